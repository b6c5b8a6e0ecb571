//! Progress and cancellation of long work.

use crate::error::{Error, Reason, Result};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// A handle on running work: any thread may poll its progress or cancel it.
///
/// Clones share one state. Pass the same `Control` to the long call and to whoever watches it; use a new one for each
/// call. A cancelled call returns [`Reason::Cancelled`] at its next checkpoint and writes nothing.
#[derive(Debug, Clone, Default)]
pub struct Control(Arc<State>);

#[derive(Debug, Default)]
struct State {
    cancelled: AtomicBool,
    progress_bits: AtomicU64,
}

impl Control {
    /// A control at progress 0, not cancelled.
    #[must_use]
    pub fn new() -> Control {
        Control::default()
    }

    /// Asks the work to stop at its next checkpoint.
    pub fn cancel(&self) {
        self.0.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether [`Control::cancel`] was called.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.cancelled.load(Ordering::Relaxed)
    }

    /// The share of the work that is done, in [0, 1].
    #[must_use]
    pub fn progress(&self) -> f64 {
        f64::from_bits(self.0.progress_bits.load(Ordering::Relaxed))
    }

    /// Reports progress; fails if the work was cancelled.
    pub(crate) fn checkpoint(&self, progress: f64) -> Result<()> {
        self.0.progress_bits.store(progress.clamp(0.0, 1.0).to_bits(), Ordering::Relaxed);
        if self.is_cancelled() { Err(Error::new(Reason::Cancelled, "the work was cancelled")) } else { Ok(()) }
    }
}
