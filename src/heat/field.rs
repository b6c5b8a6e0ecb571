//! Distances from the direction of heat: L φ = -∇·X, and the constant that this leaves free in each component.
//!
//! φ has the distances that are known beforehand ([`super::place`]): one in a component fixes its constant, several ask
//! for multipliers ([`crate::linear`]), very many for a factorisation of their own.

use super::flow::{Flow, finite};
use super::place::{Part, Placed};
use super::systems::Systems;
use super::{HeatSolver, Shift};
use crate::control::Piece;
use crate::error::Result;
use crate::linear::Pin;
use crate::mesh::Mesh;
use crate::mesh::topology::NONE;
use crate::surface::basin::basins;
use crate::surface::source::Seed;
use std::array;

/// With more pins than this in a component, a factorisation that holds them is cheaper.
const MOST_PINS: usize = 256;

/// The distances from one set of sources by the heat method.
#[derive(Debug, Clone)]
pub struct HeatField {
    mesh: Mesh,
    distances: Vec<f64>,
    /// Vertices whose nearest source is known, and that source.
    nearest: Vec<(u32, u32)>,
    restarts: u32,
    nonpositive: u64,
}

impl HeatField {
    /// The distance of each vertex, in mesh units and vertex order; +inf where no source reaches: in a component without
    /// a source, and at vertices that no triangle uses.
    #[must_use]
    pub fn distances(&self) -> &[f64] {
        &self.distances
    }

    /// The distances alone.
    #[must_use]
    pub fn into_distances(self) -> Vec<f64> {
        self.distances
    }

    /// The source to which steepest descent of the distances leads from each vertex, by its number; None where no source
    /// reaches. [`descent_paths`](crate::descent_paths) draws the ways there.
    ///
    /// O(V log V) time.
    #[must_use]
    pub fn nearest_sources(&self) -> Vec<Option<u32>> {
        basins(&self.mesh, &self.distances, &self.nearest)
    }

    /// How often heat had to start anew, because it had faded below the numbers there are.
    #[must_use]
    pub fn restarts(&self) -> u32 {
        self.restarts
    }

    /// At how many vertices that a source reaches heat was not positive. There the direction is doubtful: cotangents are
    /// negative nearby, by [`Laplacian::Plain`](super::Laplacian::Plain) or at edges that could not be flipped.
    #[must_use]
    pub fn nonpositive_heat(&self) -> u64 {
        self.nonpositive
    }
}

impl HeatSolver {
    /// The fields of K sets of sources, each as it is alone. With each set comes how many sources stand before it.
    pub(super) fn fields<const K: usize>(&self, sets: [(u64, &[Seed]); K], piece: Piece) -> Result<[HeatField; K]> {
        let mut placed = Vec::with_capacity(K);
        for set in sets {
            placed.push(Placed::new(set, &self.systems, self.time_step)?);
        }
        let placed: [Placed; K] = exactly(placed);
        piece.checkpoint(0.0)?;
        let flows = self.flows(&placed)?;
        piece.checkpoint(0.5)?;
        let potentials = self.systems.potentials(&flows, &placed, &piece.part(0.5, 1.0))?;
        piece.checkpoint(1.0)?;
        let fields = placed.into_iter().enumerate().map(|(k, placed)| HeatField {
            mesh: self.systems.mesh.clone(),
            distances: self.systems.shifted(potentials.iter().map(|phi| phi[k]), &placed),
            nearest: placed.nearest,
            restarts: flows[k].restarts,
            nonpositive: flows[k].nonpositive,
        });
        Ok(exactly(fields))
    }
}

/// The K things that there are.
fn exactly<T, const K: usize>(things: impl IntoIterator<Item = T>) -> [T; K] {
    let mut things = things.into_iter();
    array::from_fn(|_| things.next().expect("one for each query"))
}

impl Systems {
    /// φ of K queries in units, up to a constant in each component.
    pub(super) fn potentials<const K: usize>(
        &self,
        flows: &[Flow; K],
        placed: &[Placed; K],
        piece: &Piece,
    ) -> Result<Vec<[f64; K]>> {
        let pins: [Vec<&[Pin]>; K] = array::from_fn(|k| match self.options.shift {
            Shift::Pinned => placed[k].parts.iter().map(|part| part.pins.as_slice()).collect(),
            Shift::Min => Vec::new(),
        });
        let has_many = |blocks: &[&[Pin]]| blocks.iter().any(|pins| pins.len() > MOST_PINS);
        let few = array::from_fn(|k| if has_many(&pins[k]) { &[][..] } else { &pins[k] });
        let b: Vec<[f64; K]> =
            (0..self.mesh.vertex_count()).map(|v| array::from_fn(|k| -flows[k].divergence[v])).collect();
        let mut phi = finite(self.poisson.solve_pinned(&b, &few)?)?;
        for k in (0..K).filter(|&k| has_many(&pins[k])) {
            let held = self.potential_held(b.iter().map(|b| b[k]).collect(), &pins[k], piece)?;
            phi.iter_mut().zip(held).for_each(|(phi, [held])| phi[k] = held);
        }
        Ok(phi)
    }

    /// φ of one query whose pins are held by a factorisation of their own.
    fn potential_held(&self, mut b: Vec<f64>, pins: &[&[Pin]], piece: &Piece) -> Result<Vec<[f64; 1]>> {
        let mut is_held = vec![false; b.len()];
        for &(v, value) in pins.iter().copied().flatten() {
            is_held[v as usize] = true;
            b[v as usize] = value;
        }
        let factor = self.factor_held(&is_held, &mut b, piece)?;
        finite(factor.solve(b.as_chunks::<1>().0))
    }

    /// Distances in mesh units: φ with its constant, +inf where there is no source.
    fn shifted(&self, phi: impl Iterator<Item = f64>, placed: &Placed) -> Vec<f64> {
        let mut phi: Vec<f64> = phi.collect();
        let topology = self.mesh.topology();
        let mut part_of: Vec<Option<&Part>> = vec![None; topology.component_count as usize];
        placed.parts.iter().for_each(|part| part_of[part.component as usize] = Some(part));
        // What is subtracted from φ, per component.
        let mut zero = vec![f64::INFINITY; part_of.len()];
        match self.options.shift {
            Shift::Pinned => {
                for part in &placed.parts {
                    let (v, value) = part.pins[0];
                    zero[part.component as usize] = phi[v as usize] - value;
                }
            }
            Shift::Min => {
                for (&x, &c) in phi.iter().zip(&topology.component).filter(|(_, c)| **c != NONE) {
                    zero[c as usize] = x.min(zero[c as usize]);
                }
            }
        }
        let distance = |part: &Part, units: f64| part.base + self.scale.to_mesh(units);
        for (x, &c) in phi.iter_mut().zip(&topology.component) {
            *x = match part_of.get(c as usize) {
                // Nothing is nearer than the nearest source; the field, which is approximate, may dip below beside it.
                Some(Some(part)) => distance(part, (*x - zero[c as usize]).max(0.0)),
                _ => f64::INFINITY,
            };
        }
        if self.options.shift == Shift::Pinned {
            // To the last bit.
            for part in &placed.parts {
                part.pins.iter().for_each(|&(v, value)| phi[v as usize] = distance(part, value));
            }
        }
        for &(v, start) in &placed.starts {
            if self.options.shift == Shift::Pinned || topology.component[v as usize] == NONE {
                phi[v as usize] = start;
            }
        }
        phi
    }
}
