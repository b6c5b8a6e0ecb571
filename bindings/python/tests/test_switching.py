"""docs/python-switching.md: each line of its table runs, and where it means the same so are the numbers."""

import importlib.util
import pathlib
import re

import numpy as np
import pytest

import taut

PAGE = (pathlib.Path(__file__).parents[3] / "docs/python-switching.md").read_text(encoding="utf-8")
HEADER, _, *ROWS = (
    [cell.strip().strip("`") for cell in line.split("|")[1:-1]] for line in PAGE.splitlines() if line.startswith("|")
)
PACKAGES = HEADER[1:]
JOBS = {row[0]: dict(zip(PACKAGES, row[1:])) for row in ROWS}
# The first block is for all, the others belong to one peer each.
COMMON, *OF_PEERS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
PREPARE = {"taut": "", **dict(zip(PACKAGES, OF_PEERS))}
CASES = [(job, package) for job, lines in JOBS.items() for package in PACKAGES if lines[package]]


def length(path):
    return np.linalg.norm(np.diff(path, axis=0), axis=1).sum()


def total_length(lines):
    """Of taut's curves, or of libigl's ends and segments."""
    if isinstance(lines, taut.Curves):
        return sum(line.length for line in lines)
    ends, segments = lines[:2]
    return np.linalg.norm(ends[segments[:, 0]] - ends[segments[:, 1]], axis=1).sum()


# What there is to compare in the results of a job, where these are not numbers that compare as they are.
NUMBERS = {
    "shortest path from 0 to 99": length,
    "all pairs within a radius, sparse": lambda matrix: matrix.toarray(),
    "isolines of a field": total_length,
    "nearest points of the surface": lambda found: found.distances if hasattr(found, "distances") else np.sqrt(found[0]),
    "reading a file": lambda mesh: mesh.positions if isinstance(mesh, taut.Mesh) else mesh[0],
}
# Others than those of 1e-10 of the largest number: the heat method of each package has its own details.
TOLERANCES = {job: 0.03 for job in JOBS if "heat" in job}


@pytest.fixture(scope="module")
def run(cgal_meshes):
    """Runs a line of the table as a package's user does who has read the page."""
    path = str(cgal_meshes / "elephant.off")
    mesh = taut.Mesh.read(path)
    common = {"mesh_positions": mesh.positions.copy(), "mesh_triangles": mesh.triangles.copy(), "path": path}
    exec(COMMON, common)

    def run(job, package):
        names = dict(common)
        exec(PREPARE[package], names)
        result = eval(JOBS[job][package], names)
        if package == "potpourri3d" and job == "isolines of a field":
            return length_on_edges(result, names)
        return NUMBERS.get(job, np.asarray)(result)

    return run


def length_on_edges(lines, names):
    """Of potpourri3d's isolines, which are points on edges."""
    ends = names["V"][names["pp"].edges(names["V"], names["F"])]
    place = lambda edge, weights: (1 - weights[0]) * ends[edge, 0] + weights[0] * ends[edge, 1]
    return sum(length([place(*point) for point in line]) for line in lines)


def test_the_table_is_whole():
    assert PACKAGES == ["potpourri3d", "pygeodesic", "libigl", "gdist", "taut"]
    assert len(OF_PEERS) == 4
    assert len(JOBS) == len(ROWS) >= 15
    assert all(JOBS[job]["taut"] for job in JOBS)


@pytest.mark.parametrize(("job", "package"), CASES, ids=[" - ".join(case) for case in CASES])
def test_a_line_of_the_table(run, job, package):
    if package == "gdist" and np.lib.NumpyVersion(np.__version__) >= "2.0.0":
        pytest.skip("gdist 2.1 was built for numpy 1")
    module = {"libigl": "igl"}.get(package, package)
    if importlib.util.find_spec(module) is None:
        pytest.skip(f"{package} is not installed")
    numbers = run(job, package)
    assert np.size(numbers)
    ours = run(job, "taut")
    assert np.shape(numbers) == np.shape(ours)
    assert np.abs(numbers - ours).max() <= TOLERANCES.get(job, 1e-10) * np.abs(ours).max()
