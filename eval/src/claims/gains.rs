//! The formulas beside Eq. 1.

use super::{FEWEST_MODELS, Finding, Judged, View, by_share, claim, gain, too_few};
use crate::accuracy::median;
use crate::gain::{Counts, Interval, Over, Verdict};
use crate::names::equation;
use crate::paper::{self, FIGURE_11, Figure, HEADLINES, Places, table5};
use crate::properties::Property;
use crate::study::{LaplacianStudy, Study};
use crate::sweep::Measure;
use taut::{Laplacian, TimeFormula, TimeScale};

/// A formula's error over that of Eq. 1 at the paper's size; `None` where the formula is refused, or was not looked at so.
fn ratio(of: &LaplacianStudy, formula: TimeFormula, measure: Measure, over: Over) -> Option<Interval> {
    of.outcome(formula, TimeScale::Paper)?.ratio(measure, over)
}

/// On how many models a formula is better.
fn tally(models: &[(&Study, &LaplacianStudy)], figure: &Figure, over: Over) -> Counts {
    let verdicts = models.iter().filter_map(|(_, of)| ratio(of, figure.formula, figure.measure, over));
    Counts::of(verdicts.map(|interval| interval.verdict()))
}

fn all(counts: Counts) -> usize {
    counts.better + counts.worse + counts.unsure
}

fn slashes(counts: Counts) -> String {
    match all(counts) {
        0 => "unknown".to_owned(),
        _ => format!("{}/{}/{}", counts.better, counts.worse, counts.unsure),
    }
}

/// Whether a model has the paper's own triangles.
fn is_own(study: &Study) -> bool {
    let [first, ..] = &paper::BASIC;
    let is_first = [Property::Vertices, Property::Sigma]
        .into_iter()
        .all(|property| first.printed(property).agrees(study.properties.value(property)));
    is_first || table5(&study.model).is_some_and(|row| paper::is_own_tessellation(row, &study.properties))
}

/// The geometric mean of what is positive; `None` of nothing.
fn geometric_mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let logarithms: Vec<f64> = values.filter(|value| *value > 0.0 && value.is_finite()).map(f64::ln).collect();
    let mean = logarithms.iter().sum::<f64>() / logarithms.len() as f64;
    if logarithms.is_empty() { None } else { Some(mean.exp()) }
}

/// C5 to C8: on most models the formula is better than Eq. 1.
pub(super) fn formulas(view: &View) -> [Judged; 4] {
    HEADLINES.map(|figure| {
        let (name, error) = (equation(figure.formula), figure.measure.name());
        claim(
            &format!("With {name} the {error} error is less than with Eq. 1 on most models, with 95 % confidence."),
            format!(
                "Figure {}: {} of {} models better/worse/unsure",
                figure.number,
                slashes(figure.counts),
                all(figure.counts)
            ),
            "It holds if the formula is better on more models than worse, and on a share of them that is no more than ten \
             percentage points below the paper's; partly if it is better on more than worse. Both for intervals by \
             vertices and, where there are several sources, by sources: partly too where these two differ.",
            counts(view, &figure),
        )
    })
}

fn counts(view: &View, figure: &Figure) -> (String, Finding) {
    let models = view.models();
    let own: Vec<_> = models.iter().copied().filter(|(study, _)| is_own(study)).collect();
    let [vertices, sources] = [Over::Vertices, Over::Sources].map(|over| tally(&models, figure, over));
    let share = |counts: Counts| counts.better as f64 / all(counts) as f64;
    let judged = |counts: Counts| match counts {
        _ if all(counts) < FEWEST_MODELS => None,
        Counts { better, worse, .. } if better <= worse => Some(Finding::DoesNotHold),
        _ if share(counts) < share(figure.counts) - 0.1 => Some(Finding::HoldsPartly),
        _ => Some(Finding::Holds),
    };
    let Some(by_vertices) = judged(vertices) else { return too_few("models on which it gives a t") };
    let verdict = match judged(sources) {
        Some(by_sources) if by_sources != by_vertices => Finding::HoldsPartly,
        _ => by_vertices,
    };
    let ours = format!(
        "By vertices {} of {} models, by sources {}; on {} of the paper's own tessellations {} and {}; refused on {}.",
        slashes(vertices),
        models.len(),
        slashes(sources),
        own.len(),
        slashes(tally(&own, figure, Over::Vertices)),
        slashes(tally(&own, figure, Over::Sources)),
        models.len() - all(vertices)
    );
    (ours, verdict)
}

/// C9: where it is better, the gain is mostly above 20 to 30 %.
pub(super) fn sizes(view: &View) -> Judged {
    let models = view.models();
    let [_, mean, _, median_error] = &HEADLINES;
    let large = [(mean, 0.2), (median_error, 0.3)].map(|(figure, least)| {
        let all: Vec<Interval> =
            models.iter().filter_map(|(_, of)| ratio(of, figure.formula, figure.measure, Over::Vertices)).collect();
        let better = all.iter().filter(|interval| interval.verdict() == Verdict::Better);
        let above = better.clone().filter(|interval| 1.0 - interval.ratio > least).count();
        let middle = median(all.iter().map(|interval| interval.ratio).collect());
        (figure, least, above, better.count(), all.len(), middle)
    });
    let judged = if large.iter().any(|&(.., all, _)| all < FEWEST_MODELS) {
        too_few("models")
    } else {
        let mostly = large.iter().filter(|&&(_, _, above, better, ..)| 2 * above > better).count();
        let verdict = [Finding::DoesNotHold, Finding::HoldsPartly, Finding::Holds][mostly];
        let sentences = large.map(|(figure, least, above, better, all, middle)| {
            format!(
                "{}: {above} of the {better} models on which it is better gain more than {:.0} %; the median gain over all \
                 {all} is {}.",
                equation(figure.formula),
                100.0 * least,
                gain(middle)
            )
        });
        (sentences.join(" "), verdict)
    };
    claim(
        "Where the formulas are better, the gain is mostly above 20 % (Eq. 3, mean error) and 30 % (Eq. 5, median error).",
        "\"in most cases\" above 20 %, and above 30 %".to_owned(),
        "It holds if more than half of the models on which the formula is better (by vertices) gain so much, for both; \
         partly for one of the two.",
        judged,
    )
}

/// C10: the best t is mostly between Eq. 1 and Eq. 2.
pub(super) fn places(view: &View) -> Judged {
    let place = |of: &LaplacianStudy| {
        let t = |formula| of.outcome(formula, TimeScale::Paper).map(|outcome| outcome.t);
        let (a, b) = (t(TimeFormula::MeanEdge)?, t(TimeFormula::Sigma)?);
        let best = of.sweep.mean.t;
        Some(if best < a.min(b) { 1 } else { 2 * usize::from(best > a.max(b)) })
    };
    let mut found = [0; 3];
    view.models().iter().filter_map(|(_, of)| place(of)).for_each(|place| found[place] += 1);
    let [between, below, above] = found;
    let judged = if found.iter().sum::<usize>() < FEWEST_MODELS {
        too_few("models")
    } else {
        let verdict = match between {
            _ if between > below + above => Finding::Holds,
            _ if between >= below.max(above) => Finding::HoldsPartly,
            _ => Finding::DoesNotHold,
        };
        (format!("Between them {between}, below both {below}, above both {above}."), verdict)
    };
    let Places { between, below, above } = FIGURE_11;
    let models = between + below + above;
    claim(
        "The best t for the mean error is between those of Eq. 1 and Eq. 2 for many models.",
        format!("between them {between}, below both {below}, above both {above} of {models}"),
        "It holds if it is between them on more than half of the models; partly if that is no less frequent than below both \
         and than above both, as with the paper's figures.",
        judged,
    )
}

/// C13: the formulas make the heat method more accurate than before.
pub(super) fn accuracy(view: &View) -> Judged {
    let models = view.models();
    let mean = |formula: TimeFormula| {
        let ratios = models.iter().filter_map(|(_, of)| ratio(of, formula, Measure::Mean, Over::Vertices));
        geometric_mean(ratios.map(|interval| interval.ratio))
    };
    let original = |of: &LaplacianStudy| of.outcome(TimeFormula::MeanEdge, TimeScale::Paper).map(|given| given.mean);
    let of_best = models.iter().filter_map(|(_, of)| Some(of.sweep.mean.error / original(of)?));
    let any_t = geometric_mean(of_best);
    let judged = match (mean(TimeFormula::Sigma), mean(TimeFormula::MeanSigma), any_t) {
        (Some(sigma), Some(both), Some(any_t)) if models.len() >= FEWEST_MODELS => {
            let (best, formula) = if sigma < both { (sigma, "Eq. 2") } else { (both, "Eq. 3") };
            let verdict = match best {
                ..0.9 => Finding::Holds,
                ..1.0 => Finding::HoldsPartly,
                _ => Finding::DoesNotHold,
            };
            let ours = format!(
                "{formula} gains {} over Eq. 1; the best t of each model, if it were known, would gain {}. {}",
                gain(best),
                gain(any_t),
                delaunay(view.evidence.studies)
            );
            (ours, verdict)
        }
        _ => too_few("models"),
    };
    claim(
        "With the new formulas the heat method is more accurate than before.",
        "gain \"usually bigger than 20-30 %\"".to_owned(),
        "Gains in the mean error, geometric means of ratios over all models. It holds if the better of Eq. 2 and Eq. 3 \
         gains more than 10 %; partly if it gains at all.",
        judged,
    )
}

/// What intrinsic Delaunay triangles gain at Eq. 1, told as a sentence.
fn delaunay(studies: &[Study]) -> String {
    let mean = |study: &Study, laplacian| {
        let of = study.laplacians.iter().find(|of| of.laplacian == laplacian)?;
        of.outcome(TimeFormula::MeanEdge, TimeScale::Paper).map(|given| given.mean)
    };
    let ratio = |study| Some(mean(study, Laplacian::Intrinsic)? / mean(study, Laplacian::Plain)?);
    let ratios: Vec<f64> = studies.iter().filter_map(ratio).filter(|ratio| *ratio > 0.0 && ratio.is_finite()).collect();
    let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    geometric_mean(ratios.iter().copied()).map_or(String::new(), |ratio| {
        format!(
            "Intrinsic Delaunay triangles instead of plain cotangents gain {} at the same Eq. 1, and up to {}.",
            gain(ratio),
            gain(least)
        )
    })
}

/// C14: the formulas take edges as they stand.
pub(super) fn units(view: &View) -> Judged {
    let models = view.models();
    let mean = |of: &LaplacianStudy, scale| of.outcome(TimeFormula::Sigma, scale).map(|given| given.mean);
    let known = models.iter().filter_map(|(_, of)| Some((mean(of, TimeScale::Paper)?, mean(of, TimeScale::Raw))));
    let pairs: Vec<(f64, Option<f64>)> = known.collect();
    let is_near = |&(paper, raw): &(f64, Option<f64>)| raw.is_some_and(|raw| (raw / paper).ln().abs() <= 1.1f64.ln());
    let near = pairs.iter().filter(|pair| is_near(pair)).count();
    let ratios: Vec<f64> = pairs.iter().filter_map(|&(paper, raw)| Some(raw? / paper)).filter(|r| *r > 0.0).collect();
    let judged = match geometric_mean(ratios.iter().copied()) {
        Some(factor) if pairs.len() >= FEWEST_MODELS => {
            let most = ratios.iter().copied().fold(0.0, f64::max);
            let refused = pairs.len() - ratios.len();
            let ours = format!(
                "With Eq. 2 in the units of their files {near} of {} models have the error that they have at the paper's \
                 size; it is {factor:.2} times that (geometric mean), at most {most:.1} times, and refused on {refused}.",
                pairs.len()
            );
            (ours, by_share(near as f64 / pairs.len() as f64, 0.9, 0.5))
        }
        _ => too_few("models"),
    };
    claim(
        "Eq. 2 to 5 give t for a mesh as it stands: no word says that they set t, an area, to a length, and so hold in one \
         unit only.",
        "all meshes \"can be inscribed in sphere with constant diameter\", which is not named".to_owned(),
        "It holds, that is, units do not matter, if with Eq. 2 in the units of the files 90 % of the models have the mean \
         error of Eq. 2 at the paper's size to 10 %; partly from half of them on.",
        judged,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::synthetic::{judged, ratios, study};

    /// Six models, the first `changed` of which are changed.
    fn models(changed: usize, change: impl Fn(&mut LaplacianStudy)) -> Vec<Study> {
        let mut studies = vec![study("m"); 6];
        let own = &mut studies[5].properties;
        (own.vertices, own.sigma) = (14290, 0.02505);
        studies[..changed].iter_mut().for_each(|study| change(&mut study.laplacians[0]));
        studies
    }

    /// Sets the ratios of all formulas but Eq. 1.
    fn set(vertices: f64, sources: Option<f64>) -> impl Fn(&mut LaplacianStudy) {
        move |of| {
            for gain in of.formulas.iter_mut().filter(|gain| gain.formula != TimeFormula::MeanEdge) {
                let Ok(outcome) = &mut gain.outcome else { continue };
                outcome.over_vertices = ratios(vertices);
                outcome.over_sources = sources.map(ratios);
            }
        }
    }

    fn verdict(id: &str, studies: &[Study]) -> Finding {
        judged(id, studies, &[]).verdict
    }

    #[test]
    fn formulas_are_counted_as_better_or_worse() {
        for id in ["C5", "C6", "C7", "C8"] {
            assert_eq!(verdict(id, &models(0, set(2.0, None))), Finding::Holds);
            // Two of six are better, four unsure: fewer than the paper's half or more.
            assert_eq!(verdict(id, &models(4, set(1.0, None))), Finding::HoldsPartly);
            assert_eq!(verdict(id, &models(4, set(2.0, Some(2.0)))), Finding::DoesNotHold);
            // Sources say otherwise.
            assert_eq!(verdict(id, &models(6, set(0.5, Some(2.0)))), Finding::HoldsPartly);
            assert_eq!(verdict(id, &models(0, set(2.0, None))[..4]), Finding::CannotTell);
        }
        let ours = judged("C5", &models(2, set(2.0, Some(1.0))), &[]).ours;
        let expected = "By vertices 4/2/0 of 6 models, by sources 4/0/2; on 1 of the paper's own tessellations 1/0/0 and \
                        1/0/0; refused on 0.";
        assert_eq!(ours, expected);
    }

    #[test]
    fn a_refused_formula_is_not_counted() {
        let refuse = |of: &mut LaplacianStudy| {
            of.formulas.iter_mut().for_each(|gain| gain.outcome = Err("equal edges".to_owned()));
        };
        let claim = judged("C5", &models(1, refuse), &[]);
        assert!(claim.ours.contains("By vertices 5/0/0 of 6") && claim.ours.contains("refused on 1"), "{claim:?}");
        assert_eq!(verdict("C5", &models(2, refuse)), Finding::CannotTell);
    }

    #[test]
    fn gains_are_large_or_small() {
        assert_eq!(verdict("C9", &models(0, set(1.0, None))), Finding::Holds);
        assert_eq!(verdict("C9", &models(6, set(0.75, None))), Finding::HoldsPartly);
        assert_eq!(verdict("C9", &models(6, set(0.85, None))), Finding::DoesNotHold);
        assert_eq!(verdict("C9", &models(0, set(1.0, None))[..2]), Finding::CannotTell);
    }

    #[test]
    fn the_best_t_is_between_below_or_above() {
        let at = |t: f64| move |of: &mut LaplacianStudy| of.sweep.mean.t = t;
        assert_eq!(verdict("C10", &models(2, at(0.01))), Finding::Holds);
        assert_eq!(verdict("C10", &models(3, at(0.01))), Finding::HoldsPartly);
        let claim = judged("C10", &models(4, at(1.0)), &[]);
        assert_eq!(
            (claim.verdict, claim.ours.as_str()),
            (Finding::DoesNotHold, "Between them 2, below both 0, above both 4.")
        );
    }

    #[test]
    fn accuracy_is_gained_or_lost_and_delaunay_stands_beside_it() {
        assert_eq!(verdict("C13", &models(0, set(1.0, None))), Finding::Holds);
        assert_eq!(verdict("C13", &models(6, set(0.95, None))), Finding::HoldsPartly);
        assert_eq!(verdict("C13", &models(6, set(1.05, None))), Finding::DoesNotHold);
        let mut studies = models(0, set(1.0, None));
        for study in &mut studies {
            let mut intrinsic = study.laplacians[0].clone();
            intrinsic.laplacian = Laplacian::Intrinsic;
            intrinsic.formulas.iter_mut().for_each(|gain| gain.outcome.as_mut().unwrap().mean *= 0.25);
            study.laplacians.push(intrinsic);
        }
        let ours = judged("C13", &studies, &[]).ours;
        // The best error is 1, that of Eq. 1 is 2.
        assert!(
            ours.contains("gains +40.0 %") && ours.contains("would gain +50.0 %") && ours.contains("gain +75.0 %"),
            "{ours}"
        );
    }

    #[test]
    fn units_matter_or_not() {
        let raw = |factor: f64| {
            move |of: &mut LaplacianStudy| {
                for gain in of.formulas.iter_mut().filter(|gain| gain.scale == TimeScale::Raw) {
                    gain.outcome.as_mut().unwrap().mean *= factor;
                }
            }
        };
        assert_eq!(verdict("C14", &models(6, raw(1.05))), Finding::Holds);
        assert_eq!(verdict("C14", &models(3, raw(10.0))), Finding::HoldsPartly);
        assert_eq!(verdict("C14", &models(4, raw(0.1))), Finding::DoesNotHold);
    }
}
