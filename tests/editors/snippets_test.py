"""Expands each snippet of editors/vscode with its defaults: `sdlc lint` finds nothing in the result, and `sdlc fmt`
changes nothing. Arguments: the program, the file of snippets."""

import json
import pathlib
import subprocess
import sys
import tempfile

CAMERA = "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n"
BALL = "sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }\n"
VARIABLES = {"TM_FILENAME_BASE": None}  # None: the default in the snippet, as for a file without a name


class Expansion:
    """Reads TextMate's syntax: `$1`, `${1:default}`, `${VARIABLE:default}` and `\\}`. A repeated number takes the text
    of its first default."""

    def __init__(self, body):
        self.body, self.at, self.texts = body, 0, {}

    def text(self, end=None):
        result = ""
        while self.at < len(self.body):
            character = self.body[self.at]
            if character == end:
                return result
            if character == "\\":
                self.at += 1
                result += self.body[self.at]
            elif character == "$":
                result += self.placeholder()
                continue
            else:
                result += character
            self.at += 1
        if end:
            raise ValueError(f"`{self.body}` lacks a `{end}`")
        return result

    def name(self):
        start = self.at
        while self.at < len(self.body) and (self.body[self.at].isalnum() or self.body[self.at] == "_"):
            self.at += 1
        return self.body[start : self.at]

    def placeholder(self):
        self.at += 1
        if self.body[self.at] != "{":
            return self.texts.get(self.name(), "")
        self.at += 1
        name = self.name()
        if self.body[self.at] == "}":
            self.at += 1
            return self.texts.get(name, "")
        self.at += 1  # the colon
        default = self.text(end="}")
        self.at += 1
        if name not in VARIABLES:
            return self.texts.setdefault(name, default)
        return default


def expanded(body):
    """What VS Code inserts where a tab is two spaces."""
    return Expansion(body).text().replace("\t", "  ").rstrip("\n")


def as_scene(text):
    """The snippet in a file: settings and films need something to render."""
    rest = CAMERA + BALL if text.startswith(("render", "animation")) else ""
    return f"scene 1\n{rest}{text}\n"


def complaints(program, folder, text):
    scene = folder / "snippet.scene"
    scene.write_text(text, encoding="utf-8")
    for command in (["lint"], ["fmt", "--check", "--diff"]):
        result = subprocess.run([program, *command, scene.name], cwd=folder, capture_output=True, text=True)
        if result.returncode != 0:
            return result.stdout + result.stderr
    return ""


def main(program, snippets):
    failures = 0
    prefixes = [snippet["prefix"] for snippet in snippets.values()]
    if len(set(prefixes)) != len(prefixes):
        print("two snippets have the same prefix")
        failures += 1
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for title, snippet in snippets.items():
            body = snippet["body"]
            text = as_scene(expanded(body if isinstance(body, str) else "\n".join(body)))
            found = complaints(program, folder, text)
            if found:
                failures += 1
                print(f"{title}:\n{text}\n{found}")
    print(f"{len(snippets)} snippets, {failures} failures")
    return 1 if failures else 0


with open(sys.argv[2], encoding="utf-8") as file:
    sys.exit(main(sys.argv[1], json.load(file)))
