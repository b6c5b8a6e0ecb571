//! The heat of a query, and the divergence of its direction.
//!
//! u = (1 - b) u_Neumann + b u_Dirichlet falls by about e^(1/√t) per unit of length: some way from the sources numbers
//! end. Where u has *faded*, heat starts anew: what flows from the last good vertices into those behind them is put in
//! there, times what makes it about 1, and farther out the direction is that of this second heat. It starts with the
//! amplitudes that u had along the front, so it runs on as u does; only what flows back over the front is not the same,
//! and that is gone when the second heat takes over, some hundred edges on. Sources whose start distance is too large for
//! e^x come in at the restart that they belong to.
//!
//! Cost: a solve whose first half is short, and O(F); for each restart the same again.

use super::HeatSolver;
use super::place::{Charge, Placed};
use crate::error::{Error, Reason, Result};
use crate::mesh::topology::NONE;
use std::array;

/// u is of no use below this share of its largest value ...
const FADED: f64 = 1e-250;
/// ... and starts anew where it falls below this one.
const FRONT: f64 = 1e-200;

/// The direction of one query's heat, X = -∇u / |∇u|.
pub(super) struct Flow {
    /// ∇·X, integrated around each vertex.
    pub(super) divergence: Vec<f64>,
    /// How often heat started anew.
    pub(super) restarts: u32,
    /// At how many vertices that heat can reach u was not positive.
    pub(super) nonpositive: u64,
}

impl HeatSolver {
    /// The flows of K queries.
    pub(super) fn flows<const K: usize>(&self, placed: &[Placed; K]) -> Result<[Flow; K]> {
        let u = self.heat(&self.charges(placed))?;
        let mut flows = array::from_fn(|_| Flow { divergence: Vec::new(), restarts: 0, nonpositive: 0 });
        for (k, flow) in flows.iter_mut().enumerate() {
            *flow = self.flow(&placed[k], u.iter().map(|u| u[k]).collect())?;
        }
        Ok(flows)
    }

    /// The heat that K queries put in at first.
    pub(super) fn charges<const K: usize>(&self, placed: &[Placed; K]) -> Vec<(u32, [f64; K])> {
        let mut charges = Vec::new();
        for (k, placed) in placed.iter().enumerate() {
            for charge in placed.charges.iter().filter(|charge| self.exponent(charge) >= FRONT.ln()) {
                let weight = charge.weight * self.exponent(charge).exp();
                charges.push((charge.v, array::from_fn(|i| if i == k { weight } else { 0.0 })));
            }
        }
        charges
    }

    /// The flow of a query whose first heat is `u`.
    fn flow(&self, placed: &Placed, mut u: Vec<f64>) -> Result<Flow> {
        let is_reachable = self.reachable(placed);
        let nonpositive = u.iter().zip(&is_reachable).filter(|&(&u, &is_reachable)| is_reachable && u <= 0.0).count();
        // Where cotangents are negative u may be negative too, far from the sources; its magnitude still falls away from
        // them. Mean error in percent, plain cotangents: camel 11.8 with the sign, 3.4 without.
        u.iter_mut().for_each(|u| *u = u.abs());
        let least = FADED * u.iter().copied().fold(0.0, f64::max);
        let is_late = |charge: &Charge| self.exponent(charge) < FRONT.ln();
        let has_faded = u.iter().zip(&is_reachable).any(|(&u, &is_reachable)| is_reachable && u < least);
        if has_faded || placed.charges.iter().any(is_late) {
            return self.restarted(placed, u, is_reachable);
        }
        let mut divergence = vec![0.0; u.len()];
        self.systems.operators.add_divergence_of_direction(&u, &mut divergence, |_, _| true);
        Ok(Flow { divergence, restarts: 0, nonpositive: nonpositive as u64 })
    }

    /// The flow of a query that needs more than its first heat, `u`.
    fn restarted(&self, placed: &Placed, mut u: Vec<f64>, mut is_beyond: Vec<bool>) -> Result<Flow> {
        let operators = &self.systems.operators;
        let mut flow = Flow { divergence: vec![0.0; u.len()], restarts: 0, nonpositive: 0 };
        let mut is_done = vec![false; operators.triangle_count()];
        let mut late: Vec<Charge> = placed.charges.clone();
        // Heat is e^scale times what stands in u.
        let mut scale = 0.0;
        loop {
            let most = u.iter().zip(&is_beyond).filter(|(_, beyond)| **beyond).map(|(&u, _)| u).fold(0.0, f64::max);
            operators.add_divergence_of_direction(&u, &mut flow.divergence, |f, corners| {
                let is_good = |&v: &u32| u[v as usize] >= FADED * most || self.is_absorbed(v as usize);
                corners.iter().all(is_good) && !std::mem::replace(&mut is_done[f], true)
            });
            late.retain(|charge| self.exponent(charge) - scale < FRONT.ln());
            let charges = self.front(&u, &mut is_beyond, FRONT * most);
            late.retain(|charge| is_beyond[charge.v as usize]);
            let latest = late.iter().map(|charge| self.exponent(charge)).fold(f64::NEG_INFINITY, f64::max);
            let amount = charges.iter().map(|&(_, [amount])| amount).fold(0.0, f64::max);
            scale = if amount > 0.0 { scale + amount.ln() } else { latest };
            let mut charges: Vec<(u32, [f64; 1])> =
                charges.into_iter().map(|(v, [charge])| (v, [charge / amount])).collect();
            let due = late.iter().filter(|charge| self.exponent(charge) - scale >= FRONT.ln());
            charges.extend(due.map(|charge| (charge.v, [charge.weight * (self.exponent(charge) - scale).exp()])));
            if charges.is_empty() {
                break;
            }
            u = self.heat::<1>(&charges)?.into_iter().map(|[u]| u.abs()).collect();
            flow.restarts += 1;
        }
        operators.add_divergence_of_direction(&u, &mut flow.divergence, |f, _| !is_done[f]);
        flow.nonpositive = is_beyond.iter().filter(|&&is_beyond| is_beyond).count() as u64;
        Ok(flow)
    }

    /// What flows from vertices where u is at least `least` into those beyond where it is not: these remain beyond.
    fn front(&self, u: &[f64], is_beyond: &mut [bool], least: f64) -> Vec<(u32, [f64; 1])> {
        let was_beyond = is_beyond.to_vec();
        is_beyond.iter_mut().zip(u).for_each(|(is_beyond, &u)| *is_beyond &= u == 0.0 || u < least);
        let mut inflow = vec![0.0; u.len()];
        for (i, j, &value) in self.systems.operators.stiffness.triplet_iter() {
            for (from, to) in [(i, j), (j, i)] {
                if was_beyond[from] && !is_beyond[from] && is_beyond[to] {
                    inflow[to] -= self.time_step * value * u[from];
                }
            }
        }
        (0..).zip(inflow).filter(|&(_, inflow)| inflow > 0.0).map(|(v, inflow)| (v, [inflow])).collect()
    }

    /// u of K right-hand sides.
    fn heat<const K: usize>(&self, charges: &[(u32, [f64; K])]) -> Result<Vec<[f64; K]>> {
        let mut u = self.neumann.solve_sparse(charges);
        if let Some(dirichlet) = &self.dirichlet {
            let b = self.systems.options.boundary;
            let inside: Vec<(u32, [f64; K])> =
                charges.iter().filter(|(v, _)| !self.systems.on_boundary[*v as usize]).copied().collect();
            for (u, absorbed) in u.iter_mut().zip(dirichlet.solve_sparse(&inside)) {
                (0..K).for_each(|k| u[k] = (1.0 - b) * u[k] + b * absorbed[k]);
            }
        }
        finite(u)
    }

    /// The logarithm of what a start distance leaves of heat.
    fn exponent(&self, charge: &Charge) -> f64 {
        -charge.delay / self.time_step.sqrt()
    }

    /// The vertices of the sources' components, but for those where all heat is absorbed.
    fn reachable(&self, placed: &Placed) -> Vec<bool> {
        let topology = self.systems.mesh.topology();
        let mut has_source = vec![false; topology.component_count as usize];
        placed.parts.iter().for_each(|part| has_source[part.component as usize] = true);
        let is_reachable = |(v, &component): (usize, &u32)| {
            component != NONE && has_source[component as usize] && !self.is_absorbed(v)
        };
        topology.component.iter().enumerate().map(is_reachable).collect()
    }

    /// Whether u is 0 at a vertex because the boundary absorbs all heat.
    fn is_absorbed(&self, v: usize) -> bool {
        self.dirichlet.is_some() && self.systems.options.boundary == 1.0 && self.systems.on_boundary[v]
    }
}

/// A solution, if it is finite.
pub(super) fn finite<const K: usize>(x: Vec<[f64; K]>) -> Result<Vec<[f64; K]>> {
    if x.as_flattened().iter().all(|x| x.is_finite()) {
        return Ok(x);
    }
    let message = "a system is singular in floating point: its solution is not finite";
    Err(Error::new(Reason::NotPositiveDefinite, message))
}
