//! Writes the mesh that the README's command reads:
//! `cargo run --release --example make_data > data/knot.obj`

use taut::shapes::{self, Shape};

/// A trefoil knot of 7680 vertices and 15360 triangles.
pub(crate) fn knot() -> Shape {
    shapes::knot(320, 24, 0.45)
}

#[allow(dead_code, reason = "tests/shapes.rs takes this file in as a module")]
fn main() {
    println!("# A trefoil knot, made by examples/make_data.rs of taut");
    let shape = knot();
    for [x, y, z] in shape.positions {
        println!("v {x:.4} {y:.4} {z:.4}");
    }
    for triangle in shape.triangles {
        let [a, b, c] = triangle.map(|v| v + 1);
        println!("f {a} {b} {c}");
    }
}
