//! What formulas gain on meshes that are made here.

use taut::{Control, HeatOptions, Mesh, Shift, TimeFormula, TimeScale, shapes};
use taut_eval::{
    Bootstrap, FORMULAS, FormulaGain, Interval, LAPLACIANS, Model, Outcome, Probe, Ratios, SCALES, Sources, Verdict,
    exact, gains,
};

const BOOTSTRAP: Bootstrap = Bootstrap { resamples: 300, sources: 6, seed: 1 };

/// The paper's plain cotangents.
fn plain() -> HeatOptions {
    HeatOptions { laplacian: LAPLACIANS[0].1, shift: Shift::Min, ..HeatOptions::default() }
}

fn model(mesh: taut::Result<Mesh>) -> Model {
    Model::new("m".to_owned(), mesh.unwrap(), None).unwrap()
}

/// The gains on a model and the sources they are from.
fn gains_on(model: &Model, options: &HeatOptions, bootstrap: &Bootstrap) -> (Vec<FormulaGain>, Vec<u32>) {
    let control = Control::new();
    let exact = exact(model, model.source, &control).unwrap();
    let sources = Sources::new(model, &exact, bootstrap, &control).unwrap();
    (gains(&sources, options, bootstrap, &control).unwrap(), sources.vertices().to_vec())
}

fn intervals(outcome: &Outcome) -> Vec<Interval> {
    let both = |ratios: Ratios| [ratios.mean, ratios.median];
    both(outcome.over_vertices).into_iter().chain(outcome.over_sources.into_iter().flat_map(both)).collect()
}

#[test]
fn each_formula_is_compared_to_eq_1_with_both_laplacians() {
    let model = model(shapes::terrain(24, 0.6).mesh());
    let control = Control::new();
    let exact = exact(&model, model.source, &control).unwrap();
    for (_, laplacian) in LAPLACIANS {
        let options = HeatOptions { laplacian, ..plain() };
        let (gains, sources) = gains_on(&model, &options, &BOOTSTRAP);
        assert_eq!((sources.len(), sources[0]), (6, model.source));

        let choices: Vec<_> = gains.iter().map(|gain| (gain.formula, gain.scale)).collect();
        let of_scale = |i: usize| FORMULAS.iter().skip(i).map(move |formula| (formula.1, SCALES[i].1));
        assert_eq!(choices, of_scale(0).chain(of_scale(1)).collect::<Vec<_>>());

        let outcomes: Vec<Outcome> = gains.iter().map(|gain| gain.outcome.clone().unwrap()).collect();
        for interval in intervals(&outcomes[0]) {
            assert_eq!([interval.ratio, interval.low, interval.high], [1.0; 3]);
            assert_eq!(interval.verdict(), Verdict::Unsure);
        }
        let probe = Probe::new(&model, &exact, &options, &control).unwrap();
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} is not {b}");
        for outcome in &outcomes {
            let errors = probe.errors(outcome.t).unwrap();
            close(outcome.mean, errors.mean_percent);
            close(outcome.median, errors.median_percent);
            close(outcome.over_vertices.mean.ratio, outcome.mean / outcomes[0].mean);
            close(outcome.over_vertices.median.ratio, outcome.median / outcomes[0].median);
            for Interval { ratio, low, high } in intervals(outcome) {
                assert!(low <= ratio && ratio <= high && low > 0.0, "{ratio} in {low}..{high}");
            }
        }
        let ends = |outcome: &Outcome| intervals(outcome).iter().all(|interval| interval.low < interval.high);
        assert!(outcomes[1..].iter().all(ends), "intervals without a length");
    }
}

#[test]
fn equal_sources_have_equal_ratios_and_equal_edges_refuse_sigma() {
    // On an icosahedron every vertex is a source like any other, and there are no more than twelve.
    let bootstrap = Bootstrap { sources: 100, ..BOOTSTRAP };
    let (gains, mut sources) = gains_on(&model(shapes::icosphere(0).mesh()), &plain(), &bootstrap);
    sources.sort_unstable();
    assert_eq!(sources, (0..12).collect::<Vec<_>>());
    for gain in gains {
        match (gain.formula, gain.outcome) {
            (TimeFormula::Sigma | TimeFormula::MedianFit, outcome) => {
                assert!(outcome.unwrap_err().contains("time step"));
            }
            (_, outcome) => {
                let outcome = outcome.unwrap();
                let Ratios { mean, median } = outcome.over_sources.unwrap();
                for (of_sources, of_vertices) in
                    [(mean, outcome.over_vertices.mean), (median, outcome.over_vertices.median)]
                {
                    for end in [of_sources.low, of_sources.high, of_vertices.ratio] {
                        assert!((end / of_sources.ratio - 1.0).abs() < 1e-9, "{of_sources:?} {of_vertices:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn one_source_has_no_interval_over_sources() {
    let model = model(shapes::torus(16, 10, 2.0, 0.7).mesh());
    for sources in [0, 1] {
        let (gains, sources) = gains_on(&model, &plain(), &Bootstrap { sources, ..BOOTSTRAP });
        assert_eq!(sources, [model.source]);
        assert!(gains.iter().all(|gain| gain.outcome.as_ref().unwrap().over_sources.is_none()));
    }
}

#[test]
fn sources_are_where_the_first_one_leads() {
    let sphere = shapes::icosphere(2);
    let n = sphere.positions.len() as u32;
    let far = sphere.positions.iter().map(|p| [p[0] + 5.0, 2.0 * p[1], p[2]]);
    let positions: Vec<[f64; 3]> = far.chain([[0.0; 3]]).chain(sphere.positions.iter().copied()).collect();
    let of_second = sphere.triangles.iter().map(|triangle| triangle.map(|v| v + n + 1));
    let triangles: Vec<[u32; 3]> = sphere.triangles.iter().copied().chain(of_second).collect();
    let model = model(Mesh::from_triangles(&positions, &triangles));
    let (gains, sources) = gains_on(&model, &plain(), &Bootstrap { sources: 40, ..BOOTSTRAP });
    assert_eq!(sources.len(), 40);
    assert!(sources.iter().all(|&v| v < n), "{sources:?}");
    assert!(gains.iter().all(|gain| gain.outcome.is_ok()), "{gains:?}");
}

#[test]
fn a_power_of_two_changes_nothing_at_the_papers_size() {
    let shape = shapes::terrain(9, 0.4);
    let sized = |factor: f64| {
        let positions: Vec<[f64; 3]> = shape.positions.iter().map(|p| p.map(|x| x * factor)).collect();
        gains_on(&model(Mesh::from_triangles(&positions, &shape.triangles)), &plain(), &BOOTSTRAP).0
    };
    let whole = sized(1.0);
    for factor in [2f64.powi(-300), 2f64.powi(300)] {
        for (gain, expected) in sized(factor).iter().zip(&whole).filter(|(gain, _)| gain.scale == TimeScale::Paper) {
            assert_eq!(gain, expected);
        }
    }
    // t is a square, and does not fit a number here.
    for factor in [2f64.powi(-600), 2f64.powi(600)] {
        for gain in sized(factor) {
            let reason = gain.outcome.unwrap_err();
            assert!(reason.contains("time step") || gain.scale == TimeScale::Raw, "{reason}");
        }
    }
}

#[test]
fn too_few_vertices_are_a_reason_and_not_a_number() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.2, 0.7, 0.0]];
    let (gains, _) = gains_on(&model(Mesh::from_triangles(&corners, &[[0, 1, 2]])), &plain(), &BOOTSTRAP);
    assert_eq!(gains.len(), 9);
    assert!(gains.iter().all(|gain| gain.outcome.as_ref().unwrap_err().contains("too few")), "{gains:?}");
}

#[test]
fn gains_survive_a_file() {
    let (gains, _) = gains_on(&model(shapes::icosphere(0).mesh()), &plain(), &BOOTSTRAP);
    assert!(gains.iter().any(|gain| gain.outcome.is_ok()) && gains.iter().any(|gain| gain.outcome.is_err()));
    let text = serde_json::to_string(&gains).unwrap();
    let back: Vec<FormulaGain> = serde_json::from_str(&text).unwrap();
    assert_eq!(back.len(), gains.len());
    assert!(!text.contains("null"), "{text}");
}

#[test]
fn a_seed_makes_the_same_gains() {
    let model = model(shapes::terrain(12, 0.5).mesh());
    let of = |seed| gains_on(&model, &plain(), &Bootstrap { seed, ..BOOTSTRAP });
    assert_eq!(of(1), of(1));
    assert_ne!(of(1).1, of(2).1);
    assert_ne!(of(1).0, of(2).0);
}

#[test]
fn what_makes_no_sense_is_an_error_and_work_can_be_cancelled() {
    let model = model(shapes::icosphere(1).mesh());
    let control = Control::new();
    let exact = exact(&model, model.source, &control).unwrap();
    let short = Sources::new(&model, &exact[1..], &BOOTSTRAP, &control).unwrap_err();
    assert!(short.to_string().contains("41 exact distances"), "{short}");
    let sources = Sources::new(&model, &exact, &BOOTSTRAP, &control).unwrap();
    let none = Bootstrap { resamples: 0, ..BOOTSTRAP };
    assert!(gains(&sources, &plain(), &none, &control).unwrap_err().to_string().contains("resamples"));

    control.cancel();
    assert!(Sources::new(&model, &exact, &BOOTSTRAP, &control).unwrap_err().is_cancelled());
    assert!(gains(&sources, &plain(), &BOOTSTRAP, &control).unwrap_err().is_cancelled());
}
