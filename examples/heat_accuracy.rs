//! Distances by the heat method with every formula of the time step, and exact ones. `scripts/bench-peers` makes a table
//! of the errors.
//!
//! ```text
//! cargo run --release --example heat_accuracy -- POSITIONS TRIANGLES FOLDER SOURCE...
//! ```
//!
//! POSITIONS (64-bit floats) and TRIANGLES (32-bit indices) are raw numbers, three to a row. FOLDER receives raw 64-bit
//! floats, one run of distances after another for each SOURCE: `exact`, and for each time step (Eq. 1 to 5 at paper scale)
//! `plain1` to `plain5` and `intrinsic1` to `intrinsic5`; where there is no answer there is no file.
//!
//! Prints the least angle in degrees, whether all is a manifold (true or false) and how many boundary loops it has; then,
//! each on a line, errors other than that a formula has no time step for the mesh, the file's name first.

use std::error::Error;
use std::path::Path;
use taut::{
    Control, ExactOptions, ExactSolver, HeatOptions, HeatSolver, Laplacian, Mesh, MeshReport, Reason, Source,
    TimeFormula, TimeScale, TimeStep,
};

const FORMULAS: [TimeFormula; 5] = [
    TimeFormula::MeanEdge,
    TimeFormula::Sigma,
    TimeFormula::MeanSigma,
    TimeFormula::MedianFit,
    TimeFormula::MedianMean,
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [positions, triangles, folder, sources @ ..] = arguments.as_slice() else {
        return Err("usage: heat_accuracy POSITIONS TRIANGLES FOLDER SOURCE...".into());
    };
    let positions: Vec<[f64; 3]> = rows(&numbers(positions, f64::from_le_bytes)?);
    let triangles: Vec<[u32; 3]> = rows(&numbers(triangles, u32::from_le_bytes)?);
    let folder = Path::new(folder);
    let sources = sources.iter().map(|v| Ok(Source::vertex(v.parse()?))).collect::<Result<Vec<_>, Box<dyn Error>>>()?;
    let mesh = Mesh::from_triangles(&positions, &triangles)?;

    let report = MeshReport::new(&mesh);
    let least = report.smallest_angle.map_or(f64::NAN, |angle| angle.radians.to_degrees());
    let is_manifold = report.components.iter().all(|component| component.is_manifold);
    println!("{least} {is_manifold} {}", report.boundary_loops.len());
    write(&folder.join("exact"), &exact(&mesh, &sources)?)?;
    for (name, laplacian) in [("plain", Laplacian::Plain), ("intrinsic", Laplacian::Intrinsic)] {
        let solver = HeatSolver::new(&mesh, &HeatOptions { laplacian, ..HeatOptions::default() }, &Control::new());
        for (number, formula) in (1..).zip(FORMULAS) {
            match solver.as_ref().map_err(Clone::clone).and_then(|solver| heat(solver, formula, &sources)) {
                Ok(fields) => write(&folder.join(format!("{name}{number}")), &fields)?,
                Err(error) if error.reason() == Reason::BadTimeStep => {}
                Err(error) => println!("{name}{number}: {error}"),
            }
        }
    }
    Ok(())
}

/// The exact distances from each source.
fn exact(mesh: &Mesh, sources: &[Source]) -> taut::Result<Vec<Vec<f64>>> {
    let solver = ExactSolver::new(mesh)?;
    let field = |source: &Source| solver.field(std::slice::from_ref(source), &ExactOptions::default(), &Control::new());
    sources.iter().map(|source| Ok(field(source)?.distances().to_vec())).collect()
}

/// The distances from each source by the heat method with another time step.
fn heat(solver: &HeatSolver, formula: TimeFormula, sources: &[Source]) -> taut::Result<Vec<Vec<f64>>> {
    let step = TimeStep::Formula { formula, scale: TimeScale::Paper, factor: 1.0 };
    let solver = solver.with_time_step(&step, &Control::new())?;
    sources
        .iter()
        .map(|source| Ok(solver.field(std::slice::from_ref(source), &Control::new())?.into_distances()))
        .collect()
}

/// The raw numbers in a file.
fn numbers<T, const SIZE: usize>(path: &str, from_bytes: fn([u8; SIZE]) -> T) -> std::io::Result<Vec<T>> {
    Ok(std::fs::read(path)?.as_chunks().0.iter().map(|&bytes| from_bytes(bytes)).collect())
}

/// Three to a row.
fn rows<T: Copy>(numbers: &[T]) -> Vec<[T; 3]> {
    numbers.as_chunks().0.to_vec()
}

fn write(path: &Path, fields: &[Vec<f64>]) -> std::io::Result<()> {
    std::fs::write(path, fields.iter().flatten().flat_map(|distance| distance.to_le_bytes()).collect::<Vec<u8>>())
}
