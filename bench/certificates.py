#!/usr/bin/env python3
"""Looks for wrong certificates: pictures whose error is said to be reached, and is not.

    bench/certificates.py build/release/bin/sdlc [--seeds 100] [--goal 5%] [--samples 16384] [--truth 1048576]
                         [SCENE...]

The scenes of bench/certificates have light that is hard to find. Each is rendered with many seeds until the goal is
reached, with at most SAMPLES per pixel, and compared with a render of TRUTH samples of another seed that samples
caustics. Prints, for each scene: what light sampling `auto` chose; the estimated error of the truth; how many pictures
have a certificate, and how many of their intervals hold the true error; the median true error, and the largest one
relative to the upper end of its interval.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import statistics
import subprocess
import tempfile


def run(*command):
    """The JSON object that a command prints."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    return json.loads(done.stdout)


def check(arguments, scene, folder):
    program, truth = arguments.program, folder / "truth.exr"

    def render(picture, seed, samples, *options):
        return run(program, "render", scene, "-o", picture, "--seed", seed, "--samples", samples, "--stats", "-",
                   "--quiet", *options)

    def certificate(seed):
        picture = folder / f"{seed}.exr"
        stats = render(picture, seed, arguments.samples, "--error", arguments.goal, "--threads", 1)
        compared = run(program, "compare", picture, truth, "--format", "json")
        reached = stats["has_reached_error"]
        return stats["light_choice"], stats["relative_error_interval"] if reached else None, compared["relative_error"]

    of_truth = render(truth, 1_000_000, arguments.truth, "--light-sampling", "caustics")["relative_error"]
    of_truth = f"{of_truth:.2%}" if of_truth else "unknown"
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        pictures = list(pool.map(certificate, range(1, arguments.seeds + 1)))
    certified = [(interval, error) for _, interval, error in pictures if interval]
    held = sum(low <= error <= high for (low, high), error in certified)
    worst = max((error / high for (_, high), error in certified), default=0)
    median = statistics.median(error for _, _, error in pictures)
    cells = [scene.stem, pictures[0][0], of_truth, len(certified), held, f"{median:.2%}", f"{worst:.2f}"]
    print(f"| {' | '.join(str(cell) for cell in cells)} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--goal", default="5%")
    parser.add_argument("--samples", type=int, default=16384)
    parser.add_argument("--truth", type=int, default=1 << 20)
    arguments = parser.parse_intermixed_args()
    scenes = arguments.scenes or sorted((pathlib.Path(__file__).parent / "certificates").glob("*.scene"))
    print("| scene | auto | error of the truth | certified | held | true error | largest / upper end |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for scene in scenes:
        with tempfile.TemporaryDirectory() as folder:
            check(arguments, pathlib.Path(scene), pathlib.Path(folder))


if __name__ == "__main__":
    main()
