"""Distances of both methods against closed forms and invariants."""

import numpy as np
import pytest
from conftest import grid_arrays

import taut


def cone(height, n=96):
    """A cone of radius 1 around the z axis, its tip last."""
    angle = 2 * np.pi * np.arange(n) / n
    rim = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(n)])
    return taut.Mesh([*rim, (0, 0, height)], [(i, (i + 1) % n, n) for i in range(n)])


def test_exact_in_the_plane(grid):
    distances = taut.ExactSolver(grid).compute_distance(31)
    expected = np.linalg.norm(grid.positions - grid.positions[31], axis=1)
    np.testing.assert_allclose(distances, expected, atol=1e-14)


@pytest.mark.parametrize("height", [0.5, 1.0, 3.0])
def test_exact_on_a_cone(height):
    n = 96
    mesh = cone(height, n)
    slant = np.hypot(1, height)
    corner = 2 * np.arcsin(np.sin(np.pi / n) / slant)  # the angle of a triangle at the tip
    turns = np.minimum(np.arange(n), n - np.arange(n)) * corner
    chord = np.where(turns < np.pi, 2 * slant * np.sin(turns / 2), 2 * slant)
    distances = taut.ExactSolver(mesh).compute_distance(0)
    np.testing.assert_allclose(distances[:n], chord, atol=1e-13)
    assert distances[n] == pytest.approx(slant, abs=1e-14)


def test_exact_is_a_metric(elephant):
    some = np.array([0, 500, 1000, 2000])
    rows = taut.ExactSolver(elephant).distance_rows(some)
    between = rows[:, some]
    np.testing.assert_allclose(between, between.T, atol=1e-13)
    assert (between[:, :, None] <= between[:, None, :] + between[None, :, :].transpose(0, 2, 1) + 1e-13).all()
    straight = np.linalg.norm(elephant.positions[some][:, None] - elephant.positions, axis=2)
    assert (rows >= straight - 1e-13).all()


def test_the_nearest_of_several_sources(elephant):
    some = [5, 900, 2500]
    for solver in (taut.ExactSolver(elephant), taut.HeatSolver(elephant)):
        rows, field = solver.distance_rows(some), solver.field(some)
        nearest, distances = field.nearest_sources(), field.distances()
        assert nearest.dtype == np.int64
        assert nearest[some].tolist() == [0, 1, 2]
        np.testing.assert_array_equal(solver.compute_distance(some), distances)
        if isinstance(solver, taut.ExactSolver):
            np.testing.assert_allclose(distances, rows.min(axis=0), atol=1e-13)
            np.testing.assert_allclose(rows[nearest, np.arange(len(nearest))], distances, atol=1e-13)


def test_start_distances(elephant):
    solver = taut.ExactSolver(elephant)
    rows = solver.distance_rows([5, 900])
    field = solver.field(taut.Sources([5, 900], offsets=[0.1, -0.2]))
    np.testing.assert_allclose(field.distances(), np.minimum(rows[0] + 0.1, rows[1] - 0.2), atol=1e-13)


def test_rows_are_fields(elephant):
    sources, sets = [0, 7, 100, 8, 9], [0, 2, 5]
    for solver in (taut.ExactSolver(elephant), taut.HeatSolver(elephant)):
        rows = solver.distance_rows(sources, sets, threads=2)
        np.testing.assert_array_equal(rows[0], solver.compute_distance(sources[:2]))
        np.testing.assert_array_equal(rows[1], solver.compute_distance(sources[2:]))
        np.testing.assert_array_equal(rows, solver.distance_rows(sources, np.array(sets, np.uint16), threads=1))


def test_sparse_rows_are_dense_ones_cut_off(elephant):
    solver = taut.ExactSolver(elephant)
    dense = solver.distance_rows([3, 1000])
    sparse = solver.distances_within([3, 1000], 0.2)
    assert sparse.shape == dense.shape
    for row, line in enumerate(dense):
        entries = slice(sparse.offsets[row], sparse.offsets[row + 1])
        np.testing.assert_array_equal(sparse.vertices[entries], np.flatnonzero(line <= 0.2))
        np.testing.assert_array_equal(sparse.values[entries], line[line <= 0.2])
    np.testing.assert_array_equal(sparse.to_scipy().toarray(), np.where(dense <= 0.2, dense, 0))
    assert sparse.to_scipy().nnz == len(sparse.values)
    assert solver.distances_within([], 1.0).shape == (0, elephant.vertex_count)


def test_radius_and_targets_end_the_work_early(elephant):
    solver = taut.ExactSolver(elephant)
    full = solver.field(0)
    assert full.final_radius == np.inf
    near = solver.field(0, radius=0.3)
    np.testing.assert_array_equal(near.distances(), np.where(full.distances() <= 0.3, full.distances(), np.inf))
    assert near.windows < full.windows
    nothing = solver.field(0, radius=0)
    assert np.flatnonzero(np.isfinite(nothing.distances())).tolist() == [0]
    some = np.argsort(full.distances())[[1, 20]]
    to_some = solver.field(0, targets=some)
    np.testing.assert_array_equal(to_some.distances(some), full.distances(some))
    assert to_some.windows < full.windows
    assert to_some.final_radius < np.inf


def test_points_are_sources_and_targets(grid):
    random = np.random.default_rng(3)
    faces, weights = random.integers(0, grid.triangle_count, 20), random.dirichlet((1, 1, 1), 20)
    points = grid.point_positions(faces, weights)
    from_point = taut.Sources(faces=faces[:1], barycentrics=weights[:1])
    field = taut.ExactSolver(grid).field(from_point, keep_windows=True)
    expected = np.linalg.norm(points - points[0], axis=1)
    targets = taut.Targets([0, 1], faces=faces, barycentrics=weights)
    np.testing.assert_allclose(field.distances(targets)[2:], expected, atol=1e-14)
    np.testing.assert_array_equal(field.distances(targets)[:2], field.distances()[:2])
    assert (field.nearest_sources(targets) == 0).all()
    heat = taut.HeatSolver(grid).compute_distance(from_point)
    assert np.abs(heat - field.distances()).mean() < 0.02


def test_farthest_points(elephant):
    solver = taut.ExactSolver(elephant)
    vertices, distances = solver.farthest_points(0, 6)
    taken = [0]
    for vertex, distance in zip(vertices, distances):
        field = solver.compute_distance(taken)
        assert distance == pytest.approx(field.max(), rel=1e-12)
        assert field[vertex] == pytest.approx(distance, rel=1e-12)
        taken.append(int(vertex))


def test_farthest_points_run_out(square):
    vertices, distances = taut.ExactSolver(square).farthest_points([0, 1], 4)
    assert vertices.tolist()[2:] == [taut.none] * 2
    assert distances.tolist() == [1, 1, 0, 0]


def test_what_is_not_reached_is_infinite():
    positions, triangles = grid_arrays(3)
    two = taut.Mesh(np.concatenate([positions, positions + 5]), np.concatenate([triangles, triangles + len(positions)]))
    for solver in (taut.ExactSolver(two), taut.HeatSolver(two)):
        field = solver.field(0)
        assert np.isinf(field.distances()[16:]).all()
        assert (field.nearest_sources()[16:] == taut.none).all()
        assert np.isfinite(field.distances()[:16]).all()
    assert len(taut.ExactSolver(two).find_geodesic_path(0, 20)) == 0


def test_heat_is_near_the_exact_distances(bunny):
    exact = taut.ExactSolver(bunny).compute_distance(1000)
    heat = taut.HeatSolver(bunny).compute_distance(1000)
    assert heat[1000] == 0
    error = np.abs(heat - exact)[exact > 0] / exact[exact > 0]
    assert error.mean() < 0.03


def test_heat_options(elephant):
    base = taut.HeatSolver(elephant)
    exact = taut.ExactSolver(elephant).compute_distance(0)
    for options in (
        {"laplacian": "plain"},
        {"shift": "min"},
        {"boundary": 0.5},
        {"time_step": taut.TimeStep("mean_sigma", factor=2)},
        {"time_step": "sigma"},
        {"time_step": 2 * base.time_step},
    ):
        solver = taut.HeatSolver(elephant, **options)
        distances = solver.compute_distance(0)
        assert np.abs(distances - exact).mean() < 0.1 * exact.mean()
        if "boundary" not in options and "shift" not in options:
            assert (distances != base.compute_distance(0)).any()
    assert taut.HeatSolver(elephant, laplacian="plain").report.flips == 0 < base.report.flips
    assert taut.HeatSolver(elephant, shift="min").compute_distance(0).min() == 0


def test_another_time_step_is_another_solver(elephant):
    base = taut.HeatSolver(elephant, laplacian="plain")
    other = base.with_time_step("sigma")
    fresh = taut.HeatSolver(elephant, laplacian="plain", time_step="sigma")
    assert other.time_step == fresh.time_step == elephant.time_step("sigma")
    np.testing.assert_array_equal(other.compute_distance(4), fresh.compute_distance(4))
    assert base.time_step == elephant.time_step()


def test_a_mesh_that_moves(elephant):
    moved = elephant.with_positions(elephant.positions * (1, 1.1, 1))
    solver = taut.HeatSolver(elephant).with_mesh(moved)
    fresh = taut.HeatSolver(moved)
    np.testing.assert_allclose(solver.compute_distance(4), fresh.compute_distance(4), rtol=1e-9, atol=1e-12)
    assert solver.mesh is moved


def test_residuals(elephant):
    residuals = taut.HeatSolver(elephant).residuals(0)
    assert 0 < residuals.heat < 1e-12
    assert 0 < residuals.poisson < 1e-10


def test_heat_fields_tell_more(elephant, cgal_meshes):
    camel = taut.Mesh.read(cgal_meshes / "camel.off")
    solver = taut.HeatSolver(elephant)
    assert solver.field(0).nonpositive_heat == 0
    assert taut.HeatSolver(camel, laplacian="plain").field(0).nonpositive_heat > 0
    along = np.repeat(np.arange(401.0), 2)
    strip = np.column_stack([along, np.tile([0.0, 1], 401), np.zeros(802)])
    squares = 2 * np.arange(400)[:, None] + (0, 2, 3, 1)
    faded = taut.HeatSolver(taut.Mesh(strip, squares), time_step=taut.TimeStep(factor=0.01)).field([0, 1])
    assert faded.restarts > 0 == solver.field(0).restarts
    np.testing.assert_allclose(faded.distances(), along, atol=1)


def test_words_for_objects(square):
    assert repr(taut.ExactSolver(square)) == "ExactSolver(Mesh(vertices=4, triangles=2))"
    assert repr(taut.HeatSolver(square, time_step=0.5)) == "HeatSolver(Mesh(vertices=4, triangles=2), time_step=0.5)"
    assert repr(taut.ExactSolver(square).field(0)) == "ExactField(vertices=4, final_radius=inf)"
    assert repr(taut.HeatSolver(square).field(0)) == "HeatField(vertices=4)"
    assert repr(taut.Closest(square)) == "Closest(Mesh(vertices=4, triangles=2))"
    assert repr(taut.Sources([1, 2])) == "Sources(vertices=2, points=0, curves=0)"
    assert repr(taut.Targets([1, 2], faces=[0], barycentrics=[(1, 0, 0)])) == "Targets(vertices=2, points=1)"
