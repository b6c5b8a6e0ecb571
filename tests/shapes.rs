//! The made-up meshes are what their descriptions say.

#[path = "../examples/make_data.rs"]
mod make_data;

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use taut::Mesh;
use taut::shapes::{self, Shape};

/// V - E + F, how many edges have one triangle only, and whether neighbours agree on their orientation.
fn topology(shape: &Shape) -> (i64, usize, bool) {
    let mut edges: HashMap<(u32, u32), Vec<bool>> = HashMap::new();
    for &[a, b, c] in &shape.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            edges.entry((from.min(to), from.max(to))).or_default().push(from < to);
        }
    }
    let euler = shape.positions.len() as i64 - edges.len() as i64 + shape.triangles.len() as i64;
    let boundary = edges.values().filter(|uses| uses.len() == 1).count();
    let oriented = edges.values().all(|uses| uses.len() == 1 || (uses.len() == 2 && uses[0] != uses[1]));
    (euler, boundary, oriented)
}

fn length(a: [f64; 3]) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Six times the volume that a closed shape encloses: positive where its triangles look outward.
fn volume(shape: &Shape) -> f64 {
    let corner = |v: u32| shape.positions[v as usize];
    let determinant = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    shape.triangles.iter().map(|triangle| determinant(triangle.map(corner))).sum::<f64>() / 6.0
}

fn angle_around(shape: &Shape, apex: u32) -> f64 {
    let position = |v: u32| shape.positions[v as usize];
    shape
        .triangles
        .iter()
        .filter_map(|triangle| {
            let k = triangle.iter().position(|&v| v == apex)?;
            let [p, q] = [1, 2].map(|step| minus(position(triangle[(k + step) % 3]), position(apex)));
            let cos = (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) / (length(p) * length(q));
            Some(cos.acos())
        })
        .sum()
}

#[test]
fn each_shape_has_its_topology_and_one_orientation() {
    assert_eq!(topology(&shapes::grid(5, 3)), (1, 16, true));
    assert_eq!(topology(&shapes::terrain(6, 0.3)), (1, 24, true));
    assert_eq!(topology(&shapes::saddle(4)), (1, 16, true));
    assert_eq!(topology(&shapes::cylinder(7, 4, 2.0)), (0, 14, true));
    assert_eq!(topology(&shapes::cone(4.0, 6, 3)), (1, 6, true));
    assert_eq!(topology(&shapes::cone(9.0, 6, 3)), (1, 6, true));
    assert_eq!(topology(&shapes::torus(8, 5, 2.0, 0.5)), (0, 0, true));
    assert_eq!(topology(&shapes::knot(40, 6, 0.4)), (0, 0, true));
    assert_eq!(topology(&shapes::icosphere(2)), (2, 0, true));
}

#[test]
fn each_shape_is_a_mesh() {
    for shape in [shapes::grid(3, 2), shapes::cone(1.0, 5, 2), shapes::icosphere(1), shapes::knot(30, 5, 0.4)] {
        let mesh = shape.mesh().unwrap();
        assert_eq!(mesh.positions(), shape.positions);
        assert_eq!(mesh.triangles(), shape.triangles);
        assert!(mesh.ignored_triangles().is_empty());
    }
}

#[test]
fn closed_shapes_look_outward_and_have_their_size() {
    let sphere = shapes::icosphere(4);
    assert!(sphere.positions.iter().all(|&p| (length(p) - 1.0).abs() < 1e-15));
    assert!((volume(&sphere) / (4.0 / 3.0 * PI) - 1.0).abs() < 5e-3);
    let torus = volume(&shapes::torus(120, 60, 2.0, 0.5));
    assert!((torus / (PI * 0.25 * TAU * 2.0) - 1.0).abs() < 5e-3, "{torus}");
    assert!(volume(&shapes::knot(200, 12, 0.4)) > 0.0);
}

#[test]
fn open_shapes_lie_where_they_should() {
    let grid = shapes::grid(4, 3);
    assert_eq!(grid.positions[5 * 2 + 3], [3.0, 2.0, 0.0]);
    let saddle = shapes::saddle(8);
    assert!(saddle.positions.iter().all(|&[x, y, z]| z == x * x - y * y));
    let cylinder = shapes::cylinder(6, 2, 3.0);
    assert!(cylinder.positions.iter().all(|&[x, y, _]| (x.hypot(y) - 1.0).abs() < 1e-15));
    assert_eq!(cylinder.positions[12][2], 3.0);
    let highest = shapes::terrain(20, 0.3).positions.iter().fold(0.0_f64, |most, p| most.max(p[2].abs()));
    assert!((0.2..=0.3).contains(&highest), "{highest}");
}

#[test]
fn a_cone_has_its_angle_and_slant() {
    for angle in [0.5, 3.0, 6.0, 7.0, 12.0] {
        let cone = shapes::cone(angle, 12, 3);
        assert!((angle_around(&cone, 0) - angle).abs() < 1e-12, "{angle}");
        assert!(cone.positions[25..].iter().all(|&p| (length(p) - 1.0).abs() < 1e-14), "{angle}");
        // The inner vertices of a sector lie in its plane, so nothing but the apex is curved.
        assert!((angle_around(&cone, 1) - TAU).abs() < 1e-12, "{angle}");
    }
}

#[test]
fn cutting_triangles_in_four_keeps_the_surface() {
    let shape = shapes::cone(3.0, 5, 2);
    let finer = shapes::subdivided(&shape);
    assert_eq!(finer.positions[..shape.positions.len()], shape.positions);
    assert_eq!(finer.triangles.len(), 4 * shape.triangles.len());
    assert_eq!(topology(&finer), (1, 10, true));
    assert!((angle_around(&finer, 0) - 3.0).abs() < 1e-12);
}

#[test]
fn the_shipped_mesh_is_what_its_program_makes() {
    let made = make_data::knot();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/knot.obj");
    let shipped = Mesh::read(path).unwrap();
    assert_eq!(shipped.triangles(), made.triangles);
    for (read, made) in shipped.positions().iter().zip(&made.positions) {
        // Four decimals; the last digit of a sine differs between platforms.
        assert!(length(minus(*read, *made)) < 1e-4);
    }
    assert!(std::fs::metadata(path).unwrap().len() < 1_000_000);
}

#[test]
fn subdivision_takes_any_soup() {
    // Edges whose ends add up to more than a number holds, one of three triangles, and a triangle that repeats a vertex.
    let far = 1.7e308;
    let positions = vec![[far, far, 0.0], [far, 0.0, 0.0], [0.0; 3], [0.0, far, 0.0]];
    let shape = shapes::Shape { positions, triangles: vec![[0, 1, 2], [1, 0, 3], [0, 1, 3], [2, 2, 3]] };
    let finer = shapes::subdivided(&shape).mesh().unwrap();
    assert_eq!(finer.positions()[4], [far, far / 2.0, 0.0]);
    assert_eq!((finer.vertex_count(), finer.triangle_count()), (4 + 6, 16));
    assert_eq!(finer.ignored_triangles(), [12, 13, 14, 15]);
}
