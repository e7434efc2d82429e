"""What packaging/ writes, and what installs it in CI. Arguments: the root of the repository, its version, and for the
test of what programs link: readelf, sdlc, and its modules. The program in these packages is a script that prints its
arguments and ends with status 3."""

import base64
import csv
import hashlib
import io
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

ROOT, VERSION = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "packaging"))
import sbom  # noqa: E402

PROGRAM = '#!/bin/sh\nprintf "<%s>" "$@"\nexit 3\n'
needs_node = unittest.skipUnless(shutil.which("node"), "there is no Node.js")


@unittest.skipUnless(pathlib.Path("/usr/share/doc/libpng-dev/copyright").exists(), "the libraries are not Debian's")
class Packages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def pack(self, folder, time="1700000000", program=PROGRAM, machine="x86_64"):
        """Returns the folder of the packages."""
        output = self.folder / folder
        output.mkdir()
        (output / "program").write_text(program)
        command = [sys.executable, ROOT / "packaging/archives.py", output / "program", VERSION, machine, output]
        subprocess.run(command, env={**os.environ, "SOURCE_DATE_EPOCH": time}, check=True, stdout=subprocess.DEVNULL)
        (output / "program").unlink()
        return output

    def install(self, packages, folder="installed"):
        """Puts the npm packages where npm would; returns the folder of sdlc-lint."""
        modules = self.folder / folder / "node_modules"
        for archive in sorted(packages.glob("*.tgz")):
            with tarfile.open(archive) as tar:
                name = json.load(tar.extractfile("package/package.json"))["name"]
                tar.extractall(modules / "new")
            (modules / name).parent.mkdir(exist_ok=True)
            (modules / "new/package").rename(modules / name)
        return modules / "sdlc-lint"

    def run_node(self, script, *arguments):
        return subprocess.run(["node", script, *arguments], capture_output=True, text=True)

    def test_the_same_program_gives_the_same_bytes(self):
        first, second = self.pack("first"), self.pack("second")
        names = sorted(path.name for path in first.iterdir())
        self.assertEqual(len(names), 4)
        for name in names:
            self.assertEqual((first / name).read_bytes(), (second / name).read_bytes(), name)

    def test_the_record_of_the_wheel_has_every_file(self):
        (wheel,) = self.pack("packages").glob("*.whl")
        with zipfile.ZipFile(wheel) as files:
            names = files.namelist()
            record = f"sdlc-{VERSION}.dist-info/RECORD"
            rows = list(csv.reader(io.StringIO(files.read(record).decode())))
            self.assertEqual([row[0] for row in rows], names)
            for name, digest, size in rows:
                if name == record:
                    continue
                content = files.read(name)
                expected = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
                self.assertEqual((digest, size), (f"sha256={expected}", str(len(content))))
            program = files.getinfo(f"sdlc-{VERSION}.data/scripts/sdlc")
            self.assertEqual(program.external_attr >> 16, 0o100755)
            self.assertEqual(files.read(program).decode(), PROGRAM)

    def contents(self, package):
        """The files of a package, by their names below its folder."""
        if package.suffix == ".whl":
            with zipfile.ZipFile(package) as files:
                return {name.partition("/")[2]: files.read(name) for name in files.namelist()}
        with tarfile.open(package) as tar:
            return {name.partition("/")[2]: tar.extractfile(name).read() for name in tar.getnames()}

    def test_each_package_has_the_licences_of_what_it_contains(self):
        texts = {"LICENSE": "Apache License", "notices/sdlc": "cmake --build b --target sdlc_static",
                 "notices/libpng-dev": "PNG", "notices/zlib1g-dev": "zlib", "notices/libc6-dev": "GNU C Library",
                 "notices/libstdc++-12-dev": "GCC RUNTIME LIBRARY EXCEPTION",
                 "notices/LGPL-2.1": "GNU LESSER GENERAL PUBLIC LICENSE", "notices/GPL-3": "GNU GENERAL PUBLIC LICENSE"}
        for package in self.pack("packages").iterdir():
            folder = "licenses/" if package.suffix == ".whl" else ""
            files = self.contents(package)
            if package.name.startswith("sdlc-lint"):
                self.assertFalse([name for name in files if "notices" in name])
                continue
            found = {name.removeprefix(folder) for name in files if re.search("^(licenses/)?(LICENSE|notices/)", name)}
            self.assertEqual(found, set(texts), package.name)
            for name, text in texts.items():
                self.assertIn(text, files[folder + name].decode(), f"{package.name} {name}")

    @unittest.skipUnless(pathlib.Path("/usr/share/doc/libc++-16-dev/copyright").exists() and shutil.which("em++"),
                         "emscripten or libc++-16-dev is not installed")
    def test_the_webassembly_modules_have_a_bill(self):
        folder, output = self.folder / "built", self.folder / "packages"
        folder.mkdir()
        output.mkdir()
        manifest = (ROOT / "wasm/package.json.in").read_text().replace("@PROJECT_VERSION@", VERSION)
        names = ["README.md", *json.loads(manifest)["files"]]
        for name in names:
            (folder / name).write_text(name)
        (folder / "package.json").write_text(manifest)
        subprocess.run([sys.executable, ROOT / "packaging/archives.py", "--wasm", folder, output], check=True,
                       stdout=subprocess.DEVNULL)
        files = self.contents(output / f"sdlc-wasm-{VERSION}.tgz")
        self.assertEqual(set(files), {"package.json", "LICENSE", *names})
        self.assertEqual(files["sdlc.wasm"], b"sdlc.wasm")
        bill = json.loads((output / f"sdlc-wasm-{VERSION}.cdx.json").read_text())
        names = {component["name"] for component in bill["components"]}
        self.assertLessEqual({"libc++", "fast_float", "PEGTL"}, names)
        self.assertNotIn("zlib", names)

    def test_the_container_is_the_unpacked_tar_file(self):
        (archive,) = self.pack("packages").glob("*.tar.gz")
        files = self.contents(archive)
        steps = files["Containerfile"].decode()
        self.assertRegex(steps, r"(?m)^FROM scratch\nCOPY \. /$")
        (program,) = re.findall(r'^ENTRYPOINT \["/(.*)"\]$', steps, re.M)
        self.assertEqual(files[program].decode(), PROGRAM)

    @needs_node
    def test_sdlc_lint_is_the_command_lint(self):
        lint = self.install(self.pack("packages", machine=os.uname().machine))
        result = self.run_node(lint / "lint.js", "a b", "--fix", "")
        self.assertEqual((result.stdout, result.returncode), ("<lint><a b><--fix><>", 3))
        result = self.run_node(lint / "sdlc.js", "explain", "E104")
        self.assertEqual((result.stdout, result.returncode), ("<explain><E104>", 3))

    @needs_node
    def test_a_program_that_is_killed_kills_its_caller(self):
        packages = self.pack("packages", program="#!/bin/sh\nkill -TERM $$\n", machine=os.uname().machine)
        self.assertEqual(self.run_node(self.install(packages) / "lint.js").returncode, -signal.SIGTERM)

    @needs_node
    def test_a_missing_program_is_an_error_with_a_way_out(self):
        lint = self.install(self.pack("packages", machine=os.uname().machine))
        shutil.rmtree(lint.parent / "@sdlc")
        result = self.run_node(lint / "lint.js", "scenes")
        self.assertEqual(result.returncode, 2)
        self.assertIn("install it too", result.stderr)


class ContinuousIntegration(unittest.TestCase):
    """The action for GitHub and the template for GitLab, with an npx that prints its arguments."""

    def run_script(self, script, shell="bash", **variables):
        with tempfile.TemporaryDirectory() as folder:
            npx = pathlib.Path(folder, "npx")
            npx.write_text(PROGRAM)
            npx.chmod(0o755)
            environment = {**os.environ, **variables, "PATH": f"{folder}:{os.environ['PATH']}"}
            result = subprocess.run([shell, "-ec", script], env=environment, cwd=folder,
                                    capture_output=True, text=True)
            report = pathlib.Path(folder, "gl-code-quality-report.json")
            return result.stdout + (report.read_text() if report.exists() else ""), result.returncode

    def read(self, name):
        try:
            import yaml
        except ImportError:
            self.skipTest("there is no python3-yaml")
        return list(yaml.safe_load_all((ROOT / name).read_text()))

    # What a user gives as paths, and what the linter gets: words are separated by spaces and lines, and no patterns.
    paths = {"a b/c": "<a><b/c>", "\na b/c\n$(exit)\n": "<a><b/c><$(exit)>", "a\t* \"b c\" -d": '<a><*><"b><c"><-d>'}

    def test_the_action_lints_the_paths(self):
        (action,) = self.read("action.yml")
        (step,) = action["runs"]["steps"]
        version = action["inputs"]["version"]["default"]
        for paths, expected in self.paths.items():
            output, status = self.run_script(step["run"], PATHS=paths, VERSION=version)
            self.assertEqual(output, f"<--yes><sdlc-lint@{VERSION}><--format><github><-->{expected}")
            self.assertEqual(status, 3)
        self.assertEqual(self.run_script(step["run"], PATHS=" \n", VERSION=version), ("", 2))
        self.assertEqual(step["env"], {"PATHS": "${{ inputs.paths }}", "VERSION": "${{ inputs.version }}"})

    def test_the_template_lints_the_same_paths_and_writes_a_report(self):
        spec, jobs = self.read("templates/lint.yml")
        job = jobs["sdlc-lint"]
        script, version = "\n".join(job["script"]), spec["spec"]["inputs"]["version"]["default"]
        for paths, expected in self.paths.items():
            for shell in ("bash", "sh"):
                output, status = self.run_script(script, shell, SDLC_PATHS=paths, SDLC_VERSION=version)
                self.assertEqual(output, f"<--yes><sdlc-lint@{VERSION}><--format><gitlab><-->{expected}")
                self.assertEqual(status, 3)
        self.assertEqual(self.run_script(script, SDLC_PATHS="", SDLC_VERSION=version), ("", 2))
        self.assertEqual(job["artifacts"]["reports"]["codequality"], "gl-code-quality-report.json")


class Files(unittest.TestCase):
    """What packaging/files.sh puts beside the program, for which `echo` stands."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def put(self, root, name):
        """Returns the folder of the documentation."""
        command = [root / "packaging/files.sh", VERSION, "1", "a <a@b>", self.folder / name, "echo"]
        subprocess.run(command, check=True)
        return self.folder / name / "sdlc/doc/sdlc"

    def test_no_link_leads_to_what_is_left_out(self):
        documentation = self.put(ROOT, "files")
        pages = sorted(documentation.rglob("*.md"))
        self.assertGreater(len(pages), 50)
        links = [(page, link) for page in pages
                 for link in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", page.read_text())]
        self.assertGreater(len(links), 100)
        dead = [f"{page}: {link}" for page, link in links if not (page.parent / link).exists()]
        self.assertEqual(dead, [])

    @unittest.skipUnless(shutil.which("git"), "there is no git")
    def test_a_checkout_gives_what_git_has_and_other_sources_give_all(self):
        root = self.folder / "root"
        for name in ("packaging/files.sh", "packaging/copyright", "packaging/sdlc.xml", "packaging/sdlc.desktop",
                     "CHANGELOG.md", "editors/vscode/icons/scene-light.svg", "docs/lint.md", "examples/demo.scene"):
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, root / name)
        git = ["git", "-C", root]
        subprocess.run([*git, "init", "-q"], check=True)
        subprocess.run([*git, "add", "."], check=True)
        (root / "examples/mine.scene").write_text("scene 1\n")
        self.assertFalse((self.put(root, "first") / "examples/mine.scene").exists())
        self.assertTrue((self.put(root, "first") / "examples/demo.scene").exists())
        shutil.rmtree(root / ".git")
        self.assertTrue((self.put(root, "second") / "examples/mine.scene").exists())


class BillOfMaterials(unittest.TestCase):
    @unittest.skipUnless(shutil.which("dpkg-query"), "the libraries are not Debian's")
    def test_has_the_libraries_of_the_package(self):
        with tempfile.TemporaryDirectory() as folder:
            # What the others need may be missing.
            packages = sbom.PACKAGES - {"sdlc-wasm"}
            subprocess.run([sys.executable, ROOT / "packaging/sbom.py", VERSION, folder, *packages], check=True,
                           stdout=subprocess.DEVNULL)
            found = {}
            for package in packages:
                bill = json.loads(pathlib.Path(folder, f"{package}-{VERSION}.cdx.json").read_text())
                self.assertEqual(bill["metadata"]["component"]["name"], package)
                found[package] = {component["name"]: component for component in bill["components"]}
        system = {"libstdc++", "GNU C library"}
        self.assertEqual(set(found["sdlc-openimageio"]), system | {"OpenImageIO"})
        self.assertEqual(set(found["sdlc"]) - set(found["sdlc-static"]), {"OpenEXR", "Imath"})
        self.assertLessEqual(system | {"libpng", "fmt", "Boost"}, set(found["sdlc-static"]))
        library = found["sdlc-static"]["libstdc++"]
        self.assertEqual(library["licenses"], [{"expression": "GPL-3.0-or-later WITH GCC-exception-3.1"}])
        self.assertRegex(library["purl"], r"^pkg:deb/debian/libstdc%2B%2B-12-dev@12\.")
        self.assertEqual(found["sdlc"]["Boost"]["licenses"], [{"license": {"id": "BSL-1.0"}}])

    @unittest.skipUnless(shutil.which("dpkg-query"), "the libraries are not Debian's")
    def test_a_library_of_unknown_version_is_an_error(self):
        with self.assertRaisesRegex(SystemExit, "libnothing-dev is not installed"):
            sbom.installed_version("libnothing-dev")

    @unittest.skipUnless(sys.argv[3:], "there are no programs")
    def test_names_the_shared_libraries_of_programs_and_modules(self):
        readelf, program, *modules = sys.argv[3:]
        files = {"sdlc": [program, *(module for module in modules if "openimageio" not in module)],
                 "sdlc-openimageio": [module for module in modules if "openimageio" in module]}

        def source(package):
            query = ["dpkg-query", "-W", "-f=${source:Package}\n", package]
            return subprocess.run(query, check=True, capture_output=True, text=True).stdout.split()[0]

        for package, paths in files.items():
            headers = subprocess.run([readelf, "-dW", *paths], check=True, capture_output=True, text=True).stdout
            names = set(re.findall(r"\(NEEDED\).*\[(.*)\]", headers))
            owners = subprocess.run(["dpkg-query", "-S", *(f"*/{name}" for name in names)], check=True,
                                    capture_output=True, text=True).stdout
            linked = {source(owner) for owner in re.findall(r"^([^:,]+).*: /(?:usr/)?lib", owners, re.M)}
            known = {source(library.debian) for library in sbom.libraries_of(package)
                     if library.joined[package] == "shared library"}
            self.assertEqual(linked, known, package)

    def test_the_copyright_file_has_the_notices_of_headers(self):
        stanzas = re.findall(r"^Files: (\S+-dev)\nCopyright: .*\nLicense: (.*)$",
                             (ROOT / "packaging/copyright").read_text(), re.M)
        headers = {library.debian: library.terms for library in sbom.libraries() if "headers" in library.joined.values()}
        self.assertEqual({name: terms.lower() for name, terms in stanzas},
                         {name: terms.lower() for name, terms in headers.items()})


    def test_the_webassembly_modules_have_their_notices(self):
        notices = (ROOT / "wasm/THIRD_PARTY.md").read_text()
        libraries = [library.name for library in sbom.libraries_of("sdlc-wasm")]
        self.assertIn("libc++", libraries)
        self.assertEqual([name for name in libraries if name not in notices], [])


class Versions(unittest.TestCase):
    def test_what_names_a_version_names_this_one(self):
        number = re.compile(r"(?:sdlc(?:-lint)?(?:@|==)v?|sdlc[-_]|sdlc/lint@v|rev: v|default: )(\d+\.\d+\.\d+)")
        for name in ("action.yml", "templates/lint.yml", "docs/ci.md", "docs/farm.md", "docs/install.md"):
            found = number.findall((ROOT / name).read_text())
            self.assertTrue(found, name)
            self.assertEqual(set(found), {VERSION}, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
