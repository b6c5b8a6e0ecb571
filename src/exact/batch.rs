//! Many sets of sources over one mesh: each its own field, side by side in threads.
//!
//! Each thread keeps one front and clears what the field before has reached, so that a small field costs little however
//! large the mesh is. Fields know nothing of each other: their distances are the same, to the bit, for any number of
//! threads, and the same as those of [`ExactSolver::field`].
//!
//! [`ExactSolver::farthest_points`] is one growing field instead: each sample is one more source, and what its windows
//! reach is only what is nearer to it than to all samples before.

use super::stop::Stop;
use super::window::{Mixed, Rays, Spreading};
use super::{ExactSolver, Front, Prepared, check_radius, has_curves};
use crate::control::{Control, Piece};
use crate::error::Result;
use crate::parallel;
use crate::surface::point::Place;
use crate::surface::source::{Origin, Seed, Source};

/// Distances within a radius, row by row: those of each source to the vertices near it.
#[derive(Debug, Clone, PartialEq)]
pub struct SparseDistances {
    row_start: Vec<usize>,
    vertices: Vec<u32>,
    distances: Vec<f64>,
}

impl SparseDistances {
    /// How many rows there are.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.row_start.len() - 1
    }

    /// Where each row starts in the other two arrays, and at last where they end.
    #[must_use]
    pub fn row_start(&self) -> &[usize] {
        &self.row_start
    }

    /// The vertices of all rows, in ascending order in each.
    #[must_use]
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// Their distances, in mesh units.
    #[must_use]
    pub fn distances(&self) -> &[f64] {
        &self.distances
    }
}

impl ExactSolver {
    /// The distances of every vertex from each of several sets of sources: one row per set, each as
    /// [`ExactSolver::field`] gives it.
    ///
    /// 0 `threads` are as many as the machine has; more than 1024 are never started. Progress counts rows; a memory limit
    /// holds for each thread, without the rows.
    ///
    /// # Errors
    /// As [`ExactSolver::field`]; sources are counted through all sets.
    pub fn distance_rows(&self, sets: &[Vec<Source>], threads: usize, control: &Control) -> Result<Vec<Vec<f64>>> {
        let sets = Source::checked_sets(sets, &self.0.mesh)?;
        match has_curves(sets.iter().flatten()) {
            false => self.0.distance_rows::<Spreading>(&sets, threads, control),
            true => self.0.distance_rows::<Mixed>(&sets, threads, control),
        }
    }

    /// The distances up to `radius` from each of several sources, in mesh units: one row per source, start distances
    /// included, with the vertices that it reaches.
    ///
    /// 0 `threads` are as many as the machine has; more than 1024 are never started. The work and the memory grow with what
    /// is reached, not with the mesh. Progress counts rows; a memory limit holds for each thread, without the rows.
    ///
    /// # Errors
    /// As [`ExactSolver::field`].
    pub fn distances_within(
        &self,
        sources: &[Source],
        radius: f64,
        threads: usize,
        control: &Control,
    ) -> Result<SparseDistances> {
        check_radius(radius)?;
        let seeds = match sources {
            [] => Vec::new(),
            _ => Source::checked(sources, &self.0.mesh)?,
        };
        let rows = match has_curves(&seeds) {
            false => self.0.near_rows::<Spreading>(&seeds, radius, threads, control)?,
            true => self.0.near_rows::<Mixed>(&seeds, radius, threads, control)?,
        };
        let mut all = SparseDistances { row_start: vec![0], vertices: Vec::new(), distances: Vec::new() };
        for row in rows {
            all.vertices.extend(row.iter().map(|&(v, _)| v));
            all.distances.extend(row.iter().map(|&(_, distance)| distance));
            all.row_start.push(all.vertices.len());
        }
        Ok(all)
    }

    /// Farthest point sampling: up to `count` vertices, each the farthest one from all `first` and from those before it,
    /// with that distance in mesh units; +inf for the first in a component without any. Of equally far ones it takes the
    /// first. Fewer where no vertex of a triangle is farther than 0: all are taken, or have start distances below 0.
    ///
    /// The first sample costs as much as a field, each further one about as much as the area that it takes.
    ///
    /// # Errors
    /// As [`ExactSolver::field`].
    pub fn farthest_points(&self, first: &[Source], count: usize, control: &Control) -> Result<Vec<(u32, f64)>> {
        let seeds = Source::checked(first, &self.0.mesh)?;
        match has_curves(&seeds) {
            false => self.0.farthest_points::<Spreading>(&seeds, count, control),
            true => self.0.farthest_points::<Mixed>(&seeds, count, control),
        }
    }
}

impl Prepared {
    /// The distances of all vertices from each set.
    fn distance_rows<R: Rays>(&self, sets: &[Vec<Seed>], threads: usize, control: &Control) -> Result<Vec<Vec<f64>>> {
        self.rows(sets.len(), threads, control, |front: &mut Front<R>, row, control| {
            let (units, _, ended) = self.propagate(front, &sets[row], f64::INFINITY, &[], control);
            ended?;
            Ok((0..).take(self.mesh.vertex_count()).map(|v| units.to_mesh(front.label(v))).collect())
        })
    }

    /// The vertices near each source, in ascending order, each with its distance.
    fn near_rows<R: Rays>(
        &self,
        seeds: &[Seed],
        radius: f64,
        threads: usize,
        control: &Control,
    ) -> Result<Vec<Vec<(u32, f64)>>> {
        self.rows(seeds.len(), threads, control, |front: &mut Front<R>, row, control| {
            let (units, _, ended) = self.propagate(front, &seeds[row..=row], radius, &[], control);
            ended?;
            let near = front.reached().iter().map(|&v| (v, units.to_mesh(front.label(v))));
            let mut near: Vec<(u32, f64)> = near.filter(|&(_, distance)| distance <= radius).collect();
            near.sort_unstable_by_key(|&(v, _)| v);
            Ok(near)
        })
    }

    fn farthest_points<R: Rays>(&self, seeds: &[Seed], count: usize, control: &Control) -> Result<Vec<(u32, f64)>> {
        let mut front = Front::<R>::new(self);
        let share = |done: usize| done as f64 / count as f64;
        // Samples start at 0, which must not be below the least start distance.
        let least = seeds.iter().map(|seed| seed.offset).fold(0.0, f64::min);
        let units = self.begin(&mut front, seeds, least);
        let nothing = units.scale.to_unit(-least); // the label of a sample
        let mut sources = seeds.len() as u32; // fits: sources are numbered by u32
        let mut samples = Vec::new();
        while samples.len() < count {
            let piece = Piece::whole(control).part(share(samples.len()), share(samples.len() + 1));
            front.run(&mut Stop::new(units, f64::INFINITY, &[]), piece).1?;
            let Some((v, label)) = self.farthest(&front, nothing) else { break };
            samples.push((v, units.to_mesh(label)));
            front.start(&Origin::Place(Place::Vertex(v)), nothing, sources);
            sources = sources.saturating_add(1);
        }
        control.report(1.0);
        Ok(samples)
    }

    /// The vertex of a triangle with the largest label, if one has more than `nothing`.
    fn farthest<R: Rays>(&self, front: &Front<R>, nothing: f64) -> Option<(u32, f64)> {
        let corners = &self.mesh.topology().corners;
        let on_surface = (0..corners.rows()).filter(|&v| !corners.row(v).is_empty());
        let farther = |best: Option<(u32, f64)>, v: u32| {
            let label = front.label(v);
            if label > best.map_or(nothing, |(_, label)| label) { Some((v, label)) } else { best }
        };
        on_surface.fold(None, farther)
    }

    /// Computes rows on several threads, each with a front of its own that is clear at the start of a row.
    fn rows<R: Rays, Row: Send>(
        &self,
        count: usize,
        threads: usize,
        control: &Control,
        row: impl Fn(&mut Front<R>, usize, Piece) -> Result<Row> + Sync,
    ) -> Result<Vec<Row>> {
        parallel::rows(
            count,
            threads,
            control,
            || Front::new(self),
            |front, i, piece| {
                let computed = row(front, i, piece);
                front.clear();
                computed
            },
        )
    }
}
