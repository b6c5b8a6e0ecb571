//! The paper's basic set: meshes 2 to 5, which are the first one with ever more vertices taken away.
//!
//! A mesh is made of the first one, not of the one before: vertices are drawn at random and deleted; a hole is one new
//! polygon, also where it took several neighbours; each polygon is cut into triangles that keep the shape. The paper then
//! corrects the worst slivers; here none with an angle above 179° is made, and nothing folds.
//!
//! Another vertex goes instead of one where this cannot be done, and instead of one that is on a border, or where the mesh
//! is not a surface, or that has fewer than 4 or more than 64 neighbours. The source stays, and so do the ends of the
//! shortest edge (Table 3: its length is the same in all meshes) and what spans the bounding box, which gives the scale. A
//! closed manifold stays one, of the same genus.
//!
//! The draw is a generator and a rule that are the same everywhere, PCG XSL-RR 128/64 and one multiplication; everything
//! else is IEEE arithmetic with square roots. O(V + F) for holes of a few vertices.
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open Physics
//! 17 (2019), section 4.1. M. E. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for
//! Random Number Generation", 2014.

mod ears;
mod polygons;

use crate::error::{Error, Result};
use crate::model::Model;
use polygons::Polygons;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;
use taut::Mesh;

/// How many vertices the paper took away for 2.obj to 5.obj (Table 1). It speaks of 3, 6, 9 and 12 %; these are 3.1, 6.2,
/// 10.0 and 12.7 % of [`VERTICES`].
const REMOVED: [u64; 4] = [442, 892, 1427, 1812];

/// How many vertices 1.obj has (Table 1).
const VERTICES: u64 = 14290;

/// A made mesh.
#[derive(Debug, Clone)]
pub struct BasicMesh {
    /// Called 2 to 5, as in the paper; the source is at the same place as that of the first mesh.
    pub model: Model,
    /// Which vertex of the first mesh each of its vertices is, ascending.
    pub origin: Vec<u32>,
}

/// Meshes 2 to 5 of the set whose first mesh is `first`: the same shares of its vertices are taken away as in the paper.
///
/// A seed gives the same meshes everywhere.
///
/// # Errors
/// [`Error::Input`] if too few vertices can be taken away, or if `first` does not have its source.
pub fn basic_set(first: &Model, seed: u64) -> Result<[BasicMesh; 4]> {
    let vertices = first.mesh.vertex_count();
    if first.source as usize >= vertices {
        return Err(Error::Input(format!("{}: the source is vertex {} of {vertices}", first.name, first.source)));
    }
    let make = |n: usize| {
        let count = (vertices as u64 * REMOVED[n] + VERTICES / 2) / VERTICES;
        thinned(first, n as u64 + 2, count, seed)
    };
    Ok([make(0)?, make(1)?, make(2)?, make(3)?])
}

/// Mesh `number` of a set: `first` without `count` of its vertices.
fn thinned(first: &Model, number: u64, count: u64, seed: u64) -> Result<BasicMesh> {
    let mut kept = vec![first.source];
    kept.extend(shortest_edge(&first.mesh).into_iter().flatten());
    kept.extend(box_corners(&first.mesh));
    let candidates = (0..first.mesh.vertex_count() as u32).filter(|v| !kept.contains(v)); // fits: vertices of a mesh
    let mut draw = Draw { left: candidates.collect(), random: Pcg64::new(seed.into(), number.into()) };

    let mut polygons = Polygons::new(&first.mesh);
    let mut removed = 0;
    while removed < count {
        let Some(v) = draw.next() else {
            let possible = removed - polygons.fill_holes(first.mesh.positions());
            let message =
                format!("{count} vertices are to be taken away, but only {possible} can so that a surface is left");
            return Err(Error::Input(format!("{}: {message}", first.name)));
        };
        removed += u64::from(polygons.remove(v));
        if removed == count {
            removed -= polygons.fill_holes(first.mesh.positions());
        }
    }
    without_removed(first, number, &polygons)
}

/// The triangles of `polygons`, and the vertices that it has not removed.
fn without_removed(first: &Model, number: u64, polygons: &Polygons) -> Result<BasicMesh> {
    let mut index = vec![0; first.mesh.vertex_count()];
    let mut origin = Vec::new();
    for v in (0..first.mesh.vertex_count() as u32).filter(|&v| !polygons.is_removed(v)) {
        index[v as usize] = origin.len() as u32; // fits: fewer than before
        origin.push(v);
    }
    let positions: Vec<[f64; 3]> = origin.iter().map(|&v| first.mesh.positions()[v as usize]).collect();
    let triangles: Vec<[u32; 3]> = polygons.triangles().map(|t| t.map(|v| index[v as usize])).collect();
    let mesh = Mesh::from_triangles(&positions, &triangles).map_err(Error::of_model(&first.name))?;
    Ok(BasicMesh { model: Model { name: number.to_string(), mesh, source: index[first.source as usize] }, origin })
}

/// Numbers drawn at random, each once.
struct Draw {
    left: Vec<u32>,
    random: Pcg64,
}

impl Iterator for Draw {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        // The product's upper half is below the number of those left. A rule of its own: a library may change its.
        let product = u128::from(self.random.next_u64()) * self.left.len() as u128;
        (!self.left.is_empty()).then(|| self.left.swap_remove((product >> 64) as usize))
    }
}

/// Vertices that span the bounding box, which gives the scale: the shortest edge is the same at the paper's size too.
fn box_corners(mesh: &Mesh) -> Vec<u32> {
    let place = |&v: &u32, axis: usize| mesh.positions()[v as usize][axis];
    let used = || mesh.triangles().iter().flatten().copied();
    let ends = (0..3).flat_map(|axis| {
        let order = move |a: &u32, b: &u32| place(a, axis).total_cmp(&place(b, axis));
        [used().min_by(order), used().max_by(order)]
    });
    ends.flatten().collect()
}

/// The ends of the first of the shortest edges; `None` without an edge.
fn shortest_edge(mesh: &Mesh) -> Option<[u32; 2]> {
    let length = |[a, b]: [u32; 2]| {
        let [from, to] = [a, b].map(|v| mesh.positions()[v as usize]);
        ears::length(ears::minus(to, from))
    };
    let sides = mesh.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    sides.filter(|[a, b]| a != b).min_by(|&x, &y| length(x).total_cmp(&length(y)))
}
