"""The declarations of C in _native.py are those of the header: the C++ compiler compares them, type by type."""

import ctypes
import re
import shutil
import subprocess

import pytest

import taut
from taut import _native

# Types without names of numbers: integers by size and sign, enums as integers, nothing const.
PRELUDE = """
#include <taut.h>
#include <cstddef>
#include <type_traits>

template <std::size_t size, bool is_signed> struct integer {};
template <class T, class = void> struct plain { using type = T; };
template <class T> using plain_t = typename plain<std::remove_const_t<T>>::type;
template <class T> struct plain<T, std::enable_if_t<std::is_integral_v<T> && !std::is_same_v<T, bool> &&
                                                    !std::is_same_v<T, char>>> {
    using type = integer<sizeof(T), std::is_signed_v<T>>;
};
template <class T> struct plain<T, std::enable_if_t<std::is_enum_v<T>>> { using type = plain_t<std::underlying_type_t<T>>; };
template <class T> struct plain<T *> { using type = plain_t<T> *; };
template <class R, class... A> struct plain<R(A...)> { using type = plain_t<R>(plain_t<A>...); };
"""


def cpp(kind) -> str:
    """A ctypes type as the prelude writes it."""
    if kind is None:
        return "void"
    if kind is ctypes.c_char_p:
        return "char *"
    if kind is ctypes.c_void_p:
        return "void *"
    if kind is ctypes.c_bool:
        return "bool"
    if kind is ctypes.c_double:
        return "double"
    if issubclass(kind, ctypes.Structure):
        return kind.__name__
    if issubclass(kind, ctypes._Pointer):
        return cpp(kind._type_) + " *"
    if issubclass(kind, ctypes._CFuncPtr):
        return function(kind._restype_, kind._argtypes_)
    is_signed = kind(-1).value < 0
    return f"integer<{ctypes.sizeof(kind)}, {str(is_signed).lower()}>"


def function(returned, parameters) -> str:
    return f"std::add_pointer_t<{cpp(returned)}({', '.join(map(cpp, parameters))})>"


def same(one: str, other: str) -> str:
    return f"static_assert(std::is_same_v<{one}, {other}>);"


def enums() -> dict[str, int]:
    """Every constant that _native.py has, by its name in C."""
    values = {"TAUT_ABI": _native.TAUT_ABI, "TAUT_MAX_LEVELS": _native.TAUT_MAX_LEVELS}
    for words in vars(_native).values():
        if isinstance(words, type) and issubclass(words, _native.IntEnum) and words is not _native.IntEnum:
            prefix = "TAUT" + re.sub("([A-Z])", r"_\1", words.__name__).upper()
            values |= {f"{prefix}_{word.name}": word.value for word in words}
    return values


def structs() -> list[type[ctypes.Structure]]:
    return [kind for name, kind in vars(_native).items() if name.startswith("taut_") and hasattr(kind, "_fields_")]


@pytest.fixture(scope="module")
def header(root) -> str:
    """The header without comments."""
    text = (root / "include/taut.h").read_text()
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)


def test_declarations_compile(root, tmp_path):
    lines = [PRELUDE]
    for name, (returned, *parameters) in _native.PROTOTYPES.items():
        lines.append(same(f"plain_t<decltype({name}) *>", function(returned, parameters)))
    for kind in structs():
        name = kind.__name__
        lines.append(f"static_assert(sizeof({name}) == {ctypes.sizeof(kind)});")
        for field, field_kind in kind._fields_:
            lines.append(f"static_assert(offsetof({name}, {field}) == {getattr(kind, field).offset});")
            lines.append(same(f"plain_t<decltype({name}::{field})>", cpp(field_kind)))
    lines += [f"static_assert({name} == {value});" for name, value in enums().items()]
    source = tmp_path / "declarations.cpp"
    source.write_text("\n".join(lines))
    compiler = shutil.which("g++") or shutil.which("c++")
    command = [compiler, "-std=c++17", "-fsyntax-only", "-I", root / "include", source]
    compiled = subprocess.run(command, capture_output=True, text=True)
    assert compiled.returncode == 0, compiled.stderr


def test_every_function_is_declared(root):
    assert sorted(_native.PROTOTYPES) == (root / "include/taut.symbols").read_text().split()


def test_every_constant_is_there(header):
    in_header = set(re.findall(r"\bTAUT_[A-Z0-9_]+\b", header))
    assert in_header - set(enums()) == {"TAUT_H", "TAUT_VERSION_MAJOR", "TAUT_VERSION_MINOR", "TAUT_VERSION_PATCH"}
    assert set(enums()) <= in_header


def test_every_struct_is_there(header):
    bodies = {name: body for body, name in re.findall(r"typedef struct \{(.*?)\}\s*(\w+);", header, re.DOTALL)}
    opaque = re.findall(r"typedef struct (\w+) \1;", header)
    fields = {kind.__name__: re.findall(r"\w+", " ".join(name for name, _ in kind._fields_)) for kind in structs()}
    assert {name: re.findall(r"(\w+);", body) for name, body in bodies.items()} == fields
    assert all(issubclass(getattr(_native, name), ctypes.Structure) for name in opaque)


def test_versions(root):
    version = re.search(r'^version = "(.*?)"', (root / "Cargo.toml").read_text(), re.MULTILINE).group(1)
    assert taut.__version__ == taut.library_version() == version


def test_a_library_of_another_interface_is_refused(tmp_path, run_python):
    source = tmp_path / "other.c"
    source.write_text("unsigned taut_abi(void) { return 99; }")
    other = tmp_path / "libother.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", other, source], check=True)
    told = run_python("import taut", TAUT_LIBRARY=str(other))
    assert told.returncode == 1
    assert f"ImportError: the library {other} has the interface 99, this package needs {_native.TAUT_ABI}" in told.stderr


@pytest.mark.parametrize("content", [None, b"", b"no library"])
def test_a_library_that_is_none_is_refused(tmp_path, run_python, content):
    path = tmp_path / "libtaut.so"
    if content is not None:
        path.write_bytes(content)
    told = run_python("import taut", TAUT_LIBRARY=str(path))
    assert told.returncode == 1
    assert f"ImportError: taut cannot load its library {path}" in told.stderr


def test_a_library_without_the_functions_is_refused(run_python):
    told = run_python("import taut", TAUT_LIBRARY="libc.so.6")
    assert "ImportError: taut cannot load its library libc.so.6" in told.stderr
