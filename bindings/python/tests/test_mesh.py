"""Meshes: what goes in comes out, polygons become fans, and what is known about them."""

import gzip

import numpy as np
import pytest
from conftest import corpus, grid_arrays

import taut

CORNERS = np.array([(0.0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0)])


def test_what_goes_in_comes_out(elephant):
    again = taut.Mesh(elephant.positions, elephant.triangles)
    assert again == elephant
    assert hash(again) == hash(elephant)
    assert elephant.positions.shape == (elephant.vertex_count, 3)
    assert elephant.triangles.shape == (elephant.triangle_count, 3)
    assert elephant != elephant.with_positions(2 * elephant.positions)
    assert elephant != taut.Mesh(elephant.positions, elephant.triangles[::-1])
    assert elephant != "elephant"
    assert repr(elephant) == f"Mesh(vertices={elephant.vertex_count}, triangles={elephant.triangle_count})"


def test_what_is_told_is_read_only(square):
    for array in (square.positions, square.triangles, square.ignored_triangles):
        assert not array.flags.writeable


@pytest.mark.parametrize(
    "faces",
    [
        [(0, 1, 2, 3), (1, 4, 5, 2)],
        np.array([(0, 1, 2, 3), (1, 4, 5, 2)]),
        np.array([(0, 1, 2, 3), (1, 4, 5, 2)], np.uint16)[:, :],
    ],
)
def test_quads_become_fans(faces):
    assert taut.Mesh(CORNERS, faces).triangles.tolist() == [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]]


def test_polygons_become_fans():
    expected = [[0, 1, 4], [0, 4, 5], [0, 5, 2], [0, 2, 3], [1, 4, 5]]
    by_list = taut.Mesh(CORNERS, [(0, 1, 4, 5, 2, 3), (1, 4, 5)])
    by_arrays = taut.Mesh(CORNERS, [np.array([0, 1, 4, 5, 2, 3]), np.array([1, 4, 5], np.uint8)])
    by_objects = taut.Mesh(CORNERS, np.array([[0, 1, 4, 5, 2, 3], [1, 4, 5]], dtype=object))
    by_offsets = taut.Mesh.polygons(CORNERS, [0, 6, 9], [0, 1, 4, 5, 2, 3, 1, 4, 5])
    assert by_list.triangles.tolist() == expected
    assert by_list == by_arrays == by_objects == by_offsets


@pytest.mark.parametrize("faces", [[], (), np.zeros((0, 3), int), np.zeros((0, 4)), np.zeros(0)])
def test_no_faces(faces):
    mesh = taut.Mesh(CORNERS, faces)
    assert (mesh.vertex_count, mesh.triangle_count) == (6, 0)
    assert mesh.triangles.shape == (0, 3)
    assert np.isinf(taut.ExactSolver(mesh).compute_distance(2)).sum() == 5


def test_the_empty_mesh():
    mesh = taut.Mesh([], [])
    assert mesh == taut.Mesh.polygons([], [], [])
    assert mesh.positions.shape == (0, 3)
    assert taut.ExactSolver(mesh).distance_rows([]).shape == (0, 0)
    assert len(taut.isolines(mesh, [], [1.0])) == 0
    assert mesh.report().components == []
    assert np.isnan(mesh.report().largest_angle.radians)


def test_a_vertex_of_no_triangle_may_be_anything():
    positions = [*CORNERS[:4], (np.nan, np.inf, -np.inf)]
    mesh = taut.Mesh(positions, [(0, 1, 2, 3)])
    assert taut.ExactSolver(mesh).compute_distance(0)[4] == np.inf
    assert taut.HeatSolver(mesh).compute_distance(0)[4] == np.inf
    assert mesh.report().unreferenced_vertices.tolist() == [4]
    np.testing.assert_array_equal(mesh.positions[4], positions[4])
    assert mesh == taut.Mesh(mesh.positions, mesh.triangles)


def test_files_are_read_as_arrays_are(elephant, cgal_meshes, tmp_path):
    content = (cgal_meshes / "elephant.off").read_bytes()
    assert taut.Mesh.read_bytes(content, "off") == elephant
    path = tmp_path / "elephant ü.off.gz"
    path.write_bytes(gzip.compress(content))
    assert taut.Mesh.read(path) == taut.Mesh.read(str(path)) == elephant
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in elephant.positions.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (elephant.triangles + 1).tolist()]
    assert taut.Mesh.read_bytes("\n".join(lines).encode(), "obj") == elephant
    assert taut.Mesh.read_bytes(bytearray(content), "off") == elephant


def test_properties_against_numpy(elephant):
    positions, triangles = elephant.positions, elephant.triangles
    edges = np.unique(np.sort(triangles[:, [(0, 1), (1, 2), (2, 0)]].reshape(-1, 2)), axis=0)
    lengths = np.linalg.norm(positions[edges[:, 0]] - positions[edges[:, 1]], axis=1)
    properties = elephant.properties()
    assert (properties.vertices, properties.edges, properties.faces) == (len(positions), len(edges), len(triangles))
    assert properties.mean_edge == pytest.approx(lengths.mean(), rel=1e-12)
    assert properties.sigma_edge == pytest.approx(lengths.std(), rel=1e-12)
    assert properties.max_edge == pytest.approx(lengths.max(), rel=1e-15)
    assert [properties.q1, properties.q2, properties.q3] == pytest.approx(np.quantile(lengths, [0.25, 0.5, 0.75]), rel=1e-2)
    diagonal = np.linalg.norm(np.ptp(positions, axis=0))
    assert properties.paper_scale == pytest.approx(24.976 / diagonal, rel=1e-12)


def test_time_steps_are_the_formulas(elephant):
    p = elephant.properties()
    e, s = p.mean_edge, p.sigma_edge
    raw = {
        "mean_edge": e**2,
        "sigma": s,
        "mean_sigma": (e**2 + s) / 2,
        "median_fit": 1.01204 * s - 0.0001,
        "median_mean": (e**2 + 1.01204 * s - 0.0001) / 2,
    }
    for formula, t in raw.items():
        assert elephant.time_step(taut.TimeStep(formula, "raw", 3.0)) == pytest.approx(3 * t, rel=1e-12)
    assert elephant.time_step() == elephant.time_step("mean_edge") == pytest.approx(e**2, rel=1e-12)
    assert elephant.time_step("sigma") == pytest.approx(s / p.paper_scale, rel=1e-12)
    assert elephant.time_step(0.25) == elephant.time_step(taut.TimeStep.value(0.25)) == 0.25


def test_time_steps_are_values():
    assert taut.TimeStep() == taut.TimeStep("mean_edge", "paper", 1)
    assert len({taut.TimeStep("sigma"), taut.TimeStep("sigma"), taut.TimeStep.value(2), taut.TimeStep.value(2.0)}) == 2
    for step in (taut.TimeStep("sigma", "raw", 2.5), taut.TimeStep.value(0.1)):
        assert eval(repr(step), {"TimeStep": taut.TimeStep}) == step


def test_report_of_two_sheets():
    # Two triangles on an edge, one of them twice; one that repeats an index; loose vertices.
    positions = [*CORNERS, (9, 9, 9)]
    mesh = taut.Mesh(positions, [(0, 1, 2), (0, 3, 2), (2, 0, 1), (1, 4, 4)])
    report = mesh.report()
    assert report.repeated_index_faces.tolist() == mesh.ignored_triangles.tolist() == [3]
    assert report.duplicate_faces.tolist() == [[2, 0]]
    assert report.nonmanifold_edges.tolist() == [[0, 2]]
    assert report.unreferenced_vertices.tolist() == [4, 5, 6]
    assert [c.vertices for c in report.components] == [4]
    assert not report.components[0].manifold


def test_report_of_an_open_grid(grid):
    report = grid.report()
    assert len(report.components) == 1
    part = report.components[0]
    assert part.vertices - part.edges + part.faces == 1
    assert part.manifold
    assert part.orientable
    (loop,) = report.boundary_loops
    assert loop.closed
    assert len(loop.vertices) == 80
    assert (report.component_of == 0).all()
    assert report.largest_angle.radians == pytest.approx(np.pi / 2)
    assert report.smallest_angle.radians == pytest.approx(np.pi / 4)


def test_points_lie_where_their_weights_say(elephant):
    random = np.random.default_rng(7)
    faces = random.integers(0, elephant.triangle_count, 50)
    weights = random.dirichlet((1, 1, 1), 50)
    expected = np.einsum("nk,nkx->nx", weights, elephant.positions[elephant.triangles[faces]])
    np.testing.assert_allclose(elephant.point_positions(faces, weights), expected, atol=1e-15)


def test_a_mesh_that_moves():
    positions, triangles = grid_arrays(4)
    moved = taut.Mesh(positions, triangles).with_positions(positions @ np.diag([1, 2, 3]))
    assert moved == taut.Mesh(positions @ np.diag([1, 2, 3]), triangles)


@pytest.mark.parametrize("path", corpus(), ids=lambda path: path.name)
def test_both_methods_answer_on_any_mesh(path):
    mesh = taut.Mesh.read(path)
    source = int(mesh.triangles[0, 0])
    exact = taut.ExactSolver(mesh).compute_distance(source)
    heat = taut.HeatSolver(mesh).compute_distance(source)
    reached = mesh.report().component_of == mesh.report().component_of[source]
    np.testing.assert_array_equal(np.isfinite(exact), reached)
    np.testing.assert_array_equal(np.isfinite(heat), reached)
