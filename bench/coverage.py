#!/usr/bin/env python3
"""Checks the confidence intervals of sdlc against long renders.

For each scene: tiny pictures with many seeds, with a fixed number of samples and with an error goal. A
picture is *covered* if its true error, the distance from a long render of another seed, is within the
interval that sdlc reports. A goal is *met* if the true error is at most the goal. *spent* is the mean
number of samples divided by the number with which the true error would have been the goal, if errors
fall with the root of the samples.

    bench/coverage.py build/release/bin/sdlc examples/hills.scene examples/demo.scene --seeds 300

Intervals of 95 % cover 92.5 to 97.5 % of 300 pictures with a probability of 95 %.
"""

import argparse
import pathlib
import re
import subprocess
import tempfile

ERROR = re.compile(r"(\d+) samples, .*error ([\d.e+-]+) % \(([\d.e+-]+) to ([\d.e+-]+) %\)")


class Case:
    """A scene in a size, with a folder for its pictures."""

    def __init__(self, sdlc, scene, size, options, folder):
        self.sdlc, self.scene, self.options = sdlc, scene, options
        self.size = ["--width", str(size[0]), "--height", str(size[1])]
        self.truth, self.picture = folder / "truth.exr", folder / "picture.exr"

    def render(self, output, *options):
        """What sdlc says about the picture: (samples, error, low end, high end), or None."""
        command = [self.sdlc, "render", self.scene, "-o", output, *self.size, *self.options, *options]
        run = subprocess.run(command, capture_output=True, text=True)
        match = ERROR.search(run.stdout + run.stderr)
        return match and (int(match[1]), *(float(match[i]) for i in (2, 3, 4)))

    def true_error(self):
        run = subprocess.run([self.sdlc, "compare", self.picture, self.truth], capture_output=True, text=True)
        return float(re.search(r"relative error +([\d.e+-]+) %", run.stdout)[1])


def row(case, options, goal, seeds):
    """A row of the table; `goal` in percent, or None."""
    known = covered = met = 0
    spent = needed = 0.0
    for seed in range(1, seeds + 1):
        said = case.render(case.picture, "--seed", str(seed), *options)
        if said is None or (goal and said[3] > goal * 1.0001):
            continue
        samples, _, low, high = said
        error = case.true_error()
        known += 1
        covered += low <= error <= high
        if goal:
            met += error <= goal
            spent += samples
            needed += samples * (error / goal) ** 2
    if known == 0:
        return ["0", "", "", ""]
    share = lambda count: f"{count / known:.3f}"
    return [str(known), share(covered), share(met) if goal else "", f"{spent / needed:.2f}" if goal else ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sdlc", type=pathlib.Path)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--seeds", type=int, default=300)
    parser.add_argument("--samples", type=int, default=64, help="fixed number of samples")
    parser.add_argument("--size", type=int, nargs=2, default=(32, 18), metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--truth", type=int, default=1 << 16, help="samples of the long render")
    parser.add_argument("--option", action="append", default=[], help="passed on to sdlc render")
    arguments = parser.parse_args()

    print("| scene | error | covered | goal | reached | covered | met | spent |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        for scene in arguments.scenes:
            case = Case(arguments.sdlc, scene, arguments.size, arguments.option, pathlib.Path(folder))
            fixed = ["--samples", str(arguments.samples)]
            said = case.render(case.truth, "--samples", str(arguments.truth), "--seed", "1000000")
            if said is None:
                print(f"| {pathlib.Path(scene).stem} | unknown | | | | | | |", flush=True)
                continue
            typical = said[1] * (arguments.truth / arguments.samples) ** 0.5
            goal = float(f"{0.6 * typical:.2g}")
            first = row(case, fixed, None, arguments.seeds)
            second = row(case, ["--samples", "1000000", "--error", f"{goal}%"], goal, arguments.seeds)
            cells = [pathlib.Path(scene).stem, f"{typical:.2g} %", first[1], f"{goal} %", *second]
            print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
