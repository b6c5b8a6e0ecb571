//! The matrices of one mesh, and their factors that do not depend on t.

use super::boundary;
use super::{HeatOptions, HeatReport, HeatTimes, Laplacian};
use crate::control::Piece;
use crate::error::Result;
use crate::linear::{self, Factor, Symbolic};
use crate::mesh::Mesh;
use crate::mesh::topology::NONE;
use crate::metric::{Metric, Scale, delaunay, mollify};
use crate::operators::Operators;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Everything that does not depend on t.
#[derive(Debug)]
pub(super) struct Systems {
    pub(super) mesh: Mesh,
    pub(super) scale: Scale,
    pub(super) options: HeatOptions,
    pub(super) report: HeatReport,
    pub(super) operators: Operators,
    /// Vertices that no triangle uses: identity rows in every system.
    unused: Vec<bool>,
    pub(super) on_boundary: Vec<bool>,
    symbolic: Arc<dyn Symbolic>,
    /// L, with the diagonal raised at one vertex of each component: where the right-hand side sums to 0 that changes only
    /// the constant.
    pub(super) poisson: Factor,
}

/// Tells how long each stage took.
struct Stopwatch(Instant);

impl Stopwatch {
    fn lap(&mut self) -> Duration {
        let last = std::mem::replace(&mut self.0, Instant::now());
        self.0 - last
    }
}

impl Systems {
    /// `like` is for another mesh of the same triangles, whose ordering and analysis serve again.
    pub(super) fn new(
        mesh: &Mesh,
        scale: Scale,
        options: &HeatOptions,
        like: Option<&Systems>,
        piece: &Piece,
    ) -> Result<Systems> {
        let mut watch = Stopwatch(Instant::now());
        let mut times = HeatTimes::default();
        let mut metric = Metric::of(mesh, scale);
        let mollified = mollify::mollify(&mut metric);
        let flips = match options.laplacian {
            Laplacian::Intrinsic => delaunay::make_delaunay(&mut metric, mesh, scale),
            Laplacian::Plain => delaunay::Flips::default(),
        };
        times.delaunay = watch.lap();
        piece.checkpoint(0.1)?;
        let operators = Operators::new(metric, mesh.vertex_count());
        times.assembly = watch.lap();
        piece.checkpoint(0.2)?;
        let pattern = operators.stiffness.pattern();
        let symbolic = match like {
            Some(like) if like.operators.stiffness.pattern() == pattern => Arc::clone(&like.symbolic),
            Some(like) => linear::analyze(options.solver, pattern, Arc::clone(like.symbolic.ordering()))?,
            None => {
                let ordering = linear::order(pattern)?;
                times.order = watch.lap();
                piece.checkpoint(0.5)?;
                linear::analyze(options.solver, pattern, ordering)?
            }
        };
        times.symbolic = watch.lap();
        piece.checkpoint(0.6)?;
        let unused: Vec<bool> = mesh.topology().component.iter().map(|&component| component == NONE).collect();
        let poisson = symbolic.factor(&grounded(&operators, mesh, &unused), &piece.part(0.6, 1.0))?;
        times.poisson = watch.lap();
        let report = HeatReport {
            mollified,
            flips: flips.flips,
            doubled_triangles: flips.doubled,
            stuck_edges: flips.stuck,
            flip_bound_reached: flips.bound_reached,
            times,
        };
        let on_boundary = boundary::boundary_vertices(mesh);
        let (mesh, options) = (mesh.clone(), *options);
        Ok(Systems { mesh, scale, options, report, operators, unused, on_boundary, symbolic, poisson })
    }

    /// Where a vertex is, in units.
    pub(super) fn unit_position(&self, v: u32) -> [f64; 3] {
        self.scale.unit_position(self.mesh.positions()[v as usize])
    }

    /// M + t L, with u = 0 on the boundary if that is asked for; t in units squared.
    pub(super) fn factor_heat(&self, t: f64, is_absorbed: bool, piece: &Piece) -> Result<Factor> {
        let stiffness = &self.operators.stiffness;
        let mut values: Vec<f64> = stiffness.values().iter().map(|value| t * value).collect();
        for (mass, &diagonal) in self.operators.mass.iter().zip(stiffness.col_offsets()) {
            values[diagonal] += mass; // the diagonal comes first in its column
        }
        let is_held = |v: usize| self.unused[v] || is_absorbed && self.on_boundary[v];
        boundary::hold(stiffness.pattern(), &mut values, is_held);
        self.symbolic.factor(&values, piece)
    }

    /// L with some vertices held, and φ with their values in its place in `b`, which becomes the right-hand side.
    pub(super) fn factor_held(&self, held: &[bool], b: &mut [f64], piece: &Piece) -> Result<Factor> {
        let stiffness = &self.operators.stiffness;
        boundary::move_held(stiffness.pattern(), stiffness.values(), held, b);
        let mut values = grounded(&self.operators, &self.mesh, &self.unused);
        boundary::hold(stiffness.pattern(), &mut values, |v| held[v] || self.unused[v]);
        self.symbolic.factor(&values, piece)
    }
}

/// L with the diagonal raised at the first vertex of each component, and 1 where no triangle is.
fn grounded(operators: &Operators, mesh: &Mesh, unused: &[bool]) -> Vec<f64> {
    let stiffness = &operators.stiffness;
    let mut values = stiffness.values().to_vec();
    let mut next = 0;
    for (v, &component) in mesh.topology().component.iter().enumerate() {
        if component == next {
            let diagonal = &mut values[stiffness.col_offsets()[v]]; // it comes first in its column
            *diagonal += if *diagonal > 0.0 { *diagonal } else { 1.0 };
            next += 1;
        }
    }
    boundary::hold(stiffness.pattern(), &mut values, |v| unused[v]);
    values
}
