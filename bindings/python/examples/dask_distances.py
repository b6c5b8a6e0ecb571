"""Distances from many sources of one mesh, and on many meshes, spread over processes by Dask.

    pip install taut dask distributed
    python dask_distances.py bunny.obj horse.obj --sources 200 --workers 4

A solver pickles by its mesh and options, and each process prepares it once on arrival. Calls give up the interpreter lock.
Every way of spreading them gives the numbers of a loop, to the bit. On a cluster of machines the same runs with another client:

    # There `dask scheduler` has been started, and on each machine `dask worker scheduler:8786 --nworkers 8 --nthreads 1`.
    client = Client("scheduler:8786")

Without Dask, with a list of blocks of sources,

    with concurrent.futures.ThreadPoolExecutor(4) as pool:  # threads share the solver, nothing is copied
        rows = np.vstack(list(pool.map(lambda block: solver.distance_rows(block, threads=1), blocks)))

    task = joblib.delayed(block_of_rows)  # processes; joblib.parallel_config("dask") spreads over a cluster as well
    rows = np.vstack(joblib.Parallel(4)(task(solver, block) for block in blocks))

and on one machine simply `solver.distance_rows(sources)`, which uses all of its processors.
"""

import argparse

import numpy as np
from distributed import Client, LocalCluster, as_completed

import taut

BLOCK = 32


def block_of_rows(solver, sources):
    """What a worker does for one mesh: a row of distances for each of some sources, on the worker's one thread."""
    return solver.distance_rows(sources, threads=1)


def mean_distance(path, source):
    """What a worker does for one of many meshes: only the answer travels back."""
    distances = taut.HeatSolver(taut.Mesh.read(path)).compute_distance(source)
    return float(distances[np.isfinite(distances)].mean())


def distance_rows(client, solver, sources, block=BLOCK):
    """The (sources, V) distances of `solver`, in blocks of sources that the workers of `client` compute.

    The solver goes to each worker once, the blocks' sources with their tasks.
    """
    everywhere = client.scatter(solver, broadcast=True, hash=False)
    starts = {}
    for start in range(0, len(sources), block):
        future = client.submit(block_of_rows, everywhere, sources[start : start + block], pure=False)
        starts[future] = start
    rows = np.empty((len(sources), solver.mesh.vertex_count))
    done = 0
    for future in as_completed(starts):
        start = starts[future]
        try:
            result = future.result()
        except taut.Error as error:
            client.cancel(list(starts))
            # The error's index counts in its block.
            raise RuntimeError(f"among the sources from number {start} on: {error}") from error
        rows[start : start + len(result)] = result
        done += len(result)
        print(f"{done} of {len(sources)} sources", flush=True)
    return rows


def local_cluster(workers):
    """Processes of one thread each; they talk over this machine's loopback alone, and there is no dashboard."""
    return LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=True,
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        scheduler_kwargs={"dashboard": False},
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("meshes", nargs="+", help="OBJ, OFF, PLY, STL or GLB files")
    parser.add_argument("--sources", type=int, default=200, help="how many vertices of the first mesh [200]")
    parser.add_argument("--workers", type=int, default=2, help="how many processes [2]")
    options = parser.parse_args()

    mesh = taut.Mesh.read(options.meshes[0])
    sources = np.linspace(0, mesh.vertex_count - 1, options.sources, dtype=np.int64)
    solver = taut.HeatSolver(mesh)
    with local_cluster(options.workers) as cluster, Client(cluster) as client:
        rows = distance_rows(client, solver, sources)
        means = client.gather([client.submit(mean_distance, path, 0) for path in options.meshes])
    for path, mean in zip(options.meshes, means):
        print(f"{path}: on average {mean:.6g} away from vertex 0")
    print(f"the same as a loop: {np.array_equal(rows, solver.distance_rows(sources, threads=1))}")


if __name__ == "__main__":
    main()
