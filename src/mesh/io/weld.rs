//! Vertices of formats that repeat a position wherever faces meet: STL at each corner, glTF along seams.
//!
//! Equal positions become one vertex, and vertices are numbered by first appearance. Equal is equal bit for bit, with one
//! exception: -0.0 counts as 0.0, which it equals; programs write it at random, where a small negative number was
//! rounded. A vertex keeps the bits of its first appearance. A NaN equals the NaN of the same bits.
//!
//! O(1) a position, by hashing with a random key, so that no file can choose positions that collide.

use crate::error::{Error, Reason, Result};
use std::collections::HashMap;

#[derive(Debug, Default)]
pub(super) struct Welder {
    positions: Vec<[f64; 3]>,
    numbers: HashMap<[u64; 3], u32>,
}

impl Welder {
    /// The number of the vertex at this position.
    pub(super) fn vertex(&mut self, position: [f64; 3]) -> Result<u32> {
        let next = u32::try_from(self.positions.len())
            .map_err(|_| Error::new(Reason::TooManyElements, "the vertices exceed 32-bit indices"))?;
        // Adding 0 makes 0 of -0 and leaves every other number as it is.
        let vertex = *self.numbers.entry(position.map(|x| (x + 0.0).to_bits())).or_insert(next);
        if vertex == next {
            self.positions.push(position);
        }
        Ok(vertex)
    }

    pub(super) fn into_positions(self) -> Vec<[f64; 3]> {
        self.positions
    }
}
