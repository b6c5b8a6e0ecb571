//! `taut_heat`: the heat method.

use super::control::taut_control;
use super::guard::{control_or_new, free, guard, guard_new, guard_value, null, required};
use super::mesh::taut_mesh;
use super::places::{source_sets, sources, taut_sources};
use super::types::{SizedStruct, bad_enum, check_reserved, read_sized, taut_input, taut_output, write_sized};
use crate::{
    Error, HeatField, HeatOptions, HeatReport, HeatResiduals, HeatSolver, Laplacian, Reason, Result, Shift, Solver,
    Status, TimeFormula, TimeScale, TimeStep,
};

/// The heat method prepared for one mesh and one time step: operators and their factors. Serves any number of calls.
pub struct taut_heat(HeatSolver);

/// The distances from one set of sources by the heat method.
pub struct taut_heat_field(HeatField);

/// A formula for the time step t, from the edge lengths: their mean e and standard deviation s. 0 means
/// `TAUT_TIME_FORMULA_MEAN_EDGE`. Eq. 1 is Crane, Weischedel and Wardetzky's (Geodesics in Heat, 2013), the others are
/// from "Wave propagation time optimization for geodesic distances calculation using the Heat Method" (2019).
pub type taut_time_formula = u32;
/// t = e^2 (Eq. 1).
pub const TAUT_TIME_FORMULA_MEAN_EDGE: taut_time_formula = 1;
/// t = s (Eq. 2).
pub const TAUT_TIME_FORMULA_SIGMA: taut_time_formula = 2;
/// t = (e^2 + s) / 2 (Eq. 3).
pub const TAUT_TIME_FORMULA_MEAN_SIGMA: taut_time_formula = 3;
/// t = 1.01204 s - 0.0001 (Eq. 4).
pub const TAUT_TIME_FORMULA_MEDIAN_FIT: taut_time_formula = 4;
/// t = (e^2 + 1.01204 s - 0.0001) / 2 (Eq. 5).
pub const TAUT_TIME_FORMULA_MEDIAN_MEAN: taut_time_formula = 5;

/// The size that a formula is evaluated at, which matters because Eq. 2 to 5 set an area to lengths. t itself is always
/// in mesh units squared. 0 means `TAUT_TIME_SCALE_PAPER`.
pub type taut_time_scale = u32;
/// A bounding box with the diagonal 24.976, for which Eq. 2 to 5 were found.
pub const TAUT_TIME_SCALE_PAPER: taut_time_scale = 1;
/// The mesh's own units.
pub const TAUT_TIME_SCALE_RAW: taut_time_scale = 2;

/// Which Laplacian diffuses the heat. 0 means `TAUT_LAPLACIAN_INTRINSIC`.
pub type taut_laplacian = u32;
/// Cotangents of the intrinsic Delaunay triangulation: the same surface with better triangles.
pub const TAUT_LAPLACIAN_INTRINSIC: taut_laplacian = 1;
/// Cotangents of the mesh's own triangles.
pub const TAUT_LAPLACIAN_PLAIN: taut_laplacian = 2;

/// How the distances get their zero. 0 means `TAUT_SHIFT_PINNED`.
pub type taut_shift = u32;
/// Each source has its start distance, unless another one reaches it sooner along edges; at the corners around a point or
/// a curve the distance is the straight way.
pub const TAUT_SHIFT_PINNED: taut_shift = 1;
/// The least distance of each component is moved to the least start distance.
pub const TAUT_SHIFT_MIN: taut_shift = 2;

/// Which code factors the sparse matrices. 0 means `TAUT_SOLVER_SUPERNODAL`.
pub type taut_solver = u32;
/// Supernodal Cholesky, A = L Lᵀ.
pub const TAUT_SOLVER_SUPERNODAL: taut_solver = 1;
/// sprs-ldl; only where the library was built with it, else TAUT_REASON_MISSING_FEATURE.
pub const TAUT_SOLVER_LDL: taut_solver = 2;

/// The time step t of the heat flow: a formula times a factor, or a value. All zero is the default.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_time_step {
    /// The formula; must be 0 if `value` is set.
    pub formula: taut_time_formula,
    /// Its scale; must be 0 if `value` is set.
    pub scale: taut_time_scale,
    /// Multiplies what the formula gives, positive; 0 means 1. Must be 0 if `value` is set.
    pub factor: f64,
    /// t itself in mesh units squared, positive; 0 means to use the formula.
    pub value: f64,
}

/// Options of `taut_heat_new`. All zero but the size is the default.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_heat_options {
    /// `sizeof(taut_heat_options)`.
    pub struct_size: usize,
    /// The time step.
    pub time_step: taut_time_step,
    /// Heat at the mesh's boundary: from 0, no flow across (Neumann), to 1, kept at zero (Dirichlet).
    pub boundary: f64,
    /// The Laplacian.
    pub laplacian: taut_laplacian,
    /// The zero of the distances.
    pub shift: taut_shift,
    /// The solver.
    pub solver: taut_solver,
    /// 0.
    pub reserved: u32,
}

// SAFETY: repr(C), starts with its size; integers and floats are valid for any bytes, and no padding follows them.
unsafe impl SizedStruct for taut_heat_options {}

/// What preparing the heat method did to the triangulation, and how long its stages took, by the clock; 0 seconds for those
/// that another `taut_heat` had done.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_heat_report {
    /// `sizeof(taut_heat_report)`, set by the caller.
    pub struct_size: usize,
    /// How many edges were flipped; 0 with `TAUT_LAPLACIAN_PLAIN`.
    pub flips: u64,
    /// How many triangles are there twice, once for each side of the surface, because an edge had to flip near a boundary,
    /// near more than two triangles on an edge, or near the seam of a one-sided surface; 0 with `TAUT_LAPLACIAN_PLAIN`.
    pub doubled_triangles: u64,
    /// How many edges are not Delaunay in the end, because rounding on needles does not let them flip, or because flips
    /// ended; 0 with `TAUT_LAPLACIAN_PLAIN`.
    pub stuck_edges: u64,
    /// 1 if flips were ended by their bound, 50 per edge, before nothing was left to flip; else 0.
    pub flip_bound_reached: u32,
    /// 1 if all edges were lengthened a little, because some triangle had (almost) no area; else 0.
    pub mollified: u32,
    /// Edge lengths, mollification and edge flips.
    pub delaunay_seconds: f64,
    /// The matrices.
    pub assembly_seconds: f64,
    /// Their fill-reducing ordering.
    pub order_seconds: f64,
    /// Where their factors have entries.
    pub symbolic_seconds: f64,
    /// The factor for the distances.
    pub poisson_seconds: f64,
    /// The factor for the heat; two with a boundary blend.
    pub heat_seconds: f64,
}

// SAFETY: repr(C), starts with its size, and no field is read back from the caller.
unsafe impl SizedStruct for taut_heat_report {}

/// How well the two systems of a field are solved: the largest entry of b - A x, as a share of the largest entry of b.
/// Rounding leaves about 1e-15 times the number of edges at a vertex; much more means that the matrix is close to singular.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_heat_residuals {
    /// `sizeof(taut_heat_residuals)`, set by the caller.
    pub struct_size: usize,
    /// Of the heat: (M + t L) u = δ.
    pub heat: f64,
    /// Of the distances: L φ = -∇·X, where they are not known beforehand.
    pub poisson: f64,
}

// SAFETY: repr(C), starts with its size, and no field is read back from the caller.
unsafe impl SizedStruct for taut_heat_residuals {}

/// Tells the time step t that a mesh gets, without preparing anything.
///
/// - `mesh`: not NULL.
/// - `time_step`: all zero means the default.
/// - `out`: not NULL; receives t in mesh units squared.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where the fields of the time step exclude each other; TAUT_REASON_BAD_TIME_STEP where t
/// is not positive and finite, or a formula says nothing about this mesh. Cost: O(F). Threads:
/// any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_time_step_value(
    mesh: Option<&taut_mesh>,
    time_step: taut_time_step,
    out: *mut f64,
) -> Status {
    guard(|| {
        let value = time_step_of(&time_step)?.value(&required(mesh, "mesh")?.0)?;
        if out.is_null() {
            return Err(null("out"));
        }
        // SAFETY: it is not NULL, and the header asks for a writable double.
        unsafe { out.write_unaligned(value) };
        Ok(())
    })
}

/// Prepares the heat method for a mesh.
///
/// - `mesh`: not NULL; it may be freed afterwards.
/// - `options`: NULL means the default.
/// - `control`: progress, cancellation and a time limit, or NULL.
/// - `out`: receives the prepared method, to be freed with `taut_heat_free`; NULL on failure.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT names the option; TAUT_REASON_BAD_TIME_STEP; TAUT_REASON_MISSING_FEATURE where the
/// library was built without the solver; TAUT_REASON_NOT_POSITIVE_DEFINITE where a factorisation breaks down;
/// TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: two sparse Cholesky
/// factorisations, about O(V^1.5) time and O(V log V) memory. Threads: any. The control is consulted between the steps
/// and, some milliseconds apart, inside the factorisations (`TAUT_SOLVER_LDL`: not inside).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_new(
    mesh: Option<&taut_mesh>,
    options: *const taut_heat_options,
    control: Option<&taut_control>,
    out: *mut *mut taut_heat,
) -> Status {
    let body = || {
        let mesh = required(mesh, "mesh")?;
        // SAFETY: the header asks for NULL or a struct of the size that it states.
        let options = unsafe { read_sized(options, "options")? };
        Ok(taut_heat(HeatSolver::new(&mesh.0, &heat_options(&options)?, &control_or_new(control))?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Prepares the heat method for another time step, sharing everything that does not depend on it.
///
/// - `heat`: not NULL; it stays as it is and may be freed before the new one.
/// - `time_step`: all zero means the default, not that of `heat`.
/// - `control`: progress, cancellation and a time limit, or NULL.
/// - `out`: receives the prepared method, to be freed with `taut_heat_free`; NULL on failure.
///
/// Errors: as for `taut_time_step_value`; TAUT_REASON_NOT_POSITIVE_DEFINITE where the factorisation breaks down;
/// TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: one numeric factorisation, a fraction of `taut_heat_new`.
/// Threads: any. The control is consulted as by `taut_heat_new`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_with_time_step(
    heat: Option<&taut_heat>,
    time_step: taut_time_step,
    control: Option<&taut_control>,
    out: *mut *mut taut_heat,
) -> Status {
    let body = || {
        let heat = required(heat, "heat")?;
        Ok(taut_heat(heat.0.with_time_step(&time_step_of(&time_step)?, &control_or_new(control))?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Prepares the heat method for the same triangles in another place, with the options of `taut_heat_new`: its time step as
/// well, not one of `taut_heat_with_time_step`.
///
/// - `heat`: not NULL; it stays as it is and may be freed before the new one.
/// - `mesh`: not NULL; as `taut_mesh_with_positions` makes it. It may be freed afterwards.
/// - `control`: progress, cancellation and a time limit, or NULL.
/// - `out`: receives the prepared method, to be freed with `taut_heat_free`; NULL on failure.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where the mesh has other triangles; else as for `taut_heat_new`. Cost: that of
/// `taut_heat_new` less the ordering of the matrices and, where no other edges are flipped than before, less their
/// analysis. Threads: any. The control is consulted as by `taut_heat_new`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_with_mesh(
    heat: Option<&taut_heat>,
    mesh: Option<&taut_mesh>,
    control: Option<&taut_control>,
    out: *mut *mut taut_heat,
) -> Status {
    let body = || {
        let (heat, mesh) = (required(heat, "heat")?, required(mesh, "mesh")?);
        Ok(taut_heat(heat.0.with_mesh(&mesh.0, &control_or_new(control))?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Tells the time step t that a method was prepared for, in mesh units squared.
///
/// - `heat`: not NULL.
///
/// Returns 0 if `heat` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_heat_time_step(heat: Option<&taut_heat>) -> f64 {
    guard_value(0.0, || Ok(required(heat, "heat")?.0.time_step()))
}

/// Tells what the preparation did to the triangulation, and how long its stages took.
///
/// - `heat`: not NULL.
/// - `out`: not NULL; receives it; set `struct_size` before the call.
///
/// Errors: none in particular. Cost: O(1). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_report_of(heat: Option<&taut_heat>, out: *mut taut_heat_report) -> Status {
    guard(|| {
        let report = required(heat, "heat")?.0.report();
        // SAFETY: the header asks for a struct of at least the size that it states.
        unsafe { write_sized(out, Some(&taut_heat_report::from(report)), "out") }
    })
}

impl From<HeatReport> for taut_heat_report {
    fn from(report: HeatReport) -> Self {
        let times = report.times;
        taut_heat_report {
            struct_size: size_of::<taut_heat_report>(),
            flips: report.flips,
            doubled_triangles: report.doubled_triangles,
            stuck_edges: report.stuck_edges,
            flip_bound_reached: u32::from(report.flip_bound_reached),
            mollified: u32::from(report.mollified),
            delaunay_seconds: times.delaunay.as_secs_f64(),
            assembly_seconds: times.assembly.as_secs_f64(),
            order_seconds: times.order.as_secs_f64(),
            symbolic_seconds: times.symbolic.as_secs_f64(),
            poisson_seconds: times.poisson.as_secs_f64(),
            heat_seconds: times.heat.as_secs_f64(),
        }
    }
}

/// Frees a prepared heat method; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_heat_free(heat: Option<Box<taut_heat>>) {
    free(heat);
}

/// Computes the distances from a set of sources by the heat method: approximate, smooth, fast for many calls.
///
/// - `heat`: not NULL.
/// - `sources`: where to measure from; not NULL, at least one.
/// - `control`: progress, cancellation and a time limit, or NULL.
/// - `out`: receives the field, to be freed with `taut_heat_field_free`; NULL on failure.
///
/// Errors: TAUT_REASON_NO_SOURCE; TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_REASON_BAD_ARGUMENT and, with `boundary` 1,
/// TAUT_REASON_SOURCE_ON_BOUNDARY name the source; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: a few sparse
/// triangular solves, about O(V log V); with `TAUT_SHIFT_PINNED` also a short one for each vertex of a source or, for more
/// than 256 in one component, a factorisation. Threads: any, also on one `heat` at once. The control is consulted between
/// the steps, not inside a solve.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_field_new(
    heat: Option<&taut_heat>,
    sources: *const taut_sources,
    control: Option<&taut_control>,
    out: *mut *mut taut_heat_field,
) -> Status {
    let body = || {
        let heat = required(heat, "heat")?;
        // SAFETY: the header asks for a struct of the size that it states, and views of readable memory.
        let sources = unsafe { self::sources(sources)? };
        Ok(taut_heat_field(heat.0.field(&sources, &control_or_new(control))?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Tells the distance of every vertex.
///
/// - `field`: not NULL.
/// - `out`: rows of one real number, at least as many as there are vertices; mesh units. +INFINITY where no source
///   reaches.
///
/// `taut_descent_paths_new` follows these distances back to a source.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(V). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_field_distances(field: Option<&taut_heat_field>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_scalars(required(field, "field")?.0.distances().as_chunks::<1>().0, "out") })
}

/// Tells the nearest source of every vertex, by its number among the sources: the one to which steepest descent leads.
///
/// - `field`: not NULL.
/// - `out`: rows of one index, at least as many as there are vertices; no index where no source reaches.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where a number exceeds the type. Cost: O(V log V).
/// Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_field_nearest_sources(field: Option<&taut_heat_field>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_optional_indices(&required(field, "field")?.0.nearest_sources(), "out") })
}

/// Tells at how many vertices that a source reaches heat was not positive. There the direction is doubtful: cotangents are
/// negative nearby, by `TAUT_LAPLACIAN_PLAIN` or at edges that could not be flipped.
///
/// - `field`: not NULL.
///
/// Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_heat_field_nonpositive_heat(field: Option<&taut_heat_field>) -> u64 {
    guard_value(0, || Ok(required(field, "field")?.0.nonpositive_heat()))
}

/// Tells how often heat had to start anew, because it had faded below the numbers that there are.
///
/// - `field`: not NULL.
///
/// Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_heat_field_restarts(field: Option<&taut_heat_field>) -> u32 {
    guard_value(0, || Ok(required(field, "field")?.0.restarts()))
}

/// Frees a field; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_heat_field_free(field: Option<Box<taut_heat_field>>) {
    free(field);
}

/// Computes a field once more, and tells how well its systems are solved.
///
/// - `heat`, `sources`, `control`: as for `taut_heat_field_new`.
/// - `out`: not NULL; receives the residuals; set `struct_size` before the call.
///
/// Errors: as for `taut_heat_field_new`. Cost: about twice that of `taut_heat_field_new`. Threads: any, also on one `heat`
/// at once. The control is consulted between the steps.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_residuals_of(
    heat: Option<&taut_heat>,
    sources: *const taut_sources,
    control: Option<&taut_control>,
    out: *mut taut_heat_residuals,
) -> Status {
    guard(|| {
        let heat = &required(heat, "heat")?.0;
        if out.is_null() {
            return Err(null("out"));
        }
        // SAFETY: the header asks for a struct of the size that it states, and views of readable memory.
        let sources = unsafe { self::sources(sources)? };
        let HeatResiduals { heat, poisson } = heat.residuals(&sources, &control_or_new(control))?;
        let residuals = taut_heat_residuals { struct_size: size_of::<taut_heat_residuals>(), heat, poisson };
        // SAFETY: the header asks for a struct of at least the size that it states.
        unsafe { write_sized(out, Some(&residuals), "out") }
    })
}

/// Computes the distances of every vertex from each of several sources, or sets of sources, by the heat method: one field
/// for each.
///
/// - `heat`: not NULL.
/// - `sources`, `set_offsets`, `threads`: as for `taut_exact_distance_rows`. The distances are the same, to the bit, as
///   those of `taut_heat_field_new`.
/// - `control`: progress, cancellation and a time limit, or NULL.
/// - `out`: rows of as many real numbers as there are vertices, at least one row for each set, in their order; mesh units.
///   +INFINITY where the set does not reach.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where the offsets are no such numbers; TAUT_REASON_NO_SOURCE where a set has none;
/// TAUT_REASON_BUFFER_TOO_SMALL, before anything is computed; else as for `taut_heat_field_new`. Cost: half of that of
/// `taut_heat_field_new` for each set, as eight are solved for at once; and 8 bytes for each number until all are there.
/// Threads: any, also on one `heat` at once. The control is consulted between the steps.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_heat_distance_rows(
    heat: Option<&taut_heat>,
    sources: *const taut_sources,
    set_offsets: taut_input,
    threads: usize,
    control: Option<&taut_control>,
    out: taut_output,
) -> Status {
    guard(|| {
        let heat = &required(heat, "heat")?.0;
        // SAFETY: the header asks for a struct of the size that it states, and views of readable memory.
        let sets = unsafe { source_sets(sources, set_offsets)? };
        let vertex_count = heat.mesh().vertex_count();
        out.scalar_layout(sets.len(), vertex_count, "out")?;
        let rows = heat.distance_rows(&sets, threads, &control_or_new(control))?;
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_scalar_rows(&rows, vertex_count, "out") }
    })
}

fn heat_options(options: &taut_heat_options) -> Result<HeatOptions> {
    let laplacian = match options.laplacian {
        0 | TAUT_LAPLACIAN_INTRINSIC => Laplacian::Intrinsic,
        TAUT_LAPLACIAN_PLAIN => Laplacian::Plain,
        other => return Err(bad_enum("options.laplacian", other)),
    };
    let shift = match options.shift {
        0 | TAUT_SHIFT_PINNED => Shift::Pinned,
        TAUT_SHIFT_MIN => Shift::Min,
        other => return Err(bad_enum("options.shift", other)),
    };
    let solver = match options.solver {
        0 | TAUT_SOLVER_SUPERNODAL => Solver::Supernodal,
        TAUT_SOLVER_LDL => Solver::Ldl,
        other => return Err(bad_enum("options.solver", other)),
    };
    check_reserved(options.reserved, "options")?;
    let time_step = time_step_of(&options.time_step)?;
    Ok(HeatOptions { laplacian, solver, time_step, boundary: options.boundary, shift })
}

fn time_step_of(step: &taut_time_step) -> Result<TimeStep> {
    if step.value != 0.0 {
        return match (step.formula, step.scale, step.factor) {
            (0, 0, 0.0) => Ok(TimeStep::Value(step.value)),
            _ => {
                let message = "`time_step.value` excludes a formula, a scale and a factor";
                Err(Error::new(Reason::BadArgument, message))
            }
        };
    }
    let formula = match step.formula {
        0 | TAUT_TIME_FORMULA_MEAN_EDGE => TimeFormula::MeanEdge,
        TAUT_TIME_FORMULA_SIGMA => TimeFormula::Sigma,
        TAUT_TIME_FORMULA_MEAN_SIGMA => TimeFormula::MeanSigma,
        TAUT_TIME_FORMULA_MEDIAN_FIT => TimeFormula::MedianFit,
        TAUT_TIME_FORMULA_MEDIAN_MEAN => TimeFormula::MedianMean,
        other => return Err(bad_enum("time_step.formula", other)),
    };
    let scale = match step.scale {
        0 | TAUT_TIME_SCALE_PAPER => TimeScale::Paper,
        TAUT_TIME_SCALE_RAW => TimeScale::Raw,
        other => return Err(bad_enum("time_step.scale", other)),
    };
    Ok(TimeStep::Formula { formula, scale, factor: if step.factor == 0.0 { 1.0 } else { step.factor } })
}
