"""The operators. From scripts: `bpy.ops.taut.distance(source="VERTICES", method="EXACT")` and so on."""

from functools import partial

import bpy
import numpy as np

from . import options, results, surface, work
from .job import Operation
from .surface import Problem


class TAUT_OT_distance(
    Operation, options.Evaluated, options.Space, options.Source, options.Solver, options.Distance, bpy.types.Operator
):
    """Measure the geodesic distance of every vertex"""

    bl_idname = "taut.distance"
    bl_label = "Geodesic Distance"

    def prepare(self, context, target):
        results.check_writable(target)
        self.check(target.data)
        self.places = surface.places(context, target, self.surface, self.source, self.evaluated)
        return partial(work.distances, self.surface, self.places, self.space, self.solver())

    def check(self, mesh):
        if not (self.attribute or self.group or self.colours or self.material):
            raise Problem("nothing is asked for: attribute, vertex group, colours or material")
        results.check_attribute(mesh, self.attribute_name, "FLOAT")
        if self.colours:
            results.check_attribute(mesh, self.attribute_name + "_colour", "FLOAT_COLOR")
        if self.group:
            results.check_free(mesh, self.attribute_name + "_weight")

    def finish(self, context, target, distances):
        target = self.written_to(context, target)
        mesh = target.data
        reached = np.isfinite(distances)
        largest = distances[reached].max(initial=0)
        shares = distances / (largest or 1)
        values = shares if self.normalize else distances
        if self.attribute or self.material:
            results.write_values(mesh, self.attribute_name, "FLOAT", values.astype(np.float32))
        if self.group:
            weights = np.where(reached, 1 - shares, 0).astype(np.float32)
            results.write_group(context, target, self.attribute_name + "_weight", weights)
        if self.colours:
            results.write_colours(mesh, self.attribute_name + "_colour", shares)
        if self.material:
            name = f"{target.name} {self.attribute_name}"
            results.write_ramp_material(mesh, name, self.attribute_name, values[reached].max(initial=0))
        _tell(self, f"Largest distance {largest:.6g}", np.count_nonzero(~reached))


def _tell(operator, message, unreached):
    if unreached:
        operator.report({"WARNING"}, f"{message}; no way leads to {unreached} vertices")
    else:
        operator.report({"INFO"}, message)


class TAUT_OT_isolines(Operation, options.Evaluated, options.Isolines, options.Thickness, bpy.types.Operator):
    """Draw lines of equal distance, or of any attribute of numbers, as a curve object"""

    bl_idname = "taut.isolines"
    bl_label = "Isolines"

    def prepare(self, context, target):
        values = surface.attribute(target, self.values, self.evaluated)
        count = self.count if self.levels == "COUNT" else None
        return partial(work.isolines, self.surface, values, count, self.spacing)

    def finish(self, context, target, result):
        curves, levels = result
        if len(curves) == 0:
            raise Problem(f"there are no isolines: no level lies between the least and the greatest value of {self.values}")
        positions = np.split(curves.positions, curves.offsets[1:-1])
        made = results.add_curves(
            context, target, f"{target.name} isolines", positions, curves.closed, self.thickness
        )
        made.data["levels"] = levels[curves.levels].tolist()
        self.report({"INFO"}, f"{len(curves)} lines of {len(levels)} levels")


class TAUT_OT_path(
    Operation, options.Evaluated, options.Space, options.Path, options.Thickness, bpy.types.Operator
):
    """Draw the shortest path over the surface through selected vertices, as a curve object"""

    bl_idname = "taut.path"
    bl_label = "Shortest Path"

    def prepare(self, context, target):
        is_object = self.surface.is_object
        history = surface.selection_history(target) if is_object else None
        vertices = surface.selected_vertices(target, not is_object) if history is None else history
        self.places = surface.Places(vertices=vertices)
        if self.start == "CURSOR":
            self.places = self.places._replace(points=surface.cursor(context, target))
        if self.places.total < 2:
            raise Problem("select one vertex at least" if self.start == "CURSOR" else "select two vertices at least")
        return partial(work.path, self.surface, self.places, history is not None, self.space)

    def finish(self, context, target, result):
        positions, length = result
        made = results.add_curves(context, target, f"{target.name} path", [positions], [False], self.thickness)
        made.data["length"] = length
        self.report({"INFO"}, f"Length {length:.6g}")


class TAUT_OT_voronoi(
    Operation, options.Evaluated, options.Space, options.Source, options.Solver, bpy.types.Operator
):
    """Give the faces nearest to each selected vertex or face a material of their own"""

    bl_idname = "taut.voronoi"
    bl_label = "Voronoi Cells"
    attribute = "geodesic_cell"

    def prepare(self, context, target):
        results.check_writable(target)
        self.check(target.data)
        self.places = surface.places(context, target, self.surface, self.source, self.evaluated)
        centres = surface.face_centres(target, self.evaluated)
        return partial(work.cells, self.surface, self.places, centres, self.space, self.solver())

    def check(self, mesh):
        results.check_attribute(mesh, self.attribute, "INT")

    def finish(self, context, target, result):
        of_vertices, of_faces = result
        target = self.written_to(context, target)
        count = self.places.total
        results.write_cell_materials(target.data, of_faces, count)
        results.write_values(target.data, self.attribute, "INT", of_vertices.astype(np.int32))
        _tell(self, f"{count} cells", np.count_nonzero(of_vertices < 0))


class TAUT_OT_spread(Operation, options.Space, options.Spread, bpy.types.Operator):
    """Select vertices that are spread evenly over the surface, those that are selected among them"""

    bl_idname = "taut.spread"
    bl_label = "Select Spread Vertices"

    def prepare(self, context, target):
        results.check_writable(target)
        vertices = surface.selected_vertices(target)
        return partial(work.spread, self.surface, vertices, self.points, self.space)

    def finish(self, context, target, vertices):
        results.select_vertices(context, target.data, vertices)
        self.report({"INFO"}, f"{len(vertices)} vertices")


classes = TAUT_OT_distance, TAUT_OT_isolines, TAUT_OT_path, TAUT_OT_voronoi, TAUT_OT_spread
