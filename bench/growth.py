#!/usr/bin/env python3
"""Measures how cost grows with the number of spheres, for sdlc and Embree on the same scenes, interleaved.

growth.py SDLC PEERS [--counts 10,100,...] [--repeats 3] [--threads 2] [--chart FILE.svg]

PEERS is a folder with gen_scene.py and embree_pt.cpp, which is compiled here. Prints a Markdown table
and least-squares fits of the time per ray with their residuals, and draws both as a chart: a + b n
if rays are tested with all spheres, a + b log2 n if they use a BVH. Paths of Embree are assumed to
have as many rays as ours, on average. All figures are medians of the repeats.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

WIDTH, DEPTH = 600, 64
HEIGHT = WIDTH * 9 // 16


def samples_for(count):
    """Paths per pixel for a run of about a second."""
    return 64 if count <= 1000 else 24 if count <= 100_000 else 8


def run_sdlc(sdlc, scene, samples, threads, folder):
    command = [sdlc, "render", scene, "-o", folder / "ours.exr", "--overwrite", "--quiet",
               "--width", WIDTH, "--samples", samples, "--depth", DEPTH, "--threads", threads,
               "--stats", "-"]
    out = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                         check=True).stdout
    stats = json.loads(out)
    return {"speed": stats["samples_per_second"] / 1e6, "build": stats["build_seconds"],
            "memory": stats["render_rss_bytes"], "kernel": f"{stats['kernel']}, {stats['precision']}",
            "rays": stats["rays"] / stats["camera_samples"]}


def run_embree(embree, scene, samples, threads, folder):
    command = [embree, scene, folder / "theirs.pfm", "--mode", "wave", "--width", WIDTH, "--spp",
               samples, "--depth", DEPTH, "--threads", threads]
    out = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                         check=True).stdout
    stats = json.loads(out)
    return {"speed": stats["msamples_per_s"], "build": stats["build_s"],
            "memory": stats["peak_rss_mb"] * 1e6}


def series_of(kernel):
    if kernel.startswith("wide"):
        return "sdlc, all spheres"
    return "sdlc, BVH, double" if kernel.endswith("double") else "sdlc, BVH"


def median_of(runs, field):
    return statistics.median(run[field] for run in runs)


class Law:
    """The fit a + b f(n), with every point weighted by 1 / y²; `error` is the residual in per cent."""

    def __init__(self, points, is_linear):
        self.counts = [n for n, _ in points]
        self.f = float if is_linear else math.log2
        self.term = "n" if is_linear else "log2 n"
        rows = [(self.f(n), y, 1 / y**2) for n, y in points]
        weight = sum(w for _, _, w in rows)
        mean_x = sum(w * x for x, _, w in rows) / weight
        mean_y = sum(w * y for _, y, w in rows) / weight
        spread = sum(w * (x - mean_x)**2 for x, _, w in rows)
        self.slope = sum(w * (x - mean_x) * (y - mean_y) for x, y, w in rows) / spread
        self.start = mean_y - self.slope * mean_x
        self.error = 100 * math.sqrt(statistics.mean((self(n) / y - 1)**2 for n, y in points))

    def __call__(self, n):
        return self.start + self.slope * self.f(n)

    def __str__(self):
        return f"{self.start:.1f} + {self.slope:.2g} {self.term}, to {self.error:.0f} %"


COLORS = {"sdlc, all spheres": "#56b4e9", "sdlc, BVH": "#0072b2",
          "sdlc, BVH, double": "#009e73", "Embree": "#d55e00"}


def chart(series, laws):
    """Returns an SVG of the time per ray over the number of spheres, with logarithmic axes."""
    width, height, left, bottom = 640, 360, 60, 40
    counts = [n for points in series.values() for n, _ in points]
    times = [y for points in series.values() for _, y in points]
    low, high = math.floor(math.log10(min(times))), math.ceil(math.log10(max(times)))
    largest = math.log10(max(counts))

    def place(n, y):
        x = left + (math.log10(n) - 1) / (largest - 1) * (width - left - 20)
        return x, 20 + (high - math.log10(y)) / (high - low) * (height - bottom - 20)

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
             'font-family="sans-serif" font-size="12" fill="#767676">']
    for power in range(1, math.floor(largest) + 1):
        x, _ = place(10**power, 10**low)
        parts.append(f'<path d="M{x:.1f} 20V{height - bottom}" stroke="#76767640"/>'
                     f'<text x="{x:.1f}" y="{height - bottom + 16}" text-anchor="middle">10'
                     f'<tspan dy="-4" font-size="9">{power}</tspan></text>')
    for power in range(low, high + 1):
        _, y = place(10, 10**power)
        parts.append(f'<path d="M{left} {y:.1f}H{width - 20}" stroke="#76767640"/>'
                     f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{10**power:g}</text>')
    parts.append(f'<text x="{width - 20}" y="{height - 6}" text-anchor="end">spheres</text>'
                 f'<text x="{left}" y="12">nanoseconds per ray</text>')
    for name, points in series.items():
        if not points:
            continue
        color = COLORS[name]
        if name in laws:
            first, last = (math.log10(n) for n in (points[0][0], points[-1][0]))
            steps = [10**(first + k * (last - first) / 60) for k in range(61)]
            line = " ".join("{:.1f},{:.1f}".format(*place(n, laws[name](n))) for n in steps)
            parts.append(f'<polyline points="{line}" fill="none" stroke="{color}"/>')
        for n, y in points:
            x, y = place(n, y)
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{color}"/>')
        x, y = place(*points[-1])
        below = {"Embree": -10, "sdlc, BVH, double": 32}.get(name, 20)
        parts.append(f'<text x="{x:.1f}" y="{y + below:.1f}" text-anchor="end" '
                     f'fill="{color}">{name}</text>')
    return "\n".join(parts) + "\n</svg>\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("sdlc")
    parser.add_argument("peers", type=pathlib.Path)
    parser.add_argument("--counts", default="10,100,1000,10000,100000,1000000")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--chart", type=pathlib.Path)
    options = parser.parse_args()

    with tempfile.TemporaryDirectory(prefix="sdlc-growth-") as name:
        folder = pathlib.Path(name)
        embree = folder / "embree_pt"
        subprocess.run(["g++", "-O3", "-march=native", "-std=c++17", "-ffp-contract=fast",
                        options.peers / "embree_pt.cpp", "-o", embree, "-lembree3", "-lpthread"],
                       check=True)
        print("| spheres | sdlc, build | bytes per sphere | million paths/s | kernel | rays per path "
              "| Embree, build | million paths/s | ratio |")
        print("| ---: | ---: | ---: | ---: | --- | ---: | ---: | ---: | ---: |")
        series = {name: [] for name in COLORS}
        base = None
        for count in (int(word) for word in options.counts.split(",")):
            scene = folder / "field.json"
            subprocess.run([sys.executable, options.peers / "gen_scene.py", "field", str(count),
                            "-o", scene], check=True)
            ours, theirs = [], []
            for _ in range(options.repeats):
                samples = samples_for(count)
                ours.append(run_sdlc(options.sdlc, scene, samples, options.threads, folder))
                theirs.append(run_embree(embree, scene, samples, options.threads, folder))
            speed, peer = median_of(ours, "speed"), median_of(theirs, "speed")
            memory = median_of(ours, "memory")
            base = memory if base is None else base
            own = f"{(memory - base) / count:.0f}" if count >= 100_000 else ""
            print(f"| {count:,} | {median_of(ours, 'build'):.3g} s | {own} | {speed:.3g} "
                  f"| {ours[-1]['kernel']} | {ours[-1]['rays']:.2f} | {median_of(theirs, 'build'):.3g} s | {peer:.3g} "
                  f"| {speed / peer:.2f} |", flush=True)
            rays = ours[-1]["rays"]
            series[series_of(ours[-1]["kernel"])].append((count, 1e3 / speed / rays))
            series["Embree"].append((count, 1e3 / peer / rays))
        laws = {name: Law(points, "all spheres" in name)
                for name, points in series.items() if len(points) > 1}
        for name, law in laws.items():
            print(f"\n{name}: {law} nanoseconds per ray")
        if options.chart:
            options.chart.write_text(chart(series, laws), encoding="utf-8")


if __name__ == "__main__":
    main()
