"""Meshes for the tests: real ones of Debian's libcgal-demo, and shapes whose distances are known."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import tarfile

import numpy as np
import pytest

import taut

CGAL_DEMO = "/usr/share/doc/libcgal-dev/data.tar.gz"
ROOT = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def root() -> pathlib.Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def cgal_meshes(tmp_path_factory):
    """A folder with real meshes: elephant.off, fandisk.off, camel.off, bunny00.off."""
    folder = tmp_path_factory.mktemp("cgal")
    wanted = {f"data/meshes/{name}.off" for name in ("elephant", "fandisk", "camel", "bunny00")}
    with tarfile.open(CGAL_DEMO) as archive:
        for member in archive:
            if member.name in wanted:
                (folder / pathlib.PurePath(member.name).name).write_bytes(archive.extractfile(member).read())
    return folder


@pytest.fixture(scope="session")
def elephant(cgal_meshes):
    return taut.Mesh.read(cgal_meshes / "elephant.off")


@pytest.fixture(scope="session")
def bunny(cgal_meshes):
    """A large mesh: 75,000 triangles."""
    return taut.Mesh.read(cgal_meshes / "bunny00.off")


def corpus() -> list[pathlib.Path]:
    """Further real meshes, where they are at hand."""
    folder = pathlib.Path(os.environ.get("TAUT_CORPUS", ROOT.parent / "shared/meshes"))
    names = ["beetle_lowres_nm", "cube_40k_nm", "many_small_holes", "boeing_soup", "bunny_stanford_unref", "tet"]
    return [path for path in sorted(folder.glob("*.*")) if path.name.split(".")[0] in names]


@pytest.fixture
def square():
    """The unit square, cut from vertex 1 to vertex 3."""
    return taut.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 3), (1, 2, 3)])


def grid_arrays(n: int) -> tuple[np.ndarray, np.ndarray]:
    """The unit square as n x n squares of two triangles each, tilted in space; vertex i (n + 1) + j is at (i, j) / n."""
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    flat = np.column_stack([i.ravel(), j.ravel()]) / n
    across = np.array([(2, 2, 1), (-2, 1, 2)]) / 3  # two unit vectors at a right angle
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    lower = np.column_stack([corner, corner + n + 1, corner + n + 2])
    upper = np.column_stack([corner, corner + n + 2, corner + 1])
    return flat @ across, np.concatenate([lower, upper])


@pytest.fixture(scope="session")
def grid():
    """A flat square of 2 x 20 x 20 triangles: distances are straight."""
    return taut.Mesh(*grid_arrays(20))


@pytest.fixture
def run_python():
    """Runs a program in a Python of its own; keyword arguments are added to its environment."""

    def run(program: str, **environment: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-X", "dev", "-c", program]
        return subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True, timeout=60)

    return run
