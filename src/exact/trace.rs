//! Distances and paths from any point of the surface, back to its nearest source.
//!
//! A point inside a triangle is reached over a corner, over a window on one of the sides, or straight from a source in the
//! triangle: the shortest of these is its distance. Its path goes back in straight pieces from pseudo-source to
//! pseudo-source. Along a piece what it comes from lies unfolded at S: the triangle beyond the edge is laid flat on S's
//! side, and either S is one of its corners, or the straight line to S leaves it by one of its two other sides.
//!
//! Where the line passes close to a corner rounding decides on which side. The other side is kept in mind, and taken where
//! the first one does not lead to the pseudo-source. Where an edge has several triangles each is tried in which the
//! distances of the corners allow it.
//!
//! Where triangles without area lie upon each other rounding may lead astray all the same: then a way over a corner does
//! that is as short. A path that is not as long as its distance is not given.
//!
//! A distance costs as much as the triangle has windows, a path as many steps as it crosses triangles.

use super::Prepared;
use super::charts::Chart;
use super::propagate::{Arrival, Found};
use super::segment::Flat;
use super::window::{Entry, Turn};
use crate::mesh::topology::{NONE, next, prev};
use crate::metric::distance;
use crate::surface::point::{Place, SurfacePoint};
use std::collections::HashSet;

/// What a finished propagation knows.
pub(crate) struct Trace<'a> {
    pub(crate) solver: &'a Prepared,
    pub(crate) found: &'a Found,
}

/// The shortest path to a place.
pub(crate) struct Best {
    /// Its length and the start distance of its source, in units.
    pub(crate) distance: f64,
    /// The source that it comes from, counted as the caller does.
    pub(crate) source: Option<u32>,
    way: Way,
}

/// Over what the shortest path to a place comes.
#[derive(Debug, Clone, Copy)]
enum Way {
    /// The place is this vertex.
    Vertex(u32),
    /// To the point over this corner of its triangle.
    Corner(SurfacePoint, u32),
    /// To the point in one straight piece.
    Straight(SurfacePoint, Arrival),
}

/// A line that passes a corner at an angle below this passes it on both sides, for all that rounding tells.
const CLOSE_CALL: f64 = 1e-6;

/// How far S may be from where it should be, as a share of the way to it and of the triangle's size.
const FOUND: f64 = 1e-7;

/// A path as long as its distance up to this share is right: more than rounding, less than another way.
const LENGTH_OFF: f64 = 1e-9;

/// Distances below this, in units, the size of the mesh, are as good as nothing to that end.
const LEAST: f64 = 1e-4;

/// How many triangles are tried for one piece, as a multiple of all: it crosses none twice.
const MOST_TRIED: usize = 16;

/// Paths are as short as each other if they differ by this share.
const AS_SHORT: f64 = 1e-13;

/// A place on an edge that is nearer to its end than this share of its length is the end.
const AT_END: f64 = 1e-13;

impl Trace<'_> {
    /// The shortest path to a place; None where no path leads.
    pub(crate) fn best(&self, place: Place) -> Option<Best> {
        let (distance, way) = match place {
            Place::Vertex(v) => (self.found.label[v as usize], Way::Vertex(v)),
            Place::Face(point) => self.best_inside(&point)?,
        };
        let emission = match way {
            Way::Vertex(v) | Way::Corner(_, v) => self.found.arrival[v as usize].emission,
            Way::Straight(_, arrival) => arrival.emission,
        };
        let source = self.found.emissions.get(emission as usize).map(|emission| emission.source);
        (distance < f64::INFINITY).then_some(Best { distance, source, way })
    }

    /// The distance of a point inside triangles, and over what its shortest path comes.
    fn best_inside(&self, point: &SurfacePoint) -> Option<(f64, Way)> {
        let mut best: Option<(f64, Way)> = None;
        let mut offer = |distance: f64, way: Way| {
            if distance < best.map_or(f64::INFINITY, |(least, _)| least) {
                best = Some((distance, way));
            }
        };
        for point in point.in_triangles(&self.solver.mesh) {
            let SurfacePoint { face, barycentric: weights } = point;
            for h in 3 * face..3 * face + 3 {
                let chart = self.solver.charts[h as usize];
                let [x, y] = chart.place(h, weights);
                offer(self.found.label[chart.start as usize] + x.hypot(y), Way::Corner(point, chart.start));
                let seen = Chart { tx: x, ty: y, ..chart };
                let windows = self.found.kept.iter().flat_map(|kept| kept.on(h));
                let entry = windows.fold(Entry::default(), |best, window| window.entry(&seen, best));
                offer(entry.distance, Way::Straight(point, Arrival::over(h, &entry, &self.found.emissions)));
            }
            let h = 3 * face;
            let chart = self.solver.charts[h as usize];
            let [x, y] = chart.place(h, weights);
            for inner in self.found.inner_of(face) {
                let flat = Flat::new(&chart, h, &inner.segment);
                let [sx, sy] = flat.place(flat.nearest([x, y]));
                let straight = Arrival { h, emission: inner.emission, at: sx, sx, sy: -sy };
                let sigma = self.found.emissions[inner.emission as usize].sigma;
                offer(sigma + (sx - x).hypot(sy - y), Way::Straight(point, straight));
            }
        }
        best
    }

    /// The shortest path from a place back to its nearest source; each point but the last names the triangle of the
    /// segment behind it, the last that of the segment before it. None where no path as long as the distance is found.
    pub(crate) fn path(&self, best: &Best) -> Option<Vec<SurfacePoint>> {
        let points = self.found_back(best)?;
        // The first throw of each source is its own, in their order.
        let own = best.source.and_then(|source| self.found.emissions.get(source as usize));
        let expected = best.distance - own.map_or(0.0, |emission| emission.sigma);
        let is_right = (self.length(&points) - expected).abs() <= LENGTH_OFF * (best.distance + LEAST);
        is_right.then_some(points)
    }

    /// In units.
    fn length(&self, points: &[SurfacePoint]) -> f64 {
        let solver = self.solver;
        let position = |point: &SurfacePoint| point.position(&solver.mesh).map(|p| p.map(|x| solver.scale.to_unit(x)));
        let positions: Vec<[f64; 3]> = points.iter().flat_map(position).collect();
        positions.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
    }

    fn found_back(&self, best: &Best) -> Option<Vec<SurfacePoint>> {
        let mut points = Vec::new();
        let mut v = match best.way {
            Way::Vertex(v) => v,
            Way::Corner(point, v) => {
                points.extend([point, SurfacePoint::corner(&self.solver.mesh, point.face, v)?]);
                v
            }
            Way::Straight(point, arrival) => {
                points.push(point);
                let from = self.solver.charts[arrival.h as usize].place(arrival.h, point.barycentric);
                self.piece(arrival, from, &mut points)?
            }
        };
        // A path comes over no vertex twice.
        for _ in 0..=self.found.label.len() {
            if v == NONE {
                return Some(self.merged(points));
            }
            let arrival = self.found.arrival[v as usize];
            if arrival.h == NONE {
                if points.is_empty() {
                    let &corner = self.solver.mesh.topology().corners.row(v).first()?;
                    points.push(SurfacePoint::corner(&self.solver.mesh, corner / 3, v)?);
                }
                return Some(self.merged(points));
            }
            points.push(SurfacePoint::corner(&self.solver.mesh, arrival.h / 3, v)?);
            let chart = &self.solver.charts[arrival.h as usize];
            v = self.piece(arrival, [chart.tx, chart.ty], &mut points)?;
        }
        None
    }

    /// Follows a straight piece back; `points` ends with the point from which it starts, which lies at `from` in the chart
    /// of the arrival's half-edge. Returns the vertex that it leads to, NONE for a source that is no vertex.
    ///
    /// Where triangles without area lie upon each other rounding may lead astray; then a way over a corner does that is as
    /// short.
    fn piece(&self, arrival: Arrival, from: [f64; 2], points: &mut Vec<SurfacePoint>) -> Option<u32> {
        let length = points.len();
        let (end, vertex) = self.straight(arrival, points).or_else(|| {
            points.truncate(length);
            self.over_corner(arrival.h, from, self.distance_at(&arrival, from))
        })?;
        points.push(end);
        Some(vertex)
    }

    fn straight(&self, arrival: Arrival, points: &mut Vec<SurfacePoint>) -> Option<(SurfacePoint, u32)> {
        let vertex = self.found.emissions.get(arrival.emission as usize)?.vertex;
        // On the edge itself it lies in this triangle and in those beyond.
        if arrival.sy <= 0.0
            && let Some(end) = self.end_in(arrival.h, arrival)
        {
            return Some((end, vertex));
        }
        if let Some(end) = self.end_on(&arrival, vertex) {
            return Some((end, vertex));
        }
        let beyond = |stand: Arrival, length: usize| {
            self.solver.others(stand.h).map(move |g| (Beyond::new(self.solver, g, &stand), length))
        };
        let mut open: Vec<(Beyond, usize)> = beyond(arrival, points.len()).collect();
        // Different ways round an edge of several triangles can lead to the same place again.
        let mut tried = HashSet::new();
        let mut astray = None;
        while let Some((triangle, length)) = open.pop() {
            if !tried.insert(triangle.key()) {
                continue;
            }
            if tried.len() > MOST_TRIED * self.solver.mesh.triangle_count() {
                break;
            }
            points.truncate(length);
            points.push(triangle.point());
            let exits = triangle.exits(self.solver);
            let on_side = || exits.iter().flatten().find_map(|exit| self.end_on(exit, vertex));
            if let Some(end) = self.end_in(triangle.g, triangle.stand).or_else(on_side) {
                return Some((end, vertex));
            }
            if astray.is_none() {
                let here = [triangle.stand.at, 0.0];
                let over = self.over_corner(triangle.g, here, self.distance_at(&triangle.stand, here));
                astray = over.map(|over| (points.clone(), over));
            }
            open.extend(
                exits.into_iter().flatten().filter(|exit| self.may_be(exit)).flat_map(|exit| beyond(exit, length + 1)),
            );
        }
        let (way, end) = astray?;
        *points = way;
        Some(end)
    }

    /// Of points that coincide only one: the segment between has no length. The one that comes first, if it lies in the
    /// triangle of the segment behind the other too.
    fn merged(&self, points: Vec<SurfacePoint>) -> Vec<SurfacePoint> {
        let position = |point: &SurfacePoint| point.position(&self.solver.mesh).ok();
        let mut merged: Vec<SurfacePoint> = Vec::with_capacity(points.len());
        for point in points {
            let same = merged.pop_if(|before| position(before) == position(&point));
            let renamed = same.and_then(|before| before.in_triangle(&self.solver.mesh, point.face));
            merged.push(renamed.unwrap_or(point));
        }
        // The last point names the triangle of the segment before it.
        if let [.., before, end] = &mut merged[..]
            && let Some(renamed) = end.in_triangle(&self.solver.mesh, before.face)
        {
            *end = renamed;
        }
        merged
    }

    /// The distance of a place in the chart of a stand's half-edge, on the triangle's side, by way of where it stands.
    fn distance_at(&self, stand: &Arrival, from: [f64; 2]) -> f64 {
        let sigma = self.found.emissions.get(stand.emission as usize).map_or(0.0, |emission| emission.sigma);
        sigma + (stand.at - from[0]).hypot(from[1]) + (stand.sx - stand.at).hypot(stand.sy)
    }

    /// A corner of the triangle of half-edge h over which a path from a place in its chart is no longer than `distance`.
    fn over_corner(&self, h: u32, [x, y]: [f64; 2], distance: f64) -> Option<(SurfacePoint, u32)> {
        let chart = &self.solver.charts[h as usize];
        let corners = [(h, [0.0, 0.0]), (next(h), [chart.length, 0.0]), (prev(h), [chart.tx, chart.ty])];
        let over = |&(h, [cx, cy]): &(u32, [f64; 2])| {
            let label = self.found.label[self.solver.start(h) as usize];
            label < distance && label + (cx - x).hypot(cy - y) <= distance * (1.0 + AS_SHORT)
        };
        let v = self.solver.start(corners.iter().find(|corner| over(corner))?.0);
        Some((SurfacePoint::corner(&self.solver.mesh, h / 3, v)?, v))
    }

    /// Whether the distance where a path stands agrees with those of the ends of the edge. Where an edge has several
    /// triangles this tells which of them the path came through.
    fn may_be(&self, stand: &Arrival) -> bool {
        let chart = &self.solver.charts[stand.h as usize];
        let sigma = self.found.emissions[stand.emission as usize].sigma;
        let distance = sigma + (stand.sx - stand.at).hypot(stand.sy);
        let is_near = |v: u32, way: f64| {
            let label = self.found.label[v as usize];
            (label - distance).abs() <= way + FOUND * (chart.length + distance - sigma)
        };
        is_near(chart.start, stand.at) && is_near(self.solver.start(next(stand.h)), chart.length - stand.at)
    }

    /// The end of the edge on which a path stands, if that is what it comes from.
    fn end_on(&self, stand: &Arrival, vertex: u32) -> Option<SurfacePoint> {
        let chart = &self.solver.charts[stand.h as usize];
        let near = FOUND * chart.length;
        let end = if vertex == chart.start && stand.sx.hypot(stand.sy) <= near {
            stand.h
        } else if vertex == self.solver.start(next(stand.h)) && (chart.length - stand.sx).hypot(stand.sy) <= near {
            next(stand.h)
        } else {
            return None;
        };
        let mut barycentric = [0.0; 3];
        barycentric[(end % 3) as usize] = 1.0;
        Some(SurfacePoint { face: stand.h / 3, barycentric })
    }

    /// What a path comes from, if it lies in the triangle of half-edge h, in whose chart the stand looks for it at
    /// (sx, -sy).
    fn end_in(&self, h: u32, stand: Arrival) -> Option<SurfacePoint> {
        let chart = &self.solver.charts[h as usize];
        let vertex = self.found.emissions[stand.emission as usize].vertex;
        let way = (stand.sx - stand.at).hypot(stand.sy);
        let near = FOUND * (chart.length + chart.tx.hypot(chart.ty) + way);
        let is_at = |[x, y]: [f64; 2]| (x - stand.sx).hypot(y + stand.sy) <= near;
        if vertex == NONE {
            let inner = self.found.inner_of(h / 3).iter().filter(|inner| inner.emission == stand.emission);
            return inner.map(|inner| &inner.segment).find_map(|segment| {
                let flat = Flat::new(chart, h, segment);
                let share = flat.nearest([stand.sx, -stand.sy]);
                is_at(flat.place(share)).then(|| segment.at(share))
            });
        }
        let corner = SurfacePoint::corner(&self.solver.mesh, h / 3, vertex)?;
        is_at(chart.place(h, corner.barycentric)).then_some(corner)
    }
}

/// The triangle beyond an edge, and what is looked for as seen from there.
struct Beyond {
    g: u32,
    chart: Chart,
    /// In the chart of g; sy is negative, as the triangle lies on that side.
    stand: Arrival,
}

impl Beyond {
    fn new(solver: &Prepared, g: u32, stand: &Arrival) -> Beyond {
        let chart = solver.charts[g as usize];
        let is_mirrored = chart.start != solver.start(stand.h);
        let from_start = |x: f64| if is_mirrored { chart.length - x } else { x };
        let (at, sx) = (from_start(stand.at), from_start(stand.sx));
        Beyond { g, chart, stand: Arrival { h: g, at, sx, sy: -stand.sy, ..*stand } }
    }

    /// The half-edge, and roughly the place on it and that of S.
    fn key(&self) -> (u32, [i64; 3]) {
        let Arrival { at, sx, sy, .. } = self.stand;
        (self.g, [at, sx, sy].map(|x| (x / self.chart.length * 1e7).round() as i64))
    }

    /// Where the path crosses the edge.
    fn point(&self) -> SurfacePoint {
        let share = if self.chart.length > 0.0 { self.stand.at / self.chart.length } else { 0.0 };
        let mut barycentric = [0.0; 3];
        let at_end = match share {
            share if share < AT_END => 0.0,
            share if share > 1.0 - AT_END => 1.0,
            share => share,
        };
        barycentric[(self.g % 3) as usize] = 1.0 - at_end;
        barycentric[(next(self.g) % 3) as usize] = at_end;
        SurfacePoint { face: self.g / 3, barycentric }
    }

    /// The sides by which the line to S leaves the triangle, the likelier one last.
    fn exits(&self, solver: &Prepared) -> [Option<Arrival>; 2] {
        let Chart { length, tx, ty, .. } = self.chart;
        let Arrival { at, sx, sy, .. } = self.stand;
        let depth = -sy;
        // Positive where S lies to the left of the apex.
        let left = (tx - at) * depth - ty * (sx - at);
        let is_close = left.abs() <= CLOSE_CALL * (tx - at).hypot(ty) * (sx - at).hypot(depth);
        let by_start = (left > 0.0 || is_close).then(|| {
            let (side, from_start) = (prev(self.g), at * depth);
            let share = share(from_start, left.max(0.0));
            let turn = Turn::left(&self.chart, solver.charts[side as usize].length);
            let [along, beyond] = turn.ahead(sx, depth);
            let side_length = solver.charts[side as usize].length;
            Arrival { h: side, at: side_length * (1.0 - share), sx: side_length - along, sy: beyond, ..self.stand }
        });
        let by_end = (left <= 0.0 || is_close).then(|| {
            let side = next(self.g);
            let share = share((length - at) * depth, (-left).max(0.0));
            let right = &solver.charts[side as usize];
            let [along, beyond] = Turn::right(&self.chart, right).ahead(length - sx, depth);
            Arrival { h: side, at: right.length * share, sx: along, sy: beyond, ..self.stand }
        });
        let is_ahead = |exit: &Arrival| exit.sy >= -FOUND * (length + depth);
        let exits = if left > 0.0 { [by_end, by_start] } else { [by_start, by_end] };
        exits.map(|exit| exit.filter(is_ahead).map(|exit| Arrival { sy: exit.sy.max(0.0), ..exit }))
    }
}

/// How far along a side a line leaves between its ends, from their twice-areas with it.
fn share(near: f64, far: f64) -> f64 {
    if near > 0.0 { near / (near + far) } else { 0.0 }
}
