//! Exact distances along the surface of a polyhedral mesh.
//!
//! A shortest path is straight inside each triangle and across each edge once the triangles are unfolded, and bends only
//! at *pseudo-sources*: vertices with more than 2π of surface around them, reflex boundary corners, places that are not
//! manifold. Bundles of such straight lines travel over the mesh as [windows](window); where they meet, the shorter one
//! survives. Distances are exact up to rounding, about 1e-15 of the largest on ordinary meshes.
//!
//! Data path: [`charts`] (each triangle laid flat) -> [`propagate`] (windows cross triangles; [`envelope`] trims them)
//! -> labels of the vertices.
//!
//! Cost: O(V²) windows in the worst case, about 20 per triangle on scans; the memory grows with the front only.

mod charts;
mod envelope;
mod propagate;
mod stop;
mod window;

use crate::control::Control;
use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;
use crate::metric::Scale;
use crate::surface::point::Source;
use charts::{Bend, Chart};
use propagate::Front;
use std::sync::Arc;
use stop::{Stop, Units};

/// A mesh prepared for exact distances. Clones share the preparation; any number of threads may use one.
///
/// ```
/// # fn main() -> taut::Result<()> {
/// use taut::{Control, ExactOptions, ExactSolver, Mesh, Source};
/// let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let mesh = Mesh::from_triangles(&square, &[[0, 1, 3], [1, 2, 3]])?;
/// let field = ExactSolver::new(&mesh)?.field(&[Source::vertex(0)], &ExactOptions::default(), &Control::new())?;
/// assert!((field.distances()[2] - 2f64.sqrt()).abs() < 1e-15);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone)]
pub struct ExactSolver(Arc<Prepared>);

/// What every propagation over one mesh shares.
#[derive(Debug)]
pub(crate) struct Prepared {
    mesh: Mesh,
    scale: Scale,
    charts: Vec<Chart>,
    bends: Vec<Bend>,
    /// Which triangles remember the windows that crossed them.
    remembers: Vec<bool>,
}

/// When to stop before every vertex is reached: vertices beyond [`ExactField::final_radius`] then have +inf.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactOptions {
    /// Vertices whose distances are wanted; none means all. The work stops once all of these are final.
    pub targets: Vec<u32>,
    /// The largest distance wanted, start distances included, in mesh units and not negative; the default is +inf.
    /// Vertices that are farther have +inf, and the work stops once all others are final.
    pub radius: f64,
    /// Whether work that is cancelled or reaches a limit of its [`Control`] succeeds with the distances that are final
    /// by then; else, the default, it fails.
    pub allow_partial: bool,
}

impl Default for ExactOptions {
    fn default() -> ExactOptions {
        ExactOptions { targets: Vec::new(), radius: f64::INFINITY, allow_partial: false }
    }
}

/// The exact distances from one set of sources.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactField {
    distances: Vec<f64>,
    final_radius: f64,
    interruption: Option<Error>,
    windows: u64,
}

impl ExactSolver {
    /// Prepares a mesh: lays each triangle flat and finds the pseudo-sources. O(V + F) time, 120 bytes per triangle.
    ///
    /// # Errors
    /// None today; the mesh was checked when it was made.
    pub fn new(mesh: &Mesh) -> Result<ExactSolver> {
        let scale = Scale::of(mesh);
        let charts = charts::charts(mesh, scale);
        let sliver = charts::slivers(&charts);
        let bends = charts::bends(mesh, &charts, &sliver);
        let remembers = charts::remembering(mesh, &charts);
        Ok(ExactSolver(Arc::new(Prepared { mesh: mesh.clone(), scale, charts, bends, remembers })))
    }

    /// The distance of every vertex from the nearest of `sources`, each with its start distance.
    ///
    /// Progress counts settled vertices. The control is consulted every few thousand windows, about a millisecond
    /// apart. Its memory limit counts 32 bytes a vertex and 12 a triangle, which are taken before the first look
    /// at it, and the windows of the moving front.
    ///
    /// # Errors
    /// [`Reason::NoSource`], [`Reason::VertexOutOfRange`] and [`Reason::BadArgument`] naming the source or target;
    /// [`Reason::BadArgument`] for a radius that is negative or NaN; unless `allow_partial` is set,
    /// [`Reason::Cancelled`], [`Reason::TimeLimit`], [`Reason::MemoryLimit`].
    pub fn field(&self, sources: &[Source], options: &ExactOptions, control: &Control) -> Result<ExactField> {
        let vertices = self.0.mesh.vertex_count();
        let sources = Source::checked(sources, vertices)?;
        check_targets(&options.targets, vertices)?;
        check_radius(options.radius)?;
        // Start distances count from the least one, so that no label is negative.
        let least = sources.iter().map(|source| source.offset()).fold(f64::INFINITY, f64::min);
        let units = Units { scale: self.0.scale, least };
        let mut is_source = vec![false; vertices];
        let mut front = Front::new(&self.0);
        for source in &sources {
            is_source[source.vertex_index() as usize] = true;
            front.start(source.vertex_index(), self.0.scale.to_unit(source.offset() - least));
        }
        let mut stop = Stop::new(units, options.radius, &options.targets);
        let (rho, ended) = front.run(&is_source, &mut stop, control);
        let interruption = match ended {
            Err(error) if !options.allow_partial => return Err(error),
            ended => ended.err(),
        };
        let windows = front.crossed();
        let mut distances = front.into_labels();
        distances.iter_mut().for_each(|d| *d = units.to_mesh(*d));
        let final_radius = units.final_radius(rho).min(options.radius);
        let mut is_cut = rho < f64::INFINITY;
        for d in distances.iter_mut().filter(|d| **d > final_radius) {
            is_cut |= *d < f64::INFINITY;
            *d = f64::INFINITY;
        }
        let final_radius = if is_cut { final_radius } else { f64::INFINITY };
        Ok(ExactField { distances, final_radius, interruption, windows })
    }
}

fn check_radius(radius: f64) -> Result<()> {
    if radius >= 0.0 {
        return Ok(());
    }
    Err(Error::new(Reason::BadArgument, format!("radius is {radius}, which is not a distance")))
}

fn check_targets(targets: &[u32], vertices: usize) -> Result<()> {
    match (0..).zip(targets).find(|&(_, &v)| v as usize >= vertices) {
        None => Ok(()),
        Some((i, v)) => {
            let message = format!("is vertex {v}, but the mesh has {vertices} vertices");
            Err(Error::at(Reason::VertexOutOfRange, Element::Target(i), message))
        }
    }
}

impl ExactField {
    /// Distance of each vertex in mesh units; +inf where no source reaches, and beyond [`ExactField::final_radius`].
    #[must_use]
    pub fn distances(&self) -> &[f64] {
        &self.distances
    }

    /// Distances up to this one are there and final, beyond it all are +inf; +inf itself if nothing was left out.
    ///
    /// Work that was interrupted early may know no distance for certain, not even its sources': then this is below the
    /// least start distance.
    #[must_use]
    pub fn final_radius(&self) -> f64 {
        self.final_radius
    }

    /// Why the work was interrupted before it had all that was asked for, where
    /// [`allow_partial`](ExactOptions::allow_partial) let it succeed all the same.
    #[must_use]
    pub fn interruption(&self) -> Option<&Error> {
        self.interruption.as_ref()
    }

    /// How many windows crossed a triangle: a measure of the work that does not depend on the machine.
    #[must_use]
    pub fn windows(&self) -> u64 {
        self.windows
    }
}
