//! The distances that the options ask for.

use crate::args::{FieldArgs, Method};
use crate::measured::{Seconds, measured};
use taut::{ExactSolver, HeatSolver, Mesh, Source};

/// What a method found, and what it took.
pub(crate) struct Field {
    pub(crate) distances: Vec<f64>,
    /// Up to which distance they are there.
    pub(crate) final_radius: f64,
    /// t in mesh units squared; None for the exact method.
    pub(crate) time_step: Option<f64>,
    pub(crate) setup: Seconds,
    pub(crate) solve: Seconds,
}

impl Field {
    /// The distances from `sources`; the exact method stops when it knows those of all `targets`, if there are any.
    pub(crate) fn compute(args: &FieldArgs, mesh: &Mesh, sources: &[Source], targets: Vec<u32>) -> taut::Result<Field> {
        match args.method {
            Method::Heat => heat(args, mesh, sources),
            Method::Exact => exact(args, mesh, sources, targets),
        }
    }
}

fn heat(args: &FieldArgs, mesh: &Mesh, sources: &[Source]) -> taut::Result<Field> {
    let options = args.heat.options();
    let (solver, setup) = measured("setup", |control| HeatSolver::new(mesh, &options, control));
    let solver = solver?;
    let (distances, solve) = measured("solve", |control| solver.distances(sources, control));
    let (distances, final_radius) = (distances?, f64::INFINITY);
    Ok(Field { distances, final_radius, time_step: Some(solver.time_step()), setup, solve })
}

fn exact(args: &FieldArgs, mesh: &Mesh, sources: &[Source], targets: Vec<u32>) -> taut::Result<Field> {
    let (solver, setup) = measured("setup", |_| ExactSolver::new(mesh));
    let solver = solver?;
    let options = args.exact.options(targets);
    let (field, solve) = measured("solve", |control| {
        args.exact.limit(control);
        solver.field(sources, &options, control)
    });
    let field = field?;
    let final_radius = field.final_radius();
    if let Some(reason) = field.interruption() {
        eprintln!("taut: {reason}: distances up to {final_radius} are final, the others are written as inf");
    }
    Ok(Field { distances: field.distances().to_vec(), final_radius, time_step: None, setup, solve })
}
