//! Exact distances along the surface of a polyhedral mesh.
//!
//! A shortest path is straight inside each triangle and across each edge once the triangles are unfolded, and bends only
//! at *pseudo-sources*: vertices with more than 2π of surface around them, reflex boundary corners, places that are not
//! manifold. Bundles of such straight lines travel over the mesh as [windows](window); where they meet, the shorter one
//! survives. Distances are exact up to rounding, about 1e-15 of the largest on ordinary meshes. Sources are vertices, points
//! and curves.
//!
//! Data path: [`charts`] (each triangle laid flat) -> [`start`] (windows leave the sources) -> [`propagate`] (they cross
//! triangles; [`envelope`] trims them; [`stop`] ends it early) -> labels of the vertices -> [`trace`] (any point; paths).
//! [`batch`] does many at once, [`join`] makes curves.
//!
//! Cost: O(V²) windows in the worst case, about 20 per triangle on scans; the memory grows with the front only.

mod batch;
mod bends;
mod charts;
mod envelope;
mod join;
mod kept;
mod propagate;
mod segment;
mod start;
mod stop;
mod trace;
mod window;

use crate::control::{Control, Piece};
use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;
use crate::metric::Scale;
use crate::surface::curve::Curve;
use crate::surface::point::{Place, SurfacePoint};
use crate::surface::source::{Origin, Seed, Source};
use crate::surface::target::Target;
pub use batch::SparseDistances;
use bends::Bends;
use charts::Chart;
use propagate::{Found, Front};
use std::sync::Arc;
use stop::{Aim, Stop, Units};
use trace::{Best, Trace};
use window::{Mixed, Rays, Spreading};

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
    bends: Bends,
    /// Which triangles remember the windows that crossed them.
    remembers: Vec<bool>,
}

/// When to stop before every vertex is reached: vertices beyond [`ExactField::final_radius`] then have +inf.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactOptions {
    /// The places whose distances are wanted; none means all. The work stops once all of these are final.
    pub targets: Vec<Target>,
    /// The largest distance wanted, start distances included, in mesh units and not negative; the default is +inf.
    /// Vertices that are farther have +inf, and the work stops once all others are final.
    pub radius: f64,
    /// Whether work that is cancelled or reaches a limit of its [`Control`] succeeds with the distances that are final
    /// by then; else, the default, it fails.
    pub allow_partial: bool,
    /// Whether the field keeps its windows, which distances and paths of points that are no vertices need: about 50 bytes
    /// for each of [`ExactField::windows`].
    pub keep_windows: bool,
}

impl Default for ExactOptions {
    fn default() -> ExactOptions {
        ExactOptions { targets: Vec::new(), radius: f64::INFINITY, allow_partial: false, keep_windows: false }
    }
}

/// The exact distances from one set of sources, and the shortest paths to them.
#[derive(Debug, Clone)]
pub struct ExactField {
    solver: Arc<Prepared>,
    units: Units,
    found: Arc<Found>,
    distances: Vec<f64>,
    final_radius: f64,
    interruption: Option<Error>,
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
        let bends = Bends::new(mesh, &charts, &sliver);
        let remembers = charts::remembering(mesh, &charts);
        Ok(ExactSolver(Arc::new(Prepared { mesh: mesh.clone(), scale, charts, bends, remembers })))
    }

    /// The distance of every vertex from the nearest of `sources`, each with its start distance.
    ///
    /// Progress counts settled vertices. The control is consulted every few thousand windows, about a millisecond
    /// apart. Its memory limit counts 50 bytes a vertex and 12 a triangle, which are taken before the first look
    /// at it, and the windows of the moving front.
    ///
    /// # Errors
    /// [`Reason::NoSource`], [`Reason::VertexOutOfRange`] and [`Reason::BadArgument`] naming the source or target;
    /// [`Reason::BadArgument`] for a radius that is negative or NaN; unless `allow_partial` is set,
    /// [`Reason::Cancelled`], [`Reason::TimeLimit`], [`Reason::MemoryLimit`].
    pub fn field(&self, sources: &[Source], options: &ExactOptions, control: &Control) -> Result<ExactField> {
        self.field_within(sources, options, Piece::whole(control))
    }

    fn field_within(&self, sources: &[Source], options: &ExactOptions, control: Piece) -> Result<ExactField> {
        let seeds = Source::checked(sources, &self.0.mesh)?;
        let aims = self.0.aims(&options.targets)?;
        check_radius(options.radius)?;
        let (found, units, rho, ended) = match has_curves(&seeds) {
            false => self.0.find::<Spreading>(&seeds, &aims, options, control),
            true => self.0.find::<Mixed>(&seeds, &aims, options, control),
        };
        let interruption = match ended {
            Err(error) if !options.allow_partial => return Err(error),
            ended => ended.err(),
        };
        let mut distances: Vec<f64> = found.label.iter().map(|&label| units.to_mesh(label)).collect();
        let final_radius = units.final_radius(rho).min(options.radius);
        let mut is_cut = rho < f64::INFINITY;
        for d in distances.iter_mut().filter(|d| **d > final_radius) {
            is_cut |= *d < f64::INFINITY;
            *d = f64::INFINITY;
        }
        let final_radius = if is_cut { final_radius } else { f64::INFINITY };
        Ok(ExactField { solver: self.0.clone(), units, found: Arc::new(found), distances, final_radius, interruption })
    }
}

impl Prepared {
    /// What there is to find from checked sources; its units and ρ.
    fn find<R: Rays>(
        &self,
        seeds: &[Seed],
        aims: &[Aim],
        options: &ExactOptions,
        control: Piece,
    ) -> (Found, Units, f64, Result<()>) {
        let mut front = Front::<R>::new(self);
        if options.keep_windows {
            front.keep_windows();
        }
        let (units, rho, ended) = self.propagate(&mut front, seeds, options.radius, aims, control);
        (front.finish(), units, rho, ended)
    }

    /// Propagates from checked sources, on a front without any. Returns its units and ρ: labels below it are final.
    fn propagate<R: Rays>(
        &self,
        front: &mut Front<R>,
        seeds: &[Seed],
        radius: f64,
        aims: &[Aim],
        control: Piece,
    ) -> (Units, f64, Result<()>) {
        // Start distances count from the least one, so that no label is negative.
        let least = seeds.iter().map(|seed| seed.offset).fold(f64::INFINITY, f64::min);
        let units = self.begin(front, seeds, least);
        let mut stop = Stop::new(units, radius, aims);
        let (rho, ended) = front.run(&mut stop, control);
        (units, rho, ended)
    }

    /// Puts sources on a front; their distances count from `least`.
    fn begin<R: Rays>(&self, front: &mut Front<R>, seeds: &[Seed], least: f64) -> Units {
        for seed in seeds {
            front.start(&seed.origin, self.scale.to_unit(seed.offset - least), seed.source);
        }
        Units { scale: self.scale, least }
    }

    fn aims(&self, targets: &[Target]) -> Result<Vec<Aim>> {
        let aim = |(i, target): (u64, &Target)| match target.checked(&self.mesh) {
            Ok(place) => Ok(self.aim(place)),
            Err(error) => Err(error.about(Element::Target(i))),
        };
        (0..).zip(targets).map(aim).collect()
    }

    fn aim(&self, place: Place) -> Aim {
        match place {
            Place::Vertex(v) => Aim([(v, 0.0); 3]),
            Place::Face(SurfacePoint { face, barycentric }) => Aim([0, 1, 2].map(|k| {
                let h = 3 * face + k;
                let [x, y] = self.charts[h as usize].place(h, barycentric);
                (self.start(h), x.hypot(y))
            })),
        }
    }
}

/// Whether a front with windows of both kinds is needed.
fn has_curves<'a>(seeds: impl IntoIterator<Item = &'a Seed>) -> bool {
    seeds.into_iter().any(|seed| matches!(seed.origin, Origin::Curve(_)))
}

fn check_radius(radius: f64) -> Result<()> {
    if radius >= 0.0 {
        return Ok(());
    }
    Err(Error::new(Reason::BadArgument, format!("radius is {radius}, which is not a distance")))
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
        self.found.crossed
    }

    /// Distance of a place in mesh units; +inf where no source reaches, and beyond [`ExactField::final_radius`]. For a
    /// point that is no vertex it costs about as much as 50 windows do.
    ///
    /// # Errors
    /// [`Reason::VertexOutOfRange`], or [`Reason::BadArgument`] where the mesh has no such point, and for one that is no
    /// vertex where the field did not [keep its windows](ExactOptions::keep_windows).
    pub fn distance(&self, target: Target) -> Result<f64> {
        Ok(self.best(self.place(target)?).map_or(f64::INFINITY, |best| self.units.to_mesh(best.distance)))
    }

    /// The source that is nearest to each vertex, by its number in the list of sources; None where no source reaches, and
    /// beyond [`ExactField::final_radius`].
    pub fn nearest_sources(&self) -> impl Iterator<Item = Option<u32>> {
        (0..).take(self.distances.len()).map(|v| self.best(Place::Vertex(v))?.source)
    }

    /// The source that is nearest to a place, by its number in the list of sources; None where no source reaches, and
    /// beyond [`ExactField::final_radius`].
    ///
    /// # Errors
    /// As [`ExactField::distance`].
    pub fn nearest_source(&self, target: Target) -> Result<Option<u32>> {
        Ok(self.best(self.place(target)?).and_then(|best| best.source))
    }

    /// The shortest path from a place back to its nearest source, as long as its distance less the start distance. None
    /// where no source reaches, beyond [`ExactField::final_radius`], and for a vertex of no triangle.
    ///
    /// # Errors
    /// As [`ExactField::distance`]; [`Reason::PathLost`] where rounding leaves it undetermined.
    pub fn path(&self, target: Target) -> Result<Option<Curve>> {
        let place = self.place(target)?;
        let Some(best) = self.best(place) else { return Ok(None) };
        let on_surface = |v: u32| !self.solver.mesh.topology().corners.row(v).is_empty();
        match self.trace().path(&best) {
            Some(points) => Ok(Some(Curve { points, is_closed: false })),
            None if matches!(place, Place::Vertex(v) if !on_surface(v)) => Ok(None),
            None => Err(Error::new(Reason::PathLost, "rounding leaves the path undetermined here")),
        }
    }

    /// The shortest path of each of several places, as [`ExactField::path`] gives it. The control is consulted before each;
    /// progress counts paths.
    ///
    /// # Errors
    /// As [`ExactField::path`], naming the target; [`Reason::Cancelled`], [`Reason::TimeLimit`].
    pub fn paths(&self, targets: &[Target], control: &Control) -> Result<Vec<Option<Curve>>> {
        let mut paths = Vec::with_capacity(targets.len());
        for (i, &target) in targets.iter().enumerate() {
            control.checkpoint(i as f64 / targets.len() as f64)?;
            paths.push(self.path(target).map_err(|error| error.about(Element::Target(i as u64)))?);
        }
        control.report(1.0);
        Ok(paths)
    }

    fn trace(&self) -> Trace<'_> {
        Trace { solver: &self.solver, found: &self.found }
    }

    /// The shortest path to a place, if it is known to be that.
    fn best(&self, place: Place) -> Option<Best> {
        self.trace().best(place).filter(|best| self.units.to_mesh(best.distance) <= self.final_radius)
    }

    fn place(&self, target: Target) -> Result<Place> {
        let place = target.checked(&self.solver.mesh)?;
        if matches!(place, Place::Face(_)) && self.found.kept.is_none() {
            let message = "a point that is no vertex needs a field that keeps its windows (keep_windows)";
            return Err(Error::new(Reason::BadArgument, message));
        }
        Ok(place)
    }
}
