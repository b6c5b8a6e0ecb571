//! Isolines: where a field u, given at the vertices and linear in each triangle, takes a value c.
//!
//! A vertex is *above* if u ≥ c, else *below*. So every triangle is crossed by two of its edges or by none, also where
//! vertices have the value c itself. An edge from a vertex below to one above is crossed at
//!
//! w_below = (u_above - c) / (u_above - u_below),   w_above = (c - u_below) / (u_above - u_below),
//!
//! of which the smaller is computed so and the other is 1 minus it; the same for every triangle on the edge.
//!
//! - The lines are the border of {u ≥ c}, seen from below: a plateau at c has a line where it meets lower ground, none
//!   where it meets higher ground. A ridge of edges at c has a line along both of its sides. A line that shrinks to a
//!   point, as at a peak of the height c, is left out.
//! - A triangle with a corner that is not finite has no line, nor has one that repeats a vertex.
//! - A line goes on over an edge where two triangles with lines meet, and ends at every other: at the boundary, beside a
//!   triangle without lines, and where three or more meet. There each triangle's line ends by itself, in the same point;
//!   one that comes back to the edge where it began is closed.
//!
//! A level's lines come in the order of the least triangle that each of them crosses. In that one higher ground is on the
//! left, seen from where its corners go round counter-clockwise; so it is all along the line where triangles are oriented
//! alike. A closed line begins where it enters that triangle.
//!
//! O(F log n + output) time for n levels together; memory O(F + output).
//!
//! References, for the rule of above and below: W. E. Lorensen, H. E. Cline: Marching Cubes: A High Resolution 3D Surface
//! Construction Algorithm. Computer Graphics 21(4) (SIGGRAPH), 1987.

use super::curve::Curve;
use super::point::SurfacePoint;
use crate::error::{Element, Error, Reason, Result};
use crate::mesh::Mesh;
use crate::mesh::topology::{NONE, next, prev, start};
use std::collections::VecDeque;

/// A line of equal value.
#[derive(Debug, Clone, PartialEq)]
pub struct Isoline {
    /// Which of the given levels it belongs to.
    pub level: u32,
    /// Where it runs: points on edges of the mesh, one weight of each exactly 0.
    pub curve: Curve,
}

/// The most levels that [`even_levels`] and [`spaced_levels`] give.
pub const MAX_LEVELS: usize = 10_000;

/// The lines along which a field has the values `levels`, those of the first level first.
///
/// `values` has one number for each vertex of the mesh, in any unit; `levels` may come in any order and repeat
/// themselves, and each has the same lines as if it were alone. A vertex counts as above a level that it has itself, so
/// that lines are the border of all that is at the level or above. Triangles with a corner that is not finite, such as
/// one that no source reaches, have no lines.
///
/// A line is closed, or ends at the boundary, beside triangles without lines, or on an edge of three or more triangles,
/// from where each triangle's line goes by itself. Higher ground is on its left in the first triangle that it crosses.
///
/// O(F log n + output) time for n levels together.
///
/// ```
/// # fn main() -> taut::Result<()> {
/// let mesh = taut::shapes::grid(4, 4).mesh()?;
/// let heights: Vec<f64> = mesh.positions().iter().map(|[x, ..]| x * x).collect();
/// let levels = taut::spaced_levels(&mesh, &heights, 5.0)?;
/// assert_eq!(levels, [5.0, 10.0, 15.0]);
/// let lines = taut::isolines(&mesh, &heights, &levels)?;
/// assert!(lines.len() == 3 && lines.iter().all(|line| !line.curve.is_closed));
/// // 5 lies 1/5 of the way from 2² to 3².
/// for [x, ..] in lines[0].curve.positions(&mesh)? {
///     assert!((x - 2.2).abs() < 1e-12);
/// }
/// # Ok(()) }
/// ```
///
/// # Errors
/// [`Reason::BadArgument`] where the number of values is not that of the vertices, or naming the level that is not
/// finite; [`Reason::TooManyElements`] where the levels exceed 32-bit indices.
pub fn isolines(mesh: &Mesh, values: &[f64], levels: &[f64]) -> Result<Vec<Isoline>> {
    let field = Field::new(mesh, values)?;
    if levels.len() >= NONE as usize {
        return Err(Error::new(Reason::TooManyElements, "the levels exceed 32-bit indices"));
    }
    for (i, level) in (0..).zip(levels) {
        if !level.is_finite() {
            return Err(Error::at(Reason::BadArgument, Element::Level(i), format!("is {level}, which is not finite")));
        }
    }
    let mates = field.mates();
    let mut last_level = vec![NONE; mesh.triangle_count()];
    let mut lines = Vec::new();
    for (level, crossed) in (0..).zip(field.crossed(levels)) {
        let mut tracer =
            Tracer { field, value: levels[level as usize], level, mates: &mates, last_level: &mut last_level };
        for f in crossed {
            if tracer.last_level[f as usize] != level {
                lines.extend(tracer.line(f)?.map(|curve| Isoline { level, curve }));
            }
        }
    }
    Ok(lines)
}

/// `count` levels, evenly spread between the least value m and the greatest M: m + (M - m) k / (count + 1) for k from 1
/// to `count`, ascending.
///
/// Only the values at triangles that can have lines count: those whose corners are all finite. The levels lie strictly
/// between m and M and are all different; there are fewer where so many numbers do not fit in, and none if m = M.
///
/// # Errors
/// [`Reason::BadArgument`] where `count` exceeds [`MAX_LEVELS`], or the number of values is not that of the vertices.
pub fn even_levels(mesh: &Mesh, values: &[f64], count: usize) -> Result<Vec<f64>> {
    if count > MAX_LEVELS {
        return Err(Error::new(Reason::BadArgument, format!("{count} levels are more than {MAX_LEVELS}")));
    }
    let Some((low, high)) = Field::new(mesh, values)?.range() else { return Ok(Vec::new()) };
    let share = |k: usize| k as f64 / (count + 1) as f64;
    // Not from M - m, which may overflow.
    Ok(ascending(low, high, (1..=count).map(|k| (1.0 - share(k)) * low + share(k) * high)))
}

/// All multiples of `spacing` that lie strictly between the least and the greatest value, ascending.
///
/// Which values count is as for [`even_levels`].
///
/// # Errors
/// [`Reason::BadArgument`] where `spacing` is not positive and finite, or so small that there would be more than
/// [`MAX_LEVELS`] levels, or where the number of values is not that of the vertices.
pub fn spaced_levels(mesh: &Mesh, values: &[f64], spacing: f64) -> Result<Vec<f64>> {
    if !(spacing > 0.0 && spacing.is_finite()) {
        let message = format!("the spacing of levels is {spacing}, but must be positive and finite");
        return Err(Error::new(Reason::BadArgument, message));
    }
    let Some((low, high)) = Field::new(mesh, values)?.range() else { return Ok(Vec::new()) };
    let first = (low / spacing).floor();
    let steps = (high / spacing).ceil() - first;
    // Where a quotient overflows, `steps` is infinite or no number.
    if steps.is_nan() || steps > MAX_LEVELS as f64 + 1.0 {
        let message = format!("a spacing of {spacing} from {low} to {high} makes more than {MAX_LEVELS} levels");
        return Err(Error::new(Reason::BadArgument, message));
    }
    Ok(ascending(low, high, (1..steps as usize).map(|k| (first + k as f64) * spacing)))
}

/// Of some levels those between the bounds, each greater than the one before it.
fn ascending(low: f64, high: f64, levels: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut kept = Vec::new();
    for level in levels {
        if level > kept.last().copied().unwrap_or(low) && level < high {
            kept.push(level);
        }
    }
    kept
}

/// A field on a mesh.
#[derive(Clone, Copy)]
struct Field<'a> {
    mesh: &'a Mesh,
    values: &'a [f64],
}

impl<'a> Field<'a> {
    fn new(mesh: &'a Mesh, values: &'a [f64]) -> Result<Field<'a>> {
        super::check_values(mesh, values)?;
        Ok(Field { mesh, values })
    }

    fn value(&self, v: u32) -> f64 {
        self.values[v as usize]
    }

    /// The least and the greatest corner of triangle `f`; `None` if it can have no lines.
    fn extent(&self, f: u32) -> Option<(f64, f64)> {
        let [a, b, c] = self.mesh.triangles()[f as usize].map(|v| self.value(v));
        let is_ignored = self.mesh.topology().edge_of[3 * f as usize] == NONE;
        let is_finite = a.is_finite() && b.is_finite() && c.is_finite();
        (is_finite && !is_ignored).then(|| (a.min(b).min(c), a.max(b).max(c)))
    }

    /// The extent of each triangle that can have lines.
    fn extents(&self) -> impl Iterator<Item = (u32, (f64, f64))> {
        (0..self.mesh.triangle_count() as u32).filter_map(|f| Some((f, self.extent(f)?))) // fits: Mesh checked it
    }

    /// The least and the greatest value that lines can have.
    fn range(&self) -> Option<(f64, f64)> {
        self.extents().map(|(_, extent)| extent).reduce(|(low, high), (min, max)| (low.min(min), high.max(max)))
    }

    /// The triangles that each level crosses, ascending.
    fn crossed(&self, levels: &[f64]) -> Vec<Vec<u32>> {
        let mut order: Vec<usize> = (0..levels.len()).collect();
        order.sort_by(|&i, &j| levels[i].total_cmp(&levels[j]));
        let up_to = |value: f64| order.partition_point(|&i| levels[i] <= value);
        let mut crossed = vec![Vec::new(); levels.len()];
        for (f, (min, max)) in self.extents() {
            // min < level ≤ max: a corner below, and one above.
            for &i in &order[up_to(min)..up_to(max)] {
                crossed[i].push(f);
            }
        }
        crossed
    }

    /// For each half-edge the one over which lines go on: where exactly two triangles with lines meet; else NONE.
    fn mates(&self) -> Vec<u32> {
        let halfedges = &self.mesh.topology().halfedges;
        let mut mates = vec![NONE; 3 * self.mesh.triangle_count()];
        for e in 0..halfedges.rows() {
            let mut with_lines = halfedges.row(e).iter().filter(|&h| self.extent(h / 3).is_some());
            if let (Some(&g), Some(&h), None) = (with_lines.next(), with_lines.next(), with_lines.next()) {
                mates[g as usize] = h;
                mates[h as usize] = g;
            }
        }
        mates
    }
}

/// Follows the lines of one level.
struct Tracer<'a> {
    field: Field<'a>,
    value: f64,
    level: u32,
    mates: &'a [u32],
    /// The last level whose lines crossed each triangle.
    last_level: &'a mut [u32],
}

impl Tracer<'_> {
    /// The line through triangle `f`, which the level crosses; `None` if it shrinks to a point.
    fn line(&mut self, f: u32) -> Result<Option<Curve>> {
        let (way, is_closed) = self.way(f);
        let mut points = Vec::with_capacity(way.len());
        let mut positions: Vec<[f64; 3]> = Vec::with_capacity(way.len());
        for h in way {
            let point = self.crossing(h);
            let position = point.position(self.field.mesh)?;
            // Of points in one place the last stays: the next segment lies in its triangle.
            if positions.last() == Some(&position) {
                positions.pop();
                points.pop();
            }
            positions.push(position);
            points.push(point);
        }
        if is_closed && points.len() > 1 && positions.first() == positions.last() {
            points.pop();
        }
        Ok((points.len() > 1).then_some(Curve { points, is_closed }))
    }

    /// The half-edges by which the line through triangle `f` enters one triangle after the other, and whether it is
    /// closed; if it is open, the one by which it leaves the last triangle follows.
    fn way(&mut self, f: u32) -> (VecDeque<u32>, bool) {
        let enter = self.descent(f);
        let mut way = VecDeque::from([enter]);
        let mut leave = self.across(enter);
        while self.mates[leave as usize] != NONE {
            let mate = self.mates[leave as usize];
            if mate == enter {
                return (way, true);
            }
            way.push_back(mate);
            leave = self.across(mate);
        }
        way.push_back(leave);
        let mut enter = enter;
        while self.mates[enter as usize] != NONE {
            enter = self.across(self.mates[enter as usize]);
            way.push_front(enter);
        }
        let edge_of = &self.field.mesh.topology().edge_of;
        let is_closed = edge_of[enter as usize] == edge_of[leave as usize];
        if is_closed {
            way.pop_back();
        }
        (way, is_closed)
    }

    fn is_above(&self, v: u32) -> bool {
        self.field.value(v) >= self.value
    }

    /// The half-edge of triangle `f` that starts above and ends below: entered there, a line has the height on its left.
    fn descent(&self, f: u32) -> u32 {
        let above = self.field.mesh.triangles()[f as usize].map(|v| self.is_above(v));
        let k = [0, 1].into_iter().find(|&k| above[k] && !above[k + 1]).unwrap_or(2);
        3 * f + k as u32 // fits: k < 3
    }

    /// The other crossed half-edge of the triangle of `h`, which is hereby visited.
    fn across(&mut self, h: u32) -> u32 {
        self.last_level[(h / 3) as usize] = self.level;
        let triangles = self.field.mesh.triangles();
        let [tail, apex] = [start(triangles, h), start(triangles, prev(h))];
        if self.is_above(apex) == self.is_above(tail) { next(h) } else { prev(h) }
    }

    /// The point where half-edge `h` is crossed, in its own triangle.
    fn crossing(&self, h: u32) -> SurfacePoint {
        let triangles = self.field.mesh.triangles();
        let [tail, head] = [h, next(h)].map(|h| self.field.value(start(triangles, h)));
        let weight = weights(tail, head, self.value);
        let mut barycentric = [0.0; 3];
        barycentric[(h % 3) as usize] = weight[0];
        barycentric[(next(h) % 3) as usize] = weight[1];
        SurfacePoint { face: h / 3, barycentric }
    }
}

/// The weights of the ends a and b, one below the level c and one not, at the point between them where c is taken.
fn weights(a: f64, b: f64, c: f64) -> [f64; 2] {
    // Halves where the difference overflows; elsewhere they would lose the last bit of the smallest numbers.
    let scale = if (b - a).is_finite() { 1.0 } else { 0.5 };
    let [a, b, c] = [a, b, c].map(|x| scale * x);
    let [to_a, to_b, whole] = [(c - a).abs(), (b - c).abs(), (b - a).abs()];
    // If both are the same, `whole` rounds to twice that, and the order of a and b does not matter here either.
    if to_a < to_b { [1.0 - to_a / whole, to_a / whole] } else { [to_b / whole, 1.0 - to_b / whole] }
}
