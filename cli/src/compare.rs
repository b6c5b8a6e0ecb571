//! `taut compare`: how far the distances of one file are from those of another.

use crate::numbers::{self, DISTANCE};
use crate::{Result, output};
use clap::Args;
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;
use taut_eval::Errors;

const EXAMPLES: &str = "\
Example:
  taut compare heat.txt exact.txt
      how far the distances of heat.txt are from those of exact.txt

Exit code: 0 success, however far they are apart; 1 failure, 2 a command line that makes no sense.";

/// Compare two files of distances
///
/// Each file has one distance a line, as `taut distance` writes them; inf is a vertex that no source reaches.
/// The error of a vertex is |a - b| / b, and 0 where b is 0. Vertices that are unreachable in both
/// are left out; where only one of the two is, the error is inf, which JSON writes as null.
/// Vertices count from 0.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct CompareArgs {
    /// The distances to judge
    a: PathBuf,

    /// The distances that count as right
    b: PathBuf,

    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &CompareArgs) -> Result<()> {
    let (a, b) = (numbers::numbers(&args.a, DISTANCE)?, numbers::numbers(&args.b, DISTANCE)?);
    if a.len() != b.len() {
        let [path_a, path_b] = [args.a.display(), args.b.display()];
        return Err(format!("{path_a}: has {} distances, but {path_b} has {}", a.len(), b.len()));
    }
    let comparison = Comparison::new(&a, &b);
    if args.json { output::json(&comparison) } else { output::print(&comparison.to_string()) }
}

/// The object of `--json`, key by key.
#[derive(Debug, Serialize)]
struct Comparison {
    vertices: usize,
    error: Errors,
    unreachable: Unreachable,
}

#[derive(Debug, Serialize)]
struct Unreachable {
    both: Vertices,
    only_a: Vertices,
    only_b: Vertices,
}

#[derive(Debug, Serialize)]
struct Vertices {
    count: usize,
    first: Option<usize>,
}

impl Comparison {
    fn new(a: &[f64], b: &[f64]) -> Comparison {
        let unreachable = |wanted: [bool; 2]| {
            let is_wanted = |&v: &usize| [a[v], b[v]].map(|distance| !distance.is_finite()) == wanted;
            let mut vertices = (0..a.len()).filter(is_wanted);
            let first = vertices.next();
            Vertices { count: vertices.count() + usize::from(first.is_some()), first }
        };
        Comparison {
            vertices: a.len(),
            error: Errors::new(a, b),
            unreachable: Unreachable {
                both: unreachable([true, true]),
                only_a: unreachable([true, false]),
                only_b: unreachable([false, true]),
            },
        }
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Errors { mean_percent, median_percent, max_percent, largest_difference, .. } = self.error;
        let at = |vertex: Option<usize>| vertex.map(|v| format!(" at vertex {v}")).unwrap_or_default();
        writeln!(out, "vertices            {}", self.vertices)?;
        writeln!(out, "mean error          {mean_percent:.5} %")?;
        writeln!(out, "median error        {median_percent:.5} %")?;
        writeln!(out, "maximum error       {max_percent:.5} %{}", at(self.error.max_vertex))?;
        writeln!(out, "largest difference  {largest_difference}{}", at(self.error.largest_difference_vertex))?;
        let Unreachable { both, only_a, only_b } = &self.unreachable;
        writeln!(out, "unreachable         {both} in both, {only_a} in A only, {only_b} in B only")
    }
}

impl fmt::Display for Vertices {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.first {
            Some(first) => write!(out, "{} (first: vertex {first})", self.count),
            None => write!(out, "{}", self.count),
        }
    }
}
