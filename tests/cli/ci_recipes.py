"""Prints what YAML files tell others to run, a JSON object a line: {"from": …, "command": …}.

Arguments: the hooks of pre-commit, and a page of Markdown with recipes in blocks ```yaml.
"""

import json
import re
import sys

import yaml


def tell(place, command):
    print(json.dumps({"from": place, "command": command}))


def tell_hook(place, hook, hooks):
    """A hook that is configured: its own entry, or that of the repository it comes from."""
    known = hooks.get(hook["id"], {})
    entry = hook.get("entry", known.get("entry"))
    if entry is None:
        raise SystemExit(f"{place}: no hook is called {hook['id']}")
    re.compile(hook.get("files", known.get("files")))
    tell(place, " ".join([entry, *hook.get("args", []), "FILE"]))


def tell_scripts(place, node, hooks):
    """Finds what is run, however deep it stands."""
    if isinstance(node, list):
        for element in node:
            tell_scripts(place, element, hooks)
    if not isinstance(node, dict):
        return
    for key, value in node.items():
        if key == "run":
            tell(place, value)
        elif key == "script":
            for command in value:
                tell(place, command)
        elif key == "hooks":
            for hook in value:
                tell_hook(place, hook, hooks)
        else:
            tell_scripts(place, value, hooks)
    if "id" in node:  # a hook that stands alone
        tell_hook(place, node, hooks)


with open(sys.argv[1], encoding="utf-8") as file:
    hooks = {hook["id"]: hook for hook in yaml.safe_load(file)}
for name, hook in hooks.items():
    tell_hook("the hook " + name, hook, {})
with open(sys.argv[2], encoding="utf-8") as file:
    page = file.read()
for block in re.finditer(r"^```yaml\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
    line = page.count("\n", 0, block.start()) + 1
    tell_scripts(f"line {line} of the page", yaml.safe_load(block.group(1)), hooks)
