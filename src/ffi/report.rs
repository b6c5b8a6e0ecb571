//! `taut_report`: what is unusual about a mesh, and its properties.

use super::guard::{free, guard, guard_new, guard_value, null, required};
use super::mesh::taut_mesh;
use super::types::{SizedStruct, bad_enum, taut_output, write_sized};
use crate::{Angle, Error, MeshReport, Properties, Reason, Result, Status};

/// The diagnosis of a mesh.
pub struct taut_report(MeshReport);

/// A kind of findings; `taut_report_count` tells how many there are, `taut_report_list` lists them.
pub type taut_finding = u32;
/// Connected parts; a row is the part's smallest vertex. Triangles that share a vertex index belong together.
pub const TAUT_FINDING_COMPONENTS: taut_finding = 1;
/// Parts whose triangles cannot be turned so that neighbours agree; a row is the part's place among the components.
pub const TAUT_FINDING_NONORIENTABLE_COMPONENTS: taut_finding = 2;
/// Chains of edges with one triangle; a row is the number of vertices and 1 if the chain is closed, else 0: then it ends
/// at edges of more than two triangles. `taut_report_boundary_vertices` tells the vertices.
pub const TAUT_FINDING_BOUNDARY_LOOPS: taut_finding = 3;
/// Edges of more than two triangles; a row is the two vertices.
pub const TAUT_FINDING_NONMANIFOLD_EDGES: taut_finding = 4;
/// Vertices whose triangles fall into several fans that touch in the vertex alone.
pub const TAUT_FINDING_NONMANIFOLD_VERTICES: taut_finding = 5;
/// Edges between two triangles of which one is turned over; a row is the two vertices.
pub const TAUT_FINDING_INCONSISTENT_EDGES: taut_finding = 6;
/// Triangles without area, up to the rounding of their coordinates.
pub const TAUT_FINDING_ZERO_AREA_FACES: taut_finding = 7;
/// Triangles that repeat a vertex index, which nothing travels over.
pub const TAUT_FINDING_REPEATED_INDEX_FACES: taut_finding = 8;
/// Triangles with the three vertices of an earlier one; a row is the triangle and that one.
pub const TAUT_FINDING_DUPLICATE_FACES: taut_finding = 9;
/// Vertices at the very place of an earlier one, where the surface is cut; a row is the vertex and that one.
pub const TAUT_FINDING_DUPLICATE_VERTICES: taut_finding = 10;
/// Vertices that no triangle uses.
pub const TAUT_FINDING_UNREFERENCED_VERTICES: taut_finding = 11;

/// An interior angle of a triangle.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_angle {
    /// Its size; NaN where the mesh has no triangle.
    pub radians: f64,
    /// The triangle.
    pub face: u32,
    /// The vertex it is at.
    pub vertex: u32,
}

/// A connected part of a mesh.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_component {
    /// `sizeof(taut_component)`, set by the caller.
    pub struct_size: usize,
    /// V, E and F: its vertices, edges, and triangles that do not repeat an index. V - E + F is its Euler characteristic.
    pub vertices: u32,
    /// See `vertices`.
    pub edges: u32,
    /// See `vertices`.
    pub faces: u32,
    /// Its smallest vertex.
    pub first_vertex: u32,
    /// How many closed boundary loops it has.
    pub boundary_loops: u32,
    /// 1 if its edges have two triangles at most and its vertices one fan each, else 0.
    pub manifold: u32,
    /// 1 if its triangles can be turned so that neighbours agree, else 0.
    pub orientable: u32,
    /// How many handles it has; 0 as well where it is not manifold or not orientable.
    pub genus: u32,
}

// SAFETY: repr(C), starts with its size, and no field is read back from the caller.
unsafe impl SizedStruct for taut_component {}

/// Statistics of a mesh's edges and angles, those of the paper "Wave propagation time optimization for geodesic distances
/// calculation using the Heat Method" (2019). Each edge counts once; lengths in mesh units, angles in radians.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_properties {
    /// `sizeof(taut_properties)`, set by the caller.
    pub struct_size: usize,
    /// Vertices, those that no triangle uses included.
    pub vertices: u64,
    /// Edges.
    pub edges: u64,
    /// Triangles, ignored ones included.
    pub faces: u64,
    /// Mean length of the edges.
    pub mean_edge: f64,
    /// Population variance of the lengths, in squared units.
    pub variance_edge: f64,
    /// Its square root, the standard deviation.
    pub sigma_edge: f64,
    /// Mean distance of a length from the mean.
    pub mean_absolute_deviation: f64,
    /// Median distance of a length from the median.
    pub median_absolute_deviation: f64,
    /// Length of the shortest edge.
    pub min_edge: f64,
    /// Length of the longest edge.
    pub max_edge: f64,
    /// Shortest over longest.
    pub edge_ratio: f64,
    /// Lower quartile of the lengths.
    pub q1: f64,
    /// Their median.
    pub q2: f64,
    /// Their upper quartile.
    pub q3: f64,
    /// (q3 - q1) / 2.
    pub quartile_deviation: f64,
    /// Smallest interior angle.
    pub min_angle: f64,
    /// Largest interior angle.
    pub max_angle: f64,
    /// Mean over the triangles with an area of (half the perimeter * longest edge) / (2 sqrt(3) * area): 1 if all are
    /// equilateral. NaN if none has an area.
    pub anisotropy: f64,
    /// Factor that brings the mesh to the paper's size, a bounding box of the diagonal 24.976.
    pub paper_scale: f64,
}

// SAFETY: repr(C), starts with its size, and no field is read back from the caller.
unsafe impl SizedStruct for taut_properties {}

/// Looks a mesh over. Nothing that is found is an error: both methods answer on every mesh.
///
/// - `mesh`: not NULL; it may be freed afterwards.
/// - `out`: receives the report, to be freed with `taut_report_free`; NULL on failure.
///
/// Errors: none in particular. Cost: O(V log V + F log F). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_report_new(mesh: Option<&taut_mesh>, out: *mut *mut taut_report) -> Status {
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, || Ok(taut_report(MeshReport::new(&required(mesh, "mesh")?.0)))) }
}

/// Tells how many findings of a kind there are.
///
/// - `report`: not NULL.
/// - `finding`: the kind.
///
/// Returns 0 if `report` is NULL or there is no such kind. Cost: linear in their number. Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_report_count(report: Option<&taut_report>, finding: taut_finding) -> usize {
    guard_value(0, || {
        Ok(match findings(&required(report, "report")?.0, finding)? {
            Findings::Single(rows) => rows.len(),
            Findings::Pairs(rows) => rows.len(),
        })
    })
}

/// Lists the findings of a kind, ascending.
///
/// - `report`: not NULL.
/// - `finding`: the kind.
/// - `out`: rows of one index, or of two where the kind's description says so, at least `taut_report_count` of them.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where there is no such kind or an index exceeds the
/// type. Cost: linear in their number. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_report_list(
    report: Option<&taut_report>,
    finding: taut_finding,
    out: taut_output,
) -> Status {
    guard(|| {
        let findings = findings(&required(report, "report")?.0, finding)?;
        // SAFETY: the header asks for a view of writable memory.
        unsafe {
            match findings {
                Findings::Single(rows) => out.write_indices(rows.as_chunks::<1>().0, "out"),
                Findings::Pairs(rows) => out.write_indices(&rows, "out"),
            }
        }
    })
}

/// Tells the vertices of all boundary loops, one loop after the other; TAUT_FINDING_BOUNDARY_LOOPS tells how many each
/// has. The first vertex of a closed loop is not repeated.
///
/// - `report`: not NULL.
/// - `out`: rows of one index, at least as many as all loops have vertices.
///
/// Errors: as for `taut_report_list`. Cost: linear in their number. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_report_boundary_vertices(report: Option<&taut_report>, out: taut_output) -> Status {
    guard(|| {
        let loops = &required(report, "report")?.0.boundary_loops;
        let vertices: Vec<[u32; 1]> = loops.iter().flat_map(|chain| &chain.vertices).map(|&v| [v]).collect();
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_indices(&vertices, "out") }
    })
}

/// Describes one component.
///
/// - `report`: not NULL.
/// - `component`: its place, less than `taut_report_count` of TAUT_FINDING_COMPONENTS.
/// - `out`: not NULL; receives the description; set `struct_size` before the call.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where there is no such component. Cost: O(1). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_report_component(
    report: Option<&taut_report>,
    component: usize,
    out: *mut taut_component,
) -> Status {
    guard(|| {
        let components = &required(report, "report")?.0.components;
        let part = components.get(component).ok_or_else(|| {
            let message = format!("`component` is {component}, but there are {}", components.len());
            Error::new(Reason::BadArgument, message)
        })?;
        let description = taut_component {
            struct_size: size_of::<taut_component>(),
            vertices: part.vertices,
            edges: part.edges,
            faces: part.faces,
            first_vertex: part.first_vertex,
            boundary_loops: part.boundary_loops,
            manifold: u32::from(part.is_manifold),
            orientable: u32::from(part.is_orientable),
            genus: part.genus().unwrap_or(0),
        };
        // SAFETY: the header asks for a struct of at least the size that it states.
        unsafe { write_sized(out, Some(&description), "out") }
    })
}

/// Tells the component of each vertex.
///
/// - `report`: not NULL.
/// - `out`: rows of one index, at least as many as there are vertices; no index for a vertex that no triangle uses.
///
/// Errors: as for `taut_report_list`. Cost: O(V). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_report_component_of(report: Option<&taut_report>, out: taut_output) -> Status {
    guard(|| {
        let component_of = &required(report, "report")?.0.component_of;
        let components: Vec<Option<u32>> = component_of.iter().map(|&c| (c != u32::MAX).then_some(c)).collect();
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_optional_indices(&components, "out") }
    })
}

/// Tells the smallest and the largest interior angle of a triangle that does not repeat an index, and where they are.
///
/// - `report`: not NULL.
/// - `smallest`, `largest`: receive the angles; not NULL.
///
/// Errors: none in particular. Cost: O(1). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_report_angles(
    report: Option<&taut_report>,
    smallest: *mut taut_angle,
    largest: *mut taut_angle,
) -> Status {
    guard(|| {
        let report = &required(report, "report")?.0;
        if smallest.is_null() || largest.is_null() {
            return Err(null(if smallest.is_null() { "smallest" } else { "largest" }));
        }
        // SAFETY: they are not NULL, so the header's promise holds that they are writable.
        unsafe {
            smallest.write_unaligned(angle(report.smallest_angle));
            largest.write_unaligned(angle(report.largest_angle));
        }
        Ok(())
    })
}

/// Frees a report; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_report_free(report: Option<Box<taut_report>>) {
    free(report);
}

/// Computes statistics of a mesh's edges and angles.
///
/// - `mesh`: not NULL.
/// - `out`: not NULL; receives them; set `struct_size` before the call.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where the mesh has no edge. Cost: O(E log E). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_properties(mesh: Option<&taut_mesh>, out: *mut taut_properties) -> Status {
    guard(|| {
        let no_edge = || Error::new(Reason::BadArgument, "`mesh` has no edge, so no properties");
        let properties = Properties::of(&required(mesh, "mesh")?.0).ok_or_else(no_edge)?;
        // SAFETY: the header asks for a struct of at least the size that it states.
        unsafe { write_sized(out, Some(&taut_properties::from(properties)), "out") }
    })
}

impl From<Properties> for taut_properties {
    fn from(properties: Properties) -> Self {
        taut_properties {
            struct_size: size_of::<taut_properties>(),
            vertices: properties.vertices as u64,
            edges: properties.edges as u64,
            faces: properties.faces as u64,
            mean_edge: properties.mean_edge,
            variance_edge: properties.variance_edge,
            sigma_edge: properties.sigma_edge,
            mean_absolute_deviation: properties.mean_absolute_deviation,
            median_absolute_deviation: properties.median_absolute_deviation,
            min_edge: properties.min_edge,
            max_edge: properties.max_edge,
            edge_ratio: properties.edge_ratio,
            q1: properties.q1,
            q2: properties.q2,
            q3: properties.q3,
            quartile_deviation: properties.quartile_deviation,
            min_angle: properties.min_angle,
            max_angle: properties.max_angle,
            anisotropy: properties.anisotropy,
            paper_scale: properties.paper_scale,
        }
    }
}

fn angle(angle: Option<Angle>) -> taut_angle {
    match angle {
        Some(Angle { face, vertex, radians }) => taut_angle { radians, face, vertex },
        None => taut_angle { radians: f64::NAN, face: u32::MAX, vertex: u32::MAX },
    }
}

/// The findings of one kind as rows.
enum Findings {
    Single(Vec<u32>),
    Pairs(Vec<[u32; 2]>),
}

fn findings(report: &MeshReport, finding: taut_finding) -> Result<Findings> {
    // A chain has fewer vertices than there are half-edges, so their number fits.
    let chains = || report.boundary_loops.iter().map(|c| [c.vertices.len() as u32, u32::from(c.is_closed)]).collect();
    Ok(match finding {
        TAUT_FINDING_COMPONENTS => Findings::Single(report.components.iter().map(|part| part.first_vertex).collect()),
        TAUT_FINDING_NONORIENTABLE_COMPONENTS => Findings::Single(report.nonorientable_components()),
        TAUT_FINDING_BOUNDARY_LOOPS => Findings::Pairs(chains()),
        TAUT_FINDING_NONMANIFOLD_EDGES => Findings::Pairs(report.nonmanifold_edges.clone()),
        TAUT_FINDING_NONMANIFOLD_VERTICES => Findings::Single(report.nonmanifold_vertices.clone()),
        TAUT_FINDING_INCONSISTENT_EDGES => Findings::Pairs(report.inconsistent_edges.clone()),
        TAUT_FINDING_ZERO_AREA_FACES => Findings::Single(report.zero_area_faces.clone()),
        TAUT_FINDING_REPEATED_INDEX_FACES => Findings::Single(report.repeated_index_faces.clone()),
        TAUT_FINDING_DUPLICATE_FACES => Findings::Pairs(report.duplicate_faces.clone()),
        TAUT_FINDING_DUPLICATE_VERTICES => Findings::Pairs(report.duplicate_vertices.clone()),
        TAUT_FINDING_UNREFERENCED_VERTICES => Findings::Single(report.unreferenced_vertices.clone()),
        _ => return Err(bad_enum("finding", finding)),
    })
}
