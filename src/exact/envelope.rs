//! Trimming: of the windows on one half-edge, keep at each point the one that gives the least distance.
//!
//! Two windows are equally far where σ₁ + |S₁ - x| = σ₂ + |S₂ - x|. Along the edge the difference of the two sides has
//! at most one stationary point, where both pseudo-sources are seen under the same angle, so its signs at both ends of
//! the overlap and at that point tell every change of sign; each root is then found inside a bracket whose signs are
//! proven, and nothing is left to a failing formula.
//!
//! n windows cost O(n log n) plus one comparison per overlap; what comes out is disjoint and sorted.
//!
//! [`Memory`] trims against what crossed the half-edge before. Slivers need that, as a straight line may cross two
//! triangles without area, back and forth, for ever, and grow no longer; and edges with more than two triangles, at which
//! the windows multiply. Elsewhere the labels of the vertices drop a window soon enough, and nothing is remembered.
//!
//! Reference: Mitchell, Mount, Papadimitriou 1987 (section 3, intervals of optimality).

use super::window::Window;

/// Trims windows of one half-edge in place; `scratch` is overwritten.
pub(crate) fn trim(windows: &mut Vec<Window>, scratch: &mut Vec<Window>) {
    if windows.len() < 2 {
        return;
    }
    if !windows.is_sorted_by(|a, b| a.b0 <= b.b0) {
        windows.sort_by(|a, b| a.b0.total_cmp(&b.b0));
    }
    scratch.clear();
    for window in windows.iter() {
        insert(scratch, *window, 0.0, |_| {});
    }
    std::mem::swap(windows, scratch);
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

    /// Keeps of the windows what is shorter than anything remembered, and remembers it.
    ///
    /// Where a window is cut down to next to nothing, the rest is dropped: between two edges that almost coincide such
    /// a rest would creep along by its own width at every crossing. A path that the rest would have carried bends at
    /// its end instead, which makes it longer by the square of that share only.
    pub(crate) fn keep_news(&mut self, windows: &mut Vec<Window>, scratch: &mut Vec<Window>) {
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
    let (low, high) = (old.b0.max(new.b0), old.b1.min(new.b1));
    if low >= high {
        return;
    }
    let new_wins = |x: f64| new.distance(x) < old.distance(x) * (1.0 - margin);
    let (wins_low, wins_high) = (new_wins(low), new_wins(high));
    let mut give = |to_new: bool, from: f64, to: f64| pieces.push(if to_new { new } else { old }, to_new, from, to);
    if wins_low != wins_high {
        let root = root(&new_wins, low, high);
        give(wins_low, low, root);
        give(wins_high, root, high);
        return;
    }
    // Seen under one angle: (x - s1x) / s1y = (x - s2x) / s2y.
    let stationary = (old.sx * new.sy - new.sx * old.sy) / (new.sy - old.sy);
    if low < stationary && stationary < high && new_wins(stationary) != wins_low {
        let (left, right) = (root(&new_wins, low, stationary), root(&new_wins, stationary, high));
        give(wins_low, low, left);
        give(!wins_low, left, right);
        give(wins_low, right, high);
    } else {
        give(wins_low, low, high);
    }
}

/// The point of [low, high] where `wins` changes, to the last bit or so, by bisection.
fn root(wins: &impl Fn(f64) -> bool, mut low: f64, mut high: f64) -> f64 {
    let at_low = wins(low);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if wins(middle) == at_low { low = middle } else { high = middle }
    }
}
