"""The wheel, the types, and what the pages say."""

import importlib.util
import os
import re
import subprocess
import sys
import sysconfig
import zipfile

import pytest

import taut
from taut import _native



@pytest.fixture(scope="module")
def project(root):
    return root / "bindings/python"


@pytest.fixture(scope="module")
def wheel(project, tmp_path_factory):
    """The wheel, with the library that these tests run on; it is made without the network."""
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "-w", folder, project]
    subprocess.run(command, check=True, env={**os.environ, "TAUT_LIBRARY": _native.library._name})
    (path,) = folder.iterdir()
    return path


def test_what_is_in_the_wheel(wheel, root, project):
    version = taut.library_version()
    with zipfile.ZipFile(wheel) as content:
        names = content.namelist()
        assert content.read("taut/libtaut.so").startswith(b"\x7fELF")
        for name in ("LICENSE-MIT", "LICENSE-APACHE", "THIRD-PARTY.txt"):
            assert content.read(f"taut-{version}.dist-info/licenses/{name}") == (root / name).read_bytes()
        metadata = content.read(f"taut-{version}.dist-info/METADATA").decode()
    modules = {f"taut/{path.name}" for path in (project / "src/taut").glob("*.py")}
    assert modules | {"taut/py.typed", "taut/libtaut.so"} == {name for name in names if name.startswith("taut/")}
    assert f"Version: {version}\n" in metadata
    assert "License-Expression: MIT OR Apache-2.0\n" in metadata


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux names a glibc")
def test_the_wheel_names_the_glibc_that_it_needs(wheel):
    told = subprocess.run(["readelf", "-V", _native.library._name], capture_output=True, text=True, check=True)
    newest = max(int(minor) for minor in re.findall(r"Name: GLIBC_2\.(\d+)", told.stdout))
    machine = re.sub("[-.]", "_", sysconfig.get_platform()).partition("_")[2]
    assert wheel.name == f"taut-{taut.library_version()}-py3-none-manylinux_2_{newest}_{machine}.whl"


def test_the_wheel_serves_on_its_own(wheel, tmp_path, run_python):
    with zipfile.ZipFile(wheel) as content:
        content.extractall(tmp_path)
    program = "import taut; print(taut.__file__, taut.Mesh([], []).vertex_count)"
    told = run_python(program, TAUT_LIBRARY="", PYTHONPATH=str(tmp_path))
    assert told.stdout == f"{tmp_path}/taut/__init__.py 0\n", told.stderr


def test_the_hook_takes_what_cargo_builds(project, tmp_path, monkeypatch):
    specification = importlib.util.spec_from_file_location("hatch_build", project / "hatch_build.py")
    hook = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(hook)
    monkeypatch.delenv("TAUT_LIBRARY", raising=False)
    assert f"{{TAUT_CARGO}} {' '.join(hook.CARGO[1:])}," in (project.parents[1] / "CMakeLists.txt").read_text()
    monkeypatch.setattr(hook, "CARGO", [sys.executable, "-c", "import sys; print(sys.argv)"])
    assert hook.library(tmp_path, "libtaut.so") == tmp_path / "target/release/libtaut.so"


def mypy(*arguments):
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--cache-dir", os.devnull, *arguments]
    return subprocess.run(command, capture_output=True, text=True)


def test_types(project):
    checked = mypy("--config-file", project / "pyproject.toml", project / "src/taut")
    assert checked.returncode == 0, checked.stdout


def test_types_of_a_program(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "import numpy as np\n"
        "import taut\n"
        "mesh = taut.Mesh(np.zeros((3, 3)), [[0, 1, 2]])\n"
        "paths: taut.Curves = taut.ExactSolver(mesh).field(0).paths([1, 2])\n"
        "length: float = paths[0].length + taut.HeatSolver(mesh, time_step='sigma').time_step\n"
        "taut.HeatSolver(mesh, boundary='no')\n"
    )
    checked = mypy("--strict", program)
    assert checked.stdout.count("error") == 2, checked.stdout  # the last line's, and their number
    assert ":6: error" in checked.stdout


def blocks(path):
    """The Python code of a page, as one program: each block goes on from those before."""
    return "\n".join(re.findall(r"^```python\n(.*?)^```", path.read_text(), re.MULTILINE | re.DOTALL))


@pytest.mark.parametrize("page", ["README.md", "bindings/python/README.md", "docs/python.md"])
def test_code_of_the_pages_runs(root, cgal_meshes, tmp_path, page, run_python):
    program = blocks(root / page)
    assert program or page == "README.md"
    (tmp_path / "elephant.off").symlink_to(cgal_meshes / "elephant.off")
    (tmp_path / "data").symlink_to(root / "data")
    told = run_python(f"import os; os.chdir({str(tmp_path)!r})\n{program}")
    assert told.returncode == 0, told.stderr
    said = re.findall(r"print\(.*\)  # (.+)", program)
    assert told.stdout.splitlines()[: len(said)] == said


def test_examples_in_docstrings():
    import doctest

    failed = attempted = 0
    for module in [taut, *(vars(taut)[name] for name in ("mesh", "heat", "sources"))]:
        result = doctest.testmod(module, extraglobs={"taut": taut})
        failed, attempted = failed + result.failed, attempted + result.attempted
    assert failed == 0
    assert attempted >= 8


def test_everything_public_is_described():
    for name in taut.__all__:
        thing = getattr(taut, name)
        if isinstance(thing, type):
            assert thing.__doc__, name
            for part, member in vars(thing).items():
                is_described = part.startswith("_") or not (callable(member) or isinstance(member, property))
                assert is_described or member.__doc__, f"{name}.{part}"
        elif callable(thing):
            assert thing.__doc__, name
