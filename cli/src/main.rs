//! The command `taut`: geodesic distances on triangle meshes.
//!
//! Exit code 0 is success, 1 a failure (said on standard error), 2 a command line that makes no sense.

mod args;
mod comparison;
mod distance;
mod measured;
mod numbers;
mod output;

use clap::Parser;
use std::process::ExitCode;

/// What a person is told of a failure: which file or option, which line or element, and what is wrong with it.
type Result<T> = std::result::Result<T, String>;

fn main() -> ExitCode {
    let args::Command::Distance(args) = args::Cli::parse().command;
    if let Err(error) = args.check() {
        error.exit();
    }
    match distance::run(&args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("taut: error: {message}");
            ExitCode::FAILURE
        }
    }
}
