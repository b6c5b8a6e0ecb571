//! Which models are to be studied: each mesh of the folder, the meshes made from the paper's first one, and for a model
//! of the paper that is here before its last subdivision, that subdivision.

use super::files;
use crate::basic_set::{BasicMesh, basic_set};
use crate::error::{Error, Result};
use crate::model::{self, Model};
use crate::paper::{self, BASIC};
use crate::properties::ModelProperties;
use sha2::{Digest, Sha256};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use taut::{Control, Mesh, Reason};

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
    /// Of its mesh and source.
    pub(crate) fingerprint: String,
}

/// Where a mesh comes from.
pub(crate) enum Origin {
    File(PathBuf),
    /// The file's mesh, each triangle in four.
    Split(PathBuf),
    Made(Box<BasicMesh>),
}

/// What is to be done, and the files that are not, with the reason.
pub(crate) struct Plan {
    /// The largest first.
    pub(crate) jobs: Vec<Job>,
    pub(crate) failed: Vec<(String, String)>,
}

impl Job {
    fn new(name: &str, origin: Origin, basic: Option<usize>, model: &Model) -> Job {
        let (vertices, fingerprint) = (model.mesh.vertex_count(), fingerprint(model));
        Job { name: name.to_owned(), origin, vertices, basic, fingerprint }
    }

    /// The mesh, which is read again: all of them at once may be more than fits into memory.
    pub(crate) fn model(&self) -> Result<Model> {
        let named = |mesh| Model::new(self.name.clone(), mesh, None);
        let model = match &self.origin {
            Origin::File(path) => named(Model::read(path, None)?.mesh)?,
            Origin::Split(path) => {
                let mesh = paper::midpoint_split(&Model::read(path, None)?.mesh);
                named(mesh.map_err(Error::of_model(&self.name))?)?
            }
            Origin::Made(made) => Model { name: self.name.clone(), ..made.model.clone() },
        };
        match fingerprint(&model) == self.fingerprint {
            true => Ok(model),
            false => Err(Error::Input(format!("{}: its file was changed while others were studied", self.name))),
        }
    }
}

impl Plan {
    /// Of the meshes of a folder; `seed` makes the basic set. A mesh that several files have counts once.
    pub(crate) fn of(folder: &Path, seed: u64, threads: usize, control: &Control) -> Result<Plan> {
        let paths = files::mesh_files(folder)?;
        if paths.is_empty() {
            return Err(Error::Input(format!("{}: has no mesh files", folder.display())));
        }
        let names = names(&paths);
        let files: Vec<(&PathBuf, &String)> = paths.iter().zip(&names).collect();
        let found = side_by_side(&files, threads, |&(path, name)| match control.is_cancelled() {
            true => Err(Error::of_model(name)(taut::Error::new(Reason::Cancelled, "the work was cancelled"))),
            false => Ok(jobs(path, name, seed)),
        })?;
        let mut plan = Plan { jobs: Vec::new(), failed: Vec::new() };
        let mut seen = BTreeMap::new();
        for (name, jobs) in names.iter().zip(found) {
            let jobs = jobs.and_then(|jobs| match jobs.iter().find_map(|job| seen.get(&job.fingerprint)) {
                Some(other) => Err(Error::Input(format!("{name}: has the same mesh as {other}"))),
                None => Ok(jobs),
            });
            match jobs {
                Ok(jobs) => {
                    seen.extend(jobs.iter().map(|job| (job.fingerprint.clone(), name)));
                    plan.jobs.extend(jobs);
                }
                Err(error) => plan.failed.push((name.clone(), error.to_string())),
            }
        }
        plan.jobs.sort_by_key(|job| Reverse(job.vertices));
        Ok(plan)
    }
}

/// What each file is called: its name without what says how it is written, or all of it where that could be another one
/// too. The names of the basic set are for the meshes that are made.
fn names(paths: &[PathBuf]) -> Vec<String> {
    let stems: Vec<String> = paths.iter().map(|path| model::name(path)).collect();
    let whole = paths.iter().map(|path| path.file_name().unwrap_or_default().to_string_lossy());
    let whole: Vec<String> =
        whole.map(|name| if is_reserved(&name) { format!("./{name}") } else { name.into() }).collect();
    let mut times = BTreeMap::new();
    stems.iter().chain(&whole).for_each(|name| *times.entry(name).or_insert(0) += 1);
    let is_clear = |stem: &String| times[stem] == 1 && !stem.is_empty() && !is_reserved(stem);
    stems.iter().zip(&whole).map(|(stem, whole)| if is_clear(stem) { stem.clone() } else { whole.clone() }).collect()
}

fn is_reserved(name: &str) -> bool {
    BASIC.iter().any(|mesh| mesh.name == name)
}

/// Tells meshes with their sources apart: the SHA-256 of their bits.
fn fingerprint(model: &Model) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("{} {}", model.source, model.mesh.vertex_count()));
    model.mesh.positions().iter().flatten().for_each(|x| hash.update(x.to_bits().to_le_bytes()));
    model.mesh.triangles().iter().flatten().for_each(|v| hash.update(v.to_le_bytes()));
    hex(&hash.finalize())
}

/// Bytes as people write them.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The models that come from a file.
fn jobs(path: &Path, name: &str, seed: u64) -> Result<Vec<Job>> {
    let model = Model::read(path, None)?;
    if paper::is_basic(&model.mesh) {
        let mut jobs = vec![Job::new(BASIC[0].name, Origin::File(path.to_owned()), Some(1), &model)];
        for (i, made) in (1..).zip(basic_set(&model, seed)?) {
            let of = made.model.clone();
            jobs.push(Job::new(BASIC[i].name, Origin::Made(Box::new(made)), Some(i + 1), &of));
        }
        return Ok(jobs);
    }
    Ok(vec![match split_of_the_paper(&model)? {
        Some(split) => Job::new(name, Origin::Split(path.to_owned()), None, &split),
        None => Job::new(name, Origin::File(path.to_owned()), None, &model),
    }])
}

/// The mesh with each triangle in four, if that is the paper's model of this name.
fn split_of_the_paper(model: &Model) -> Result<Option<Model>> {
    let Some(printed) = paper::table5(&model.name) else { return Ok(None) };
    if paper::is_own_tessellation(printed, &ModelProperties::of(model)?) {
        return Ok(None);
    }
    let mesh: Mesh = paper::midpoint_split(&model.mesh).map_err(Error::of_model(&model.name))?;
    let split = Model::new(model.name.clone(), mesh, None)?;
    let is_own = paper::is_own_tessellation(printed, &ModelProperties::of(&split)?);
    Ok(is_own.then_some(split))
}

/// The results of `work` on each item, by several threads that take one item after the other; after a failure no item is
/// begun. A panic in `work` comes out when the other threads have ended.
///
/// # Errors
/// Those of `work`, of the first item that fails.
pub(crate) fn side_by_side<I: Sync, T: Send>(
    items: &[I],
    threads: usize,
    work: impl Fn(&I) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::new());
    let take = || {
        let i = next.fetch_add(1, Ordering::Relaxed);
        items.get(i).map(|item| (i, item))
    };
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, items.len().max(1)) {
            scope.spawn(|| {
                while let Some((i, item)) = take() {
                    let result = work(item);
                    if result.is_err() {
                        next.store(items.len(), Ordering::Relaxed);
                    }
                    results.lock().unwrap_or_else(PoisonError::into_inner).push((i, result));
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_by_key(|&(i, _)| i);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_files_are_called_the_same_and_none_as_a_made_mesh() {
        let called = |files: &[&str]| names(&files.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(called(&["m/1.obj", "m/2.obj", "m/lucy.obj.gz"]), ["1", "2", "lucy"]);
        assert_eq!(called(&["a.obj", "a.off", "a.off.gz"]), ["a.obj", "a.off", "a.off.gz"]);
        // The first is not called as all of the second, the third not as 2.obj that is made.
        assert_eq!(called(&["a.obj.ply", "a.obj", "2.obj.off"]), ["a.obj.ply", "a", "2.obj.off"]);
        assert_eq!(called(&["2.obj", "2.off"]), ["./2.obj", "2.off"]);
        assert_eq!(called(&["..obj", "6.obj", "6.ply"]), [".", "6.obj", "6.ply"]);
    }

    #[test]
    fn results_are_in_order_and_after_a_failure_nothing_is_begun() {
        let items: Vec<usize> = (0..50).collect();
        for threads in [0, 1, 3, 100] {
            assert_eq!(side_by_side(&items, threads, |&i| Ok(i)).unwrap(), items);
            let begun = AtomicUsize::new(0);
            let failed = side_by_side(&items, threads, |&i| {
                begun.fetch_add(1, Ordering::Relaxed);
                if i == 3 { Err(Error::Input(i.to_string())) } else { Ok(i) }
            });
            assert_eq!(failed.unwrap_err().to_string(), "3");
            if threads <= 1 {
                assert_eq!(begun.into_inner(), 4);
            }
        }
        assert!(side_by_side(&[], 2, |_: &u8| Ok(1)).unwrap().is_empty());
    }
}
