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
//! *Several sources*: φ is constrained to the offset of each source ([`Shift::Pinned`]). *Offsets* o: the heat put in at
//! a source is exp(-(o - min o) / √t), as u decays like exp(-d / √t). *Boundary*: u is the blend
//! (1 - b) u_Neumann + b u_Dirichlet. *Null space of L*: one vertex of every component is held fixed.
//!
//! Cost: building factorises two matrices (about V^1.5 time, V log V memory); a query costs two solves with them. A
//! query with several sources in one component and [`Shift::Pinned`] factorises a third.
//!
//! References: K. Crane, C. Weischedel, M. Wardetzky: Geodesics in Heat: A New Approach to Computing Distance Based on
//! Heat Flow. ACM Transactions on Graphics, 2013.

mod boundary;
mod time_step;

use crate::control::Control;
use crate::error::{Element, Error, Reason, Result};
use crate::linear::{self, Factor, Symbolic};
use crate::mesh::Mesh;
use crate::mesh::topology::NONE;
use crate::metric::{Metric, Scale, delaunay, mollify};
use crate::operators::Operators;
use crate::surface::point::Place;
use crate::surface::source::{Origin, Seed, Source};
use std::sync::Arc;

pub use crate::linear::Solver;
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
    /// The distance is the source's offset at every source, also where the way from another source is shorter than that,
    /// and nowhere less than the smallest offset of its component: the default.
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
    /// Which library factorises the matrices; the default is [`Solver::Faer`].
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
            solver: Solver::Faer,
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
}

/// The factorised systems of one mesh, for any number of queries by any number of threads; clones share them.
#[derive(Debug, Clone)]
pub struct HeatSolver {
    systems: Arc<Systems>,
    /// t in units squared.
    time_step: f64,
    /// M + t L.
    neumann: Arc<dyn Factor>,
    /// The same, with u = 0 prescribed on the boundary; only if the boundary blend is not 0.
    dirichlet: Option<Arc<dyn Factor>>,
}

/// Everything that does not depend on t.
#[derive(Debug)]
struct Systems {
    mesh: Mesh,
    scale: Scale,
    boundary: f64,
    shift: Shift,
    report: HeatReport,
    operators: Operators,
    /// Vertices that no triangle uses: identity rows in every system.
    unused: Vec<bool>,
    on_boundary: Vec<bool>,
    symbolic: Arc<dyn Symbolic>,
    /// L with φ = 0 prescribed at the first vertex of each component.
    poisson: Arc<dyn Factor>,
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
        let time_step = options.time_step.unit_value(mesh, Scale::of(mesh))?;
        control.checkpoint(0.0)?;
        let systems = Systems::new(mesh, options, control)?;
        HeatSolver::timed(Arc::new(systems), time_step, control)
    }

    /// A solver for another time step; it shares everything but the heat systems, which are factorised anew.
    ///
    /// # Errors
    /// As [`HeatSolver::new`].
    pub fn with_time_step(&self, step: &TimeStep, control: &Control) -> Result<HeatSolver> {
        let time_step = step.unit_value(&self.systems.mesh, self.systems.scale)?;
        HeatSolver::timed(Arc::clone(&self.systems), time_step, control)
    }

    /// The time step t, in mesh units squared; +inf or 0 where these do not fit a number.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        let scale = self.systems.scale;
        scale.to_mesh(scale.to_mesh(self.time_step))
    }

    /// What building did to the triangulation.
    #[must_use]
    pub fn report(&self) -> HeatReport {
        self.systems.report
    }

    /// The distance of each vertex to the nearest source (its offset included), in mesh units and vertex order; +inf
    /// where no source reaches: in a component without a source, and at vertices that no triangle uses.
    ///
    /// # Errors
    /// [`Reason::NoSource`]; [`Reason::VertexOutOfRange`] and [`Reason::BadArgument`] (an offset that is not finite, or
    /// out of all proportion to the mesh) name the source, as does [`Reason::SourceOnBoundary`], raised only if the
    /// boundary blend is 1; [`Reason::NotPositiveDefinite`] if a solution is not finite; [`Reason::OutOfMemory`];
    /// [`Reason::Cancelled`].
    pub fn distances(&self, sources: &[Source], control: &Control) -> Result<Vec<f64>> {
        let placed = self.systems.place(sources)?;
        control.checkpoint(0.0)?;
        let mut u = self.heat(&placed)?;
        // Where cotangents are negative u may be negative too, far from the sources; its magnitude still falls away from
        // them. Mean error in percent, plain cotangents: camel 11.8 with the sign, 3.4 without.
        u.iter_mut().for_each(|u| *u = u.abs());
        control.checkpoint(0.4)?;
        let divergence = self.systems.operators.divergence_of_direction(&u);
        control.checkpoint(0.5)?;
        let phi = self.systems.potential(divergence, &placed)?;
        control.checkpoint(1.0)?;
        Ok(self.systems.shifted(phi, &placed))
    }

    fn timed(systems: Arc<Systems>, time_step: f64, control: &Control) -> Result<HeatSolver> {
        let neumann = systems.factor_heat(time_step, &systems.unused)?;
        control.checkpoint(0.9)?;
        let dirichlet = if systems.boundary > 0.0 {
            let absorbing: Vec<bool> = systems.unused.iter().zip(&systems.on_boundary).map(|(&a, &b)| a || b).collect();
            Some(systems.factor_heat(time_step, &absorbing)?)
        } else {
            None
        };
        control.checkpoint(1.0)?;
        Ok(HeatSolver { systems, time_step, neumann, dirichlet })
    }

    /// u = (1 - b) u_Neumann + b u_Dirichlet.
    fn heat(&self, placed: &Placed) -> Result<Vec<f64>> {
        let b = self.systems.boundary;
        let mut u = vec![0.0; self.systems.mesh.vertex_count()];
        for source in &placed.sources {
            u[source.v] = (-source.offset / self.time_step.sqrt()).exp();
        }
        let Some(dirichlet) = &self.dirichlet else {
            solve(&*self.neumann, &mut u)?;
            return Ok(u);
        };
        let mut absorbed = u.clone();
        absorbed.iter_mut().zip(&self.systems.on_boundary).filter(|(_, on)| **on).for_each(|(u, _)| *u = 0.0);
        solve(&**dirichlet, &mut absorbed)?;
        solve(&*self.neumann, &mut u)?;
        Ok(u.iter().zip(&absorbed).map(|(neumann, dirichlet)| (1.0 - b) * neumann + b * dirichlet).collect())
    }
}

/// The sources of one query, as the systems use them.
struct Placed {
    sources: Vec<PlacedSource>,
    /// Of each component: its smallest offset, in mesh units, and how many sources it has.
    base: Vec<f64>,
    count: Vec<u32>,
}

struct PlacedSource {
    v: usize,
    component: u32,
    /// The offset as it was given, in mesh units.
    given_offset: f64,
    /// The offset above the smallest of its component, in units.
    offset: f64,
}

/// A source as it was given.
struct Start {
    v: u32,
    offset: f64,
}

/// Heat starts at vertices.
fn start(seed: Seed) -> Result<Start> {
    let what = match seed.origin {
        Origin::Place(Place::Vertex(v)) => return Ok(Start { v, offset: seed.offset }),
        Origin::Place(Place::Face(point)) => format!("lies inside triangle {}", point.face),
        Origin::Curve(_) => "is a curve".to_owned(),
    };
    let message = format!("{what}; the heat method starts at vertices");
    Err(Error::at(Reason::BadArgument, Element::Source(u64::from(seed.source)), message))
}

impl Systems {
    fn new(mesh: &Mesh, options: &HeatOptions, control: &Control) -> Result<Systems> {
        let scale = Scale::of(mesh);
        let mut metric = Metric::of(mesh, scale);
        let mollified = mollify::mollify(&mut metric);
        control.checkpoint(0.05)?;
        let flips = match options.laplacian {
            Laplacian::Intrinsic => delaunay::make_delaunay(&mut metric, mesh, scale),
            Laplacian::Plain => delaunay::Flips::default(),
        };
        control.checkpoint(0.1)?;
        let operators = Operators::new(metric, mesh.vertex_count());
        control.checkpoint(0.2)?;
        let symbolic = linear::analyze(options.solver, operators.stiffness.pattern())?;
        control.checkpoint(0.5)?;
        let poisson = factor_poisson(&operators, &*symbolic, &held(mesh))?;
        control.checkpoint(0.7)?;
        Ok(Systems {
            scale,
            boundary: options.boundary,
            shift: options.shift,
            report: HeatReport {
                mollified,
                flips: flips.flips,
                doubled_triangles: flips.doubled,
                stuck_edges: flips.stuck,
                flip_bound_reached: flips.bound_reached,
            },
            operators,
            unused: mesh.topology().component.iter().map(|&component| component == NONE).collect(),
            on_boundary: boundary::boundary_vertices(mesh),
            symbolic,
            poisson,
            mesh: mesh.clone(),
        })
    }

    /// M + t L, with 0 prescribed at some vertices; t in units squared.
    fn factor_heat(&self, t: f64, prescribed: &[bool]) -> Result<Arc<dyn Factor>> {
        let stiffness = &self.operators.stiffness;
        let mut values: Vec<f64> = stiffness.values().iter().map(|value| t * value).collect();
        for (mass, &diagonal) in self.operators.mass.iter().zip(stiffness.col_offsets()) {
            values[diagonal] += mass; // the diagonal comes first in its column
        }
        boundary::constrain(stiffness.pattern(), &mut values, prescribed);
        self.symbolic.factor(&values)
    }

    /// Checks the sources and expresses them in units.
    fn place(&self, sources: &[Source]) -> Result<Placed> {
        let topology = self.mesh.topology();
        let mut starts = Source::checked(sources, &self.mesh)?.into_iter().map(start).collect::<Result<Vec<_>>>()?;
        let mut base = vec![f64::INFINITY; topology.component_count as usize];
        let mut count = vec![0; topology.component_count as usize];
        let component = |start: &Start| topology.component[start.v as usize];
        for start in starts.iter().filter(|start| component(start) != NONE) {
            let c = component(start) as usize;
            base[c] = start.offset.min(base[c]);
        }
        for (i, start) in (0..).zip(&starts) {
            if self.boundary == 1.0 && self.on_boundary[start.v as usize] {
                let message = "lies on the boundary, which absorbs all heat (boundary is 1)";
                return Err(Error::at(Reason::SourceOnBoundary, Element::Source(i), message));
            }
            let c = component(start);
            if c != NONE && !self.scale.to_unit(start.offset - base[c as usize]).is_finite() {
                let message = format!("has the start distance {}, out of all proportion to the mesh", start.offset);
                return Err(Error::at(Reason::BadArgument, Element::Source(i), message));
            }
        }
        // Of several at one vertex only the nearest counts.
        starts.sort_by(|a, b| a.v.cmp(&b.v).then(a.offset.total_cmp(&b.offset)));
        starts.dedup_by_key(|start| start.v);
        for start in starts.iter().filter(|start| component(start) != NONE) {
            count[component(start) as usize] += 1;
        }
        let place = |start: &Start| {
            let smallest = base.get(component(start) as usize).copied().unwrap_or(start.offset);
            PlacedSource {
                v: start.v as usize,
                component: component(start),
                given_offset: start.offset,
                offset: self.scale.to_unit(start.offset - smallest),
            }
        };
        Ok(Placed { sources: starts.iter().map(place).collect(), base, count })
    }

    /// φ in units, up to a constant in each component; where several sources are pinned, the constant is right.
    fn potential(&self, divergence: Vec<f64>, placed: &Placed) -> Result<Vec<f64>> {
        let mut phi: Vec<f64> = divergence.into_iter().map(|x| -x).collect();
        let several = placed.count.iter().any(|&count| count > 1);
        let mut prescribed = held(&self.mesh);
        if self.shift == Shift::Min || !several {
            phi.iter_mut().zip(&prescribed).filter(|(_, held)| **held).for_each(|(x, _)| *x = 0.0);
            solve(&*self.poisson, &mut phi)?;
            return Ok(phi);
        }
        // Sources take the place of the held vertex of their component.
        for (v, &component) in self.mesh.topology().component.iter().enumerate() {
            prescribed[v] &= component == NONE || placed.count[component as usize] == 0;
        }
        placed.sources.iter().for_each(|source| prescribed[source.v] = true);
        phi.iter_mut().zip(&prescribed).filter(|(_, prescribed)| **prescribed).for_each(|(x, _)| *x = 0.0);
        placed.sources.iter().for_each(|source| phi[source.v] = source.offset);
        let stiffness = &self.operators.stiffness;
        boundary::move_prescribed(stiffness.pattern(), stiffness.values(), &prescribed, &mut phi);
        solve(&*factor_poisson(&self.operators, &*self.symbolic, &prescribed)?, &mut phi)?;
        Ok(phi)
    }

    /// Distances in mesh units: φ with its constant, +inf where there is no source.
    fn shifted(&self, mut phi: Vec<f64>, placed: &Placed) -> Vec<f64> {
        let component = &self.mesh.topology().component;
        // The value of φ, per component, at which the distance is the smallest offset.
        let mut zero = vec![f64::INFINITY; placed.base.len()];
        match self.shift {
            Shift::Min => {
                for (&x, &c) in phi.iter().zip(component).filter(|(_, c)| **c != NONE) {
                    zero[c as usize] = x.min(zero[c as usize]);
                }
            }
            // With several sources φ already has its constant: at the source with the smallest offset it is 0.
            Shift::Pinned => {
                for source in placed.sources.iter().filter(|source| source.component != NONE && source.offset == 0.0) {
                    zero[source.component as usize] = phi[source.v];
                }
            }
        }
        for (x, &c) in phi.iter_mut().zip(component) {
            *x = match placed.count.get(c as usize) {
                // Nothing is nearer than the nearest source; the field, which is approximate, may dip below beside it.
                Some(1..) => placed.base[c as usize] + self.scale.to_mesh((*x - zero[c as usize]).max(0.0)),
                _ => f64::INFINITY,
            };
        }
        // Exactly, where rounding moved an offset; and at vertices that no triangle uses.
        for source in &placed.sources {
            if self.shift == Shift::Pinned || source.component == NONE {
                phi[source.v] = source.given_offset;
            }
        }
        phi
    }
}

/// Where the Poisson system holds φ: at the first vertex of each component and where no triangle is.
fn held(mesh: &Mesh) -> Vec<bool> {
    let topology = mesh.topology();
    let mut seen = vec![false; topology.component_count as usize];
    let first = |&c: &u32| c == NONE || !std::mem::replace(&mut seen[c as usize], true);
    topology.component.iter().map(first).collect()
}

/// L, with φ prescribed at some vertices.
fn factor_poisson(operators: &Operators, symbolic: &dyn Symbolic, prescribed: &[bool]) -> Result<Arc<dyn Factor>> {
    let mut values = operators.stiffness.values().to_vec();
    boundary::constrain(operators.stiffness.pattern(), &mut values, prescribed);
    symbolic.factor(&values)
}

/// Solves in place; a solution that is not finite is an error.
fn solve(factor: &dyn Factor, x: &mut [f64]) -> Result<()> {
    factor.solve_in_place(x)?;
    if x.iter().all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(Error::new(
            Reason::NotPositiveDefinite,
            "a system is singular in floating point: its solution is not finite",
        ))
    }
}
