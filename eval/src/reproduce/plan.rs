//! Which models are to be studied: each mesh of the folder, the meshes made from the paper's first one, and for a model
//! of the paper that is here before its last subdivision, that subdivision.

use super::files;
use crate::basic_set::{BasicMesh, basic_set};
use crate::error::{Error, Result};
use crate::model::{self, Model};
use crate::paper;
use crate::properties::ModelProperties;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use taut::Mesh;

/// A model to be studied.
pub(crate) struct Job {
    /// What it is called.
    pub(crate) name: String,
    /// Where its mesh comes from.
    pub(crate) origin: Origin,
    /// Its number of vertices, which tells how long it takes.
    pub(crate) vertices: usize,
    /// Its number in the basic set, from 1 to 5.
    pub(crate) basic: Option<usize>,
}

/// Where a mesh comes from.
pub(crate) enum Origin {
    File(PathBuf),
    /// The file's mesh, each triangle in four.
    Split(PathBuf),
    Made(Box<BasicMesh>),
}

/// What is to be done, and the files that are no meshes, with the reason.
pub(crate) struct Plan {
    /// The largest first.
    pub(crate) jobs: Vec<Job>,
    pub(crate) failed: Vec<(String, String)>,
}

impl Job {
    pub(crate) fn model(&self) -> Result<Model> {
        match &self.origin {
            Origin::File(path) => Model::read(path, None).map(|model| Model { name: self.name.clone(), ..model }),
            Origin::Split(path) => {
                let mesh = paper::midpoint_split(&Model::read(path, None)?.mesh);
                let mesh = mesh.map_err(Error::of_model(&self.name))?;
                Model::new(self.name.clone(), mesh, None)
            }
            Origin::Made(made) => Ok(Model { name: self.name.clone(), ..made.model.clone() }),
        }
    }
}

impl Plan {
    /// Of the meshes of a folder; `seed` makes the basic set.
    pub(crate) fn of(folder: &Path, seed: u64, threads: usize) -> Result<Plan> {
        let paths = files::mesh_files(folder)?;
        if paths.is_empty() {
            return Err(Error::Input(format!("{}: has no mesh files", folder.display())));
        }
        let names = names(&paths);
        let files: Vec<(&PathBuf, &String)> = paths.iter().zip(&names).collect();
        let found = side_by_side(&files, threads, |&(path, name)| jobs(path, name, seed));
        let mut plan = Plan { jobs: Vec::new(), failed: Vec::new() };
        for (name, jobs) in names.iter().zip(found) {
            match jobs {
                Ok(jobs) => plan.jobs.extend(jobs),
                Err(error) => plan.failed.push((name.clone(), error.to_string())),
            }
        }
        plan.jobs.sort_by_key(|job| std::cmp::Reverse(job.vertices));
        Ok(plan)
    }
}

/// What each file is called: its whole name where two have the same but for how they are written.
fn names(paths: &[PathBuf]) -> Vec<String> {
    let mut seen = BTreeSet::new();
    let twice: BTreeSet<String> =
        paths.iter().map(|path| model::name(path)).filter(|name| !seen.insert(name.clone())).collect();
    let whole = |path: &PathBuf| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    paths
        .iter()
        .map(|path| Some(model::name(path)).filter(|name| !twice.contains(name)).unwrap_or_else(|| whole(path)))
        .collect()
}

/// The models that come from a file.
fn jobs(path: &Path, name: &str, seed: u64) -> Result<Vec<Job>> {
    let model = Model::read(path, None)?;
    let job = |name: &str, origin, vertices, basic| Job { name: name.to_owned(), origin, vertices, basic };
    if paper::is_basic(&model.mesh) {
        let mut jobs = vec![job("1.obj", Origin::File(path.to_owned()), model.mesh.vertex_count(), Some(1))];
        for (i, made) in (2..).zip(basic_set(&model, seed)?) {
            let vertices = made.model.mesh.vertex_count();
            jobs.push(job(&format!("{i}.obj"), Origin::Made(Box::new(made)), vertices, Some(i)));
        }
        return Ok(jobs);
    }
    match split_of_the_paper(&model)? {
        Some(vertices) => Ok(vec![job(name, Origin::Split(path.to_owned()), vertices, None)]),
        None => Ok(vec![job(name, Origin::File(path.to_owned()), model.mesh.vertex_count(), None)]),
    }
}

/// The number of vertices of the mesh with each triangle in four, if that is the paper's model of this name.
fn split_of_the_paper(model: &Model) -> Result<Option<usize>> {
    let Some(printed) = paper::table5(&model.name) else { return Ok(None) };
    if paper::is_own_tessellation(printed, &ModelProperties::of(model)?) {
        return Ok(None);
    }
    let mesh: Mesh = paper::midpoint_split(&model.mesh).map_err(Error::of_model(&model.name))?;
    let split = Model::new(model.name.clone(), mesh, None)?;
    let is_own = paper::is_own_tessellation(printed, &ModelProperties::of(&split)?);
    Ok(is_own.then(|| split.mesh.vertex_count()))
}

/// The results of `work` on each item, by several threads that take one item after the other.
pub(crate) fn side_by_side<I: Sync, T: Send>(items: &[I], threads: usize, work: impl Fn(&I) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, items.len().max(1)) {
            scope.spawn(|| {
                while let Some((i, item)) = {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    items.get(i).map(|item| (i, item))
                } {
                    let result = work(item);
                    results.lock().unwrap_or_else(PoisonError::into_inner).push((i, result));
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_by_key(|&(i, _)| i);
    results.into_iter().map(|(_, result)| result).collect()
}
