"""Follows the steps of docs/tutorial.md in an empty folder, with small pictures.

Usage: tutorial_test.py PROGRAM PAGE [--pictures]

The words after the opening fence of a block select what is done with it:

  rust file NAME      (or `csv`) the complete text of a file
  rust change NAME    statements; one that begins with the same two words as one of the file replaces it, any other is
                      added at the end
  sh                  lines `sdlc ...` that succeed; `# writes NAME` after one: the file that it writes
  text session        lines `$ sdlc ...`, each followed by its complete output

At the end of each step the scene has no findings, and is that of the file that the step links to; the picture of the
step exists, and is small. SDLC_UPDATE=1 rewrites the sessions and the linked files; --pictures renders the pictures,
by the commands as they are.
"""

import os
import pathlib
import re
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import urllib.request

WIDTH = 480
MAX_PICTURE_BYTES = 250_000
SMALL = {"--width": "24", "--samples": "16"}
UPDATE = "SDLC_UPDATE" in os.environ


class Wrong(Exception):
    """The page is not true."""


class Step:
    """A section `## N. TITLE`: its number, and its lines as (number in the page, text)."""

    def __init__(self, number, lines):
        self.number, self.lines = number, lines

    def blocks(self):
        """(number of the first line of the text, words after the fence, text) of each fenced block."""
        start, words, text = None, None, []
        for number, line in self.lines:
            if not line.startswith("```"):
                text.append(line)
            elif start is None:
                start, words, text = number + 1, line[3:].split(), []
            else:
                yield start, words, "".join(line + "\n" for line in text)
                start = None

    def linked(self, pattern):
        """The one target of a link that matches, or None."""
        targets = re.findall(r"\]\((" + pattern + r")\)", "\n".join(line for _, line in self.lines))
        if len(targets) > 1:
            raise Wrong(f"step {self.number} links to several files: {targets}")
        return targets[0] if targets else None


def steps_of(page):
    steps, inside = [], False
    for number, line in enumerate(page.splitlines(), 1):
        heading = re.match(r"## (\d+)\. ", line)
        if line.startswith("## "):
            inside = heading is not None
            if inside:
                steps.append(Step(int(heading[1]), []))
        if inside:
            steps[-1].lines.append((number, line))
    return steps


def statements_of(text):
    """The statements of a formatted file, each with the comments above it: a statement begins in the first column,
    and ends before the next one."""
    statements, comments = [], []
    for line in text.splitlines():
        if line.startswith("//"):
            comments.append(line)
        elif line[:1] in ("", " ", "}", ")", "]"):
            if statements and not comments:
                statements[-1].append(line)
        else:
            statements.append([*comments, line])
            comments = []
    return ["\n".join(lines).rstrip() for lines in statements]


def key_of(statement):
    """Its first two words, which say whether another one replaces it."""
    code = next(line for line in statement.splitlines() if not line.startswith("//"))
    return re.findall(r'\w+|".*?"|[{(]', code)[:2]


def changed(text, change):
    """The text after the change."""
    statements = statements_of(text)
    for new in statements_of(change):
        same = [i for i, old in enumerate(statements) if key_of(old) == key_of(new)]
        if same:
            statements[same[0]] = new
        else:
            statements.append(new)
    return "\n\n".join(statements) + "\n"


def small(arguments):
    """The arguments of `sdlc render` for a small picture."""
    if arguments[0] != "render":
        return arguments
    result = []
    skip = False
    for argument in arguments:
        if not skip and argument not in SMALL:
            result.append(argument)
        skip = argument in SMALL
    return result + [word for option in SMALL.items() for word in option]


class Reader:
    """Someone who follows the page in a folder."""

    def __init__(self, program, folder, full_size):
        self.program, self.folder, self.full_size = program, folder, full_size
        self.picture = None  # the last one that was written

    def run(self, arguments):
        """The exit status and the output, standard error included."""
        result = subprocess.run([self.program, *arguments], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return result.returncode, result.stdout

    def serve(self, arguments):
        """Opens the page whose address `sdlc serve` prints; a scene with errors, or none, is served too."""
        status, text = self.run(["inspect", *arguments[1:]])
        if status != 0:
            raise Wrong(text)
        process = subprocess.Popen([self.program, *arguments], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        try:
            line = process.stdout.readline()
            address = re.search(r"http://\S+", line)
            if not address:
                raise Wrong(f"no address: {line}")
            without_proxy = urllib.request.build_opener(urllib.request.ProxyHandler({}))
            with without_proxy.open(address[0]) as answer:
                if b"<html" not in answer.read():
                    raise Wrong("the address is not that of a page")
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate()

    def do(self, line):
        """A line of a block `sh`."""
        command, _, comment = line.partition("#")
        words = shlex.split(command)
        if words[:1] != ["sdlc"]:
            raise Wrong(f"not a command of sdlc: {line}")
        arguments = words[1:]
        if arguments[0] == "serve":
            return self.serve(arguments)
        output = re.fullmatch(r" writes (\S+)", comment.rstrip())
        if not output:
            raise Wrong(f"the page does not say what this writes: {line}")
        path = self.folder / output[1]
        if path.suffix == ".mp4" and (self.full_size or not shutil.which("ffmpeg")):
            print(f"skipped: {line}" + ("" if self.full_size else " (ffmpeg is not installed)"))
            return None
        path.unlink(missing_ok=True)
        if self.full_size and arguments[0] == "render":
            arguments += ["--width", str(WIDTH)]
        status, text = self.run(arguments if self.full_size else small(arguments))
        if status != 0:
            raise Wrong(f"{line}\nends with {status}:\n{text}")
        if not path.is_file() or path.stat().st_size == 0:
            raise Wrong(f"{line}\ndid not write {output[1]}, but printed:\n{text}")
        if path.suffix == ".png":
            self.picture = path
        return None

    def session(self, text):
        """The session with the real output."""
        lines = []
        for line in text.splitlines():
            if line.startswith("$ sdlc "):
                lines += [line + "\n", self.run(shlex.split(line)[2:])[1]]
        return "".join(lines)

    def follow(self, words, text):
        """Does what a block says; the text that the block should have."""
        if words[1:2] == ["file"]:
            (self.folder / words[2]).write_text(text, encoding="utf-8")
        elif words[1:2] == ["change"]:
            path = self.folder / words[2]
            path.write_text(changed(path.read_text(encoding="utf-8"), text), encoding="utf-8")
        elif words[1:2] == ["session"]:
            return self.session(text)
        elif words == ["sh"]:
            for line in text.splitlines():
                self.do(line)
        else:
            raise Wrong(f"a block of an unknown kind: {words}")
        return text

    def check_scenes(self):
        for command in (["lint"], ["fmt", "--check", "--diff"]):
            for scene in self.folder.glob("*.scene"):
                status, text = self.run([*command, scene.name])
                if status != 0:
                    raise Wrong(f"sdlc {' '.join(command)} {scene.name}:\n{text}")


def check_linked(step, folder, reader):
    """The file that the step links to is the reader's, and so are the data files beside it."""
    target = step.linked(r"tutorial/[^)]*\.scene")
    if target is None:
        return
    for path in reader.folder.iterdir():
        if path.suffix not in (".scene", ".csv"):
            continue
        copy = folder / (target if path.suffix == ".scene" else f"tutorial/{path.name}")
        if UPDATE:
            copy.write_bytes(path.read_bytes())
        elif not copy.is_file() or copy.read_bytes() != path.read_bytes():
            raise Wrong(f"{copy} is not the file after step {step.number}; SDLC_UPDATE=1 rewrites it")


def check_picture(step, folder, reader):
    target = step.linked(r"images/[^)]*\.png")
    if target != f"images/tutorial-{step.number:02}.png":
        raise Wrong(f"step {step.number} has the picture {target}")
    path = folder / target
    if reader.full_size:
        shutil.copyfile(reader.picture, path)
    data = path.read_bytes()
    width = struct.unpack(">I", data[16:20])[0]
    if width != WIDTH or len(data) > MAX_PICTURE_BYTES:
        raise Wrong(f"{target} is {width} pixels wide and has {len(data)} bytes")


def follow_page(page_path, reader):
    page = page_path.read_text(encoding="utf-8")
    lines = page.splitlines(keepends=True)
    replacements = []
    steps = steps_of(page)
    if [step.number for step in steps] != list(range(1, 11)):
        raise Wrong("the page does not have the steps 1 to 10")
    for step in steps:
        reader.picture = None
        for start, words, text in step.blocks():
            try:
                real = reader.follow(words, text)
            except Wrong as wrong:
                raise Wrong(f"{page_path}:{start}: {wrong}") from None
            if real != text and not UPDATE:
                raise Wrong(f"{page_path}:{start}: SDLC_UPDATE=1 rewrites this:\n{text}\nto\n{real}")
            replacements.append((start - 1, len(text.splitlines()), real))
        if reader.picture is None:
            raise Wrong(f"step {step.number} renders no picture")
        reader.check_scenes()
        check_linked(step, page_path.parent, reader)
        check_picture(step, page_path.parent, reader)
    if UPDATE:
        for start, count, text in reversed(replacements):
            lines[start : start + count] = [text]
        page_path.write_text("".join(lines), encoding="utf-8")
    return len(steps)


def main(program, page, *options):
    with tempfile.TemporaryDirectory() as name:
        reader = Reader(program, pathlib.Path(name), full_size="--pictures" in options)
        try:
            count = follow_page(pathlib.Path(page), reader)
        except Wrong as wrong:
            print(wrong)
            return 1
    print(f"{count} steps, no failures")
    return 0


sys.exit(main(*sys.argv[1:]))
