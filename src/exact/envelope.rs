//! Trimming: of the windows on one half-edge, keep at each point the one that gives the least distance.
//!
//! Two windows are equally far where σ₁ + |S₁ - x| = σ₂ + |S₂ - x|. Along the edge the difference of the two sides has
//! at most one stationary point, where both pseudo-sources are seen under the same angle, so its signs at both ends of
//! the overlap and at that point tell every change of sign; each root is then found inside a bracket whose signs are
//! proven, and nothing is left to a failing formula.
//!
//! Two things are left alone, because they cost more than they save: overlaps that are small, and *crumbs*, windows so
//! narrow that rounding made them.
//!
//! n windows cost O(n log n) plus one comparison per overlap; what comes out is sorted.
//!
//! [`Memory`] trims against what crossed the half-edge before. Slivers need that, as a straight line may cross two
//! triangles without area, back and forth, for ever, and grow no longer; and edges with more than two triangles, at which
//! the windows multiply. Elsewhere the labels of the vertices drop a window soon enough, and nothing is remembered.
//!
//! Reference: Mitchell, Mount, Papadimitriou 1987 (section 3, intervals of optimality).

use super::window::Window;

/// Trims the windows of one half-edge in place; `height` is that of its triangle, `scratch` is overwritten.
pub(crate) fn trim(windows: &mut Vec<Window>, height: f64, scratch: &mut Scratch) {
    if windows.len() < 2 {
        return;
    }
    if !windows.is_sorted_by(|a, b| a.b0 <= b.b0) {
        windows.sort_by(|a, b| a.b0.total_cmp(&b.b0));
    }
    let Scratch { kept, pending } = scratch;
    kept.clear();
    for &window in &*windows {
        // What begins before it comes first.
        while let Some(rest) = pending.pop_if(|rest| rest.b0 <= window.b0) {
            add(kept, pending, rest);
        }
        add(kept, pending, window);
    }
    while let Some(rest) = pending.pop() {
        add(kept, pending, rest);
    }
    drop_crumbs(kept, height);
    std::mem::swap(windows, kept);
}

/// Windows that overlap less than this share of the narrower one are both kept whole: to find where they change hands
/// takes longer than to let them cross a triangle. On bunny this halves the time and adds 0.7 % to the windows.
const WORTH_A_CUT: f64 = 0.5;

/// Buffers of [`trim`].
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    /// Sorted.
    kept: Vec<Window>,
    /// Parts that were cut off, the one that begins first at the end.
    pending: Vec<Window>,
}

impl Scratch {
    /// For how many windows memory is taken.
    pub(crate) fn capacity(&self) -> usize {
        self.kept.capacity() + self.pending.capacity()
    }
}

/// Adds a window that begins no earlier than any that was added before, so that it is enough to look at the last of the
/// kept ones. What is cut off behind the first change of hands waits for its turn: windows may still come before it.
fn add(kept: &mut Vec<Window>, pending: &mut Vec<Window>, new: Window) {
    let Some(old) = kept.last_mut() else { return kept.push(new) };
    if old.continues_in(&new) {
        old.b1 = old.b1.max(new.b1);
        return;
    }
    if old.b1 <= new.b0 {
        return kept.push(new);
    }
    let old_end = old.b1;
    let overlap = [new.b0, old_end.min(new.b1)];
    let narrower = (old.b1 - old.b0).min(new.b1 - new.b0);
    if overlap[1] - overlap[0] < WORTH_A_CUT * narrower {
        kept.push(new);
        return;
    }
    let mut later = |rest: Window| {
        if rest.b0 < rest.b1 {
            let place = pending.iter().rposition(|other| other.b0 >= rest.b0).map_or(0, |i| i + 1);
            pending.insert(place, rest);
        }
    };
    match duel(old, &new, overlap, 0.0) {
        Duel::Old => later(Window { b0: old_end, ..new }),
        Duel::New => {
            later(Window { b0: new.b1, ..*old });
            old.b1 = new.b0;
            if old.b0 >= old.b1 {
                kept.pop();
            }
            kept.push(new);
        }
        Duel::OldThenNew { root, until } => {
            later(Window { b0: until, ..*old });
            old.b1 = root;
            later(Window { b0: root, ..new });
        }
        Duel::NewThenOld { root, until } => {
            later(Window { b0: root, ..*old });
            later(Window { b0: until, ..new });
            old.b1 = new.b0;
            if old.b0 >= old.b1 {
                kept.pop();
            }
            kept.push(Window { b1: root, ..new });
        }
    }
}

/// The rounding of a distance, as a share.
const ROUNDING: f64 = 1e-16;

/// Drops windows so narrow that the path beside them is as short. Where two windows touch, both are equally far and their
/// difference grows only with the square of the way from there, so rounding cuts them into ever more pieces: on bunny
/// they were 1.1 of 2.6 million windows.
///
/// A path over a dropped place bends at the nearest kept one, w away, instead. With r the distance from the edge of the
/// nearer end of its straight piece that makes it longer by w² / r at most, which must be below the rounding of d. Dropped
/// neighbours count as one.
fn drop_crumbs(windows: &mut Vec<Window>, height: f64) {
    let mut run = f64::NEG_INFINITY; // where the dropped neighbours begin
    let mut end = f64::NEG_INFINITY;
    windows.retain(|w| {
        if w.b0 > end {
            run = w.b0;
        }
        end = w.b1;
        let width = w.b1 - run;
        // Most windows are far from it; the root is for the others.
        let is_crumb = width < 1e-3 * height && {
            let distance = w.distance(w.b1);
            width * width <= ROUNDING * distance * height.min(distance - w.sigma)
        };
        if !is_crumb {
            run = w.b1;
        }
        !is_crumb
    });
}

/// What memory leaves of a window is dropped below this share of the window's width, or of its edge.
const LEAST_REST: f64 = 1e-7;
const LEAST_WIDTH: f64 = 1e-12;

/// What crossed the half-edges of triangles that remember; also the measure of what is news to them.
pub(crate) struct Memory {
    windows: Vec<Window>,
    /// Least width of a window, and how much shorter than a remembered path a new one must be.
    least: f64,
    margin: f64,
}

impl Memory {
    /// Nothing yet, on an edge of this length. Paths are equal if they differ by the share `tie`.
    pub(crate) fn new(length: f64, tie: f64) -> Memory {
        Memory { windows: Vec::new(), least: LEAST_WIDTH * length, margin: tie }
    }

    /// For how many windows memory is taken.
    pub(crate) fn capacity(&self) -> usize {
        self.windows.capacity()
    }

    /// Keeps of the windows what is shorter than anything remembered, and remembers it.
    ///
    /// Where a window is cut down to next to nothing, the rest is dropped: between two edges that almost coincide such
    /// a rest would creep along by its own width at every crossing. A path that the rest would have carried bends at
    /// its end instead, which makes it longer by the square of that share only.
    pub(crate) fn keep_news(&mut self, windows: &mut Vec<Window>, scratch: &mut Scratch) {
        let scratch = &mut scratch.kept;
        scratch.clear();
        for window in windows.iter() {
            let least = self.least.max(LEAST_REST * (window.b1 - window.b0));
            insert(&mut self.windows, *window, self.margin, |piece| {
                if piece.b1 - piece.b0 >= least {
                    scratch.push(piece);
                }
            });
        }
        std::mem::swap(windows, scratch);
    }
}

/// Inserts a window into a disjoint sorted list, at the points where it is shorter by the share `margin`; those pieces
/// of it go to `won` as well.
fn insert(disjoint: &mut Vec<Window>, new: Window, margin: f64, mut won: impl FnMut(Window)) {
    let first = disjoint.iter().rposition(|old| old.b1 <= new.b0).map_or(0, |i| i + 1);
    let mut pieces = Pieces::default();
    let mut done = new.b0;
    for old in disjoint.drain(first..) {
        pieces.push(&old, false, old.b0, old.b1.min(new.b0));
        pieces.push(&new, true, done, old.b0.min(new.b1));
        contest(&mut pieces, &old, &new, margin);
        pieces.push(&old, false, old.b0.max(new.b1), old.b1);
        done = old.b1.max(done);
    }
    pieces.push(&new, true, done, new.b1);
    for piece in pieces.0 {
        disjoint.push(piece.window);
        if piece.is_new {
            won(piece.window);
        }
    }
}

/// A part of a window while two sets of windows are merged.
struct Piece {
    window: Window,
    is_new: bool,
}

/// Pieces from left to right.
#[derive(Default)]
struct Pieces(Vec<Piece>);

impl Pieces {
    /// Appends [from, to] of a window, if that is not empty; to the last piece where it continues that one.
    fn push(&mut self, window: &Window, is_new: bool, from: f64, to: f64) {
        if from >= to {
            return;
        }
        let cut = Window { b0: from, b1: to, ..*window };
        match self.0.last_mut() {
            Some(last) if last.is_new == is_new && last.window == (Window { b0: last.window.b0, b1: from, ..cut }) => {
                last.window.b1 = to;
            }
            _ => self.0.push(Piece { window: cut, is_new }),
        }
    }
}

/// Shares out the overlap of two windows.
fn contest(pieces: &mut Pieces, old: &Window, new: &Window, margin: f64) {
    let (mut low, high) = (old.b0.max(new.b0), old.b1.min(new.b1));
    let mut give = |is_new: bool, from: f64, to: f64| pieces.push(if is_new { new } else { old }, is_new, from, to);
    while low < high {
        match duel(old, new, [low, high], margin) {
            Duel::Old => return give(false, low, high),
            Duel::New => return give(true, low, high),
            Duel::OldThenNew { root, until } => {
                give(false, low, root);
                give(true, root, until);
                low = until;
            }
            Duel::NewThenOld { root, until } => {
                give(true, low, root);
                give(false, root, until);
                low = until;
            }
        }
    }
}

/// Who is nearer along an overlap: the old or the new window, or one up to a root and the other from there until some
/// place. Where there are two changes of hands that place lies between them, else it is the end of the overlap.
enum Duel {
    Old,
    New,
    OldThenNew { root: f64, until: f64 },
    NewThenOld { root: f64, until: f64 },
}

/// To win, the new window must be nearer by the share `margin`.
fn duel(old: &Window, new: &Window, [low, high]: [f64; 2], margin: f64) -> Duel {
    let gain = |x: f64| old.distance(x) * (1.0 - margin) - new.distance(x);
    let (gain_low, gain_high) = (gain(low), gain(high));
    let is_new = gain_low > 0.0;
    let change = |until: f64, gain_until: f64| {
        let root = crossing(old, new, [low, until], [gain_low, gain_until], margin);
        if is_new { Duel::NewThenOld { root, until } } else { Duel::OldThenNew { root, until } }
    };
    if is_new != (gain_high > 0.0) {
        return change(high, gain_high);
    }
    // Seen under one angle: (x - s1x) / s1y = (x - s2x) / s2y.
    let stationary = (old.sx * new.sy - new.sx * old.sy) / (new.sy - old.sy);
    if low < stationary && stationary < high {
        let between = gain(stationary);
        if is_new != (between > 0.0) {
            return change(stationary, between);
        }
    }
    if is_new { Duel::New } else { Duel::Old }
}

/// Where the gain of the new window over the old one changes its sign, to the rounding of the distances: Newton's steps
/// inside a bracket whose signs are proven, and halves where they lead out of it.
fn crossing(
    old: &Window,
    new: &Window,
    [mut low, mut high]: [f64; 2],
    [gain_low, gain_high]: [f64; 2],
    margin: f64,
) -> f64 {
    const STEPS: usize = 6;
    let mut x = low + (high - low) * (gain_low / (gain_low - gain_high));
    for step in 0.. {
        if !(x > low && x < high) || step > STEPS {
            x = 0.5 * (low + high);
            if x <= low || x >= high {
                break;
            }
        }
        let (to_old, to_new) = (x - old.sx, x - new.sx);
        let far_old = (to_old * to_old + old.sy * old.sy).sqrt();
        let far_new = (to_new * to_new + new.sy * new.sy).sqrt();
        let gain = (old.sigma + far_old) * (1.0 - margin) - (new.sigma + far_new);
        if gain.abs() <= ROUNDING * (old.sigma + far_old) {
            break;
        }
        if (gain > 0.0) == (gain_low > 0.0) {
            low = x
        } else {
            high = x
        }
        x -= gain / (to_old / far_old - to_new / far_new);
    }
    x
}
