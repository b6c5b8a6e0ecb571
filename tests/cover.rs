//! The intrinsic triangulation of the heat method where edges have one triangle, three or more, or no consistent sides.

mod common;

use common::corpus;
use taut::{Control, HeatOptions, HeatReport, HeatSolver, Mesh, Source, TimeStep};

type Buffers = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Distances from some vertices with t = 0.05, and what was done to the triangulation.
fn heat((positions, triangles): &Buffers, sources: &[u32]) -> (Vec<f64>, HeatReport) {
    let mesh = Mesh::from_triangles(positions, triangles).unwrap();
    let options = HeatOptions { time_step: TimeStep::Value(0.05), ..HeatOptions::default() };
    let solver = HeatSolver::new(&mesh, &options, &Control::new()).unwrap();
    let sources: Vec<Source> = sources.iter().copied().map(Source::vertex).collect();
    (solver.field(&sources, &Control::new()).unwrap().into_distances(), solver.report())
}

#[track_caller]
fn assert_close(a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len());
    let largest = a.iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
    for (v, (a, b)) in a.iter().zip(b).enumerate() {
        assert!((a - b).abs() <= 1e-9 * largest || a == b, "vertex {v}: {a} and {b}");
    }
}

/// A number in [-½, ½) for each pair, always the same.
fn jitter(a: u32, b: u32) -> f64 {
    let hash = (u64::from(a) << 32 | u64::from(b)).wrapping_add(0x9e3779b97f4a7c15).wrapping_mul(0xbf58476d1ce4e5b9);
    let hash = (hash ^ hash >> 29).wrapping_mul(0x94d049bb133111eb);
    (hash >> 11) as f64 / (1u64 << 53) as f64 - 0.5
}

const COLUMNS: u32 = 7;
const ROWS: u32 = 6;

/// Vertex `x` of row `y` of a strip with low rows, so that the angles opposite its long sides are obtuse.
fn place(x: u32, y: u32) -> [f64; 2] {
    let shift = 0.5 * f64::from(y % 2) + 0.2 * jitter(x, y);
    let up = if y == 0 { 0.0 } else { 0.1 * jitter(y, x) };
    [f64::from(x) + shift, 0.3 * (f64::from(y) + up)]
}

/// The triangles between the rows `y` and `y + 1`, and between `x` and `x + 1`.
fn cell(at: impl Fn(u32, u32) -> u32, x: u32, y: u32) -> [[u32; 3]; 2] {
    let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
    if y.is_multiple_of(2) { [[a, b, c], [b, d, c]] } else { [[a, b, d], [a, d, c]] }
}

fn cells(columns: u32) -> impl Iterator<Item = (u32, u32)> {
    (0..ROWS).flat_map(move |y| (0..columns).map(move |x| (x, y)))
}

/// `pages` copies of the strip, joined in their row 0, which is the x-axis; vertices page by page.
fn book(pages: u32) -> Buffers {
    let (per_row, mut positions, mut triangles) = (COLUMNS + 1, Vec::new(), Vec::new());
    positions.extend((0..per_row).map(|x| [place(x, 0)[0], 0.0, 0.0]));
    for page in 0..pages {
        let (sin, cos) = (0.3 + f64::from(page) * 1.1).sin_cos();
        for (y, x) in (1..=ROWS).flat_map(|y| (0..per_row).map(move |x| (y, x))) {
            let [along, out] = place(x, y);
            positions.push([along, out * cos, out * sin]);
        }
        let at = |x, y| if y == 0 { x } else { per_row * (1 + page * ROWS + y - 1) + x };
        triangles.extend(cells(COLUMNS).flat_map(|(x, y)| cell(at, x, y)));
    }
    (positions, triangles)
}

/// Heat from the spine flows into all pages alike, so each is as if it were alone: with a boundary, beside a mirror image or
/// beside several.
#[test]
fn pages_of_a_book() {
    for source in [0, 3] {
        let (alone, report) = heat(&book(1), &[source]);
        assert!(report.doubled_triangles > 0 && report.stuck_edges == 0, "{report:?}");
        let page = (ROWS * (COLUMNS + 1)) as usize;
        let spine = alone.len() - page;
        for pages in [2, 3, 5] {
            let (d, report) = heat(&book(pages), &[source]);
            assert_eq!(report.stuck_edges, 0);
            for i in 0..pages as usize {
                let this = [&d[..spine], &d[spine + i * page..][..page]].concat();
                assert_close(&alone, &this);
            }
        }
    }
}

/// A sheet is as its double: a closed surface of the sheet and a second copy of it, joined in its boundary.
#[test]
fn a_sheet_and_its_double() {
    let (mut positions, mut triangles) = book(1);
    let per_row = COLUMNS + 1;
    let is_inner = |v: u32| (1..COLUMNS).contains(&(v % per_row)) && (1..ROWS).contains(&(v / per_row));
    // A corner's triangle with no inner vertex would be there twice.
    triangles.retain(|corners| corners.iter().any(|&v| is_inner(v)));
    let sheet = (positions.clone(), triangles.clone());
    let other: Vec<u32> = (0..positions.len() as u32)
        .map(|v| {
            if is_inner(v) {
                positions.push(positions[v as usize]);
            }
            if is_inner(v) { positions.len() as u32 - 1 } else { v }
        })
        .collect();
    triangles.extend_from_within(..);
    let half = triangles.len() / 2;
    triangles[half..].iter_mut().for_each(|corners| *corners = [2, 1, 0].map(|k| other[corners[k] as usize]));
    let (alone, report) = heat(&sheet, &[5]);
    assert!(report.doubled_triangles > 0);
    let (closed, report) = heat(&(positions, triangles), &[5]);
    assert_eq!(report.doubled_triangles, 0);
    assert_close(&alone, &closed[..alone.len()]);
    let on_other: Vec<f64> = other.iter().map(|&v| closed[v as usize]).collect();
    assert_close(&alone, &on_other);
}

/// A strip of `columns` that closes after `around`, upside down if that is odd many half turns: `turns` times around a
/// Möbius strip of 11 columns.
fn moebius(turns: u32) -> Buffers {
    let columns = 11;
    // Where the strip has been around once, it is what it was, upside down.
    let position = |x: u32, y: u32| {
        let upside_down = (x / columns) % 2 == 1;
        let (x, y) = (x % columns, if upside_down { ROWS - y } else { y });
        let [along, out] =
            [f64::from(x) + 0.5 * f64::from(y % 2) + 0.2 * jitter(x, y), f64::from(y) + 0.1 * jitter(y, x)];
        let (angle, out) = (along / f64::from(columns) * std::f64::consts::TAU, 0.15 * (out - f64::from(ROWS) / 2.0));
        let radius = 1.0 + out * (angle / 2.0).cos();
        [radius * angle.cos(), radius * angle.sin(), out * (angle / 2.0).sin()]
    };
    let at = |x: u32, y: u32| match x {
        x if x < turns * columns => x * (ROWS + 1) + y,
        _ => {
            if turns % 2 == 1 {
                ROWS - y
            } else {
                y
            }
        }
    };
    let rows = 0..=ROWS;
    let positions = (0..turns * columns).flat_map(|x| rows.clone().map(move |y| position(x, y))).collect();
    (positions, cells(turns * columns).flat_map(|(x, y)| cell(at, x, y)).collect())
}

/// The seam of a Möbius strip is no place of its surface: all is as on the ring that covers it twice.
#[test]
fn a_moebius_strip_and_its_double_cover() {
    let (once, report) = heat(&moebius(1), &[40]);
    assert!(report.doubled_triangles > 0 && report.stuck_edges == 0, "{report:?}");
    let vertices = once.len() as u32;
    let opposite = |v: u32| v - v % (ROWS + 1) + ROWS - v % (ROWS + 1);
    let (twice, report) = heat(&moebius(2), &[40, vertices + opposite(40)]);
    assert!(report.doubled_triangles > 0 && report.stuck_edges == 0, "{report:?}");
    assert_close(&once, &twice[..once.len()]);
    let other: Vec<f64> = (0..vertices).map(|v| twice[(vertices + opposite(v)) as usize]).collect();
    assert_close(&once, &other);
}

/// Neither the order of vertices, of triangles and of their corners, nor which way they face makes a difference.
#[test]
fn order_and_orientation() {
    let mut with_copies = book(3);
    with_copies.1.extend_from_within(3..30);
    with_copies.1.extend_from_within(10..14);
    for buffers in [book(3), with_copies, moebius(1)] {
        let (expected, report) = heat(&buffers, &[20]);
        assert!(report.doubled_triangles > 0);
        for round in 0..5 {
            let shuffled = |n: usize| {
                let mut order: Vec<u32> = (0..n as u32).collect();
                order.sort_by(|&i, &j| jitter(i, round).total_cmp(&jitter(j, round)));
                order
            };
            let (vertices, triangles) = (shuffled(buffers.0.len()), shuffled(buffers.1.len()));
            let mut renumbered = vec![0; vertices.len()];
            (0..).zip(&vertices).for_each(|(new, &old)| renumbered[old as usize] = new);
            let changed = triangles.iter().map(|&f| {
                let mut corners = buffers.1[f as usize].map(|v| renumbered[v as usize]);
                corners.rotate_left((3.0 * (jitter(round, f) + 0.5)) as usize);
                if jitter(f, round + 100) > 0.0 {
                    corners.swap(0, 1);
                }
                corners
            });
            let positions = vertices.iter().map(|&v| buffers.0[v as usize]).collect();
            let (found, _) = heat(&(positions, changed.collect()), &[renumbered[20]]);
            assert_close(&expected, &renumbered.iter().map(|&v| found[v as usize]).collect::<Vec<f64>>());
        }
    }
}

/// No edge of any real mesh is left that is not Delaunay, and closed surfaces are not doubled.
#[test]
fn every_edge_of_the_corpus_is_delaunay() {
    let Some(folder) = corpus() else { return };
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let Ok(mesh) = Mesh::read(&path) else { continue };
        if mesh.triangle_count() > 120_000 {
            continue; // closed, like many of the others
        }
        let report = HeatSolver::new(&mesh, &HeatOptions::default(), &Control::new()).unwrap().report();
        assert_eq!((report.stuck_edges, report.flip_bound_reached), (0, false), "{}", path.display());
        let described = taut::MeshReport::new(&mesh);
        let is_closed = |part: &taut::Component| part.boundary_loops == 0 && part.is_orientable;
        if described.components.iter().all(is_closed) && described.nonmanifold_edges.is_empty() {
            assert_eq!(report.doubled_triangles, 0, "{}", path.display());
        }
    }
}
