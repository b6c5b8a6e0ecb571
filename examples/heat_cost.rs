//! What the heat method costs: CPU time of set-up, of a solve and of a new time step, and the memory beyond the buffers
//! (Linux). `scripts/bench-peers` sets it beside other programs.
//!
//! ```text
//! cargo run --release --example heat_cost -- POSITIONS TRIANGLES SOURCE DISTANCES
//! ```
//!
//! POSITIONS (64-bit floats) and TRIANGLES (32-bit indices) are raw numbers, three to a row. Set-up begins with them in
//! memory: it builds the mesh, its intrinsic Delaunay triangulation and the factors. DISTANCES receives the distance of
//! each vertex, one a line. Prints the seconds of set-up, the median seconds of the solves after a first one, the MB beyond
//! the buffers at their peak, and the seconds that another time step takes.

use cpu_time::ProcessTime;
use std::error::Error;
use std::io::Write;
use taut::{Control, HeatOptions, HeatSolver, Mesh, Source, TimeFormula, TimeScale, TimeStep};

/// Solves after the first one.
const SOLVES: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [positions, triangles, source, out] = arguments.as_slice() else {
        return Err("usage: heat_cost POSITIONS TRIANGLES SOURCE DISTANCES".into());
    };
    let positions: Vec<[f64; 3]> = rows(&numbers(positions, f64::from_le_bytes)?);
    let triangles: Vec<[u32; 3]> = rows(&numbers(triangles, u32::from_le_bytes)?);
    let sources = [Source::vertex(source.parse()?)];
    let control = Control::new();

    let with_buffers = memory("VmRSS")?;
    std::fs::write("/proc/self/clear_refs", "5")?; // the peak starts anew
    let start = ProcessTime::now();
    let mesh = Mesh::from_triangles(&positions, &triangles)?;
    let solver = HeatSolver::new(&mesh, &HeatOptions::default(), &control)?;
    let setup = start.elapsed();
    let distances = solver.field(&sources, &control)?.into_distances();
    let mut solves = Vec::with_capacity(SOLVES);
    for _ in 0..SOLVES {
        let start = ProcessTime::now();
        solver.field(&sources, &control)?;
        solves.push(start.elapsed());
    }
    solves.sort();
    let beyond = memory("VmHWM")? - with_buffers;
    let start = ProcessTime::now();
    let twice = TimeStep::Formula { formula: TimeFormula::MeanEdge, scale: TimeScale::Paper, factor: 2.0 };
    solver.with_time_step(&twice, &control)?;
    let retime = start.elapsed();
    let [setup, solve, retime] = [setup, solves[SOLVES / 2], retime].map(|time| time.as_secs_f64());
    println!("{setup} {solve} {beyond:.1} {retime}");

    let mut file = std::io::BufWriter::new(std::fs::File::create(out)?);
    for distance in distances {
        writeln!(file, "{distance}")?;
    }
    Ok(file.flush()?)
}

/// The raw numbers in a file.
fn numbers<T, const SIZE: usize>(path: &str, from_bytes: fn([u8; SIZE]) -> T) -> std::io::Result<Vec<T>> {
    Ok(std::fs::read(path)?.as_chunks().0.iter().map(|&bytes| from_bytes(bytes)).collect())
}

/// Three to a row.
fn rows<T: Copy>(numbers: &[T]) -> Vec<[T; 3]> {
    numbers.as_chunks().0.to_vec()
}

/// A line of this process's status, in MB of 10⁶ bytes.
fn memory(name: &str) -> Result<f64, Box<dyn Error>> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix(name)).ok_or("no such line")?;
    let kilobytes: f64 = line.trim_matches(|c: char| !c.is_ascii_digit()).parse()?;
    Ok(kilobytes * 1024.0 / 1e6)
}
