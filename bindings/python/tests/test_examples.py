"""The example that shows distances in polyscope; test_parallel runs the one with Dask."""

import runpy

import polyscope as ps


def test_polyscope_view(root, elephant):
    show = runpy.run_path(str(root / "bindings/python/examples/polyscope_view.py"))["show"]
    ps.init("openGL_mock")
    show(elephant)
    surface, paths = ps.get_surface_mesh("surface"), ps.get_curve_network("paths")
    assert (surface.n_vertices(), surface.n_faces()) == (elephant.vertex_count, elephant.triangle_count)
    # Eight paths, in each of which every point but the first ends a segment.
    assert paths.n_nodes() - paths.n_edges() == 8
    assert ps.get_point_cloud("ends").n_points() == 9
