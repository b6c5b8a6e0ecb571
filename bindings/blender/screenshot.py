"""Takes a picture of Blender's window with the add-on's panel, for docs/blender.md.

xvfb-run -a -s "-screen 0 1400x880x24" blender --factory-startup --window-geometry 0 0 1400 880 --enable-event-simulate
    --python screenshot.py -- ZIP MESH PICTURE

ZIP is the add-on, MESH an OBJ, gzipped or not, PICTURE the PNG to write. Steps run from a timer, so that the window draws itself
between them.
"""

import gzip
import os
import sys
import tempfile
import traceback

import bpy
import numpy as np
from mathutils import Euler

bpy.context.preferences.view.show_splash = False
archive, path, picture = sys.argv[sys.argv.index("--") + 1 :]


def load():
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    opened = gzip.open(path, "rb") if path.endswith(".gz") else open(path, "rb")
    with opened as source, tempfile.NamedTemporaryFile(suffix=".obj") as plain:
        plain.write(source.read())
        plain.flush()
        bpy.ops.wm.obj_import(filepath=plain.name)
    target = bpy.context.selected_objects[0]
    target.name = "Bunny"
    bpy.context.view_layer.objects.active = target
    target.scale = 3 * [20]
    mesh = target.data
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    for items in (mesh.vertices, mesh.edges, mesh.polygons):
        items.foreach_set("select", np.zeros(len(items), bool))
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    x, y, z = points.reshape(-1, 3).T
    mesh.vertices[int(np.argmin(np.hypot(x + 0.005, y - 0.09) - 0.1 * z))].select = True  # on the thigh
    bpy.context.view_layer.update()
    return target


def view(area):
    """The bunny as the only thing to see, with its colours."""
    space = area.spaces.active
    space.show_region_ui = True
    space.show_region_toolbar = False
    space.shading.light = "STUDIO"
    space.shading.color_type = "VERTEX"
    space.shading.show_cavity = False
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False
    space.overlay.show_cursor = space.overlay.show_outline_selected = False
    space.overlay.show_relationship_lines = space.overlay.show_object_origins = False
    place = space.region_3d
    place.view_perspective = "PERSP"
    place.view_location = 0.3, 0, 2.15
    place.view_rotation = Euler((1.35, 0, 0.25)).to_quaternion()
    place.view_distance = 5.4


def click(window, x, y):
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=kind, value=value, x=x, y=y)
        yield


def steps():
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module="taut_geodesics")
    load()
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    view(area)
    bpy.ops.taut.distance(method="EXACT")
    bpy.ops.taut.isolines(count=24, thickness=0.0002)
    lines = bpy.data.objects["Bunny isolines"]
    lines.color = 0.02, 0.02, 0.04, 1
    ink = bpy.data.materials.new("Ink")
    ink.diffuse_color = 0.02, 0.02, 0.04, 1
    lines.data.materials.append(ink)
    for _ in range(30):
        yield
    sidebar = next(region for region in area.regions if region.type == "UI")
    drawn = []
    cls = bpy.types.TAUT_PT_main
    draw = cls.draw

    def noted(self, context):
        drawn.append(True)
        draw(self, context)

    cls.draw = noted
    for down in range(20, sidebar.height, 20):  # until the tab is hit
        yield from click(window, sidebar.x + sidebar.width - 10, sidebar.y + sidebar.height - down)
        for _ in range(10):
            yield
        if drawn:
            break
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=area.x + 200, y=area.y + 200)
    for _ in range(60):
        yield
    bpy.ops.screen.screenshot(filepath=picture)
    os._exit(0)


script = steps()


def beat():
    try:
        next(script)
    except Exception:
        traceback.print_exc()
        os._exit(1)
    return 0.05


bpy.app.timers.register(beat, first_interval=1)
