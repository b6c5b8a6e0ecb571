//! What is unusual about a mesh: holes, places that are not manifold, faces and vertices that look like mistakes.
//!
//! Nothing here is an error: both methods answer on every mesh. But a distance that surprises often has its reason in one
//! of these lists. Each names elements by the numbers of the input.
//!
//! O(V + F) time and memory, but for the search for duplicates, which sorts.

mod boundary;
mod properties;

use crate::mesh::Mesh;
use crate::mesh::fan::{Fan, fan};
use crate::mesh::topology::{NONE, next, prev, start};
use crate::metric::{Scale, cross, dot, minus};

pub use boundary::BoundaryLoop;
pub use properties::{Angle, Properties};

/// The diagnosis of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshReport {
    /// The connected parts: triangles that share a vertex index belong together. Ordered by their smallest vertex.
    pub components: Vec<Component>,
    /// The component of each vertex, by its place in `components`; `u32::MAX` for an unreferenced vertex.
    pub component_of: Vec<u32>,
    /// The holes and rims: chains of edges that have one triangle only.
    pub boundary_loops: Vec<BoundaryLoop>,
    /// Edges of more than two triangles, by their two vertices.
    pub nonmanifold_edges: Vec<[u32; 2]>,
    /// Vertices whose triangles fall into several fans, which touch in the vertex alone.
    pub nonmanifold_vertices: Vec<u32>,
    /// Edges between two triangles of which one is turned over, by their two vertices.
    pub inconsistent_edges: Vec<[u32; 2]>,
    /// Triangles that repeat a vertex index; nothing travels over them.
    pub repeated_index_faces: Vec<u32>,
    /// Triangles without area, up to the rounding of their coordinates; those that repeat an index are not listed here.
    pub zero_area_faces: Vec<u32>,
    /// Triangles with the same three vertices as an earlier one, in any order, and that one.
    pub duplicate_faces: Vec<[u32; 2]>,
    /// Vertices at the very position of an earlier one, and that one. The mesh is not connected there.
    pub duplicate_vertices: Vec<[u32; 2]>,
    /// Vertices that no triangle uses; their distance is +inf.
    pub unreferenced_vertices: Vec<u32>,
    /// The smallest angle of a triangle that does not repeat an index, and where it is.
    pub smallest_angle: Option<Angle>,
    /// The largest such angle.
    pub largest_angle: Option<Angle>,
}

/// A connected part of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Component {
    /// Its smallest vertex.
    pub first_vertex: u32,
    /// How many vertices it has.
    pub vertices: u32,
    /// How many edges it has.
    pub edges: u32,
    /// How many triangles it has, without those that repeat an index.
    pub faces: u32,
    /// How many closed boundary loops it has.
    pub boundary_loops: u32,
    /// Whether its edges have two triangles at most and its vertices one fan each.
    pub is_manifold: bool,
    /// Whether its triangles can all be turned so that neighbours agree. A Möbius strip's cannot.
    pub is_orientable: bool,
}

impl Component {
    /// The Euler characteristic V - E + F.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        i64::from(self.vertices) - i64::from(self.edges) + i64::from(self.faces)
    }

    /// How many handles a manifold, orientable component has: (2 - χ - boundary loops) / 2.
    #[must_use]
    pub fn genus(&self) -> Option<u32> {
        let twice = 2 - self.euler_characteristic() - i64::from(self.boundary_loops);
        let is_surface = self.is_manifold && self.is_orientable;
        if is_surface { u32::try_from(twice / 2).ok() } else { None }
    }
}

impl MeshReport {
    /// Looks a mesh over.
    #[must_use]
    pub fn new(mesh: &Mesh) -> MeshReport {
        let topology = mesh.topology();
        let positions = Scale::of(mesh).unit_positions(mesh);
        let [smallest_angle, largest_angle] = properties::extreme_angles(mesh, &positions);
        let mut report = MeshReport {
            components: vec![],
            component_of: topology.component.clone(),
            boundary_loops: boundary::loops(mesh),
            nonmanifold_edges: edges_where(mesh, |row| row.len() > 2),
            nonmanifold_vertices: nonmanifold_vertices(mesh),
            inconsistent_edges: edges_where(mesh, |row| agree(mesh, row) == Some(false)),
            repeated_index_faces: mesh.ignored_triangles().to_vec(),
            zero_area_faces: zero_area_faces(mesh, &positions),
            duplicate_faces: duplicate_faces(mesh),
            duplicate_vertices: duplicate_vertices(mesh),
            unreferenced_vertices: (0..)
                .zip(&topology.component)
                .filter(|(_, c)| **c == NONE)
                .map(|(v, _)| v)
                .collect(),
            smallest_angle,
            largest_angle,
        };
        report.components = components(mesh, &report);
        report
    }

    /// The components that cannot be oriented, by their places in `components`.
    #[must_use]
    pub fn nonorientable_components(&self) -> Vec<u32> {
        (0..).zip(&self.components).filter(|(_, part)| !part.is_orientable).map(|(i, _)| i).collect()
    }
}

fn edges_where(mesh: &Mesh, is_wanted: impl Fn(&[u32]) -> bool) -> Vec<[u32; 2]> {
    let topology = mesh.topology();
    (0..).zip(&topology.edges).filter(|&(e, _)| is_wanted(topology.halfedges.row(e))).map(|(_, &ends)| ends).collect()
}

/// Whether the two triangles on an edge run along it in opposite directions, as neighbours do that face the same way;
/// None where there are not two.
fn agree(mesh: &Mesh, halfedges: &[u32]) -> Option<bool> {
    match halfedges {
        &[a, b] => Some(start(mesh.triangles(), a) != start(mesh.triangles(), b)),
        _ => None,
    }
}

fn components(mesh: &Mesh, report: &MeshReport) -> Vec<Component> {
    let topology = mesh.topology();
    let start = Component { first_vertex: NONE, is_manifold: true, ..Component::default() };
    let mut components = vec![start; topology.component_count as usize];
    let of = |v: u32| topology.component[v as usize] as usize;
    for (v, _) in (0..).zip(&topology.component).filter(|(_, c)| **c != NONE) {
        let component = &mut components[of(v)];
        component.first_vertex = component.first_vertex.min(v);
        component.vertices += 1;
    }
    topology.edges.iter().for_each(|edge| components[of(edge[0])].edges += 1);
    used_triangles(mesh).for_each(|(_, triangle)| components[of(triangle[0])].faces += 1);
    let closed = report.boundary_loops.iter().filter(|chain| chain.is_closed);
    closed.for_each(|chain| components[of(chain.vertices[0])].boundary_loops += 1);
    report.nonmanifold_edges.iter().for_each(|edge| components[of(edge[0])].is_manifold = false);
    report.nonmanifold_vertices.iter().for_each(|&v| components[of(v)].is_manifold = false);
    components.iter_mut().zip(orientable(mesh)).for_each(|(component, is)| component.is_orientable = is);
    components
}

/// The triangles that do not repeat an index, with their numbers.
fn used_triangles(mesh: &Mesh) -> impl Iterator<Item = (u32, [u32; 3])> {
    let mut ignored = mesh.ignored_triangles().iter().peekable();
    (0..).zip(mesh.triangles().iter().copied()).filter(move |(f, _)| ignored.next_if_eq(&f).is_none())
}

/// Of each component, whether its triangles can be turned so that neighbours agree. Edges of more than two triangles
/// bind nothing.
fn orientable(mesh: &Mesh) -> Vec<bool> {
    let topology = mesh.topology();
    let mut orientable = vec![true; topology.component_count as usize];
    let mut turned: Vec<Option<bool>> = vec![None; mesh.triangle_count()];
    let mut stack = Vec::new();
    for (seed, triangle) in used_triangles(mesh) {
        if turned[seed as usize].is_none() {
            turned[seed as usize] = Some(false);
            stack.push((seed, false));
        }
        while let Some((f, is_turned)) = stack.pop() {
            for h in 3 * f..3 * f + 3 {
                let row = topology.halfedges.row(topology.edge_of[h as usize]);
                let Some(agree) = agree(mesh, row) else { continue };
                let neighbour = if row[0] == h { row[1] / 3 } else { row[0] / 3 };
                let needed = is_turned == agree;
                match turned[neighbour as usize] {
                    None => {
                        turned[neighbour as usize] = Some(needed);
                        stack.push((neighbour, needed));
                    }
                    Some(found) if found != needed => {
                        orientable[topology.component[triangle[0] as usize] as usize] = false;
                    }
                    Some(_) => {}
                }
            }
        }
    }
    orientable
}

fn nonmanifold_vertices(mesh: &Mesh) -> Vec<u32> {
    let mut order = Vec::new();
    let mut is_no_fan = |v: u32| fan(mesh, v, &mut order) == Fan::Other;
    (0..mesh.topology().corners.rows()).filter(|&v| is_no_fan(v) && has_several_fans(mesh, v)).collect()
}

/// Whether the triangles at `v` fall apart when only those that share an edge at `v` hold together.
fn has_several_fans(mesh: &Mesh, v: u32) -> bool {
    let topology = mesh.topology();
    let corners = topology.corners.row(v);
    let mut reached: Vec<u32> = corners.first().copied().into_iter().collect();
    let mut seen = vec![false; corners.len()];
    seen.iter_mut().take(1).for_each(|first| *first = true);
    let mut done = 0;
    while let Some(&corner) = reached.get(done) {
        done += 1;
        for edge in [corner, prev(corner)].map(|h| topology.edge_of[h as usize]) {
            for &h in topology.halfedges.row(edge) {
                let there = if start(mesh.triangles(), h) == v { h } else { next(h) };
                // Corners are in ascending order, and this is one of them.
                if let Ok(place) = corners.binary_search(&there)
                    && !std::mem::replace(&mut seen[place], true)
                {
                    reached.push(there);
                }
            }
        }
    }
    reached.len() < corners.len()
}

/// Triangles whose height is lost in the rounding of their coordinates.
fn zero_area_faces(mesh: &Mesh, positions: &[[f64; 3]]) -> Vec<u32> {
    let has_no_area = |triangle: [u32; 3]| {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let sides = [minus(b, a), minus(c, b), minus(a, c)];
        let longest = sides.map(|side| dot(side, side)).into_iter().fold(0.0, f64::max).sqrt();
        let normal = cross(sides[0], sides[2]);
        let largest_coordinate = [a, b, c].into_iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        dot(normal, normal).sqrt() <= 4.0 * f64::EPSILON * largest_coordinate * longest
    };
    used_triangles(mesh).filter(|&(_, triangle)| has_no_area(triangle)).map(|(f, _)| f).collect()
}

fn duplicate_faces(mesh: &Mesh) -> Vec<[u32; 2]> {
    let sorted = |[a, b, c]: [u32; 3]| {
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        [low, (a ^ b ^ c) ^ low ^ high, high]
    };
    repeats(used_triangles(mesh).map(|(f, triangle)| (sorted(triangle), f)).collect())
}

fn duplicate_vertices(mesh: &Mesh) -> Vec<[u32; 2]> {
    let finite = (0..).zip(mesh.positions()).filter(|(_, position)| position.iter().all(|x| x.is_finite()));
    // Adding 0 turns -0 into 0; the order of the bits is any order, which is enough to bring equals together.
    repeats(finite.map(|(v, position)| (position.map(|x| (x + 0.0).to_bits()), v)).collect())
}

/// The numbers whose key occurred at a smaller number, each with the smallest such number, in ascending order.
fn repeats<K: Ord>(mut keyed: Vec<(K, u32)>) -> Vec<[u32; 2]> {
    keyed.sort_unstable();
    let groups = keyed.chunk_by(|a, b| a.0 == b.0);
    let mut repeats: Vec<[u32; 2]> =
        groups.flat_map(|group| group[1..].iter().map(|&(_, i)| [i, group[0].1])).collect();
    repeats.sort_unstable();
    repeats
}
