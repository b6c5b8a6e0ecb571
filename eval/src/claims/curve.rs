//! The error as a function of t.

use super::{FEWEST_MODELS, Finding, Judged, View, by_share, claim, too_few};
use crate::accuracy::median;
use crate::fit::Fit;
use crate::study::LaplacianStudy;
use crate::sweep::{Measure, Point, Sweep};
use taut::{TimeFormula, TimeScale};

/// By how much the error must rise behind a minimum, for it to count as one: noise of the best t is less.
const NOISE: f64 = 0.01;

/// C1: the curve of the mean error has one minimum and looks like |log t|.
pub(super) fn valley(view: &View) -> Judged {
    let models = view.models();
    let shapes: Vec<Shape> = models.iter().filter_map(|(_, of)| Shape::of(&of.sweep)).collect();
    let judged = if models.len() < FEWEST_MODELS || shapes.is_empty() {
        too_few("models")
    } else {
        let single = models.iter().filter(|(_, of)| minima(&of.sweep.points) == 1).count();
        let near = models.iter().filter(|(_, of)| minima(&near_best(&of.sweep)) == 1).count();
        let most = models.iter().map(|(_, of)| minima(&of.sweep.points)).max().unwrap_or(0);
        let middle = |of: fn(&Shape) -> f64| median(shapes.iter().map(of).collect());
        let [left, right] = [middle(|shape| shape.left.slope.value), middle(|shape| shape.right.slope.value)];
        let r_squared = middle(|shape| shape.left.r_squared.min(shape.right.r_squared));
        let is_valley = r_squared >= 0.9 && left < 0.0 && right > 0.0 && (0.5..=2.0).contains(&(-right / left));
        let ours = format!(
            "{single} of {} models have one minimum, none more than {most}; within a decade of the best t {near} have one. Up \
             to the best t the mean error falls by {:.1} percentage points a decade, beyond it it rises by {right:.1}; \
             straight lines explain {:.0} % of that (medians over the models).",
            models.len(),
            -left,
            100.0 * r_squared
        );
        let share = single as f64 / models.len() as f64;
        let verdict = match by_share(share, 0.9, 0.5) {
            Finding::Holds if !is_valley => Finding::HoldsPartly,
            verdict => verdict,
        };
        (ours, verdict)
    };
    claim(
        "The mean error as a function of t looks like |log t|: there is one minimum only, and beyond it the error grows.",
        "Figure 9, on the five meshes of the basic set".to_owned(),
        "A minimum counts where the error rises by more than 1 % behind it. It holds if 90 % of the models have one, and \
         over log t, one decade to either side, straight lines explain 90 % of the variance, with slopes of opposite signs \
         whose ratio is from 1/2 to 2; partly if half of the models have one.",
        judged,
    )
}

/// How many minima there are beyond noise. Where the error falls up to the last t there is none yet.
fn minima(points: &[Point]) -> usize {
    let mut count = 0;
    let mut is_falling = true;
    let mut turn = f64::INFINITY; // the least error since it fell, or the largest since it rose
    for mean in points.iter().map(|point| point.mean) {
        turn = if is_falling { turn.min(mean) } else { turn.max(mean) };
        let has_turned = if is_falling { mean > turn * (1.0 + NOISE) } else { mean < turn / (1.0 + NOISE) };
        if has_turned {
            count += usize::from(is_falling);
            is_falling = !is_falling;
            turn = mean;
        }
    }
    count
}

/// The points at most a decade from the best t.
fn near_best(sweep: &Sweep) -> Vec<Point> {
    let near = sweep.mean.t / 10.0..=10.0 * sweep.mean.t;
    sweep.points.iter().copied().filter(|point| near.contains(&point.t)).collect()
}

/// Lines through the mean error over log₁₀ t, one decade to the left and one to the right of the best t.
struct Shape {
    left: Fit,
    right: Fit,
}

impl Shape {
    fn of(sweep: &Sweep) -> Option<Shape> {
        let best = sweep.mean.t;
        let side = |low: f64, high: f64| {
            let mut spread: Vec<[f64; 2]> = Vec::new();
            for point in sweep.points.iter().filter(|point| (low..=high).contains(&point.t)) {
                let log = point.t.log10();
                // The sweep is dense around the best t, which shall not count for more.
                if spread.last().is_none_or(|last| log - last[0] >= 0.08) {
                    spread.push([log, point.mean]);
                }
            }
            Fit::of(&spread).ok()
        };
        Some(Shape { left: side(best / 10.0, best)?, right: side(best, 10.0 * best)? })
    }
}

/// C12: the maximum t bounds the formulas and can stop a search.
pub(super) fn maximum(view: &View) -> Judged {
    let models = view.models();
    let judged = if models.len() < FEWEST_MODELS {
        too_few("models")
    } else {
        let counts = models.iter().fold(Counts::default(), |counts, (_, of)| counts.and(of));
        let share = |part: usize, whole: usize| part as f64 / whole.max(1) as f64;
        let saves = counts.search_probes < counts.sweep_probes;
        let found = share(counts.same, counts.searches).min(share(counts.below, counts.formulas));
        let verdict = match by_share(found, 0.95, 0.5) {
            Finding::Holds if !saves => Finding::HoldsPartly,
            verdict => verdict,
        };
        let ours = format!(
            "The maximum t is within the range for {} of {} curves. There {} of {} values of the formulas are below it. The \
             search that it stops finds the t of the sweep for {} of {} curves, with {} probes where the sweep takes {}.",
            counts.known,
            counts.searches,
            counts.below,
            counts.formulas,
            counts.same,
            counts.searches,
            counts.search_probes,
            counts.sweep_probes
        );
        (ours, verdict)
    };
    claim(
        "The maximum t, where half of the vertices have three times the least error, is above the best t and above what the \
         formulas give, and can stop an iterative search for the best t.",
        "95 % sure that the best t is below it; no figures".to_owned(),
        "It holds if 95 % of the values of Eq. 2 to 5, each beside the maximum for its error, are below the maximum, and \
         95 % of the searches find the t of the sweep, with fewer probes in all; partly with half of them. That the best t \
         is below it is so by definition.",
        judged,
    )
}

/// Curves, two for each model, and what the maximum t does for them.
#[derive(Default)]
struct Counts {
    searches: usize,
    same: usize,
    known: usize,
    formulas: usize,
    below: usize,
    search_probes: usize,
    sweep_probes: usize,
}

impl Counts {
    /// With one more model.
    fn and(mut self, of: &LaplacianStudy) -> Counts {
        for (measure, search) in Measure::ALL.into_iter().zip(&of.search) {
            let best = of.sweep.best(measure);
            self.searches += 1;
            self.same += usize::from(search.t == best.t);
            self.search_probes += search.probes;
            self.sweep_probes += best.probes;
            let Some(maximum) = best.maximum_t else { continue };
            self.known += 1;
            let formulas = match measure {
                Measure::Mean => [TimeFormula::Sigma, TimeFormula::MeanSigma],
                Measure::Median => [TimeFormula::MedianFit, TimeFormula::MedianMean],
            };
            for given in formulas.into_iter().filter_map(|formula| of.outcome(formula, TimeScale::Paper)) {
                self.formulas += 1;
                self.below += usize::from(given.t < maximum);
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::synthetic::{judged, study};
    use crate::study::Study;

    fn points(errors: &[f64]) -> Vec<Point> {
        let point = |(t, &mean): (u32, &f64)| Point { t: f64::from(t), mean, median: mean };
        (1..).zip(errors).map(point).collect()
    }

    #[test]
    fn minima_beyond_noise_are_counted() {
        for (errors, count) in [
            (&[3.0, 2.0, 1.0, 2.0, 3.0][..], 1),
            (&[3.0, 2.0, 2.01, 1.0, 1.005, 1.0, 2.0], 1),
            (&[3.0, 1.0, 2.0, 1.5, 4.0], 2),
            (&[1.0, 2.0], 1),
            (&[2.0, 1.0], 0),
            (&[], 0),
        ] {
            assert_eq!(minima(&points(errors)), count, "{errors:?}");
        }
    }

    /// Six models, the first `wrong` of which are changed.
    fn models(wrong: usize, change: impl Fn(&mut LaplacianStudy)) -> Vec<Study> {
        let mut studies = vec![study("m"); 6];
        studies[..wrong].iter_mut().for_each(|study| change(&mut study.laplacians[0]));
        studies
    }

    #[test]
    fn a_valley_is_told_from_waves_and_from_bowls() {
        let waves = |of: &mut LaplacianStudy| {
            of.sweep.points.iter_mut().for_each(|point| {
                point.mean += 5.0 * (3.0 * point.t.ln()).sin() + 5.0;
            })
        };
        // Flat on the left, steep on the right.
        let slope = |of: &mut LaplacianStudy| {
            of.sweep.points.iter_mut().for_each(|point| {
                let log = (point.t / 0.1).ln();
                point.mean = 1.0 + if log < 0.0 { -0.05 * log } else { log };
            })
        };
        for (studies, verdict) in [
            (models(0, waves), Finding::Holds),
            (models(3, waves), Finding::HoldsPartly),
            (models(6, waves), Finding::DoesNotHold),
            (models(6, slope), Finding::HoldsPartly),
        ] {
            assert_eq!(judged("C1", &studies, &[]).verdict, verdict);
        }
        assert_eq!(judged("C1", &models(0, waves)[..4], &[]).verdict, Finding::CannotTell);
    }

    #[test]
    fn the_maximum_must_bound_the_formulas_and_the_search_must_find() {
        let low = |of: &mut LaplacianStudy| of.sweep.mean.maximum_t = Some(1e-6);
        let lost = |of: &mut LaplacianStudy| of.search[1].t *= 1.01;
        let slow = |of: &mut LaplacianStudy| of.search[0].probes = 1000;
        for (studies, verdict) in [
            (models(0, low), Finding::Holds),
            (models(6, low), Finding::HoldsPartly),
            (models(1, lost), Finding::HoldsPartly),
            (models(1, slow), Finding::HoldsPartly),
            (models(6, |of| of.search.iter_mut().for_each(|best| best.t = 9.0)), Finding::DoesNotHold),
        ] {
            assert_eq!(judged("C12", &studies, &[]).verdict, verdict);
        }
    }
}
