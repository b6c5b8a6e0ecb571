//! Where heat is put in, and where distances are known beforehand.
//!
//! A vertex takes its heat itself. A point inside a triangle divides it among the corners by its weights, a curve all
//! along, as the integral of each corner's hat function over the curve: what piecewise linear functions see of it.
//!
//! Near a source distances are known: 0 at a vertex, the straight way from the point or the curve at the corners of the
//! triangles that it lies in. These corners are *pinned*. One that another source reaches sooner, along edges, is not.
//!
//! Cost: linear in the sources, and a search along edges as far as start distances differ.

use super::systems::Systems;
use crate::error::{Element, Error, Reason, Result};
use crate::linear::Pin;
use crate::mesh::topology::{NONE, next, prev, start};
use crate::metric::{distance, dot, minus};
use crate::surface::curve::Segment;
use crate::surface::point::{Place, SurfacePoint};
use crate::surface::source::{Origin, Seed};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// A pin gives way where another is nearer by more than this share of its distance.
const SOONER: f64 = 1e-12;

/// The sources of one query, as the systems use them.
#[derive(Debug)]
pub(super) struct Placed {
    pub(super) charges: Vec<Charge>,
    /// The components with sources.
    pub(super) parts: Vec<Part>,
    /// Vertices whose distance is a start distance, in mesh units, and which source's: they have it to the last bit.
    pub(super) starts: Vec<(u32, f64)>,
    /// The source whose distance each pinned vertex has.
    pub(super) nearest: Vec<(u32, u32)>,
}

/// Heat that a source puts in at a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Charge {
    pub(super) v: u32,
    pub(super) weight: f64,
    /// The start distance above the smallest of the component, in units: heat that starts late has decayed before.
    pub(super) delay: f64,
}

/// A component with sources.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) component: u32,
    /// The smallest start distance, in mesh units.
    pub(super) base: f64,
    /// Distances above it that are known, in units.
    pub(super) pins: Vec<Pin>,
}

/// A source at some vertices: the share of its heat and its distance from each.
struct Spread {
    shares: Vec<(u32, f64)>,
    near: Vec<(u32, f64)>,
}

impl Placed {
    /// Expresses sources in units, of which `first` others stand before these. `time_step` is t in units squared.
    pub(super) fn new((first, seeds): (u64, &[Seed]), systems: &Systems, time_step: f64) -> Result<Placed> {
        let mesh = &systems.mesh;
        let spreads: Vec<Spread> = seeds.iter().map(|seed| Spread::of(seed, systems, time_step.sqrt())).collect();
        let component = |spread: &Spread| mesh.topology().component[spread.near[0].0 as usize];
        let mut base: HashMap<u32, f64> = HashMap::new();
        for (seed, spread) in seeds.iter().zip(&spreads) {
            let base = base.entry(component(spread)).or_insert(f64::INFINITY);
            *base = seed.offset.min(*base);
        }
        let mut placed = Placed { charges: Vec::new(), parts: Vec::new(), starts: Vec::new(), nearest: Vec::new() };
        let mut known = Vec::new();
        for (seed, spread) in seeds.iter().zip(&spreads) {
            if component(spread) == NONE {
                placed.start_alone(spread.near[0].0, seed);
                continue;
            }
            let delay = systems.scale.to_unit(seed.offset - base[&component(spread)]);
            check(first + u64::from(seed.source), seed, spread, delay, systems)?;
            placed.charges.extend(spread.shares.iter().map(|&(v, weight)| Charge { v, weight, delay }));
            known.extend(spread.near.iter().map(|&(v, distance)| Known {
                v,
                value: delay + distance,
                source: seed.source,
            }));
        }
        let known = nearest_known(known, systems);
        placed.pin(&known, seeds, &base, &mesh.topology().component);
        Ok(placed)
    }

    /// A source at a vertex that no triangle uses.
    fn start_alone(&mut self, v: u32, seed: &Seed) {
        match self.starts.iter_mut().zip(&mut self.nearest).find(|((start, _), _)| *start == v) {
            Some(((_, least), (_, source))) if seed.offset < *least => (*least, *source) = (seed.offset, seed.source),
            Some(_) => {}
            None => {
                self.starts.push((v, seed.offset));
                self.nearest.push((v, seed.source));
            }
        }
    }

    fn pin(&mut self, known: &[Known], seeds: &[Seed], base: &HashMap<u32, f64>, component: &[u32]) {
        let mut part_of: HashMap<u32, usize> = HashMap::new();
        for &Known { v, value, source } in known {
            let component = component[v as usize];
            let part = *part_of.entry(component).or_insert_with(|| {
                self.parts.push(Part { component, base: base[&component], pins: Vec::new() });
                self.parts.len() - 1
            });
            self.parts[part].pins.push((v, value));
            self.nearest.push((v, source));
            if matches!(seeds[source as usize].origin, Origin::Place(Place::Vertex(_))) {
                self.starts.push((v, seeds[source as usize].offset));
            }
        }
    }
}

/// Refuses a source whose start distance is out of all proportion, or whose heat is all absorbed.
fn check(number: u64, seed: &Seed, spread: &Spread, delay: f64, systems: &Systems) -> Result<()> {
    let at_source = |reason, message| Err(Error::at(reason, Element::Source(number), message));
    if !delay.is_finite() {
        let message = format!("has the start distance {}, out of all proportion to the mesh", seed.offset);
        return at_source(Reason::BadArgument, message);
    }
    if systems.options.boundary == 1.0 && spread.shares.iter().all(|&(v, _)| systems.on_boundary[v as usize]) {
        let message = "lies on the boundary, which absorbs all heat (boundary is 1)".to_owned();
        return at_source(Reason::SourceOnBoundary, message);
    }
    Ok(())
}

impl Spread {
    fn of(seed: &Seed, systems: &Systems, reach: f64) -> Spread {
        let corners = |face: u32| systems.mesh.triangles()[face as usize];
        match &seed.origin {
            Origin::Place(Place::Vertex(v)) => Spread { shares: vec![(*v, 1.0)], near: vec![(*v, 0.0)] },
            Origin::Place(Place::Face(point)) => Spread {
                shares: corners(point.face).into_iter().zip(point.barycentric).filter(|&(_, w)| w > 0.0).collect(),
                near: near_point(point, systems),
            },
            Origin::Curve(route) => match Spread::along(&route.segments, systems, reach) {
                // A curve without length is a point.
                spread if spread.shares.is_empty() => {
                    let origin = Origin::Place(route.points[0].as_place(&systems.mesh));
                    Spread::of(&Seed { origin, ..seed.clone() }, systems, reach)
                }
                spread => spread,
            },
        }
    }

    fn along(segments: &[Segment], systems: &Systems, reach: f64) -> Spread {
        let corners = |face: u32| systems.mesh.triangles()[face as usize];
        let (mut shares, mut near) = (Vec::new(), Vec::new());
        for segment in segments {
            let ends = segment.ends.map(|barycentric| SurfacePoint { face: segment.face, barycentric });
            let [from, to] = ends.map(|point| unit_position(&point, systems));
            // In the unit of heat's own length √t, so that curves and points warm alike.
            let half = distance(from, to) / reach / 2.0;
            let share = |k: usize| half * (ends[0].barycentric[k] + ends[1].barycentric[k]);
            shares.extend((0..3).map(|k| (corners(segment.face)[k], share(k))).filter(|&(_, share)| share > 0.0));
            for segment in segment.in_triangles(&systems.mesh) {
                let away = |v: u32| distance_to_segment(systems.unit_position(v), from, to);
                near.extend(corners(segment.face).map(|v| (v, away(v))));
            }
        }
        Spread { shares, near }
    }
}

/// The straight distances from a point to the corners of all triangles that it lies in.
fn near_point(point: &SurfacePoint, systems: &Systems) -> Vec<(u32, f64)> {
    let mesh = &systems.mesh;
    let position = unit_position(point, systems);
    let corners = point.in_triangles(mesh).into_iter().flat_map(|point| mesh.triangles()[point.face as usize]);
    corners.map(|v| (v, distance(position, systems.unit_position(v)))).collect()
}

fn unit_position(point: &SurfacePoint, systems: &Systems) -> [f64; 3] {
    let corners = systems.mesh.triangles()[point.face as usize].map(|v| systems.unit_position(v));
    [0, 1, 2].map(|axis| (0..3).map(|k| point.barycentric[k] * corners[k][axis]).sum())
}

fn distance_to_segment(p: [f64; 3], from: [f64; 3], to: [f64; 3]) -> f64 {
    let (along, to_p) = (minus(to, from), minus(p, from));
    let squared = dot(along, along);
    let share = if squared > 0.0 { (dot(along, to_p) / squared).clamp(0.0, 1.0) } else { 0.0 };
    distance(p, [0, 1, 2].map(|k| from[k] + share * along[k]))
}

/// A distance that is known beforehand, in units above the smallest start distance of its component.
#[derive(Clone, Copy)]
struct Known {
    v: u32,
    value: f64,
    source: u32,
}

/// For each vertex the least of what is known, and only where no other vertex's comes to less along edges.
fn nearest_known(mut known: Vec<Known>, systems: &Systems) -> Vec<Known> {
    known.sort_by(|a, b| a.v.cmp(&b.v).then(a.value.total_cmp(&b.value)).then(a.source.cmp(&b.source)));
    known.dedup_by_key(|known| known.v);
    let along_edges = distances_along_edges(&known, systems);
    known.retain(|known| known.value * (1.0 - SOONER) <= along_edges[&known.v]);
    known
}

/// The least distances along edges from what is known, as far as these go (Dijkstra).
fn distances_along_edges(known: &[Known], systems: &Systems) -> HashMap<u32, f64> {
    let mesh = &systems.mesh;
    let mut least: HashMap<u32, f64> = known.iter().map(|known| (known.v, known.value)).collect();
    // The bits of numbers from 0 on are ordered as the numbers are.
    let mut queue: BinaryHeap<Reverse<(u64, u32)>> =
        known.iter().map(|known| Reverse((known.value.to_bits(), known.v))).collect();
    let farthest = known.iter().map(|known| known.value).fold(0.0, f64::max);
    while let Some(Reverse((bits, v))) = queue.pop() {
        let to_v = f64::from_bits(bits);
        if to_v > least[&v] {
            continue;
        }
        let corners = mesh.topology().corners.row(v).iter();
        for u in corners.flat_map(|&h| [next(h), prev(h)]).map(|h| start(mesh.triangles(), h)) {
            let to_u = to_v + distance(systems.unit_position(v), systems.unit_position(u));
            if to_u <= farthest && least.get(&u).is_none_or(|&least| to_u < least) {
                least.insert(u, to_u);
                queue.push(Reverse((to_u.to_bits(), u)));
            }
        }
    }
    least
}
