//! Trimming: of the windows on one half-edge, keep at each point the one that gives the least distance.
//!
//! Two windows are equally far where σ₁ + |S₁ - x| = σ₂ + |S₂ - x|. Along the edge the difference of the two sides has
//! at most one stationary point, where both pseudo-sources are seen under the same angle, so its signs at both ends of
//! the overlap and at that point tell every change of sign; each root is then found inside a bracket whose signs are
//! proven, and nothing is left to a failing formula. Parallel rays are seen under one angle everywhere, other rays under
//! each angle once, and so that holds for them too; the difference of two windows of parallel rays is linear.
//!
//! Small overlaps are left alone, because to find where they change hands costs more than it saves, and *crumbs*, windows
//! so narrow that rounding made them, are dropped.
//!
//! n windows cost O(n log n) plus one comparison per overlap; what comes out is sorted.
//!
//! [`Memory`] trims against what crossed the half-edge before. Low triangles need that, as a straight line may wind
//! around two of them very often, and for ever if they have no area; and edges with more than two triangles, at which
//! the windows multiply. Elsewhere the labels of the vertices drop a window soon enough, and nothing is remembered.
//!
//! Reference: Mitchell, Mount, Papadimitriou 1987 (section 3, intervals of optimality).

use super::window::{Rays, Window};

/// Windows that arrived more often than this are trimmed by halves first: where all overlap, as those of many sources in
/// one triangle do, their number is then that of what survives soon, and not squared in time.
const MANY: u32 = 16;

/// Trims the windows of one half-edge, which arrived in so many `runs`, in place; `height` is that of its triangle,
/// `scratch` is overwritten.
pub(crate) fn trim<R: Rays>(windows: &mut Vec<Window<R>>, runs: u32, height: f64, scratch: &mut Scratch<R>) {
    if runs > MANY {
        let mut half = windows.split_off(windows.len() / 2);
        trim(windows, runs / 2, height, scratch);
        trim(&mut half, runs / 2, height, scratch);
        windows.append(&mut half);
    }
    let Scratch { kept, pending } = scratch;
    kept.clear();
    let mut sweep = Sweep { kept, pending, height, run: f64::NEG_INFINITY, end: f64::NEG_INFINITY };
    let begins_before = |a: &Window<R>, b: &Window<R>| a.b0 <= b.b0;
    // They come in two sorted runs at most, one for each side of the triangle before, but for a few.
    let second =
        windows.windows(2).position(|pair| !begins_before(&pair[0], &pair[1])).map_or(windows.len(), |i| i + 1);
    if !windows[second..].is_sorted_by(begins_before) {
        windows.sort_by(|a, b| a.b0.total_cmp(&b.b0));
        windows.iter().for_each(|window| sweep.add_next(window));
    } else {
        let (mut left, mut right) = windows.split_at(second);
        while let (Some(a), Some(b)) = (left.first(), right.first()) {
            let run = if begins_before(a, b) { &mut left } else { &mut right };
            sweep.add_next(&run[0]);
            *run = &run[1..];
        }
        left.iter().chain(right).for_each(|window| sweep.add_next(window));
    }
    while let Some(cut) = sweep.pending.pop() {
        sweep.add(&cut);
    }
    sweep.settle_last();
    std::mem::swap(windows, kept);
}

/// What the ends of an edge tell about the windows on it.
pub(crate) struct Limits {
    /// The labels of the ends.
    pub(crate) at_a: f64,
    pub(crate) at_b: f64,
    /// The length of the edge.
    pub(crate) length: f64,
}

impl Limits {
    /// Whether no path over an end is shorter at each point of the window: by the triangle inequality it is if it is at
    /// the far end of the window.
    pub(crate) fn let_pass<R: Rays>(&self, w: &Window<R>) -> bool {
        let (over_a, over_b) = (self.at_a + w.b1, self.at_b + (self.length - w.b0));
        let reaches = |x: f64, limit: f64| {
            if w.rays.are_parallel() {
                return w.distance(x) <= limit;
            }
            let (dx, left) = (x - w.sx, limit - w.sigma);
            left >= 0.0 && dx * dx + w.sy * w.sy <= left * left
        };
        reaches(w.b1, over_a) && reaches(w.b0, over_b)
    }
}

/// Windows that overlap no more than this share of the narrower one are both kept whole: to find where they change hands
/// takes longer than to let them cross a triangle.
const WORTH_A_CUT: f64 = 0.1;

/// Buffers of [`trim`].
#[derive(Debug, Default)]
pub(crate) struct Scratch<R> {
    /// Sorted.
    kept: Vec<Window<R>>,
    /// Parts that were cut off, the one that begins first at the end.
    pending: Vec<Window<R>>,
}

impl<R> Scratch<R> {
    /// For how many windows memory is taken.
    pub(crate) fn capacity(&self) -> usize {
        self.kept.capacity() + self.pending.capacity()
    }
}

/// Windows from left to right. All but the last that was added are final, so that it is enough to look at that one.
struct Sweep<'a, R> {
    kept: &'a mut Vec<Window<R>>,
    /// Parts that were cut off, the one that begins first at the end.
    pending: &'a mut Vec<Window<R>>,
    height: f64,
    /// Where the dropped neighbours of the next crumb begin, and where the last final window ended.
    run: f64,
    end: f64,
}

impl<R: Rays> Sweep<'_, R> {
    /// Adds a window, and before it what was cut off and begins before it.
    fn add_next(&mut self, window: &Window<R>) {
        while let Some(cut) = self.pending.pop_if(|cut| cut.b0 <= window.b0) {
            self.add(&cut);
        }
        self.add(window);
    }

    /// Adds a window that begins no earlier than any that was added before.
    fn add(&mut self, new: &Window<R>) {
        let Some(old) = self.kept.last_mut() else { return self.kept.push(*new) };
        if old.continues_in(new) {
            old.b1 = larger(old.b1, new.b1);
            return;
        }
        let high = smaller(old.b1, new.b1);
        let narrower = smaller(old.b1 - old.b0, new.b1 - new.b0);
        if high - new.b0 > WORTH_A_CUT * narrower {
            return self.share(*new, high);
        }
        self.settle_last();
        self.kept.push(*new);
    }

    /// Shares out the overlap of the last window and the one that is added. What is cut off behind the first change of
    /// hands waits for its turn: windows may still come before it.
    fn share(&mut self, mut new: Window<R>, high: f64) {
        let Some(old) = self.kept.last_mut() else { return };
        let Duel { is_new_first, root, until } = duel(old, &new, [new.b0, high]);
        let cut = Window { b0: until, ..if is_new_first { new } else { *old } };
        if is_new_first {
            let rest = Window { b0: root, ..*old };
            old.b1 = new.b0;
            self.settle_last();
            new.b1 = root;
            self.kept.push(new);
            self.wait(rest);
        } else {
            old.b1 = root;
            new.b0 = root;
            self.wait(new);
        }
        self.wait(cut);
    }

    /// Lets what was cut off wait for its turn.
    fn wait(&mut self, cut: Window<R>) {
        if cut.b0 < cut.b1 {
            let place = self.pending.iter().rposition(|other| other.b0 >= cut.b0).map_or(0, |i| i + 1);
            self.pending.insert(place, cut);
        }
    }

    /// The last window is final. Drops it if it is empty or a crumb; dropped neighbours count as one.
    fn settle_last(&mut self) {
        let Some(w) = self.kept.last() else { return };
        let end = std::mem::replace(&mut self.end, w.b1);
        // Most windows are far from being a crumb; the root is for the others.
        if w.b1 - w.b0 < 1e-3 * self.height {
            let begin = if w.b0 > end { w.b0 } else { smaller(self.run, w.b0) };
            if is_crumb(w, w.b1 - begin, self.height) {
                self.run = begin;
                self.kept.pop();
                return;
            }
        }
        self.run = w.b1;
    }
}

/// Whether a window, `width` wide with the dropped ones before it, is empty or a *crumb*: so narrow that the path beside it
/// is as short. Where two windows touch, both are equally far and their difference grows only with the square of the way
/// from there, so rounding cuts them into ever more pieces: on bunny they were 1.1 of 2.6 million windows.
///
/// A path over a dropped place bends at the nearest kept one, w away, instead. With r the distance from the edge of the
/// nearer end of its straight piece that makes it longer by w² / r at most, which must be below the rounding of d. Of
/// parallel rays the piece may be as short as w.
fn is_crumb<R: Rays>(w: &Window<R>, width: f64, height: f64) -> bool {
    let distance = w.distance(w.b1);
    let way = if w.rays.are_parallel() { width } else { distance - w.sigma };
    width * width <= ROUNDING * distance * smaller(height, way) || w.b0 >= w.b1
}

/// f64::min and f64::max also look for NaN, which no window has.
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The rounding of a distance, as a share.
const ROUNDING: f64 = 1e-16;

/// In triangles that remember, paths that differ by this share of their length and of the triangle are equal: more than
/// the rounding of a few crossings.
const TIE: f64 = 1e-14;

/// What a path to each point of a half-edge that remembers has cost so far, over it or along its edge.
///
/// Between and beyond the windows that crossed, a path leaves the nearest one at its end and goes on along the edge: a
/// window whose pseudo-source lies there. So the least distances of the points are known to be those of a function that
/// changes no faster than the way along the edge. A ray that comes back to an edge that it has crossed is no shorter than
/// from there along the edge: it is no news, wherever it comes back, and no ray crosses a half-edge twice.
#[derive(Debug, Default)]
pub(crate) struct Memory<R> {
    /// Disjoint and sorted.
    windows: Vec<Window<R>>,
}

impl<R: Rays> Memory<R> {
    /// For how many windows memory is taken.
    pub(crate) fn capacity(&self) -> usize {
        self.windows.capacity()
    }

    /// Keeps of the windows what is shorter than anything remembered by more than rounding, and remembers it. No side of
    /// the triangle is longer than `longest`.
    pub(crate) fn keep_news(
        &mut self,
        windows: &mut Vec<Window<R>>,
        limits: &Limits,
        longest: f64,
        scratch: &mut Scratch<R>,
    ) {
        let Some(&any) = windows.first() else { return };
        let Limits { at_a, at_b, length } = *limits;
        let tie = |distance: f64| TIE * (distance + longest);
        let any = Window { sy: 0.0, rays: R::default(), ..any };
        self.go_right(&Window { b1: 0.0, sx: 0.0, sigma: at_a, ..any }, length, tie(at_a));
        self.go_left(&Window { b0: length, sx: length, sigma: at_b, ..any }, tie(at_b));
        let news = &mut scratch.kept;
        news.clear();
        for window in windows.iter() {
            let tie = tie(window.distance(window.b1));
            insert(&mut self.windows, window, tie, |piece| news.push(piece));
        }
        for window in news.iter() {
            let tie = tie(window.distance(window.b1));
            self.go_left(window, tie);
            self.go_right(window, length, tie);
        }
        std::mem::swap(windows, news);
    }

    /// Remembers the way along the edge from the right end of a window, up to where another is shorter; from there on it
    /// is shorter everywhere.
    fn go_right(&mut self, window: &Window<R>, length: f64, tie: f64) {
        let at = window.b1;
        let along = Window { b0: at, sx: at, sy: 0.0, sigma: window.distance(at), rays: R::default(), ..*window };
        let first = self.windows.partition_point(|old| old.b1 <= at);
        let beyond = self.windows[first..].iter().map(|old| (old, old.b0.max(at)));
        let end = beyond.into_iter().find(|&(old, x)| old.distance(x) <= along.distance(x) + 0.5 * tie);
        let b1 = end.map_or(length, |(_, x)| x);
        insert(&mut self.windows, &Window { b1, ..along }, 0.5 * tie, |_| {});
    }

    /// The same from the left end.
    fn go_left(&mut self, window: &Window<R>, tie: f64) {
        let at = window.b0;
        let along = Window { b1: at, sx: at, sy: 0.0, sigma: window.distance(at), rays: R::default(), ..*window };
        let last = self.windows.partition_point(|old| old.b0 < at);
        let before = self.windows[..last].iter().rev().map(|old| (old, old.b1.min(at)));
        let start = before.into_iter().find(|&(old, x)| old.distance(x) <= along.distance(x) + 0.5 * tie);
        let b0 = start.map_or(0.0, |(_, x)| x);
        insert(&mut self.windows, &Window { b0, ..along }, 0.5 * tie, |_| {});
    }
}

/// Inserts a window into a disjoint sorted list, at the points where it is shorter by more than `tie`; those pieces of
/// it go to `won` as well.
fn insert<R: Rays>(disjoint: &mut Vec<Window<R>>, new: &Window<R>, tie: f64, mut won: impl FnMut(Window<R>)) {
    if new.b0 >= new.b1 {
        return;
    }
    let first = disjoint.partition_point(|old| old.b1 <= new.b0);
    let last = disjoint.partition_point(|old| old.b0 < new.b1);
    let mut pieces = Pieces::default();
    let mut done = new.b0;
    // Neither side changes faster than the way along the edge: who loses by g loses for g / 2 to either side.
    let mut lost = new.b0;
    for old in &disjoint[first..last] {
        pieces.push(old, false, old.b0, old.b1.min(new.b0));
        pieces.push(new, true, done, old.b0.min(new.b1));
        let (low, high) = (old.b0.max(new.b0), old.b1.min(new.b1));
        if lost < high {
            lost = lost.max(low + 0.5 * (new.distance(low) + tie - old.distance(low)));
        }
        if lost >= high {
            pieces.push(old, false, low, high);
        } else {
            contest(&mut pieces, old, new, tie);
        }
        pieces.push(old, false, old.b0.max(new.b1), old.b1);
        done = old.b1.max(done);
    }
    pieces.push(new, true, done, new.b1);
    if pieces.0.iter().any(|piece| piece.is_new) {
        disjoint.splice(first..last, pieces.0.iter().map(|piece| piece.window));
        pieces.0.iter().filter(|piece| piece.is_new).for_each(|piece| won(piece.window));
    }
}

/// A part of a window while two sets of windows are merged.
struct Piece<R> {
    window: Window<R>,
    is_new: bool,
}

/// Pieces from left to right.
#[derive(Default)]
struct Pieces<R>(Vec<Piece<R>>);

impl<R: Rays> Pieces<R> {
    /// Appends [from, to] of a window, if that is not empty; to the last piece where it continues that one.
    fn push(&mut self, window: &Window<R>, is_new: bool, from: f64, to: f64) {
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

/// Shares out the overlap of two windows, if the new one is nearer by more than `tie` somewhere.
fn contest<R: Rays>(pieces: &mut Pieces<R>, old: &Window<R>, new: &Window<R>, tie: f64) {
    let (mut low, high) = (old.b0.max(new.b0), old.b1.min(new.b1));
    let wins = |x: f64| old.distance(x) - new.distance(x) > tie;
    let between = stationary(old, new);
    if !(wins(low) || wins(high) || low < between && between < high && wins(between)) {
        return pieces.push(old, false, low, high);
    }
    while low < high {
        let Duel { is_new_first, root, until } = duel(old, new, [low, high]);
        let [first, second] = if is_new_first { [new, old] } else { [old, new] };
        pieces.push(first, is_new_first, low, root.min(high));
        pieces.push(second, !is_new_first, root, until.min(high));
        low = until;
    }
}

/// Where the difference of two distances is stationary, seen under one angle: (w1 x - s1x) / s1y = (w2 x - s2x) / s2y.
/// Not finite where there is no such place, as between two bundles of parallel rays.
fn stationary<R: Rays>(old: &Window<R>, new: &Window<R>) -> f64 {
    (old.sx * new.sy - new.sx * old.sy) / (old.rays.weight() * new.sy - new.rays.weight() * old.sy)
}

/// Who is nearer along an overlap: one up to the root, and the other from there until some place. Where hands change once
/// that place is the end of the overlap; where they do not change, the root is the end of the winner, and the place +inf.
struct Duel {
    is_new_first: bool,
    root: f64,
    until: f64,
}

#[inline]
fn duel<R: Rays>(old: &Window<R>, new: &Window<R>, [low, high]: [f64; 2]) -> Duel {
    let sample = |x: f64| {
        let far = old.distance(x);
        let gain = far - new.distance(x);
        (x, if gain.abs() <= EQUAL * far { 0.0 } else { gain })
    };
    let (mut first, last) = (sample(low), sample(high));
    let between = stationary(old, new);
    if !differ(first.1, last.1) && low < between && between < high {
        let middle = sample(between);
        if differ(first.1, middle.1) {
            return change(old, new, first, middle);
        }
        if first.1 == 0.0 {
            first = middle;
        }
    }
    if differ(first.1, last.1) {
        return change(old, new, first, last);
    }
    let is_new_first = first.1 > 0.0 || first.1 == 0.0 && last.1 > 0.0;
    Duel { is_new_first, root: if is_new_first { new.b1 } else { old.b1 }, until: f64::INFINITY }
}

/// Distances of one point that differ by this share are the same up to the rounding of the crossings behind. Where the
/// rays of one window graze a vertex that the other comes from, both are equally far along a ray, and their difference
/// grows with the square of the way from there: the sign that rounding gives it there is no change of hands. On bunny
/// such signs cost as many steps of the root finder as all true roots.
const EQUAL: f64 = 1e-15;

/// Whether one gain is positive and the other negative.
fn differ(a: f64, b: f64) -> bool {
    a > 0.0 && b < 0.0 || a < 0.0 && b > 0.0
}

/// The duel of two windows that change hands between two places, each with the gain of the new one there.
fn change<R: Rays>(old: &Window<R>, new: &Window<R>, first: (f64, f64), last: (f64, f64)) -> Duel {
    Duel { is_new_first: first.1 > 0.0, root: crossing(old, new, first, last), until: last.0 }
}

/// Where the gain of the new window over the old one changes its sign, to the rounding of the distances: Newton's steps
/// inside a bracket whose signs are proven, and halves where they lead out of it.
fn crossing<R: Rays>(
    old: &Window<R>,
    new: &Window<R>,
    (mut low, at_low): (f64, f64),
    (mut high, at_high): (f64, f64),
) -> f64 {
    const STEPS: usize = 8;
    let mut x = low + (high - low) * (at_low / (at_low - at_high));
    for step in 0.. {
        if !(x > low && x < high) || step > STEPS {
            x = 0.5 * (low + high);
            if x <= low || x >= high {
                break;
            }
        }
        let far = old.distance(x);
        let gain = far - new.distance(x);
        if gain.abs() <= EQUAL * far {
            break;
        }
        if (gain > 0.0) == (at_low > 0.0) {
            low = x
        } else {
            high = x
        }
        x -= gain / (old.slope(x) - new.slope(x));
    }
    x
}
