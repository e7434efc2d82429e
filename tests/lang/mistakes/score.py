#!/usr/bin/env python3
"""Scores how well `sdlc lint` answers the mistakes that the corpora of tests/files expect.

    tests/lang/mistakes/score.py build/release/bin/sdlc [tests/files] [--list]

Prints for each corpus how many mistakes are reported on their line, reported elsewhere (within three
lines), and missed, and how many errors are reported beyond those. --list prints each difference. Give
the tests/files of another commit to compare two programs on the same expectations.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

EXPECTATION = re.compile(r"//\s*(?:\^+|@\d+\+\d+) ([A-Z]\d\d\d|label|fix|chain): |// help: ")
CORPORA = ("mistakes", "syntax", "json")


def reported(program, path):
    """The lines of the file with an error each."""
    command = [program, "lint", "--no-config", "--format", "json", "--select", "E", str(path)]
    output = subprocess.run(command, capture_output=True, check=False).stdout
    found = []
    for diagnostic in json.loads(output)["diagnostics"]:
        where = diagnostic["location"] or {}
        is_here = pathlib.Path(where.get("file", "")).name == path.name
        found.append((where["line"] if is_here else 0, diagnostic["code"], diagnostic["message"]))
    return sorted(found)


def planted(folder):
    expected = {}
    for row in (folder / "EXPECTED").read_text().splitlines():
        place, codes = row.split(" ")
        name, lines = place.split(":")
        if codes.startswith("E"):
            expected.setdefault(name, []).append([int(line) for line in lines.split("|")])
    for path in sorted(folder.iterdir()):
        if path.suffix in (".scene", ".json"):
            yield path.name, path, expected.get(path.name, [])


def with_bytes(match):
    name, _, count = match.group(1).partition("×")
    return name.encode() * int(count) if count else bytes([int(name, 16)])


def unescape(text):
    parts = re.split(r"(⟦[^⟧]*⟧)", text)
    return b"".join(with_bytes(re.match("⟦(.*)⟧", p)) if p.startswith("⟦") else p.encode() for p in parts)


def cases(folder, scratch):
    """The cases of the file tests: each is written to a folder of its own."""
    for source in sorted(folder.iterdir()):
        for number, case in enumerate(re.split(r"^--- (?=\w+ ---$)", source.read_text(), flags=re.M)[1:]):
            name, _, body = case.partition(" ---\n")
            home = pathlib.Path(scratch) / f"{source.stem}-{number}"
            home.mkdir(parents=True)
            suffix = ".json" if source.suffix == ".txt" else ".scene"
            lines, expected, part = [], [], "case" + suffix
            texts = {part: lines}
            for line in body.splitlines():
                if header := re.fullmatch(r"=== (\S.*) ===", line):
                    part, lines = header.group(1), []
                    texts[part] = lines
                elif match := EXPECTATION.match(line):
                    if part == "case" + suffix and (match.group(1) or "").startswith("E"):
                        expected.append([len(lines)])
                else:
                    lines.append(line)
            for part, content in texts.items():
                (home / part).parent.mkdir(parents=True, exist_ok=True)
                (home / part).write_bytes(unescape("".join(line + "\n" for line in content)))
            yield f"{source.name}:{name}", home / ("case" + suffix), expected


def score(program, files, lists):
    total = on_line = elsewhere = surplus = 0
    for name, path, expected in files:
        left = reported(program, path)
        lost = []
        for lines in expected:  # those with one line only come first: they have no choice
            hit = next((error for error in left if error[0] in lines), None)
            left.remove(hit) if hit else lost.append(lines)
        missed = []
        for lines in lost:
            hit = next((error for error in left if abs(error[0] - lines[0]) <= 3), None)
            left.remove(hit) if hit else missed.append(lines)
            elsewhere += hit is not None
        total += len(expected)
        on_line += len(expected) - len(lost)
        surplus += len(left)
        if lists and (lost or left):
            print(f"  {name}: lines without an error {lost}, errors too many {left}")
    missed = total - on_line - elsewhere
    share = 100 * on_line / max(total, 1)
    return f"{total:5} mistakes: {on_line} on their line ({share:.1f} %), {elsewhere} elsewhere, {missed} missed; {surplus} errors too many"


def main():
    arguments = [a for a in sys.argv[1:] if a != "--list"]
    program = arguments[0]
    root = pathlib.Path(arguments[1] if len(arguments) > 1 else pathlib.Path(__file__).parents[2] / "files")
    lists = "--list" in sys.argv
    with tempfile.TemporaryDirectory() as scratch:
        print("planted ", score(program, planted(root / "planted"), lists))
        for corpus in CORPORA:
            home = pathlib.Path(scratch) / corpus
            print(f"{corpus:8}", score(program, cases(root / corpus, home), lists))


main()
