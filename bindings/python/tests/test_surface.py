"""Paths, isolines, closest points, and curves as sources."""

import numpy as np
import pytest

import taut


def values_at(mesh, values, curves):
    """A field, linear in each triangle, at the points of curves."""
    return (values[mesh.triangles[curves.faces]] * curves.barycentrics).sum(axis=1)


def test_paths_are_as_long_as_distances(elephant):
    sources = taut.Sources([10, 1500], offsets=[0, 0.05])
    field = taut.ExactSolver(elephant).field(sources)
    paths = field.paths()
    assert len(paths) == elephant.vertex_count
    nearest = field.nearest_sources()
    np.testing.assert_array_equal(paths.sources, nearest)
    np.testing.assert_array_equal(paths.levels, np.arange(len(paths)))
    lengths = np.array([path.length for path in paths])
    np.testing.assert_allclose(lengths + np.array([0, 0.05])[nearest], field.distances(), atol=1e-12)
    starts, ends = paths.offsets[:-1], paths.offsets[1:] - 1
    np.testing.assert_array_equal(paths.positions[starts], elephant.positions)
    np.testing.assert_array_equal(paths.positions[ends], elephant.positions[np.array([10, 1500])[nearest]])
    on_surface = elephant.point_positions(paths.faces, paths.barycentrics)
    np.testing.assert_allclose(paths.positions, on_surface, atol=1e-15)


def test_find_geodesic_path(elephant, square):
    solver = taut.ExactSolver(elephant)
    path = solver.find_geodesic_path(3, 2000)
    np.testing.assert_array_equal(path[[0, -1]], elephant.positions[[3, 2000]])
    length = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
    assert length == pytest.approx(solver.compute_distance(2000)[3], rel=1e-12)
    np.testing.assert_array_equal(solver.find_geodesic_path(3, 3), elephant.positions[[3]])
    start = taut.Targets(faces=[0], barycentrics=[(0.5, 0.25, 0.25)])
    end = taut.Sources(faces=[1], barycentrics=[(0, 1, 0)])
    expected = [(0.25, 0.25, 0), (0.5, 0.5, 0), (1, 1, 0)]
    np.testing.assert_allclose(taut.ExactSolver(square).find_geodesic_path(start, end), expected, atol=1e-15)


def test_isolines_lie_at_their_levels(elephant):
    distances = taut.HeatSolver(elephant).compute_distance(0)
    levels = taut.even_levels(elephant, distances, 12)
    assert len(levels) == 12
    np.testing.assert_allclose(np.diff(levels), levels[0] - distances.min(), rtol=1e-12)
    lines = taut.isolines(elephant, distances, levels)
    assert set(lines.levels) == set(range(12))
    of_points = np.repeat(levels[lines.levels], np.diff(lines.offsets))
    np.testing.assert_allclose(values_at(elephant, distances, lines), of_points, atol=1e-14)
    assert (lines.sources == taut.none).all()
    assert lines.closed.any()
    alone = taut.isolines(elephant, distances, levels[5])
    assert [line.length for line in alone] == [line.length for line in lines if line.level == 5]


def test_the_length_of_an_isoline(grid):
    height = (grid.positions - grid.positions[0]) @ np.array([2, 2, 1]) / 3  # along a side of the square
    (line,) = taut.isolines(grid, height, 0.33)
    assert line.length == pytest.approx(1, rel=1e-12)
    assert not line.closed
    top = np.linalg.norm(grid.positions - grid.positions[10 * 21 + 10], axis=1)
    (ring,) = taut.isolines(grid, top, [0.3])
    assert ring.closed
    assert ring.length == pytest.approx(2 * np.pi * 0.3, rel=5e-3)


def test_spaced_levels(square):
    assert taut.spaced_levels(square, [0, 1, 2, 1], 0.5).tolist() == [0.5, 1, 1.5]
    assert len(taut.even_levels(square, [1, 1, 1, 1], 5)) == 0
    assert len(taut.even_levels(square, [0, 1, 2, 1], 0)) == 0


def test_steepest_descent_leads_to_the_sources(elephant):
    sources = [10, 1500]
    field = taut.HeatSolver(elephant).field(sources)
    distances, targets = field.distances(), np.arange(0, elephant.vertex_count, 50)
    paths = taut.descent_paths(elephant, distances, sources, targets)
    assert len(paths) == len(targets)
    np.testing.assert_array_equal(paths.sources, field.nearest_sources()[targets])
    np.testing.assert_array_equal(paths.positions[paths.offsets[:-1]], elephant.positions[targets])
    np.testing.assert_array_equal(paths.positions[paths.offsets[1:] - 1], elephant.positions[sources][paths.sources])
    exact = taut.ExactSolver(elephant).compute_distance(sources)[targets]
    lengths = np.array([path.length for path in paths])
    assert (lengths >= exact - 1e-12).all()
    assert lengths.sum() < 1.05 * exact.sum()


def test_descent_without_sources(grid):
    height = grid.positions[:, 2]
    paths = taut.descent_paths(grid, height)
    assert (paths.sources == taut.none).all()
    np.testing.assert_allclose(paths.positions[paths.offsets[1:] - 1, 2], height.min(), atol=1e-15)


def test_closest_points(elephant):
    random = np.random.default_rng(11)
    points = random.random((200, 3)) - 0.5
    closest = taut.Closest(elephant)
    places = closest.points(points)
    positions = elephant.point_positions(places.faces, places.barycentrics)
    np.testing.assert_allclose(np.linalg.norm(points - positions, axis=1), places.distances, rtol=1e-12)
    to_vertices = np.linalg.norm(points[:, None] - elephant.positions, axis=2).min(axis=1)
    assert (places.distances <= to_vertices + 1e-15).all()
    at_vertices = closest.points(elephant.positions)
    assert at_vertices.distances.max() == 0
    corners = elephant.triangles[at_vertices.faces, at_vertices.barycentrics.argmax(axis=1)]
    np.testing.assert_array_equal(corners, np.arange(elephant.vertex_count))
    assert len(closest.points(np.empty((0, 3))).faces) == 0


def test_curves_are_a_sequence(elephant):
    distances = taut.HeatSolver(elephant).compute_distance(0)
    lines = taut.isolines(elephant, distances, taut.even_levels(elephant, distances, 9))
    assert len(lines) == len(lines.closed) == len(list(lines))
    assert lines[-1].level == lines[len(lines) - 1].level == 8
    with pytest.raises(IndexError):
        lines[len(lines)]
    some = lines[1:-1:2]
    assert isinstance(some, taut.Curves)
    for one, other in zip(some, list(lines)[1:-1:2]):
        for a, b in zip(one, other):
            np.testing.assert_array_equal(a, b)
    assert lines[:] == lines
    assert lines[1:] != lines
    assert lines != "lines"
    assert not lines.positions.flags.writeable
    assert not lines[0].positions.flags.writeable
    assert repr(lines) == f"Curves(curves={len(lines)}, points={len(lines.faces)})"
    assert len(lines[3:3]) == 0


def test_curves_are_sources(grid):
    across = (grid.positions - grid.positions[0]) @ np.array([2, 2, 1]) / 3
    line = taut.isolines(grid, across, [0.42])
    for solver, tolerance in ((taut.ExactSolver(grid), 1e-14), (taut.HeatSolver(grid), 0.05)):
        distances = solver.compute_distance(taut.Sources(curves=line))
        np.testing.assert_allclose(distances, np.abs(across - 0.42), atol=tolerance)
    both = taut.Sources(0, curves=line, offsets=[0, 0.1])
    assert len(both) == 2
    field = taut.ExactSolver(grid).field(both)
    straight = np.linalg.norm(grid.positions - grid.positions[0], axis=1)
    np.testing.assert_allclose(field.distances(), np.minimum(straight, np.abs(across - 0.42) + 0.1), atol=1e-14)
    np.testing.assert_array_equal(field.nearest_sources()[[0, 440]], [0, 1])


def test_closed_curves_have_their_last_segment(grid):
    top = np.linalg.norm(grid.positions - grid.positions[10 * 21 + 10], axis=1)
    ring = taut.isolines(grid, top, [0.3])
    points = np.concatenate([ring.positions, ring.positions[:1]])
    a, along = points[:-1], np.diff(points, axis=0)
    share = np.einsum("vsx,sx->vs", grid.positions[:, None] - a, along) / (along**2).sum(axis=1)
    nearest = a + np.clip(share, 0, 1)[..., None] * along
    expected = np.linalg.norm(grid.positions[:, None] - nearest, axis=2).min(axis=1)
    distances = taut.ExactSolver(grid).compute_distance(taut.Sources(curves=ring))
    np.testing.assert_allclose(distances, expected, atol=1e-13)


def test_a_curve_through_points(grid):
    places = taut.Closest(grid).points(grid.positions[[0, 220, 440]])
    curves = taut.ExactSolver(grid).curve_through(places.faces, places.barycentrics)
    (curve,) = curves
    assert curve.length == pytest.approx(2**0.5, rel=1e-12)
    distances = taut.ExactSolver(grid).compute_distance(taut.Sources(curves=curves))
    np.testing.assert_allclose(distances[[0, 20, 440]], [0, 0.5**0.5, 0], atol=1e-13)
