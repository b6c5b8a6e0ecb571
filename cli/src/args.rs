//! Options that several commands share.

use crate::{Cli, numbers};
use clap::error::ErrorKind;
use clap::{Args, CommandFactory, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;
use taut::{Control, ExactOptions, HeatOptions, Laplacian, Shift, Solver, TimeFormula, TimeScale, TimeStep};
use taut_eval::FORMULAS;

/// A field of distances: on which mesh, from where and how.
#[derive(Debug, Args)]
pub(crate) struct FieldArgs {
    /// Mesh file: .glb, .obj, .off, .ply or .stl, also with .gz behind it
    pub(crate) mesh: PathBuf,

    #[command(flatten)]
    pub(crate) sources: SourceArgs,

    /// How distances are found
    #[arg(long, value_enum, default_value_t = Method::Heat)]
    pub(crate) method: Method,

    #[command(flatten)]
    pub(crate) heat: HeatArgs,

    #[command(flatten)]
    pub(crate) exact: ExactArgs,
}

/// Where distances are measured from; sources count from 0, vertices before points, and curves last.
#[derive(Debug, Args)]
pub(crate) struct SourceArgs {
    /// Source vertex; may be given several times, for the distance to the nearest
    #[arg(long = "source", value_name = "V", conflicts_with = "sources")]
    pub(crate) source: Vec<u32>,

    /// Source on the surface where it is nearest to this point; may be given several times
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "X,Y,Z",
        value_parser = position,
        allow_hyphen_values = true,
        conflicts_with = "sources"
    )]
    pub(crate) source_at: Vec<[f64; 3]>,

    /// File of sources, one a line; # begins a comment:
    ///   V [D]               a vertex and, if wanted, its start distance
    ///   F W0 W1 W2 [D]      a point of triangle F by the weights of its corners, which sum to 1
    #[arg(verbatim_doc_comment, long, value_name = "FILE")]
    pub(crate) sources: Option<PathBuf>,

    /// File of curves on the surface, each a source as a whole; may be given several times. One
    /// point a line, a blank line between curves; # begins a comment:
    ///   V                   a vertex
    ///   F W0 W1 W2          a point of triangle F by the weights of its corners
    ///   X Y Z               the point of the surface nearest to this one
    /// Points that follow each other are joined within a triangle or by a shortest path. What
    /// `taut path` prints are such curves; of an .obj file, as `taut path` and `taut isolines`
    /// write, each polyline is one
    #[arg(verbatim_doc_comment, long, value_name = "FILE")]
    pub(crate) source_curve: Vec<PathBuf>,
}

/// A point in space on the command line.
pub(crate) fn position(text: &str) -> Result<[f64; 3], &'static str> {
    numbers::triple(text).filter(|point| point.iter().all(|x| x.is_finite())).ok_or("not three finite numbers x,y,z")
}

const HEAT: &str = "Options of the heat method";

/// Each is `None` where it was not given, so that the exact method can refuse it.
#[derive(Debug, Args)]
pub(crate) struct HeatArgs {
    /// How long heat flows, t; less is sharper, more is smoother. With the mean ē and standard
    /// deviation σ of the edge lengths, and the numbers of the paper's equations:
    ///   mean-edge    ē² (1, the default)
    ///   sigma        σ (2)
    ///   mean-sigma   (ē² + σ) / 2 (3)
    ///   median-fit   1.01204 σ - 0.0001 (4)
    ///   median-mean  (ē² + 1.01204 σ - 0.0001) / 2 (5)
    ///   a number     t itself, in the mesh's units squared
    #[arg(verbatim_doc_comment, help_heading = HEAT, long, value_name = "FORMULA|T", value_parser = time_step, allow_negative_numbers = true)]
    time_step: Option<TimeStepArg>,

    /// Units in which a formula is evaluated [default: paper]
    #[arg(help_heading = HEAT, long, value_enum, value_name = "SCALE")]
    time_scale: Option<TimeScaleArg>,

    /// Multiply a formula's t by this [default: 1]
    #[arg(help_heading = HEAT, long, value_name = "M", allow_negative_numbers = true)]
    time_factor: Option<f64>,

    /// Laplacian of the heat flow [default: intrinsic]
    #[arg(help_heading = HEAT, long, value_enum)]
    laplacian: Option<LaplacianArg>,

    /// Code that factorises the linear systems [default: supernodal]
    #[arg(help_heading = HEAT, long, value_enum)]
    solver: Option<SolverArg>,

    /// Heat at the boundary of the mesh: from 0, none leaves, to 1, all is swallowed [default: 0]
    #[arg(help_heading = HEAT, long, value_name = "B", allow_negative_numbers = true)]
    boundary: Option<f64>,

    /// Where distances begin [default: pinned]
    #[arg(help_heading = HEAT, long, value_enum)]
    shift: Option<ShiftArg>,
}

const EXACT: &str = "Options of the exact method";

#[derive(Debug, Args)]
pub(crate) struct ExactArgs {
    /// Stop at this distance, in the units of the mesh; what is farther counts as unreachable
    #[arg(help_heading = EXACT, long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,

    /// Give up after this many seconds
    #[arg(help_heading = EXACT, long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    time_limit: Option<Duration>,

    /// Give up at this many megabytes of memory, beside those of the mesh
    #[arg(help_heading = EXACT, long, value_name = "MB")]
    memory_limit: Option<usize>,

    /// At a limit, write what is final by then; the rest counts as unreachable
    #[arg(help_heading = EXACT, long)]
    partial: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Method {
    /// Fast and approximate, by the flow of heat
    Heat,
    /// Shortest paths over the triangles, exact up to rounding
    Exact,
}

#[derive(Debug, Clone, Copy)]
enum TimeStepArg {
    Formula(TimeFormula),
    Value(f64),
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum TimeScaleArg {
    /// As if the mesh were scaled to the size of the paper's meshes
    Paper,
    /// The units of the mesh as they stand
    Raw,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum LaplacianArg {
    /// Of the Delaunay triangulation of the same surface: good on bad triangles too
    Intrinsic,
    /// Cotangents of the triangles as they are
    Plain,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SolverArg {
    /// Supernodal Cholesky factors
    Supernodal,
    /// LDLᵀ factors by sprs-ldl
    Ldl,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ShiftArg {
    /// Each source has its own start distance
    Pinned,
    /// The least distance is moved to 0
    Min,
}

fn time_step(text: &str) -> Result<TimeStepArg, String> {
    if let Some(&(_, formula)) = FORMULAS.iter().find(|(name, _)| *name == text) {
        return Ok(TimeStepArg::Formula(formula));
    }
    let expected = || format!("neither a number nor one of {}", FORMULAS.map(|(name, _)| name).join(", "));
    text.parse().map(TimeStepArg::Value).map_err(|_| expected())
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().map_err(|_| "not a number".to_owned())?;
    Duration::try_from_secs_f64(seconds).map_err(|error| error.to_string())
}

impl FieldArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> Result<(), clap::Error> {
        self.sources.check()?;
        check_method(self.method, &self.heat, &self.exact)
    }
}

/// Refuses options of the method that is not used, and what clap cannot see by itself.
pub(crate) fn check_method(method: Method, heat: &HeatArgs, exact: &ExactArgs) -> Result<(), clap::Error> {
    exact.check()?;
    let error = |kind, message: &str| Err(Cli::command().error(kind, message));
    if let (Method::Exact, Some(option)) = (method, heat.first_given()) {
        let message = format!("{option} belongs to the heat method and means nothing with --method exact");
        return error(ErrorKind::ArgumentConflict, &message);
    }
    if let (Method::Heat, Some(option)) = (method, exact.first_given()) {
        let message = format!("{option} belongs to the exact method and means nothing without --method exact");
        return error(ErrorKind::ArgumentConflict, &message);
    }
    if let (Some(TimeStepArg::Value(_)), Some(_)) = (heat.time_step, heat.time_factor) {
        let message = "--time-factor multiplies a formula's t; --time-step gives t as a number";
        return error(ErrorKind::ArgumentConflict, message);
    }
    Ok(())
}

impl SourceArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> Result<(), clap::Error> {
        let is_given = !self.source.is_empty() || !self.source_at.is_empty();
        if !is_given && self.sources.is_none() && self.source_curve.is_empty() {
            let message = "give at least one --source or --source-at, a file of --sources, or one of a --source-curve";
            return Err(Cli::command().error(ErrorKind::MissingRequiredArgument, message));
        }
        Ok(())
    }
}

impl HeatArgs {
    pub(crate) fn first_given(&self) -> Option<&'static str> {
        let given = [
            ("--time-step", self.time_step.is_some()),
            ("--time-scale", self.time_scale.is_some()),
            ("--time-factor", self.time_factor.is_some()),
            ("--laplacian", self.laplacian.is_some()),
            ("--solver", self.solver.is_some()),
            ("--boundary", self.boundary.is_some()),
            ("--shift", self.shift.is_some()),
        ];
        given.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }

    /// The library's options, its defaults where nothing was given.
    pub(crate) fn options(&self) -> HeatOptions {
        let default = HeatOptions::default();
        HeatOptions {
            laplacian: self.laplacian.map_or(default.laplacian, |laplacian| match laplacian {
                LaplacianArg::Intrinsic => Laplacian::Intrinsic,
                LaplacianArg::Plain => Laplacian::Plain,
            }),
            solver: self.solver.map_or(default.solver, |solver| match solver {
                SolverArg::Supernodal => Solver::Supernodal,
                SolverArg::Ldl => Solver::Ldl,
            }),
            time_step: self.time_step(),
            boundary: self.boundary.unwrap_or(default.boundary),
            shift: self.shift.map_or(default.shift, |shift| match shift {
                ShiftArg::Pinned => Shift::Pinned,
                ShiftArg::Min => Shift::Min,
            }),
        }
    }

    fn time_step(&self) -> TimeStep {
        let scale = match self.time_scale.unwrap_or(TimeScaleArg::Paper) {
            TimeScaleArg::Paper => TimeScale::Paper,
            TimeScaleArg::Raw => TimeScale::Raw,
        };
        match self.time_step.unwrap_or(TimeStepArg::Formula(TimeFormula::MeanEdge)) {
            TimeStepArg::Formula(formula) => {
                TimeStep::Formula { formula, scale, factor: self.time_factor.unwrap_or(1.0) }
            }
            TimeStepArg::Value(t) => TimeStep::Value(t),
        }
    }
}

impl ExactArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> Result<(), clap::Error> {
        if self.partial && self.time_limit.is_none() && self.memory_limit.is_none() {
            let message = "--partial needs a --time-limit or a --memory-limit";
            return Err(Cli::command().error(ErrorKind::MissingRequiredArgument, message));
        }
        Ok(())
    }

    pub(crate) fn first_given(&self) -> Option<&'static str> {
        let given = [
            ("--radius", self.radius.is_some()),
            ("--time-limit", self.time_limit.is_some()),
            ("--memory-limit", self.memory_limit.is_some()),
            ("--partial", self.partial),
        ];
        given.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
    }

    /// The library's options, its defaults where nothing was given.
    pub(crate) fn options(&self) -> ExactOptions {
        let default = ExactOptions::default();
        ExactOptions { radius: self.radius.unwrap_or(default.radius), allow_partial: self.partial, ..default }
    }

    /// Sets the limits; the time begins now.
    pub(crate) fn limit(&self, control: &Control) {
        if let Some(limit) = self.time_limit {
            control.set_time_limit(limit);
        }
        if let Some(megabytes) = self.memory_limit {
            control.set_memory_limit(megabytes.saturating_mul(1_000_000));
        }
    }
}
