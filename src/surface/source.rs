//! What distances are measured from.

use super::curve::{Curve, Route};
use super::point::{Place, SurfacePoint};
use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;
use std::sync::Arc;

/// What distances are measured from, a vertex, a point or a curve, and the distance that it starts with. Clones share the
/// curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    given: Given,
    offset: f64,
}

#[derive(Debug, Clone, PartialEq)]
enum Given {
    Vertex(u32),
    Point(SurfacePoint),
    Curve(Arc<Curve>),
}

/// A source that was checked.
#[derive(Debug, Clone)]
pub(crate) struct Seed {
    /// Its number in the caller's list.
    pub(crate) source: u32,
    pub(crate) origin: Origin,
    /// In mesh units.
    pub(crate) offset: f64,
}

/// Where a source begins.
#[derive(Debug, Clone)]
pub(crate) enum Origin {
    Place(Place),
    Curve(Route),
}

impl Source {
    /// A vertex, at distance 0.
    #[must_use]
    pub fn vertex(vertex: u32) -> Source {
        Source { given: Given::Vertex(vertex), offset: 0.0 }
    }

    /// Any point of the surface, at distance 0. Its weights may sum to 1 up to 1e-6.
    #[must_use]
    pub fn point(point: SurfacePoint) -> Source {
        Source { given: Given::Point(point), offset: 0.0 }
    }

    /// All points of a curve at once, at distance 0: the distance from it is that from the nearest of them. The curve may
    /// cross itself, run along edges and through vertices, and have one point only; points may follow each other at one
    /// place. A point on an edge or at a vertex may name any triangle there.
    #[must_use]
    pub fn curve(curve: Curve) -> Source {
        Source { given: Given::Curve(Arc::new(curve)), offset: 0.0 }
    }

    /// The same place with start distance `offset`, in mesh units: any finite number.
    #[must_use]
    pub fn with_offset(self, offset: f64) -> Source {
        Source { offset, ..self }
    }

    /// Where it lies, in mesh units: one position, or that of each point of a curve.
    ///
    /// # Errors
    /// [`Reason::VertexOutOfRange`], or [`Reason::BadArgument`] as [`SurfacePoint::position`].
    pub fn positions(&self, mesh: &Mesh) -> Result<Vec<[f64; 3]>> {
        match &self.given {
            Given::Vertex(v) => match mesh.positions().get(*v as usize) {
                Some(&position) => Ok(vec![position]),
                None => Err(Error::new(Reason::VertexOutOfRange, out_of_range(*v, mesh))),
            },
            Given::Point(point) => Ok(vec![point.position(mesh)?]),
            Given::Curve(curve) => curve.positions(mesh),
        }
    }

    /// Checks sources: one or more, each on the mesh and with a finite start distance.
    pub(crate) fn checked(sources: &[Source], mesh: &Mesh) -> Result<Vec<Seed>> {
        if sources.is_empty() {
            return Err(Error::new(Reason::NoSource, "at least one source is needed"));
        }
        let seed = |(i, source): (u32, &Source)| {
            let error = |reason, message| Error::at(reason, Element::Source(u64::from(i)), message);
            let bad = |message| error(Reason::BadArgument, message);
            let origin = match &source.given {
                &Given::Vertex(v) if v as usize >= mesh.vertex_count() => {
                    return Err(error(Reason::VertexOutOfRange, out_of_range(v, mesh)));
                }
                &Given::Vertex(v) => Origin::Place(Place::Vertex(v)),
                Given::Point(point) => Origin::Place(point.checked(mesh).map_err(bad)?.as_place(mesh)),
                Given::Curve(curve) => Origin::Curve(curve.checked(mesh).map_err(bad)?),
            };
            if !source.offset.is_finite() {
                return Err(bad(format!("has the start distance {}, which is not finite", source.offset)));
            }
            Ok(Seed { source: i, origin, offset: source.offset })
        };
        (0..).zip(sources).map(seed).collect()
    }

    /// Checks several sets of sources; each counts its own, errors count through all sets.
    pub(crate) fn checked_sets(sets: &[Vec<Source>], mesh: &Mesh) -> Result<Vec<Vec<Seed>>> {
        let mut before = 0;
        let checked = |set: &Vec<Source>| {
            let seeds = Source::checked(set, mesh).map_err(|error| match error.element() {
                Some(Element::Source(i)) => error.about(Element::Source(before + i)),
                _ => error,
            });
            before += set.len() as u64;
            seeds
        };
        sets.iter().map(checked).collect()
    }
}

fn out_of_range(v: u32, mesh: &Mesh) -> String {
    format!("is vertex {v}, but the mesh has {} vertices", mesh.vertex_count())
}
