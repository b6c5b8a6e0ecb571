//! `taut_control`: progress, cancellation and limits.

use super::guard::{free, guard, guard_new, guard_value, required};
use crate::{Control, Error, Reason, Result, Status};
use libc::{c_int, c_void};
use std::ops::ControlFlow;
use std::time::Duration;

/// Watches, limits and cancels a long call from any thread.
pub struct taut_control(pub(super) Control);

/// A function of yours that is told the progress, in [0, 1], and the `user` that was set with it.
///
/// It returns 0 to go on; any other number cancels the call. It must return: no exception, no `longjmp`.
pub type taut_callback = Option<unsafe extern "C" fn(progress: f64, user: *mut c_void) -> c_int>;

/// Makes a control, at progress 0, not cancelled, without limits or callback.
///
/// Use a new one for each call, or one for several calls that share a limit.
///
/// - `out`: receives the control; free it with `taut_control_free` once the call that uses it has returned.
///
/// Errors: none in particular. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_control_new(out: *mut *mut taut_control) -> Status {
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, || Ok(taut_control(Control::new()))) }
}

/// Asks the call that uses the control to stop: at its next check it ends with TAUT_STATUS_CANCELLED.
///
/// A call that starts with a cancelled control stops at once; one that has just ended is not undone.
///
/// - `control`: not NULL.
///
/// Errors: none in particular. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_cancel(control: Option<&taut_control>) {
    guard(|| {
        required(control, "control")?.0.cancel();
        Ok(())
    });
}

/// Tells whether `taut_control_cancel` was called or a callback has cancelled.
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

/// Limits the time: a call that uses the control ends with TAUT_REASON_TIME_LIMIT at its first check after so many seconds
/// from now.
///
/// A later limit takes the place of an earlier one, also while a call runs.
///
/// - `control`: not NULL.
/// - `seconds`: not negative; 0 means no limit, as does +INFINITY.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where `seconds` is negative or NaN. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_set_time_limit(control: Option<&taut_control>, seconds: f64) -> Status {
    guard(|| {
        let control = required(control, "control")?;
        control.0.set_time_limit(if seconds == 0.0 { Duration::MAX } else { duration(seconds)? });
        Ok(())
    })
}

/// A number of seconds of the caller's.
fn duration(seconds: f64) -> Result<Duration> {
    match Duration::try_from_secs_f64(seconds) {
        Ok(duration) => Ok(duration),
        // More than 500 billion years.
        Err(_) if seconds > 0.0 => Ok(Duration::MAX),
        Err(_) => Err(Error::new(Reason::BadArgument, format!("`seconds` is {seconds}, which is not a time"))),
    }
}

/// Limits the memory that a call takes beyond its mesh and what was prepared: it ends with TAUT_REASON_MEMORY_LIMIT at its
/// first check beyond the limit.
///
/// Only calls that compute exact distances count their memory: each of their threads by itself, and without the rows
/// that they gather. To other calls this makes no difference.
///
/// - `control`: not NULL.
/// - `bytes`: 0 means no limit.
///
/// Errors: none in particular. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_set_memory_limit(control: Option<&taut_control>, bytes: usize) -> Status {
    guard(|| {
        required(control, "control")?.0.set_memory_limit(if bytes == 0 { usize::MAX } else { bytes });
        Ok(())
    })
}

/// Lets a call that uses the control tell its progress to a function of yours, at each of its checks or, after
/// `taut_control_set_callback_interval`, less often; on the thread that makes the call and no other.
///
/// - `control`: not NULL.
/// - `callback`: may use the control; it is not called again while it runs. NULL means none.
/// - `user`: handed to the callback as it is; may be NULL. It must stay valid until the callback is replaced or the
///   control freed, and no call uses the control any more.
///
/// Errors: none in particular. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_control_set_callback(
    control: Option<&taut_control>,
    callback: taut_callback,
    user: *mut c_void,
) -> Status {
    guard(|| {
        let control = required(control, "control")?;
        let user = User(user);
        control.0.set_callback(move |progress| {
            // SAFETY: the header asks for a function of this type and a `user` that it may be called with.
            let answer = callback.map_or(0, |callback| unsafe { callback(progress, user.pointer()) });
            if answer == 0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        Ok(())
    })
}

/// Lets the callback rest: from one time that it is called to the next at least so long goes by, but for the end of the work,
/// at progress 1, which is always told. For a callback that is not done within a microsecond.
///
/// - `control`: not NULL.
/// - `seconds`: not negative; 0, which is the default, means that it is called at each check.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where `seconds` is negative or NaN. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_set_callback_interval(control: Option<&taut_control>, seconds: f64) -> Status {
    guard(|| {
        required(control, "control")?.0.set_callback_interval(duration(seconds)?);
        Ok(())
    })
}

/// A pointer of the caller's.
struct User(*mut c_void);

// SAFETY: we only hand it back. That its callback may run on another thread than the one it was set on, the one that
// makes the call, is what the header says.
unsafe impl Send for User {}

impl User {
    /// A method, so that a closure holds the whole of it, which is Send, and not the field.
    fn pointer(&self) -> *mut c_void {
        self.0
    }
}

/// Frees a control; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_control_free(control: Option<Box<taut_control>>) {
    free(control);
}
