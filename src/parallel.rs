//! Rows that are computed side by side by threads, each the same whoever computes it.

use crate::control::{Control, Piece};
use crate::error::Result;
use std::num::NonZero;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

/// More threads than this are not started, whatever is asked for.
const MOST_THREADS: usize = 1024;

/// Computes `count` rows on several threads, 0 for as many as the machine has, each with a state of its own. Progress
/// counts rows, on the calling thread.
pub(crate) fn rows<State, Row: Send>(
    count: usize,
    threads: usize,
    control: &Control,
    state: impl Fn() -> State + Sync,
    row: impl Fn(&mut State, usize, Piece) -> Result<Row> + Sync,
) -> Result<Vec<Row>> {
    let threads = if threads == 0 { thread::available_parallelism().map_or(1, NonZero::get) } else { threads };
    let threads = threads.min(MOST_THREADS).min(count);
    let (next, done, is_over) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicBool::new(false));
    let work = |is_caller: bool| {
        let mut state = state();
        let mut rows = Vec::new();
        while !is_over.load(Ordering::Relaxed) {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= count {
                break;
            }
            let progress = |done: usize| done as f64 / count as f64;
            let before = done.load(Ordering::Relaxed);
            let piece = match is_caller {
                true => Piece::whole(control).part(progress(before), progress(before + 1)),
                false => Piece::elsewhere(control),
            };
            let computed = row(&mut state, i, piece);
            is_over.fetch_or(computed.is_err(), Ordering::Relaxed);
            rows.push((i, computed));
            done.fetch_add(1, Ordering::Relaxed);
        }
        rows
    };
    let mut rows = thread::scope(|scope| {
        // Where the system gives no more threads, those that there are do all.
        let spawn = |_| thread::Builder::new().spawn_scoped(scope, || work(false)).ok();
        let others: Vec<_> = (1..threads).map_while(spawn).collect();
        let mut rows = work(true);
        for other in others {
            rows.extend(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        rows
    });
    rows.sort_unstable_by_key(|&(i, _)| i);
    let rows = rows.into_iter().map(|(_, row)| row).collect::<Result<_>>()?;
    control.report(1.0);
    Ok(rows)
}
