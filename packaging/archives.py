#!/usr/bin/env python3
"""usage: archives.py PROGRAM VERSION MACHINE OUTPUT

Puts a program without shared libraries into packages: a tar file, a wheel for pip, and two packages for npm, of which
sdlc-lint depends on the one of the machine. MACHINE is as `uname -m` prints it. The same program gives the same bytes:
files have the time SOURCE_DATE_EPOCH, or that of the year 1980, the first one in a zip file.

usage: archives.py --wasm FOLDER OUTPUT

Puts the WebAssembly modules in FOLDER into a package for npm, beside its bill of materials.
"""

import base64
import gzip
import hashlib
import io
import json
import os
import pathlib
import sys
import tarfile
import time
import zipfile

sys.dont_write_bytecode = True
import sbom  # noqa: E402

HERE = pathlib.Path(__file__).parent
SUMMARY = "Compiler, linter and renderer of a scene language"
LICENCE = "Apache-2.0"
# Names of the same machine elsewhere.
NODE_MACHINES = {"x86_64": "x64", "aarch64": "arm64"}
# The licences of the C library and of libstdc++, beyond their notices.
LICENCES = ("LGPL-2.1", "GPL-3")
SHARE = pathlib.Path("/usr/share")
WHEEL_PLATFORMS = "manylinux_2_17_{0}.musllinux_1_1_{0}"


def file_time():
    return max(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), 315532800)


class Entry:
    """A file of a package."""

    def __init__(self, name, content, is_program=False):
        self.name = name
        self.content = content if isinstance(content, bytes) else content.encode()
        self.mode = 0o755 if is_program else 0o644


def own_licence():
    return Entry("LICENSE", (HERE.parent / "LICENSE").read_bytes())


def notices():
    """Of the program: the licence, the notices of what is compiled and linked in, and the licences they refer to."""
    # Those of headers are in packaging/copyright.
    linked = [library.debian for library in sbom.libraries_of("sdlc-static")
              if library.joined["sdlc-static"] == "static library"]
    files = {
        "notices/sdlc": HERE / "copyright",
        **{f"notices/{name}": SHARE / "doc" / name / "copyright" for name in linked},
        **{f"notices/{name}": SHARE / "common-licenses" / name for name in LICENCES},
    }
    return [own_licence(), *(Entry(name, path.read_bytes()) for name, path in files.items())]


def readme():
    return Entry("README.md", (HERE / "README.md").read_bytes())


def write_tar(path, folder, entries):
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for entry in entries:
            info = tarfile.TarInfo(f"{folder}/{entry.name}")
            info.size, info.mode, info.mtime = len(entry.content), entry.mode, file_time()
            tar.addfile(info, io.BytesIO(entry.content))
    path.write_bytes(gzip.compress(packed.getvalue(), mtime=0))
    print(path)


def write_wheel(path, entries, version):
    record = f"sdlc-{version}.dist-info/RECORD"
    lines = []
    for entry in entries:
        digest = base64.urlsafe_b64encode(hashlib.sha256(entry.content).digest()).rstrip(b"=").decode()
        lines.append(f"{entry.name},sha256={digest},{len(entry.content)}\n")
    lines.append(f"{record},,\n")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for entry in [*entries, Entry(record, "".join(lines))]:
            info = zipfile.ZipInfo(entry.name, time.gmtime(file_time())[:6])
            info.external_attr = (0o100000 | entry.mode) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(info, entry.content)
    print(path)


def wheel(program, version, machine, output):
    platforms = WHEEL_PLATFORMS.format(machine)
    tags = "".join(f"Tag: py3-none-{platform}\n" for platform in platforms.split("."))
    about = f"sdlc-{version}.dist-info"
    metadata = f"Metadata-Version: 2.1\nName: sdlc\nVersion: {version}\nSummary: {SUMMARY}\nLicense: {LICENCE}\n" \
        "Requires-Python: >=3.7\nDescription-Content-Type: text/markdown\n\n"
    entries = [
        Entry(f"sdlc-{version}.data/scripts/sdlc", program, is_program=True),
        Entry(f"{about}/METADATA", metadata.encode() + readme().content),
        Entry(f"{about}/WHEEL", f"Wheel-Version: 1.0\nGenerator: sdlc\nRoot-Is-Purelib: false\n{tags}"),
    ]
    entries += [Entry(f"{about}/licenses/{entry.name}", entry.content) for entry in notices()]
    write_wheel(output / f"sdlc-{version}-py3-none-{platforms}.whl", entries, version)


def npm(program, version, machine, output):
    node_machine = NODE_MACHINES[machine]

    def package(about, file, entries):
        manifest = {"version": version, "license": LICENCE, **about}
        entries = [Entry("package.json", json.dumps(manifest, indent=2) + "\n"), *entries, readme()]
        write_tar(output / f"{file}-{version}.tgz", "package", entries)

    package(
        {"name": f"@sdlc/linux-{node_machine}", "description": f"{SUMMARY}: the program for Linux",
         "os": ["linux"], "cpu": [node_machine]},
        f"sdlc-linux-{node_machine}", [Entry("bin/sdlc", program, is_program=True), *notices()])
    package(
        {"name": "sdlc-lint", "description": SUMMARY, "bin": {"sdlc-lint": "lint.js", "sdlc": "sdlc.js"},
         "engines": {"node": ">=14"},
         "optionalDependencies": {f"@sdlc/linux-{known}": version for known in NODE_MACHINES.values()}},
        "sdlc-lint",
        [own_licence(), *(Entry(name, (HERE / "npm" / name).read_bytes(), name != "run.js")
                          for name in ("lint.js", "run.js", "sdlc.js"))])


def wasm(folder, output):
    manifest = json.loads((folder / "package.json").read_text())
    names = ["package.json", "README.md", *manifest["files"]]
    write_tar(output / f"sdlc-wasm-{manifest['version']}.tgz", "package",
              [*(Entry(name, (folder / name).read_bytes()) for name in names), own_licence()])
    sbom.write("sdlc-wasm", manifest["version"], output)


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--wasm":
        return wasm(*map(pathlib.Path, sys.argv[2:]))
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    program = pathlib.Path(sys.argv[1]).read_bytes()
    version, machine = sys.argv[2:4]
    output = pathlib.Path(sys.argv[4])
    if machine not in NODE_MACHINES:
        sys.exit(f"archives.py: unknown machine {machine}")
    output.mkdir(parents=True, exist_ok=True)
    container = Entry("Containerfile", (HERE / "Containerfile").read_bytes())
    write_tar(output / f"sdlc-{version}-linux-{machine}.tar.gz", f"sdlc-{version}",
              [Entry("bin/sdlc", program, is_program=True), readme(), container, *notices()])
    wheel(program, version, machine, output)
    npm(program, version, machine, output)


if __name__ == "__main__":
    main()
