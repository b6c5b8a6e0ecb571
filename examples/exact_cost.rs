//! What exact distances on a mesh cost: CPU time of set-up and solve, and the memory beyond the mesh (Linux).
//! `scripts/bench-peers` sets it beside other programs.
//!
//! ```text
//! cargo run --release --example exact_cost -- MESH FOLDER
//! ```
//!
//! Prints the source, which is the first vertex that a triangle uses, the seconds of set-up and solve, the MB beyond the
//! mesh at their peak, and how many windows crossed a triangle. FOLDER receives, as raw numbers, `positions` and
//! `distances` (64-bit floats) and `triangles` (32-bit indices).

use cpu_time::ProcessTime;
use std::error::Error;
use std::path::Path;
use taut::{Control, ExactOptions, ExactSolver, Mesh, Source};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(path), Some(folder), None) = (arguments.next(), arguments.next(), arguments.next()) else {
        return Err("usage: exact_cost MESH FOLDER".into());
    };
    let mesh = Mesh::read(path)?;
    let is_used =
        |triangle: &&[u32; 3]| triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
    let source = mesh.triangles().iter().filter(is_used).flatten().min().copied().ok_or("no triangle")?;

    let with_mesh = memory("VmRSS")?;
    std::fs::write("/proc/self/clear_refs", "5")?; // the peak starts anew
    let start = ProcessTime::now();
    let solver = ExactSolver::new(&mesh)?;
    let setup = start.elapsed();
    let start = ProcessTime::now();
    let field = solver.field(&[Source::vertex(source)], &ExactOptions::default(), &Control::new())?;
    let solve = start.elapsed();
    let beyond = memory("VmHWM")? - with_mesh;
    println!("{source} {} {} {beyond:.1} {}", setup.as_secs_f64(), solve.as_secs_f64(), field.windows());

    let folder = Path::new(&folder);
    let bytes = |numbers: &[f64]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    std::fs::write(folder.join("positions"), bytes(mesh.positions().as_flattened()))?;
    std::fs::write(folder.join("distances"), bytes(field.distances()))?;
    let indices = mesh.triangles().as_flattened().iter();
    std::fs::write(folder.join("triangles"), indices.flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>())?;
    Ok(())
}

/// A line of this process's status, in MB of 10⁶ bytes.
fn memory(name: &str) -> Result<f64, Box<dyn Error>> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix(name)).ok_or("no such line")?;
    let kilobytes: f64 = line.trim_matches(|c: char| !c.is_ascii_digit()).parse()?;
    Ok(kilobytes * 1024.0 / 1e6)
}
