//! When a propagation ends before nothing is left, and which distances are final then.
//!
//! The heap holds the vertices C that were labelled d(C) but not settled; the windows that wait, wait on edges opposite
//! such vertices. A path over such a window to C is no shorter than d(C), and from any point of the window it is at most
//! r(C) long, the longest edge at C; so no window is nearer than d(C) - r(C) anywhere. What is still to come continues
//! these windows or starts at these vertices, and grows on its way: every label that is still to be given is at least
//!
//!   ρ = min over the heap of d(C) - r(C),
//!
//! and labels below ρ are final. That stays true whatever happens later, so work that is interrupted between may use the
//! ρ of any time before.
//!
//! A target inside a triangle is no farther than a corner's label and the straight way from there; once ρ is beyond the
//! least of these three, its distance is final too, by whatever way the shortest path comes.
//!
//! Cost: one pass over the heap for ρ. A stopping rule takes it when its vertices are labelled, and again only when all
//! that stood in the way has left the heap.

use crate::control::Piece;
use crate::error::Result;
use crate::metric::Scale;

/// From distances in units above the least start distance to those of the caller.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Units {
    pub(crate) scale: Scale,
    /// The least start distance, in mesh units.
    pub(crate) least: f64,
}

impl Units {
    /// The distance that the caller sees; grows with the one in units, though it may be rounded to the same.
    pub(crate) fn to_mesh(self, distance: f64) -> f64 {
        self.scale.to_mesh(distance) + self.least
    }

    /// The largest distance in mesh units that is below ρ after rounding too.
    pub(crate) fn final_radius(self, rho: f64) -> f64 {
        self.to_mesh(rho).next_down()
    }
}

/// A vertex in the heap.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Open {
    /// Its label d, in units.
    pub(crate) distance: f64,
    /// The longest edge at it, r.
    pub(crate) reach: f64,
}

/// Paths that rounding makes shorter than they are stay above ρ by this share.
const MARGIN: f64 = 1e-14;

/// The least that a label may be which is still to be given, in units.
pub(crate) fn rho(open: impl Iterator<Item = Open>) -> f64 {
    open.map(Open::least).fold(f64::INFINITY, f64::min)
}

impl Open {
    fn least(self) -> f64 {
        self.distance * (1.0 - MARGIN) - self.reach
    }
}

/// A target, by what bounds its distance: the label of each of these vertices, and the way from there. A vertex is three
/// times itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Aim(pub(crate) [(u32, f64); 3]);

impl Aim {
    fn bound(&self, label: &[f64]) -> f64 {
        self.0.iter().map(|&(v, way)| label[v as usize] + way).fold(f64::INFINITY, f64::min)
    }
}

/// A stopping rule: the work ends once every target, or everything within a radius, is final.
pub(crate) struct Stop<'a> {
    units: Units,
    /// In mesh units.
    radius: f64,
    targets: &'a [Aim],
    /// How many of the targets are known to be labelled.
    labelled: usize,
    /// Up to this distance, in units, something is in the way for certain.
    blocked: f64,
}

impl<'a> Stop<'a> {
    pub(crate) fn new(units: Units, radius: f64, targets: &'a [Aim]) -> Stop<'a> {
        Stop { units, radius, targets, labelled: 0, blocked: f64::NEG_INFINITY }
    }

    /// Whether the work may end; `distance` is the least in the heap, `open` tells all of it.
    pub(crate) fn is_met<I: Iterator<Item = Open>>(
        &mut self,
        distance: f64,
        label: &[f64],
        open: impl FnOnce() -> I,
    ) -> bool {
        if distance <= self.blocked {
            return false;
        }
        let wanted = self.wanted(distance, label);
        if self.units.to_mesh(distance) < wanted || wanted == f64::INFINITY {
            return false;
        }
        let in_the_way = open().filter(|open| self.units.final_radius(open.least()) < wanted);
        self.blocked = in_the_way.map(|open| open.distance).fold(f64::NEG_INFINITY, f64::max);
        self.blocked == f64::NEG_INFINITY
    }

    /// Up to which distance labels must be final, in mesh units; +inf where that is not known yet. Looks at each target
    /// once until all have labels.
    fn wanted(&mut self, distance: f64, label: &[f64]) -> f64 {
        let is_near = |aim: &&Aim| aim.bound(label) <= distance;
        self.labelled += self.targets[self.labelled..].iter().take_while(is_near).count();
        if self.targets.is_empty() || self.labelled < self.targets.len() {
            return self.radius;
        }
        let farthest = self.targets.iter().map(|aim| aim.bound(label)).fold(0.0, f64::max);
        self.radius.min(self.units.to_mesh(farthest))
    }
}

/// The control is consulted whenever this many windows and lists have crossed: a fraction of a millisecond.
const CHECK_EVERY: u64 = 4096;

/// Consults the control: often enough for people, seldom enough to cost nothing.
pub(crate) struct Watch<'a> {
    control: Piece<'a>,
    next_check: u64,
    next_weighing: u64,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(control: Piece<'a>) -> Watch<'a> {
        Watch { control, next_check: 0, next_weighing: 0 }
    }

    /// Whether it is time to consult the control; `work` counts what was done so far.
    pub(crate) fn is_due(&self, work: u64) -> bool {
        work >= self.next_check
    }

    /// Consults it. To tell the `bytes` in use takes time in proportion to `parts`, so they are told less often where
    /// the parts are many.
    pub(crate) fn check(
        &mut self,
        work: u64,
        progress: f64,
        parts: usize,
        bytes: impl FnOnce() -> usize,
    ) -> Result<()> {
        self.next_check = work + CHECK_EVERY;
        self.control.checkpoint(progress)?;
        if work >= self.next_weighing {
            self.next_weighing = work + parts as u64;
            self.control.check_memory(bytes)?;
        }
        Ok(())
    }
}
