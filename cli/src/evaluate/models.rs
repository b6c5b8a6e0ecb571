//! Options that several words of `taut evaluate` share.

use crate::{Result, output};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::path::PathBuf;
use taut::Laplacian;
use taut_eval::{Bootstrap, LAPLACIANS, Model, Table, mesh_files};

/// Meshes, and from where distances on them are measured.
#[derive(Debug, Args)]
pub(crate) struct ModelArgs {
    /// Mesh files, or folders of such: .glb, .obj, .off, .ply or .stl, also with .gz behind it
    #[arg(required = true, value_name = "MESH")]
    meshes: Vec<PathBuf>,

    /// Source vertex, once for all meshes or once for each [default: the first vertex of each mesh,
    /// and that of the paper on its 1.obj]
    #[arg(verbatim_doc_comment, long = "source", value_name = "V")]
    sources: Vec<u32>,
}

impl ModelArgs {
    /// Reads all of them.
    pub(super) fn read(&self) -> Result<Vec<Model>> {
        let mut paths = Vec::new();
        for path in &self.meshes {
            match path.is_dir() {
                true => paths.extend(mesh_files(path).map_err(|error| error.to_string())?),
                false => paths.push(path.clone()),
            }
        }
        let source = |i: usize| match self.sources[..] {
            [one] => Ok(Some(one)),
            [] => Ok(None),
            _ if self.sources.len() == paths.len() => Ok(Some(self.sources[i])),
            _ => Err(format!(
                "{} sources for {} meshes: give one for all, or one for each",
                self.sources.len(),
                paths.len()
            )),
        };
        let read = |(i, path): (usize, &PathBuf)| Model::read(path, source(i)?).map_err(|error| error.to_string());
        paths.iter().enumerate().map(read).collect()
    }
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
    /// One object with all there is, each number in full
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
            Format::Text => output::print(&tables().iter().map(Table::text).collect::<Vec<_>>().join("\n")),
            Format::Csv => {
                let mut bytes = Vec::new();
                csv(&mut bytes).map_err(|error| error.to_string())?;
                output::print(&String::from_utf8_lossy(&bytes))
            }
            Format::Json => output::json(all),
        }
    }
}
