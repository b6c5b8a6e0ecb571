//! The minimal program: reads a mesh and prints the exact distance of each vertex from one of them.
//!
//! ```text
//! cargo run --release --example distance -- MESH VERTEX
//! ```

use std::error::Error;
use taut::{Control, ExactOptions, ExactSolver, Mesh, Source};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(path), Some(vertex), None) = (arguments.next(), arguments.next(), arguments.next()) else {
        return Err("usage: distance MESH VERTEX".into());
    };
    let mesh = Mesh::read(path)?;
    let from = [Source::vertex(vertex.parse()?)];
    let field = ExactSolver::new(&mesh)?.field(&from, &ExactOptions::default(), &Control::new())?;
    for distance in field.distances() {
        println!("{distance}");
    }
    Ok(())
}
