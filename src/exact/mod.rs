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
mod window;

use crate::control::Control;
use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;
use crate::metric::Scale;
use crate::surface::point::Source;
use charts::{Bend, Chart};
use propagate::Front;
use std::sync::Arc;

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
    /// Which triangles are slivers.
    sliver: Vec<bool>,
    /// Which triangles remember the windows that crossed them.
    remembers: Vec<bool>,
    longest_edge: f64,
}

/// When to stop before every vertex is reached.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ExactOptions {
    /// Vertices whose distances are wanted; none means all. The work stops once all of these are final, and vertices
    /// beyond [`ExactField::final_radius`] then have +inf.
    pub targets: Vec<u32>,
}

/// The exact distances from one set of sources.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactField {
    distances: Vec<f64>,
    final_radius: f64,
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
        let remembers = charts::remembering(mesh, &sliver);
        let edge_of = &mesh.topology().edge_of;
        let edges = charts.iter().zip(edge_of).filter(|&(_, &e)| e != crate::mesh::topology::NONE);
        let longest_edge = edges.map(|(chart, _)| chart.length).fold(0.0, f64::max);
        Ok(ExactSolver(Arc::new(Prepared {
            mesh: mesh.clone(),
            scale,
            charts,
            bends,
            sliver,
            remembers,
            longest_edge,
        })))
    }

    /// The distance of every vertex from the nearest of `sources`, each with its start distance.
    ///
    /// Progress counts settled vertices; the control is consulted every few hundred of them.
    ///
    /// # Errors
    /// [`Reason::NoSource`], [`Reason::VertexOutOfRange`] and [`Reason::BadArgument`] naming the source or target,
    /// [`Reason::Cancelled`].
    pub fn field(&self, sources: &[Source], options: &ExactOptions, control: &Control) -> Result<ExactField> {
        let vertices = self.0.mesh.vertex_count();
        let sources = Source::checked(sources, vertices)?;
        check_targets(&options.targets, vertices)?;
        // Start distances count from the least one, so that no label is negative.
        let least = sources.iter().map(|source| source.offset()).fold(f64::INFINITY, f64::min);
        let mut is_source = vec![false; vertices];
        let mut front = Front::new(&self.0);
        for source in &sources {
            is_source[source.vertex_index() as usize] = true;
            front.start(source.vertex_index(), self.0.scale.to_unit(source.offset() - least));
        }
        let radius = front.run(&is_source, &options.targets, control)?;
        let windows = front.crossed();
        let to_mesh =
            |distance: f64| if distance <= radius { self.0.scale.to_mesh(distance) + least } else { f64::INFINITY };
        let distances = front.into_labels().into_iter().map(to_mesh).collect();
        Ok(ExactField { distances, final_radius: to_mesh(radius), windows })
    }
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

    /// Distances up to this one are there and final: +inf unless the work stopped at its targets.
    #[must_use]
    pub fn final_radius(&self) -> f64 {
        self.final_radius
    }

    /// How many windows crossed a triangle: a measure of the work that does not depend on the machine.
    #[must_use]
    pub fn windows(&self) -> u64 {
        self.windows
    }
}
