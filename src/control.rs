//! Watching and limiting long work: progress, cancellation, a time limit and a memory limit.
//!
//! The work calls [`Control::checkpoint`] now and then, on the thread of the call: progress is told there, and there the
//! work ends if it was cancelled or has reached a limit.

use crate::error::{Error, Reason, Result};
use std::fmt;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A handle on running work: any thread may poll its progress, cancel it or limit it.
///
/// Clones share one state. Pass the same `Control` to the long call and to whoever watches it; use a new one for each
/// call, or one for several calls that share a limit. A call that is cancelled or reaches a limit fails at its next
/// checkpoint with [`Reason::Cancelled`], [`Reason::TimeLimit`] or [`Reason::MemoryLimit`], unless
/// [`ExactOptions::allow_partial`](crate::ExactOptions::allow_partial) asks for what is known by then.
///
/// ```
/// use std::time::Duration;
/// use taut::{Control, ExactOptions, ExactSolver, Source, shapes};
/// # fn main() -> taut::Result<()> {
/// let control = Control::new();
/// control.set_time_limit(Duration::from_secs(60));
/// control.set_memory_limit(1 << 30);
/// let solver = ExactSolver::new(&shapes::icosphere(3).mesh()?)?;
/// let field = solver.field(&[Source::vertex(0)], &ExactOptions::default(), &control)?;
/// # Ok(()) }
/// ```
#[derive(Clone, Default)]
pub struct Control(Arc<State>);

#[derive(Default)]
struct State {
    cancelled: AtomicBool,
    progress_bits: AtomicU64,
    limits: Mutex<Limits>,
    telling: Mutex<Telling>,
}

/// To whom progress is told, and how often.
#[derive(Default)]
struct Telling {
    callback: Option<Callback>,
    interval: Duration,
    last: Option<Instant>,
}

impl Telling {
    /// The callback, if it is to be told this progress.
    fn due(&mut self, progress: f64) -> Option<Callback> {
        if !self.interval.is_zero() && progress < 1.0 {
            let now = Instant::now();
            if self.last.is_some_and(|last| now - last < self.interval) {
                return None;
            }
            self.last = Some(now);
        }
        self.callback.take()
    }
}

#[derive(Clone, Copy)]
struct Limits {
    /// When the time limit was set.
    start: Instant,
    time: Duration,
    bytes: usize,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits { start: Instant::now(), time: Duration::MAX, bytes: usize::MAX }
    }
}

type Callback = Box<dyn FnMut(f64) -> ControlFlow<()> + Send>;

impl Control {
    /// A control at progress 0, not cancelled, without limits.
    #[must_use]
    pub fn new() -> Control {
        Control::default()
    }

    /// Asks the work to stop at its next checkpoint.
    pub fn cancel(&self) {
        self.0.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether [`Control::cancel`] was called, or a callback has cancelled the work.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.cancelled.load(Ordering::Relaxed)
    }

    /// The share of the work that is done, in [0, 1].
    #[must_use]
    pub fn progress(&self) -> f64 {
        f64::from_bits(self.0.progress_bits.load(Ordering::Relaxed))
    }

    /// Ends the work when this much time has passed from now; `Duration::MAX` is no limit.
    pub fn set_time_limit(&self, limit: Duration) {
        let mut limits = lock(&self.0.limits);
        limits.start = Instant::now();
        limits.time = limit;
    }

    /// Ends the work when it uses more than this many bytes; `usize::MAX` is no limit.
    ///
    /// Only [`ExactSolver`](crate::ExactSolver) counts its bytes, each thread by itself: those beyond the mesh, the solver
    /// and the rows that are gathered.
    pub fn set_memory_limit(&self, bytes: usize) {
        lock(&self.0.limits).bytes = bytes;
    }

    /// Tells the progress to `callback` at each checkpoint, on the thread that makes the call and never inside another
    /// run of the callback; `Break` cancels the work.
    pub fn set_callback(&self, callback: impl FnMut(f64) -> ControlFlow<()> + Send + 'static) {
        let former = lock(&self.0.telling).callback.replace(Box::new(callback));
        drop(former); // here, with the lock open: the drop of a closure may use this control
    }

    /// Lets the callback rest: from one time that it is told to the next at least so long goes by, but for the end of the
    /// work, at progress 1. For a callback that costs more than a microsecond; `Duration::ZERO`, the default, is no rest.
    pub fn set_callback_interval(&self, interval: Duration) {
        lock(&self.0.telling).interval = interval;
    }

    /// Reports progress. For the thread of the call only, since it runs the callback.
    pub(crate) fn report(&self, progress: f64) {
        let progress = progress.clamp(0.0, 1.0);
        self.0.progress_bits.store(progress.to_bits(), Ordering::Relaxed);
        // Taken out while it runs, so that it may use this control, even for another call.
        let taken = lock(&self.0.telling).due(progress);
        if let Some(mut callback) = taken {
            if callback(progress).is_break() {
                self.cancel();
            }
            // Another one that was set meanwhile stays; this one is dropped with the lock open.
            let mut telling = lock(&self.0.telling);
            if telling.callback.is_none() {
                telling.callback = Some(callback);
            }
        }
    }

    /// Reports progress; fails if the work was cancelled or its time is over.
    pub(crate) fn checkpoint(&self, progress: f64) -> Result<()> {
        self.report(progress);
        self.check()
    }

    /// Fails if the work was cancelled or its time is over. For any thread.
    fn check(&self) -> Result<()> {
        if self.is_cancelled() {
            return Err(Error::new(Reason::Cancelled, "the work was cancelled"));
        }
        let Limits { start, time, .. } = *lock(&self.0.limits);
        if time < Duration::MAX && start.elapsed() >= time {
            let message = format!("the time limit of {time:?} is reached, after {:?}", start.elapsed());
            return Err(Error::new(Reason::TimeLimit, message));
        }
        Ok(())
    }

    /// Fails if the work uses more memory than it may; `used` tells the bytes, where there is a limit.
    pub(crate) fn check_memory(&self, used: impl FnOnce() -> usize) -> Result<()> {
        let limit = lock(&self.0.limits).bytes;
        if limit == usize::MAX {
            return Ok(());
        }
        match used() {
            used if used <= limit => Ok(()),
            used => {
                let message = format!("the memory limit of {limit} bytes is reached: {used} are in use");
                Err(Error::new(Reason::MemoryLimit, message))
            }
        }
    }
}

/// The control as one of the pieces sees it that a work is made of.
#[derive(Clone, Copy)]
pub(crate) struct Piece<'a> {
    control: &'a Control,
    /// The progress at its begin and its end, if the piece is done on the thread of the call; others tell none.
    progress: Option<[f64; 2]>,
}

impl<'a> Piece<'a> {
    /// The whole work.
    pub(crate) fn whole(control: &'a Control) -> Piece<'a> {
        Piece { control, progress: Some([0.0, 1.0]) }
    }

    /// The part of this piece between two of its progresses.
    pub(crate) fn part(&self, from: f64, to: f64) -> Piece<'a> {
        let progress = self.progress.map(|[begin, end]| [from, to].map(|at| begin + (end - begin) * at));
        Piece { control: self.control, progress }
    }

    /// A piece on another thread.
    pub(crate) fn elsewhere(control: &'a Control) -> Piece<'a> {
        Piece { control, progress: None }
    }

    /// As [`Control::report`], with the progress of the piece.
    pub(crate) fn report(&self, progress: f64) {
        if let Some([from, to]) = self.progress {
            self.control.report(from + (to - from) * progress.clamp(0.0, 1.0));
        }
    }

    /// As [`Control::checkpoint`], with the progress of the piece.
    pub(crate) fn checkpoint(&self, progress: f64) -> Result<()> {
        self.report(progress);
        self.control.check()
    }

    /// As [`Control::check_memory`], with the bytes of the piece.
    pub(crate) fn check_memory(&self, used: impl FnOnce() -> usize) -> Result<()> {
        self.control.check_memory(used)
    }
}

impl fmt::Debug for Control {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut out = out.debug_struct("Control");
        out.field("cancelled", &self.is_cancelled()).field("progress", &self.progress()).finish_non_exhaustive()
    }
}

/// No code runs under these locks that could leave half a state behind, so a panic elsewhere does not matter.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
