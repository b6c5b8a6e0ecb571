//! What the paper claims, and what becomes of it: every verdict is computed from figures by a rule that is told with it.
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open
//! Physics 17 (2019).

mod basic;
mod boundary;
mod curve;
mod gains;
#[cfg(test)]
mod synthetic;

use crate::ablation::Ablation;
use crate::draws::Drawn;
use crate::names::{self, LAPLACIANS};
use crate::study::{LaplacianStudy, Study};
use crate::sweep::Measure;
use serde::Serialize;
use taut::Laplacian;

/// The claim that all of it serves: more accuracy.
pub(crate) const ACCURACY: &str = "C13";

/// What becomes of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Finding {
    /// It is so.
    Holds,
    /// A part of it is so, or it is so in some cases.
    HoldsPartly,
    /// It is not so.
    DoesNotHold,
    /// What there is does not tell.
    CannotTell,
}

/// A claim of the paper, judged with each Laplacian.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// `C1` to `C15`, in the paper's order.
    pub id: String,
    /// What is claimed, in our words.
    pub text: String,
    /// The paper's figures.
    pub paper: String,
    /// By which rule it is judged.
    pub rule: String,
    /// What becomes of it with each Laplacian, the paper's first.
    pub judgements: Vec<Judgement>,
}

/// What becomes of a claim with one Laplacian.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Judgement {
    /// Which.
    #[serde(with = "names::laplacian")]
    pub laplacian: Laplacian,
    /// Our figures.
    pub ours: String,
    /// What they say.
    pub finding: Finding,
}

/// What the claims are judged by.
#[derive(Debug, Clone, Copy, Default)]
pub struct Evidence<'a> {
    /// All models that formulas are tried on; the paper has the basic set among its 35.
    pub studies: &'a [Study],
    /// The basic set, 1.obj first.
    pub basic: &'a [Study],
    /// The basic set drawn again and again.
    pub draws: &'a [Drawn],
    /// Models with one choice changed at a time, plain cotangents.
    pub ablations: &'a [Ablation],
}

/// The paper's claims, judged.
#[must_use]
pub fn claims(evidence: &Evidence) -> Vec<Claim> {
    let mut claims: Vec<Claim> = Vec::new();
    for (_, laplacian) in LAPLACIANS {
        for (i, Judged { id, text, paper, rule, ours, verdict }) in judge(evidence, laplacian).into_iter().enumerate() {
            if i == claims.len() {
                claims.push(Claim { id, text, paper, rule, judgements: Vec::new() });
            }
            claims[i].judgements.push(Judgement { laplacian, ours, finding: verdict });
        }
    }
    claims
}

/// A claim judged with one Laplacian.
#[cfg_attr(test, derive(Debug))]
struct Judged {
    id: String,
    text: String,
    paper: String,
    ours: String,
    verdict: Finding,
    rule: String,
}

/// The claims judged with one Laplacian.
fn judge(evidence: &Evidence, laplacian: Laplacian) -> Vec<Judged> {
    let view = View { evidence, laplacian };
    let mut claims =
        vec![curve::valley(&view), basic::errors_grow(&view), basic::sigma(&view), basic::regression(&view)];
    claims.extend(gains::formulas(&view));
    claims.extend([
        gains::sizes(&view),
        gains::places(&view),
        basic::trends(&view),
        curve::maximum(&view),
        gains::accuracy(&view),
        gains::units(&view),
        boundary::zero_is_best(&view),
    ]);
    let ids = (1..).map(|number| format!("C{number}"));
    claims.into_iter().zip(ids).map(|(claim, id)| Judged { id, ..claim }).collect()
}

/// A claim; its number comes later.
fn claim(text: &str, paper: String, rule: &str, (ours, verdict): (String, Finding)) -> Judged {
    Judged { id: String::new(), text: text.to_owned(), paper, ours, verdict, rule: rule.to_owned() }
}

/// Where nothing can be said, and why.
fn too_few(what: &str) -> (String, Finding) {
    (format!("There are too few {what}."), Finding::CannotTell)
}

/// With fewer models than this no share of them is judged.
const FEWEST_MODELS: usize = 5;

/// The finding for a share: `holds` of the models or more, at least `partly`, or fewer.
fn by_share(share: f64, holds: f64, partly: f64) -> Finding {
    if share >= holds {
        Finding::Holds
    } else if share >= partly {
        Finding::HoldsPartly
    } else {
        Finding::DoesNotHold
    }
}

/// The evidence with one Laplacian.
struct View<'a> {
    evidence: &'a Evidence<'a>,
    laplacian: Laplacian,
}

impl<'a> View<'a> {
    fn models(&self) -> Vec<(&'a Study, &'a LaplacianStudy)> {
        with(self.evidence.studies, self.laplacian)
    }

    fn basic(&self) -> Vec<(&'a Study, &'a LaplacianStudy)> {
        with(self.evidence.basic, self.laplacian)
    }

    fn draws(&self, measure: Measure) -> Vec<&'a Drawn> {
        let draws = self.evidence.draws.iter();
        draws.filter(|drawn| drawn.laplacian == self.laplacian && drawn.measure == measure).collect()
    }
}

/// The studies that have a Laplacian, and what it gives.
fn with(studies: &[Study], laplacian: Laplacian) -> Vec<(&Study, &LaplacianStudy)> {
    studies.iter().filter_map(|study| Some((study, study.with(laplacian)?))).collect()
}

/// Numbers with commas between.
fn list(numbers: impl IntoIterator<Item = f64>, decimals: usize) -> String {
    let texts: Vec<String> = numbers.into_iter().map(|number| format!("{number:.decimals$}")).collect();
    texts.join(", ")
}

/// A ratio of errors as a gain, with its sign.
fn gain(ratio: f64) -> String {
    let tenths = (1000.0 * (1.0 - ratio)).round() + 0.0; // no -0
    format!("{:+.1} %", tenths / 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_tells_nothing() {
        for laplacian in [Laplacian::Plain, Laplacian::Intrinsic] {
            let claims = judge(&Evidence::default(), laplacian);
            assert_eq!(claims.len(), 15);
            for (number, claim) in (1..).zip(&claims) {
                assert_eq!(claim.id, format!("C{number}"));
                assert_eq!(claim.verdict, Finding::CannotTell, "{claim:?}");
                assert!(!claim.text.is_empty() && !claim.rule.is_empty() && !claim.paper.is_empty(), "{claim:?}");
            }
        }
    }

    #[test]
    fn each_laplacian_is_judged_by_its_own_figures() {
        let mut studies = vec![synthetic::study("m"); 6];
        for study in &mut studies {
            let mut intrinsic = study.laplacians[0].clone();
            intrinsic.laplacian = Laplacian::Intrinsic;
            intrinsic.sweep.mean.t = 10.0; // above both formulas
            study.laplacians.push(intrinsic);
        }
        let evidence = Evidence { studies: &studies, ..Evidence::default() };
        let verdict = |laplacian| judge(&evidence, laplacian)[9].verdict;
        assert_eq!(verdict(Laplacian::Plain), Finding::Holds);
        assert_eq!(verdict(Laplacian::Intrinsic), Finding::DoesNotHold);
    }

    #[test]
    fn no_figure_is_missing_in_a_sentence() {
        let studies = vec![synthetic::study("m"); 6];
        let evidence = Evidence { studies: &studies, basic: &synthetic::basic(), ..Evidence::default() };
        for claim in judge(&evidence, Laplacian::Plain) {
            let text = format!("{} {} {} {}", claim.text, claim.paper, claim.ours, claim.rule);
            assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        }
    }
}
