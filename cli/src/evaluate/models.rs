//! Options that several words of `taut evaluate` share.

use super::counted;
use crate::{Result, output};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::path::{Path, PathBuf};
use taut::Laplacian;
use taut_eval::{Bootstrap, LAPLACIANS, Model, Table, mesh_files};

/// Meshes, and from where distances on them are measured.
#[derive(Debug, Args)]
pub(crate) struct ModelArgs {
    /// Mesh files, or folders of such: .glb, .obj, .off, .ply or .stl, also with .gz behind it
    #[arg(required = true, value_name = "MESH")]
    meshes: Vec<PathBuf>,

    /// Source vertex, once for all meshes or once for each [default: what basic-set wrote into its
    /// files; on the paper's mesh its source, 7649; else the first vertex of a triangle]
    #[arg(verbatim_doc_comment, long = "source", value_name = "V")]
    sources: Vec<u32>,
}

impl ModelArgs {
    /// Reads all of them.
    pub(super) fn read(&self) -> Result<Vec<Model>> {
        let mut paths = Vec::new();
        for path in &self.meshes {
            match path.is_dir() {
                true => paths.extend(files(path)?),
                false => paths.push(path.clone()),
            }
        }
        let source = |i: usize| match self.sources[..] {
            [one] => Ok(Some(one)),
            [] => Ok(None),
            _ if self.sources.len() == paths.len() => Ok(Some(self.sources[i])),
            _ => Err(format!(
                "{} sources for {}: give one for all, or one for each",
                self.sources.len(),
                counted(paths.len(), "mesh", "meshes")
            )),
        };
        let read = |(i, path): (usize, &PathBuf)| Model::read(path, source(i)?).map_err(|error| error.to_string());
        paths.iter().enumerate().map(read).collect()
    }
}

/// The mesh files of a folder, of which there must be some.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let files = mesh_files(folder).map_err(|error| error.to_string())?;
    if files.is_empty() { Err(format!("{}: has no mesh files", folder.display())) } else { Ok(files) }
}

/// Which Laplacians.
#[derive(Debug, Args)]
pub(crate) struct LaplacianArgs {
    /// Laplacian of the heat flow
    #[arg(long, value_enum, default_value_t = Laplacians::Both)]
    laplacian: Laplacians,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Laplacians {
    /// Cotangents of the triangles as they are, as in the paper
    Plain,
    /// Of the Delaunay triangulation of the same surface
    Intrinsic,
    /// One after the other
    Both,
}

impl LaplacianArgs {
    pub(super) fn all(&self) -> Vec<Laplacian> {
        let is_wanted = |laplacian| match self.laplacian {
            Laplacians::Plain => laplacian == Laplacian::Plain,
            Laplacians::Intrinsic => laplacian == Laplacian::Intrinsic,
            Laplacians::Both => true,
        };
        LAPLACIANS.map(|(_, laplacian)| laplacian).into_iter().filter(|&laplacian| is_wanted(laplacian)).collect()
    }
}

/// How sure a gain is.
#[derive(Debug, Args)]
pub(crate) struct BootstrapArgs {
    /// How many resamples a confidence interval takes
    #[arg(long, value_name = "N", default_value_t = Bootstrap::default().resamples)]
    resamples: usize,

    /// From how many sources gains are measured: that of the model, and others at random
    #[arg(long, value_name = "K", default_value_t = Bootstrap::default().sources)]
    bootstrap_sources: usize,

    /// Seed of the resamples and of these sources
    #[arg(long, value_name = "N", default_value_t = Bootstrap::default().seed)]
    seed: u64,
}

impl BootstrapArgs {
    pub(super) fn options(&self) -> Bootstrap {
        Bootstrap { resamples: self.resamples, sources: self.bootstrap_sources, seed: self.seed }
    }
}

/// Tables one below the other.
pub(super) fn text(tables: &[Table]) -> String {
    tables.iter().map(Table::text).collect::<Vec<_>>().join("\n")
}

/// How results are printed.
#[derive(Debug, Args)]
pub(crate) struct FormatArgs {
    /// What is printed
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Tables for people
    Text,
    /// The same as comma-separated values
    Csv,
    /// All there is, each number in full
    Json,
}

impl FormatArgs {
    /// Prints `all` as JSON, as tables, or as what `csv` writes.
    pub(super) fn print(
        &self,
        all: &impl Serialize,
        tables: impl FnOnce() -> Vec<Table>,
        csv: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>,
    ) -> Result<()> {
        match self.format {
            Format::Text => output::print(&text(&tables())),
            Format::Csv => {
                let mut bytes = Vec::new();
                csv(&mut bytes).map_err(|error| error.to_string())?;
                output::print(&String::from_utf8_lossy(&bytes))
            }
            Format::Json => output::json(all),
        }
    }
}
