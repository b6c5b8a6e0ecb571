//! The distances that the options ask for.

use crate::args::{ExactArgs, FieldArgs, HeatArgs, Method};
use crate::measured::{Seconds, measured};
use serde::Serialize;
use taut::{ExactField, ExactOptions, ExactSolver, HeatField, HeatReport, HeatSolver, Mesh, Source, Target};

/// What a method found, and what it took.
pub(crate) struct Field {
    pub(crate) distances: Vec<f64>,
    /// Up to which distance they are there.
    pub(crate) final_radius: f64,
    /// t in mesh units squared; None for the exact method.
    pub(crate) time_step: Option<f64>,
    /// What the heat method met with.
    pub(crate) heat: Option<HeatFacts>,
    pub(crate) setup: Seconds,
    pub(crate) solve: Seconds,
}

/// What the heat method did to the triangulation, where its heat is doubtful, and how long its stages took.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct HeatFacts {
    flips: u64,
    doubled_triangles: u64,
    stuck_edges: u64,
    flip_bound_reached: bool,
    mollified: bool,
    restarts: u32,
    nonpositive_heat: u64,
    seconds: Stages,
}

/// The seconds of each stage of the set-up.
#[derive(Debug, Clone, Copy, Serialize)]
struct Stages {
    delaunay: f64,
    assembly: f64,
    order: f64,
    symbolic: f64,
    poisson: f64,
    heat: f64,
}

impl HeatFacts {
    fn new(report: &HeatReport, field: &HeatField) -> HeatFacts {
        let times = report.times;
        HeatFacts {
            flips: report.flips,
            doubled_triangles: report.doubled_triangles,
            stuck_edges: report.stuck_edges,
            flip_bound_reached: report.flip_bound_reached,
            mollified: report.mollified,
            restarts: field.restarts(),
            nonpositive_heat: field.nonpositive_heat(),
            seconds: Stages {
                delaunay: times.delaunay.as_secs_f64(),
                assembly: times.assembly.as_secs_f64(),
                order: times.order.as_secs_f64(),
                symbolic: times.symbolic.as_secs_f64(),
                poisson: times.poisson.as_secs_f64(),
                heat: times.heat.as_secs_f64(),
            },
        }
    }
}

impl Field {
    /// The distances from `sources`; the exact method stops when it knows those of all `targets`, if there are any.
    pub(crate) fn compute(
        args: &FieldArgs,
        mesh: &Mesh,
        sources: &[Source],
        targets: Vec<Target>,
    ) -> taut::Result<Field> {
        match args.method {
            Method::Heat => heat(args, mesh, sources),
            Method::Exact => exact(args, mesh, sources, targets),
        }
    }
}

fn heat(args: &FieldArgs, mesh: &Mesh, sources: &[Source]) -> taut::Result<Field> {
    let (solver, field, [setup, solve]) = heat_field(&args.heat, mesh, sources)?;
    let heat = Some(HeatFacts::new(&solver.report(), &field));
    let (distances, final_radius) = (field.into_distances(), f64::INFINITY);
    Ok(Field { distances, final_radius, time_step: Some(solver.time_step()), heat, setup, solve })
}

fn exact(args: &FieldArgs, mesh: &Mesh, sources: &[Source], targets: Vec<Target>) -> taut::Result<Field> {
    let options = ExactOptions { targets, ..args.exact.options() };
    let (field, [setup, solve]) = exact_field(&args.exact, mesh, sources, &options)?;
    let (distances, final_radius) = (field.distances().to_vec(), field.final_radius());
    Ok(Field { distances, final_radius, time_step: None, heat: None, setup, solve })
}

/// What the heat method finds, with its solver, and the seconds of set-up and solve.
pub(crate) fn heat_field(
    args: &HeatArgs,
    mesh: &Mesh,
    sources: &[Source],
) -> taut::Result<(HeatSolver, HeatField, [Seconds; 2])> {
    let options = args.options();
    let (solver, setup) = measured("setup", |control| HeatSolver::new(mesh, &options, control));
    let solver = solver?;
    let (field, solve) = measured("solve", |control| solver.field(sources, control));
    Ok((solver, field?, [setup, solve]))
}

/// What the exact method finds within the limits of the command line, and the seconds of set-up and solve; says where a
/// limit ended it.
pub(crate) fn exact_field(
    limits: &ExactArgs,
    mesh: &Mesh,
    sources: &[Source],
    options: &ExactOptions,
) -> taut::Result<(ExactField, [Seconds; 2])> {
    let (solver, setup) = measured("setup", |_| ExactSolver::new(mesh));
    let solver = solver?;
    let (field, solve) = measured("solve", |control| {
        limits.limit(control);
        solver.field(sources, options, control)
    });
    let field = field?;
    if let Some(reason) = field.interruption() {
        let radius = field.final_radius();
        eprintln!("taut: {reason}: distances up to {radius} are final, what is farther counts as unreachable");
    }
    Ok((field, [setup, solve]))
}
