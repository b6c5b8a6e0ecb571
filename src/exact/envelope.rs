//! Trimming: of the windows on one half-edge, keep at each point the one that gives the least distance.
//!
//! Two windows are equally far where σ₁ + |S₁ - x| = σ₂ + |S₂ - x|. Along the edge the difference of the two sides has
//! at most one stationary point, where both pseudo-sources are seen under the same angle, so its signs at both ends of
//! the overlap and at that point tell every change of sign; each root is then found inside a bracket whose signs are
//! proven, and nothing is left to a failing formula.
//!
//! n windows cost O(n log n) plus one comparison per overlap; what comes out is disjoint and sorted.
//!
//! Reference: Mitchell, Mount, Papadimitriou 1987 (section 3, intervals of optimality).

use super::window::Window;

/// A piece [from, to] of window `owner` while two sets of windows are merged.
struct Piece {
    window: Window,
    from: f64,
    to: f64,
}

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
        insert(scratch, *window);
    }
    std::mem::swap(windows, scratch);
}

/// Inserts a window into a disjoint sorted list.
fn insert(disjoint: &mut Vec<Window>, new: Window) {
    let first = disjoint.iter().rposition(|old| old.b1 <= new.b0).map_or(0, |i| i + 1);
    if first == disjoint.len() {
        disjoint.push(new);
        return;
    }
    let mut pieces = Pieces::default();
    let mut done = new.b0;
    for old in disjoint.drain(first..) {
        pieces.push(&old, old.b0, old.b1.min(new.b0));
        pieces.push(&new, done, old.b0.min(new.b1));
        contest(&mut pieces, &old, &new);
        pieces.push(&old, old.b0.max(new.b1), old.b1);
        done = old.b1.max(done);
    }
    pieces.push(&new, done, new.b1);
    disjoint.extend(pieces.0.iter().map(|piece| Window { b0: piece.from, b1: piece.to, ..piece.window }));
}

/// Pieces from left to right.
#[derive(Default)]
struct Pieces(Vec<Piece>);

impl Pieces {
    /// Appends [from, to] of a window, if that is not empty, to its last piece where it continues it.
    fn push(&mut self, window: &Window, from: f64, to: f64) {
        if from >= to {
            return;
        }
        match self.0.last_mut() {
            Some(last) if last.window == *window && last.to == from => last.to = to,
            _ => self.0.push(Piece { window: *window, from, to }),
        }
    }
}

/// Shares out the overlap of two windows.
fn contest(pieces: &mut Pieces, old: &Window, new: &Window) {
    let (low, high) = (old.b0.max(new.b0), old.b1.min(new.b1));
    if low >= high {
        return;
    }
    let new_wins = |x: f64| new.distance(x) < old.distance(x);
    let (wins_low, wins_high) = (new_wins(low), new_wins(high));
    let better = |new_is: bool| if new_is { new } else { old };
    if wins_low != wins_high {
        let root = root(&new_wins, low, high);
        pieces.push(better(wins_low), low, root);
        pieces.push(better(wins_high), root, high);
        return;
    }
    // Seen under one angle: (x - s1x) / s1y = (x - s2x) / s2y.
    let stationary = (old.sx * new.sy - new.sx * old.sy) / (new.sy - old.sy);
    if low < stationary && stationary < high && new_wins(stationary) != wins_low {
        let (left, right) = (root(&new_wins, low, stationary), root(&new_wins, stationary, high));
        pieces.push(better(wins_low), low, left);
        pieces.push(better(!wins_low), left, right);
        pieces.push(better(wins_low), right, high);
    } else {
        pieces.push(better(wins_low), low, high);
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
