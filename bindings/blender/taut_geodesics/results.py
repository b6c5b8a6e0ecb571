"""Writes results into Blender: attributes, vertex groups, colours, materials, curves, selections. Main thread, object mode."""

import bpy
import numpy as np

from . import palette
from .surface import Problem


def check_writable(target):
    """Refuses a mesh that belongs to another file."""
    if target.library or target.data.library:
        raise Problem(f"{target.name} is linked from another file; make it local")


def check_attribute(mesh, name, kind):
    """Refuses a name that is empty or that another kind of attribute has."""
    if not name:
        raise Problem("the attribute has no name")
    found = mesh.attributes.get(name)
    if found is not None and (found.data_type, found.domain) != (kind, "POINT"):
        check_free(mesh, name)


def check_free(mesh, name):
    """Refuses a name that an attribute has."""
    if name in mesh.attributes:
        raise Problem(f"{mesh.name} already has an attribute {name} of another kind; choose another name")


def _attribute(attributes, name, kind):
    found = attributes.get(name) or attributes.new(name, kind, "POINT")
    if found.name != name:
        attributes.remove(found)
        raise Problem(f"the name {name} is taken; choose another name")
    return found


def copy_of_evaluated(context, target, check):
    """A new object in the place of `target`: its mesh as modifiers make it, unless `check` refuses that.

    What is active and selected stays so.
    """
    graph = context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(target.evaluated_get(graph), preserve_all_data_layers=True, depsgraph=graph)
    try:
        check(mesh)
    except Problem:
        bpy.data.meshes.remove(mesh)
        raise
    mesh.name = f"{target.name} evaluated"
    copy = bpy.data.objects.new(mesh.name, mesh)
    copy.matrix_world = target.matrix_world
    _link(context, target, copy)
    return copy


def _link(context, target, new):
    home = target.users_collection
    (home[0] if home else context.collection).objects.link(new)


def write_values(mesh, name, kind, values):
    """An attribute of a number at each vertex; `kind` is FLOAT or INT."""
    _attribute(mesh.attributes, name, kind).data.foreach_set("value", values)
    mesh.update()


def write_group(context, target, name, weights):
    """A vertex group. Vertices of weight 0 are not in it."""
    old = target.vertex_groups.get(name)
    if old is not None:
        target.vertex_groups.remove(old)
    attributes = target.data.attributes
    attribute = _attribute(attributes, name, "FLOAT")
    attribute.data.foreach_set("value", weights)
    attributes.active = attribute
    # Blender's own conversion: the groups have no access to many weights at once.
    with context.temp_override(object=target, active_object=target):
        bpy.ops.geometry.attribute_convert(mode="VERTEX_GROUP")


def write_colours(mesh, name, shares):
    """A colour attribute by the ramp, for shares in [0, 1]; not finite: the colour of what no source reaches."""
    colours = np.ones((len(shares), 4), np.float32)
    colours[:, :3] = palette.ramp(shares)
    colours[~np.isfinite(shares), :3] = palette.UNREACHED
    attribute = _attribute(mesh.color_attributes, name, "FLOAT_COLOR")
    attribute.data.foreach_set("color", colours.ravel())
    mesh.color_attributes.active_color = attribute
    mesh.update()


_RAMP_NODES = {"Distance", "Range", "Unreached"}  # those that a later call sets


def write_ramp_material(mesh, name, attribute, largest):
    """A material that colours all faces by an attribute from 0 to `largest`. One of an earlier call is kept, but for its range."""
    material = bpy.data.materials.get(name)
    if material is None or not material.use_nodes or not _RAMP_NODES <= set(material.node_tree.nodes.keys()):
        material = _ramp_material(name)
    nodes = material.node_tree.nodes
    nodes["Distance"].attribute_name = attribute
    nodes["Range"].inputs["From Max"].default_value = largest
    nodes["Unreached"].inputs[1].default_value = largest * (1 + 1e-6)
    _write_slots(mesh, [material], np.zeros(len(mesh.polygons), np.int32))


def _ramp_material(name):
    material = _new_material(name)
    nodes, links = material.node_tree.nodes, material.node_tree.links

    def node(kind, name, x):
        made = nodes.new(kind)
        made.name = made.label = name
        made.location = x, 300
        return made

    distance, scaled = node("ShaderNodeAttribute", "Distance", -1000), node("ShaderNodeMapRange", "Range", -800)
    ramp, mix = node("ShaderNodeValToRGB", "Ramp", -600), node("ShaderNodeMix", "Colour", -200)
    unreached = node("ShaderNodeMath", "Unreached", -420)
    unreached.operation = "GREATER_THAN"
    mix.data_type = "RGBA"
    _set_ramp(ramp.color_ramp.elements)
    factor, near, far = mix.inputs[0], mix.inputs[6], mix.inputs[7]
    far.default_value = *palette.UNREACHED, 1
    links.new(distance.outputs["Fac"], scaled.inputs["Value"])
    links.new(distance.outputs["Fac"], unreached.inputs[0])
    links.new(scaled.outputs["Result"], ramp.inputs["Fac"])
    links.new(ramp.outputs["Color"], near)
    links.new(unreached.outputs["Value"], factor)
    links.new(mix.outputs[2], nodes["Principled BSDF"].inputs["Base Color"])
    return material


def _set_ramp(elements):
    while len(elements) < len(palette.RAMP):
        elements.new(0.5)
    for i, colour in enumerate(palette.RAMP):
        elements[i].position = i / (len(palette.RAMP) - 1)
        elements[i].color = *colour, 1


def _new_material(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    return material


def write_cell_materials(mesh, cells, count):
    """A material for each of `count` cells, and one for the faces of none (-1)."""
    names = [f"Cell {i + 1}" for i in range(count)]
    colours = [palette.cell(i) for i in range(count)]
    if (cells < 0).any():
        names.append("Cell unreached")
        colours.append(palette.UNREACHED)
        cells = np.where(cells < 0, count, cells)
    materials = [bpy.data.materials.get(name) or _plain_material(name, rgb) for name, rgb in zip(names, colours)]
    _write_slots(mesh, materials, cells.astype(np.int32))


def _plain_material(name, colour):
    material = _new_material(name)
    material.diffuse_color = *colour, 1  # in the viewport's solid mode
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = *colour, 1
    return material


def _write_slots(mesh, materials, places):
    """Gives each face one of `materials`, in slots behind those that the mesh has of others."""
    slots = mesh.materials
    slot = {name: i for i, name in enumerate(slots.keys())}
    if len(slots) + sum(material.name not in slot for material in materials) > 32767:
        raise Problem("a mesh has 32,767 materials at most")
    for material in materials:
        if material.name not in slot:
            slot[material.name] = len(slots)
            slots.append(material)
    indices = np.array([slot[material.name] for material in materials], np.int32)[places]
    attributes = mesh.attributes
    attribute = attributes.get("material_index") or attributes.new("material_index", "INT", "FACE")
    attribute.data.foreach_set("value", indices)
    mesh.update()


def add_curves(context, target, name, positions, closed, thickness):
    """A curve object that moves with `target`: a list of (n, 3) positions in its space, and which of them are closed.

    Curves with a thickness go without the points that are nearer than it: the tube would kink there.
    """
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    data.bevel_depth = thickness
    for points, is_closed in zip(positions, closed):
        points = _spaced(points, thickness) if thickness > 0 else points
        spline = data.splines.new("POLY")
        spline.points.add(len(points) - 1)
        spline.points.foreach_set("co", np.append(points, np.ones((len(points), 1)), axis=1).ravel())
        spline.use_cyclic_u = bool(is_closed)
    curves = bpy.data.objects.new(name, data)
    curves.parent = target
    _link(context, target, curves)
    return curves


def _spaced(points, least):
    """Those of the points that are so far apart along the curve, and both ends."""
    way = np.append(0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    chosen, last = [0], len(points) - 1
    while (following := int(np.searchsorted(way, way[chosen[-1]] + least))) < last:
        chosen.append(following)
    if len(chosen) > 1 and way[last] - way[chosen[-1]] < least:
        chosen.pop()
    return points[[*chosen, last]] if last > 0 else points


def select_vertices(context, mesh, vertices):
    """Selects these vertices alone."""
    for items in (mesh.edges, mesh.polygons):
        items.foreach_set("select", np.zeros(len(items), bool))
    selected = np.zeros(len(mesh.vertices), bool)
    selected[vertices] = True
    mesh.vertices.foreach_set("select", selected)
    context.tool_settings.mesh_select_mode = True, False, False
    mesh.update()
