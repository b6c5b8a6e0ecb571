//! Paths of steepest descent: where -∇u leads on the surface, for a field u given at the vertices and linear in each
//! triangle.
//!
//! In a triangle ∇u is constant. With the side eₖ opposite the corner k, as vectors that run round the triangle, and its
//! area A, the weights λ of a point that follows -∇u change by
//!
//! dλₖ / ds = -eₖ · (Σ uᵢ eᵢ) / 4A²,
//!
//! of which the direction needs no area. From a point, a path takes the steepest of the straight pieces that fall: in each
//! triangle there the line of steepest descent to where it leaves it, and the ways to the corners. Where the lines of both
//! triangles on an edge lead back to it, in a valley, it so follows the edge.
//!
//! - A path ends at a vertex that has no lower neighbour. The values of its points never rise, and stay the same only
//!   where, on level ground, it goes to a vertex from a place that is none.
//! - It follows the line of steepest descent through a triangle once, should it ever come back by a corner: so it has no
//!   more points than there are vertices and triangles. On edges of several triangles the steepest of all counts.
//! - A triangle with a corner that is not finite has no field inside it, but its edges between finite corners do. One that
//!   repeats a vertex has none.
//! - The least value of a linear field is at a vertex, but the source of distances may lie anywhere. Where sources are
//!   known, a path that comes to a triangle with one goes straight to it, if its start distance is below the field, and the
//!   field falls towards it half as steeply at least as it falls at all: else the source is another path's.
//! - Distances have minima that are no sources, where triangles are obtuse. Where sources are known these are
//!   [drained](super::drain) first, and paths lead on over their lowest passes.
//!
//! O(1) time for each triangle that a path crosses, and for all paths together O(V), or O(V log V) where minima are
//! drained; memory O(V + output).
//!
//! References: the gradient of a linear field as in K. Crane, C. Weischedel, M. Wardetzky: Geodesics in Heat. ACM
//! Transactions on Graphics, 2013, section 3.2.1.

use super::closest::side_weights;
use super::curve::{Curve, Segment};
use super::drain::drained;
use super::point::{Place, SurfacePoint};
use super::source::{Origin, Source};
use super::target::Target;
use crate::control::Control;
use crate::error::{Element, Error, Result};
use crate::mesh::Mesh;
use crate::mesh::topology::start;
use crate::metric::{Scale, distance, dot, minus};
use std::cmp::Ordering;
use std::collections::{HashMap, HashSet};

/// A path of steepest descent.
#[derive(Debug, Clone, PartialEq)]
pub struct DescentPath {
    /// From the target down; a single point where nothing is lower.
    pub curve: Curve,
    /// The source where it ends, by its number in the list of sources; None where it ends at another vertex, which has no
    /// lower neighbour.
    pub source: Option<u32>,
}

/// The paths along which a field falls steepest, one from each target.
///
/// `values` has one number for each vertex of the mesh, in any unit; the field is linear in each triangle, and never rises
/// along a path. Without `sources` a path ends at a vertex that has no lower neighbour.
///
/// If the values are distances, of whatever origin, the paths lead back to the `sources` and come near to the shortest ones.
/// They end at a source, also inside a triangle or on a curve. Where the distances have a minimum that is no source, as
/// where triangles are obtuse, the path goes on over the lowest pass.
///
/// A path is None for a target where the field is not finite, such as one that no source reaches, and for a vertex of no
/// triangle.
///
/// O(V) time for all paths together, O(V log V) where they leave such minima, and O(1) for each triangle that they cross.
/// The control is consulted before each path; progress counts paths.
///
/// ```
/// # fn main() -> taut::Result<()> {
/// use taut::{Control, HeatOptions, HeatSolver, Source, Target, descent_paths, shapes};
/// let mesh = shapes::icosphere(4).mesh()?;
/// let sources = [Source::vertex(0)];
/// let control = Control::new();
/// let distances = HeatSolver::new(&mesh, &HeatOptions::default(), &control)?.field(&sources, &control)?.into_distances();
///
/// let paths = descent_paths(&mesh, &distances, &sources, &[Target::Vertex(11)], &control)?;
/// let path = paths[0].as_ref().expect("the source reaches all vertices");
/// assert_eq!(path.source, Some(0));
/// let points = path.curve.positions(&mesh)?;
/// assert_eq!(points.last(), Some(&mesh.positions()[0]));
/// # Ok(()) }
/// ```
///
/// # Errors
/// [`Reason::BadArgument`](crate::Reason) where the number of values is not that of the vertices; it and
/// [`Reason::VertexOutOfRange`](crate::Reason) naming the source or target that the mesh does not have;
/// [`Reason::Cancelled`](crate::Reason), [`Reason::TimeLimit`](crate::Reason).
pub fn descent_paths(
    mesh: &Mesh,
    values: &[f64],
    sources: &[Source],
    targets: &[Target],
    control: &Control,
) -> Result<Vec<Option<DescentPath>>> {
    super::check_values(mesh, values)?;
    let positions = Scale::of(mesh).unit_positions(mesh);
    let descent = Descent { field: Field { mesh, values, positions: &positions }, goals: goals(mesh, sources)? };
    let outlets = descent.outlets();
    let drained = if outlets.is_empty() { values.into() } else { drained(mesh, values, &outlets) };
    let descent = Descent { field: Field { values: &drained, ..descent.field }, ..descent };
    let mut paths = Vec::with_capacity(targets.len());
    for (i, target) in targets.iter().enumerate() {
        control.checkpoint(i as f64 / targets.len() as f64)?;
        let place = target.checked(mesh).map_err(|error: Error| error.about(Element::Target(i as u64)))?;
        paths.push(descent.path(place)?);
    }
    control.report(1.0);
    Ok(paths)
}

/// A field on a mesh.
#[derive(Clone, Copy)]
pub(super) struct Field<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) values: &'a [f64],
    /// In units.
    pub(super) positions: &'a [[f64; 3]],
}

/// A straight piece of a path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    from: SurfacePoint,
    /// In the same triangle.
    pub(super) to: SurfacePoint,
    /// In units.
    length: f64,
    /// By how much the field falls along it, halved lest it overflow, over its length.
    slope: f64,
}

impl Piece {
    /// By slope; on level ground by nearness.
    fn by_slope(&self, other: &Piece) -> Ordering {
        self.slope.total_cmp(&other.slope).then(other.length.total_cmp(&self.length))
    }
}

impl Field<'_> {
    /// The steepest piece that falls from a point, in any of the triangles there. Lines of steepest descent are not
    /// followed through triangles that are `crossed`.
    pub(super) fn steepest(&self, at: &SurfacePoint, crossed: &HashSet<u32>) -> Option<Piece> {
        let falling = |from: SurfacePoint| {
            let exit = if crossed.contains(&from.face) { None } else { self.exit(&from) };
            let corners = if exit.is_none() { Some(self.lower_corners(from)) } else { None };
            let ends = exit.into_iter().chain(corners.into_iter().flatten());
            ends.map(move |to| self.piece(from, to, self.value(&to)))
        };
        at.in_triangles(self.mesh).into_iter().flat_map(falling).max_by(Piece::by_slope)
    }

    /// The corners of its triangle that are lower than a point or, if it is no vertex, as high as it.
    fn lower_corners(&self, from: SurfacePoint) -> impl Iterator<Item = SurfacePoint> {
        let height = self.value(&from);
        let is_vertex = matches!(from.as_place(self.mesh), Place::Vertex(_));
        let is_lower = move |&h: &u32| {
            let u = self.values[start(self.mesh.triangles(), h) as usize];
            u.is_finite() && (u < height || (u == height && !is_vertex))
        };
        (3 * from.face..3 * from.face + 3).filter(is_lower).map(SurfacePoint::at_start)
    }

    /// Where the line of steepest descent through a point leaves its triangle; None where it leaves it at once, where it
    /// does not fall by more than rounding, and where the field is level or not finite.
    fn exit(&self, from: &SurfacePoint) -> Option<SurfacePoint> {
        let rates = self.rates(from.face)?;
        let times = (0..3).filter(|&k| rates[k] < 0.0).map(|k| (k, from.barycentric[k] / -rates[k]));
        let (k, time) = times.min_by(|(_, s), (_, t)| s.total_cmp(t))?;
        let weight = |k: usize| (from.barycentric[k % 3] + time * rates[k % 3]).max(0.0);
        let exit = (time > 0.0).then(|| on_side(from.face, k, [weight(k + 1), weight(k + 2)]))?;
        (self.value(&exit) < self.value(from)).then_some(exit)
    }

    /// How the weights of a point change that follows -∇u through a triangle, the fastest by 1 or -1; None where the field
    /// is level or not finite.
    fn rates(&self, face: u32) -> Option<[f64; 3]> {
        let corners = self.mesh.triangles()[face as usize];
        let halves = corners.map(|v| 0.5 * self.values[v as usize]); // whose differences do not overflow
        let [low, high] = [halves[0].min(halves[1]).min(halves[2]), halves[0].max(halves[1]).max(halves[2])];
        if !(halves.iter().all(|u| u.is_finite()) && low < high) {
            return None;
        }
        let heights = halves.map(|u| (u - low) / (high - low));
        let [a, b, c] = corners.map(|v| self.positions[v as usize]);
        let sides = [minus(c, b), minus(a, c), minus(b, a)];
        let turned = [0, 1, 2].map(|axis| (0..3).map(|k| heights[k] * sides[k][axis]).sum());
        let rates = sides.map(|side| -dot(side, turned));
        let fastest = rates.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        (fastest > 0.0).then(|| rates.map(|rate| rate / fastest))
    }

    /// The value at a point; not finite where a corner with a weight is not.
    fn value(&self, point: &SurfacePoint) -> f64 {
        point.between(self.mesh.triangles()[point.face as usize].map(|v| self.values[v as usize]))
    }

    /// From one point of a triangle to another, where the value is `value`.
    fn piece(&self, from: SurfacePoint, to: SurfacePoint, value: f64) -> Piece {
        let corners = self.mesh.triangles()[from.face as usize].map(|v| self.positions[v as usize]);
        let length = distance(from.place(corners), to.place(corners));
        let fall = 0.5 * self.value(&from) - 0.5 * value;
        Piece { from, to, length, slope: if fall > 0.0 { fall / length } else { 0.0 } }
    }
}

/// A place on a side that is nearer to its end than this share of its length is the end: the slope of a way between them
/// would be rounding.
const AT_END: f64 = 1e-12;

/// The point on the side opposite corner `k` of a triangle with weights in this ratio at the corners after `k`.
fn on_side(face: u32, k: usize, [a, b]: [f64; 2]) -> SurfacePoint {
    let less = Some(a.min(b) / (a + b)).filter(|less| *less >= AT_END).unwrap_or(0.0);
    let mut barycentric = [0.0; 3];
    [barycentric[(k + 1) % 3], barycentric[(k + 2) % 3]] = if a < b { [less, 1.0 - less] } else { [1.0 - less, less] };
    SurfacePoint { face, barycentric }
}

/// What of a source lies in a triangle: a piece of a curve, or a point as one without length.
#[derive(Debug)]
struct Goal {
    source: u32,
    segment: Segment,
    /// The start distance.
    offset: f64,
}

/// What of the sources lies in each triangle.
fn goals(mesh: &Mesh, sources: &[Source]) -> Result<HashMap<u32, Vec<Goal>>> {
    let mut goals: HashMap<u32, Vec<Goal>> = HashMap::new();
    let seeds = if sources.is_empty() { Vec::new() } else { Source::checked(sources, mesh)? };
    for seed in seeds {
        let (places, segments) = match seed.origin {
            Origin::Place(place) => (vec![place], Vec::new()),
            Origin::Curve(route) => (route.points.iter().map(|point| point.as_place(mesh)).collect(), route.segments),
        };
        let points = places.iter().flat_map(|place| place.in_triangles(mesh));
        let points = points.map(|SurfacePoint { face, barycentric }| Segment { face, ends: [barycentric; 2] });
        for segment in points.chain(segments.iter().flat_map(|segment| segment.in_triangles(mesh))) {
            let goal = Goal { source: seed.source, segment, offset: seed.offset };
            goals.entry(segment.face).or_default().push(goal);
        }
    }
    Ok(goals)
}

/// A field and what it comes from.
struct Descent<'a> {
    field: Field<'a>,
    goals: HashMap<u32, Vec<Goal>>,
}

/// The field falls towards a source that a path goes to by this share of the steepest slope at least.
const TOWARDS_SOURCE: f64 = 0.5;

impl Descent<'_> {
    /// The path from a place; None where the field is not finite, and for a vertex of no triangle.
    fn path(&self, place: Place) -> Result<Option<DescentPath>> {
        let field = &self.field;
        let Some(&first) = place.in_triangles(field.mesh).first().filter(|point| field.value(point).is_finite()) else {
            return Ok(None);
        };
        let (mut at, mut source) = (first, None);
        let (mut pieces, mut crossed) = (Vec::new(), HashSet::new());
        while source.is_none() {
            let Some((piece, end)) = self.next(&at, &crossed) else { break };
            (at, source) = (piece.to, end);
            if matches!(at.as_place(field.mesh), Place::Face(_)) {
                crossed.insert(at.face);
            }
            pieces.push(piece);
        }
        Ok(Some(DescentPath { curve: self.curve(first, &pieces)?, source }))
    }

    /// The next piece of a path, and the source where it ends, if it does.
    fn next(&self, at: &SurfacePoint, crossed: &HashSet<u32>) -> Option<(Piece, Option<u32>)> {
        let steepest = self.field.steepest(at, crossed);
        let least = steepest.map_or(0.0, |piece| TOWARDS_SOURCE * piece.slope);
        match self.towards_source(at).filter(|(piece, _)| piece.slope >= least) {
            Some((piece, source)) => Some((piece, Some(source))),
            None => steepest.map(|piece| (piece, None)),
        }
    }

    /// The vertices from which a way goes straight to a source.
    fn outlets(&self) -> Vec<u32> {
        let corners = |goal: &Goal| {
            let corners = 3 * goal.segment.face..3 * goal.segment.face + 3;
            let reaching = corners.filter(|&h| self.to_goal(SurfacePoint::at_start(h), goal).is_some());
            reaching.map(|h| start(self.field.mesh.triangles(), h)).collect::<Vec<_>>()
        };
        self.goals.values().flatten().flat_map(corners).collect()
    }

    /// The steepest way from a point straight to a source in one of its triangles, and which source that is.
    fn towards_source(&self, at: &SurfacePoint) -> Option<(Piece, u32)> {
        let in_triangle = |from: SurfacePoint| {
            let goals = self.goals.get(&from.face).into_iter().flatten();
            goals.filter_map(move |goal| Some((self.to_goal(from, goal)?, goal.source)))
        };
        let ways = at.in_triangles(self.field.mesh).into_iter().flat_map(in_triangle);
        ways.max_by(|(a, _), (b, _)| a.by_slope(b))
    }

    /// The way to the nearest place of a source, if the field falls towards it, or if this is the place.
    fn to_goal(&self, from: SurfacePoint, goal: &Goal) -> Option<Piece> {
        let corners = self.field.mesh.triangles()[from.face as usize].map(|v| self.field.positions[v as usize]);
        let ends = goal.segment.ends.map(|barycentric| SurfacePoint { barycentric, ..from }.place(corners));
        let [_, share] = side_weights(ends, from.place(corners));
        let piece = self.field.piece(from, goal.segment.at(share), goal.offset);
        let height = self.field.value(&from);
        match piece.length > 0.0 {
            true => (goal.offset < height).then_some(piece),
            false => (goal.offset <= height).then_some(Piece { slope: f64::INFINITY, ..piece }),
        }
    }

    /// The pieces with a length as a curve; `first` where there are none.
    fn curve(&self, first: SurfacePoint, pieces: &[Piece]) -> Result<Curve> {
        let mut points = Vec::with_capacity(pieces.len() + 1);
        let mut last = first;
        for &Piece { from, to, .. } in pieces {
            if from.position(self.field.mesh)? != to.position(self.field.mesh)? {
                points.push(from);
                last = to;
            }
        }
        points.push(last);
        Ok(Curve { points, is_closed: false })
    }
}
