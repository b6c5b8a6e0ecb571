"""taut beside pygeodesic, libigl and potpourri3d, in one run, on real meshes that libigl reads for all of them.

docs/witnesses.md tells which program is right where they disagree. So meshes whose vertices or edges are not manifold are
left out (pygeodesic does not pass where two fans meet, the others refuse or differ); louvre_cad, where from vertex 4128
pygeodesic says 1.2e-9 more than the length of the path that it draws itself, which is taut's and libigl's distance, and from
3117 libigl says 2.8e-8 more; and for libigl the exact distances of mannequin-devil, where it loses eight digits.
"""

import functools

import igl
import numpy as np
import potpourri3d
import pytest
import real_meshes
import scipy.sparse.csgraph
import scipy.sparse.linalg
from pygeodesic import geodesic

import taut

CLOSED = ["elephant.off", "knot2.off", "fandisk.off", "homer.off", "bull.off", "camel.off", "anchor_dense.off"]
OPEN = ["holes.off", "lion-head.off", "mannequin-devil.off", "mech-holes-shark.off"]
PARTS = ["bones.off", "knot2.off"]
LARGE = ["armadillo.off", "bunny00.off"]
CORPUS = [
    f"corpus/{name}"
    for name in ("paper_bunny_1.obj", "moebius.obj", "platonic_shelf.obj", "ankylosaurus.obj.gz", "nefertiti.obj.gz")
    if (real_meshes.CORPUS / name).exists()
]

# Shares of the largest distance. The worst of pygeodesic is 1.8e-13, on needles of anchor_dense; of libigl 1.3e-14.
EXACT = 1e-12


# -------------------------------------------------------------------------------------------------- Meshes and peers


@functools.lru_cache(maxsize=None)
def arrays(name):
    """Positions and triangles, as libigl reads them."""
    positions, triangles = igl.read_triangle_mesh(str(real_meshes.path(name)))
    return np.ascontiguousarray(positions), np.ascontiguousarray(triangles, np.int64)


@functools.lru_cache(maxsize=None)
def mesh_of(name):
    return taut.Mesh(*arrays(name))


@functools.lru_cache(maxsize=None)
def exact_of(name):
    return taut.ExactSolver(mesh_of(name))


def some_vertices(name, count=3):
    """Vertices all over a mesh, of triangles."""
    triangles = arrays(name)[1]
    return triangles[:: len(triangles) // count][:count, 0].tolist()


@functools.lru_cache(maxsize=None)
def by_pygeodesic(name):
    positions, triangles = arrays(name)
    return geodesic.PyGeodesicAlgorithmExact(positions, triangles.astype(np.int32))


@functools.lru_cache(maxsize=None)
def parts(name):
    """The connected part of each vertex, by scipy."""
    positions, triangles = arrays(name)
    ends = triangles[:, [0, 1, 1, 2]].reshape(-1, 2)
    edges = scipy.sparse.coo_array((np.ones(len(ends)), ends.T), (len(positions), len(positions)))
    return scipy.sparse.csgraph.connected_components(edges, directed=False)[1]


def pygeodesic_distances(name, sources, targets=None):
    """Distances and nearest sources; +inf and -1 out of reach, where it is not asked since it reads stray memory."""
    part = parts(name)
    targets = np.arange(len(part)) if targets is None else np.array(targets)
    reached = np.isin(part[targets], part[sources])
    distances, nearest = np.full(len(targets), np.inf), np.full(len(targets), -1)
    ends = np.array(sources, np.int32), targets[reached].astype(np.int32)
    distances[reached], nearest[reached] = by_pygeodesic(name).geodesicDistances(*ends)
    return distances, nearest


@functools.lru_cache(maxsize=None)
def pygeodesic_row(name, source):
    return pygeodesic_distances(name, [source])[0]


def libigl_distances(name, **places):
    """The distances of all vertices, or of the vertices VT and the triangles' centres FT."""
    positions, triangles = arrays(name)
    if not {"VT", "FT"} & set(places):
        places["VT"] = np.arange(len(positions))
    return igl.exact_geodesic(positions, triangles, **{key: np.asarray(value) for key, value in places.items()})


def assert_same(ours, theirs, tolerance=EXACT):
    """Equal up to a share of the largest finite number, and +inf at the same places."""
    finite = np.isfinite(theirs)
    assert np.array_equal(np.isfinite(ours), finite)
    assert np.abs(ours[finite] - theirs[finite]).max() <= tolerance * np.abs(theirs[finite]).max()


# -------------------------------------------------------------------------------------------------------- The meshes


@pytest.mark.parametrize("name", [*CLOSED, *OPEN, *PARTS])
def test_files_are_read_as_libigl_reads_them(name):
    positions, triangles = arrays(name)
    mesh = taut.Mesh.read(real_meshes.path(name))
    assert np.array_equal(mesh.positions, positions)
    assert np.array_equal(mesh.triangles, triangles)


def test_the_nearest_points_of_the_surface_are_those_of_libigl():
    positions, triangles = arrays("fandisk.off")
    low, high = positions.min(0), positions.max(0)
    clicks = np.random.default_rng(1).uniform(low - 0.2, high + 0.2, (2000, 3))
    squared, _, places = igl.point_mesh_squared_distance(clicks, positions, triangles)
    ours = taut.Closest(mesh_of("fandisk.off")).points(clicks)
    assert_same(ours.distances, np.sqrt(squared), 1e-13)
    found = mesh_of("fandisk.off").point_positions(ours.faces, ours.barycentrics)
    # Several places may be equally near.
    apart = np.linalg.norm(found - places, axis=1) > 1e-9
    assert apart.mean() < 0.01
    assert_same(np.linalg.norm(clicks - found, axis=1), np.sqrt(squared), 1e-13)


# --------------------------------------------------------------------------------------------------- Exact distances


@pytest.mark.parametrize("name", [*CLOSED, *OPEN, *PARTS, *LARGE, *CORPUS])
def test_exact_distances_are_those_of_pygeodesic(name):
    for source in some_vertices(name, 1 if len(arrays(name)[1]) > 40_000 else 3):
        assert_same(exact_of(name).compute_distance(source), pygeodesic_row(name, source))


@pytest.mark.parametrize("name", [*CLOSED, "holes.off", "mech-holes-shark.off"])
def test_exact_distances_are_those_of_libigl(name):
    source = some_vertices(name)[1]
    ours = exact_of(name).compute_distance(source)
    # It says 0 for what is out of reach.
    assert_same(np.where(np.isfinite(ours), ours, 0), libigl_distances(name, VS=[source]))


@pytest.mark.parametrize("name", ["fandisk.off", "lion-head.off", "bones.off", "camel.off"])
def test_several_sources_at_once(name):
    sources = some_vertices(name, 20)
    ours = exact_of(name).compute_distance(sources)
    assert_same(ours, pygeodesic_distances(name, sources)[0])
    if name != "bones.off":
        assert_same(ours, libigl_distances(name, VS=sources))


@pytest.mark.parametrize("name", ["fandisk.off", "bones.off"])
def test_rows_of_single_sources_and_of_sets(name):
    sources = some_vertices(name, 6)
    single = np.array([pygeodesic_row(name, source) for source in sources])
    assert_same(exact_of(name).distance_rows(sources, threads=2), single)
    sets = [0, 1, 4, 6]
    united = np.array([single[i:j].min(0) for i, j in zip(sets, sets[1:])])
    assert_same(exact_of(name).distance_rows(sources, sets=sets, threads=2), united)


def test_start_distances():
    name, offsets = "fandisk.off", [0.0, 0.1, -0.2, 0.05]
    sources = some_vertices(name, 4)
    expected = np.min([pygeodesic_row(name, source) + start for source, start in zip(sources, offsets)], axis=0)
    assert_same(exact_of(name).compute_distance(taut.Sources(sources, offsets=offsets)), expected)


@pytest.mark.parametrize("name", ["fandisk.off", "holes.off"])
def test_points_inside_triangles_are_those_of_libigl(name):
    faces = [5, 700, 4000]
    centres = dict(faces=faces, barycentrics=np.full((3, 3), 1 / 3))
    ours = exact_of(name).field(taut.Sources(**centres), keep_windows=True)
    assert_same(ours.distances(), libigl_distances(name, FS=faces))
    others = [1, 77, 2500]
    targets = taut.Targets([10, 20], faces=others, barycentrics=np.full((3, 3), 1 / 3))
    assert_same(ours.distances(targets), libigl_distances(name, FS=faces, VT=[10, 20], FT=others))


@pytest.mark.parametrize("name", ["fandisk.off", "lion-head.off"])
def test_what_lies_within_a_radius(name):
    sources = some_vertices(name)
    rows = np.array([pygeodesic_row(name, source) for source in sources])
    radius = 0.3 * float(rows.max())
    assert not (np.abs(rows - radius) < 1e-9 * radius).any(), "a vertex on the border: choose another radius"
    within = exact_of(name).distances_within(sources, radius).to_scipy()
    expected = np.where(rows <= radius, rows, np.inf)
    reached = np.full_like(rows, np.inf)
    entries = within.tocoo()
    reached[entries.row, entries.col] = entries.data
    assert_same(reached, expected)


@pytest.mark.parametrize("name", ["fandisk.off", "holes.off", "bones.off"])
def test_nearest_sources(name):
    sources = some_vertices(name, 12)
    rows = np.array([pygeodesic_row(name, source) for source in sources])
    nearest = exact_of(name).field(sources).nearest_sources()
    first, second = np.sort(rows, axis=0)[:2]
    with np.errstate(invalid="ignore"):  # inf - inf, of parts without a source
        clear = second - first > 1e-9 * rows[np.isfinite(rows)].max()
    assert np.array_equal(nearest[clear], rows.argmin(0)[clear])
    assert np.array_equal(nearest[clear], pygeodesic_distances(name, sources)[1][clear])
    assert np.array_equal(nearest < 0, np.isinf(first))
    at_all = np.flatnonzero(nearest >= 0)
    assert_same(rows[nearest[at_all], at_all], first[at_all])


def test_farthest_points():
    name, first = "holes.off", 17
    vertices, distances = exact_of(name).farthest_points(first, 12)
    least = pygeodesic_row(name, first)
    for vertex, distance in zip(vertices.tolist(), distances):
        assert distance == pytest.approx(least.max(), rel=1e-12)
        assert least[vertex] == pytest.approx(least.max(), rel=1e-12)
        least = np.minimum(least, pygeodesic_row(name, vertex))


# ------------------------------------------------------------------------------------------------------------- Paths


def length(points):
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum()


@pytest.mark.parametrize("name", ["fandisk.off", "camel.off", "lion-head.off", *CORPUS[:1]])
def test_shortest_paths_are_as_long_as_those_of_pygeodesic(name):
    positions, triangles = arrays(name)
    flips = potpourri3d.EdgeFlipGeodesicSolver(positions, triangles)
    start = some_vertices(name)[0]
    for end in some_vertices(name, 8)[1:]:
        ours = exact_of(name).find_geodesic_path(start, end)
        distance, theirs = by_pygeodesic(name).geodesicDistance(start, end)
        assert np.array_equal(ours[[0, -1]], positions[[start, end]])
        assert length(ours) == pytest.approx(distance, rel=1e-11)
        assert length(ours) == pytest.approx(length(theirs), rel=1e-11)
        # Those of potpourri3d are straight, but not always shortest.
        assert length(ours) <= length(flips.find_geodesic_path(start, end)) * (1 + 1e-11)


def test_paths_of_a_field_lead_to_the_nearest_source():
    name, sources = "holes.off", some_vertices("holes.off", 5)
    targets = some_vertices(name, 60)
    distances, nearest = pygeodesic_distances(name, sources, targets)
    paths = exact_of(name).field(sources).paths(targets)
    assert_same(np.array([length(path.positions) for path in paths]), distances, 1e-11)
    assert np.array_equal([path.source for path in paths], nearest)


# ---------------------------------------------------------------------------------------------------------- Isolines


def potpourri3d_isolines(name, values, level):
    """The positions of each line, from vertices and points on edges."""
    positions, triangles = arrays(name)
    edges = potpourri3d.edges(positions, triangles)

    def place(element, weights):
        if not weights:
            return positions[element]
        a, b = positions[edges[element]]
        return (1 - weights[0]) * a + weights[0] * b

    lines = potpourri3d.marching_triangles(positions, triangles, values, level)
    return [np.array([place(*point) for point in line]) for line in lines]


def closed_up(curve):
    return np.vstack([curve.positions, curve.positions[:1]]) if curve.closed else curve.positions


@pytest.mark.parametrize("name", ["elephant.off", "fandisk.off", "camel.off", "holes.off", "lion-head.off"])
def test_isolines_are_those_of_potpourri3d_and_libigl(name):
    positions, triangles = arrays(name)
    source = some_vertices(name)[1]
    values = pygeodesic_row(name, source)
    levels = taut.even_levels(mesh_of(name), values, 7)
    assert_same(levels, values.max() * np.arange(1, 8) / 8, 1e-12)
    curves = taut.isolines(mesh_of(name), values, levels)
    for number, level in enumerate(levels):
        ours = [closed_up(curve) for curve in curves if curve.level == number]
        theirs = potpourri3d_isolines(name, values, level)
        assert len(ours) == len(theirs)
        assert_same(np.sort([length(line) for line in ours]), np.sort([length(line) for line in theirs]), 1e-9)
        ends, segments, _ = igl.isolines(positions, triangles, values, np.array([level]))
        total = np.linalg.norm(ends[segments[:, 0]] - ends[segments[:, 1]], axis=1).sum()
        assert sum(map(length, ours)) == pytest.approx(total, rel=1e-9)


# --------------------------------------------------------------------------------------------------- The heat method


def flat_heat(name, sources):
    """The heat method in 20 lines of scipy, on potpourri3d's cotangents and areas.

    t = mean edge², no flow at boundaries, and distances that are 0 at the sources.
    """
    positions, triangles = arrays(name)
    ends = positions[potpourri3d.edges(positions, triangles)]
    t = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean() ** 2
    stiffness = potpourri3d.cotan_laplacian(positions, triangles)
    mass = scipy.sparse.diags(potpourri3d.vertex_areas(positions, triangles))
    is_source = np.zeros(len(positions))
    is_source[sources] = 1
    heat = scipy.sparse.linalg.spsolve((mass + t * stiffness).tocsc(), is_source)

    corners = positions[triangles]
    opposite = np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normal, axis=1) / 2
    gradients = np.cross(normal[:, None] / (2 * area[:, None, None]), opposite) / (2 * area[:, None, None])
    slope = (gradients * heat[triangles][:, :, None]).sum(1)
    direction = -slope / np.linalg.norm(slope, axis=1, keepdims=True)
    flux = area[:, None] * (gradients * direction[:, None]).sum(2)

    inside = is_source == 0
    divergence = np.bincount(triangles.ravel(), flux.ravel(), len(positions))
    distances = np.zeros(len(positions))
    distances[inside] = scipy.sparse.linalg.spsolve(stiffness[inside][:, inside].tocsc(), divergence[inside])
    return distances


@pytest.mark.parametrize("name", ["elephant.off", "fandisk.off", "femur.off", "anchor_dense.off", "blade.off"])
def test_plain_heat_is_what_the_cotangents_of_potpourri3d_give(name):
    source = some_vertices(name)[1]
    field = taut.HeatSolver(mesh_of(name), laplacian="plain").field(source)
    # On other meshes the mesh's own triangles make negative heat, and what that says depends on the code.
    assert field.nonpositive_heat == 0
    # 9e-12 at most, on the needles of anchor_dense.
    assert_same(field.distances(), flat_heat(name, source), 1e-10)


def intrinsic_mean_edge(name):
    """The mean edge of the intrinsic Delaunay triangulation, by libigl; at a boundary an edge has one triangle."""
    positions, triangles = arrays(name)
    lengths, flipped = igl.intrinsic_delaunay_triangulation(igl.edge_lengths(positions, triangles), triangles)[:2]
    ends = np.sort(np.stack([np.roll(flipped, -1, 1), np.roll(flipped, -2, 1)], -1).reshape(-1, 2), axis=1)
    edges = np.unique(np.column_stack([ends, np.round(lengths.ravel() / lengths.mean(), 9)]), axis=0)
    return edges[:, 2].mean() * lengths.mean()


def heat_difference(name, **options):
    """The largest difference from potpourri3d's robust distances, as a share of the largest distance."""
    source = some_vertices(name)[1]
    theirs = potpourri3d.MeshHeatMethodDistanceSolver(*arrays(name)).compute_distance(source)
    ours = taut.HeatSolver(mesh_of(name), **options).compute_distance(source)
    reached = np.isfinite(ours)
    return np.abs(ours - (theirs - theirs[source]))[reached].max() / ours[reached].max()


# potpourri3d adds 1e-6 to the diagonal of its Laplacian and lengthens edges by 1e-5 of their mean: 1.4e-3 at most here.
# A time step a tenth too long differs by 1.8e-3 at least, one half as long again by 8e-3.
ROBUST = 1.6e-3
HEAT = [*CLOSED, *OPEN]


@pytest.mark.parametrize("name", HEAT)
def test_heat_is_that_of_potpourri3d_with_its_time_step(name):
    t = intrinsic_mean_edge(name) ** 2
    assert heat_difference(name, time_step=t) <= ROBUST
    assert heat_difference(name, time_step=1.1 * t) > ROBUST


@pytest.mark.parametrize("name", ["fandisk.off", "bull.off", "camel.off", "holes.off", "lion-head.off"])
def test_heat_on_the_triangles_of_the_mesh_is_not_that_of_potpourri3d(name):
    t = intrinsic_mean_edge(name) ** 2
    assert heat_difference(name, time_step=t, laplacian="plain") > ROBUST


@pytest.mark.parametrize("name", HEAT)
def test_heat_with_defaults_is_as_near_to_the_truth_as_potpourri3d(name):
    source = some_vertices(name)[0]
    exact = pygeodesic_row(name, source)
    away = np.isfinite(exact) & (exact > 0)
    mean_error = lambda distances: (np.abs(distances[away] - exact[away]) / exact[away]).mean()
    ours = mean_error(taut.HeatSolver(mesh_of(name)).compute_distance(source))
    theirs = mean_error(potpourri3d.MeshHeatMethodDistanceSolver(*arrays(name)).compute_distance(source))
    # Their mean edge is that of the Delaunay triangulation, up to 8 % shorter here.
    assert 0.8 < ours / theirs < 1.25
    assert ours < 0.08


@pytest.mark.parametrize("name", ["elephant.off", "fandisk.off", "bull.off", "lion-head.off"])
def test_heat_from_several_sources_is_that_of_potpourri3d(name):
    sources = some_vertices(name, 5)
    theirs = potpourri3d.MeshHeatMethodDistanceSolver(*arrays(name)).compute_distance_multisource(sources)
    t = intrinsic_mean_edge(name) ** 2
    # Only the zero of the distances differs: theirs is a mean over the sources.
    ours = taut.HeatSolver(mesh_of(name), time_step=t, shift="min").compute_distance(sources)
    assert_same(ours - ours.min(), theirs - theirs.min(), ROBUST)


@pytest.mark.parametrize("name", ["elephant.off", "fandisk.off", "camel.off", "bull.off", "holes.off", "lion-head.off"])
def test_heat_is_near_that_of_libigl(name):
    positions, triangles = arrays(name)
    source = some_vertices(name)[1]
    data = igl.HeatGeodesicsData()
    data.use_intrinsic_delaunay = True
    igl.heat_geodesics_precompute(positions, triangles, data)
    theirs = igl.heat_geodesics_solve(data, np.array([source]))
    # Both kinds of boundaries in equal parts, as libigl has them.
    t, boundary = igl.avg_edge_length(positions, triangles) ** 2, 0.0 if name in CLOSED else 0.5
    difference = lambda t: np.abs(heat(t) - (theirs - theirs[source])).max() / theirs.max()
    heat = lambda t: taut.HeatSolver(mesh_of(name), time_step=t, boundary=boundary).compute_distance(source)
    # It lumps Voronoi areas instead of thirds: 1.1e-2 at most here.
    assert difference(t) < 1.2e-2 < difference(1.5 * t)


def test_heat_knows_the_parts_of_a_mesh():
    name = "knot2.off"
    source = some_vertices(name)[1]
    exact = pygeodesic_row(name, source)
    assert np.isinf(exact).any()
    ours = taut.HeatSolver(mesh_of(name)).compute_distance(source)
    assert np.array_equal(np.isinf(ours), np.isinf(exact))


@pytest.mark.parametrize("name", ["fandisk.off", "camel.off", "holes.off"])
def test_nearest_sources_by_heat_are_right_where_it_is_clear(name):
    sources = some_vertices(name, 8)
    rows = np.array([pygeodesic_row(name, source) for source in sources])
    nearest = taut.HeatSolver(mesh_of(name)).field(sources).nearest_sources()
    first, second = np.sort(rows, axis=0)[:2]
    clear = second - first > 0.1 * rows.max()
    assert clear.mean() > 0.2
    assert np.array_equal(nearest[clear], rows.argmin(0)[clear])
