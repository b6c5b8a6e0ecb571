# Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
"""The filters in meshlabserver: what is in the files that it saves is what the library says of them from outside.

    server.py MESHLABSERVER REFERENCE FOLDER MESH...

MESHLABSERVER is one that finds the plug-in, REFERENCE the program of reference.cpp; files go into FOLDER.
"""

import array
import math
import pathlib
import struct
import subprocess
import sys
from xml.sax.saxutils import quoteattr

server, reference, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
meshes = sys.argv[4:]
folder.mkdir(parents=True, exist_ok=True)

DISTANCE = "Geodesic distance (Taut)"
SELECT = "Conditional Vertex Selection"


def parameter(name, value):
    """A line of a filter script; MeshLab reads the number of an enum only beside their count, which may be 0."""
    if name == "perc":
        return f'<Param name="{name}" type="RichDynamicFloat" min="0" max="100" value="{value}"/>'
    if isinstance(value, tuple):
        x, y, z = value
        return f'<Param name="{name}" type="RichPoint3f" x="{x!r}" y="{y!r}" z="{z!r}"/>'
    kinds = {bool: "RichBool", int: "RichInt", float: "RichFloat", str: "RichString"}
    kind = kinds[type(value)]
    if name in ("sources", "method", "timeStep", "laplacian"):
        kind = 'RichEnum" enum_cardinality="0'
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return f'<Param name="{name}" type="{kind}" value={quoteattr(text)}/>'


# meshlabserver 2020.09 wants every parameter of a filter.
METHOD = {"method": 0, "timeStep": 0, "timeFactor": 1.0, "laplacian": 0, "boundary": 0.0}
DEFAULTS = {
    DISTANCE: {"sources": 0, "sourcePoint": (0.0, 0.0, 0.0), **METHOD, "colour": True, "unreached": -1.0},
    "Geodesic Voronoi cells (Taut)": {"sources": 0, "sourcePoint": (0.0, 0.0, 0.0), **METHOD},
    "Geodesic isolines (Taut)": {"count": 20, "spacing": 0.0, "skipNegative": True},
    "Geodesic shortest path (Taut)": {"sources": 2, "sourcePoint": (0.0, 0.0, 0.0), "targetPoint": (1.0, 1.0, 1.0)},
}


def run(mesh, filters, outputs):
    """Applies filters, each a name and what differs from its defaults, and saves what `outputs` asks for."""
    lines = []
    for name, changes in filters:
        values = DEFAULTS.get(name, {}) | changes
        lines += [f"<filter name={quoteattr(name)}>", *(parameter(*item) for item in values.items()), "</filter>"]
    script = folder / "script.mlx"
    script.write_text("<!DOCTYPE FilterScript>\n<FilterScript>\n" + "\n".join(lines) + "\n</FilterScript>\n")
    command = [server, "-i", mesh, *outputs, "-s", script]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")


def read_ply(path):
    """The fields of the vertices, and the vertices of the faces, of a binary PLY of MeshLab."""
    content = path.read_bytes()
    end = content.index(b"end_header\n") + len(b"end_header\n")
    counts, fields, element = {}, [], ""
    for line in content[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element, counts[words[1]] = words[1], int(words[2])
        if words[0] == "property" and element == "vertex":
            fields.append((words[2], {"float": "f", "double": "d", "uchar": "B", "int": "i"}[words[1]]))
    row = struct.Struct("<" + "".join(code for _, code in fields))
    rows = list(row.iter_unpack(content[end : end + counts["vertex"] * row.size]))
    vertices = {name: [r[i] for r in rows] for i, (name, _) in enumerate(fields)}
    face = struct.Struct("<B3i")
    begin = end + counts["vertex"] * row.size
    faces = [f[1:] for f in face.iter_unpack(content[begin : begin + counts.get("face", 0) * face.size])]
    return vertices, faces


def distances(mesh, method, *sources):
    """What the library says; as the filter, -1 where no source reaches."""
    floats = array.array("f")
    floats.frombytes(subprocess.check_output([reference, mesh, method, *map(str, sources)]))
    return [-1.0 if math.isinf(d) else d for d in floats]


def check(condition, *message):
    if not condition:
        print(*message)
        sys.exit(1)


def saved_distances(mesh, filters):
    """Fields of the vertices, the faces, and the path of what is saved after filters."""
    out = folder / "out.ply"
    out.unlink(missing_ok=True)
    done = run(mesh, filters, ["-o", out, "-m", "vq", "vc"])
    check(done.returncode == 0 and out.exists(), mesh, filters, done.stdout)
    return *read_ply(out), out


def test_distances(mesh):
    select = (SELECT, {"condSelect": "(vi < 3)"})
    for number, method in enumerate(["exact", "heat"]):
        vertices, _, out = saved_distances(mesh, [select, (DISTANCE, {"method": number})])
        check(vertices["quality"] == distances(out, method, "vertices", 0, 1, 2), mesh, method)
    grey = (160, 160, 160)
    colours = list(zip(vertices["red"], vertices["green"], vertices["blue"]))
    for quality, colour in zip(vertices["quality"], colours):
        check((colour == grey) == (quality == -1), mesh, quality, colour)

    faces = ("Conditional Face Selection", {"condSelect": "(fi == 5)"})
    vertices, _, out = saved_distances(mesh, [faces, (DISTANCE, {"sources": 1})])
    check(vertices["quality"] == distances(out, "exact", "faces", 5), mesh, "faces")

    # A float of MeshLab's, since that is what it reads.
    point = tuple(array.array("f", [0.1, 0.2, 0.3]))
    vertices, _, out = saved_distances(mesh, [(DISTANCE, {"sources": 2, "sourcePoint": point})])
    check(vertices["quality"] == distances(out, "exact", "point", *point), mesh, "point")
    print(f"{mesh}: {len(vertices['quality'])} vertices")


def test_deleted(mesh):
    """Faces that a filter before has deleted are still in MeshLab's list."""
    filters = [
        ("Conditional Face Selection", {"condSelect": "(fi >= 40 && fi < 90)"}),
        ("Delete Selected Faces", {}),
        (SELECT, {"condSelect": "(vi == 0)"}),
        (DISTANCE, {}),
    ]
    vertices, faces, out = saved_distances(mesh, filters)
    check(vertices["quality"] == distances(out, "exact", "vertices", 0), mesh, "deleted")
    check(len(faces) > 0, "no faces")


def test_lines(mesh):
    """Layers of lines; PLY of 2020.09 keeps their vertices, DXF their edges."""
    points, edges = folder / "lines.ply", folder / "lines.dxf"
    select = (SELECT, {"condSelect": "(vi == 0)"})
    isolines = ("Geodesic isolines (Taut)", {"count": 7})
    outputs = ["-o", points, "-l", "1", "-m", "vq", "-o", edges, "-l", "1"]
    done = run(mesh, [select, (DISTANCE, {}), isolines], outputs)
    check(done.returncode == 0, done.stdout)
    qualities = set(read_ply(points)[0]["quality"])
    check(len(qualities) == 7, mesh, qualities)
    check(edges.read_text().count("LINE") > 0, mesh, "no edges")

    vertices, _, out = saved_distances(mesh, [select, (DISTANCE, {})])
    end = max((q, i) for i, q in enumerate(vertices["quality"]) if q >= 0)[1]
    to = tuple(vertices[axis][end] for axis in "xyz")
    path = ("Geodesic shortest path (Taut)", {"sources": 0, "targetPoint": to})
    done = run(mesh, [select, path], ["-o", points, "-l", "1", "-m", "vq"])
    check(done.returncode == 0, done.stdout)
    line = read_ply(points)[0]
    steps = list(zip(line["x"], line["y"], line["z"]))
    length = sum(math.dist(a, b) for a, b in zip(steps, steps[1:]))
    check(abs(length - vertices["quality"][end]) < 1e-4 * length, mesh, length)
    check(f"{length:.5g}"[:5] in done.stdout, mesh, length, done.stdout)


def test_others_read(mesh):
    """MeshLab's own filters, whose histograms end the program on inf, take our quality of what no source reaches."""
    colour = ("Colorize by vertex Quality", {"minVal": 0.0, "maxVal": 1.0, "perc": 5.0, "zeroSym": False})
    vertices, _, _ = saved_distances(mesh, [(SELECT, {"condSelect": "(vi == 0)"}), (DISTANCE, {}), colour])
    check(-1 in vertices["quality"], mesh)


def test_failure(mesh):
    """The message is shown, and nothing saved."""
    out = folder / "none.ply"
    out.unlink(missing_ok=True)
    done = run(mesh, [(DISTANCE, {})], ["-o", out, "-m", "vq"])
    check(done.returncode != 0 and "no vertex is selected" in done.stdout and not out.exists(), done.stdout)


# Quads, a hexagon, an isolated part, an unreferenced vertex.
polygons = folder / "polygons.off"
polygons.write_text(
    "OFF\n14 4 0\n0 0 0\n1 0 0.5\n2 0 0\n2 1 0.2\n1 1 0\n0 1 0.3\n3 0 0\n4 0.5 0.1\n3 1.2 0\n"
    "9 9 9\n5 5 5\n6 5 5\n6 6 5\n5 6 5\n4 0 1 4 5\n4 1 2 3 4\n5 2 6 7 8 3\n4 10 11 12 13\n"
)
meshes.append(polygons)

for mesh in meshes[:-1]:
    test_distances(mesh)
test_deleted(meshes[0])
test_lines(meshes[0])
vertices, _, out = saved_distances(polygons, [(SELECT, {"condSelect": "(vi == 0)"}), (DISTANCE, {})])
check(vertices["quality"] == distances(out, "exact", "vertices", 0) and -1 in vertices["quality"], "polygons")
test_others_read(polygons)
test_failure(polygons)
