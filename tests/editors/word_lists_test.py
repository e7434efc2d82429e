"""Compares the keywords in the files for Kate and Emacs with those of the grammar, words.json, which other tests compare
with the program. Argument: the folder `editors`."""

import json
import pathlib
import re
import sys

editors = pathlib.Path(sys.argv[1])
words = json.loads((editors / "tree-sitter-sdlc/words.json").read_text(encoding="utf-8"))
keywords = {*words["reserved"], *words["contextual"]}

kate = (editors / "kate/scene.xml").read_text(encoding="utf-8")
emacs = (editors / "emacs/sdlc-mode.el").read_text(encoding="utf-8")
lists = {
    "kate/scene.xml": re.findall(r"<item>(\w+)</item>", kate),
    "emacs/sdlc-mode.el": re.findall(r'"(\w+)"', emacs[emacs.index("regexp-opt") : emacs.index("font-lock-keyword-face")])
    + re.search(r"\(\?:(true\\\\\|false)", emacs).group(1).split("\\\\|"),
}
failures = 0
for name, found in lists.items():
    for problem, these in (("lacks", keywords - set(found)), ("has the unknown", set(found) - keywords)):
        if these:
            failures += 1
            print(f"{name} {problem} {', '.join(sorted(these))}")
sys.exit(1 if failures else 0)
