//! The windows that crossed a triangle, kept for distances and paths of points that are no vertices.
//!
//! They lie in the order in which they crossed, one *run* for each list, and only the runs are sorted by half-edge: no
//! window is ever moved. 48 bytes a window and 24 a run; O(log n) to find the runs of a half-edge among n.

use super::window::{Mixed, Rays, Window};

/// What crossed one half-edge at one time.
#[derive(Debug, Clone, Copy)]
struct Run {
    h: u32,
    start: usize,
    end: usize,
}

/// Windows by half-edge.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    windows: Vec<Window<Mixed>>,
    runs: Vec<Run>,
}

impl Kept {
    /// Keeps windows that enter the triangle of half-edge h over it.
    pub(crate) fn push<R: Rays>(&mut self, h: u32, windows: &[Window<R>]) {
        let start = self.windows.len();
        self.windows.extend(windows.iter().map(Window::mixed));
        self.runs.push(Run { h, start, end: self.windows.len() });
    }

    /// To be called before [`Kept::on`].
    pub(crate) fn sort(&mut self) {
        self.runs.sort_unstable_by_key(|run| (run.h, run.start));
    }

    /// The windows that entered the triangle of half-edge h over it.
    pub(crate) fn on(&self, h: u32) -> impl Iterator<Item = &Window<Mixed>> {
        let first = self.runs.partition_point(|run| run.h < h);
        let runs = self.runs[first..].iter().take_while(move |run| run.h == h);
        runs.flat_map(|run| &self.windows[run.start..run.end])
    }

    /// The memory in use.
    pub(crate) fn bytes(&self) -> usize {
        self.windows.capacity() * size_of::<Window<Mixed>>() + self.runs.capacity() * size_of::<Run>()
    }
}
