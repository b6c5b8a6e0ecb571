//! Work that takes minutes, watched: Ctrl-C cancels it, a bar shows how far it is.

use super::counted;
use crate::Result;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use taut::Control;
use taut_eval::{Model, Observer};

/// A control that Ctrl-C cancels; a second Ctrl-C ends the program.
pub(super) fn cancelled_by_user() -> Control {
    let control = Control::new();
    let handle = control.clone();
    let set = ctrlc::set_handler(move || {
        if handle.is_cancelled() {
            std::process::exit(130);
        }
        eprintln!("taut: stopping; once more to stop at once");
        handle.cancel();
    });
    if let Err(error) = set {
        eprintln!("taut: warning: Ctrl-C will stop at once: {error}");
    }
    control
}

/// The result of `work` on each model, one after the other, while a bar shows how far it is.
pub(super) fn watched<T>(
    models: &[Model],
    work: impl Fn(&Model, &Control, &dyn Fn(f64)) -> taut_eval::Result<T>,
) -> Result<Vec<T>> {
    let control = cancelled_by_user();
    let bar = Bar::new();
    let one = |(i, model): (usize, &Model)| {
        bar.update(|state| state.working = vec![model.name.clone()]);
        let at = |share: f64| bar.update(|state| state.done = (i as f64 + share) / models.len() as f64);
        work(model, &control, &at).map_err(|error| error.to_string())
    };
    let results = models.iter().enumerate().map(one).collect();
    bar.end();
    results
}

const STEPS: f64 = 10_000.0;

/// Shows what is done: a bar where standard error is a terminal, else a line for each model.
pub(super) struct Bar {
    bar: ProgressBar,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    done: f64,
    /// The models that are in work.
    working: Vec<String>,
}

impl Bar {
    pub(super) fn new() -> Bar {
        let is_shown = std::io::stderr().is_terminal();
        let target = if is_shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let style = ProgressStyle::with_template("[{bar:40}] {percent:>3} %  {elapsed}, {eta} to go  {wide_msg}");
        let bar = ProgressBar::with_draw_target(Some(STEPS as u64), target); // the number is whole
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(200));
        Bar { bar, state: Mutex::default() }
    }

    /// Lets the bar vanish.
    pub(super) fn end(&self) {
        self.bar.finish_and_clear();
    }

    fn update(&self, change: impl FnOnce(&mut State)) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut state);
        self.bar.set_position((STEPS * state.done) as u64); // the cast cuts off the fraction
        self.bar.set_message(state.working.join(", "));
    }

    fn say(&self, line: &str) {
        self.bar.suspend(|| eprintln!("{line}"));
    }
}

impl Observer for Bar {
    fn planned(&self, models: usize, done_before: usize) {
        let before = if done_before == 0 { String::new() } else { format!(", {done_before} of them done before") };
        self.say(&(counted(models, "model", "models") + &before));
    }

    fn begun(&self, model: &str) {
        self.update(|state| state.working.push(model.to_owned()));
    }

    fn advanced(&self, share: f64) {
        self.update(|state| state.done += share);
    }

    fn finished(&self, model: &str, failure: Option<&str>) {
        self.update(|state| state.working.retain(|name| name != model));
        match failure {
            Some(failure) => self.say(&format!("taut: warning: {failure}")),
            None if self.bar.is_hidden() => self.say(model),
            None => {}
        }
    }
}
