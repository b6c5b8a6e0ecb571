//! The command `taut`: geodesic distances on triangle meshes.
//!
//! Exit code 0 is success, 1 a failure (said on standard error), 2 a command line that makes no sense.

mod args;
mod comparison;
mod distance;
mod field;
mod input;
mod measured;
mod numbers;
mod output;
mod picture;

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
    Distance(distance::DistanceArgs),
}

impl Command {
    /// Refuses what clap cannot see by itself.
    fn check(&self) -> std::result::Result<(), clap::Error> {
        match self {
            Command::Distance(args) => args.field.check(),
        }
    }

    fn run(&self) -> Result<()> {
        match self {
            Command::Distance(args) => distance::run(args),
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
