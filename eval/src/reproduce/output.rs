//! What is written when all models are studied: the report, the data, tables, and the meshes of the basic set.

use super::content::Parts;
use super::files::{folder, to_json, write};
use super::plan::{Job, Origin};
use super::{Finished, Reproduction, Summary};
use crate::claims::Claim;
use crate::draws::Drawn;
use crate::error::{Error, Result};
use crate::report;
use crate::study::Study;
use serde::Serialize;
use std::path::Path;

/// All that came out, as JSON.
#[derive(Serialize)]
struct Data<'a> {
    version: &'static str,
    options: super::Options,
    models: &'a [Study],
    /// The names of the basic set's models, 1.obj first.
    basic: Vec<&'a str>,
    ablations: Vec<&'a crate::ablation::Ablation>,
    draws: &'a [Drawn],
    claims: &'a [Claim],
    failed: &'a [(String, String)],
}

/// Writes everything.
pub(super) fn write_all(
    work: &Reproduction,
    jobs: &[Job],
    finished: &[Finished],
    draws: &[Drawn],
    failed: Vec<(String, String)>,
) -> Result<Summary> {
    write_basic_set(work.out, jobs)?;
    let models: Vec<Study> = finished.iter().map(|of| of.study.clone()).collect();
    let mut numbered: Vec<(usize, &Study)> = finished.iter().filter_map(|of| Some((of.basic?, &of.study))).collect();
    numbered.sort_by_key(|&(number, _)| number);
    let basic: Vec<Study> = numbered.into_iter().map(|(_, study)| study.clone()).collect();
    let counted: Vec<Study> = models.iter().filter(|study| study.counts()).cloned().collect();
    let parts = Parts { finished, models: &counted, basic: &basic, draws };
    let claims = parts.claims();
    let content = parts.content(work, &claims, &failed);

    let report = work.out.join("report.html");
    write(&report, report::html(&content).as_bytes())?;
    let data = Data {
        version: env!("CARGO_PKG_VERSION"),
        options: work.options,
        models: &models,
        basic: basic.iter().map(|study| study.model.as_str()).collect(),
        ablations: finished.iter().filter_map(|of| of.ablation.as_ref()).collect(),
        draws,
        claims: &claims,
        failed: &failed,
    };
    write(&work.out.join("data.json"), &to_json(&data)?)?;
    write_tables(work.out, &models)?;
    Ok(Summary { report, models: models.len(), failed })
}

/// The meshes that were made, as OBJ.
fn write_basic_set(out: &Path, jobs: &[Job]) -> Result<()> {
    for job in jobs {
        if let Origin::Made(made) = &job.origin {
            folder(&out.join("basic-set"))?;
            write(&out.join("basic-set").join(&job.name), made.model.obj().as_bytes())?;
        }
    }
    Ok(())
}

fn write_tables(out: &Path, models: &[Study]) -> Result<()> {
    type Writer = fn(&[Study], &mut Vec<u8>) -> std::io::Result<()>;
    let tables: [(&str, Writer); 4] = [
        ("properties.csv", |models, out| {
            report::write_properties(models.iter().map(|study| (&*study.model, &study.properties)), out)
        }),
        ("sweep.csv", |models, out| report::write_sweeps(models, out)),
        ("best.csv", |models, out| report::write_best(models, out)),
        ("gains.csv", |models, out| report::write_gains(models, out)),
    ];
    for (name, table) in tables {
        let path = out.join(name);
        let mut content = Vec::new();
        table(models, &mut content).map_err(Error::of_file(&path))?;
        write(&path, &content)?;
    }
    Ok(())
}
