"""Writes the spheres, point lights and camera of a Blender file as a scene of sdlc.

    blender -b balls.blend -P export_spheres.py -- balls.scene

A mesh is a sphere if all its vertices have one distance from their mean, and its faces are near that sphere: UV
spheres, and ico spheres of two or more subdivisions. Other objects are left out, with a message.
"""

import math
import sys

import bpy


def point(v):
    """A position or direction: z is up in Blender, y in sdlc."""
    return f"({v[0]:.7g}, {v[2]:.7g}, {0 - v[1]:.7g})"


def color(values, factor=1.0):
    return "linear({:.6g}, {:.6g}, {:.6g})".format(*(factor * value for value in values[:3]))


def sphere_of(obj, mesh):
    """Centre and radius in the world, or None."""
    vertices = [obj.matrix_world @ vertex.co for vertex in mesh.vertices]
    faces = [obj.matrix_world @ polygon.center for polygon in mesh.polygons]
    if not vertices or not faces:
        return None
    center = sum(vertices[1:], vertices[0]) / len(vertices)
    radius = max((vertex - center).length for vertex in vertices)
    is_round = min((vertex - center).length for vertex in vertices) > 0.999 * radius
    is_fine = min((face - center).length for face in faces) > 0.9 * radius
    return (center, radius) if is_round and is_fine else None


def material_of(obj):
    """The nearest material of sdlc; textures are ignored."""
    material = obj.active_material
    if material is None:
        return "diffuse(color: linear(0.8, 0.8, 0.8))"
    links = material.use_nodes and material.node_tree.get_output_node("ALL").inputs["Surface"].links
    if not links:
        return f"diffuse(color: {color(material.diffuse_color)})"
    node = links[0].from_node
    value = {socket.name: getattr(socket, "default_value", None) for socket in node.inputs}
    tint = color(value.get("Base Color") or value.get("Color"))
    # Blender 4 renamed some inputs.
    transmission = value.get("Transmission Weight", value.get("Transmission", 0))
    if node.type == "EMISSION":
        return f"emissive(color: {tint}, intensity: {value['Strength']:.6g})"
    if node.type == "BSDF_GLASS" or transmission > 0.5:
        return f"transmissive(color: {tint}, ior: {value['IOR']:.6g}, fresnel: exact)"
    if node.type == "BSDF_GLOSSY" or value.get("Metallic", 0) > 0.5:
        return f"specular(color: {tint}, fuzz: {value['Roughness'] ** 2:.6g})"
    return f"diffuse(color: {tint})"


def light_of(light):
    """The material of a sphere that gives the light of a point light."""
    radius = light.shadow_soft_size
    return f"emissive(color: {color(light.color, light.energy / (2 * math.pi * radius) ** 2)})"


def camera_of(scene):
    camera = scene.camera
    axes = camera.matrix_world.to_3x3()
    place = camera.matrix_world.translation
    corner = camera.data.view_frame(scene=scene)[0]
    fov = 2 * math.degrees(math.atan(abs(corner.y / corner.z)))
    lens = ""
    dof = camera.data.dof
    if dof.use_dof:
        focus = point(dof.focus_object.matrix_world.translation) if dof.focus_object else f"{dof.focus_distance:.7g}"
        lens = f", aperture: {camera.data.lens / dof.aperture_fstop:.7g}mm, focus: {focus}"
    at, up = place - axes.col[2], axes.col[1]
    return f"camera main {{ from: {point(place)}, at: {point(at)}, up: {point(up)}, fov: {fov:.7g}deg{lens} }}"


def background_of(world):
    for node in world.node_tree.nodes if world and world.use_nodes else []:
        if node.type == "BACKGROUND":
            return color(node.inputs["Color"].default_value, node.inputs["Strength"].default_value)
    return color(world.color) if world else "black"


def scene_text(scene, graph):
    percentage = scene.render.resolution_percentage / 100
    width, height = (int(size * percentage) for size in (scene.render.resolution_x, scene.render.resolution_y))
    lines = ["scene 1", camera_of(scene), f"background {{ color: {background_of(scene.world)} }}",
             f"render {{ width: {width}, height: {height}, tone: neutral }}"]
    for obj in scene.objects:
        sphere, material = None, None
        if obj.hide_render or obj.type == "CAMERA":
            continue
        if obj.type == "MESH":
            sphere, material = sphere_of(obj, obj.evaluated_get(graph).to_mesh()), material_of(obj)
        elif obj.type == "LIGHT" and obj.data.type == "POINT" and obj.data.shadow_soft_size > 0:
            sphere, material = (obj.matrix_world.translation, obj.data.shadow_soft_size), light_of(obj.data)
        if sphere is None:
            print(f"left out: {obj.name} is not a sphere")
        else:
            lines.append(f"// {obj.name}")
            lines.append(f"sphere {{ center: {point(sphere[0])}, radius: {sphere[1]:.7g}, material: {material} }}")
    return "\n".join(lines) + "\n"


with open(sys.argv[-1], "w", encoding="utf-8") as file:
    file.write(scene_text(bpy.context.scene, bpy.context.evaluated_depsgraph_get()))
