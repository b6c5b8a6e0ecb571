//! Work whose time is taken and whose progress is shown.

use cpu_time::ProcessTime;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::io::IsTerminal;
use std::time::{Duration, Instant};
use taut::Control;

/// Seconds of one stage of the work.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(crate) struct Seconds {
    /// Of all threads of this process.
    cpu: f64,
    wall: f64,
}

/// Runs `work`, shows its progress on standard error where that is a terminal, and takes its time.
pub(crate) fn measured<T: Send>(stage: &'static str, work: impl FnOnce(&Control) -> T + Send) -> (T, Seconds) {
    let control = Control::new();
    if std::io::stderr().is_terminal() {
        watched(stage, &control, || timed(|| work(&control)))
    } else {
        timed(|| work(&control))
    }
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, Seconds) {
    let wall = Instant::now();
    // A system that does not tell the time of a process leaves its place at 0.
    let cpu = ProcessTime::try_now().ok();
    let result = work();
    let cpu = cpu.and_then(|start| start.try_elapsed().ok()).unwrap_or_default();
    (result, Seconds { cpu: cpu.as_secs_f64(), wall: wall.elapsed().as_secs_f64() })
}

fn watched<T: Send>(stage: &'static str, control: &Control, work: impl FnOnce() -> T + Send) -> T {
    const STEPS: u32 = 1000;
    let style =
        ProgressStyle::with_template("{msg:6} [{bar:40}] {elapsed}").unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(u64::from(STEPS)).with_style(style).with_message(stage);
    let result = std::thread::scope(|scope| {
        let worker = scope.spawn(work);
        while !worker.is_finished() {
            // From 0 to STEPS: the cast cuts off the fraction only.
            bar.set_position((control.progress() * f64::from(STEPS)) as u64);
            std::thread::sleep(Duration::from_millis(20));
        }
        worker.join()
    });
    bar.finish_and_clear();
    result.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
