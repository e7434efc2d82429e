"""sdlc-static does what sdlc does. Arguments: the root of the repository, sdlc, sdlc-static, readelf."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT, SHARED, STATIC = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
READELF = sys.argv[4]


def run(*command, folder=ROOT):
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    return result.returncode, result.stdout, result.stderr


class StaticProgram(unittest.TestCase):
    def test_has_no_shared_libraries(self):
        self.assertIn("INTERP", run(READELF, "-lW", SHARED)[1])
        headers = run(READELF, "-lW", STATIC)[1]
        self.assertIn("LOAD", headers)
        self.assertNotIn("INTERP", headers)
        self.assertNotIn("DYNAMIC", headers)

    def test_is_the_same_version(self):
        self.assertEqual(run(STATIC, "--version"), run(SHARED, "--version"))

    def test_finds_the_same_mistakes(self):
        self.assertEqual(run(STATIC, "lint", "examples/demo.scene")[:2], (0, ""))
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "bad.scene").write_text("scene 1\nsphere a { radus: 1 }\n")
            status, output, _ = found = run(STATIC, "lint", "bad.scene", folder=folder)
            self.assertEqual(found, run(SHARED, "lint", "bad.scene", folder=folder))
        self.assertEqual(status, 1)
        self.assertIn("E104", output)

    def test_renders_the_same_bytes(self):
        for extension in ("png", "ppm"):
            pictures = []
            for program in (SHARED, STATIC):
                with tempfile.TemporaryDirectory() as folder:
                    picture = pathlib.Path(folder, f"demo.{extension}")
                    status, _, errors = run(program, "render", ROOT / "examples/demo.scene", "--width", "32",
                                            "--samples", "4", "-o", picture.name, folder=folder)
                    self.assertEqual(status, 0, errors)
                    pictures.append(picture.read_bytes())
            self.assertEqual(pictures[0], pictures[1], extension)

    def test_refuses_other_formats_and_names_a_way_out(self):
        with tempfile.TemporaryDirectory() as folder:
            status, _, errors = run(STATIC, "render", ROOT / "examples/demo.scene", "-o", "demo.exr", folder=folder)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])
        self.assertNotEqual(status, 0)
        self.assertIn("Debian packages", errors)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
