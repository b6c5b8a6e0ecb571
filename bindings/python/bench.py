"""What Python adds to the calls of the library, beside its peers: bench.py MESH [MESH ...] [--runs N]

Each line is a call: the user time in Python, that of the same functions of C called with arguments that are ready, the
difference, and for distances the time of pygeodesic and potpourri3d where they are installed, all in one run. Medians of
interleaved runs on one thread; set-up is not counted. The small calls are the mean of a thousand.
"""

import argparse
import statistics
import time

import numpy as np

import taut
from taut import _native
from taut._buffers import output
from taut._handle import made
from taut.sources import Sources, pointer_to


def by_c(solver, field, new, distances):
    """Distances from vertex 0 by the functions of C alone."""
    sources, out = pointer_to(Sources(0)), np.empty(solver.mesh.vertex_count)
    buffer = output(out)

    def call():
        handle = made(field, new, solver._pointer, sources, *([None] * (len(new.argtypes) - 3)))
        distances(handle.pointer, *([None] * (len(distances.argtypes) - 2)), buffer)

    return call


def large_calls(mesh, library):
    """The name of each call, in Python, in C, and by the peers."""
    exact, heat = taut.ExactSolver(mesh), taut.HeatSolver(mesh)
    positions, triangles = np.array(mesh.positions), np.array(mesh.triangles)
    peers = {"exact distances": {}, "heat distances": {}}
    try:
        from pygeodesic import geodesic

        kirsanov = geodesic.PyGeodesicAlgorithmExact(positions, triangles.astype(np.int32))
        peers["exact distances"]["pygeodesic"] = lambda: kirsanov.geodesicDistances(np.array([0], np.int32))
    except ImportError:
        pass
    try:
        import potpourri3d

        robust = potpourri3d.MeshHeatMethodDistanceSolver(positions, triangles)
        peers["heat distances"]["potpourri3d"] = lambda: robust.compute_distance(0)
    except ImportError:
        pass
    exact_c = by_c(exact, _native.taut_exact_field, library.taut_exact_field_new, library.taut_exact_field_distances)
    heat_c = by_c(heat, _native.taut_heat_field, library.taut_heat_field_new, library.taut_heat_field_distances)
    yield "exact distances", lambda: exact.compute_distance(0), exact_c, peers["exact distances"]
    yield "heat distances", lambda: heat.compute_distance(0), heat_c, peers["heat distances"]


def small_calls():
    """Calls whose work in C is nothing."""
    square = taut.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 3), (1, 2, 3)])
    exact, heat, closest = taut.ExactSolver(square), taut.HeatSolver(square), taut.Closest(square)
    field, values, point = exact.field(0), np.arange(4.0), np.zeros((1, 3))
    positions, triangles = np.array(square.positions), np.array(square.triangles)
    pointer, out = field._pointer, output(np.empty(4))
    return {
        "one function of C through ctypes": lambda: _native.library.taut_exact_field_distances(pointer, None, out),
        "mesh.vertex_count": lambda: square.vertex_count,
        "field.distances()": field.distances,
        "taut.Mesh(positions, triangles)": lambda: taut.Mesh(positions, triangles),
        "exact.compute_distance(0)": lambda: exact.compute_distance(0),
        "heat.compute_distance(0)": lambda: heat.compute_distance(0),
        "exact.find_geodesic_path(2, 0)": lambda: exact.find_geodesic_path(2, 0),
        "closest.points(point)": lambda: closest.points(point),
        "taut.isolines(mesh, values, 0.5)": lambda: taut.isolines(square, values, 0.5),
    }


def user_time(call, times=1):
    start = time.process_time()
    for _ in range(times):
        call()
    return (time.process_time() - start) / times


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", metavar="MESH")
    parser.add_argument("--runs", type=int, default=9, help="of each large call [9]")
    options = parser.parse_args()
    print("| mesh | triangles | call | Python, ms | C, ms | added, ms | peer, ms |", "|---" * 7 + "|", sep="\n")
    for path in options.meshes:
        mesh = taut.Mesh.read(path)
        for name, python, c, peers in large_calls(mesh, _native.library):
            calls = {"python": python, "c": c, **peers}
            runs = {key: [] for key in calls}
            for _ in range(options.runs):
                for key, call in calls.items():
                    runs[key].append(1000 * user_time(call))
            median = {key: statistics.median(times) for key, times in runs.items()}
            added = statistics.median(np.subtract(runs["python"], runs["c"]))
            others = ", ".join(f"{peer} {median[peer]:.1f}" for peer in peers)
            numbers = f"{median['python']:.3f} | {median['c']:.3f} | {added:+.3f} | {others}"
            print(f"| {path.rsplit('/', 1)[-1]} | {mesh.triangle_count} | {name} | {numbers} |")
    print("\n| small call | µs |", "|---|---|", sep="\n")
    for name, call in small_calls().items():
        print(f"| `{name}` | {1e6 * statistics.median(user_time(call, 1000) for _ in range(options.runs)):.1f} |")


if __name__ == "__main__":
    main()
