"""A peer that is a Python package, as scripts/bench-peers calls a program:

    package.py PEER POSITIONS TRIANGLES SOURCE DISTANCES

POSITIONS (64-bit floats) and TRIANGLES (32-bit indices) are raw numbers, three to a row.
"""
import pathlib
import statistics
import sys
import time

import numpy as np


def memory(name):
    """A line of this process's status, in MB of 10^6 bytes."""
    for line in pathlib.Path("/proc/self/status").read_text().splitlines():
        if line.startswith(name):
            return int(line.split()[1]) * 1024 / 1e6
    return float("nan")


# Each peer: how to prepare the mesh, and how to solve with what that returned.


def pygeodesic(positions, triangles, source):
    from pygeodesic import geodesic
    prepare = lambda: geodesic.PyGeodesicAlgorithmExact(positions, triangles)
    return prepare, lambda algorithm: algorithm.geodesicDistances(np.array([source], np.int32))[0]


def libigl(positions, triangles, source):
    import igl
    triangles, from_vertex, to = triangles.astype(np.int64), np.array([source]), np.arange(len(positions))
    return lambda: None, lambda _: igl.exact_geodesic(V=positions, F=triangles, VS=from_vertex, VT=to)


def libigl_heat(intrinsic):
    def peer(positions, triangles, source):
        import igl
        triangles, sources = triangles.astype(np.int64), np.array([source])

        def prepare():
            data = igl.HeatGeodesicsData()
            data.use_intrinsic_delaunay = intrinsic
            igl.heat_geodesics_precompute(positions, triangles, data)
            return data
        return prepare, lambda data: igl.heat_geodesics_solve(data, sources)
    return peer


def potpourri3d(robust):
    def peer(positions, triangles, source):
        import potpourri3d as package
        prepare = lambda: package.MeshHeatMethodDistanceSolver(positions, triangles, use_robust=robust)
        return prepare, lambda solver: solver.compute_distance(source)
    return peer


# Each peer and how often it solves; the first solve does not count where others follow.
PEERS = {
    "pygeodesic": (pygeodesic, 1),
    "libigl": (libigl, 1),
    "potpourri3d-robust": (potpourri3d(robust=True), 6),
    "potpourri3d-plain": (potpourri3d(robust=False), 6),
    "libigl-plain": (libigl_heat(intrinsic=False), 6),
    "libigl-intrinsic": (libigl_heat(intrinsic=True), 6),
}


def main(name, positions, triangles, source, out):
    peer, solves = PEERS[name]
    positions = np.fromfile(positions).reshape(-1, 3)
    triangles = np.fromfile(triangles, np.int32).reshape(-1, 3)
    prepare, solve = peer(positions, triangles, int(source))
    with_mesh = memory("VmRSS")
    pathlib.Path("/proc/self/clear_refs").write_text("5")  # the peak starts anew
    start = time.process_time()
    prepared = prepare()
    setup = time.process_time() - start
    times = []
    for _ in range(solves):
        start = time.process_time()
        distances = solve(prepared)
        times.append(time.process_time() - start)
    print(setup, statistics.median(times[1:] or times), memory("VmHWM") - with_mesh)
    np.savetxt(out, distances, "%.17g")


main(*sys.argv[1:])
