//! What the paper prints, as it prints it, and what of it follows from the rest of it.
//!
//! Numbers keep their printed digits ([`Printed`]). The basic set ([`BASIC`], Tables 1 to 4, 6 and 8) can be had as
//! [`ModelProperties`](crate::ModelProperties), so that whatever is computed for models is computed for the paper's five
//! too; [`Check`] sets that beside what it prints (Tables 7 and 9, Eq. 4). [`VERIFICATION`] is Table 5, with a way to tell
//! which of its models a file is meant to be, and whether it is that very tessellation. [`SLIPS`] are the numbers and
//! sentences that cannot be right.
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open
//! Physics 17 (2019).

mod basic;
mod check;
mod printed;
mod slips;
mod split;
mod verification;

pub use basic::{BASIC, BASIC_SOURCE, BasicMesh, CORRELATIONS, EQUATION_4, PrintedBest, TABLES, is_basic};
pub use check::{Check, basic_rows, recomputed_correlations, recomputed_equation_4, trend};
pub use printed::Printed;
pub use slips::{SLIPS, Slip};
pub use split::midpoint_split;
pub use verification::{FIGURE_11, Figure, HEADLINES, Places, Table5, VERIFICATION, is_own_tessellation, table5};
