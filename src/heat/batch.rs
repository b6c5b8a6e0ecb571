//! Many sets of sources over one mesh: blocks of them side by side, so that the factors are fetched once for each block.
//!
//! Each field has the bits that it has alone, for any number of threads.

use super::{HeatField, HeatSolver};
use crate::control::Control;
use crate::error::Result;
use crate::parallel;
use crate::surface::source::{Seed, Source};

/// How many sets make a block.
const BLOCK: usize = 8;

impl HeatSolver {
    /// The distances of every vertex from each of several sets of sources: one row per set, each as
    /// [`HeatSolver::field`] gives it, at half its cost or less.
    ///
    /// 0 `threads` are as many as the machine has; more than 1024 are never started. Progress counts blocks of 8 rows.
    ///
    /// # Errors
    /// As [`HeatSolver::field`]; sources are counted through all sets.
    pub fn distance_rows(&self, sets: &[Vec<Source>], threads: usize, control: &Control) -> Result<Vec<Vec<f64>>> {
        let sets = Source::checked_sets(sets, &self.systems.mesh)?;
        let firsts: Vec<u64> =
            sets.iter().scan(0, |next, set| Some(std::mem::replace(next, *next + set.len() as u64))).collect();
        let numbered: Vec<(u64, &[Seed])> = firsts.into_iter().zip(sets.iter().map(Vec::as_slice)).collect();
        let (blocks, rest) = numbered.as_chunks::<BLOCK>();
        let rows = parallel::rows(
            blocks.len() + rest.len(),
            threads,
            control,
            || (),
            |(), i, piece| {
                let fields = match blocks.get(i) {
                    Some(block) => Vec::from(self.fields(*block, piece)?),
                    None => Vec::from(self.fields([rest[i - blocks.len()]], piece)?),
                };
                Ok(fields.into_iter().map(HeatField::into_distances).collect::<Vec<_>>())
            },
        )?;
        Ok(rows.into_iter().flatten().collect())
    }
}
