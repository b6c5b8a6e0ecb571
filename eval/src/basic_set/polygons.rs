//! A mesh of polygons whose vertices can be removed.
//!
//! Removing a vertex merges the polygons around it into one, a *hole*, which is cut into triangles in the end. No edge may
//! be used that is there already, since it would have four triangles. Where a hole cannot be cut the vertex that was
//! removed for it comes back, with the polygons that were around it.

use super::ears::ears;
use std::collections::HashSet;
use taut::Mesh;

/// How many corners a hole may have. Cutting it takes the cube of them; at the paper's shares few have more than 20.
const MOST_CORNERS: usize = 64;

/// Polygons, and which vertices they are without.
pub(super) struct Polygons {
    polygons: Vec<Polygon>,
    /// The polygons at each vertex, also those that are not there any more.
    at: Vec<Vec<usize>>,
    is_removed: Vec<bool>,
    /// The holes, also those merged into another.
    holes: Vec<usize>,
    /// All edges, the smaller end first. Those of removed vertices stay: nothing asks for them.
    edges: HashSet<[u32; 2]>,
}

struct Polygon {
    corners: Vec<u32>,
    /// Not if it is merged or cut.
    is_there: bool,
    /// What a hole took the place of.
    hole: Option<Hole>,
}

struct Hole {
    vertex: u32,
    around: Vec<usize>,
}

impl Polygons {
    pub(super) fn new(mesh: &Mesh) -> Polygons {
        let vertices = mesh.vertex_count();
        let mut polygons = Polygons {
            polygons: Vec::with_capacity(mesh.triangle_count()),
            at: vec![Vec::new(); vertices],
            is_removed: vec![false; vertices],
            holes: Vec::new(),
            edges: HashSet::with_capacity(3 * mesh.triangle_count() / 2),
        };
        mesh.triangles().iter().for_each(|triangle| polygons.add(triangle.to_vec(), None));
        polygons
    }

    pub(super) fn is_removed(&self, v: u32) -> bool {
        self.is_removed[v as usize]
    }

    /// All triangles; those that the mesh had come first.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let there = self.polygons.iter().filter(|polygon| polygon.is_there);
        there.filter_map(|polygon| polygon.corners.as_slice().try_into().ok())
    }

    /// Removes a vertex, if a polygon of distinct corners can take the place of those around it: whether it did.
    pub(super) fn remove(&mut self, v: u32) -> bool {
        let around: Vec<usize> = self.at[v as usize].iter().copied().filter(|&p| self.polygons[p].is_there).collect();
        let Some(ring) = self.ring(v, &around) else { return false };
        around.iter().for_each(|&p| self.polygons[p].is_there = false);
        self.is_removed[v as usize] = true;
        self.holes.push(self.polygons.len());
        self.add(ring, Some(Hole { vertex: v, around }));
        true
    }

    /// Cuts all holes into triangles: how many vertices had to come back.
    pub(super) fn fill_holes(&mut self, positions: &[[f64; 3]]) -> u64 {
        let mut returned = 0;
        while let Some(p) = self.holes.pop() {
            if !std::mem::take(&mut self.polygons[p].is_there) {
                continue; // a part of a later one, which has been cut
            }
            let corners = std::mem::take(&mut self.polygons[p].corners);
            let places: Vec<[f64; 3]> = corners.iter().map(|&v| positions[v as usize]).collect();
            let is_new = |i: usize, j: usize| !self.edges.contains(&edge(corners[i], corners[j]));
            if let Some(triangles) = ears(&places, is_new) {
                triangles.iter().for_each(|triangle| self.add(triangle.map(|i| corners[i]).to_vec(), None));
            } else if let Some(Hole { vertex, around }) = self.polygons[p].hole.take() {
                self.is_removed[vertex as usize] = false;
                around.iter().for_each(|&q| self.polygons[q].is_there = true);
                returned += 1;
            }
        }
        returned
    }

    fn add(&mut self, corners: Vec<u32>, hole: Option<Hole>) {
        self.edges.extend(sides(&corners).map(|[from, to]| edge(from, to)));
        corners.iter().for_each(|&v| self.at[v as usize].push(self.polygons.len()));
        self.polygons.push(Polygon { corners, is_there: true, hole });
    }

    /// The corners of the polygon that is left of those around `v` without it.
    ///
    /// Each of them gives the way from one of its corners beside `v` to the other; ways that meet are joined.
    fn ring(&self, v: u32, around: &[usize]) -> Option<Vec<u32>> {
        let corners = || around.iter().map(|&p| &self.polygons[p].corners);
        if corners().map(|corners| corners.len() - 2).sum::<usize>() > MOST_CORNERS {
            return None;
        }
        let way = |corners: &Vec<u32>| {
            let mut way = corners.clone();
            way.rotate_left(corners.iter().position(|&corner| corner == v)? + 1);
            way.pop();
            Some(way)
        };
        let mut ways = corners().map(way).collect::<Option<Vec<_>>>()?;
        let mut ring = ways.pop()?;
        while let Some(next) = ways.iter().position(|way| [way.first(), way.last()].contains(&ring.last())) {
            let mut way = ways.swap_remove(next);
            if way.first() != ring.last() {
                way.reverse(); // triangles that go round the other way
            }
            ring.extend_from_slice(&way[1..]);
        }
        let is_closed = ways.is_empty() && ring.pop() == ring.first().copied();
        let distinct: HashSet<u32> = ring.iter().copied().collect();
        // Of three corners there may be a triangle already.
        let is_polygon = ring.len() > 3 && distinct.len() == ring.len() && !distinct.contains(&v);
        (is_closed && is_polygon).then_some(ring)
    }
}

/// Each corner with the next one.
fn sides(corners: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&from, &to)| [from, to])
}

fn edge(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygons(vertices: usize, triangles: &[[u32; 3]]) -> Polygons {
        Polygons::new(&Mesh::from_triangles(&vec![[0.0; 3]; vertices], triangles).unwrap())
    }

    #[test]
    fn only_the_middle_of_a_disc_can_go() {
        let disc = [[0, 1, 2], [0, 2, 3], [4, 3, 0], [0, 4, 1]];
        assert!(polygons(5, &disc).remove(0));
        assert!(!polygons(6, &disc).remove(1), "on the border");
        assert!(!polygons(6, &disc).remove(5), "of no triangle");
        assert!(!polygons(5, &disc[1..]).remove(0), "an open fan");
        let cap = [[0, 1, 2], [0, 2, 3], [0, 3, 1]];
        assert!(!polygons(4, &cap).remove(0), "there may be a triangle already");
        let two_caps = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [0, 4, 5], [0, 5, 6], [0, 6, 4]];
        assert!(!polygons(7, &two_caps).remove(0), "two discs");
        let touching = two_caps.map(|t| t.map(|v| if v == 4 { 1 } else { v }));
        assert!(!polygons(7, &touching).remove(0), "two discs that touch");
        let repeated = [&disc[..], &[[0, 0, 1]]].concat();
        assert!(!polygons(5, &repeated).remove(0), "a triangle that is none");
    }

    #[test]
    fn holes_of_neighbours_are_one() {
        let taut::shapes::Shape { positions, triangles } = taut::shapes::grid(3, 4);
        let mesh = Mesh::from_triangles(&positions, &triangles).unwrap();
        let mut polygons = Polygons::new(&mesh);
        assert!(polygons.remove(5) && polygons.remove(9) && !polygons.remove(9));
        let hole = polygons.polygons.last().unwrap();
        assert_eq!(hole.corners.iter().copied().collect::<HashSet<_>>(), HashSet::from([0, 1, 4, 6, 8, 10, 13, 14]));
        assert_eq!(polygons.fill_holes(&positions), 0);
        assert_eq!(polygons.triangles().count(), triangles.len() - 4);
        assert!(polygons.triangles().flatten().all(|v| v != 5 && v != 9));
    }
}
