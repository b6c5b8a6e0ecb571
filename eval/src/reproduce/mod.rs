//! The paper's evaluation on all meshes of a folder: one report, and what it was made from.
//!
//! Each model's results are a file of their own in the folder `work` of the output, named by what they depend on: mesh,
//! source, name, bootstrap and version. So work that was interrupted goes on where it was, meshes that are added cost only
//! themselves, and a file that does not fit, or was cut short, is as none. Files that nothing asks for any more stay.
//!
//! Each file is written whole or not at all; so two that work in one folder at once do all of it twice, but break nothing.

mod content;
mod files;
mod output;
mod plan;

use crate::ablation::{Ablation, ablation};
use crate::accuracy::percents;
use crate::draws::{self, Drawn};
use crate::error::{Error, Result};
use crate::gain::{Bootstrap, FormulaGain, Sources};
use crate::model::Model;
use crate::names::{self, LAPLACIANS};
use crate::paper;
use crate::probe::{self, Probe, setting};
use crate::study::Study;
use crate::sweep::Measure;
use base64::prelude::{BASE64_STANDARD, Engine as _};
pub use files::mesh_files;
use files::{folder, read_json, safe, to_json, write};
use plan::{Job, Plan, hex, side_by_side};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::time::Instant;
use taut::{Control, Laplacian, Mesh, Reason, TimeFormula, TimeScale};

/// How an evaluation is done.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Options {
    /// Makes the basic set.
    pub basic_seed: u64,
    /// How sure the gains are.
    pub bootstrap: Bootstrap,
}

/// Draws the errors of several fields on one surface, each as a PNG file, all with the same colours and view: of the mesh,
/// its source, the exact distances, and the errors in percent.
pub type Draw<'a> = dyn Fn(&Mesh, u32, &[f64], &[Vec<f64>]) -> std::result::Result<Vec<Vec<u8>>, String> + Sync + 'a;

/// Is told how the work goes, by several threads.
pub trait Observer: Sync {
    /// There are so many models; of so many the results are there already, and nothing is told of these any more but their
    /// share in all.
    fn planned(&self, models: usize, done_before: usize);
    /// A model is begun.
    fn begun(&self, model: &str);
    /// This share of all work is done, in addition; they sum up to 1, but where the work is cancelled.
    fn advanced(&self, share: f64);
    /// A model is done; `failure` is what it failed with. Not told where the work is cancelled.
    fn finished(&self, model: &str, failure: Option<&str>);
}

/// What there is to do, and with what.
pub struct Reproduction<'a> {
    /// The folder of the meshes.
    pub meshes: &'a Path,
    /// The folder of the report.
    pub out: &'a Path,
    /// How it is done.
    pub options: Options,
    /// How many models are studied at once.
    pub threads: usize,
    /// Draws the errors.
    pub draw: &'a Draw<'a>,
    /// Is told how it goes.
    pub observer: &'a dyn Observer,
    /// Cancels it.
    pub control: &'a Control,
}

/// All about one model, as it is kept in the folder `work`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Finished {
    /// What it depends on.
    key: String,
    basic: Option<usize>,
    study: Study,
    ablation: Option<Ablation>,
    maps: Vec<ErrorMap>,
}

/// A picture of the errors of one field.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct ErrorMap {
    #[serde(with = "names::laplacian")]
    pub(crate) laplacian: Laplacian,
    #[serde(with = "names::formula")]
    pub(crate) formula: TimeFormula,
    /// The mean error, in percent.
    pub(crate) mean: f64,
    /// A PNG file, in base64.
    pub(crate) png: String,
}

/// What became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// The report.
    pub report: PathBuf,
    /// How many models are in it.
    pub models: usize,
    /// The models that are not, and why.
    pub failed: Vec<(String, String)>,
}

/// Studies all meshes of a folder and writes `report.html`, `data.json`, tables as CSV and the meshes of the basic set.
///
/// The same meshes, options and version give the same files, but for the seconds in them: whatever the number of threads,
/// and however often the work was interrupted.
///
/// # Errors
/// [`Error::File`] where a folder cannot be read or a file not be written; [`Error::Input`] where there is no mesh at all;
/// [`Error::Model`] if the work is cancelled or its time is over. What is finished by then is kept, and the next call goes
/// on from there. A model that fails is no failure of the whole; the report tells it.
pub fn reproduce(work: &Reproduction) -> Result<Summary> {
    let Plan { jobs, mut failed } = Plan::of(work.meshes, work.options.basic_seed, work.threads, work.control)?;
    folder(&work.out.join(WORK))?;
    let first = jobs.iter().find(|job| job.basic == Some(1));
    let drawn = first.map_or(0, |first| DRAWS * first.vertices);
    let total = (jobs.iter().map(|job| job.vertices).sum::<usize>() + drawn).max(1) as f64;
    let share = |job: &Job| job.vertices as f64 / total;

    let kept: Vec<Option<Finished>> = jobs.iter().map(|job| work.kept(job)).collect();
    let (before, left): (Vec<_>, Vec<_>) = jobs.iter().zip(&kept).partition(|(_, kept)| kept.is_some());
    work.observer.planned(jobs.len(), before.len());
    work.observer.advanced(before.iter().map(|(job, _)| share(job)).sum());

    let results = side_by_side(&left, work.threads, |&(job, _)| {
        let progress = Progress { observer: work.observer, share: share(job), told: Cell::new(0.0) };
        work.finish(job, &progress)
    })?;
    let mut finished: Vec<Finished> = kept.iter().flatten().cloned().collect();
    for (&(job, _), result) in left.iter().zip(results) {
        match result {
            Ok(model) => finished.push(model),
            Err(reason) => failed.push((job.name.clone(), reason)),
        }
    }
    finished.sort_by(|a, b| a.study.model.cmp(&b.study.model));
    let draws = match first {
        Some(first) => work.draws(first, &finished, drawn as f64 / total, &mut failed)?,
        None => Vec::new(),
    };
    output::write_all(work, &jobs, &finished, &draws, failed)
}

/// How often the basic set is drawn again.
const DRAWS: usize = 9;

const WORK: &str = "work";

/// How far one model is.
struct Progress<'a> {
    observer: &'a dyn Observer,
    /// What it is of all the work.
    share: f64,
    /// How much of it was told, from 0 to 1.
    told: Cell<f64>,
}

impl Progress<'_> {
    fn at(&self, done: f64) {
        self.observer.advanced(self.share * (done - self.told.replace(done)));
    }
}

/// Whether an error is the end of all work, and not only of a model.
fn ends_all(error: &Error) -> bool {
    match error {
        Error::File { .. } => true,
        Error::Model { error, .. } => matches!(error.reason(), Reason::Cancelled | Reason::TimeLimit),
        Error::Input(_) => false,
    }
}

impl Reproduction<'_> {
    /// What a model's results depend on: the mesh, its source and name, the bootstrap and this program's version. The seed
    /// of the basic set is in its meshes.
    fn key(&self, job: &Job) -> String {
        let Job { name, basic, fingerprint, .. } = job;
        let bootstrap = self.options.bootstrap;
        hex(&Sha256::digest(format!("{} {bootstrap:?} {basic:?} {fingerprint} {name}", env!("CARGO_PKG_VERSION"))))
    }

    /// Where a model's results are kept.
    fn file(&self, job: &Job) -> PathBuf {
        self.out.join(WORK).join(format!("{}-{:.16}.json", safe(&job.name), self.key(job)))
    }

    /// The results of one model, if they are there.
    fn kept(&self, job: &Job) -> Option<Finished> {
        read_json::<Finished>(&self.file(job)).filter(|kept| kept.key == self.key(job))
    }

    /// The results of one model, or why there are none, told to the observer.
    ///
    /// # Errors
    /// What ends all work.
    fn finish(&self, job: &Job, progress: &Progress) -> Result<std::result::Result<Finished, String>> {
        self.observer.begun(&job.name);
        let result = match self.study(job, progress).and_then(|finished| self.keep(job, finished)) {
            Err(error) if ends_all(&error) => return Err(error),
            result => result.map_err(|error| error.to_string()),
        };
        progress.at(1.0);
        self.observer.finished(&job.name, result.as_ref().err().map(String::as_str));
        Ok(result)
    }

    fn study(&self, job: &Job, progress: &Progress) -> Result<Finished> {
        let start = Instant::now();
        let model = job.model()?;
        let exact = probe::exact(&model, model.source, self.control)?;
        let sources = Sources::new(&model, &exact, &self.options.bootstrap, self.control)?;
        progress.at(0.2);
        let laplacians = LAPLACIANS.map(|(_, laplacian)| laplacian);
        let gains = Some((&sources, &self.options.bootstrap));
        let done = |done| progress.at(0.2 + 0.7 * done);
        let mut study = Study::new(&model, &exact, &laplacians, gains, self.control, &done)?;
        let is_named = job.basic.is_some() || paper::table5(&job.name).is_some();
        let is_papers = job.basic.is_some() || is_own_tessellation(&study);
        let ablation = match study.with(Laplacian::Plain).filter(|_| is_named) {
            Some(of) => {
                Some(ablation(&model, &exact, Measure::ALL.map(|measure| of.sweep.best(measure).t), self.control)?)
            }
            None => None,
        };
        let maps = self.maps(&model, &exact, &study, is_papers)?;
        study.seconds = start.elapsed().as_secs_f64();
        Ok(Finished { key: self.key(job), basic: job.basic, study, ablation, maps })
    }

    /// Writes a model's results, if they can be read back: JSON has no infinite numbers.
    fn keep(&self, job: &Job, finished: Finished) -> Result<Finished> {
        let json = to_json(&finished)?;
        match serde_json::from_slice::<Finished>(&json) {
            Ok(back) if back == finished => write(&self.file(job), &json).map(|()| finished),
            _ => Err(Error::Input(format!("{}: some of its results are not finite", job.name))),
        }
    }

    /// The basic set of `first` with other random numbers, all together `share` of the work; beside the set of the seed itself.
    /// What cannot be made is `failed`.
    fn draws(
        &self,
        first: &Job,
        finished: &[Finished],
        share: f64,
        failed: &mut Vec<(String, String)>,
    ) -> Result<Vec<Drawn>> {
        let mut basic: Vec<&Finished> = finished.iter().filter(|of| of.basic.is_some()).collect();
        basic.sort_by_key(|of| of.basic);
        let Some(best) = basic.first().filter(|of| of.basic == Some(1)) else { return Ok(Vec::new()) };
        let (model, seed) = (first.model()?, self.options.basic_seed);
        let seeds: Vec<u64> = (1..=DRAWS as u64).map(|k| seed.wrapping_add(k)).collect();
        let others = side_by_side(&seeds, self.threads, |&seed| {
            let drawn = match self.drawn(first, &model, &best.study, seed) {
                Err(error) if ends_all(&error) => return Err(error),
                drawn => drawn.map_err(|error| (set_name(seed), error.to_string())),
            };
            self.observer.advanced(share / DRAWS as f64);
            Ok(drawn)
        })?;
        let studies: Vec<Study> = basic.iter().map(|of| of.study.clone()).collect();
        let mut draws = draws::judge(&studies, seed);
        for other in others {
            match other {
                Ok(drawn) => draws.extend(drawn),
                Err(failure) => failed.push(failure),
            }
        }
        Ok(draws)
    }

    /// One of them: what is kept, or made anew.
    fn drawn(&self, first: &Job, model: &Model, best: &Study, seed: u64) -> Result<Vec<Drawn>> {
        let file = self.out.join(WORK).join(format!("draw-{seed}-{:.16}.json", self.key(first)));
        if let Some(kept) = read_json(&file) {
            return Ok(kept);
        }
        self.observer.begun(&set_name(seed));
        let drawn = draws::draw(model, best, seed, self.control)?;
        write(&file, &to_json(&drawn)?)?;
        self.observer.finished(&set_name(seed), None);
        Ok(drawn)
    }

    /// Pictures of the errors by Eq. 1 with each Laplacian; of the paper's own models by Eq. 3 too.
    fn maps(&self, model: &Model, exact: &[f64], study: &Study, is_papers: bool) -> Result<Vec<ErrorMap>> {
        let mut shown = Vec::new();
        let mut errors = Vec::new();
        for of in &study.laplacians {
            let probe = Probe::new(model, exact, &setting(of.laplacian), self.control)?;
            for gain in of.formulas.iter().filter(|gain| is_drawn(gain, is_papers)) {
                let Ok(outcome) = &gain.outcome else { continue };
                errors.push(percents(&probe.distances(outcome.t)?, exact));
                shown.push((of.laplacian, gain.formula, outcome.mean));
            }
        }
        if errors.is_empty() {
            return Ok(Vec::new());
        }
        let draw = (self.draw)(&model.mesh, model.source, exact, &errors);
        let drawn = draw.map_err(|error| Error::Input(format!("{}: {error}", model.name)))?;
        let map = |((laplacian, formula, mean), png)| ErrorMap { laplacian, formula, mean, png };
        Ok(shown.into_iter().zip(drawn.iter().map(|png| BASE64_STANDARD.encode(png))).map(map).collect())
    }
}

fn set_name(seed: u64) -> String {
    format!("basic set, seed {seed}")
}

fn is_drawn(gain: &FormulaGain, is_papers: bool) -> bool {
    let is_wanted = gain.formula == TimeFormula::MeanEdge || (is_papers && gain.formula == TimeFormula::MeanSigma);
    is_wanted && gain.scale == TimeScale::Paper
}

/// Whether a model is one of the paper's Table 5, triangle by triangle.
pub(crate) fn is_own_tessellation(study: &Study) -> bool {
    let printed = paper::table5(&study.model);
    printed.is_some_and(|printed| paper::is_own_tessellation(printed, &study.properties))
}
