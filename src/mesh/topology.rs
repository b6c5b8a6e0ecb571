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
        let (edges, halfedges) = edges(triangles, &corners);
        let mut edge_of = vec![NONE; 3 * triangles.len()];
        for e in 0..halfedges.rows() {
            halfedges.row(e).iter().for_each(|&h| edge_of[h as usize] = e);
        }
        let (component, component_count) = components(&edges, &corners);
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

/// Numbers the edges by their smaller end, then by the larger: (ends of each edge, half-edges on each edge).
fn edges(triangles: &[[u32; 3]], corners: &Csr) -> (Vec<[u32; 2]>, Csr) {
    let mut edges = Vec::with_capacity(corners.items.len());
    let mut starts = Vec::with_capacity(corners.items.len() + 1);
    let mut items = Vec::with_capacity(corners.items.len());
    // The larger end and the half-edge of each edge at a vertex, as one number.
    let mut at_vertex: Vec<u64> = Vec::new();
    for v in 0..corners.rows() {
        at_vertex.clear();
        for &h in corners.row(v) {
            let (to, from) = (start(triangles, next(h)), start(triangles, prev(h)));
            let sides = [(to, h), (from, prev(h))].into_iter().filter(|&(end, _)| end > v);
            at_vertex.extend(sides.map(|(end, h)| u64::from(end) << 32 | u64::from(h)));
        }
        at_vertex.sort_unstable();
        for of_edge in at_vertex.chunk_by(|x, y| x >> 32 == y >> 32) {
            edges.push([v, (of_edge[0] >> 32) as u32]);
            starts.push(items.len() as u32); // fits: numbers of half-edges
            items.extend(of_edge.iter().map(|&side| side as u32)); // the lower half
        }
    }
    starts.push(items.len() as u32);
    edges.shrink_to_fit();
    starts.shrink_to_fit();
    (edges, Csr { start: starts, items })
}

/// Joins the ends of edges, and numbers the components by their smallest vertex: (component of each vertex, count).
fn components(edges: &[[u32; 2]], corners: &Csr) -> (Vec<u32>, u32) {
    // A smaller vertex of the same component, or itself.
    let mut below: Vec<u32> = (0..corners.rows()).collect();
    for ends in edges {
        let [a, b] = ends.map(|v| smallest(&mut below, v));
        below[a.max(b) as usize] = a.min(b);
    }
    let mut count = 0;
    let mut component = vec![NONE; below.len()];
    for v in (0..corners.rows()).filter(|&v| !corners.row(v).is_empty()) {
        let root = smallest(&mut below, v);
        if root == v {
            count += 1;
        }
        component[v as usize] = if root == v { count - 1 } else { component[root as usize] };
    }
    (component, count)
}

/// Follows `below` to its end, and halves the way for the next time.
fn smallest(below: &mut [u32], mut v: u32) -> u32 {
    while below[v as usize] != v {
        below[v as usize] = below[below[v as usize] as usize];
        v = below[v as usize];
    }
    v
}
