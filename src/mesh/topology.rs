//! How the triangles hang together: edges, the corners at each vertex, components.
//!
//! Half-edge h = 3f + k runs from corner k of triangle f to its next corner. An *edge* is an unordered pair of vertices
//! that some triangle joins; it has one half-edge per triangle on it, whatever their directions: one at a boundary, two
//! inside, more where the mesh is not manifold. Ignored triangles have no edges and no corners.
//!
//! Two triangles are connected when they share a vertex index, so a component is a set of vertices.
//!
//! O(V + F) time and memory, by counting sort (edges at a vertex of degree d cost d log d).

use super::validate::repeats_index;

/// "No such element", in arrays of 32-bit numbers.
pub(crate) const NONE: u32 = u32::MAX;

/// Connectivity of a mesh.
#[derive(Debug)]
pub(crate) struct Topology {
    /// Edge of each half-edge; NONE in an ignored triangle.
    pub(crate) edge_of: Vec<u32>,
    /// The two ends of each edge, the smaller index first.
    pub(crate) edges: Vec<[u32; 2]>,
    /// The half-edges on each edge.
    pub(crate) halfedges: Csr,
    /// The half-edges that start at each vertex: its corners.
    pub(crate) corners: Csr,
    /// Component of each vertex; NONE for a vertex that no triangle uses.
    pub(crate) component: Vec<u32>,
    /// How many components there are.
    pub(crate) component_count: u32,
}

/// Lists of numbers, one list per row, back to back.
#[derive(Debug, Default)]
pub(crate) struct Csr {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Csr {
    /// The list of row `row`.
    pub(crate) fn row(&self, row: u32) -> &[u32] {
        &self.items[self.range(row)]
    }

    /// Where the list of row `row` lies among all items.
    pub(crate) fn range(&self, row: u32) -> std::ops::Range<usize> {
        self.start[row as usize] as usize..self.start[row as usize + 1] as usize
    }

    /// How many rows there are.
    pub(crate) fn rows(&self) -> u32 {
        (self.start.len() - 1) as u32 // fits: rows are vertices or edges
    }

    /// Counting sort: row `rows[i]` lists every `i` in ascending order; NONE is left out.
    fn sorted(row_count: usize, rows: impl Iterator<Item = u32> + Clone) -> Csr {
        let mut start = vec![0u32; row_count + 1];
        for row in rows.clone().filter(|&row| row != NONE) {
            start[row as usize + 1] += 1;
        }
        for row in 0..row_count {
            start[row + 1] += start[row];
        }
        let mut next = start.clone();
        let mut items = vec![0; start[row_count] as usize];
        for (i, row) in (0..).zip(rows).filter(|&(_, row)| row != NONE) {
            items[next[row as usize] as usize] = i;
            next[row as usize] += 1;
        }
        Csr { start, items }
    }
}

impl Topology {
    pub(crate) fn new(vertex_count: usize, triangles: &[[u32; 3]]) -> Topology {
        let origins = triangles.iter().flat_map(|t| if repeats_index(t) { [NONE; 3] } else { *t });
        let corners = Csr::sorted(vertex_count, origins);
        let (edge_of, edges) = edges(vertex_count, triangles);
        let halfedges = Csr::sorted(edges.len(), edge_of.iter().copied());
        let (component, component_count) = components(triangles, &corners);
        Topology { edge_of, edges, halfedges, corners, component, component_count }
    }

    /// Whether only one triangle lies on edge `e`.
    pub(crate) fn is_boundary(&self, e: u32) -> bool {
        self.halfedges.row(e).len() == 1
    }
}

/// The half-edge after `h` in its triangle.
pub(crate) fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before `h` in its triangle.
pub(crate) fn prev(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

/// The vertex where half-edge `h` starts.
pub(crate) fn start(triangles: &[[u32; 3]], h: u32) -> u32 {
    triangles[(h / 3) as usize][(h % 3) as usize]
}

/// Numbers the edges by their smaller end, then by the larger: (edge of each half-edge, ends of each edge).
fn edges(vertex_count: usize, triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<[u32; 2]>) {
    let lower_ends = triangles.iter().flat_map(|t| match repeats_index(t) {
        true => [NONE; 3],
        false => [t[0].min(t[1]), t[1].min(t[2]), t[2].min(t[0])],
    });
    let by_lower_end = Csr::sorted(vertex_count, lower_ends);
    let mut edge_of = vec![NONE; 3 * triangles.len()];
    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(by_lower_end.items.len() / 2);
    let mut at_vertex: Vec<(u32, u32)> = Vec::new();
    for v in 0..by_lower_end.rows() {
        at_vertex.clear();
        at_vertex.extend(by_lower_end.row(v).iter().map(|&h| (start(triangles, h).max(start(triangles, next(h))), h)));
        at_vertex.sort_unstable();
        for &(upper, h) in &at_vertex {
            if edges.last() != Some(&[v, upper]) {
                edges.push([v, upper]);
            }
            edge_of[h as usize] = (edges.len() - 1) as u32; // fits: there are no more edges than half-edges
        }
    }
    (edge_of, edges)
}

/// Flood fill over shared vertices, numbered by their smallest vertex: (component of each vertex, count).
fn components(triangles: &[[u32; 3]], corners: &Csr) -> (Vec<u32>, u32) {
    let mut component = vec![NONE; corners.rows() as usize];
    let mut count = 0;
    let mut stack = Vec::new();
    for seed in 0..corners.rows() {
        if component[seed as usize] != NONE || corners.row(seed).is_empty() {
            continue;
        }
        component[seed as usize] = count;
        stack.push(seed);
        while let Some(v) = stack.pop() {
            for &u in corners.row(v).iter().flat_map(|&h| &triangles[(h / 3) as usize]) {
                if component[u as usize] == NONE {
                    component[u as usize] = count;
                    stack.push(u);
                }
            }
        }
        count += 1;
    }
    (component, count)
}
