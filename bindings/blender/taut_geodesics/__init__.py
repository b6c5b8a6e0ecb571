"""Geodesic distances, isolines, shortest paths and Voronoi cells in Blender, by the library Taut.

`surface` reads meshes, `work` computes without touching Blender, `results` writes, `job` runs the work on a thread of its own;
`operators` puts these together, `options` has their properties, `panel` the buttons.
"""

bl_info = {
    "name": "Taut Geodesics",
    "author": "The Taut authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Taut",
    "description": "Geodesic distances, isolines, shortest paths and Voronoi cells on any mesh",
    "category": "Mesh",
}

import bpy

from . import job, operators, options, panel

_classes = (options.Settings, *operators.classes, *panel.classes)


def register():
    for cls in _classes:
        bpy.utils.register_class(cls)
    bpy.types.Scene.taut = bpy.props.PointerProperty(type=options.Settings)


def unregister():
    job.stop()
    del bpy.types.Scene.taut
    for cls in reversed(_classes):
        bpy.utils.unregister_class(cls)
