//! The C interface: one file per handle, and the only `unsafe` of the crate.
//!
//! Every entry point that can fail has the same shape: [`guard`] catches panics and keeps the error for
//! `taut_last_error`; [`types`] and [`places`] turn views, sized structs and sources into the crate's own; the work is
//! one call of the public Rust API. Doc comments of public items here are the C manual: `tests/header.rs` makes
//! `include/taut.h` of them.
//!
//! What an entry point asks of its pointers stands once, in the header's preamble: a handle is NULL or alive, a view
//! describes memory that the caller owns, a sized struct has the size that it states, `out` is NULL or writable.
//!
//! A handle that may be NULL is an `Option<&T>` or `Option<Box<T>>`, which C sees as a plain pointer. Pointers to sized
//! structs stay raw: an older caller's struct is shorter than ours, so a reference to it would claim too much.
#![allow(unsafe_code, reason = "C hands us raw memory; every block says why it may be touched")]
#![allow(unreachable_pub, reason = "`pub` is for the linker and cbindgen; Rust callers have the safe API")]
#![allow(non_camel_case_types, reason = "these are the names that C sees")]
#![deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

mod batch;
mod closest;
mod control;
mod curves;
mod exact;
mod guard;
mod heat;
mod lines;
mod mesh;
mod places;
mod report;
mod types;
mod version;
