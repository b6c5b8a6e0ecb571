//! The command `taut`: geodesic distances on triangle meshes.
//!
//! Exit code 0 is success, 1 a failure (said on standard error), 2 a command line that makes no sense.

mod args;
mod cells;
mod compare;
mod curves;
mod distance;
mod drawing;
mod evaluate;
mod field;
mod info;
mod input;
mod isolines;
mod measured;
mod mesh_out;
mod numbers;
mod output;
mod path;
mod picture;
mod sample;
mod voronoi;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// What a person is told of a failure: which file or option, which line or element, and what is wrong with it.
type Result<T> = std::result::Result<T, String>;

/// Geodesic distances on triangle meshes: how far it is along the surface.
#[derive(Debug, Parser)]
#[command(name = "taut", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Compare(compare::CompareArgs),
    Distance(distance::DistanceArgs),
    Evaluate(evaluate::EvaluateArgs),
    Info(info::InfoArgs),
    Isolines(isolines::IsolinesArgs),
    Path(path::PathArgs),
    Sample(sample::SampleArgs),
    Voronoi(voronoi::VoronoiArgs),
}

impl Command {
    /// Refuses what clap cannot see by itself.
    fn check(&self) -> std::result::Result<(), clap::Error> {
        match self {
            Command::Compare(_) => Ok(()),
            Command::Distance(args) => args.check(),
            Command::Evaluate(args) => args.check(),
            Command::Info(_) => Ok(()),
            Command::Isolines(args) => args.check(),
            Command::Path(args) => args.check(),
            Command::Sample(args) => args.check(),
            Command::Voronoi(args) => args.check(),
        }
    }

    fn run(&self) -> Result<()> {
        match self {
            Command::Compare(args) => compare::run(args),
            Command::Distance(args) => distance::run(args),
            Command::Evaluate(args) => evaluate::run(args),
            Command::Info(args) => info::run(args),
            Command::Isolines(args) => isolines::run(args),
            Command::Path(args) => path::run(args),
            Command::Sample(args) => sample::run(args),
            Command::Voronoi(args) => voronoi::run(args),
        }
    }
}

fn main() -> ExitCode {
    let command = Cli::parse().command;
    if let Err(error) = command.check() {
        error.exit();
    }
    match command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("taut: error: {message}");
            ExitCode::FAILURE
        }
    }
}
