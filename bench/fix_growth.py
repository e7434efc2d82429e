#!/usr/bin/env python3
"""Measures how the time of commands that repair or rewrite text grows with the number of mistakes.

fix_growth.py SDLC [--counts 5000,20000,80000] [--only NAME]

Prints a Markdown table of CPU seconds, which should grow in proportion to the counts.
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile

HEAD = "scene 1\ncamera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n"
CONFIG = {"camera": {"look_from": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0], "vfov": 40,
                     "focal_length": 1, "aspect_ratio": 1.6, "viewport_height": 2,
                     "samples_per_pixel": 4},
          "rendering": {"width": 16, "render_depth": 4}, "saving": {"path": "c.png"}}


def lines(line, head=HEAD):
    return lambda count: head + "".join(line.format(i=i) for i in range(count))


def config(sphere):
    begin = json.dumps(CONFIG)[:-1] + ', "spheres": [\n'
    return lambda count: begin + ",\n".join(sphere.format(i=i) for i in range(count)) + "]}\n"


SPHERE = "sphere {{ center: ({i}, 0, 0), radius: .1, material: diffuse(color: tan) }}\n"
JSON_SPHERE = ('{{"origin": [{i}, 0, 0], "radius": 0.1, '
               '"material": {{"type": "diffuse", "color": [1, 2, 3]}}}}')
CASES = {
    "semicolons": ("lint --fix", lines("let a{i} = 1;\n")),
    "one name, semicolons": ("lint --fix", lines("let a = 1;\n")),
    "semicolons, --diff": ("lint --fix --diff", lines("let a{i} = 1;\n")),
    "missing colons": ("lint --fix", lines(SPHERE.replace("center:", "center"))),
    "missing commas": ("lint --fix", lines("let a{i} = [1 2, 3]\n")),
    "typographic quotes": ("lint --fix", lines("let a{i} = “x”\n")),
    "lopsided minus": ("lint --fix", lines("let a{i} = pi -{i}\n")),
    "units apart": ("lint --fix", lines("let a{i} = {i} m;\n")),
    "unused lets": ("lint --unsafe-fixes", lines("let a{i} = 1\n")),
    "unknown properties": ("lint --unsafe-fixes", lines(SPHERE.replace("radius", "radus"))),
    "unknown names": ("lint --unsafe-fixes", lines("let a{i} = pii\n")),
    "unknown names of many": ("lint --unsafe-fixes",
                              lines("let someone{i} = 1\nlet other{i} = someon{i}x\n")),
    "no fix": ("lint --fix", lines("let a{i} = 1 / 0\n")),
    "JSON, single quotes": ("lint --fix", config(JSON_SPHERE.replace('"radius"', "'radius'"))),
    "JSON, missing commas": ("lint --fix", config(JSON_SPHERE.replace("0.1,", "0.1"))),
    "JSON, unknown keys": ("lint --unsafe-fixes", config(JSON_SPHERE.replace("radius", "radus"))),
    "JSON, sound": ("convert -o out.scene", config(JSON_SPHERE)),
    "sound": ("fmt", lines(SPHERE)),
    "sound, --diff": ("fmt --diff", lines(SPHERE)),
    "sound, to JSON": ("convert -o out.json", lines(SPHERE, HEAD + "background { color: white }\n")),
}


def seconds(sdlc, command, text, is_config):
    with tempfile.TemporaryDirectory(prefix="sdlc-fixes-") as folder:
        name = "input.json" if is_config else "input.scene"
        (pathlib.Path(folder) / name).write_text(text, encoding="utf-8")
        before = os.times()
        verb, *flags = command.split()
        subprocess.run([sdlc, verb, name, *flags], cwd=folder, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - \
            before.children_system


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("sdlc", type=pathlib.Path)
    parser.add_argument("--counts", default="5000,20000,80000")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    counts = [int(word) for word in options.counts.split(",")]
    print("| text | command | " + " | ".join(f"{count:,}" for count in counts) + " |")
    print("| --- | --- |" + " ---: |" * len(counts))
    for name, (command, text) in CASES.items():
        if options.only not in name:
            continue
        times = [seconds(options.sdlc.resolve(), command, text(count), name.startswith("JSON"))
                 for count in counts]
        print(f"| {name} | `{command}` | " + " | ".join(f"{t:.2f}" for t in times) + " |",
              flush=True)


if __name__ == "__main__":
    main()
