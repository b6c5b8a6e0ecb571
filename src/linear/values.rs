//! The numbers of a factor, in pages as large as the system gives.
//!
//! A factor is by far the largest thing that a solver has, and its blocks are walked in long strides. On pages of 2 MB
//! these strides stay within what the processor can address at once, and taking the memory costs a tenth.

use super::out_of_memory;
use crate::error::Result;
use memmap2::MmapMut;
use std::ops::{Deref, DerefMut};

/// Numbers that begin as zeros.
#[derive(Debug)]
pub(super) struct Values(MmapMut);

impl Values {
    pub(super) fn zeros(len: usize) -> Result<Values> {
        let bytes = len.checked_mul(size_of::<f64>()).ok_or_else(out_of_memory)?;
        let map = MmapMut::map_anon(bytes).map_err(|_| out_of_memory())?;
        #[cfg(target_os = "linux")]
        let _ = map.advise(memmap2::Advice::HugePage); // it is a wish: where there are none, small pages serve
        Ok(Values(map))
    }
}

impl Deref for Values {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        bytemuck::cast_slice(&self.0)
    }
}

impl DerefMut for Values {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(&mut self.0)
    }
}
