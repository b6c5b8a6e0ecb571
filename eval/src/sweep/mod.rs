//! The best t: where the mean and where the median error are least, and how large t may be at most.
//!
//! Every t is a number of three significant digits at the paper's size, as the paper gives it. The sweep takes steps of a
//! third over the whole range, of 3 % around the best of these, and then each number of three digits.
//!
//! The *maximum t* of the paper is the least t beyond the best at which at least half of the vertices have three times the
//! least error, that is, at which the median error is three times the least.
//!
//! The *search* goes up from the lowest t in steps of a half, stops where t is beyond the maximum that belongs to the
//! least error so far, and refines as the sweep does.
//!
//! Some 120 factorisations and solves for both errors, a fifth of them for the maximum t; a search for one error takes
//! about 60.
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open
//! Physics 17 (2019), sections 4 and 5.

mod digits;

use crate::error::Result;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// The errors at one t.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// At the paper's size.
    pub t: f64,
    /// The mean error, in percent.
    pub mean: f64,
    /// The median error, in percent.
    pub median: f64,
}

/// Which error is to be least.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Measure {
    /// The mean over the vertices.
    Mean,
    /// The median over the vertices.
    Median,
}

impl Measure {
    /// Both, the paper's order.
    pub const ALL: [Measure; 2] = [Measure::Mean, Measure::Median];

    /// What it is called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Measure::Mean => "mean",
            Measure::Median => "median",
        }
    }
}

impl Point {
    /// The error that is asked for.
    #[must_use]
    pub fn error(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Mean => self.mean,
            Measure::Median => self.median,
        }
    }
}

/// The least error and where it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Best {
    /// At the paper's size.
    pub t: f64,
    /// In percent.
    pub error: f64,
    /// Whether it is at an end of the range, so that there may be a lesser one beyond.
    pub at_end: bool,
    /// The maximum t; `None` where it is beyond the range.
    pub maximum_t: Option<f64>,
    /// How many t were tried for it.
    pub probes: usize,
}

/// A sweep over all t.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// All that were tried, t ascending.
    pub points: Vec<Point>,
    /// For the mean error.
    pub mean: Best,
    /// For the median error.
    pub median: Best,
}

/// The least and the largest t that are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Where sweep and search begin.
    pub low: f64,
    /// Where they end.
    pub high: f64,
}

impl Range {
    /// From ē² / 100 to 1000 ē².
    #[must_use]
    pub fn around(mean_edge: f64) -> Range {
        let middle = mean_edge * mean_edge;
        Range { low: 0.01 * middle, high: 1000.0 * middle }
    }
}

/// How much larger the next t is where nothing is known yet: in a sweep, in a search, and around the best of those.
const SWEEP_STEP: f64 = 4.0 / 3.0;
const SEARCH_STEP: f64 = 1.5;
const FINE_STEP: f64 = 1.03;

/// How often the least error half of the vertices have at the maximum t.
const MAXIMUM: f64 = 3.0;

/// The errors at any t, each found once.
///
/// `probe` tells the errors at t, or nothing where the heat method has no distances at such a t.
pub struct ErrorCurve<P> {
    probe: P,
    /// By the number of t.
    points: BTreeMap<i32, Option<Point>>,
}

impl<P: FnMut(f64) -> Result<Option<Point>>> ErrorCurve<P> {
    /// A curve of which nothing is known yet.
    pub fn new(probe: P) -> ErrorCurve<P> {
        ErrorCurve { probe, points: BTreeMap::new() }
    }

    /// The least errors over a range of t; `None` where there are no errors at any t.
    ///
    /// # Errors
    /// Those of the probe.
    pub fn sweep(&mut self, range: Range) -> Result<Option<Sweep>> {
        let grid = steps(range.low, range.high, SWEEP_STEP);
        let mut bests = Vec::new();
        for measure in Measure::ALL {
            let mut tried = Tried::new(self, measure);
            for &k in &grid {
                tried.at(k)?;
            }
            bests.push(tried.finish()?);
        }
        let points = self.points.values().copied().flatten().collect();
        Ok(match bests[..] {
            [Some(mean), Some(median)] => Some(Sweep { points, mean, median }),
            _ => None,
        })
    }

    /// The same for one error, found by going up until t is beyond its maximum.
    ///
    /// # Errors
    /// Those of the probe.
    pub fn search(&mut self, range: Range, measure: Measure) -> Result<Option<Best>> {
        let mut tried = Tried::new(self, measure);
        for k in steps(range.low, range.high, SEARCH_STEP) {
            let point = tried.at(k)?;
            let (Some(point), Some(best)) = (point, tried.best()) else { continue };
            if point.median >= MAXIMUM * best.1.error(measure) {
                break;
            }
        }
        tried.finish()
    }

    fn at(&mut self, k: i32) -> Result<Option<Point>> {
        if let Some(&known) = self.points.get(&k) {
            return Ok(known);
        }
        let found = (self.probe)(digits::value(k))?;
        self.points.insert(k, found);
        Ok(found)
    }
}

/// The numbers of t from `low` to `high`, each `step` times the one before.
fn steps(low: f64, high: f64, step: f64) -> Vec<i32> {
    let mut numbers: Vec<i32> = std::iter::successors(Some(low), |t| Some(t * step))
        .take_while(|&t| t < high)
        .chain([high])
        .map(digits::nearest)
        .collect();
    numbers.dedup();
    numbers
}

/// What one sweep or search has tried of a curve.
struct Tried<'a, P> {
    curve: &'a mut ErrorCurve<P>,
    measure: Measure,
    numbers: BTreeSet<i32>,
}

impl<'a, P: FnMut(f64) -> Result<Option<Point>>> Tried<'a, P> {
    fn new(curve: &'a mut ErrorCurve<P>, measure: Measure) -> Tried<'a, P> {
        Tried { curve, measure, numbers: BTreeSet::new() }
    }

    fn at(&mut self, k: i32) -> Result<Option<Point>> {
        self.numbers.insert(k);
        self.curve.at(k)
    }

    /// What is known at a number that was tried.
    fn known(&self, k: i32) -> Option<Point> {
        self.curve.points.get(&k).copied().flatten()
    }

    /// The least error so far; of several the one with the least t.
    fn best(&self) -> Option<(i32, Point)> {
        let points = self.numbers.iter().filter_map(|&k| Some((k, self.known(k)?)));
        points.reduce(|best, point| if point.1.error(self.measure) < best.1.error(self.measure) { point } else { best })
    }

    /// The numbers beside one, among those that were tried.
    fn neighbours(&self, k: i32) -> [Option<i32>; 2] {
        [self.numbers.range(..k).next_back().copied(), self.numbers.range(k + 1..).next().copied()]
    }

    /// Refines around the best, and looks for the maximum t.
    fn finish(mut self) -> Result<Option<Best>> {
        let Some((first, _)) = self.best() else { return Ok(None) };
        let [low, high] = self.neighbours(first).map(|k| k.unwrap_or(first));
        for k in steps(digits::value(low), digits::value(high), FINE_STEP) {
            self.at(k)?;
        }
        let Some((second, _)) = self.best() else { return Ok(None) };
        let [low, high] = self.neighbours(second).map(|k| k.unwrap_or(second));
        for k in low..high {
            self.at(k)?;
        }
        let Some((k, point)) = self.best() else { return Ok(None) };
        let at_end = self.neighbours(k).contains(&None);
        let error = point.error(self.measure);
        let maximum_t = self.maximum(k, MAXIMUM * error)?.map(digits::value);
        Ok(Some(Best { t: point.t, error, at_end, maximum_t, probes: self.numbers.len() }))
    }

    /// The number beyond `best` at which the median reaches `enough`, by halving where it does first among those tried.
    fn maximum(&mut self, best: i32, enough: f64) -> Result<Option<i32>> {
        let reaches = |point: Option<Point>| point.is_none_or(|point| point.median >= enough);
        let beyond = self.numbers.range(best + 1..).copied().find(|&k| reaches(self.known(k)));
        let Some(mut high) = beyond else { return Ok(None) };
        let mut low = self.numbers.range(best..high).next_back().copied().unwrap_or(best);
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            *(if reaches(self.at(middle)?) { &mut high } else { &mut low }) = middle;
        }
        Ok(Some(high))
    }
}

impl Sweep {
    /// The best t for one of the errors.
    #[must_use]
    pub fn best(&self, measure: Measure) -> Best {
        match measure {
            Measure::Mean => self.mean,
            Measure::Median => self.median,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors like |log t|: least at `mean` and `median`, where they are 1.
    fn valley(mean: f64, median: f64) -> impl FnMut(f64) -> Result<Option<Point>> {
        move |t| Ok(Some(Point { t, mean: 1.0 + (t / mean).ln().abs(), median: 1.0 + (t / median).ln().abs() }))
    }

    const RANGE: Range = Range { low: 1e-4, high: 10.0 };

    #[test]
    fn the_bottom_of_a_valley_is_found_to_three_digits() {
        for (mean, median) in [(0.0254, 0.0246), (0.1, 0.999), (3.21e-4, 7.77)] {
            let sweep = ErrorCurve::new(valley(mean, median)).sweep(RANGE).unwrap().unwrap();
            assert_eq!((sweep.mean.t, sweep.median.t), (mean, median));
            assert_eq!((sweep.mean.error, sweep.median.error), (1.0, 1.0));
            assert!(!sweep.mean.at_end && !sweep.median.at_end);
            assert!(sweep.points.is_sorted_by(|a, b| a.t < b.t));
        }
    }

    #[test]
    fn at_the_maximum_half_of_the_vertices_have_three_times_the_least_error() {
        let sweep = ErrorCurve::new(valley(0.0254, 0.0246)).sweep(RANGE).unwrap().unwrap();
        // 1 + ln(t / 0.0246) = 3.
        let expected = 0.0246 * 2f64.exp();
        for best in [sweep.mean, sweep.median] {
            let maximum = best.maximum_t.unwrap();
            assert!(maximum >= expected && maximum < 1.01 * expected, "{maximum} {expected}");
        }
        let sweep = ErrorCurve::new(valley(5.0, 5.0)).sweep(RANGE).unwrap().unwrap();
        assert_eq!(sweep.mean.maximum_t, None);
    }

    #[test]
    fn the_search_finds_the_same_with_fewer_probes_and_none_far_beyond_the_maximum() {
        let mut largest = 0.0f64;
        let mut errors = valley(0.0254, 0.0246);
        let mut curve = ErrorCurve::new(|t| {
            largest = largest.max(t);
            errors(t)
        });
        let found = Measure::ALL.map(|measure| curve.search(RANGE, measure).unwrap().unwrap());
        drop(curve);
        let sweep = ErrorCurve::new(valley(0.0254, 0.0246)).sweep(RANGE).unwrap().unwrap();
        for (search, sweep) in found.into_iter().zip([sweep.mean, sweep.median]) {
            assert_eq!((search.t, search.error, search.maximum_t), (sweep.t, sweep.error, sweep.maximum_t));
            assert!(search.probes < sweep.probes, "{} {}", search.probes, sweep.probes);
        }
        // A step beyond the maximum that belongs to the least error of its steps, which is not quite the least.
        assert!(largest <= SEARCH_STEP * SEARCH_STEP * found[0].maximum_t.unwrap(), "{largest}");
    }

    #[test]
    fn an_end_of_the_range_is_told() {
        for (bottom, at_end) in [(1e-9, 1e-4), (1e9, 10.0)] {
            let sweep = ErrorCurve::new(valley(bottom, bottom)).sweep(RANGE).unwrap().unwrap();
            assert!(sweep.mean.at_end && sweep.median.at_end);
            assert_eq!(sweep.mean.t, at_end);
        }
    }

    #[test]
    fn each_t_is_probed_once_and_holes_are_left_out() {
        let mut seen = BTreeSet::new();
        let mut errors = valley(0.0254, 0.0246);
        let mut curve = ErrorCurve::new(|t: f64| {
            assert!(seen.insert(t.to_bits()), "{t} twice");
            if t > 1.0 { Ok(None) } else { errors(t) }
        });
        let sweep = curve.sweep(RANGE).unwrap().unwrap();
        assert_eq!(curve.search(RANGE, Measure::Mean).unwrap().unwrap().t, 0.0254);
        assert_eq!(sweep.mean.t, 0.0254);
        assert!(sweep.points.iter().all(|point| point.t <= 1.0));
        assert_eq!(ErrorCurve::new(|_| Ok(None)).sweep(RANGE).unwrap(), None);
        assert_eq!(ErrorCurve::new(|_| Ok(None)).search(RANGE, Measure::Median).unwrap(), None);
    }

    #[test]
    fn what_a_probe_fails_with_comes_out() {
        let fail = |_| Err(crate::Error::Input("no".to_owned()));
        assert_eq!(ErrorCurve::new(fail).sweep(RANGE).unwrap_err().to_string(), "no");
    }
}
