//! The border: what every entry point does about panics, errors and NULL.

use super::types::{SizedStruct, write_sized};
use crate::{Control, Element, Error, Reason, Result, Status};
use libc::c_char;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::CString;
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    /// The last failure on this thread, and its message as C reads it.
    static LAST_FAILURE: RefCell<Option<(Error, CString)>> = const { RefCell::new(None) };
}

/// Runs an entry point: panics become errors, and an error becomes the thread's last one.
pub(super) fn guard(body: impl FnOnce() -> Result<()>) -> Status {
    let outcome = catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| Err(panicked(payload)));
    match outcome {
        Ok(()) => Status::Ok,
        Err(error) => {
            let status = error.status();
            remember(error);
            status
        }
    }
}

/// [`guard`] for an entry point that returns a value: `fallback` on failure.
pub(super) fn guard_value<T>(fallback: T, body: impl FnOnce() -> Result<T>) -> T {
    let mut value = fallback;
    guard(|| {
        value = body()?;
        Ok(())
    });
    value
}

/// [`guard`] for an entry point that makes a handle: `*out` is the handle, or NULL on failure.
///
/// # Safety
/// `out` is NULL or may be written.
pub(super) unsafe fn guard_new<T>(out: *mut *mut T, body: impl FnOnce() -> Result<T>) -> Status {
    guard(|| {
        if out.is_null() {
            return Err(null("out"));
        }
        // SAFETY: `out` is not NULL, so the caller of this function promises that it may be written.
        unsafe { out.write(std::ptr::null_mut()) };
        let handle = Box::into_raw(Box::new(body()?));
        // SAFETY: as above.
        unsafe { out.write(handle) };
        Ok(())
    })
}

/// Frees a handle; NULL is fine.
pub(super) fn free<T>(handle: Option<Box<T>>) {
    guard(|| {
        drop(handle);
        Ok(())
    });
}

/// The parameter `name`, which must not be NULL.
pub(super) fn required<'a, T>(handle: Option<&'a T>, name: &str) -> Result<&'a T> {
    handle.ok_or_else(|| null(name))
}

/// The error of a parameter that is NULL but must not be.
pub(super) fn null(name: &str) -> Error {
    Error::new(Reason::NullPointer, format!("`{name}` is NULL"))
}

/// The caller's control, or a new one that nobody watches.
pub(super) fn control_or_new(control: Option<&super::control::taut_control>) -> Control {
    control.map_or_else(Control::new, |control| control.0.clone())
}

fn panicked(payload: Box<dyn Any + Send>) -> Error {
    let text = match (payload.downcast_ref::<&str>(), payload.downcast_ref::<String>()) {
        (Some(text), _) => (*text).to_owned(),
        (_, Some(text)) => text.clone(),
        _ => "no message".to_owned(),
    };
    std::mem::forget(payload); // its drop may panic again, and then nothing would catch it
    Error::new(Reason::Panic, format!("a defect of the library, please report it: {text}"))
}

fn remember(error: Error) {
    let text = error.to_string().replace('\0', "\u{fffd}");
    let message = CString::new(text).unwrap_or_default();
    // During the thread's exit the slot may be gone; then the message is lost and the status alone remains.
    let _ = LAST_FAILURE.try_with(|last| last.replace(Some((error, message))));
}

/// What kind of element an error is about.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum taut_element {
    /// No single element.
    None = 0,
    /// A vertex of the mesh.
    Vertex = 1,
    /// A face of the input.
    Face = 2,
    /// A row of the sources.
    Source = 3,
    /// A row of the targets.
    Target = 4,
    /// A line of a text file, counted from 1.
    Line = 5,
    /// A row of the levels.
    Level = 6,
    /// A row of the points.
    Point = 7,
}

/// The last failure in detail.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_error {
    /// `sizeof(taut_error)`, set by the caller.
    pub struct_size: usize,
    /// What the failing call returned.
    pub status: Status,
    /// What went wrong, finer than the status.
    pub reason: Reason,
    /// What kind of element is at fault.
    pub element: taut_element,
    /// 0.
    pub reserved: u32,
    /// Which one: counted from 0, a line from 1; 0 where `element` is `TAUT_ELEMENT_NONE`.
    pub index: u64,
}

// SAFETY: repr(C), starts with its size, and no field is read back from the caller.
unsafe impl SizedStruct for taut_error {}

/// Tells what the last failed call on this thread ran into.
///
/// Success never clears it, so look here only after a call has failed.
///
/// - `detail`: NULL, or receives the failure in detail; set `struct_size` before the call. All zero but the size if no
///   call has failed on this thread.
///
/// Returns the message for people, UTF-8, in English, naming the parameter and the element; "" if no call has failed.
/// It stays valid until the next failure on this thread or the thread's end.
///
/// Errors: none. Cost: O(1). Threads: any; each has its own last failure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_last_error(detail: *mut taut_error) -> *const c_char {
    let copy_out = |last: &RefCell<Option<(Error, CString)>>| {
        let last = last.borrow();
        let error = last.as_ref().map(|(error, _)| error_detail(error));
        // SAFETY: the header asks for NULL or a struct of at least the size that it states. Where it is neither, there is
        // no one to tell.
        let _ = unsafe { write_sized(detail, error.as_ref(), "detail") };
        last.as_ref().map_or(c"".as_ptr(), |(_, message)| message.as_ptr())
    };
    LAST_FAILURE.try_with(copy_out).unwrap_or(c"".as_ptr())
}

/// An error as C reads it.
pub(super) fn error_detail(error: &Error) -> taut_error {
    let (element, index) = match error.element() {
        None => (taut_element::None, 0),
        Some(Element::Vertex(i)) => (taut_element::Vertex, i),
        Some(Element::Face(i)) => (taut_element::Face, i),
        Some(Element::Source(i)) => (taut_element::Source, i),
        Some(Element::Target(i)) => (taut_element::Target, i),
        Some(Element::Line(i)) => (taut_element::Line, i),
        Some(Element::Level(i)) => (taut_element::Level, i),
        Some(Element::Point(i)) => (taut_element::Point, i),
    };
    taut_error {
        struct_size: size_of::<taut_error>(),
        status: error.status(),
        reason: error.reason(),
        element,
        reserved: 0,
        index,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::panic, reason = "the test of what a panic does")]
    use super::*;
    use std::ffi::CStr;

    fn last_message() -> String {
        // SAFETY: NULL is allowed, and the message is copied before the next failure.
        let message = unsafe { CStr::from_ptr(taut_last_error(std::ptr::null_mut())) };
        message.to_string_lossy().into_owned()
    }

    #[test]
    fn a_panic_becomes_an_error_and_leaves_no_handle() {
        let mut out = std::ptr::dangling_mut::<u8>();
        // SAFETY: `out` may be written.
        let status = unsafe { guard_new(&raw mut out, || panic!("number {}", 7)) };
        assert_eq!(status, Status::Internal);
        assert!(out.is_null());
        assert!(last_message().ends_with("number 7"));
        assert_eq!(guard(|| panic!("plain")), Status::Internal);
        assert!(last_message().ends_with("plain"));
    }

    #[test]
    fn a_panic_whose_payload_panics_when_dropped_stops_at_the_border() {
        struct Bomb;
        impl Drop for Bomb {
            fn drop(&mut self) {
                panic!("dropped");
            }
        }
        assert_eq!(guard(|| std::panic::panic_any(Bomb)), Status::Internal);
    }

    #[test]
    fn each_thread_has_its_own_last_error() {
        guard(|| Err(null("ours")));
        std::thread::scope(|scope| {
            scope.spawn(|| {
                assert_eq!(last_message(), "");
                guard(|| Err(null("theirs")));
            });
        });
        assert_eq!(last_message(), "`ours` is NULL");
    }

    #[test]
    fn a_zero_byte_in_a_message_does_not_end_it() {
        guard(|| Err(Error::new(Reason::BadArgument, "a\0b")));
        assert_eq!(last_message(), "a\u{fffd}b");
    }
}
