"""Arrays reach C where they lie; only what C cannot read is converted, once."""

import tracemalloc

import numpy as np
import pytest
from conftest import grid_arrays

import taut
from taut._buffers import input_indices, input_reals

REALS = ["f4", "f8"]
INDICES = ["u2", "u4", "u8", "i4", "i8"]


def with_gap(array):
    """The same numbers with other memory between the rows."""
    wide = np.full((len(array), *(size + 2 for size in array.shape[1:])), 77, array.dtype)
    if array.ndim == 1:
        wide = np.full(3 * len(array), 77, array.dtype)
        wide[::3] = array
        return wide[::3]
    wide[:, : array.shape[1]] = array
    return wide[:, : array.shape[1]]


def misaligned(array):
    """The same numbers at an odd address."""
    memory = np.empty(array.nbytes + 1, np.uint8)
    view = memory[1:].view(array.dtype).reshape(array.shape)
    view[...] = array
    return view


def in_records(array):
    """The same rows as a field of records, between fields of other types."""
    records = np.zeros(len(array), [("tag", "u1"), ("row", array.dtype, array.shape[1:]), ("more", "f4")])
    records["row"] = array
    return records["row"]


def read_only(array):
    array.flags.writeable = False
    return array


IN_PLACE = [lambda a: a, with_gap, misaligned, in_records, read_only]
CONVERTED = [
    np.asfortranarray,  # of more than one column
    lambda a: a[::-1].copy()[::-1],
    lambda a: a.astype(a.dtype.newbyteorder()),
    lambda a: a.tolist(),
]


@pytest.mark.parametrize("lay", IN_PLACE)
@pytest.mark.parametrize("kind", REALS + INDICES)
@pytest.mark.parametrize("width", [None, 3])
def test_c_gets_the_array_itself(kind, width, lay):
    array = lay(np.arange(12).reshape(4, 3).astype(kind) if width else np.arange(12).astype(kind))
    view = (input_reals if kind in REALS else input_indices)(array, "rows", width)
    assert view.data == array.ctypes.data
    assert view.count == len(array)
    assert view.stride == array.strides[0]


@pytest.mark.parametrize("lay", CONVERTED)
@pytest.mark.parametrize("kind", REALS + INDICES)
def test_other_layouts_are_converted(kind, lay):
    wanted = np.arange(12).reshape(4, 3).astype(kind)
    array = lay(wanted)
    view = (input_reals if kind in REALS else input_indices)(array, "rows", 3)
    assert view.array.flags.c_contiguous
    assert not isinstance(array, np.ndarray) or view.data != array.ctypes.data
    np.testing.assert_array_equal(view.array, wanted)


def test_a_row_repeated_by_broadcasting_is_converted():
    view = input_reals(np.broadcast_to(np.arange(3.0), (4, 3)), "rows", 3)
    np.testing.assert_array_equal(view.array, [[0, 1, 2]] * 4)
    assert view.stride == 24


@pytest.mark.parametrize("kind", ["i1", "i2", "u1", ">i4", ">u8"])
def test_other_integers_are_converted(kind):
    view = input_indices(np.arange(3).astype(kind), "rows")
    assert view.array.dtype == np.int64
    np.testing.assert_array_equal(view.array, [0, 1, 2])


@pytest.mark.parametrize("data", [[0.0, 1.0], ["a"], [True], [None], [1 + 2j]])
def test_what_is_no_index_is_refused(data):
    with pytest.raises(TypeError, match="vertices must be integers"):
        taut.Sources(data)


@pytest.mark.parametrize("data", [["a"], [True], [None], [1 + 2j]])
def test_what_is_no_number_is_refused(data):
    with pytest.raises(TypeError, match="offsets must be real numbers"):
        taut.Sources(offsets=data)


@pytest.mark.parametrize("lay", IN_PLACE + CONVERTED)
@pytest.mark.parametrize("real", REALS)
@pytest.mark.parametrize("index", INDICES)
def test_distances_do_not_depend_on_the_layout(real, index, lay):
    positions, triangles = grid_arrays(6)
    rounded = positions.astype(real)
    expected = taut.ExactSolver(taut.Mesh(rounded.astype(float), triangles)).compute_distance([0, 5])
    mesh = taut.Mesh(lay(rounded.copy()), lay(triangles.astype(index)))
    sources = lay(np.array([0, 5], index))
    np.testing.assert_array_equal(taut.ExactSolver(mesh).compute_distance(sources), expected)


def test_no_copy_is_made():
    positions = np.random.default_rng(1).random((200_000, 3))
    triangles = np.arange(199_998, dtype=np.uint32).reshape(-1, 3)
    tracemalloc.start()
    try:
        mesh = taut.Mesh(positions, triangles)
        _, in_place = tracemalloc.get_traced_memory()
        taut.Mesh(positions, triangles.astype(np.int16))
        _, converted = tracemalloc.get_traced_memory()
    except taut.InvalidMesh:  # 16 bits do not hold these
        _, converted = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert mesh.triangle_count == len(triangles)
    assert in_place < 20_000
    assert converted > 8 * triangles.size  # numpy's memory is seen


@pytest.mark.parametrize("kind", REALS)
@pytest.mark.parametrize("lay", [lambda a: a, with_gap, misaligned])
def test_out_is_filled_in_place(grid, kind, lay):
    solver = taut.ExactSolver(grid)
    expected = solver.distance_rows([0, 7]).astype(kind)
    rows = lay(np.zeros(expected.shape, kind))
    assert solver.distance_rows([0, 7], out=rows) is rows
    np.testing.assert_array_equal(rows, expected)
    if rows.base is not None and rows.base.shape != rows.shape and rows.base.ndim == 2:
        assert (rows.base[:, rows.shape[1] :] == 77).all()  # what lies between the rows is left alone
    row = lay(np.zeros(grid.vertex_count, kind))
    assert solver.field(7).distances(out=row) is row
    np.testing.assert_array_equal(row, expected[1])
    heat = taut.HeatSolver(grid).field(7)
    assert heat.distances(out=row) is row
    np.testing.assert_array_equal(row, heat.distances().astype(kind))


@pytest.mark.parametrize(
    ("out", "error"),
    [
        ([0.0] * 4, TypeError),
        (np.zeros(4, np.int64), TypeError),
        (np.zeros(4, ">f8"), TypeError),
        (np.zeros(3), taut.InvalidArgument),
        (np.zeros((4, 1)), taut.InvalidArgument),
        (np.zeros(4)[::-1], taut.InvalidArgument),
        (np.broadcast_to(0.0, 4), taut.InvalidArgument),
        (read_only(np.zeros(4)), taut.InvalidArgument),
    ],
)
def test_a_bad_out_is_refused(square, out, error):
    with pytest.raises(error, match="out"):
        taut.ExactSolver(square).field(0).distances(out=out)


def test_out_is_left_alone_on_failure(square):
    rows = np.full((2, 4), 7.0)
    with pytest.raises(taut.InvalidArgument):
        taut.ExactSolver(square).distance_rows([0, 9], out=rows)
    with pytest.raises(taut.InvalidArgument):
        taut.HeatSolver(square).distance_rows([0, 9], out=rows)
    assert (rows == 7).all()


def test_out_may_be_the_input(square):
    positions = np.array([(0.5, 0.25, 0.25), (0, 1, 0)])
    expected = square.point_positions([0, 1], positions)
    assert square.point_positions([0, 1], positions, out=positions) is positions
    np.testing.assert_array_equal(positions, expected)
