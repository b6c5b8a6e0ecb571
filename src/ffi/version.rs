//! Versions and names.

use crate::Status;
use libc::c_char;
use std::ffi::CStr;

/// Tells the version of the library that runs, for example "0.1.0".
///
/// Returns a string that is valid for ever. Errors: none. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Tells the binary interface of the library that runs; a plug-in that loads it by hand compares it to `TAUT_ABI`.
///
/// Returns the `TAUT_ABI` that the library was built with. Errors: none. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_abi() -> u32 {
    ABI
}

/// The minor version before 1.0, 65536 times the major version after, as in the soname.
const ABI: u32 = match (number(env!("CARGO_PKG_VERSION_MAJOR")), number(env!("CARGO_PKG_VERSION_MINOR"))) {
    (0, minor) => minor,
    (major, _) => major << 16,
};

/// A decimal number, at compile time.
const fn number(digits: &str) -> u32 {
    let mut rest = digits.as_bytes();
    let mut value = 0;
    while let [digit, tail @ ..] = rest {
        value = 10 * value + (*digit - b'0') as u32;
        rest = tail;
    }
    value
}

/// Every status and its name.
const STATUS_NAMES: [(Status, &CStr); 11] = [
    (Status::Ok, c"ok"),
    (Status::InvalidArgument, c"invalid argument"),
    (Status::InvalidMesh, c"invalid mesh"),
    (Status::Io, c"input/output"),
    (Status::Format, c"file format"),
    (Status::Unsupported, c"unsupported"),
    (Status::Numeric, c"numeric"),
    (Status::Cancelled, c"cancelled"),
    (Status::TooLarge, c"too large"),
    (Status::Internal, c"internal"),
    (Status::LimitReached, c"limit reached"),
];

/// Names a status, for example "invalid mesh".
///
/// - `status`: any number, so that a status of a newer library is fine.
///
/// Returns a string that is valid for ever; "unknown" for a number that is no status. Errors: none. Cost: O(1).
/// Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_status_name(status: i32) -> *const c_char {
    let name = STATUS_NAMES.iter().find(|(known, _)| *known as i32 == status);
    name.map_or(c"unknown", |(_, name)| name).as_ptr()
}
