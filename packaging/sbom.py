#!/usr/bin/env python3
"""usage: sbom.py VERSION FOLDER PACKAGE...

Writes the bill of materials of each package, sdlc, sdlc-openimageio, sdlc-static or sdlc-wasm, to
FOLDER/PACKAGE-VERSION.cdx.json, as CycloneDX 1.5: each library that it contains or links, as the table of
THIRD_PARTY.md says, with the version of the Debian package from which it was taken.
"""

import collections
import json
import pathlib
import re
import subprocess
import sys

# `debian` is a package, `terms` are in SPDX's words, `joined` has `headers`, `shared library` or `static library`
# for each of our packages that has the library.
Library = collections.namedtuple("Library", "name debian terms joined")
PACKAGES = {"sdlc", "sdlc-openimageio", "sdlc-static", "sdlc-wasm"}
OUTSIDE = "not part of the program"


def libraries():
    """The rows of THIRD_PARTY.md."""
    text = (pathlib.Path(__file__).parent.parent / "THIRD_PARTY.md").read_text()
    for row in re.findall(r"^\| (\[.*) \|$", text, re.M):
        link, _, debian, terms, _, how = row.split(" | ")
        joined = {}
        for part in how.split("; ") if how != OUTSIDE else ():
            kind, names = part.split(": ")
            joined.update((name.strip("`"), kind) for name in names.split(", "))
        if not PACKAGES.issuperset(joined):
            sys.exit(f"THIRD_PARTY.md: {link} is joined with an unknown package: {how}")
        yield Library(re.match(r"\[([^]]*)", link)[1], debian, terms.split(" (")[0], joined)


def libraries_of(package):
    return [library for library in libraries() if package in library.joined]


def installed_version(debian):
    """Of any architecture."""
    output = subprocess.run(["dpkg-query", "-W", "-f=${db:Status-Status} ${Version}\n", debian], capture_output=True, text=True)
    versions = [line.split()[1] for line in output.stdout.splitlines() if line.startswith("installed ")]
    if not versions:
        sys.exit(f"sbom.py: Debian's package {debian} is not installed, so its version is unknown")
    return versions[0]


def licence(expression):
    return {"expression": expression} if " " in expression else {"license": {"id": expression}}


def component(library):
    version = installed_version(library.debian)
    address = f"pkg:deb/debian/{library.debian}@{version}".replace("+", "%2B")
    return {"type": "library", "name": library.name, "version": version, "licenses": [licence(library.terms)], "purl": address}


def bill(package, version):
    return {
        "bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
        "metadata": {"component": {"type": "application", "name": package, "version": version,
                                   "licenses": [licence("Apache-2.0")]}},
        "components": [component(library) for library in libraries_of(package)],
    }


def write(package, version, folder):
    path = pathlib.Path(folder, f"{package}-{version}.cdx.json")
    path.write_text(json.dumps(bill(package, version), indent=2) + "\n")
    print(path)


def main():
    if len(sys.argv) < 4 or not PACKAGES.issuperset(sys.argv[3:]):
        sys.exit(__doc__)
    version, folder = sys.argv[1:3]
    for package in sys.argv[3:]:
        write(package, version, folder)


if __name__ == "__main__":
    main()
