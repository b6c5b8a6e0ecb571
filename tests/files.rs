//! Mesh files: what is kept of them, and what is said of broken ones.

mod common;

use common::corpus;
use std::io::Write;
use taut::{Element, Error, Mesh, MeshFormat, Reason};

const FORMATS: [MeshFormat; 5] = [MeshFormat::Glb, MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply, MeshFormat::Stl];

fn read(format: MeshFormat, content: impl AsRef<[u8]>) -> Mesh {
    Mesh::read_bytes(content.as_ref(), format).unwrap()
}

fn fails(format: MeshFormat, content: impl AsRef<[u8]>) -> (Reason, Option<Element>) {
    let error: Error = Mesh::read_bytes(content.as_ref(), format).unwrap_err();
    (error.reason(), error.element())
}

fn ply_header(format: &str, vertices: usize, faces: usize) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment made up\nelement vertex {vertices}\nproperty double x\nproperty double y\n\
         property double z\nproperty uchar red\nelement face {faces}\nproperty list uchar int vertex_indices\n\
         property short flags\nend_header\n"
    )
}

/// The two triangles of a unit square and an unreferenced first vertex, in every format and encoding.
fn squares() -> Vec<(MeshFormat, Vec<u8>)> {
    let positions = [[9.0, 9.0, 9.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let faces = [[1, 2, 3], [1, 3, 4]];
    let obj = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 4\nf 2 4 5\n";
    let off = "OFF\n5 2 0\n9 9 9\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 1 2 3\n3 1 3 4\n";
    let mut text = ply_header("ascii", 5, 2).into_bytes();
    let mut little = ply_header("binary_little_endian", 5, 2).into_bytes();
    let mut big = ply_header("binary_big_endian", 5, 2).into_bytes();
    for [x, y, z] in positions {
        writeln!(text, "{x} {y} {z} 255").unwrap();
        for c in [x, y, z] {
            little.extend(f64::to_le_bytes(c));
            big.extend(f64::to_be_bytes(c));
        }
        little.push(255);
        big.push(255);
    }
    for face in faces {
        writeln!(text, "3 {} {} {} -7", face[0], face[1], face[2]).unwrap();
        little.push(3);
        big.push(3);
        for v in face {
            little.extend(i32::to_le_bytes(v));
            big.extend(i32::to_be_bytes(v));
        }
        little.extend(i16::to_le_bytes(-7));
        big.extend(i16::to_be_bytes(-7));
    }
    let ply = [text, little, big].map(|content| (MeshFormat::Ply, content));
    [(MeshFormat::Obj, obj.into()), (MeshFormat::Off, off.into())].into_iter().chain(ply).collect()
}

fn gzip(content: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(content).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn every_format_keeps_the_order_of_vertices_and_faces_and_the_unreferenced() {
    for (format, content) in squares() {
        let mesh = read(format, content);
        assert_eq!(mesh.positions()[0], [9.0; 3], "{format:?}");
        assert_eq!(mesh.positions()[4], [0.0, 1.0, 0.0], "{format:?}");
        assert_eq!(mesh.triangles(), [[1, 2, 3], [1, 3, 4]], "{format:?}");
    }
}

#[test]
fn gzip_is_known_by_its_first_bytes_and_by_the_suffix() {
    let folder = tempfile::tempdir().unwrap();
    for (format, content) in squares() {
        assert_eq!(read(format, gzip(&content)).triangle_count(), 2);
        for suffix in ["", ".gz", ".GZ"] {
            let path = folder.path().join(format!("square.{format:?}{suffix}"));
            std::fs::write(&path, if suffix.is_empty() { content.clone() } else { gzip(&content) }).unwrap();
            assert_eq!(Mesh::read(&path).unwrap().vertex_count(), 5, "{}", path.display());
        }
    }
}

#[test]
fn seventeen_digits_come_back_bit_for_bit() {
    let [x, y, z] = [0.1 + 0.2, 1.0 / 3.0, -2.2250738585072014e-308_f64];
    let xyz = format!("{x:.17} {y:.16e} {z:.16e}");
    let three = format!("{xyz}\n{xyz}\n{xyz}\n");
    let obj = format!("v {xyz}\nv {xyz}\nv {xyz}\nf 1 2 3\n");
    let off = format!("OFF\n3 1 0\n{three}3 0 1 2\n");
    let ply = format!("{}{}3 0 1 2 0\n", ply_header("ascii", 3, 1), three.replace('\n', " 0\n"));
    let float = ply.replace("double", "float");
    for (format, content) in
        [(MeshFormat::Obj, obj), (MeshFormat::Off, off), (MeshFormat::Ply, ply), (MeshFormat::Ply, float)]
    {
        for position in read(format, content).positions() {
            assert_eq!(position.map(f64::to_bits), [x, y, z].map(f64::to_bits), "{format:?}");
        }
    }
}

#[test]
fn extreme_numbers_and_numbers_that_are_none_come_back_bit_for_bit() {
    let rows =
        [[1e308, 1e-300, -0.0], [f64::MAX, f64::MIN_POSITIVE, 5e-324], [f64::NAN, f64::INFINITY, -f64::INFINITY]];
    let text: String = rows.iter().map(|[x, y, z]| format!("{x:?} {y:?} {z:?}\n")).collect();
    let binary: Vec<u8> = rows.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let head = |format: &str| ply_header(format, 3, 0).replace("property uchar red\n", "");
    let files = [
        (MeshFormat::Obj, text.lines().map(|row| format!("v {row}\n")).collect::<String>().into_bytes()),
        (MeshFormat::Off, format!("OFF\n3 0 0\n{text}").into_bytes()),
        (MeshFormat::Ply, (head("ascii") + &text).into_bytes()),
        (MeshFormat::Ply, [head("binary_little_endian").into_bytes(), binary].concat()),
    ];
    for (format, content) in files {
        let mesh = read(format, content);
        for (found, expected) in mesh.positions().iter().flatten().zip(rows.iter().flatten()) {
            assert!(found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan(), "{format:?} {found}");
        }
    }
}

#[test]
fn a_file_may_have_no_face_or_nothing_but_a_line() {
    for (vertices, faces) in [(1, 0), (2, 0), (2, 1)] {
        let rows = ["0 0 0\n", "1 0 0\n"][..vertices].concat();
        // A face that goes along the line and back.
        let [obj_face, face] = if faces == 1 { ["f 1 2 1\n", "3 0 1 0\n"] } else { [""; 2] };
        let obj: String = rows.lines().map(|row| format!("v {row}\n")).collect();
        let files = [
            (MeshFormat::Obj, obj + obj_face),
            (MeshFormat::Off, format!("OFF\n{vertices} {faces} 0\n{rows}{face}")),
            (
                MeshFormat::Ply,
                ply_header("ascii", vertices, faces) + &rows.replace("0\n", "0 0\n") + &face.replace('\n', " 0\n"),
            ),
        ];
        for (format, content) in files {
            let mesh = read(format, content);
            let counts = [mesh.vertex_count(), mesh.triangle_count(), mesh.ignored_triangles().len()];
            assert_eq!(counts, [vertices, faces, faces], "{format:?}");
        }
    }
    assert_eq!(read(MeshFormat::Off, "OFF\n0 0 0\n").vertex_count(), 0);
    assert_eq!(read(MeshFormat::Ply, ply_header("ascii", 0, 0)).vertex_count(), 0);
}

#[test]
fn polygons_become_fans_from_their_first_corner() {
    let fan = [[4, 3, 2], [4, 2, 1], [4, 1, 0], [0, 1, 2], [0, 2, 3]];
    let obj = "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 5 4 3 2 1\nf 1 2 3 4";
    assert_eq!(read(MeshFormat::Obj, obj).triangles(), fan);
    let off = "OFF 5 2 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 4 3 2 1 0 255 0 0\n4 0 1 2 3";
    assert_eq!(read(MeshFormat::Off, off).triangles(), fan);
    let ply = "0 0 0 0\n1 0 0 0\n2 1 0 0\n1 2 0 0\n0 1 0 0\n5 4 3 2 1 0 -1\n4 0 1 2 3 -1";
    assert_eq!(read(MeshFormat::Ply, ply_header("ascii", 5, 2) + ply).triangles(), fan);
}

#[test]
fn obj_groups_objects_and_materials_do_not_split_or_renumber() {
    let obj = "mtllib nowhere.mtl\no one\nv 0 0 0\nv 1 0 0\ng left\nusemtl red\nf 1 2 4\ng right\nusemtl\n\
               v 5 5 5\nv 0 1 0\nv -1 0 0\nf 4 5 1\no two\nf 2 1 4\n";
    let mesh = read(MeshFormat::Obj, obj);
    assert_eq!(mesh.vertex_count(), 5);
    assert_eq!(mesh.triangles(), [[0, 1, 3], [3, 4, 0], [1, 0, 3]]);
}

#[test]
fn obj_in_all_its_spellings() {
    let obj = b"\xef\xbb\xbfv 0 0 0 1.0 # weight, caf\xe9 in Latin-1\r\nv 1 0 0 .5 .5 .5\r\n\
        v 1 \\\r\n  1 0\r\nvt 0 0\r\nvn 0 0 1\r\np 1\r\nl 1 2 3\r\nf -3/1/1 -2//1 \\\n-1/1\r\nv nan 0 0\r\n#f 1 2 3\r\nf 1 2 3#";
    let mesh = read(MeshFormat::Obj, obj);
    assert_eq!(mesh.positions()[..3], [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
    assert!(mesh.positions()[3][0].is_nan());
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 1, 2]]);
}

#[test]
fn off_in_all_its_spellings() {
    let body = "0 0 0 0 0 1 255 0 0 0 0\r\n # between\r\n\r\n1 0 0\r\n0 1 0 # behind\r\n3 0 1 2 0.5 0.5 0.5\r\n";
    for head in ["OFF\r\n3 1\r\n", "# first\n\nOFF 3 1 0\n", "COFF\n# then\n3 1 3\n", "NOFF 3 1\n", "STCNOFF\n3 1 0\n"]
    {
        assert_eq!(read(MeshFormat::Off, format!("{head}{body}")).triangles(), [[0, 1, 2]], "{head:?}");
    }
    for head in ["OFF BINARY\n\0\0\0\x03", "4OFF\n", "nOFF 2\n"] {
        assert_eq!(fails(MeshFormat::Off, head), (Reason::UnknownFormat, Some(Element::Line(1))), "{head:?}");
    }
}

#[test]
fn ply_reads_past_what_it_does_not_need() {
    let ply = "ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement camera 1\r\nproperty float px\r\nproperty list int8 float32 l\r\n\
               element nothing 4294967295\r\nelement face 1\r\nproperty list uint8 uint32 vertex_index\r\n\
               element vertex 3\r\nproperty float q\r\nproperty float z\r\nproperty float y\r\nproperty float x\r\n\
               end_header\r\n1.5 2 7 8\r\n3 0 1 2\r\n0 1 2 3\r\n0 -inf nan 3\r\n0 .5 5. 1e-3\r\n";
    let error = Mesh::read_bytes(ply.as_bytes(), MeshFormat::Ply).unwrap_err();
    assert_eq!((error.reason(), error.element()), (Reason::NonFiniteCoordinate, Some(Element::Vertex(1))));
    let mesh = read(MeshFormat::Ply, ply.replace("-inf nan", "1 1"));
    assert_eq!(mesh.positions(), [[3.0, 2.0, 1.0], [3.0, 1.0, 1.0], [1e-3, 5.0, 0.5]]);
}

#[test]
fn a_file_cut_anywhere_is_an_error_or_a_shorter_mesh_and_never_a_panic() {
    for (format, content) in squares() {
        for length in 0..content.len() {
            if let Ok(mesh) = Mesh::read_bytes(&content[..length], format) {
                assert!(format == MeshFormat::Obj || length + 3 >= content.len(), "{format:?} cut at {length}");
                assert!(mesh.vertex_count() <= 5);
            }
        }
        let packed = gzip(&content);
        assert_eq!(fails(format, &packed[..packed.len() / 2]), (Reason::Truncated, None));
    }
}

#[test]
fn a_truncated_file_names_where_it_ends() {
    assert_eq!(fails(MeshFormat::Obj, "v 0 0 0\nv 1 0"), (Reason::Truncated, Some(Element::Line(2))));
    assert_eq!(fails(MeshFormat::Obj, "v 0 0 0\nv 1 0 0\nf 1 2"), (Reason::FaceTooSmall, Some(Element::Face(0))));
    assert_eq!(fails(MeshFormat::Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n"), (Reason::Truncated, Some(Element::Vertex(2))));
    assert_eq!(fails(MeshFormat::Off, "OFF\n1 2 0\n0 0 0\n3 0 0 0\n"), (Reason::Truncated, Some(Element::Face(1))));
    assert_eq!(fails(MeshFormat::Off, "OFF\n1 1 0\n0 0 0\n3 0"), (Reason::Truncated, Some(Element::Line(4))));
    assert_eq!(fails(MeshFormat::Ply, "ply\nformat ascii 1.0\nelement"), (Reason::Truncated, Some(Element::Line(3))));
    for (format, content) in squares().into_iter().skip(2) {
        let (reason, element) = fails(format, &content[..content.len() - 5]);
        assert_eq!((reason, element), (Reason::Truncated, Some(Element::Face(1))));
        assert_eq!(fails(format, ply_header("ascii", 1, 0)), (Reason::Truncated, Some(Element::Vertex(0))));
    }
}

#[test]
fn an_index_out_of_range_names_the_face_of_the_file() {
    let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    for bad in ["1 2 5", "1 2 0", "1 2 -5", "1 2 9223372036854775807", "1 2 -9223372036854775808", "0/1/1 1 2"] {
        let obj = format!("{quad}g next\nf {bad}\nf 7 8 9");
        assert_eq!(fails(MeshFormat::Obj, &obj), (Reason::IndexOutOfRange, Some(Element::Face(1))), "{bad}");
        let message = Mesh::read_bytes(obj.as_bytes(), MeshFormat::Obj).unwrap_err().to_string();
        assert!(message.contains("line 7"), "{message}");
    }
    for bad in ["4", "-1", "4294967296", "9223372036854775807"] {
        let off = format!("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 {bad}\n");
        assert_eq!(fails(MeshFormat::Off, off), (Reason::IndexOutOfRange, Some(Element::Face(1))), "{bad}");
    }
    for bad in ["4", "-1", "4294967296"] {
        let body = format!("0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n4 0 1 2 3 0\n3 0 1 {bad} 0\n");
        let ply = ply_header("ascii", 4, 2) + &body;
        assert_eq!(fails(MeshFormat::Ply, ply), (Reason::IndexOutOfRange, Some(Element::Face(1))), "{bad}");
    }
}

#[test]
fn an_obj_face_may_name_vertices_that_follow_it() {
    assert_eq!(read(MeshFormat::Obj, "f 1 2 3\ng rest\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles(), [[0, 1, 2]]);
}

#[test]
fn garbage_names_its_line() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for bad in ["f 1 2 x", "f 1 2 3/x", "f 1 2 3/1/1/1", "f 1 2 /3", "v 1 2", "v 1 2 z", "f 1 2 \u{e9}", "f 1.0 2 3"] {
        let obj = format!("{triangle}{bad}\nf 1 2 3\n");
        assert_eq!(fails(MeshFormat::Obj, obj), (Reason::Malformed, Some(Element::Line(4))), "{bad}");
    }
    for bad in ["3 0 1\n", "x 0 1 2\n", "3 0 1 2.5\n", "-3 0 1 2\n", "4294967295 0 1 2\n"] {
        let off = format!("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n{bad}");
        assert_eq!(fails(MeshFormat::Off, off), (Reason::Malformed, Some(Element::Line(6))), "{bad}");
    }
    for head in ["", "FOO\n", "XOFF\n1 1 1\n", "OFF\n-1 2 0\n", "OFF\n3\n", "solid\n", "\0\0\0\n"] {
        let (reason, element) = fails(MeshFormat::Off, head);
        assert!(matches!(reason, Reason::Malformed | Reason::Truncated), "{head:?}");
        assert!(matches!(element, Some(Element::Line(_))), "{head:?}");
    }
    for bad in ["3 0 1 1.5 0", "-3 0 1 2 0", "3 0 1 x 0", "1e30 0 1 2 0", "nan 0 1 2 0"] {
        let ply = ply_header("ascii", 3, 1) + "0 0 0 0\n1 0 0 0\n\n0 1 0 0\n" + bad + "\n";
        assert_eq!(fails(MeshFormat::Ply, ply), (Reason::Malformed, Some(Element::Line(17))), "{bad}");
    }
}

#[test]
fn a_hostile_header_costs_nothing() {
    let huge = u64::MAX;
    for count in [4_000_000_000, huge] {
        for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
            let head = format!("ply\nformat {encoding} 1.0\nelement nothing {huge}\nelement face {count}\n");
            let lists = format!("{head}property list uint int vertex_indices\nend_header\n");
            assert_eq!(fails(MeshFormat::Ply, &lists), (Reason::Truncated, Some(Element::Face(0))));
            let cut = lists + "\x7f\x7f\x7f\x7f\x01\x02";
            assert_eq!(fails(MeshFormat::Ply, cut), (Reason::Truncated, Some(Element::Face(0))));
        }
        let off = format!("OFF\n{count} {count} 0\n0 0 0\n");
        assert_eq!(fails(MeshFormat::Off, off), (Reason::Truncated, Some(Element::Vertex(1))));
    }
    for bad in [
        "format ascii 1.0\nelement vertex 1\nend_header\n",
        "format ascii 1.0\nelement vertex 1\nproperty float x\nproperty float x\nproperty float z\nend_header\n",
        "format ascii 1.0\nelement face 1\nproperty int vertex_indices\nend_header\n",
        "format ascii 1.0\nproperty float x\nend_header\n",
        "format ascii 1.0\nelement vertex 18446744073709551616\nend_header\n",
        "format ascii 1.0\nelement face 1\nproperty list int128 int vertex_indices\nend_header\n",
        "format utf-16 1.0\nend_header\n",
        "end_header\n",
        "\x7fELF\n",
    ] {
        let (reason, element) = fails(MeshFormat::Ply, format!("ply\n{bad}"));
        assert!(reason == Reason::Malformed && matches!(element, Some(Element::Line(_))), "{bad:?}");
    }
    let strips = "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    assert_eq!(fails(MeshFormat::Ply, strips), (Reason::UnknownFormat, Some(Element::Line(3))));
}

#[test]
fn an_obj_statement_continued_a_million_times_is_joined_in_linear_time() {
    let continued = "\\\n".repeat(1_000_000);
    let triangle = format!("v 0 0 {continued} 0\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    assert_eq!(read(MeshFormat::Obj, triangle).triangles(), [[0, 1, 2]]);
    assert_eq!(fails(MeshFormat::Obj, continued), (Reason::Malformed, Some(Element::Line(1))));
}

#[test]
fn a_decompression_bomb_is_refused() {
    for format in FORMATS {
        assert_eq!(fails(format, gzip(&vec![b'\n'; 10_000_000])), (Reason::Malformed, None));
    }
}

#[test]
fn a_missing_file_and_an_unknown_suffix_say_so() {
    assert_eq!(Mesh::read("nowhere/bunny.obj").unwrap_err().reason(), Reason::Io);
    for path in ["bunny.gltf", "bunny", "bunny.gz", "bunny.obj.zip", ""] {
        assert_eq!(Mesh::read(path).unwrap_err().reason(), Reason::UnknownFormat, "{path:?}");
    }
}

#[test]
fn a_file_without_a_head_or_a_vertex_is_no_mesh_file() {
    for content in ["", "# nothing\n", "\x7fELF\0\0\n"] {
        assert_eq!(fails(MeshFormat::Obj, content), (Reason::Malformed, Some(Element::Line(1))));
    }
    assert_eq!(fails(MeshFormat::Off, ""), (Reason::Truncated, Some(Element::Line(1))));
    assert_eq!(fails(MeshFormat::Ply, "").1, Some(Element::Line(1)));
}

#[test]
fn every_mesh_of_the_corpus_has_the_counts_of_its_table() {
    let Some(folder) = corpus() else { return };
    let table = std::fs::read_to_string(folder.join("meshes.tsv")).unwrap();
    for line in table.lines().skip(1) {
        let columns: Vec<&str> = line.split('\t').collect();
        let mesh = Mesh::read(folder.join(columns[0])).unwrap();
        let counts = [mesh.vertex_count(), mesh.triangle_count()];
        assert_eq!(counts, [columns[1], columns[3]].map(|column| column.parse::<usize>().unwrap()), "{}", columns[0]);
    }
}
