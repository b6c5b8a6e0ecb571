//! Sources: where distances are measured from.

use crate::error::{Element, Error, Reason, Result};

/// A place that distances are measured from, and the distance that it starts with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    vertex: u32,
    offset: f64,
}

impl Source {
    /// A vertex, at distance 0.
    #[must_use]
    pub fn vertex(vertex: u32) -> Source {
        Source { vertex, offset: 0.0 }
    }

    /// The same place with start distance `offset`, in mesh units: any finite number.
    #[must_use]
    pub fn with_offset(self, offset: f64) -> Source {
        Source { offset, ..self }
    }

    /// The vertex.
    #[must_use]
    pub fn vertex_index(self) -> u32 {
        self.vertex
    }

    /// The start distance, in mesh units.
    pub(crate) fn offset(self) -> f64 {
        self.offset
    }

    /// Sources as the engines use them: checked, sorted by vertex, and of several at one vertex only the nearest.
    pub(crate) fn checked(sources: &[Source], mesh_vertices: usize) -> Result<Vec<Source>> {
        if sources.is_empty() {
            return Err(Error::new(Reason::NoSource, "at least one source is needed"));
        }
        for (i, source) in (0..).zip(sources) {
            if source.vertex as usize >= mesh_vertices {
                let message = format!("is vertex {}, but the mesh has {mesh_vertices} vertices", source.vertex);
                return Err(Error::at(Reason::VertexOutOfRange, Element::Source(i), message));
            }
            if !source.offset.is_finite() {
                let message = format!("has the start distance {}, which is not finite", source.offset);
                return Err(Error::at(Reason::BadArgument, Element::Source(i), message));
            }
        }
        let mut checked = sources.to_vec();
        checked.sort_by(|a, b| a.vertex.cmp(&b.vertex).then(a.offset.total_cmp(&b.offset)));
        checked.dedup_by_key(|source| source.vertex);
        Ok(checked)
    }
}
