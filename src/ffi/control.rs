//! `taut_control`: progress and cancellation.

use super::guard::{free, guard, guard_new, guard_value, required};
use crate::{Control, Status};

/// Watches and cancels one long call from any thread.
pub struct taut_control(pub(super) Control);

/// Makes a control, at progress 0 and not cancelled. Use a new one for each call.
///
/// - `out`: receives the control; free it with `taut_control_free` once the call that uses it has returned.
///
/// Errors: `out` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_control_new(out: *mut *mut taut_control) -> Status {
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, || Ok(taut_control(Control::new()))) }
}

/// Asks the call that uses the control to stop: at its next check it returns TAUT_STATUS_CANCELLED and writes nothing.
///
/// - `control`: not NULL.
///
/// A call that starts with a cancelled control stops at once; one that has just ended is not undone.
///
/// Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_cancel(control: Option<&taut_control>) {
    guard(|| {
        required(control, "control")?.0.cancel();
        Ok(())
    });
}

/// Tells whether `taut_control_cancel` was called.
///
/// - `control`: not NULL.
///
/// Returns false if `control` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_is_cancelled(control: Option<&taut_control>) -> bool {
    guard_value(false, || Ok(required(control, "control")?.0.is_cancelled()))
}

/// Tells the share of the work that is done, in [0, 1].
///
/// - `control`: not NULL.
///
/// Returns 0 if `control` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_progress(control: Option<&taut_control>) -> f64 {
    guard_value(0.0, || Ok(required(control, "control")?.0.progress()))
}

/// Frees a control; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_free(control: Option<Box<taut_control>>) {
    free(control);
}
