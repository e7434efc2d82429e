"""Exports a scene of Blender with docs/blender/export_spheres.py: the result is the scene that Blender has, and has no
findings. Skipped if Blender is not installed. Arguments: the program, the script."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
# To Blender's own scene, which has a cube, a point light of 1000 W and a camera with a lens of 50 mm.
ADDITIONS = """
import bpy
bpy.ops.mesh.primitive_uv_sphere_add(radius=2, location=(1, 2, 3))
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, radius=0.5, location=(-1, 1, 0.5))
bpy.ops.mesh.primitive_cylinder_add()
dof = bpy.context.scene.camera.data.dof
dof.use_dof, dof.aperture_fstop, dof.focus_distance = True, 2, 8
"""
EXPECTED = ["(1, 3, -2), radius: 2", "(-1, 0.5, -1), radius: 0.5", "radius: 0.1, material: emissive", "fov: 22.895",
            "aperture: 25mm", "focus: 8"]


def rounded(text):
    """With numbers of five digits: Blender computes in single precision."""
    def short(number):
        return f"{round(float(number[0]), 3):.5g}"
    return re.sub(r"-?\d+(\.\d+)?(e-?\d+)?", short, text)


def main(program, script):
    if not shutil.which("blender"):
        print("skipped: blender is not installed")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        scene = pathlib.Path(name) / "balls.scene"
        blender = subprocess.run(["blender", "-b", "--factory-startup", "--python-expr", ADDITIONS, "-P", script,
                                  "--python-exit-code", "1", "--", scene], capture_output=True, text=True)
        if not scene.is_file():
            print(blender.stdout, blender.stderr)
            return 1
        text = scene.read_text(encoding="utf-8")
        missing = [part for part in EXPECTED if rounded(part) not in rounded(text)]
        missing += [f"left out: {name}" for name in ("Cube", "Cylinder") if f"left out: {name} " not in blender.stdout]
        lint = subprocess.run([program, "lint", scene], capture_output=True, text=True)
        print(text, lint.stdout, *missing, sep="\n")
        return 1 if missing or lint.returncode != 0 else 0


sys.exit(main(*sys.argv[1:]))
