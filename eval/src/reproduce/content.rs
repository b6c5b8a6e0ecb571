//! The parts of the report: the paper's numbers beside ours.

use super::{Finished, Reproduction, is_own_tessellation};
use crate::ablation::{Ablation, Choice, ErrorPair, Figures, Row};
use crate::claims::{ACCURACY, Claim, Evidence, claims};
use crate::correlate::correlations;
use crate::draws::Drawn;
use crate::fit::Fit;
use crate::names::{FORMULAS, LAPLACIANS, equation};
use crate::paper::{self, BASIC, CORRELATIONS, Printed, SLIPS, TABLES, VERIFICATION};
use crate::properties::Property;
use crate::report::numbers::{fixed, significant};
use crate::report::{self, Beside, Content, CorrelationRow, CorrelationTable, Trend};
use crate::report::{Cell, Table, Tone};
use crate::study::{LEAST_REACHED, Study};
use crate::sweep::Measure;
use crate::tables::best_rows;
use base64::prelude::{BASE64_STANDARD, Engine as _};
use taut::Laplacian;

/// What the report is made from.
pub(super) struct Parts<'a> {
    pub(super) finished: &'a [Finished],
    pub(super) models: &'a [Study],
    /// 1.obj to 5.obj.
    pub(super) basic: &'a [Study],
    /// The set of the seed, and others.
    pub(super) draws: &'a [Drawn],
}

impl<'a> Parts<'a> {
    pub(super) fn content(&self, work: &Reproduction, claims: &'a [Claim], failed: &[(String, String)]) -> Content<'a> {
        Content {
            title: "How good is a time step? The heat method's t, evaluated".to_owned(),
            summary: self.summary() + &in_short(claims),
            claims,
            making: self.making(work, failed),
            basic: self.basic,
            models: self.models,
            properties: self.properties(),
            trends: self.trends(),
            best: self.best(),
            correlations: self.correlations(),
            fits: self.fits(),
            draws: self.drawn(),
            verification: self.verification(),
            why: self.why(),
            pictures: self.pictures(),
            slips: slips(),
        }
    }

    /// The paper's claims, judged.
    pub(super) fn claims(&self) -> Vec<Claim> {
        let ablations: Vec<Ablation> = self.finished.iter().filter_map(|of| of.ablation.clone()).collect();
        claims(&Evidence { studies: self.models, basic: self.basic, draws: self.draws, ablations: &ablations })
    }

    fn summary(&self) -> String {
        let own = self.models.iter().filter(|study| is_own_tessellation(study)).count();
        let basic = match self.basic {
            [] => "The paper's basic set was not made, as its first mesh was not there.".to_owned(),
            _ => "The basic set was made from the paper's first mesh by the paper's recipe.".to_owned(),
        };
        format!(
            "The paper “Wave propagation time optimization for geodesic distances calculation using the Heat Method” (2019) \
             proposes formulas for the time step t of the heat method. Here its evaluation is done again on {} models, of which \
             {own} are meshes of its verification set, triangle by triangle. {basic} Errors are against exact distances. Each result \
             stands for two Laplacians: the plain cotangents of the paper, and those of the intrinsic Delaunay triangulation.",
            self.models.len(),
        )
    }

    fn making(&self, work: &Reproduction, failed: &[(String, String)]) -> Vec<[String; 2]> {
        let super::Options { basic_seed, bootstrap } = work.options;
        let seconds: f64 = self.models.iter().map(|study| study.seconds).sum();
        let vertices: usize = self.models.iter().map(|study| study.properties.vertices).sum();
        let mut facts = vec![
            ["program", &format!("taut {}", env!("CARGO_PKG_VERSION"))].map(str::to_owned),
            ["models".to_owned(), format!("{}, with {vertices} vertices together", self.models.len())],
            ["not counted".to_owned(), self.not_counted()],
            ["seed of the basic set".to_owned(), basic_seed.to_string()],
            [
                "bootstrap".to_owned(),
                format!("{} resamples; {} sources; seed {}", bootstrap.resamples, bootstrap.sources, bootstrap.seed),
            ],
            ["seconds of one thread".to_owned(), format!("{seconds:.0}")],
            [
                "setting".to_owned(),
                "the least distance moved to 0, no heat leaves through boundaries: as the paper's tool".to_owned(),
            ],
        ];
        facts.extend(failed.iter().map(|(model, reason)| [format!("left out: {model}"), reason.clone()]));
        facts
    }

    /// The models whose source reaches too few vertices to say anything.
    fn not_counted(&self) -> String {
        let few = self.finished.iter().map(|of| &of.study).filter(|study| !study.counts());
        let names: Vec<String> = few.map(|study| format!("{} ({})", study.model, study.reached)).collect();
        match names[..] {
            [] => "none".to_owned(),
            _ => format!(
                "models whose source reaches fewer than {LEAST_REACHED} vertices; their numbers are in the tables beside this \
                 page: {}",
                names.join(", ")
            ),
        }
    }

    /// Tables 1 to 4.
    fn properties(&self) -> Vec<Table> {
        let notes = [
            "Vertices, edges, triangles, source and anisotropy. 1.obj is the paper's own mesh; the others are made by its \
             recipe, with other random numbers.",
            "Edge lengths. What the paper calls the median absolute deviation D_e is the mean absolute deviation; the median one \
             is in properties.csv.",
            "Extreme edges and angles.",
            "Quartiles of the edge lengths.",
        ];
        let tables = TABLES.iter().zip(notes).zip(1..);
        tables
            .filter(|_| !self.basic.is_empty())
            .map(|((properties, note), number)| {
                let columns: Vec<(&str, usize)> =
                    properties.iter().map(|&p| (p.symbol(), BASIC[0].printed(p).decimals())).collect();
                let rows = BASIC.iter().zip(self.basic).map(|(paper, ours)| {
                    let row = properties.iter().map(|&p| beside(paper.printed(p), ours.properties.value(p)));
                    (paper.name.to_owned(), row.collect())
                });
                Table::beside(&format!("Table {number}"), note, &columns, &rows.collect::<Vec<_>>())
            })
            .collect()
    }

    /// Figure 5.
    fn trends(&self) -> Vec<Trend> {
        let trend = |property: Property| {
            let ours: Vec<f64> = self.basic.iter().map(|study| study.properties.value(property)).collect();
            let points: Vec<[f64; 2]> = (1..).zip(&ours).map(|(n, &value)| [f64::from(n), value]).collect();
            let paper = BASIC.iter().map(|mesh| mesh.printed(property).value()).collect();
            Some(Trend { property, paper, ours, line: Fit::of(&points).ok()? })
        };
        [Property::Anisotropy, Property::Sigma].into_iter().filter_map(trend).collect()
    }

    /// Tables 6 and 8.
    fn best(&self) -> Vec<Table> {
        let mut tables = Vec::new();
        for (number, measure) in [(6, Measure::Mean), (8, Measure::Median)] {
            let mut groups = vec![(String::new(), 1), ("paper".to_owned(), 2)];
            groups.extend(LAPLACIANS.map(|(name, _)| (name.to_owned(), 2)));
            let rows = BASIC.iter().zip(self.basic).map(|(paper, ours)| {
                let printed = paper.best(measure);
                let mut row: Vec<Cell> = vec![paper.name.into()];
                row.extend([printed.error, printed.t].map(|number| Cell::new(number.to_string(), Tone::Pale)));
                for of in &ours.laplacians {
                    let best = of.sweep.best(measure);
                    row.push(same(printed.error, best.error));
                    row.push(same(printed.t, best.t));
                }
                row
            });
            let rows: Vec<_> = rows.collect();
            if !rows.is_empty() {
                tables.push(Table {
                    title: format!("Table {number}"),
                    note: format!("The least {} error, in percent, and the t that gives it.", measure.name()),
                    groups,
                    head: ["model"]
                        .into_iter()
                        .chain(["error", "t"].into_iter().cycle().take(6))
                        .map(str::to_owned)
                        .collect(),
                    rows,
                });
            }
        }
        tables
    }

    /// Tables 7 and 9.
    fn correlations(&self) -> Vec<CorrelationTable> {
        let mut tables = Vec::new();
        for measure in Measure::ALL {
            for (_, laplacian) in LAPLACIANS {
                let found = correlations(&best_rows(self.basic, laplacian, measure));
                let row = |&(property, printed): &(Property, Printed)| {
                    let ours = found.iter().find(|(other, _)| *other == property).and_then(|(_, of)| of.as_ref().ok());
                    let paper = Some(printed.value());
                    CorrelationRow {
                        property,
                        paper,
                        ours: ours.map(|of| of.r),
                        interval: ours.and_then(|of| of.interval),
                    }
                };
                let rows = CORRELATIONS[measure as usize].iter().map(row).collect();
                tables.push(CorrelationTable { measure, laplacian, rows });
            }
        }
        tables.retain(|_| !self.basic.is_empty());
        tables
    }

    /// The way to Eq. 4.
    fn fits(&self) -> Vec<report::FitFigure> {
        let mut fits = Vec::new();
        for measure in Measure::ALL {
            for (_, laplacian) in LAPLACIANS {
                let rows = best_rows(self.basic, laplacian, measure);
                let ours = rows.iter().map(|(properties, t)| [properties.sigma, *t]).collect();
                let paper = paper::basic_rows(measure).iter().map(|(properties, t)| [properties.sigma, *t]).collect();
                if let Ok(line) = Fit::of_property(Property::Sigma, &rows) {
                    fits.push(report::FitFigure { measure, laplacian, ours, paper, line });
                }
            }
        }
        fits
    }

    /// The basic set drawn again.
    fn drawn(&self) -> Vec<Table> {
        let tables = Measure::ALL.map(|measure| drawn(self.draws, measure));
        tables.into_iter().filter(|table| !table.rows.is_empty()).collect()
    }

    /// Table 5.
    fn verification(&self) -> Vec<Table> {
        let columns: Vec<(&str, usize)> =
            VERIFICATION[0].printed().iter().map(|(p, printed)| (p.symbol(), printed.decimals())).collect();
        let mut rows = Vec::new();
        for paper in &VERIFICATION {
            let named = |study: &&Study| paper::table5(&study.model) == Some(paper);
            for ours in self.finished.iter().map(|of| &of.study).filter(named) {
                let name = match is_own_tessellation(ours) {
                    true => format!("{}, its mesh", paper.name),
                    false => format!("{}, another", paper.name),
                };
                rows.push((
                    name,
                    paper.printed().map(|(p, printed)| beside(printed, ours.properties.value(p))).to_vec(),
                ));
            }
        }
        let note = "Each model of the paper's verification set whose name is here: “its mesh” where all lengths are the paper's to the \
                    printed digits, and the anisotropy to 0.5 % (a few needles make it up, which rounded coordinates change); \
                    “another” where it is another tessellation of the shape, or another shape of that name.";
        if rows.is_empty() { Vec::new() } else { vec![Table::beside("Table 5", note, &columns, &rows)] }
    }

    fn why(&self) -> Vec<Table> {
        self.finished.iter().filter_map(|of| of.ablation.as_ref()).map(ablation).collect()
    }

    fn pictures(&self) -> Vec<report::Picture> {
        let pictures = self.finished.iter().flat_map(|of| of.maps.iter().map(move |map| (&of.study.model, map)));
        let decoded = pictures.filter_map(|(model, map)| {
            let png = BASE64_STANDARD.decode(&map.png).ok()?;
            let (laplacian, formula, mean_error) = (map.laplacian, map.formula, map.mean);
            Some(report::Picture { model: model.clone(), laplacian, formula, mean_error, png })
        });
        decoded.collect()
    }
}

/// What it all comes to, as far as one claim says it.
fn in_short(claims: &[Claim]) -> String {
    let accuracy = claims.iter().find(|claim| claim.id == ACCURACY).map(|claim| &claim.judgements[..]);
    let Some([plain, intrinsic]) = accuracy else { return String::new() };
    let first = intrinsic.ours.split(';').next().unwrap_or_default();
    format!(" In short: with plain cotangents {} With intrinsic Delaunay triangles {first}.", plain.ours)
}

fn beside(printed: Printed, ours: f64) -> Beside {
    Beside { paper: Some(printed.value()), ours: Some(ours).filter(|ours| ours.is_finite()) }
}

/// Our number with the digits of the paper's, marked where it is the same.
fn same(printed: Printed, ours: f64) -> Cell {
    let text = fixed(ours, printed.decimals());
    let is_same = text.parse() == Ok(printed.value());
    Cell::new(text, if is_same { Tone::Good } else { Tone::Plain })
}

/// The errors of one model with each choice.
fn ablation(of: &Ablation) -> Table {
    let pair = |pair: &ErrorPair| [fixed(pair.mean, 5), pair.median.map_or("–".to_owned(), |median| fixed(median, 5))];
    let cells = |figures: &Figures| -> Vec<Cell> {
        let first = [pair(&figures.at_best_mean)[0].clone(), pair(&figures.at_best_median)[1].clone()];
        let formulas = figures.at_formulas.iter();
        let means = formulas.map(|figures| figures.map_or("refused".to_owned(), |pair| significant(pair.mean)));
        first.into_iter().chain(means).map(Cell::from).collect()
    };
    let is_told = |row: &&Row| of.has_boundary || !matches!(row.choice, Choice::Boundary(_));
    let rows = of.rows.iter().filter(is_told).map(|row| {
        let name = Cell::from(row.choice.to_string());
        match &row.outcome {
            Ok(figures) => std::iter::once(name).chain(cells(figures)).collect(),
            Err(reason) => [vec![name, Cell::new(reason.as_str(), Tone::Pale)], vec![Cell::default(); 6]].concat(),
        }
    });
    let [mean, median] = of.best_t.map(significant);
    let head = [format!("mean at {mean}"), format!("median at {median}")];
    let formulas = FORMULAS.map(|(_, formula)| format!("mean, {}", equation(formula)));
    Table {
        title: format!("{}, source {}", of.model, of.source),
        note: format!(
            "One thing is changed at a time from the paper's setting; errors in percent, at the t where that setting has its \
             least mean and its least median error, and with each formula.{}",
            if of.has_boundary { "" } else { " It has no boundary, so that the condition there does nothing." }
        ),
        head: std::iter::once(String::new()).chain(head).chain(formulas).collect(),
        rows: rows.collect(),
        ..Table::default()
    }
}

/// What each draw of the basic set says of one error.
fn drawn(draws: &[Drawn], measure: Measure) -> Table {
    let [errors, r, line] = [4, 4, 3].map(|decimals| move |value: f64| fixed(value, decimals));
    let cells = |of: &Drawn| -> Vec<Cell> {
        let strongest =
            of.strongest.map_or("–".to_owned(), |(property, at)| format!("{} {}", property.symbol(), r(at)));
        let times: Vec<String> = of.times.iter().map(|&t| significant(t)).collect();
        let slope = of.line.map_or("–".to_owned(), |fit| line(fit.slope.value));
        let last = of.errors.last().map_or("–".to_owned(), |&error| errors(error));
        vec![
            times.join(", ").into(),
            last.into(),
            of.sigma.map_or("–".to_owned(), r).into(),
            strongest.into(),
            slope.into(),
        ]
    };
    let row = |seed: u64| {
        let of = |&(_, laplacian): &(&str, Laplacian)| {
            draws.iter().find(|of| of.seed == seed && of.laplacian == laplacian && of.measure == measure)
        };
        let found = LAPLACIANS.iter().flat_map(|laplacian| of(laplacian).map_or(vec![Cell::default(); 5], cells));
        std::iter::once(seed.to_string().into()).chain(found).collect()
    };
    let mut seeds: Vec<u64> = draws.iter().map(|of| of.seed).collect();
    seeds.dedup();
    let columns = ["best t, 1.obj to 5.obj", "least % on 5.obj", "r of σ", "largest |r|", "slope over σ"];
    Table {
        title: format!("The basic set with other random numbers: {} error", measure.name()),
        note: format!(
            "The same recipe with other seeds. The paper's one draw has r = {} for σ; Eq. 4 has the slope {}. What changes from \
             row to row is chance.",
            CORRELATIONS[measure as usize][0].1,
            paper::EQUATION_4[0]
        ),
        groups: std::iter::once((String::new(), 1)).chain(LAPLACIANS.map(|(name, _)| (name.to_owned(), 5))).collect(),
        head: std::iter::once("seed").chain(columns).chain(columns).map(str::to_owned).collect(),
        rows: seeds.into_iter().map(row).collect(),
    }
}

fn slips() -> Vec<Table> {
    let rows = SLIPS.iter().map(|slip| [slip.place, slip.printed, slip.note].map(Cell::from).to_vec());
    vec![Table {
        title: "Numbers and sentences that cannot be right".to_owned(),
        note: "Found by computing the paper's tables from each other.".to_owned(),
        head: ["where", "printed", "why not"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
        ..Table::default()
    }]
}
