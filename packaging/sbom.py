#!/usr/bin/env python3
"""usage: sbom.py VERSION OUTPUT

Writes the bill of materials of sdlc's packages to OUTPUT, as CycloneDX 1.5: each library, with the version of the
Debian package from which it was taken. THIRD_PARTY.md says what each is for.
"""

import json
import subprocess
import sys

# Debian's package, the name and the licence (SPDX) of each library that is part of a program or module.
LIBRARIES = (
    ("libopenimageio-dev", "OpenImageIO", "BSD-3-Clause"),
    ("libpng-dev", "libpng", "libpng-2.0"),
    ("libopenexr-dev", "OpenEXR", "BSD-3-Clause"),
    ("libfmt-dev", "fmt", "MIT"),
    ("tao-pegtl-dev", "PEGTL", "MIT"),
    ("libcli11-dev", "CLI11", "BSD-3-Clause"),
    ("nlohmann-json3-dev", "JSON for Modern C++", "MIT"),
    ("libtomlplusplus-dev", "toml++", "MIT"),
    ("libhwy-dev", "Highway", "Apache-2.0"),
    ("libboost-dev", "Boost", "BSL-1.0"),
    ("zlib1g-dev", "zlib", "Zlib"),
    ("libc6-dev", "GNU C library", "LGPL-2.1-or-later"),
    ("libstdc++-12-dev", "libstdc++", "GPL-3.0-or-later WITH GCC-exception-3.1"),
)


def installed_versions():
    """The versions of Debian's packages of any architecture, by name."""
    names = [package for package, _, _ in LIBRARIES]
    output = subprocess.run(["dpkg-query", "-W", "-f=${Package}\t${Version}\n", *names], capture_output=True, text=True)
    return dict(line.split("\t") for line in output.stdout.splitlines())


def licence(expression):
    return {"expression": expression} if " " in expression else {"license": {"id": expression}}


def bill(version):
    versions = installed_versions()
    components = [
        {"type": "library", "name": name, "version": versions[package], "licenses": [licence(terms)],
         "purl": f"pkg:deb/debian/{package.replace('+', '%2B')}@{versions[package].replace('+', '%2B')}"}
        for package, name, terms in LIBRARIES if package in versions
    ]
    return {
        "bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
        "metadata": {"component": {"type": "application", "name": "sdlc", "version": version,
                                   "licenses": [licence("Apache-2.0")]}},
        "components": components,
    }


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[2], "w") as output:
        json.dump(bill(sys.argv[1]), output, indent=2)
        output.write("\n")
    print(sys.argv[2])


if __name__ == "__main__":
    main()
