"""What the operators compute, by Taut. It knows nothing of Blender, so it may run on any thread."""

from dataclasses import dataclass

import numpy as np

from . import taut
from .surface import Problem


@dataclass
class Watch:
    """What a call is at, told to other threads, and the control to cancel it."""

    control: taut.Control
    stage: str = ""


@dataclass(frozen=True)
class Solver:
    """How to compute distances."""

    method: str  # HEAT or EXACT
    time_step: taut.TimeStep
    boundary: float
    laplacian: str

    def field(self, mesh, sources, watch):
        """The distances from all sources together."""
        if self.method == "EXACT":
            watch.stage = "Exact distances"
            return taut.ExactSolver(mesh).field(sources, control=watch.control)
        watch.stage = "Preparing heat"
        options = {"time_step": self.time_step, "boundary": self.boundary, "laplacian": self.laplacian}
        heat = taut.HeatSolver(mesh, **options, control=watch.control)
        watch.stage = "Distances by heat"
        return heat.field(sources, control=watch.control)


def mesh_of(surface, space):
    """The mesh in the space, WORLD or LOCAL, in which lengths are measured."""
    return taut.Mesh(surface.world(surface.positions) if space == "WORLD" else surface.positions, surface.triangles)


def sources_of(surface, places, watch):
    """Vertices, faces by their centres, points by the nearest place on the surface, as it is seen in the world."""
    faces, barycentrics = _centres(surface, places, watch)
    if len(places.points):
        closest = _closest(surface, surface.triangles, places.points, watch)
        faces, barycentrics = closest.faces, closest.barycentrics
    return taut.Sources(places.vertices, faces=faces, barycentrics=barycentrics)


def _closest(surface, triangles, points, watch):
    watch.stage = "Nearest place"
    return taut.Closest(taut.Mesh(surface.world(surface.positions), triangles)).points(points, control=watch.control)


def _centres(surface, places, watch):
    """The place of each face that is nearest to its centre: a bent or concave face may not contain its centre."""
    if len(places.faces) == 0:
        return (), ()
    own = np.flatnonzero(np.isin(surface.faces, places.faces))
    closest = _closest(surface, surface.triangles[own], surface.world(places.face_centres), watch)
    return own[closest.faces], closest.barycentrics


def explained(error, surface, places):
    """The library's message, and what it is about in Blender's terms."""
    names = {
        "face": ("face", surface.faces),
        "source": ("vertex", places.vertices) if len(places.vertices) else ("face", places.faces),
        "point": ("vertex", places.vertices),
    }
    noun, indices = names.get(error.element, ("", ()))
    return f"{error} ({noun} {indices[error.index]})" if error.element in names and error.index < len(indices) else str(error)


def distances(surface, places, space, solver, watch):
    """The distance of each vertex: (V,) float64, inf where no source reaches."""
    mesh = mesh_of(surface, space)
    return solver.field(mesh, sources_of(surface, places, watch), watch).distances()


def cells(surface, places, centres, space, solver, watch):
    """The nearest source of each vertex and of each face, -1 where none reaches.

    A face belongs to the source with the shortest way to its centre through one of its corners.
    """
    mesh = mesh_of(surface, space)
    field = solver.field(mesh, sources_of(surface, places, watch), watch)
    return field.nearest_sources(), _of_faces(surface, mesh.positions, centres, space, field)


def _of_faces(surface, positions, centres, space, field):
    measured = surface.world(centres) if space == "WORLD" else centres.astype(np.float64)
    corners = surface.triangles
    ways = np.linalg.norm(positions[corners] - measured[surface.faces][:, None], axis=2) + field.distances()[corners]
    # The triangles of a face follow each other: sorted by face and then by way, the first is the shortest.
    corner = ways.argmin(axis=1)
    row = np.arange(len(corners))
    order = np.lexsort((ways[row, corner], surface.faces))
    first = order[np.searchsorted(surface.faces, np.arange(surface.face_count))]
    return field.nearest_sources()[corners[first, corner[first]]]


def path(surface, places, is_ordered, space, watch):
    """The shortest path through a point, if there is one, and vertices: its points in the object's space, and its length.

    In the vertices' order, or always on to the nearest one that is left.
    """
    mesh = mesh_of(surface, space)
    exact = taut.ExactSolver(mesh)
    if len(places.points):
        point = _closest(surface, surface.triangles, places.points, watch)
        start = taut.Sources(faces=point.faces, barycentrics=point.barycentrics)
    else:
        start = taut.Sources(places.vertices[:1])
    faces, barycentrics = _as_points(surface, places.vertices)
    if not is_ordered:
        order = _by_nearness(exact, start, places.vertices, watch)
        faces, barycentrics = faces[order], barycentrics[order]
    watch.stage = "Shortest path"
    faces, barycentrics = np.append(start.faces, faces), np.append(start.barycentrics, barycentrics, axis=0)
    curve = exact.curve_through(faces, barycentrics, control=watch.control)[0]
    local = taut.Mesh(surface.positions, surface.triangles)
    return local.point_positions(curve.faces, curve.barycentrics), curve.length


def _by_nearness(exact, start, vertices, watch):
    """The places of the vertices in the order in which the path goes through them."""
    watch.stage = "Order of the points"
    left, order = np.arange(len(vertices)), []
    while len(left):
        ways = exact.field(start, targets=vertices[left], control=watch.control).distances(vertices[left])
        nearest = ways.argmin()
        if np.isinf(ways[nearest]):
            raise Problem(f"no way leads to vertex {vertices[left[nearest]]}")
        order.append(left[nearest])
        start = taut.Sources(vertices[order[-1]])
        left = np.delete(left, nearest)
    return np.array(order, np.int64)


def _as_points(surface, vertices):
    """Vertices as points of a triangle each, the first that there is."""
    corner = np.full(len(surface.positions), -1, np.int64)
    corner[surface.triangles.ravel()[::-1]] = np.arange(surface.triangles.size)[::-1]
    found = corner[vertices]
    if (found < 0).any():
        raise Problem(f"vertex {vertices[found < 0][0]} belongs to no face")
    return found // 3, np.eye(3)[found % 3]


def spread(surface, vertices, count, space, watch):
    """So many vertices, evenly spread, the given ones among them; without these the first one of a face begins."""
    start = vertices if len(vertices) else surface.triangles.ravel()[:1]
    watch.stage = "Farthest points"
    exact = taut.ExactSolver(mesh_of(surface, space))
    found, _ = exact.farthest_points(start, max(count - len(start), 0), control=watch.control)
    return np.append(start, found[found != taut.none])


def isolines(surface, values, count, spacing, watch):
    """Lines of a value at each vertex: so many levels or, if `count` is None, so far apart. Curves, and the levels."""
    watch.stage = "Isolines"
    mesh = taut.Mesh(surface.positions, surface.triangles)
    levels = taut.spaced_levels(mesh, values, spacing) if count is None else taut.even_levels(mesh, values, count)
    return taut.isolines(mesh, values, levels), levels
