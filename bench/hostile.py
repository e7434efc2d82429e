#!/usr/bin/env python3
"""Measures what scenes designed to use up time and memory cost each command, within the limits.

hostile.py SDLC [--only WORD] [--commands lint,render] [--timeout 60] [--all]

Prints a Markdown table with the CPU seconds, the peak resident memory and the exit status of each scene
and command. Rows above 10 seconds or 1.5 GiB (2 GiB for files of the maximum size) are marked with `!`.
Without --all only the costliest command of each scene is shown.
"""

import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

CAMERA = "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
LIGHT = "background { color: white }\n"
RENDER = "render { width: 8, samples: 1 }\n"
HEAD = "scene 1\n" + CAMERA + LIGHT + RENDER
BALL = "sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: red) }\n"
MIB = 1 << 20

SCENES = {}


def scene(function):
    SCENES[function.__name__] = function
    return function


def text(body):
    return {"main.scene": HEAD + body + BALL}


# Evaluation


@scene
def lets_that_are_loops():
    """6 KB: a loop whose body has no further loops and calls."""
    return text("for i in range(99000000) {\n" +
                "".join(f"let a{k} = sin(i * {k}deg) + cos(i * 3deg) * i ^ 0.3\n"
                        for k in range(120)) + "}\n")


@scene
def random_of_a_long_string():
    return text('fn grow(s, n) = if n == 0 then s else grow(s + s, n - 1)\n'
                'let s = grow("x", 20)\nfor i in range(99000000) { let a = random(s, i) }\n')


@scene
def noise_300_a_turn():
    terms = " + ".join(f"noise((i, {k}, 0.5))" for k in range(300))
    return text(f"for i in range(99000000) {{ let a = {terms} }}\n")


@scene
def doubled_strings():
    return text('let s0 = "0123456789abcdef"\n' +
                "".join(f"let s{k + 1} = s{k} + s{k}\n" for k in range(15)) +
                "".join(f'let t{k} = s15 + "{k}"\n' for k in range(4200)))


@scene
def list_of_long_strings():
    return text('fn grow(s, n) = if n == 0 then s else grow(s + s, n - 1)\nlet s = grow("x", 19)\n'
                "let l = [" + ", ".join(f's + "{k}"' for k in range(6000)) + "]\n")


@scene
def lists_of_lists():
    return text("let l0 = [" + ", ".join("1" for _ in range(1000)) + "]\n" +
                "fn copy(i) = [" + ", ".join(f"i + {k}" for k in range(1000)) + "]\n" +
                "fn more(i) = [" + ", ".join(f"copy(i + {k})" for k in range(1000)) + "]\n" +
                "let m = [" + ", ".join(f"more({k})" for k in range(1000)) + "]\n")


@scene
def equal_long_lists():
    return text("let a = range(50000000)\nlet b = range(50000000)\n" +
                "for i in range(100000000) { assert a == b, \"\" }\n")


@scene
def equal_long_strings():
    return text('fn grow(s, n) = if n == 0 then s else grow(s + s, n - 1)\n'
                'let s = grow("x", 20)\nlet t = grow("x", 20)\n'
                'for i in range(99000000) { assert s == t, "" }\n')


@scene
def sums_of_lists():
    return text("let a = range(10000000)\nfor i in range(100000) { let b = sum(a) + max(a) }\n")


@scene
def calls_of_calls():
    return text("fn f(n) = if n == 0 then 1 else f(n - 1) + f(n - 1)\nlet a = f(120)\n")


@scene
def calls_with_many_arguments():
    names = ", ".join(f"a{k}" for k in range(200))
    again = ", ".join(f"a{k}" for k in range(1, 200)) + ", a0"
    return text(f"fn f({names}) = if a0 == 0 then 1 else f({again}) + f({again})\n"
                f"let a = f({', '.join(str(k + 1) for k in range(200))})\n")


@scene
def frames_of_many_slots():
    lets = "".join(f"let a{k} = {k}\n" for k in range(100000))
    return text(f"def d(n) {{\n{lets}if n > 0 {{ d {{ n: n - 1 }} d {{ n: n - 1.5 }} }}\n}}\nd {{ n: 120 }}\n")


@scene
def defs_of_defs():
    defs = "".join(f"def d{k}() {{ d{k + 1} {{ }} d{k + 1} {{ }} }}\n" for k in range(100))
    return text(defs + "def d100() { }\nd0 { }\n")


@scene
def defs_of_defs_with_numbers():
    return text("def d(n, x) { if n > 0 { d { n: n - 1, x: 2 * x } d { n: n - 1, x: 2 * x + 1 } } }\n"
                "d { n: 110, x: 1 }\n")


@scene
def defs_of_defs_with_strings():
    return text('fn grow(s, n) = if n == 0 then s else grow(s + s, n - 1)\nlet s = grow("x", 19)\n'
                'def d(n, x) { if n > 0 { d { n: n - 1, x: x + "a" } d { n: n - 1, x: x + "b" } } }\n'
                "d { n: 110, x: s }\n")


@scene
def defs_with_one_sphere():
    defs = "".join(f"def d{k}() {{ d{k + 1} {{ translate: (1, 0, {k}) }} d{k + 1} {{ rotate: (0deg, {k}deg, 0deg) }} }}\n"
                   for k in range(100))
    return text(defs + "def d100() { " + BALL + " }\nd0 { }\n")


@scene
def groups_without_spheres():
    return text("for i in range(1e9) { group { translate: (i, 0, 0), group { rotate: (0deg, 1deg, 2deg) } } }\n")


@scene
def deep_groups_in_a_loop():
    return text("for i in range(1e9) { " + "group { rotate: (1deg, 2deg, 3deg) " * 60 + "}" * 60 + " }\n")


@scene
def spheres_of_a_loop():
    return text("for i in range(99000000) { sphere { center: (mod(i, 464), mod(floor(i / 464), 464), floor(i / 215296)), "
                "radius: 0.3, material: diffuse(color: red) } }\n")


@scene
def equal_spheres():
    return text("for i in range(99000000) { sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: red) } }\n")


@scene
def spheres_of_many_materials():
    return text("for i in range(99000000) { sphere { center: (i, 0, 0), radius: 0.3, "
                "material: diffuse(color: linear(i / 1e8, random(i), 0.5)) } }\n")


@scene
def moving_spheres():
    return {"main.scene": "scene 1\ncamera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, shutter: 0s .. 1s }\n" +
            LIGHT + RENDER +
            "for i in range(99000000) { group { rotate: (0deg, 90deg * time / 1s, 0deg) sphere { center: (i, 0, 0), "
            "radius: 0.3, material: diffuse(color: red), motion: line(to: (i, 1, 0), over: 0s .. 1s) } } }\n" + BALL}


@scene
def spheres_inside_each_other():
    return text("for i in range(3000000) { sphere { center: (0, 0, 0), radius: 1 + i / 3e6, material: transmissive(ior: 1.5) } }\n")


@scene
def heavy_spheres():
    """Each sphere takes 900 evaluations of noise."""
    terms = " + ".join(f"noise((i, {k}, 0.5))" for k in range(900))
    return text(f"for i in range(99000000) {{ sphere {{ center: (i, {terms}, 0), radius: 0.1, material: diffuse(color: red) }} }}\n")


@scene
def work_before_findings():
    """Work, followed by spheres whose findings have to be traced back to the source."""
    return {"main.scene": "scene 1\nanimation { frames: 1 .. 100, fps: 24 }\n" + CAMERA + LIGHT +
            'render { width: 8, samples: 1, output: "a.####.png" }\n' +
            "for i in range(11000000) { let a = sin(i * 1deg) + time / 1s }\n" +
            "".join(f"sphere {{ center: (0, 0, 0), radius: {r}, material: diffuse(color: red) }}\n"
                    for r in (1, 1, 2, 3, 4, 10, 1e-9)) +
            "sphere { center: (9, 9, 9), radius: 1, material: transmissive(ior: 0.5) }\n"}


@scene
def asserts_with_long_strings():
    return text('fn grow(s, n) = if n == 0 then s else grow(s + s, n - 1)\nlet s = grow("x", 19)\n' +
                "".join(f'assert 1 == 2, s + "{k}"\n' for k in range(20000)))


@scene
def warnings_of_defs():
    return text("def d(n) { " + BALL + BALL + "}\nfor i in range(3000000) { d { n: i } }\n")


@scene
def param_of_the_command_line():
    return {**text('param s = "x"\nfor i in range(99000000) { let a = random(s + str(i)) }\n'),
            "flags": ["--set", "s=" + "x" * 100000]}


@scene
def str_of_everything():
    return text("for i in range(99000000) { let a = str(i / 7) + str((i / 3, i / 7, i / 11)) + str(hsl(1deg * mod(i, 360), 0.5, 0.5)) }\n")


@scene
def else_if_of_100000():
    chain = " else ".join(f"if x == {k} then {k}" for k in range(1, 50000)) + " else 0"
    return text(f"fn f(x) = {chain}\nfor i in range(1e8) {{ let a = f(-1) }}\n")


@scene
def range_over_literals():
    return text("for i in [" + ", ".join(str(k) for k in range(300000)) + "] { for j in ["
                + ", ".join(str(k) for k in range(300000)) + "] { } }\n")


@scene
def film_of_a_billion_frames():
    return {"main.scene": "scene 1\nanimation { frames: 1 .. 1000000000, fps: 24 }\n" + CAMERA + LIGHT +
            'render { width: 8, samples: 1, output: "a.####.png" }\n' +
            "for i in range(1000) { sphere { center: (i, sin(360deg * time / 1s), 0), radius: 1, material: diffuse(color: red) } }\n"}


# Files


@scene
def includes_in_a_loop():
    return {**text('for i in range(1e9) { include "part.scene" }\n'),
            "part.scene": "scene 1\n" + "let a = 1\n" * 0 + "".join(f"let a{k} = {k}\n" for k in range(3000))}


@scene
def includes_of_statements():
    return {**text('for i in range(1e9) { include "part.scene" }\n'),
            "part.scene": "scene 1\n" + "".join(f"if 1 > 2 {{ group {{ translate: (1 + {k} * 2, 2, 3) }} }}\n" for k in range(3000))}


@scene
def includes_of_configs():
    return {**text('for i in range(1e9) { include "part.json" }\n'),
            "part.json": json.dumps({"spheres": []}) + " " * 100000}


@scene
def includes_of_includes():
    files = text('include "p0.scene"\n')
    for k in range(30):
        files[f"p{k}.scene"] = "scene 1\n" + f'include "p{k + 1}.scene"\n' * 2
    files["p30.scene"] = "scene 1\n"
    return files


@scene
def imports_of_imports():
    files = text('import "p0.scene" as p\n')
    for k in range(30):
        files[f"p{k}.scene"] = "scene 1\n" + "".join(f'import "p{k + 1}.scene" as q{j}\n' for j in range(200))
    files["p30.scene"] = "scene 1\nlet a = 1\n"
    return files


@scene
def unknown_names():
    return text("".join(f"let name_number_{k} = {k}\n" for k in range(50000)) +
                "".join(f"let b{k} = nome_nunber_{k}x\n" for k in range(50000)))


@scene
def unknown_members():
    return {**text('import "part.scene" as p\n' + "".join(f"let b{k} = p.nome_nunber_{k}x\n" for k in range(50000))),
            "part.scene": "scene 1\n" + "".join(f"let name_number_{k} = {k}\n" for k in range(50000))}


@scene
def unknown_kinds():
    return text("".join(f"def kind_number_{k}() {{ }}\n" for k in range(30000)) +
                "".join(f"kimd_nunber_{k}x {{ a: 1 }}\n" for k in range(30000)))


@scene
def unknown_properties():
    return text("".join(f"sphere {{ center: (0, 0, 0), radus: 1, matrial_{k}: diffuse(colour: red) }}\n" for k in range(30000)))


@scene
def unknown_parameters():
    names = ", ".join(f"name_number_{k} = 1" for k in range(3000))
    calls = "".join(f"let b{k} = f(nome_nunber_{k}: 1, name_munber_{k}: 2)\n" for k in range(20000))
    return text(f"fn f({names}) = 1\n{calls}")


@scene
def circles_of_lets():
    return text("".join(f"let a{k} = a{(k + 1) % 100000} + a{(k * 7) % 100000}\n" for k in range(100000)))


@scene
def chain_of_lets():
    return text("".join(f"let a{k} = a{k + 1} + 1\n" for k in range(200000)) + "let a200000 = 1\n")


@scene
def duplicates():
    return text("let a = 1;\n" * 100000)


@scene
def many_mistakes():
    return text("sphere { center (0 0 0) radius = 1, material: difuse(red }\n" * 10000)


@scene
def many_mistakes_in_long_text():
    return text("sphere { center (0 0 0) radius = 1, material: difuse(red }\n" * 500000)


@scene
def cameras():
    return {"main.scene": "scene 1\n" + LIGHT + RENDER + BALL +
            "".join(f"camera c{k} {{ from: (0, 0, 5), at: (0, 0, {k / 1e6}), fov: 40deg, shutter: 0s .. 1s }}\n" for k in range(30000))}


@scene
def materials_by_name():
    return text("".join(f"let m{k} = diffuse(color: linear({k / 2e5}, 0.5, 0.5))\n"
                        f"sphere {{ center: ({k}, 0, 0), radius: 0.4, material: m{k} }}\n" for k in range(200000)))


@scene
def allowances():
    return text("".join(f"// sdlc: allow W401 W40{k % 10}\n" for k in range(200000)))


@scene
def long_line():
    return text("let a = " + " + ".join("1" for _ in range(3000000)) + "\n")


@scene
def long_line_of_mistakes():
    return text("".join(f"let a = b{k} " for k in range(300000)) + "\n")


@scene
def open_brackets():
    return text("(" * 1000000 + "\n")


@scene
def open_blocks():
    return text("group { " * 1000000 + "\n")


@scene
def open_comments():
    return text("/* " * 1000000 + "\n")


@scene
def quotes():
    return text('"' * 1000001 + "\n")


@scene
def minuses():
    return text("let a = " + "-" * 1000000 + "1\n")


@scene
def powers():
    return text("let a = " + " ^ ".join("1" for _ in range(500000)) + "\n")


@scene
def nuls():
    return {"main.scene": b"\0" * (2 * MIB)}


@scene
def bad_bytes():
    return {"main.scene": HEAD.encode() + b"\xff" * (2 * MIB)}


@scene
def nuls_and_letters():
    return {"main.scene": HEAD.encode() + b"\0a\n" * MIB}


@scene
def nuls_300_mb():
    return {"main.scene": "sparse 314572800"}


@scene
def sparse_2_gib():
    return {"main.scene": f"sparse {2048 * MIB}"}


@scene
def sparse_config_2_gib():
    return {"main.json": f"sparse {2048 * MIB}"}


@scene
def endless():
    return {"main.scene": "link /dev/zero"}


@scene
def endless_config():
    return {"main.json": "link /dev/zero"}


@scene
def file_at_the_limit_of_nuls():
    return {"main.scene": "sparse limit"}


@scene
def file_at_the_limit_of_lets():
    return {"main.scene": ("fill limit", HEAD, "let a=1\n")}


@scene
def file_at_the_limit_of_minuses():
    return {"main.scene": ("fill limit", HEAD, "let a=-1+-x*-2\n")}


@scene
def file_at_the_limit_of_lists():
    return {"main.scene": ("fill limit", HEAD + "let a=[", "1,", "1]\n")}


@scene
def file_at_the_limit_of_groups():
    return {"main.scene": ("fill limit", HEAD, "group{}\n")}


@scene
def file_at_the_limit_of_comments():
    return {"main.scene": ("fill limit", HEAD, "//\n")}


@scene
def file_at_the_limit_of_spheres():
    return {"main.scene": ("fill limit", HEAD, "sphere{center:(1,2,3),radius:1,material:diffuse(color:red)}\n")}


@scene
def file_at_the_limit_of_strings():
    return {"main.scene": ("fill limit", HEAD, 'let a="\\n\\n"\n')}


@scene
def file_at_the_limit_of_junk():
    return {"main.scene": ("fill limit", HEAD, "x y z ( ;\n")}


# Configs

CONFIG = {"image_width": 8, "samples_per_pixel": 1,
          "camera": {"look_from": [0, 0, 5], "look_at": [0, 0, 0], "fov": 40}}


def config(body):
    return {"main.json": body}


@scene
def config_of_brackets():
    return config("[" * 3000000)


@scene
def config_of_nuls():
    return config(b"\0" * (2 * MIB))


@scene
def config_of_unknown_keys():
    return config("{" + ", ".join(f'"key_{k}": {k}' for k in range(300000)) + "}")


@scene
def config_of_equal_keys():
    return config("{" + ", ".join('"spheres": []' for k in range(300000)) + "}")


@scene
def config_of_materials():
    return config('{"materials": [' + ", ".join(f'{{"id": "m{k}", "type": "diffuse", "color": [0.5, 0.5, 0.5]}}' for k in range(200000)) +
                  '], "spheres": [' + ", ".join(f'{{"origin": [{k}, 0, 0], "radius": 0.4, "material": "mm{k}"}}' for k in range(200000)) + "]}")


@scene
def config_of_mistakes():
    return config('{"spheres": [' + ", ".join('{"origin": [1 2 3] "radius" 1}' for k in range(100000)) + "]}")


@scene
def config_of_spheres():
    return config('{"spheres": [' + ",\n".join(f'{{"origin": [{k}, 0, 0], "radius": 0.4}}' for k in range(1000000)) + "]}")


@scene
def config_at_the_limit_of_lists():
    return {"main.json": ("fill limit", '{"spheres": [', "[],", "[]]}")}


@scene
def config_at_the_limit_of_numbers():
    return {"main.json": ("fill limit", '{"spheres": [', "1,", "1]}")}


@scene
def config_at_the_limit_of_keys():
    return {"main.json": ("fill limit", '{"a": {', '"b":1,', '"b":1}}')}


@scene
def config_at_the_limit_of_blanks():
    return {"main.json": ("fill limit", "{", " ", "}")}


COMMANDS = {
    "lint": lambda sdlc, name: [sdlc, "lint", "--no-config", name],
    "lint --fix": lambda sdlc, name: [sdlc, "lint", "--no-config", "--fix", "--diff", name],
    "fmt": lambda sdlc, name: [sdlc, "fmt", "--check", name],
    "inspect": lambda sdlc, name: [sdlc, "inspect", name],
    "convert": lambda sdlc, name: [sdlc, "convert", name, "-o", "-"],
    "render": lambda sdlc, name: [sdlc, "render", name, "-o", "out.png", "--overwrite", "--quiet",
                                  "--width", "4", "--samples", "1", "--depth", "1"],
}
FILE_LIMIT = {"main.scene": 32 * MIB, "main.json": 256 * MIB}


def write(folder, files):
    for name, content in files.items():
        path = folder / name
        if name == "flags":
            continue
        if isinstance(content, bytes):
            path.write_bytes(content)
        elif isinstance(content, tuple):
            _, begin, middle, *end = content
            size = FILE_LIMIT[name] - len(begin) - sum(map(len, end))
            with open(path, "w") as out:
                out.write(begin)
                block = middle * (MIB // len(middle))
                count = size // len(middle) * len(middle)
                while count >= len(block):
                    out.write(block)
                    count -= len(block)
                out.write(middle * (count // len(middle)))
                out.write("".join(end))
        elif content.startswith("sparse "):
            size = content[7:]
            with open(path, "wb") as out:
                out.truncate(FILE_LIMIT[name] if size == "limit" else int(size))
        elif content.startswith("link "):
            os.symlink(content[5:], path)
        else:
            path.write_text(content)


def measure(command, folder, timeout):
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (12 << 30, 12 << 30))
        resource.setrlimit(resource.RLIMIT_CPU, (timeout, timeout))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with open(folder / "stdout", "wb") as out, open(folder / "stderr", "wb") as err:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                   preexec_fn=limit)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status
    code = os.waitstatus_to_exitcode(status)
    lines = (folder / "stderr").read_bytes()[:100000] + b"\n" + (folder / "stdout").read_bytes()[:100000]
    first = next((line for line in lines.decode("utf-8", "replace").splitlines() if line.startswith("error")), "")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, code, first[:70]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("sdlc", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--commands", default=",".join(COMMANDS))
    parser.add_argument("--timeout", type=int, default=60)
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args()
    wanted = options.commands.split(",")
    print("| scene | command | seconds | MiB | exit | first error |\n| --- | --- | ---: | ---: | ---: | --- |")
    for name, make in SCENES.items():
        if options.only not in name:
            continue
        with tempfile.TemporaryDirectory(prefix="hostile.") as temporary:
            folder = pathlib.Path(temporary)
            files = make()
            write(folder, files)
            main_name = next(iter(files))
            rows = []
            for command in wanted:
                if command == "fmt" and main_name.endswith(".json"):
                    continue
                words = COMMANDS[command](str(options.sdlc.resolve()), main_name)
                if command in ("inspect", "render"):
                    words += files.get("flags", [])
                if (folder / main_name).is_symlink() and command == "lint --fix":
                    continue
                rows.append((command, *measure(words, folder, options.timeout)))
            worst = max(rows, key=lambda row: max(row[1] / 10, row[2] / 1536))
            limit = 2048 if "limit" in name else 1536
            for row in rows if options.all else [worst]:
                mark = " !" if row[1] > 10 or row[2] > limit or row[3] not in (0, 1, 2) else ""
                print(f"| {name} | {row[0]} | {row[1]:.1f} | {row[2]:.0f} | {row[3]}{mark} | {row[4]} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
