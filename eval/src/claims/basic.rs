//! The basic set: what the least errors, the best t and the properties do along it.

use super::{Finding, Judged, View, claim, list, too_few};
use crate::correlate::correlations;
use crate::draws::Drawn;
use crate::fit::{Coefficient, Fit};
use crate::paper::{BASIC, EQUATION_4, basic_rows};
use crate::properties::{ModelProperties, Property};
use crate::study::Study;
use crate::sweep::Measure;

/// With fewer meshes neither trends nor correlations are judged.
const FEWEST_MESHES: usize = 4;

/// C2: the least mean error grows along the set, the best t does not grow with it.
pub(super) fn errors_grow(view: &View) -> Judged {
    let basic = view.basic();
    let errors: Vec<f64> = basic.iter().map(|(_, of)| of.sweep.mean.error).collect();
    let times: Vec<f64> = basic.iter().map(|(_, of)| of.sweep.mean.t).collect();
    let judged = if basic.len() < FEWEST_MESHES {
        too_few("meshes in the basic set")
    } else {
        let grows = |values: &[f64]| values.is_sorted_by(|a, b| a < b);
        let verdict = match (grows(&errors), !grows(&times)) {
            (true, true) => Finding::Holds,
            (false, false) => Finding::DoesNotHold,
            _ => Finding::HoldsPartly,
        };
        let ours = format!("Least mean errors {} %, best t {}.", list(errors, 5), list(times, 4));
        let draws = view.draws(Measure::Mean);
        let [errors_grow, t_grows] = [
            draws.iter().filter(|drawn| grows(&drawn.errors)).count(),
            draws.iter().filter(|drawn| grows(&drawn.times)).count(),
        ];
        let n = draws.len();
        let over =
            || format!(" Over {n} draws of the set the error grows at each step in {errors_grow}, t in {t_grows}.");
        (ours + &if n == 0 { String::new() } else { over() }, verdict)
    };
    claim(
        "Along the basic set the least mean error grows, but the best t does not grow with it: it falls from 4.obj to 5.obj.",
        format!(
            "{} %; t {}",
            list(BASIC.iter().map(|mesh| mesh.best(Measure::Mean).error.value()), 5),
            list(BASIC.iter().map(|mesh| mesh.best(Measure::Mean).t.value()), 4)
        ),
        "It holds if the error grows at each step and t does not; partly if one of the two is so.",
        judged,
    )
}

/// C3: σ has the strongest correlation with the best t.
pub(super) fn sigma(view: &View) -> Judged {
    let basic = view.basic();
    let found: Vec<Strongest> = Measure::ALL
        .into_iter()
        .filter_map(|measure| {
            let rows = basic.iter().map(|(study, of)| (&study.properties, of.sweep.best(measure).t));
            Strongest::of(measure, &rows.collect::<Vec<_>>())
        })
        .collect();
    let judged = if found.len() < Measure::ALL.len() {
        too_few("meshes in the basic set")
    } else {
        let first = found.iter().filter(|found| found.stronger.is_empty()).count();
        let is_told_apart = found.iter().all(|found| found.alike == 0);
        let verdict = match first {
            2 if is_told_apart => Finding::Holds,
            0 => Finding::DoesNotHold,
            _ => Finding::HoldsPartly,
        };
        (sentences(&found) + &Measure::ALL.map(|measure| drawn_sigma(view, measure)).concat(), verdict)
    };
    let printed = Measure::ALL.into_iter().filter_map(|measure| {
        let rows = basic_rows(measure);
        Strongest::of(measure, &rows.each_ref().map(|(properties, t)| (properties, *t)))
    });
    claim(
        "Of all properties the standard deviation σ of the edge lengths has the strongest correlation with the best t.",
        format!("0.9593 and 0.9113. From its tables: {}", sentences(&printed.collect::<Vec<_>>())),
        "It holds if σ has the largest |r| for both errors and no other property's |r| is in the 95 % interval (Fisher) of \
         that of σ; partly if it has the largest |r| for one error or cannot be told apart from others.",
        judged,
    )
}

/// How r of σ moves when the set is drawn again.
fn drawn_sigma(view: &View, measure: Measure) -> String {
    let draws = view.draws(measure);
    let is_sigma = |drawn: &&&Drawn| drawn.strongest.is_some_and(|(property, _)| property == Property::Sigma);
    let first = draws.iter().filter(is_sigma).count();
    let r = range(draws.iter().filter_map(|drawn| drawn.sigma));
    r.map_or(String::new(), |[low, high]| {
        let n = draws.len();
        format!(
            " Over {n} draws of the set, {} error: r = {low:.2} to {high:.2}, the strongest in {first}.",
            measure.name()
        )
    })
}

/// The least and the largest; `None` where there is none.
fn range(values: impl Iterator<Item = f64> + Clone) -> Option<[f64; 2]> {
    Some([values.clone().reduce(f64::min)?, values.reduce(f64::max)?])
}

/// How σ stands among the properties.
struct Strongest {
    measure: Measure,
    r: f64,
    /// Of |r|.
    interval: [f64; 2],
    /// Properties with a larger |r|.
    stronger: Vec<Property>,
    /// Properties whose |r| is in the interval.
    alike: usize,
    others: usize,
}

impl Strongest {
    /// `None` where there are too few rows for an interval, or σ or t does not vary.
    fn of(measure: Measure, rows: &[(&ModelProperties, f64)]) -> Option<Strongest> {
        let table = correlations(rows);
        let known = || table.iter().filter_map(|(property, found)| Some((*property, found.ok()?)));
        let (_, sigma) = known().find(|(property, _)| *property == Property::Sigma)?;
        let [low, high] = sigma.interval?;
        let [low, high] = if sigma.r < 0.0 { [-high, -low] } else { [low, high] };
        let interval = [low.max(0.0), high];
        let others = || known().filter(|(property, _)| *property != Property::Sigma);
        let size = |r: f64| r.abs();
        Some(Strongest {
            measure,
            r: sigma.r,
            interval,
            stronger: others()
                .filter(|(_, other)| size(other.r) > size(sigma.r))
                .map(|(property, _)| property)
                .collect(),
            alike: others().filter(|(_, other)| (interval[0]..=interval[1]).contains(&size(other.r))).count(),
            others: others().count(),
        })
    }

    fn sentence(&self) -> String {
        let Strongest { measure, r, interval: [low, high], stronger, alike, others } = self;
        let stronger: Vec<&str> = stronger.iter().map(|property| property.symbol()).collect();
        let rank =
            if stronger.is_empty() { "the strongest".to_owned() } else { format!("behind {}", stronger.join(", ")) };
        let error = measure.name();
        format!(
            "{error} error: r = {r:.4}, {rank}; 95 % interval of |r| {low:.2} to {high:.2}, in which {alike} of {others} \
             others are."
        )
    }
}

fn sentences(found: &[Strongest]) -> String {
    found.iter().map(Strongest::sentence).collect::<Vec<String>>().join(" ")
}

/// C4: Eq. 4 is the regression of the best t for the median error on σ.
pub(super) fn regression(view: &View) -> Judged {
    let basic = view.basic();
    let rows: Vec<_> = basic.iter().map(|(study, of)| (&study.properties, of.sweep.median.t)).collect();
    let [factor, constant] = EQUATION_4.map(|number| number.value());
    let judged = match Fit::of_property(Property::Sigma, &rows) {
        Ok(fit) if rows.len() >= FEWEST_MESHES => {
            let [low, high] = fit.slope.interval;
            let verdict = match (low..=high).contains(&factor) {
                true if high - low <= factor => Finding::Holds,
                true => Finding::HoldsPartly,
                false => Finding::DoesNotHold,
            };
            let draws = view.draws(Measure::Median);
            let slopes = range(draws.iter().filter_map(|drawn| Some(drawn.line?.slope.value)));
            let over = slopes.map_or(String::new(), |[low, high]| {
                format!(" Over {} draws of the set the slope is {low:.2} to {high:.2}.", draws.len())
            });
            (format!("{}.{over}", sloped(&fit)), verdict)
        }
        _ => too_few("meshes in the basic set"),
    };
    let rows = basic_rows(Measure::Median);
    let recomputed = Fit::of_property(Property::Sigma, &rows.each_ref().map(|(properties, t)| (properties, *t)));
    claim(
        "The best t for the median error is proportional to σ: Eq. 4 is its linear regression.",
        format!("t = {factor} σ {constant:+}; from its tables {}", recomputed.as_ref().map_or(String::new(), sloped)),
        "It holds if the 95 % confidence interval of our slope holds the paper's and is no wider than that is large; partly \
         if it is wider.",
        judged,
    )
}

/// t as a function of σ.
fn sloped(fit: &Fit) -> String {
    let Coefficient { value: slope, interval: [low, high], .. } = fit.slope;
    let (constant, share) = (fit.intercept.value, 100.0 * fit.r_squared);
    format!("t = {slope:.5} σ {constant:+.5}, slope {low:.2} to {high:.2} with 95 % confidence, R² {share:.0} %")
}

/// C11: anisotropy and σ grow linearly with the removed vertices.
pub(super) fn trends(view: &View) -> Judged {
    let basic = view.evidence.basic;
    let removed = |vertices: f64, first: f64| 100.0 * (1.0 - vertices / first);
    let ours = |property: Property| {
        let first = basic.first().map_or(f64::NAN, |study| study.properties.vertices as f64);
        let point =
            |study: &Study| [removed(study.properties.vertices as f64, first), study.properties.value(property)];
        Fit::of(&basic.iter().map(point).collect::<Vec<[f64; 2]>>())
    };
    let judged = match (ours(Property::Anisotropy), ours(Property::Sigma)) {
        (Ok(g), Ok(sigma)) if basic.len() >= FEWEST_MESHES => {
            let rises = g.slope.value > 0.0 && sigma.slope.value > 0.0;
            let least = g.r_squared.min(sigma.r_squared);
            let verdict = match (rises, least) {
                (true, 0.95..) => Finding::Holds,
                (true, 0.8..) => Finding::HoldsPartly,
                _ => Finding::DoesNotHold,
            };
            let ours = format!(
                "A line explains {:.1} % of the variance of g and {:.1} % of that of σ; they grow by {:.4} and {:.5} for \
                 each percent of the vertices.",
                100.0 * g.r_squared,
                100.0 * sigma.r_squared,
                g.slope.value,
                sigma.slope.value
            );
            (ours, verdict)
        }
        _ => too_few("meshes in the basic set"),
    };
    let printed = |property| {
        let value = |mesh: usize, property| BASIC[mesh].printed(property).value();
        let point =
            |mesh| [removed(value(mesh, Property::Vertices), value(0, Property::Vertices)), value(mesh, property)];
        Fit::of(&[0, 1, 2, 3, 4].map(point)).map_or(0.0, |fit| 100.0 * fit.r_squared)
    };
    claim(
        "Along the basic set the anisotropy g and the standard deviation σ of the edges grow linearly.",
        format!(
            "Figure 5; in its Tables 1 and 2 lines explain {:.1} % of the variance of g and {:.1} % of that of σ",
            printed(Property::Anisotropy),
            printed(Property::Sigma)
        ),
        "Over the share of removed vertices. It holds if both grow and a line explains 95 % of both; partly from 80 % on.",
        judged,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::synthetic::{basic, judged};

    /// The basic set with one thing changed in each mesh, by its place.
    fn changed(change: impl Fn(usize, &mut Study)) -> Vec<Study> {
        let mut studies = basic();
        studies.iter_mut().enumerate().for_each(|(place, study)| change(place, study));
        studies
    }

    fn verdict(id: &str, basic: &[Study]) -> Finding {
        judged(id, &[], basic).verdict
    }

    #[test]
    fn errors_grow_and_t_does_not() {
        let steady = changed(|place, study| study.laplacians[0].sweep.mean.t = place as f64);
        let flat = |mut studies: Vec<Study>| {
            studies.iter_mut().for_each(|study| study.laplacians[0].sweep.mean.error = 1.0);
            studies
        };
        assert_eq!(verdict("C2", &basic()), Finding::Holds);
        assert_eq!(verdict("C2", &steady), Finding::HoldsPartly);
        assert_eq!(verdict("C2", &flat(basic())), Finding::HoldsPartly);
        assert_eq!(verdict("C2", &flat(steady)), Finding::DoesNotHold);
        assert_eq!(verdict("C2", &basic()[..3]), Finding::CannotTell);
    }

    #[test]
    fn sigma_is_told_apart_or_not() {
        // On the paper's numbers it is the strongest, but five points do not tell it from the others.
        let claim = judged("C3", &[], &basic());
        assert_eq!(claim.verdict, Finding::HoldsPartly);
        assert!(claim.ours.contains("r = 0.9594, the strongest; 95 % interval of |r| 0.50 to 1.00"), "{}", claim.ours);
        assert!(
            claim.paper.contains("r = 0.9594, the strongest; 95 % interval of |r| 0.50 to 1.00, in which 16 of 16")
        );
        // t follows σ closely and nothing else varies as it does.
        let alone = changed(|place, study| {
            let p = &mut study.properties;
            p.anisotropy = Some([1.0, 3.0, 1.0, 3.0, 1.0][place]);
            (p.vertices, p.variance) = (10 + place % 2, 1.0);
            let t = p.sigma + [0.0, 1e-6, -1e-6, 0.0, 1e-6][place];
            (study.laplacians[0].sweep.mean.t, study.laplacians[0].sweep.median.t) = (t, t);
        });
        assert_eq!(verdict("C3", &alone), Finding::Holds);
        let other = changed(|_, study| {
            let t = study.properties.vertices as f64;
            (study.laplacians[0].sweep.mean.t, study.laplacians[0].sweep.median.t) = (t, t);
        });
        assert_eq!(verdict("C3", &other), Finding::DoesNotHold);
        assert_eq!(verdict("C3", &changed(|_, study| study.laplacians[0].sweep.mean.t = 1.0)), Finding::CannotTell);
    }

    #[test]
    fn the_slope_is_the_paper_s_or_not() {
        let sloped = |slope: f64, noise: f64| {
            changed(|place, study| {
                let off = noise * [1.0, -1.0, 0.0, 1.0, -1.0][place];
                study.laplacians[0].sweep.median.t = slope * study.properties.sigma + off;
            })
        };
        let claim = judged("C4", &[], &basic());
        assert_eq!(claim.verdict, Finding::HoldsPartly);
        assert!(
            claim.ours.contains("1.01214 σ -0.00011, slope 0.17")
                && claim.paper.contains("1.01214 σ -0.00011, slope 0.17"),
            "{claim:?}"
        );
        assert_eq!(verdict("C4", &sloped(1.012, 1e-4)), Finding::Holds);
        assert_eq!(verdict("C4", &sloped(2.0, 1e-4)), Finding::DoesNotHold);
        assert_eq!(verdict("C4", &sloped(0.0, 0.0)), Finding::CannotTell);
    }

    #[test]
    fn trends_are_lines_or_not() {
        let bent = |by: f64| {
            changed(|place, study| {
                study.properties.sigma = place as f64 + by * [1.0, -1.0, 0.0, 1.0, -1.0][place];
            })
        };
        assert_eq!(verdict("C11", &basic()), Finding::Holds);
        assert_eq!(verdict("C11", &bent(0.5)), Finding::HoldsPartly);
        assert_eq!(verdict("C11", &bent(2.0)), Finding::DoesNotHold);
        assert_eq!(verdict("C11", &changed(|_, study| study.properties.anisotropy = None)), Finding::CannotTell);
    }
}
