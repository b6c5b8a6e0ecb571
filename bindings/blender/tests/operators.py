"""Drives the operators in Blender without a window, and compares with the library called outside Blender."""

import os
import pathlib
import sys
import tempfile
import time
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import bpy
import host
import numpy as np
from host import add, outside, select, values

addon = host.install()
job, options, surface = addon.job, addon.options, addon.surface

EXACT = "taut.ExactSolver(taut.Mesh(p, t)).compute_distance(s).astype(np.float32)"
HEAT = "taut.HeatSolver(taut.Mesh(p, t){}).compute_distance(s).astype(np.float32)"
GRID = [(x, y, 0) for y in range(6) for x in range(6)]
QUADS = [(6 * y + x, 6 * y + x + 1, 6 * y + x + 7, 6 * y + x + 6) for y in range(5) for x in range(5)]


def real_meshes():
    names = ["elephant.off", "fandisk.off", "mannequin-devil.off"]
    paths = [host.MESHES / name for name in names]
    if host.CORPUS:
        names = "moebius.obj", "bunny10k_unref.ply", "bones_26cc.off", "truck_nm.obj"
        paths += [host.CORPUS / name for name in names]
    return paths


class Case(unittest.TestCase):
    def setUp(self):
        host.empty_scene()

    def assertSame(self, found, wanted):
        np.testing.assert_array_equal(found, wanted)

    def assertRefused(self, message, operator, **properties):
        """The operator tells this, and changes nothing."""
        before = host.state()
        with self.assertRaisesRegex(RuntimeError, message):
            operator(**properties)
        self.assertEqual(host.state(), before)

    def elephant(self):
        self.positions, self.triangles = host.read(host.MESHES / "elephant.off")
        return add(self.positions, self.triangles, "Elephant")


class Distance(Case):
    def test_real_meshes_give_what_the_library_gives(self):
        for path in real_meshes():
            with self.subTest(path.name):
                host.empty_scene()
                positions, triangles = host.read(path)
                target = add(positions, triangles)
                sources = np.array([triangles[0, 0], triangles[len(triangles) // 2, 1]])
                select(target, sources)
                for method, expression in (("HEAT", HEAT.format("")), ("EXACT", EXACT)):
                    bpy.ops.taut.distance(method=method)
                    wanted = outside(expression, p=positions, t=triangles, s=np.unique(sources))
                    self.assertSame(values(target), wanted)

    def test_each_option_of_heat_arrives(self):
        target = self.elephant()
        select(target, [7])
        cases = [
            ({"time_step": "MEAN_EDGE", "factor": 4}, ", time_step=taut.TimeStep('mean_edge', factor=4)"),
            ({"time_step": "SIGMA"}, ", time_step='sigma'"),
            ({"time_step": "SIGMA", "scale": "RAW"}, ", time_step=taut.TimeStep('sigma', 'raw')"),
            ({"time_step": "MEAN_SIGMA"}, ", time_step='mean_sigma'"),
            ({"time_step": "MEDIAN_FIT"}, ", time_step='median_fit'"),
            ({"time_step": "MEDIAN_MEAN"}, ", time_step='median_mean'"),
            ({"time_step": "VALUE", "value": 2**-10}, ", time_step=2**-10"),
            ({"boundary": 0.5}, ", boundary=0.5"),
            ({"laplacian": "PLAIN"}, ", laplacian='plain'"),
        ]
        seen = set()
        for properties, arguments in cases:
            bpy.ops.taut.distance(**properties)
            wanted = outside(HEAT.format(arguments), p=self.positions, t=self.triangles, s=7)
            self.assertSame(values(target), wanted)
            seen.add(values(target).tobytes())
        self.assertGreaterEqual(len(seen), len(cases) - 1)  # a closed surface has no boundary to tell

    def test_sources_may_be_the_centres_of_faces(self):
        target = self.elephant()
        select(target, faces=[10, 2000])
        bpy.ops.taut.distance(source="FACES", method="EXACT")
        sources = "taut.Sources(faces=f, barycentrics=np.full((2, 3), 1 / 3))"
        wanted = outside(EXACT.replace("(s)", f"({sources})"), p=self.positions, t=self.triangles, f=[10, 2000])
        np.testing.assert_allclose(values(target), wanted, rtol=1e-5)

    def test_the_source_may_be_the_place_nearest_to_the_cursor(self):
        target = self.elephant()
        target.location = 1, 2, 3
        target.rotation_euler = 0.3, 0.2, 0.1
        bpy.context.view_layer.update()
        linear = np.array(target.matrix_world.to_3x3())
        offset = np.array([0.1, 0.2, -0.05])
        bpy.context.scene.cursor.location = target.matrix_world.translation + type(target.location)(offset)
        bpy.ops.taut.distance(source="CURSOR", method="EXACT")
        c = np.array(bpy.context.scene.cursor.location) - np.array(target.matrix_world.translation)
        expression = (
            "(m := taut.Mesh(p.astype(float) @ l.T, t), c := taut.Closest(m).points(c[None]), "
            "taut.ExactSolver(m).compute_distance(taut.Sources(faces=c.faces, barycentrics=c.barycentrics)))[2]"
        )
        wanted = outside(expression, p=self.positions, t=self.triangles, l=linear, c=c)
        np.testing.assert_allclose(values(target), wanted, atol=1e-6)

    def test_lengths_are_the_worlds_unless_local_ones_are_asked_for(self):
        target = self.elephant()
        target.scale = 3, 0.5, -1
        target.rotation_euler = 0.4, -1, 2
        bpy.context.view_layer.update()
        select(target, [100])
        linear = np.array(target.matrix_world.to_3x3(), np.float64)
        p = self.positions.astype(np.float64)
        world = p[:, :1] * linear[:, 0] + p[:, 1:2] * linear[:, 1] + p[:, 2:] * linear[:, 2]
        bpy.ops.taut.distance(method="EXACT")
        self.assertSame(values(target), outside(EXACT, p=world, t=self.triangles, s=100))
        bpy.ops.taut.distance(method="EXACT", space="LOCAL")
        self.assertSame(values(target), outside(EXACT, p=self.positions, t=self.triangles, s=100))

    def test_an_object_scaled_flat_has_distances(self):
        target = add(GRID, QUADS)
        target.scale = 2, 0, 1
        bpy.context.view_layer.update()
        select(target, [0])
        bpy.ops.taut.distance(method="EXACT")
        np.testing.assert_allclose(values(target).reshape(6, 6), np.tile(2.0 * np.arange(6), (6, 1)), atol=1e-6)

    def test_quads_are_flat_where_they_are_flat(self):
        target = add(GRID, QUADS)
        select(target, [0])
        bpy.ops.taut.distance(method="EXACT")
        np.testing.assert_allclose(values(target), np.linalg.norm(GRID, axis=1), rtol=1e-6)

    def test_a_concave_face_is_not_left(self):
        # An L of one face: from tip to tip the way bends round the inner corner, whatever corner comes first.
        corners = [(0, 0, 0), (4, 0, 0), (4, 1, 0), (1, 1, 0), (1, 4, 0), (0, 4, 0)]
        for first in range(6):
            host.empty_scene()
            turned = corners[first:] + corners[:first]
            target = add(turned, [range(6)])
            select(target, [turned.index((4, 1, 0))])
            bpy.ops.taut.distance(method="EXACT")
            self.assertAlmostEqual(values(target)[turned.index((1, 4, 0))], 6, places=5)
            self.assertAlmostEqual(values(target)[turned.index((0, 4, 0))], 3 + 10**0.5, places=5)

    def test_the_centre_of_a_concave_face_is_on_it(self):
        target = add([(0, 0, 0), (8, 0, 0), (8, 1, 0), (1, 1, 0), (1, 8, 0), (0, 8, 0)], [range(6)])
        select(target, faces=[0])
        bpy.ops.taut.distance(method="EXACT", source="FACES")
        self.assertAlmostEqual(values(target)[3], 2, places=5)  # (3, 1) or (1, 3) is nearest to the mean of the corners

    def test_what_no_source_reaches(self):
        two = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 0, 0), (6, 0, 0), (5, 1, 0), (9, 9, 9)])
        target = add(two, [(0, 1, 2), (3, 4, 5)])
        select(target, [0])
        bpy.ops.taut.distance(method="EXACT", group=True, material=True)
        self.assertSame(values(target), np.float32([0, 1, 1, np.inf, np.inf, np.inf, np.inf]))
        group = target.vertex_groups["geodesic_distance_weight"]
        self.assertEqual([[g.group for g in v.groups] for v in target.data.vertices], [[group.index]] + 6 * [[]])
        colours = np.array([c.color[:] for c in target.data.color_attributes["geodesic_distance_colour"].data])
        np.testing.assert_allclose(colours[3:, :3], np.tile(addon.palette.UNREACHED, (4, 1)), atol=1e-6)
        self.assertFalse(np.allclose(colours[1, :3], addon.palette.UNREACHED, atol=0.1))

    def test_outputs_are_written_where_asked_for(self):
        target = self.elephant()
        select(target, [7])
        names = {"attribute": "d", "colours": "d_colour", "group": "d_weight", "material": "Elephant d"}
        for chosen in names:
            host.empty_scene()
            target = add(self.positions, self.triangles, "Elephant")
            select(target, [7])
            asked = {name: name == chosen for name in names}
            bpy.ops.taut.distance(attribute_name="d", method="EXACT", **asked)
            self.assertEqual("d" in target.data.attributes, chosen in {"attribute", "material"})
            self.assertEqual("d_colour" in target.data.color_attributes, chosen == "colours")
            self.assertEqual("d_weight" in target.vertex_groups, chosen == "group")
            self.assertEqual([m.name for m in target.data.materials], ["Elephant d"] if chosen == "material" else [])
        self.assertRefused(
            "nothing is asked for", bpy.ops.taut.distance, attribute=False, colours=False, group=False, material=False
        )

    def test_weights_and_colours_fall_with_the_distance(self):
        target = self.elephant()
        select(target, [7])
        for _ in range(2):  # a second time it takes the place of the first
            bpy.ops.taut.distance(method="EXACT", group=True, normalize=True)
        shares = values(target)
        self.assertEqual((shares.min(), shares.max()), (0, 1))
        self.assertEqual(len(target.vertex_groups), 1)
        weights = np.array([v.groups[0].weight if len(v.groups) else 0 for v in target.data.vertices])
        np.testing.assert_allclose(weights, 1 - shares, atol=1e-6)
        colours = np.array([c.color[:3] for c in target.data.color_attributes["geodesic_distance_colour"].data])
        np.testing.assert_allclose(colours, addon.palette.ramp(shares), atol=1e-5)
        self.assertEqual(target.data.color_attributes.active_color.name, "geodesic_distance_colour")

    def test_the_material_reads_the_attribute(self):
        target = self.elephant()
        target.data.materials.append(bpy.data.materials.new("Mine"))
        select(target, [7])
        for _ in range(2):
            bpy.ops.taut.distance(method="EXACT", material=True)
        self.assertEqual([m.name for m in target.data.materials], ["Mine", "Elephant geodesic_distance"])
        bpy.data.materials.new("Elephant other")  # not of the add-on
        bpy.ops.taut.distance(method="EXACT", material=True, attribute_name="other")
        self.assertEqual(target.data.materials[2].name, "Elephant other.001")
        bpy.ops.taut.distance(method="EXACT", material=True)
        nodes = target.data.materials[1].node_tree.nodes
        self.assertEqual(nodes["Distance"].attribute_name, "geodesic_distance")
        self.assertAlmostEqual(nodes["Range"].inputs["From Max"].default_value, values(target).max(), places=5)
        self.assertEqual({face.material_index for face in target.data.polygons}, {1})

    def test_loose_vertices(self):
        target = add([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.5, 0.5, 0)], [(0, 1, 2)])
        select(target, [3])
        bpy.ops.taut.distance(method="EXACT")
        self.assertSame(values(target), np.float32([np.inf, np.inf, np.inf, 0]))

    def test_refusals(self):
        target = add(GRID, QUADS)
        self.assertRefused("no vertex of Thing is selected", bpy.ops.taut.distance)
        self.assertRefused("no face of Thing is selected", bpy.ops.taut.distance, source="FACES")
        select(target, [0])
        self.assertRefused("is not positive", bpy.ops.taut.distance, time_step="VALUE", value=0)
        self.assertRefused(r"\(vertex 0\)", bpy.ops.taut.distance, boundary=1)
        self.assertRefused("has no name", bpy.ops.taut.distance, attribute_name="")
        target.data.attributes.new("taken", "INT", "POINT")
        self.assertRefused("already has an attribute taken", bpy.ops.taut.distance, attribute_name="taken")
        target.data.attributes.new("d_weight", "FLOAT", "POINT")
        self.assertRefused("already has an attribute d_weight", bpy.ops.taut.distance, attribute_name="d", group=True)
        target.data.vertices[9].co.x = np.nan
        self.assertRefused("vertex 9", bpy.ops.taut.distance)
        add([], [], "Empty")
        self.assertRefused("Empty has no faces", bpy.ops.taut.distance)
        add(GRID[:3], [], "Points")
        self.assertRefused("Points has no faces", bpy.ops.taut.distance)

    def test_a_linked_mesh_is_left_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "other.blend")
            bpy.data.libraries.write(path, {add(GRID, QUADS, "Linked")})
            host.empty_scene()
            with bpy.data.libraries.load(path, link=True) as (_, wanted):
                wanted.objects = ["Linked"]
            target = bpy.data.objects["Linked"]
            bpy.context.collection.objects.link(target)
            bpy.context.view_layer.objects.active = target
            self.assertRefused("linked from another file", bpy.ops.taut.distance, source="CURSOR")


class Modes(Case):
    def test_edit_mode_gives_the_same_and_stays(self):
        target = self.elephant()
        select(target, [7, 900])
        bpy.ops.taut.distance()
        wanted = values(target)
        select(target)
        bpy.ops.object.mode_set(mode="EDIT")
        host.select_in_order(target, [900, 7])
        bpy.ops.taut.distance(attribute_name="edited", group=True, material=True)
        self.assertEqual(target.mode, "EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertSame(values(target, "edited"), wanted)
        self.assertSame(surface.selected_vertices(target), [7, 900])

    def test_undo_and_redo(self):
        operators = [
            lambda: bpy.ops.taut.distance("EXEC_DEFAULT", True, group=True, material=True),
            lambda: bpy.ops.taut.isolines("EXEC_DEFAULT", True, values="base"),
            lambda: bpy.ops.taut.path("EXEC_DEFAULT", True),
            lambda: bpy.ops.taut.voronoi("EXEC_DEFAULT", True),
            lambda: bpy.ops.taut.spread("EXEC_DEFAULT", True, points=5),
        ]
        for mode in ("OBJECT", "EDIT"):
            for operator in operators:
                host.empty_scene()
                target = add(GRID, QUADS)
                base = target.data.attributes.new("base", "FLOAT", "POINT")
                base.data.foreach_set("value", np.arange(36, dtype=np.float32))
                select(target, [0, 20])
                bpy.ops.object.mode_set(mode=mode)
                bpy.ops.ed.undo_push(message="before")
                before = host.state()
                operator()
                after = host.state()
                if mode == "OBJECT":
                    self.assertNotEqual(after, before)
                bpy.ops.ed.undo()
                self.assertEqual(host.state(), before)
                bpy.ops.ed.redo()
                self.assertEqual(host.state(), after)

    def test_a_deformed_mesh_writes_to_the_object(self):
        target = self.elephant()
        modifier = target.modifiers.new("Bend", "SIMPLE_DEFORM")
        modifier.deform_method = "TWIST"
        modifier.angle = 2
        select(target, [7], faces=[3])
        result = target.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        bent = np.array([v.co[:] for v in result.vertices], np.float32)
        self.assertFalse(np.allclose(bent, self.positions, atol=0.01))
        bpy.ops.taut.distance(method="EXACT", evaluated=True)
        self.assertSame(values(target), outside(EXACT, p=bent, t=self.triangles, s=7))
        bpy.ops.taut.distance(method="EXACT", evaluated=True, source="FACES")
        sources = "taut.Sources(faces=[3], barycentrics=np.full((1, 3), 1 / 3))"
        wanted = outside(EXACT.replace("(s)", f"({sources})"), p=bent, t=self.triangles)
        np.testing.assert_allclose(values(target), wanted, rtol=1e-5, atol=1e-6)
        bpy.ops.taut.distance(method="EXACT")
        self.assertSame(values(target), outside(EXACT, p=self.positions, t=self.triangles, s=7))

    def test_a_subdivided_mesh_writes_to_a_copy(self):
        for mode in ("OBJECT", "EDIT"):
            host.empty_scene()
            target = add(GRID, QUADS)
            target.modifiers.new("Finer", "SUBSURF").levels = 2
            select(target, [14, 15])  # neighbours: the vertices between them are no sources
            bpy.ops.object.mode_set(mode=mode)
            before = host.state()[0]
            bpy.ops.taut.distance(method="EXACT", evaluated=True)
            data = host.state()[0]
            copy = bpy.data.objects["Thing evaluated"]
            self.assertEqual(data.pop(copy.name)[1].count("geodesic_distance"), 1)
            self.assertEqual(data, before)
            self.assertIs(bpy.context.view_layer.objects.active, target)
            self.assertEqual(len(copy.data.polygons), 25 * 16)
            found = values(copy)
            self.assertSame(np.flatnonzero(found == 0), [14, 15])
            bent = np.array([v.co[:] for v in copy.data.vertices])
            flat = np.linalg.norm(bent[:, None] - bent[[14, 15]], axis=2).min(axis=1)
            np.testing.assert_allclose(found, flat, atol=1e-5)

    def test_a_copy_that_cannot_be_written_to_does_not_stay(self):
        target = add(GRID, QUADS)
        select(target, [0])
        target.modifiers.new("Finer", "SUBSURF")
        for operator, name, kind in ((bpy.ops.taut.distance, "geodesic_distance", "INT"),
                                     (bpy.ops.taut.voronoi, "geodesic_cell", "FLOAT")):
            modifier = target.modifiers.new("Store", "NODES")
            modifier.node_group = host.storing(name, kind)
            meshes = len(bpy.data.meshes)
            self.assertRefused("already has an attribute", operator, evaluated=True)
            self.assertEqual(len(bpy.data.meshes), meshes)
            target.modifiers.remove(modifier)

    def test_a_remeshed_one_asks_for_the_cursor(self):
        target = add(GRID, QUADS)
        target.modifiers.new("Thick", "SOLIDIFY").thickness = 1
        target.modifiers.new("Blocks", "REMESH").octree_depth = 3
        select(target, [0])
        self.assertRefused("use the 3D cursor", bpy.ops.taut.distance, evaluated=True)
        bpy.ops.taut.distance(evaluated=True, source="CURSOR")
        self.assertTrue(np.isfinite(values(bpy.data.objects["Thing evaluated"])).all())


class Isolines(Case):
    def setUp(self):
        super().setUp()
        self.target = self.elephant()
        select(self.target, [7])
        bpy.ops.taut.distance(method="EXACT")

    def lines(self, levels):
        expression = f"(m := taut.Mesh(p, t), c := taut.isolines(m, v, {levels}), np.array({{}}))[2]"
        given = {"p": self.positions, "t": self.triangles, "v": values(self.target)}
        offsets, closed = outside(expression.format("c.offsets"), **given), outside(expression.format("c.closed"), **given)
        return np.split(outside(expression.format("c.positions"), **given).astype(np.float32), offsets[1:-1]), closed

    def test_lines_are_those_of_the_library(self):
        for properties, levels in (
            ({"count": 15}, "taut.even_levels(m, v, 15)"),
            ({"levels": "SPACING", "spacing": 0.125}, "taut.spaced_levels(m, v, 0.125)"),
        ):
            bpy.ops.taut.isolines(**properties)
            made = [o for o in bpy.data.objects if o.type == "CURVE"][-1]
            found, (points, closed) = host.splines(made), self.lines(levels)
            self.assertEqual(len(found), len(points))
            for (a, a_closed), b, b_closed in zip(found, points, closed):
                self.assertSame(a, b)
                self.assertEqual(a_closed, b_closed)
            self.assertIs(made.parent, self.target)
            self.assertEqual(len(made.data["levels"]), len(found))
            bpy.data.objects.remove(made)

    def test_thick_lines_have_no_points_that_nearly_coincide(self):
        bpy.ops.taut.isolines(thickness=0.01)
        made = bpy.data.objects["Elephant isolines"]
        self.assertAlmostEqual(made.data.bevel_depth, 0.01)
        whole, closed = self.lines("taut.even_levels(m, v, 20)")
        found = host.splines(made)
        self.assertEqual(len(found), len(whole))
        for (points, _), all_points in zip(found, whole):
            self.assertSame(points[[0, -1]], all_points[[0, -1]])
            self.assertTrue({p.tobytes() for p in points} <= {p.tobytes() for p in all_points})
            way = np.append(0, np.cumsum(np.linalg.norm(np.diff(all_points.astype(float), axis=0), axis=1)))
            places = [np.flatnonzero((all_points == p).all(axis=1))[0] for p in points]
            if way[-1] > 0.02:
                self.assertGreater(np.diff(way[places]).min(), 0.0099)

    def test_lines_move_with_the_object(self):
        self.target.scale = 1, 2, 3
        self.target.location = 4, 5, 6
        bpy.ops.taut.isolines()
        bpy.context.view_layer.update()
        self.assertEqual(bpy.data.objects["Elephant isolines"].matrix_world, self.target.matrix_world)

    def test_refusals(self):
        self.assertRefused("no attribute nothing", bpy.ops.taut.isolines, values="nothing")
        self.assertRefused("there are no isolines", bpy.ops.taut.isolines, levels="SPACING", spacing=1000)
        self.assertRefused("spacing", bpy.ops.taut.isolines, levels="SPACING", spacing=0)

    def test_lines_of_a_subdivided_mesh(self):
        self.target.modifiers.new("Finer", "SUBSURF").levels = 1
        bpy.ops.taut.isolines(count=10)
        coarse = sum(len(points) for points, _ in host.splines(bpy.data.objects["Elephant isolines"]))
        bpy.ops.taut.isolines(count=10, evaluated=True)
        fine = sum(len(points) for points, _ in host.splines(bpy.data.objects["Elephant isolines.001"]))
        self.assertGreater(fine, 1.8 * coarse)


class Path(Case):
    def path(self):
        return next(o for o in bpy.data.objects if o.type == "CURVE")

    def test_a_path_is_that_of_the_library(self):
        target = self.elephant()
        select(target, [7, 1900])
        bpy.ops.taut.path()
        ((found, closed),) = host.splines(self.path())
        wanted = outside("taut.ExactSolver(taut.Mesh(p, t)).find_geodesic_path(7, 1900)", p=self.positions, t=self.triangles)
        self.assertFalse(closed)
        self.assertEqual(len(found), len(wanted))
        np.testing.assert_allclose(found, wanted, atol=2e-7)
        length = outside("taut.ExactSolver(taut.Mesh(p, t)).compute_distance(7)[1900]", p=self.positions, t=self.triangles)
        self.assertAlmostEqual(self.path().data["length"] / length, 1, places=12)

    def test_the_length_is_the_worlds(self):
        target = self.elephant()
        target.scale = 1, 2, 5
        bpy.context.view_layer.update()
        select(target, [7, 1900])
        bpy.ops.taut.distance(method="EXACT", source="CURSOR")
        bpy.ops.taut.path()
        ((found, _),) = host.splines(self.path())
        scaled = found.astype(np.float64) * (1, 2, 5)
        length = self.path().data["length"]
        self.assertAlmostEqual(np.linalg.norm(np.diff(scaled, axis=0), axis=1).sum() / length, 1, places=5)
        wanted = outside("taut.ExactSolver(taut.Mesh(p * np.array([1, 2, 5.]), t)).compute_distance(7)[1900]",
                         p=self.positions.astype(np.float64), t=self.triangles)
        self.assertAlmostEqual(length / wanted, 1, places=12)

    def through(self):
        """The corners of the grid that the path goes through, in its order."""
        ((points, _),) = host.splines(self.path())
        return [int(p[1] * 6 + p[0]) for p in points if any(np.allclose(p, GRID[v]) for v in (0, 5, 30, 35))]

    def test_the_order_of_selection_counts_in_edit_mode(self):
        target = add(GRID, QUADS)
        for order in ([0, 35, 5, 30], [30, 35, 0, 5]):
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_mode(type="VERT")
            host.select_in_order(target, order)
            bpy.ops.taut.path()
            self.assertEqual((target.mode, self.through()), ("EDIT", order))
            bpy.ops.object.mode_set(mode="OBJECT")
            bpy.data.objects.remove(self.path())

    def test_without_an_order_the_nearest_is_next(self):
        target = add(np.array(GRID) * (1, 0.5, 1), QUADS)
        select(target, [0, 5, 30, 35])
        bpy.ops.taut.path()
        ((points, _),) = host.splines(self.path())
        at = [tuple(p) for p in points.round(4) if tuple(p) in {(0, 0, 0), (5, 0, 0), (0, 2.5, 0), (5, 2.5, 0)}]
        self.assertEqual(at, [(0, 0, 0), (0, 2.5, 0), (5, 2.5, 0), (5, 0, 0)])

    def test_a_path_may_start_at_the_cursor(self):
        target = add(GRID, QUADS)
        target.location = 1, 1, 1
        bpy.context.view_layer.update()
        bpy.context.scene.cursor.location = 1 + 4.25, 1 + 3.5, 1.5
        select(target, [0])
        bpy.ops.taut.path(start="CURSOR")
        ((points, _),) = host.splines(self.path())
        np.testing.assert_allclose(points[[0, -1]], [(4.25, 3.5, 0), (0, 0, 0)], atol=1e-6)
        self.assertAlmostEqual(self.path().data["length"], np.hypot(4.25, 3.5), places=5)

    def test_refusals(self):
        two = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 0, 0), (6, 0, 0), (5, 1, 0), (9, 9, 9)]
        target = add(two, [(0, 1, 2), (3, 4, 5)])
        self.assertRefused("select two vertices", bpy.ops.taut.path)
        self.assertRefused("select one vertex", bpy.ops.taut.path, start="CURSOR")
        select(target, [0, 4])
        self.assertRefused("no way leads to vertex 4", bpy.ops.taut.path)
        select(target, [0, 6])
        self.assertRefused("vertex 6 belongs to no face", bpy.ops.taut.path)
        bpy.ops.object.mode_set(mode="EDIT")
        host.select_in_order(target, [4, 1])
        self.assertRefused(r"\(vertex 1\)", bpy.ops.taut.path)


class Voronoi(Case):
    def test_cells_are_those_of_the_library(self):
        target = self.elephant()
        seeds = np.array([7, 500, 1200, 2000, 2700])
        for method, solver in (("EXACT", "ExactSolver"), ("HEAT", "HeatSolver")):
            select(target, seeds)
            bpy.ops.taut.voronoi(method=method)
            expression = f"taut.{solver}(taut.Mesh(p, t)).field(s).nearest_sources().astype(np.int32)"
            wanted = outside(expression, p=self.positions, t=self.triangles, s=seeds)
            self.assertSame(values(target, "geodesic_cell", np.int32), wanted)
            self.assertEqual([m.name for m in target.data.materials], [f"Cell {i + 1}" for i in range(5)])

    def test_a_face_belongs_to_the_cell_of_its_centre(self):
        target = self.elephant()
        select(target, [7, 500, 1200, 2000, 2700])
        bpy.ops.taut.voronoi(method="EXACT")
        found = np.array([face.material_index for face in target.data.polygons])
        expression = (
            "taut.ExactSolver(taut.Mesh(p, t)).field([7, 500, 1200, 2000, 2700], keep_windows=True)"
            ".nearest_sources(taut.Targets(faces=np.arange(len(t)), barycentrics=np.full((len(t), 3), 1 / 3)))"
        )
        wanted = outside(expression, p=self.positions, t=self.triangles)
        inner = (values(target, "geodesic_cell", np.int32)[self.triangles] == found[:, None]).all(axis=1)
        self.assertSame(found[inner], wanted[inner])
        a, b, c = values(target, "geodesic_cell", np.int32)[self.triangles[~inner]].T
        of_most = np.where(b == c, b, a)
        right, by_most = np.mean(found[~inner] == wanted[~inner]), np.mean(of_most == wanted[~inner])
        print(f"faces on borders in the cell of their centre: {right:.1%}; by the most corners: {by_most:.1%}")
        self.assertGreater(right, by_most)

    def test_own_materials_stay_and_cells_are_used_again(self):
        target = add(GRID, QUADS)
        target.data.materials.append(bpy.data.materials.new("Mine"))
        for seeds in ([0, 35], [0, 5, 30]):
            select(target, seeds)
            bpy.ops.taut.voronoi()
        self.assertEqual([m.name for m in target.data.materials], ["Mine", "Cell 1", "Cell 2", "Cell 3"])
        faces = np.array([face.material_index for face in target.data.polygons]).reshape(5, 5)
        self.assertEqual((faces[0, 0], faces[0, 4], faces[4, 0]), (1, 2, 3))

    def test_faces_that_no_seed_reaches(self):
        two = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 0, 0), (6, 0, 0), (5, 1, 0)]
        target = add(two, [(0, 1, 2), (3, 4, 5)])
        select(target, faces=[0])
        bpy.ops.taut.voronoi(source="FACES")
        self.assertSame(values(target, "geodesic_cell", np.int32), [0, 0, 0, -1, -1, -1])
        self.assertEqual([m.name for m in target.data.materials], ["Cell 1", "Cell unreached"])
        self.assertEqual([face.material_index for face in target.data.polygons], [0, 1])

    def test_a_subdivided_mesh_writes_to_a_copy(self):
        target = add(GRID, QUADS)
        target.modifiers.new("Finer", "SUBSURF").levels = 2
        select(target, [0, 35])
        bpy.ops.taut.voronoi(evaluated=True)
        copy = bpy.data.objects["Thing evaluated"]
        faces = np.array([face.material_index for face in copy.data.polygons])
        self.assertEqual(len(faces), 400)
        self.assertAlmostEqual(faces.mean(), 0.5, places=1)
        self.assertEqual(len(target.data.materials), 0)


class Spread(Case):
    def test_vertices_are_those_of_the_library(self):
        target = self.elephant()
        select(target, [7, 900], faces=[5])
        bpy.ops.taut.spread(points=10)
        wanted = outside("taut.ExactSolver(taut.Mesh(p, t)).farthest_points([7, 900], 8)[0]", p=self.positions, t=self.triangles)
        self.assertSame(surface.selected_vertices(target), np.sort([7, 900, *wanted]))
        self.assertSame(surface.selected_faces(target, False), [])

    def test_nothing_selected_and_more_than_there_are(self):
        target = add([(9, 9, 9), *GRID], [[v + 1 for v in quad] for quad in QUADS])
        bpy.ops.taut.spread(points=4)
        self.assertEqual(set(surface.selected_vertices(target)), {1, 6, 31, 36})
        bpy.ops.taut.spread(points=100)
        self.assertSame(surface.selected_vertices(target), np.arange(1, 37))


class Panel(Case):
    def test_buttons_hand_on_every_setting(self):
        settings = bpy.context.scene.taut
        for cls in addon.operators.classes:
            copied = types.SimpleNamespace()
            options.copy(settings, copied, cls)
            group, operator = cls.bl_idname.split(".")
            known = getattr(getattr(bpy.ops, group), operator).get_rna_type().properties.keys()
            self.assertEqual(set(vars(copied)), set(known) - {"rna_type"})

    def test_the_add_on_leaves_nothing_behind(self):
        addon.unregister()
        self.assertFalse(hasattr(bpy.types.Scene, "taut") or hasattr(bpy.types, "TAUT_PT_main"))
        addon.register()
        self.assertTrue(hasattr(bpy.types.Scene, "taut"))


class Job(Case):
    """The job without a window; `window` has the rest."""

    def test_a_job_tells_its_progress_and_its_result(self):
        target = self.elephant()
        work = addon.work
        read = surface.read(target, False)
        solver = work.Solver("EXACT", addon.taut.TimeStep(), 0, "intrinsic")
        running = job.Job(lambda watch: work.distances(read, surface.Places(vertices=np.array([7])), "LOCAL", solver, watch))
        told = [running.watch.control.progress]
        while not running.is_done:
            told.append(running.watch.control.progress)
            time.sleep(0.001)
        self.assertEqual(told, sorted(told))
        wanted = outside(EXACT, p=self.positions, t=self.triangles, s=7)
        self.assertSame(running.outcome().astype(np.float32), wanted)

    def test_a_job_raises_what_its_work_raised(self):
        def work(watch):
            raise surface.Problem("this")

        with self.assertRaisesRegex(surface.Problem, "this"):
            job.Job(work).outcome()

    def test_a_cancelled_job_has_no_result(self):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=8)
        read = surface.read(bpy.context.object, False)
        solver = addon.work.Solver("EXACT", addon.taut.TimeStep(), 0, "intrinsic")
        places = surface.Places(vertices=np.array([0]))
        running = job.Job(lambda watch: addon.work.distances(read, places, "WORLD", solver, watch))
        while running.watch.control.progress == 0:
            time.sleep(0.001)
        start = time.perf_counter()
        running.cancel()
        with self.assertRaises(addon.taut.Cancelled):
            running.outcome()
        self.assertLess(time.perf_counter() - start, 1)


host.main(sys.modules[__name__])
