"""Looks at distances in polyscope: python polyscope_view.py MESH [PICTURE.png]

From one end of the mesh: distances, with stripes a fortieth of the largest wide, and the shortest paths to eight vertices
that are spread over the surface. With PICTURE it draws without a window. Needs `pip install polyscope taut`.
"""

from __future__ import annotations

import sys

import numpy as np
import polyscope as ps
import taut

INK = (0.9, 0.1, 0.15)


def show(mesh: taut.Mesh) -> None:
    """Register the surface, its distances and the paths."""
    # polyscope frames all vertices, also those that no face uses.
    used, corners = np.unique(mesh.triangles, return_inverse=True)
    points = mesh.positions[used]
    longest = np.ptp(points, axis=0).argmax()
    source = used[points[:, longest].argmax()]

    exact = taut.ExactSolver(mesh)
    field = exact.field(source)
    distances = field.distances()[used]
    largest = distances[np.isfinite(distances)].max()
    surface = ps.register_surface_mesh("surface", points, corners.reshape(-1, 3), smooth_shade=True)
    shown = np.minimum(distances, largest)
    surface.add_distance_quantity("distance", shown, enabled=True, stripe_size=largest / 40, stripe_size_relative=False)

    spread, _ = exact.farthest_points(source, 8)
    paths = field.paths(spread)
    starts = paths.offsets[:-1][np.diff(paths.offsets) > 0]
    follows = np.setdiff1d(np.arange(len(paths.positions)), starts)
    segments = np.column_stack([follows - 1, follows])
    ps.register_curve_network("paths", paths.positions, segments, color=INK, radius=0.003)
    ends = np.vstack([mesh.positions[source], paths.positions[starts]])
    ps.register_point_cloud("ends", ends, color=INK, radius=0.009)


def main(path: str, picture: str | None = None) -> None:
    """Show a mesh in a window or draw it."""
    ps.set_allow_headless_backends(picture is not None)
    ps.set_ground_plane_mode("shadow_only")
    ps.set_SSAA_factor(4)
    ps.set_window_size(960, 720)
    ps.init()
    show(taut.Mesh.read(path))
    if picture is None:
        ps.show()
    else:
        ps.screenshot(picture, transparent_bg=False)


if __name__ == "__main__":
    main(*sys.argv[1:])
