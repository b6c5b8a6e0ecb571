//! Distances by the heat method.
//!
//! ```text
//! 1.  (M + t L) u = δ         heat that spread from the sources for the time t
//! 2.  X = -∇u / |∇u|          the direction away from them, on every triangle
//! 3.  L φ = -∇·X              the function whose gradient comes nearest to X: the distance
//! ```
//!
//! M lumped mass, L cotangent stiffness (positive semidefinite), u heat, t time step, X unit field, φ distance. Step 2
//! takes the magnitude of u, which is positive but where cotangents are negative.
//!
//! The result is approximate: on good meshes the mean error is about one percent, and it falls as the mesh is refined.
//!
//! *Sources* are vertices, points and curves ([`place`]). *Several*: φ is constrained to what is known near each
//! ([`Shift::Pinned`]). *Offsets* o: the heat put in at a source is exp(-(o - min o) / √t), as u decays like
//! exp(-d / √t). *Boundary*: u is the blend (1 - b) u_Neumann + b u_Dirichlet. *Faded heat* starts anew ([`flow`]).
//!
//! Cost: building factorises two matrices (about V^1.5 time, V log V memory); a query costs three quarters of two solves
//! with them.
//!
//! References: K. Crane, C. Weischedel, M. Wardetzky: Geodesics in Heat: A New Approach to Computing Distance Based on
//! Heat Flow. ACM Transactions on Graphics, 2013.

mod batch;
mod boundary;
mod field;
mod flow;
mod place;
mod residual;
mod systems;
mod time_step;

use crate::control::{Control, Piece};
use crate::error::{Error, Reason, Result};
use crate::linear::Factor;
use crate::mesh::Mesh;
use crate::metric::Scale;
use crate::surface::source::Source;
use std::sync::Arc;
use std::time::{Duration, Instant};
use systems::Systems;

pub use crate::linear::Solver;
pub use field::HeatField;
pub use residual::HeatResiduals;
pub use time_step::{TimeFormula, TimeScale, TimeStep};

/// On which triangulation of the surface the operators are built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Laplacian {
    /// The intrinsic Delaunay triangulation, by edge flips on lengths: the default. It is far more accurate where the
    /// mesh has obtuse triangles.
    Intrinsic,
    /// The mesh's own triangles: plain cotangents.
    Plain,
}

/// What determines the constant that the Poisson problem leaves free.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Shift {
    /// Near each source the field has the distances that are known there: the source's offset at a vertex, the straight
    /// way to a point or a curve at the corners of its triangles. Nowhere is it less than the smallest offset of its
    /// component. A source that another reaches sooner, along edges, does not count. The default.
    Pinned,
    /// The field is shifted so that its minimum in each component is the smallest offset there, as Crane's reference
    /// code does.
    Min,
}

/// Options of a [`HeatSolver`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatOptions {
    /// On which triangulation the operators are built; the default is [`Laplacian::Intrinsic`].
    pub laplacian: Laplacian,
    /// Which code factorises the matrices; the default is [`Solver::Supernodal`].
    pub solver: Solver,
    /// The time step t; the default is [`TimeFormula::MeanEdge`] at paper scale, times 1.
    pub time_step: TimeStep,
    /// The boundary blend, from 0 (heat is reflected: Neumann conditions, the default) to 1 (absorbed: Dirichlet).
    pub boundary: f64,
    /// What determines the constant; the default is [`Shift::Pinned`].
    pub shift: Shift,
}

impl Default for HeatOptions {
    fn default() -> Self {
        HeatOptions {
            laplacian: Laplacian::Intrinsic,
            solver: Solver::Supernodal,
            time_step: TimeStep::Formula { formula: TimeFormula::MeanEdge, scale: TimeScale::Paper, factor: 1.0 },
            boundary: 0.0,
            shift: Shift::Pinned,
        }
    }
}

/// What building a [`HeatSolver`] did to the triangulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HeatReport {
    /// Whether all edges were lengthened a little, because some triangle had (almost) no area.
    pub mollified: bool,
    /// How many edges were flipped; 0 with [`Laplacian::Plain`].
    pub flips: u64,
    /// How many triangles are there twice, once for each side of the surface, because an edge had to flip near a boundary,
    /// near more than two triangles on an edge, or near the seam of a one-sided surface; 0 with [`Laplacian::Plain`].
    pub doubled_triangles: u64,
    /// How many edges are not Delaunay in the end, because rounding on needles does not let them flip, or because flips
    /// ended; near them u may be negative. An edge of doubled triangles counts once for each side. 0 with
    /// [`Laplacian::Plain`], which does not look.
    pub stuck_edges: u64,
    /// Whether flips were ended by their bound, 50 per edge, before nothing was left to flip.
    pub flip_bound_reached: bool,
    /// How long that took.
    pub times: HeatTimes,
}

/// How long the stages of building a [`HeatSolver`] took, by the clock; 0 for those that another solver had done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct HeatTimes {
    /// Edge lengths, mollification and edge flips.
    pub delaunay: Duration,
    /// The matrices M and L.
    pub assembly: Duration,
    /// The fill-reducing ordering.
    pub order: Duration,
    /// Where the factor has entries.
    pub symbolic: Duration,
    /// The factor of L.
    pub poisson: Duration,
    /// The factor of M + t L; two with a boundary blend.
    pub heat: Duration,
}

/// The factorised systems of one mesh, for any number of queries by any number of threads; clones share them.
#[derive(Debug, Clone)]
pub struct HeatSolver {
    systems: Arc<Systems>,
    /// t in units squared.
    time_step: f64,
    /// M + t L.
    neumann: Arc<Factor>,
    /// The same, with u = 0 held on the boundary; only if the boundary blend is not 0.
    dirichlet: Option<Arc<Factor>>,
    factor_time: Duration,
}

impl HeatSolver {
    /// Builds and factorises the systems of `mesh`.
    ///
    /// # Errors
    /// [`Reason::BadArgument`] if `boundary` is not in [0, 1]; [`Reason::BadTimeStep`] as [`TimeStep::value`], or if t is
    /// out of all proportion to the mesh; [`Reason::MissingFeature`] if the build lacks the solver;
    /// [`Reason::NotPositiveDefinite`] if a factorisation breaks down; [`Reason::OutOfMemory`];
    /// [`Reason::TooManyElements`]; [`Reason::Cancelled`].
    pub fn new(mesh: &Mesh, options: &HeatOptions, control: &Control) -> Result<HeatSolver> {
        if !(0.0..=1.0).contains(&options.boundary) {
            let message = format!("boundary is {}, which is not in [0, 1]", options.boundary);
            return Err(Error::new(Reason::BadArgument, message));
        }
        HeatSolver::build(mesh, options, None, control)
    }

    /// A solver for another time step; it shares everything but the heat systems, which are factorised anew.
    ///
    /// # Errors
    /// As [`HeatSolver::new`].
    pub fn with_time_step(&self, step: &TimeStep, control: &Control) -> Result<HeatSolver> {
        let time_step = step.unit_value(&self.systems.mesh, self.systems.scale)?;
        let piece = Piece::whole(control);
        piece.checkpoint(0.0)?;
        HeatSolver::timed(Arc::clone(&self.systems), time_step, &piece)
    }

    /// A solver with the options of this one for the same triangles in another place, as
    /// [`Mesh::with_positions`] gives them. It saves the fill-reducing ordering, and where no other edges
    /// are flipped than before the symbolic analysis too.
    ///
    /// The time step is that of the options of [`HeatSolver::new`].
    ///
    /// # Errors
    /// [`Reason::BadArgument`] if the mesh has other triangles or another number of vertices; else as
    /// [`HeatSolver::new`].
    pub fn with_mesh(&self, mesh: &Mesh, control: &Control) -> Result<HeatSolver> {
        let before = &self.systems.mesh;
        if mesh.vertex_count() != before.vertex_count() || mesh.triangles() != before.triangles() {
            return Err(Error::new(Reason::BadArgument, "the mesh has other triangles than the one before"));
        }
        HeatSolver::build(mesh, &self.systems.options, Some(&self.systems), control)
    }

    /// The mesh that it was built for.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.systems.mesh
    }

    /// The time step t, in mesh units squared; +inf or 0 where these do not fit a number.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        let scale = self.systems.scale;
        scale.to_mesh(scale.to_mesh(self.time_step))
    }

    /// What building did.
    #[must_use]
    pub fn report(&self) -> HeatReport {
        let report = self.systems.report;
        HeatReport { times: HeatTimes { heat: self.factor_time, ..report.times }, ..report }
    }

    /// The distances of all vertices to the nearest source, its offset included.
    ///
    /// # Errors
    /// [`Reason::NoSource`]; [`Reason::VertexOutOfRange`] and [`Reason::BadArgument`] (no place on the mesh, or an offset
    /// that is not finite or out of all proportion to the mesh) name the source, as does [`Reason::SourceOnBoundary`],
    /// raised only if the boundary blend is 1; [`Reason::NotPositiveDefinite`] if a solution is not finite;
    /// [`Reason::OutOfMemory`]; [`Reason::Cancelled`].
    pub fn field(&self, sources: &[Source], control: &Control) -> Result<HeatField> {
        let seeds = Source::checked(sources, &self.systems.mesh)?;
        let [field] = self.fields([(0, &seeds)], Piece::whole(control))?;
        Ok(field)
    }

    fn build(mesh: &Mesh, options: &HeatOptions, like: Option<&Systems>, control: &Control) -> Result<HeatSolver> {
        let scale = Scale::of(mesh);
        let time_step = options.time_step.unit_value(mesh, scale)?;
        let piece = Piece::whole(control);
        piece.checkpoint(0.0)?;
        let systems = Systems::new(mesh, scale, options, like, &piece.part(0.0, 0.7))?;
        HeatSolver::timed(Arc::new(systems), time_step, &piece.part(0.7, 1.0))
    }

    fn timed(systems: Arc<Systems>, time_step: f64, piece: &Piece) -> Result<HeatSolver> {
        let start = Instant::now();
        let neumann = Arc::new(systems.factor_heat(time_step, false, &piece.part(0.0, 0.5))?);
        let dirichlet = match systems.options.boundary > 0.0 {
            true => Some(Arc::new(systems.factor_heat(time_step, true, &piece.part(0.5, 1.0))?)),
            false => None,
        };
        piece.checkpoint(1.0)?;
        Ok(HeatSolver { systems, time_step, neumann, dirichlet, factor_time: start.elapsed() })
    }
}
