//! STL files: which corners are one vertex, which of the two encodings a file has, and what is said of broken ones.

use std::io::Write;
use taut::{Element, Mesh, MeshFormat, Reason};

type Corners = [[f32; 3]; 3];

/// The two triangles of a unit square.
const SQUARE: [Corners; 2] =
    [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]];

fn binary(name: &str, triangles: &[Corners]) -> Vec<u8> {
    let mut file = vec![b' '; 80];
    file[..name.len()].copy_from_slice(name.as_bytes());
    file.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        file.extend([0; 12]);
        file.extend(triangle.iter().flatten().flat_map(|number| number.to_le_bytes()));
        file.extend([0xab; 2]);
    }
    file
}

fn text(triangles: &[Corners]) -> String {
    let facet = |corners: &Corners| {
        let vertices: String = corners.iter().map(|[x, y, z]| format!("      vertex {x:e} {y:e} {z:e}\n")).collect();
        format!("  facet normal nan nan nan\n    outer loop\n{vertices}    endloop\n  endfacet\n")
    };
    let facets: String = triangles.iter().map(facet).collect();
    format!("solid a name\n{facets}endsolid a name\n")
}

fn read(file: impl AsRef<[u8]>) -> Mesh {
    Mesh::read_bytes(file.as_ref(), MeshFormat::Stl).unwrap()
}

fn fails(file: impl AsRef<[u8]>) -> (Reason, Option<Element>) {
    let error = Mesh::read_bytes(file.as_ref(), MeshFormat::Stl).unwrap_err();
    (error.reason(), error.element())
}

#[test]
fn the_suffix_is_stl_with_or_without_gz() {
    let folder = tempfile::tempdir().unwrap();
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    packed.write_all(&binary("any", &SQUARE)).unwrap();
    for (name, file) in [("a.STL", text(&SQUARE).into_bytes()), ("b.stl.gz", packed.finish().unwrap())] {
        std::fs::write(folder.path().join(name), file).unwrap();
        assert_eq!(Mesh::read(folder.path().join(name)).unwrap().vertex_count(), 4, "{name}");
    }
}

#[test]
fn corners_of_equal_position_are_one_vertex_numbered_by_first_appearance() {
    for file in [binary("any", &SQUARE), text(&SQUARE).into_bytes()] {
        let mesh = read(file);
        assert_eq!(mesh.positions(), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    }
}

#[test]
fn positions_that_differ_in_the_last_bit_stay_apart_but_the_sign_of_zero_does_not_count() {
    let [first, mut second] = SQUARE;
    second[0] = [-0.0, 0.0, -0.0];
    second[1][0] = 1.0_f32.next_up();
    let mesh = read(binary("any", &[second, first]));
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 3, 4]]);
    assert!(mesh.positions()[0][0].is_sign_negative(), "a vertex keeps the bits of its first appearance");
    assert_eq!(mesh.positions()[1][0], f64::from(1.0_f32.next_up()));
}

#[test]
fn numbers_come_back_bit_for_bit() {
    let corners = [[1e-40, f32::MAX, 0.1], [f32::MIN_POSITIVE, -3.5, 7.0], [16_777_217.0, 1e-45, -0.1]];
    assert_eq!(read(binary("any", &[corners])).positions(), corners.map(|corner| corner.map(f64::from)));
    let exact = "solid\nfacet\nvertex 1e308 1e-300 0.30000000000000004\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid";
    assert_eq!(read(exact).positions()[0], [1e308, 1e-300, 0.1 + 0.2]);
}

#[test]
fn a_corner_that_is_not_finite_names_its_vertex() {
    for bad in [f32::NAN, f32::INFINITY] {
        let [first, mut second] = SQUARE;
        second[2][1] = bad;
        for file in [binary("any", &[first, second]), text(&[first, second]).into_bytes()] {
            assert_eq!(fails(file), (Reason::NonFiniteCoordinate, Some(Element::Vertex(3))));
        }
    }
}

#[test]
fn the_length_tells_a_binary_file_even_if_it_begins_with_solid() {
    for name in ["solid", "solid block\nfacet normal", "SOLID\r\n"] {
        assert_eq!(read(binary(name, &SQUARE)).triangle_count(), 2, "{name:?}");
    }
    let cut = |file: Vec<u8>| file[..file.len() - 7].to_vec();
    assert_eq!(fails(cut(binary("solid block\nof wood\n", &SQUARE))), (Reason::Truncated, Some(Element::Face(1))));
}

#[test]
fn text_in_all_its_spellings() {
    let plain = text(&SQUARE);
    let two = plain.clone() + &plain.replace("e0", "e1");
    assert_eq!(read(&two).triangle_count(), 4, "several solids are one mesh");
    let spellings = [
        plain.to_uppercase(),
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\n\n\t"),
        format!("\u{feff}{plain}"),
        plain.replace("nan nan nan", ""),
        plain.replace("a name", "caf\u{e9} # facet"),
    ];
    for spelling in spellings {
        assert_eq!(read(&spelling).triangles(), read(&plain).triangles(), "{spelling}");
    }
    assert_eq!(read("solid nothing\nendsolid nothing\n").triangle_count(), 0);
}

#[test]
fn garbage_in_a_text_names_its_line() {
    let plain = text(&SQUARE);
    let broken = [
        (plain.replacen("1e0", "one", 1), 5),
        (plain.replacen("vertex 0e0 0e0 0e0", "vertex 0 0", 1), 4),
        (plain.replacen("      vertex 0e0 0e0 0e0\n", "", 1), 7),
        (plain.replacen("endloop", "vertex 1 1 1", 1), 7),
        (plain.replacen("    endloop\n  endfacet\n", "", 1), 7),
        (plain.replacen("endsolid", "end", 1), 16),
        (plain.clone() + "facet\n", 17),
    ];
    for (file, line) in broken {
        assert_eq!(fails(&file), (Reason::Malformed, Some(Element::Line(line))), "{file}");
    }
}

#[test]
fn a_file_cut_anywhere_is_an_error() {
    for file in [binary("any", &SQUARE), text(&SQUARE).trim_end().into()] {
        let is_text = file.starts_with(b"solid");
        // The last word may lose its end, as a name may.
        let whole = if is_text { file.len() - " a name".len() } else { file.len() };
        for length in 0..whole {
            let (reason, _) = fails(&file[..length]);
            assert!(matches!(reason, Reason::Truncated | Reason::Malformed), "cut at {length}");
        }
    }
    let file = binary("any", &SQUARE);
    assert_eq!(fails(&file[..84]), (Reason::Truncated, Some(Element::Face(0))));
    assert_eq!(fails(&file[..file.len() - 1]), (Reason::Truncated, Some(Element::Face(1))));
    let facet = text(&SQUARE);
    assert_eq!(fails(facet.split_once("endsolid").unwrap().0), (Reason::Truncated, Some(Element::Line(15))));
}

#[test]
fn a_head_that_promises_too_few_or_too_many_triangles_is_an_error() {
    let mut file = binary("any", &SQUARE);
    file.extend([0; 49]);
    assert_eq!(read(&file).triangle_count(), 2, "less than a triangle may follow");
    file.push(0);
    assert_eq!(fails(&file), (Reason::Malformed, None));
    file[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(fails(&file), (Reason::Truncated, Some(Element::Face(3))));
}

#[test]
fn another_file_is_refused() {
    assert_eq!(fails(""), (Reason::Truncated, None));
    assert_eq!(fails("OFF\n0 0 0\n"), (Reason::Malformed, None));
    assert_eq!(fails("<html>".repeat(100)).0, Reason::Truncated);
}
