//! Studies made up: plausible numbers of no mesh.

use taut::{Laplacian, TimeFormula, TimeScale};
use taut_eval::report::{Beside, Content, CorrelationRow, CorrelationTable, FitFigure, Picture, Table, Trend};
use taut_eval::{
    Best, Claim, FORMULAS, Finding, Fit, FormulaGain, Interval, Judgement, LAPLACIANS, LaplacianStudy, Measure,
    ModelProperties, Outcome, Point, Property, Ratios, SCALES, Study, Sweep,
};

/// Numbers in [0, 1) that look like chance: a Weyl sequence, squared to the middle.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

fn properties(chance: &mut Chance, mean_edge: f64, sigma: f64) -> ModelProperties {
    let vertices = chance.within(3.0, 11.5).exp() as usize;
    ModelProperties {
        scale: 10f64.powf(chance.within(-2.0, 2.0)),
        vertices,
        edges: 3 * vertices,
        faces: 2 * vertices,
        source: 0,
        anisotropy: Some(chance.within(1.05, 3.3)),
        mean_edge,
        variance: sigma * sigma,
        sigma,
        mean_absolute_deviation: 0.78 * sigma,
        median_absolute_deviation: 0.62 * sigma,
        min_edge: 0.1 * mean_edge,
        max_edge: 6.0 * mean_edge,
        edge_ratio: 1.0 / 60.0,
        min_angle: chance.within(0.001, 30.0),
        max_angle: chance.within(95.0, 179.99),
        q1: 0.8 * mean_edge,
        q2: 0.97 * mean_edge,
        q3: 1.2 * mean_edge,
        quartile_deviation: 0.2 * mean_edge,
    }
}

/// A valley like |log t|.
fn sweep(chance: &mut Chance, best: f64, least: f64) -> Sweep {
    let error = |t: f64| least * (1.0 + 0.9 * (t / best).ln().abs().powf(1.3));
    let point = |t: f64| Point { t, mean: error(t), median: 0.7 * error(1.1 * t) };
    let mut points: Vec<Point> = (-40..60).map(|i| point(best * 1.16f64.powi(i))).collect();
    points.iter_mut().for_each(|point| point.mean *= chance.within(1.0, 1.02));
    let maximum_t = Some(best * 8.0).filter(|_| chance.next() > 0.1);
    let best = Best { t: best, error: least, at_end: chance.next() < 0.05, maximum_t, probes: 74 };
    Sweep { points, mean: best, median: Best { t: 0.9 * best.t, error: 0.7 * least, ..best } }
}

fn interval(chance: &mut Chance, ratio: f64, width: f64) -> Interval {
    Interval { ratio, low: ratio - width * chance.within(0.5, 1.2), high: ratio + width * chance.within(0.5, 1.2) }
}

fn outcome(chance: &mut Chance, t: f64, least: f64, ratio: f64) -> Outcome {
    let mut ratios =
        |width| Ratios { mean: interval(chance, ratio, width), median: interval(chance, 0.95 * ratio, 1.3 * width) };
    let (over_vertices, over_sources) = (ratios(0.02), Some(ratios(0.15)));
    Outcome { t, mean: 2.0 * least * ratio, median: 1.5 * least * ratio, over_vertices, over_sources }
}

fn formula(
    chance: &mut Chance,
    p: &ModelProperties,
    least: f64,
    formula: TimeFormula,
    scale: TimeScale,
) -> FormulaGain {
    let unit = if scale == TimeScale::Paper { 1.0 } else { p.scale };
    let original = p.mean_edge * p.mean_edge;
    let t = match formula {
        TimeFormula::MeanEdge => original,
        TimeFormula::Sigma | TimeFormula::MedianFit => p.sigma * unit,
        TimeFormula::MeanSigma | TimeFormula::MedianMean => 0.5 * (original + p.sigma * unit),
    };
    let spread = (t / original).ln().abs();
    let ratio = if formula == TimeFormula::MeanEdge {
        1.0
    } else {
        (chance.within(0.45, 1.5) + if scale == TimeScale::Paper { 0.0 } else { 0.4 * spread * spread }).max(0.4)
    };
    let ratio = if chance.next() < 0.03 { 4.0 * ratio } else { ratio };
    let outcome = match t {
        t if t < 1e-6 * original => Err(format!("t = {t} is too small")),
        _ => Ok(outcome(chance, t, least, ratio)),
    };
    FormulaGain { formula, scale, outcome }
}

pub(crate) fn study(name: &str, seed: u64) -> Study {
    let mut chance = Chance(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    chance.next();
    let mean_edge = chance.within(0.05, 0.9);
    let variation = chance.within(0.1, 1.2);
    let properties = properties(&mut chance, mean_edge, variation * mean_edge);
    let original = mean_edge * mean_edge;
    let laplacians = LAPLACIANS.map(|(_, laplacian)| {
        let least = chance.within(-0.7, 1.5).exp() * if laplacian == Laplacian::Plain { 1.6 } else { 1.0 };
        let best = original * chance.within(-1.0, 2.0).exp();
        let sweep = sweep(&mut chance, best, least);
        let all = SCALES.iter().flat_map(|&(_, scale)| FORMULAS.iter().map(move |&(_, formula)| (formula, scale)));
        let formulas =
            all.map(|(formula, scale)| self::formula(&mut chance, &properties, least, formula, scale)).collect();
        let search = Measure::ALL.map(|measure| Best { probes: 51, ..sweep.best(measure) });
        LaplacianStudy { laplacian, sweep, search, formulas }
    });
    Study {
        model: name.to_owned(),
        properties,
        reached: 1000,
        sources: vec![0, 7],
        laplacians: laplacians.to_vec(),
        seconds: 12.5,
    }
}

pub(crate) const MODELS: [&str; 70] = [
    "suzanne",
    "helmet_genus3",
    "paper_fandisk2",
    "plane_grid",
    "beetle_lowres_nm",
    "bumpy",
    "sub_nm",
    "boeing_soup",
    "head_open",
    "cheburashka_sub",
    "klingon_starship",
    "many_small_holes",
    "blobby_shuffled",
    "bones_26cc",
    "truck_nm",
    "triceratops_slivers",
    "cow_nm_vertex",
    "teapot",
    "knot1_genus1",
    "office_chair_bad",
    "threeholes_genus3",
    "anchor_dense",
    "bunny10k_unref",
    "b9_mesh_47cc",
    "mech_holes_shark",
    "paper_homer",
    "twirl_genus1",
    "hero_soup",
    "louvre_cad",
    "fandisk",
    "genus3",
    "cylinder_locally_refined",
    "tvb_face_surface",
    "paper_camel",
    "max_planck",
    "cup_genus2",
    "rocker_arm",
    "camelhead_open",
    "mannequin_devil",
    "fertility",
    "1",
    "2",
    "3",
    "4",
    "5",
    "armadillo_uniform",
    "ankylosaurus",
    "elephant",
    "bimba",
    "pizza_genus73",
    "mountain_terrain",
    "gargoyle",
    "dilo",
    "soccerball_genus31",
    "teapot_genus2",
    "bunny_stanford_unref",
    "botijo_genus5",
    "rangemap_lato180",
    "cube_40k_nm",
    "nefertiti",
    "lucy",
    "seahorse_genus8",
    "dragon_nm",
    "lion_100k",
    "sketched_brunnen",
    "turbineblade",
    "tvb_cortex",
    "igea",
    "igea_x4",
    "a_model_with_a_name_that_is_much_too_long",
];

pub(crate) fn models() -> Vec<Study> {
    (1..).zip(MODELS).map(|(seed, name)| study(name, seed)).collect()
}

pub(crate) fn basic() -> Vec<Study> {
    (1..=5).map(|n| study(&format!("{n}.obj"), 100 + n)).collect()
}

/// A PNG of one pixel.
const PNG: [u8; 67] = [
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 1, 0, 0, 0, 1, 8, 6, 0, 0, 0, 31, 21, 196,
    137, 0, 0, 0, 10, 73, 68, 65, 84, 120, 156, 99, 0, 1, 0, 0, 5, 0, 1, 13, 10, 45, 180, 0, 0, 0, 0, 73, 69, 78, 68,
    174, 66, 96, 130,
];

fn claim(id: &str, text: &str, paper: &str, ours: &str, finding: Finding) -> Claim {
    let rule = "It holds if nine tenths of the models do so, and partly if half of them do.".to_owned();
    let [id, text, paper] = [id, text, paper].map(str::to_owned);
    let judgements = LAPLACIANS.map(|(_, laplacian)| Judgement { laplacian, ours: ours.to_owned(), finding });
    Claim { id, text, paper, rule, judgements: judgements.into() }
}

pub(crate) fn claims() -> Vec<Claim> {
    vec![
        claim("C1", "On 1.obj the least mean error is at t = 0.0254.", "0.53031 %", "0.53031 %", Finding::Holds),
        claim(
            "C2",
            "The least mean error grows from 1.obj to 5.obj.",
            "0.530 to 0.922 %",
            "0.530 to 0.871 %",
            Finding::Holds,
        ),
        claim(
            "C3",
            "Of all properties the standard deviation of the edge lengths correlates most with the best t.",
            "0.9593 and 0.9113. From its tables: mean error: σ_e 0.9593, next Var(e) 0.9501; median error: max_e 0.9267, next \
             σ_e 0.9114",
            "mean error: σ_e 0.9412, its interval [0.34, 1.00] holds 14 others; median error: max_e 0.9267, next σ_e 0.9114, \
             its interval holds 15 others.",
            Finding::HoldsPartly,
        ),
        claim(
            "C4",
            "Eq. 2 is better than Eq. 1 on most models.",
            "21 of 35 better, 10 worse",
            "By vertices 31 / 34 / 5 of 70 models, by sources 20 / 22 / 28; on the paper's own five tessellations 3 / 1 / 1.",
            Finding::DoesNotHold,
        ),
        claim(
            "C5",
            "There is one minimum only.",
            "said of all curves",
            "70 of 70 with plain cotangents",
            Finding::Holds,
        ),
        claim(
            "C6",
            "95 % of the best t are below the maximum t.",
            "not shown",
            "defined so that it is always",
            Finding::CannotTell,
        ),
    ]
}

fn beside() -> Vec<Table> {
    let number = |paper, ours| Beside { paper: Some(paper), ours: Some(ours) };
    let rows = [
        ("1.obj".to_owned(), vec![number(0.53031, 0.530_312), number(0.0254, 0.0254)]),
        ("2.obj".to_owned(), vec![number(0.60318, 0.599_871), number(0.0361, 0.0357)]),
        ("3.obj".to_owned(), vec![number(0.7676, 0.7012), Beside { paper: Some(0.0486), ours: None }]),
    ];
    vec![Table::beside(
        "Table 6. Least mean error",
        "Marked: the same to every printed digit.",
        &[("least mean error, %", 5), ("t", 4)],
        &rows,
    )]
}

fn correlations() -> Vec<CorrelationTable> {
    let mut all = Vec::new();
    for measure in Measure::ALL {
        for (_, laplacian) in LAPLACIANS {
            let rows = Property::ALL.into_iter().enumerate().map(|(i, property)| {
                let ours = Some(0.97 - 0.1 * i as f64).filter(|_| property != Property::MinEdge);
                let interval = ours.map(|r| [(r - 0.5f64).max(-1.0), (r + 0.3f64).min(1.0)]);
                CorrelationRow { property, paper: Some(0.95 - 0.105 * i as f64), ours, interval }
            });
            all.push(CorrelationTable { measure, laplacian, rows: rows.collect() });
        }
    }
    all
}

fn fits() -> Vec<FitFigure> {
    let sigma = [0.02505, 0.03904, 0.05155, 0.06813, 0.07287];
    let [ours, paper] = [[0.0246, 0.0351, 0.0521, 0.0719, 0.068], [0.0246, 0.0365, 0.0553, 0.0815, 0.0613]];
    let points = |t: [f64; 5]| sigma.into_iter().zip(t).map(|(x, y)| [x, y]).collect::<Vec<_>>();
    let line = Fit::of(&points(ours)).unwrap();
    let both = |measure| {
        LAPLACIANS.map(|(_, laplacian)| FitFigure {
            measure,
            laplacian,
            ours: points(ours),
            paper: points(paper),
            line,
        })
    };
    Measure::ALL.into_iter().flat_map(both).collect()
}

pub(crate) fn content<'a>(basic: &'a [Study], models: &'a [Study], claims: &'a [Claim]) -> Content<'a> {
    let trend = |property, paper: [f64; 5]| {
        let ours = paper.map(|value| 1.01 * value);
        let line = Fit::of(&[0, 1, 2, 3, 4].map(|k| [k as f64, ours[k]])).unwrap();
        Trend { property, paper: paper.to_vec(), ours: ours.to_vec(), line }
    };
    let table = |title: &str| Table {
        title: title.to_owned(),
        note: "What the boundary, the shift and the error's definition do.".to_owned(),
        head: ["model", "as in the paper", "without shift", "remark"].map(str::to_owned).to_vec(),
        rows: vec![vec!["camel".into(), "3.41".into(), "3.57".into(), "the shift moves the source".into()]],
        ..Table::default()
    };
    Content {
        title: "Does a better time step make the heat method better?".to_owned(),
        summary: "The paper proposes formulas for the time step t of the heat method and reports gains of 20 to 30 % over t = ē². \
                  Here all of it is computed again, on 70 models, with the paper's cotangents and with intrinsic Delaunay ones."
            .to_owned(),
        claims,
        making: [["version", "taut 0.1.0"], ["seed", "7"], ["models", "70"], ["time", "5 h 12 min of one thread"]].map(|fact| fact.map(str::to_owned)).to_vec(),
        basic,
        models,
        properties: beside(),
        trends: vec![
            trend(Property::Anisotropy, [1.079, 1.137, 1.208, 1.296, 1.349]),
            trend(Property::Sigma, [0.02505, 0.03904, 0.05155, 0.06813, 0.07287]),
        ],
        best: beside(),
        correlations: correlations(),
        fits: fits(),
        draws: vec![table("Drawn again")],
        verification: beside(),
        why: vec![table("The steps of the paper's tool, one by one")],
        pictures: LAPLACIANS
            .into_iter()
            .flat_map(|(_, laplacian)| FORMULAS[..3].iter().map(move |&(_, formula)| Picture { model: "paper_camel".to_owned(), laplacian, formula, mean_error: 3.412, png: PNG.to_vec() }))
            .collect(),
        slips: vec![table("Numbers that cannot be")],
    }
}
