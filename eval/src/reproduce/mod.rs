//! The paper's evaluation on all meshes of a folder: one report, and what it was made from.
//!
//! Each model's results are a file of their own in the folder `work` of the output, named by what they depend on; so
//! work that was interrupted goes on where it was, and meshes that are added cost only themselves.

mod content;
mod files;
mod output;
mod plan;

use crate::ablation::{Ablation, ablation};
use crate::accuracy::percents;
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
use files::{folder, read_json, safe, write_json};
use plan::{Job, Plan, side_by_side};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::cell::Cell;
use std::path::{Path, PathBuf};
use taut::{Control, Laplacian, Mesh, TimeFormula, TimeScale};

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
    /// So many models are to be studied; of so many the results are there already.
    fn planned(&self, models: usize, done_before: usize);
    /// A model is begun.
    fn begun(&self, model: &str);
    /// This share of all work is done.
    fn advanced(&self, share: f64);
    /// A model is done; `failure` is what it failed with.
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
/// # Errors
/// [`Error::File`] where a folder cannot be read or a file not be written; [`Error::Input`] where there is no mesh at all;
/// [`Error::Model`] if the work is cancelled: what is finished by then is kept, and the next call goes on from there. A
/// model that fails is no failure of the whole; the report tells it.
pub fn reproduce(work: &Reproduction) -> Result<Summary> {
    folder(&work.out.join(WORK))?;
    let plan = Plan::of(work.meshes, work.options.basic_seed, work.threads)?;
    let before = plan.jobs.iter().filter(|job| work.file(job).is_file()).count();
    work.observer.planned(plan.jobs.len(), before);
    let total: usize = plan.jobs.iter().map(|job| job.vertices).sum();
    let results = side_by_side(&plan.jobs, work.threads, |job| {
        work.observer.begun(&job.name);
        let result = work.finish(job, job.vertices as f64 / total.max(1) as f64);
        let failure = result.as_ref().err().map(ToString::to_string);
        work.observer.finished(&job.name, failure.as_deref());
        result
    });
    let mut finished = Vec::new();
    let mut failed = plan.failed;
    for (job, result) in plan.jobs.iter().zip(results) {
        match result {
            Ok(model) => finished.push(model),
            Err(error) if error.is_cancelled() || matches!(error, Error::File { .. }) => return Err(error),
            Err(error) => failed.push((job.name.clone(), error.to_string())),
        }
    }
    finished.sort_by(|a, b| a.study.model.cmp(&b.study.model));
    output::write_all(work, &plan.jobs, &finished, failed)
}

const WORK: &str = "work";

impl Reproduction<'_> {
    /// Where a model's results are kept.
    fn file(&self, job: &Job) -> PathBuf {
        self.out.join(WORK).join(safe(&job.name) + ".json")
    }

    /// The results of one model, which is `share` of all the work: those that are kept, or new ones.
    fn finish(&self, job: &Job, share: f64) -> Result<Finished> {
        let model = job.model()?;
        let key = self.key(&model)?;
        let file = self.file(job);
        if let Some(kept) = read_json::<Finished>(&file).filter(|kept| kept.key == key) {
            self.observer.advanced(share);
            return Ok(kept);
        }
        let exact = probe::exact(&model, model.source, self.control)?;
        let sources = Sources::new(&model, &exact, &self.options.bootstrap, self.control)?;
        self.observer.advanced(0.2 * share);
        let told = Cell::new(0.0);
        let study = Study::new(
            &model,
            &exact,
            &LAPLACIANS.map(|(_, laplacian)| laplacian),
            Some((&sources, &self.options.bootstrap)),
            self.control,
            &|done| {
                self.observer.advanced(0.7 * share * (done - told.replace(done)));
            },
        )?;
        let is_named = job.basic.is_some() || paper::table5(&job.name).is_some();
        let is_papers = job.basic.is_some() || is_own_tessellation(&study);
        let ablation = match study.with(Laplacian::Plain).filter(|_| is_named) {
            Some(of) => {
                Some(ablation(&model, &exact, Measure::ALL.map(|measure| of.sweep.best(measure).t), self.control)?)
            }
            None => None,
        };
        let maps = self.maps(&model, &exact, &study, is_papers)?;
        let finished = Finished { key, basic: job.basic, study, ablation, maps };
        write_json(&file, &finished)?;
        self.observer.advanced(0.1 * share);
        Ok(finished)
    }

    /// What a model's results depend on: the mesh, its source, the options and this program's version.
    fn key(&self, model: &Model) -> Result<String> {
        let options = serde_json::to_string(&self.options).map_err(|error| Error::Input(error.to_string()))?;
        let mut hash = Sha256::new();
        hash.update(format!("{} {} {} {options}", env!("CARGO_PKG_VERSION"), model.name, model.source));
        model.mesh.positions().iter().flatten().for_each(|x| hash.update(x.to_bits().to_le_bytes()));
        model.mesh.triangles().iter().flatten().for_each(|v| hash.update(v.to_le_bytes()));
        Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
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
        let draw = (self.draw)(&model.mesh, model.source, exact, &errors);
        let drawn = draw.map_err(|error| Error::Input(format!("{}: {error}", model.name)))?;
        let map = |((laplacian, formula, mean), png)| ErrorMap { laplacian, formula, mean, png };
        Ok(shown.into_iter().zip(drawn.iter().map(|png| BASE64_STANDARD.encode(png))).map(map).collect())
    }
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
