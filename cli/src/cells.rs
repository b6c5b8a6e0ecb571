//! The cells of a Voronoi diagram: which part of the surface is nearest to which source.
//!
//! Where the ends of an edge have different nearest sources, the border between them is looked for on the edge by
//! bisection, in an exact field; heat knows vertices alone, and the border is in the middle. Across a triangle it is taken
//! for straight; three cells meet in the middle of their places on its edges. So each triangle is cut into parts of one
//! cell. What of a cell has no vertex is missed.
//!
//! O(V + F) and, in an exact field, [`BISECTIONS`] questions for each edge between two cells.

use std::collections::{BTreeSet, HashMap};
use taut::{ExactField, Mesh, SurfacePoint, Target};

/// An edge is halved so often: the border is then off by less than a millionth of it.
const BISECTIONS: u32 = 19;

/// A surface cut into cells.
pub(crate) struct Cells {
    /// The vertices of the surface and then those on borders, where each triangle has its own.
    positions: Vec<[f64; 3]>,
    /// The source that is nearest to each vertex or, on a border, to its triangle.
    pub(crate) nearest: Vec<Option<u32>>,
    triangles: Vec<[u32; 3]>,
    /// The sources whose cells share a border, the larger number first.
    neighbours: BTreeSet<[u32; 2]>,
}

impl Cells {
    /// By the nearest source of each vertex and, for places between vertices, the exact field that this comes from, if it
    /// does; it keeps its windows.
    pub(crate) fn new(mesh: &Mesh, nearest: &[Option<u32>], field: Option<&ExactField>) -> taut::Result<Cells> {
        let mut cells = Cells {
            positions: mesh.positions().to_vec(),
            nearest: nearest.to_vec(),
            triangles: Vec::with_capacity(mesh.triangle_count()),
            neighbours: BTreeSet::new(),
        };
        let mut edges = Edges { field, found: HashMap::new() };
        for (f, &triangle) in (0..).zip(mesh.triangles()) {
            let [a, b, c] = triangle;
            let nearest = triangle.map(|v| cells.nearest[v as usize]);
            if a == b || b == c || c == a {
                continue; // conducts nothing and has no area
            }
            if nearest[0] == nearest[1] && nearest[1] == nearest[2] {
                cells.triangles.push(triangle);
                continue;
            }
            // On the edge from corner k to the next.
            let mut places = [None; 3];
            for k in 0..3 {
                let next = (k + 1) % 3;
                if nearest[k] != nearest[next] {
                    places[k] = Some(edges.border(f, [k, next], triangle, nearest)?);
                    let pair = [nearest[k], nearest[next]];
                    cells.neighbours.extend(pair[0].zip(pair[1]).map(|(s, t)| [s.max(t), s.min(t)]));
                }
            }
            cells.cut(mesh, triangle, nearest, places)?;
        }
        Ok(cells)
    }

    /// Cuts a triangle at the places on its edges.
    fn cut(
        &mut self,
        mesh: &Mesh,
        triangle: [u32; 3],
        nearest: [Option<u32>; 3],
        places: [Option<SurfacePoint>; 3],
    ) -> taut::Result<()> {
        let at = |place: SurfacePoint| place.position(mesh);
        if let [Some(p), Some(q), Some(r)] = places {
            let weight = |k: usize| (p.barycentric[k] + q.barycentric[k] + r.barycentric[k]) / 3.0;
            let middle = at(SurfacePoint { face: p.face, barycentric: [0, 1, 2].map(weight) })?;
            let places = [at(p)?, at(q)?, at(r)?];
            for k in 0..3 {
                let corner = mesh.positions()[triangle[k] as usize];
                self.add(nearest[k], &[corner, places[k], middle, places[(k + 2) % 3]]);
            }
            return Ok(());
        }
        for k in 0..3 {
            let [next, last] = [(k + 1) % 3, (k + 2) % 3];
            // The corner k is alone.
            if let (Some(after), Some(before)) = (places[k], places[last]) {
                let [after, before] = [at(after)?, at(before)?];
                let corners = triangle.map(|v| mesh.positions()[v as usize]);
                self.add(nearest[k], &[corners[k], after, before]);
                self.add(nearest[next], &[after, corners[next], corners[last], before]);
            }
        }
        Ok(())
    }

    /// Adds a convex polygon of one cell, as a fan.
    fn add(&mut self, nearest: Option<u32>, polygon: &[[f64; 3]]) {
        let first = self.positions.len() as u32; // a mesh of more vertices than u32 has is refused
        self.positions.extend(polygon);
        self.nearest.resize(self.positions.len(), nearest);
        self.triangles.extend((1..polygon.len() as u32 - 1).map(|i| [first, first + i, first + i + 1]));
    }

    /// The surface as it is cut.
    pub(crate) fn mesh(&self) -> taut::Result<Mesh> {
        Mesh::from_triangles(&self.positions, &self.triangles)
    }

    /// The area of each of so many cells, in mesh units squared.
    pub(crate) fn areas(&self, count: usize) -> Vec<f64> {
        let mut areas = vec![0.0; count];
        for triangle in &self.triangles {
            if let Some(source) = self.nearest[triangle[0] as usize] {
                areas[source as usize] += area(triangle.map(|v| self.positions[v as usize]));
            }
        }
        areas
    }

    /// For each of so many cells one of `colours` colours. Neighbours have different ones, as long as the colours last.
    pub(crate) fn colours(&self, count: usize, colours: usize) -> Vec<usize> {
        let mut colour: Vec<usize> = Vec::with_capacity(count);
        for source in 0..count {
            let s = source as u32; // sources are numbered by u32
            let taken: BTreeSet<usize> =
                self.neighbours.range([s, 0]..[s, s]).map(|&[_, t]| colour[t as usize]).collect();
            let free = (0..colours).map(|i| (source + i) % colours).find(|colour| !taken.contains(colour));
            colour.push(free.unwrap_or(source % colours));
        }
        colour
    }
}

fn area([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|axis| p[axis] - a[axis]));
    let part = |x: usize, y: usize| u[x] * v[y] - u[y] * v[x];
    0.5 * part(1, 2).hypot(part(2, 0)).hypot(part(0, 1))
}

/// Where borders cross edges.
struct Edges<'a> {
    field: Option<&'a ExactField>,
    /// By the vertices of an edge, the lesser first: how far from that one.
    found: HashMap<[u32; 2], f64>,
}

impl Edges<'_> {
    /// The place where the border crosses the edge between these corners of a triangle, the same for every triangle there.
    fn border(
        &mut self,
        face: u32,
        mut ends: [usize; 2],
        triangle: [u32; 3],
        nearest: [Option<u32>; 3],
    ) -> taut::Result<SurfacePoint> {
        ends.sort_by_key(|&k| triangle[k]);
        let [from, to] = ends;
        let point = |share: f64| {
            let mut barycentric = [0.0; 3];
            [barycentric[from], barycentric[to]] = [1.0 - share, share];
            SurfacePoint { face, barycentric }
        };
        let Some(field) = self.field else { return Ok(point(0.5)) };
        let key = [triangle[from], triangle[to]];
        if let Some(&share) = self.found.get(&key) {
            return Ok(point(share));
        }
        let [mut low, mut high] = [0.0, 1.0];
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let is_same = field.nearest_source(Target::Point(point(middle)))? == nearest[from];
            *(if is_same { &mut low } else { &mut high }) = middle;
        }
        let share = 0.5 * (low + high);
        self.found.insert(key, share);
        Ok(point(share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taut::{Control, ExactOptions, ExactSolver, Source, shapes};

    #[test]
    fn neighbours_have_different_colours() {
        let mesh = shapes::icosphere(4).mesh().unwrap();
        let sources: Vec<Source> = (0..60).map(|i| Source::vertex(i * 42)).collect();
        let options = ExactOptions { keep_windows: true, ..ExactOptions::default() };
        let field = ExactSolver::new(&mesh).unwrap().field(&sources, &options, &Control::new()).unwrap();
        let cells = Cells::new(&mesh, &field.nearest_sources().collect::<Vec<_>>(), Some(&field)).unwrap();
        let colours = cells.colours(60, 8);
        assert!(cells.neighbours.len() > 100 && cells.neighbours.iter().any(|&[s, t]| (s - t) % 8 == 0));
        assert!(cells.neighbours.iter().all(|&[s, t]| colours[s as usize] != colours[t as usize]));
        assert!((0..8).all(|colour| colours.iter().filter(|&&other| other == colour).count() >= 4), "{colours:?}");
    }
}
