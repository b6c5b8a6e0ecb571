"""Renders the pictures of docs/blender.md by the add-on's own operators and Cycles.

gallery.py ZIP MESH FOLDER [SAMPLES]

Runs in a Python that has the module bpy 4.2 or newer, whose Cycles has a denoiser (Debian's Blender has none). ZIP is the add-on,
MESH the Stanford bunny as OBJ, gzipped or not. Writes FOLDER/blender_isolines.png,
blender_path.png and blender_voronoi.png, 1200x900; docs/gallery has them scaled to 960x720.
"""

import gzip
import math
import os
import pathlib
import sys
import tempfile

os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp()  # nothing of the user's, and nothing is left there

import bpy
import numpy as np
from mathutils import Vector

HEIGHT = 2.0  # of the bunny on the stage
INK = (0.012, 0.010, 0.028)


def read(path):
    """The mesh on the stage, standing on the floor: vertices that no face uses are left out, as they fall far off."""
    opened = gzip.open(path, "rb") if path.endswith(".gz") else open(path, "rb")
    with opened as source, tempfile.NamedTemporaryFile(suffix=".obj") as plain:
        plain.write(source.read())
        plain.flush()
        bpy.ops.wm.obj_import(filepath=plain.name, forward_axis="NEGATIVE_Z", up_axis="Y")
    target = bpy.context.selected_objects[0]
    bpy.context.view_layer.objects.active = target
    bpy.ops.object.transform_apply()
    mesh = target.data
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    points = points.reshape(-1, 3)
    low, high = points[corners].min(axis=0), points[corners].max(axis=0)
    points = (points - [*(low + high)[:2] / 2, low[2]]) * (HEIGHT / (high - low)[2])
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    mesh.update()
    target.name = "Bunny"
    return target, points


def stage(samples):
    """Floor, lights, camera."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = True
    scene.cycles.max_bounces = 6
    scene.render.resolution_x, scene.render.resolution_y = 1200, 900
    scene.render.dither_intensity = 0  # which would make the files three times as large
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.compression = 100
    scene.view_settings.view_transform = "Standard"
    world = scene.world = bpy.data.worlds.new("Studio")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = 0.86, 0.90, 1, 1
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.42
    floor()
    light("Key", (-3.2, -4.0, 5.2), 3.0, 330, (1, 0.95, 0.88))
    light("Rim", (3.0, 2.2, 4.6), 1.5, 120, (0.85, 0.92, 1))
    light("Fill", (4.5, -4.5, 1.8), 4.0, 60, (0.95, 0.97, 1))
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.lens = 80
    camera.location = 0.6, -7.6, 2.3
    camera.rotation_euler = (Vector((0, 0, 0.93)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera


def floor():
    """A sheet that bends up behind, so that there is no horizon."""
    x = np.array([-20.0, 20.0])
    angles = np.linspace(0, math.pi / 2, 24)
    profile = [(-20, 0), *zip(5 + 4 * np.sin(angles), 4 - 4 * np.cos(angles)), (9, 20)]
    points = [(side, y, z) for y, z in profile for side in x]
    faces = [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(len(profile) - 1)]
    mesh = bpy.data.meshes.new("Floor")
    mesh.from_pydata(points, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    mesh.materials.append(plain("Floor", (0.80, 0.80, 0.82), 0.6))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Floor", mesh))


def light(name, place, size, watts, colour):
    data = bpy.data.lights.new(name, "AREA")
    data.size, data.energy, data.color = size, watts, colour
    lamp = bpy.data.objects.new(name, data)
    lamp.location = place
    lamp.rotation_euler = (Vector((0, 0, 0.8)) - lamp.location).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(lamp)


def plain(name, colour, roughness):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    surface = material.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = *colour, 1
    surface.inputs["Roughness"].default_value = roughness
    return material


def select(mesh, vertices):
    for items in (mesh.vertices, mesh.edges, mesh.polygons):
        items.foreach_set("select", np.zeros(len(items), bool))
    for vertex in vertices:
        mesh.vertices[vertex].select = True


def seen(points, x, z):
    """The vertex that the camera sees near this place, if the bunny is seen from the front."""
    return int(np.nanargmin(np.hypot(points[:, 0] - x, points[:, 2] - z) + 0.1 * points[:, 1]))


def ball(place, radius, material):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, location=place, segments=48, ring_count=24)
    made = bpy.context.object
    made.data.polygons.foreach_set("use_smooth", np.ones(len(made.data.polygons), bool))
    made.data.materials.append(material)
    return made


def render(path):
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    print(path)


def clear(target, made):
    """Takes away what a picture has added."""
    for thing in made:
        bpy.data.objects.remove(thing)
    target.data.materials.clear()
    bpy.context.view_layer.objects.active = target


def isolines(target, points, ink):
    source = seen(points, 0.15, 0.75)
    select(target.data, [source])
    bpy.ops.taut.distance(material=True)
    bpy.ops.taut.isolines(count=28, thickness=0.0045)
    lines = bpy.data.objects["Bunny isolines"]
    lines.data.materials.append(ink)
    return [lines, ball(points[source], 0.035, ink)]


def path(target, points, ink):
    ends = [seen(points, *place) for place in ((-0.85, 1.12), (0.88, 0.4))]
    select(target.data, ends)
    target.data.materials.append(plain("Clay", (0.62, 0.56, 0.50), 0.55))
    bpy.ops.taut.path(thickness=0.016)
    line = bpy.data.objects["Bunny path"]
    red = plain("Red", (0.70, 0.035, 0.05), 0.35)
    line.data.materials.append(red)
    return [line, *(ball(points[v], 0.045, red) for v in ends)]


def voronoi(target, points, ink):
    select(target.data, [seen(points, 0.15, 0.75)])
    bpy.ops.taut.spread(points=24)
    seeds = [v.index for v in target.data.vertices if v.select]
    bpy.ops.taut.voronoi(method="EXACT")
    return [ball(points[v], 0.022, ink) for v in seeds]


def main(archive, mesh, folder, samples=96):
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
    stage(int(samples))
    target, points = read(mesh)
    ink = plain("Ink", INK, 0.4)
    for draw in (isolines, path, voronoi):
        made = draw(target, points, ink)
        render(pathlib.Path(folder) / f"blender_{draw.__name__}.png")
        clear(target, made)


main(*sys.argv[1:])
sys.stdout.flush()
os._exit(0)  # the module bpy may wait for ever where Python ends by itself
