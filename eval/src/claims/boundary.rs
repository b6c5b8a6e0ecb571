//! The boundary condition.

use super::{Finding, Judged, View, claim};
use crate::ablation::{Ablation, Choice, Figures};

/// C15: on closed surfaces the boundary condition 0 is best.
pub(super) fn zero_is_best(view: &View) -> Judged {
    let ablations = view.evidence.ablations;
    let open: Vec<&Ablation> = ablations.iter().filter(|ablation| ablation.has_boundary).collect();
    let closed = ablations.len() - open.len();
    let judged = if closed == 0 && open.is_empty() {
        ("No model was tried with other boundary conditions.".to_owned(), Finding::CannotTell)
    } else {
        let verdict = if closed > 0 { Finding::Holds } else { Finding::CannotTell };
        let effect =
            format!("On {closed} closed models every condition gives the same, so that 0 is no worse than others. ");
        let (best, compared) = compared(&open);
        let others = format!("With a boundary 0 has the least mean error at Eq. 1 on {best} of {compared} models.");
        (effect + &others, verdict)
    };
    claim(
        "On surfaces without boundary the boundary condition 0 (no heat leaves) is best.",
        "said of the tool, without figures".to_owned(),
        "It holds where closed models were tried: without a boundary the condition enters no equation. Models with a \
         boundary, of which the paper says nothing, are told beside; plain cotangents.",
        judged,
    )
}

/// On how many models with a boundary 0 is no worse than 0.5 and 1, and how many could be compared.
fn compared(open: &[&Ablation]) -> (usize, usize) {
    let mean = |ablation: &Ablation, choice: Choice| {
        let row = ablation.rows.iter().find(|row| row.choice == choice)?;
        let Figures { at_formulas, .. } = row.outcome.as_ref().ok()?;
        Some((*at_formulas.first()?)?.mean)
    };
    let is_best = |ablation: &&Ablation| {
        let zero = mean(ablation, Choice::Paper)?;
        let others: Vec<f64> = [0.5, 1.0].into_iter().filter_map(|b| mean(ablation, Choice::Boundary(b))).collect();
        if others.is_empty() { None } else { Some(others.iter().all(|&other| zero <= other)) }
    };
    let found: Vec<bool> = open.iter().filter_map(is_best).collect();
    (found.iter().filter(|&&is_best| is_best).count(), found.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ablation::{ErrorPair, Row};
    use crate::claims::{Evidence, judge};
    use taut::Laplacian;

    /// The mean errors at Eq. 1 with the boundary conditions 0, 0.5 and 1.
    fn ablation(has_boundary: bool, means: [f64; 3]) -> Ablation {
        let rows = [Choice::Paper, Choice::Boundary(0.5), Choice::Boundary(1.0)].into_iter().zip(means);
        let rows = rows.map(|(choice, mean)| {
            let pair = ErrorPair { mean, median: None };
            Row {
                choice,
                outcome: Ok(Figures { at_best_mean: pair, at_best_median: pair, at_formulas: vec![Some(pair)] }),
            }
        });
        Ablation { model: "m".to_owned(), source: 0, has_boundary, best_t: [1.0; 2], rows: rows.collect() }
    }

    #[test]
    fn closed_models_decide_and_open_ones_are_told() {
        let judged = |ablations: &[Ablation]| {
            let claim = judge(&Evidence { ablations, ..Evidence::default() }, Laplacian::Plain).pop().unwrap();
            (claim.verdict, claim.ours)
        };
        let (closed, open) =
            (ablation(false, [1.0; 3]), [ablation(true, [2.0, 1.0, 3.0]), ablation(true, [1.0, 2.0, 3.0])]);
        let (verdict, ours) = judged(&[closed, open[0].clone(), open[1].clone()]);
        assert_eq!(verdict, Finding::Holds);
        assert!(ours.contains("1 closed") && ours.contains("1 of 2"), "{ours}");
        assert_eq!(judged(&open).0, Finding::CannotTell);
    }
}
