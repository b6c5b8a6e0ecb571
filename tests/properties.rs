//! What must hold on every mesh, tried on random ones: soups, surfaces with random heights, and made-up shapes.

use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::RngSeed;
use std::f64::consts::TAU;
use taut::shapes::{self, Shape, subdivided};
use taut::{
    Control, ElementType, ExactOptions, ExactSolver, Faces, HeatOptions, HeatSolver, IndexType, Mesh, Rows, ScalarType,
    Source, TimeFormula, TimeScale, TimeStep,
};

/// The same cases on every machine and in every run.
fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() }
}

/// Triangles over any three of a few points, which lie on a lattice or anywhere.
fn soup() -> impl Strategy<Value = Shape> {
    let lattice = (0..3u8, 0..3u8, 0..3u8).prop_map(|(x, y, z)| [x, y, z].map(f64::from));
    let positions = prop_oneof![
        prop::collection::vec(lattice, 4..10),
        prop::collection::vec([0.0..1.0, 0.0..1.0, 0.0..1.0], 4..10)
    ];
    positions.prop_flat_map(|positions| {
        let vertex = || 0..positions.len() as u32;
        let triangles = prop::collection::vec([vertex(), vertex(), vertex()], 1..13);
        (Just(positions), triangles).prop_map(|(positions, triangles)| Shape { positions, triangles })
    })
}

/// An open grid with a random height at each vertex. No four vertices lie on a circle, so there are no ties that heat
/// would break by number.
fn heights() -> impl Strategy<Value = Shape> {
    (2..9u32, 2..9u32).prop_flat_map(|(columns, rows)| {
        let flat = shapes::grid(columns, rows);
        prop::collection::vec(0.0..1.5, flat.positions.len()).prop_map(move |z| {
            let mut shape = flat.clone();
            shape.positions.iter_mut().zip(z).for_each(|(position, z)| position[2] = z);
            shape
        })
    })
}

/// Symmetric surfaces, where many ways are equally long.
fn made() -> impl Strategy<Value = Shape> {
    prop_oneof![
        (2..12u32, 2..12u32).prop_map(|(columns, rows)| shapes::grid(columns, rows)),
        (2..12u32).prop_map(shapes::saddle),
        (3..12u32, 1..8u32, 0.1..9.0).prop_map(|(sides, rows, height)| shapes::cylinder(sides, rows, height)),
        (3..14u32, 3..9u32, 0.1..0.9).prop_map(|(columns, rows, minor)| shapes::torus(columns, rows, 1.0, minor)),
        (1..7u32, 0.1..0.9, 1..5u32).prop_map(|(pairs, share, rings)| {
            let sides = 2 * pairs + 4;
            shapes::cone(share * f64::from(sides) * TAU / 2.0, sides, rings)
        }),
        (0..3u32).prop_map(shapes::icosphere),
    ]
}

fn any_mesh() -> impl Strategy<Value = Shape> {
    prop_oneof![3 => soup(), 1 => heights(), 1 => made()]
}

fn vertex(shape: &Shape, index: Index) -> u32 {
    index.index(shape.positions.len()) as u32
}

fn exact_from(mesh: &Mesh, sources: &[Source]) -> Vec<f64> {
    let solver = ExactSolver::new(mesh).unwrap();
    solver.field(sources, &ExactOptions::default(), &Control::new()).unwrap().distances().to_vec()
}

fn exact(shape: &Shape, source: u32) -> Vec<f64> {
    exact_from(&shape.mesh().unwrap(), &[Source::vertex(source)])
}

fn heat(mesh: &Mesh, source: u32) -> Vec<f64> {
    let solver = HeatSolver::new(mesh, &HeatOptions::default(), &Control::new()).unwrap();
    solver.field(&[Source::vertex(source)], &Control::new()).unwrap().into_distances()
}

fn largest(distances: &[f64]) -> f64 {
    distances.iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max)
}

/// Equal up to a share of the largest distance, and infinite at the same vertices.
fn close(found: &[f64], expected: &[f64], share: f64) -> Result<(), TestCaseError> {
    prop_assert_eq!(found.len(), expected.len());
    for (v, (&d, &e)) in found.iter().zip(expected).enumerate() {
        prop_assert!(d == e || (d - e).abs() <= share * largest(expected), "vertex {v}: {d} should be {e}");
    }
    Ok(())
}

fn straight(shape: &Shape, a: u32, b: u32) -> f64 {
    let [p, q] = [a, b].map(|v| shape.positions[v as usize]);
    (0..3).map(|axis| (p[axis] - q[axis]).powi(2)).sum::<f64>().sqrt()
}

fn moved(shape: &Shape, to: impl Fn([f64; 3]) -> [f64; 3]) -> Shape {
    Shape { positions: shape.positions.iter().map(|&p| to(p)).collect(), triangles: shape.triangles.clone() }
}

/// Turned about the z axis, about the x axis, and shifted.
fn rigid(shape: &Shape, [turn, tilt]: [f64; 2], shift: [f64; 3]) -> Shape {
    let [(s, c), (sin, cos)] = [turn.sin_cos(), tilt.sin_cos()];
    moved(shape, |[x, y, z]| {
        let [x, y] = [c * x - s * y, s * x + c * y];
        [x + shift[0], cos * y - sin * z + shift[1], sin * y + cos * z + shift[2]]
    })
}

/// The same surface under other numbers: vertex v becomes `number[v]`; triangles come in another order, with their
/// corners in another, and facing either way.
#[derive(Debug, Clone)]
struct Relabelled {
    plain: Shape,
    other: Shape,
    number: Vec<u32>,
}

fn relabelled(meshes: impl Strategy<Value = Shape>) -> impl Strategy<Value = Relabelled> {
    meshes.prop_flat_map(|plain| {
        let number = Just((0..plain.positions.len() as u32).collect::<Vec<_>>()).prop_shuffle();
        let order = Just((0..plain.triangles.len()).collect::<Vec<_>>()).prop_shuffle();
        let corners = prop::collection::vec(Just([0, 1, 2]).prop_shuffle(), plain.triangles.len());
        (number, order, corners).prop_map(move |(number, order, corners)| {
            let mut positions = plain.positions.clone();
            number.iter().zip(&plain.positions).for_each(|(&to, &position)| positions[to as usize] = position);
            let triangle = |&f: &usize| corners[f].map(|k: usize| number[plain.triangles[f][k] as usize]);
            let other = Shape { positions, triangles: order.iter().map(triangle).collect() };
            Relabelled { plain: plain.clone(), other, number }
        })
    })
}

impl Relabelled {
    /// The other mesh's distances in the order of the plain mesh's vertices.
    fn in_plain_order(&self, distances: &[f64]) -> Vec<f64> {
        self.number.iter().map(|&v| distances[v as usize]).collect()
    }
}

proptest! {
    #![proptest_config(config(1000))]

    #[test]
    fn exact_scales(shape in any_mesh(), at in any::<Index>(), exponent in -950..950i32, factor in 0.001..1000.0) {
        let source = vertex(&shape, at);
        let plain = exact(&shape, source);
        let times = |factor: f64| plain.iter().map(|d| d * factor).collect::<Vec<_>>();
        let power = 2f64.powi(exponent);
        prop_assert_eq!(exact(&moved(&shape, |p| p.map(|x| x * power)), source), times(power));
        close(&exact(&moved(&shape, |p| p.map(|x| x * factor)), source), &times(factor), 1e-14)?;
    }

    #[test]
    fn exact_knows_no_place(
        shape in any_mesh(), at in any::<Index>(), angles in [0.0..TAU, 0.0..TAU], shift in [-9.0..9.0, -9.0..9.0, -9.0..9.0]
    ) {
        let source = vertex(&shape, at);
        close(&exact(&rigid(&shape, angles, shift), source), &exact(&shape, source), 1e-12)?;
    }

    #[test]
    fn exact_knows_no_numbers(pair in relabelled(any_mesh()), at in any::<Index>()) {
        let source = vertex(&pair.plain, at);
        let other = exact(&pair.other, pair.number[source as usize]);
        close(&pair.in_plain_order(&other), &exact(&pair.plain, source), 1e-13)?;
    }

    /// The last of these bounds distances by paths of edges, too.
    #[test]
    fn exact_is_a_metric(shape in any_mesh(), at in [any::<Index>(), any::<Index>()]) {
        let [a, b] = at.map(|at| vertex(&shape, at));
        let [from_a, from_b] = [a, b].map(|v| exact(&shape, v));
        let rounding = 1e-12 * largest(&from_a).max(largest(&from_b));
        close(&[from_a[b as usize]], &[from_b[a as usize]], 1e-12)?;
        for v in 0..shape.positions.len() {
            prop_assert!(from_a[v] >= straight(&shape, a, v as u32) - rounding);
            prop_assert!(from_a[v] <= from_a[b as usize] + from_b[v] + rounding);
        }
        for &[u, v, w] in shape.triangles.iter().filter(|[u, v, w]| u != v && v != w && w != u) {
            for [u, v] in [[u, v], [v, u], [v, w], [w, v], [w, u], [u, w]] {
                prop_assert!(from_a[u as usize] <= from_a[v as usize] + straight(&shape, u, v) + rounding);
            }
        }
    }

    #[test]
    fn exact_takes_the_nearest_source(
        shape in any_mesh(), listed in prop::collection::vec((any::<Index>(), -1.0..1.0), 1..5), shift in -3.0..3.0
    ) {
        let mesh = shape.mesh().unwrap();
        let shifted = |by: f64| -> Vec<Source> {
            listed.iter().map(|&(at, offset)| Source::vertex(vertex(&shape, at)).with_offset(offset + by)).collect()
        };
        let (all, later) = (exact_from(&mesh, &shifted(0.0)), exact_from(&mesh, &shifted(shift)));
        let mut least = vec![f64::INFINITY; all.len()];
        for source in shifted(0.0) {
            least.iter_mut().zip(exact_from(&mesh, &[source])).for_each(|(least, d)| *least = d.min(*least));
        }
        let rounding = 1e-12 * (largest(&least) + 4.0);
        for v in 0..all.len() {
            prop_assert!(all[v] == least[v] || (all[v] - least[v]).abs() <= rounding, "{} {}", all[v], least[v]);
            prop_assert!(later[v] == least[v] || (later[v] - shift - least[v]).abs() <= rounding);
        }
    }

    #[test]
    fn exact_knows_no_triangles(shape in any_mesh(), at in any::<Index>()) {
        let source = vertex(&shape, at);
        // A triangle that repeats a vertex conducts nothing, but its quarters would.
        let whole = Shape {
            triangles: shape.triangles.iter().filter(|[a, b, c]| a != b && b != c && c != a).copied().collect(),
            ..shape
        };
        let cut = exact(&subdivided(&whole), source);
        close(&cut[..whole.positions.len()], &exact(&whole, source), 1e-12)?;
    }
}

/// Bytes of rows with something else between them, from an address that is no multiple of anything.
#[derive(Debug)]
struct Packed {
    bytes: Vec<u8>,
    stride: usize,
}

fn packed<const N: usize>(rows: impl Iterator<Item = [Vec<u8>; N]>, gap: usize) -> Packed {
    let mut bytes = vec![0xAB];
    let mut stride = 0;
    for row in rows {
        let row = row.concat();
        stride = row.len() + gap;
        bytes.extend(row);
        bytes.extend(vec![0xCD; gap]);
    }
    Packed { bytes, stride }
}

impl Packed {
    fn rows<T: ElementType>(&self, count: usize, width: usize, kind: T) -> Rows<'_, T> {
        Rows::new(&self.bytes[1..], count, width, self.stride, kind).unwrap()
    }
}

fn index_bytes(v: u32, kind: IndexType) -> Vec<u8> {
    match kind {
        IndexType::U16 => (v as u16).to_ne_bytes().to_vec(),
        IndexType::U32 => v.to_ne_bytes().to_vec(),
        IndexType::U64 => u64::from(v).to_ne_bytes().to_vec(),
        IndexType::I32 => (v as i32).to_ne_bytes().to_vec(),
        IndexType::I64 => i64::from(v).to_ne_bytes().to_vec(),
    }
}

fn index_type() -> impl Strategy<Value = IndexType> {
    select(vec![IndexType::U16, IndexType::U32, IndexType::U64, IndexType::I32, IndexType::I64])
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn any_packing_gives_the_same_bits(
        shape in heights(), at in any::<Index>(), gaps in [0..17usize, 0..17usize], [of_faces, of_offsets] in
        [index_type(), index_type()], is_float in any::<bool>(), is_polygons in any::<bool>()
    ) {
        let shape = if is_float { moved(&shape, |p| p.map(|x| f64::from(x as f32))) } else { shape };
        let (kind, source) = (if is_float { ScalarType::F32 } else { ScalarType::F64 }, vertex(&shape, at));
        let scalar = |x: f64| if is_float { (x as f32).to_ne_bytes().to_vec() } else { x.to_ne_bytes().to_vec() };
        let positions = packed(shape.positions.iter().map(|p| p.map(scalar)), gaps[0]);
        let positions = positions.rows(shape.positions.len(), 3, kind);
        let faces = shape.triangles.len();
        let triangles = packed(shape.triangles.iter().map(|t| t.map(|v| index_bytes(v, of_faces))), gaps[1]);
        let corners = packed(shape.triangles.iter().flatten().map(|&v| [index_bytes(v, of_faces)]), gaps[1]);
        let offsets = packed((0..=faces as u32).map(|f| [index_bytes(3 * f, of_offsets)]), gaps[0]);
        let faces = if is_polygons {
            let corners = corners.rows(3 * faces, 1, of_faces);
            Faces::Polygons { offsets: offsets.rows(faces + 1, 1, of_offsets), corners }
        } else {
            Faces::Triangles(triangles.rows(faces, 3, of_faces))
        };
        let [read, plain] = [Mesh::from_buffers(positions, faces).unwrap(), shape.mesh().unwrap()];
        prop_assert_eq!(exact_from(&read, &[Source::vertex(source)]), exact(&shape, source));
        prop_assert_eq!(heat(&read, source), heat(&plain, source));
    }

    #[test]
    fn heat_scales(shape in heights(), at in any::<Index>(), exponent in -950..950i32, factor in 0.001..1000.0) {
        let (source, power) = (vertex(&shape, at), 2f64.powi(exponent));
        let plain = heat(&shape.mesh().unwrap(), source);
        let scaled = |factor| heat(&moved(&shape, |p| p.map(|x| x * factor)).mesh().unwrap(), source);
        let times = |factor: f64| plain.iter().map(|d| d * factor).collect::<Vec<_>>();
        prop_assert_eq!(scaled(power), times(power));
        close(&scaled(factor), &times(factor), 1e-9)?;
    }

    #[test]
    fn heat_knows_no_place(
        shape in heights(), at in any::<Index>(), angles in [0.0..TAU, 0.0..TAU], shift in [-9.0..9.0, -9.0..9.0, -9.0..9.0]
    ) {
        let source = vertex(&shape, at);
        let elsewhere = rigid(&shape, angles, shift).mesh().unwrap();
        close(&heat(&elsewhere, source), &heat(&shape.mesh().unwrap(), source), 1e-9)?;
    }

    #[test]
    fn heat_knows_no_numbers(pair in relabelled(heights()), at in any::<Index>()) {
        let source = vertex(&pair.plain, at);
        let other = heat(&pair.other.mesh().unwrap(), pair.number[source as usize]);
        close(&pair.in_plain_order(&other), &heat(&pair.plain.mesh().unwrap(), source), 1e-9)?;
    }

    #[test]
    fn heat_re_timed_is_as_fresh(shape in heights(), at in any::<Index>(), factor in 0.1..10.0) {
        let (mesh, control) = (shape.mesh().unwrap(), Control::new());
        let step = TimeStep::Formula { formula: TimeFormula::MeanEdge, scale: TimeScale::Paper, factor };
        let options = HeatOptions { time_step: step, ..HeatOptions::default() };
        let fresh = HeatSolver::new(&mesh, &options, &control).unwrap();
        let re_timed = HeatSolver::new(&mesh, &HeatOptions::default(), &control).unwrap();
        let re_timed = re_timed.with_time_step(&step, &control).unwrap();
        let source = [Source::vertex(vertex(&shape, at))];
        let [re_timed, fresh] = [re_timed, fresh].map(|solver| solver.field(&source, &control).unwrap().into_distances());
        prop_assert_eq!(re_timed, fresh);
    }
}
