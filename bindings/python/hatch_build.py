"""Puts the library into the wheel: the one that TAUT_LIBRARY names, else what cargo builds.

The wheel has no code that is compiled against Python: one serves every Python from 3.9 on, on one platform. On Linux its tag
names the oldest glibc that has all that the library asks for.
"""

from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NAMES = {"win32": "taut.dll", "darwin": "libtaut.dylib"}
CARGO = ["cargo", "rustc", "-p", "taut", "--lib", "--release", "--locked", "--crate-type", "cdylib"]


class LibraryHook(BuildHookInterface[Any]):
    """Adds the library to the wheel, and the platform to its name."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by hatchling before it builds; `version` is "standard" or "editable"."""
        name = NAMES.get(sys.platform, "libtaut.so")
        source = library(pathlib.Path(self.root, "../..").resolve(), name)
        if version == "editable":
            shutil.copyfile(source, pathlib.Path(self.root, "src/taut", name))
        else:
            self.folder = tempfile.mkdtemp()
            stripped = pathlib.Path(self.folder, name)
            without_debug_information(source, stripped)
            build_data["force_include"][str(stripped)] = f"taut/{name}"
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{platform_tag(source)}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Called by hatchling after it has built."""
        if version != "editable":
            shutil.rmtree(self.folder)


def library(root: pathlib.Path, name: str) -> pathlib.Path:
    """The library that goes into the wheel, built if need be."""
    given = os.environ.get("TAUT_LIBRARY")
    if given:
        return pathlib.Path(given)
    subprocess.run([*CARGO, "--target-dir", "target"], cwd=root, check=True)
    return root / "target/release" / name


def without_debug_information(source: pathlib.Path, target: pathlib.Path) -> None:
    """Copy a library; where `strip` is at hand without its debug information, four fifths of the bytes."""
    if shutil.which("strip"):
        subprocess.run(["strip", "-S", "-o", target, source], check=True)
    else:
        shutil.copyfile(source, target)


def platform_tag(source: pathlib.Path) -> str:
    """The platform that a library runs on, as wheels name it."""
    platform = re.sub("[-.]", "_", sysconfig.get_platform())
    versions = re.findall(rb"GLIBC_2\.(\d+)", source.read_bytes())
    if not platform.startswith("linux_") or not versions:
        return platform
    return platform.replace("linux", f"manylinux_2_{max(map(int, versions))}", 1)
