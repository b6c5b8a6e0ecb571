//! `taut distance --mesh-out` as a person runs it.

mod common;

use common::Desk;
use std::fs;
use std::path::Path;
use taut::Mesh;

/// Two triangles of odd numbers that no edge joins, a triangle that repeats a vertex, and vertices that no face uses.
const SOUP: &str = "v nan 7 inf\nv 0.30000000000000004 -0.0 1e-300\nv 1e10 0 0.1\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\n\
                    f 2 3 4\nf 5 6 7\nf 2 2 3\n";

/// A folder with the soup, and what the command left there.
fn written(options: &str) -> Desk {
    let desk = Desk::new();
    desk.write("soup.obj", SOUP);
    let printed = desk.prints(&format!("distance soup.obj --source 1 --method exact {options}"));
    assert_eq!(printed.lines().count(), 7);
    desk
}

fn bits(mesh: &Mesh) -> Vec<[u64; 3]> {
    mesh.positions().iter().map(|position| position.map(f64::to_bits)).collect()
}

#[test]
fn the_mesh_comes_back_bit_for_bit() {
    for name in ["out.ply", "out.OBJ"] {
        let desk = written(&format!("--mesh-out {name}"));
        let [mesh, back] = ["soup.obj", name].map(|name| Mesh::read(desk.path(name)).unwrap());
        assert_eq!(bits(&back), bits(&mesh), "{name}");
        assert_eq!(back.triangles(), mesh.triangles(), "{name}");
    }
}

/// The rows of the vertices of a PLY file: distance and colour.
fn qualities(path: &Path) -> Vec<(f64, [u8; 3])> {
    let content = fs::read(path).unwrap();
    let head = content.windows(11).position(|word| word == b"end_header\n").unwrap() + 11;
    let row = |row: &[u8]| (f64::from_le_bytes(row[24..32].try_into().unwrap()), row[32..].try_into().unwrap());
    content[head..].chunks(35).take(7).map(row).collect()
}

#[test]
fn ply_has_distances_as_quality_and_the_colours_of_pictures() {
    let desk = written("--mesh-out out.ply");
    let rows = qualities(&desk.path("out.ply"));
    let far = 1e10_f64;
    for (v, (distance, colour)) in rows.iter().enumerate() {
        match v {
            1 => assert_eq!((*distance, *colour), (0.0, [0xff, 0xf1, 0xd6])),
            2 => assert!((distance - far).abs() < 1.0 && *colour == [0x3b, 0x32, 0x80], "{distance} {colour:?}"),
            3 => assert!((1.0..1.1).contains(distance) && *colour == [0xff, 0xf1, 0xd6], "{distance} {colour:?}"),
            _ => assert_eq!((*distance, *colour), (f64::INFINITY, [128; 3]), "vertex {v}"),
        }
    }
    let text = fs::read(desk.path("out.ply")).unwrap();
    assert!(String::from_utf8_lossy(&text).contains("property double quality\nproperty uchar red\n"));
}

#[test]
fn obj_has_distances_from_0_to_1_as_texture_coordinates() {
    let desk = written("--mesh-out out.obj");
    let text = fs::read_to_string(desk.path("out.obj")).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter_map(|line| line.strip_prefix("vt "))
        .map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows[1], [0.0, 0.0]);
    assert_eq!(rows[2], [1.0, 0.0]);
    assert!((1e-10..1.1e-10).contains(&rows[3][0]));
    for v in [0, 4, 5, 6] {
        assert_eq!(rows[v], [0.0, 1.0], "vertex {v}");
    }
    assert!(text.contains("f 2/2 3/3 4/4\nf 5/5 6/6 7/7\nf 2/2 2/2 3/3\n"));
    assert!(text.starts_with("# vt u 0: u is 0 at the distance 0.0 and 1 at 9999999999.7;"), "{text}");
}

#[test]
fn a_target_does_not_cut_the_mesh_short() {
    let [all, one] = ["out.ply", "out.ply --target 3 -o target.txt --json"].map(|options| {
        let desk = Desk::new();
        desk.write("soup.obj", SOUP);
        desk.prints(&format!("distance soup.obj --source 1 --method exact --mesh-out {options}"));
        fs::read(desk.path("out.ply")).unwrap()
    });
    assert_eq!(all, one);
}

#[test]
fn a_field_without_extent_has_one_colour() {
    let desk = Desk::new();
    desk.write("point.obj", "v 0 0 0\n");
    desk.prints("distance point.obj --source 0 --method exact --mesh-out out.ply");
    assert_eq!(qualities(&desk.path("out.ply")), [(0.0, [0xff, 0xf1, 0xd6])]);
}

#[test]
fn failures_leave_nothing_behind() {
    let desk = Desk::new();
    desk.write("soup.obj", SOUP);
    for (code, options, expected) in [
        (2, "--source 1 --mesh-out out.stl", "the suffix is neither .ply nor .obj"),
        (2, "--source 1 --mesh-out ply", "the suffix is neither .ply nor .obj"),
        (1, "--source 9 --mesh-out out.ply", "source 0"),
        (1, "--source 1 --method exact --mesh-out out.ply -o nowhere/out.txt", "nowhere/out.txt: "),
        (1, "--source 1 --method exact --mesh-out nowhere/out.ply -o out.txt", "nowhere/out.ply: "),
    ] {
        let said = desk.says(code, &format!("distance soup.obj {options}"));
        assert!(said.contains(expected), "{options}: {said}");
        assert_eq!(fs::read_dir(desk.path(".")).unwrap().count(), 1, "{options}");
    }
}
