//! Curves as sources on small soups, against the engine's own distances from points of them: the nearest point is sought
//! by samples and refined by golden section. Distances from points agree with the brute-force search, so this is what is
//! new about curves.

use super::cases;
use super::soups::{KINDS, Random, Soup, needles, soup};
use taut::{Control, Curve, ExactField, ExactOptions, ExactSolver, Mesh, Reason, Source, SurfacePoint, Target};

fn field(solver: &ExactSolver, source: Source) -> ExactField {
    let options = ExactOptions { keep_windows: true, ..ExactOptions::default() };
    solver.field(&[source], &options, &Control::new()).unwrap()
}

/// A point of a triangle: a corner, on an edge, or inside.
fn point(face: u32, random: &mut Random) -> SurfacePoint {
    let [a, b] = [1 + random.below(7), 1 + random.below(7)].map(f64::from);
    let mut barycentric = match random.below(4) {
        0 => [1.0, 0.0, 0.0],
        1 => [a / 8.0, 1.0 - a / 8.0, 0.0],
        _ => [a / 16.0, b / 16.0, 1.0 - (a + b) / 16.0],
    };
    barycentric.rotate_left(random.below(3) as usize);
    SurfacePoint { face, barycentric }
}

/// A curve that goes from triangle to triangle over their common corners and edges; None where all repeat an index.
fn curve(triangles: &[[u32; 3]], random: &mut Random) -> Option<Curve> {
    let has_area = |&&[a, b, c]: &&[u32; 3]| a != b && b != c && c != a;
    triangles.iter().find(has_area)?;
    let mut face = loop {
        let face = random.below(triangles.len() as u32);
        if has_area(&&triangles[face as usize]) {
            break face;
        }
    };
    let mut points = vec![point(face, random)];
    for _ in 0..1 + random.below(4) {
        let next = point(face, random);
        let on: Vec<u32> = (0..3).filter(|&k| next.barycentric[k] > 0.0).map(|k| triangles[face as usize][k]).collect();
        points.push(next);
        // Some triangle that has the point too names it and holds what follows.
        let beside = random.below(triangles.len() as u32);
        let corners = triangles[beside as usize];
        if on.len() < 3 && has_area(&&corners) && on.iter().all(|v| corners.contains(v)) {
            let old = triangles[face as usize];
            let weight = |v: u32| (0..3).filter(|&k| old[k] == v).map(|k| next.barycentric[k]).sum();
            face = beside;
            *points.last_mut()? = SurfacePoint { face, barycentric: corners.map(weight) };
        }
    }
    Some(Curve { points, is_closed: false })
}

/// Straight pieces of a curve, each by its triangle and the weights of its ends.
type Pieces = Vec<(u32, [[f64; 3]; 2])>;

fn pieces(triangles: &[[u32; 3]], curve: &Curve) -> Pieces {
    let piece = |pair: &[SurfacePoint]| {
        let [corners, others] = [0, 1].map(|i| triangles[pair[i].face as usize]);
        let weight = |v: u32| (0..3).filter(|&k| others[k] == v).map(|k| pair[1].barycentric[k]).sum();
        (pair[0].face, [pair[0].barycentric, corners.map(weight)])
    };
    curve.points.windows(2).map(piece).collect()
}

/// The least of a function of [low, high] that has one minimum there.
fn golden(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_895;
    let [mut a, mut b] = [high - SHARE * (high - low), low + SHARE * (high - low)];
    let [mut at_a, mut at_b] = [a, b].map(&f);
    while high - low > 1e-10 {
        if at_a <= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - SHARE * (high - low);
            at_a = f(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + SHARE * (high - low);
            at_b = f(b);
        }
    }
    at_a.min(at_b)
}

/// The least distance of each vertex from points of the pieces.
fn sought(solver: &ExactSolver, pieces: &Pieces, vertices: usize) -> Vec<f64> {
    const SAMPLES: usize = 32;
    let mut least = vec![f64::INFINITY; vertices];
    for &(face, [from, to]) in pieces {
        let distances = |share: f64| {
            let barycentric = [0, 1, 2].map(|k| (1.0 - share) * from[k] + share * to[k]);
            field(solver, Source::point(SurfacePoint { face, barycentric })).distances().to_vec()
        };
        let share = |i: usize| i as f64 / SAMPLES as f64;
        let samples: Vec<Vec<f64>> = (0..=SAMPLES).map(|i| distances(share(i))).collect();
        for (v, least) in least.iter_mut().enumerate() {
            for i in 0..=SAMPLES {
                let [before, here, after] = [i.saturating_sub(1), i, (i + 1).min(SAMPLES)].map(|i| samples[i][v]);
                *least = least.min(here);
                if here < f64::INFINITY && here <= before && here <= after {
                    let [low, high] = [i.saturating_sub(1), (i + 1).min(SAMPLES)].map(share);
                    *least = least.min(golden(low, high, |share| distances(share)[v]));
                }
            }
        }
    }
    least
}

fn check(what: &str, soup: &Soup, curve: &Curve, tolerance: f64) {
    let (points, triangles) = soup;
    let solver = ExactSolver::new(&Mesh::from_triangles(points, triangles).unwrap()).unwrap();
    let ours = field(&solver, Source::curve(curve.clone()));
    let right = sought(&solver, &pieces(triangles, curve), points.len());
    let largest = right.iter().copied().filter(|d| d.is_finite()).fold(1.0, f64::max);
    for (v, (&d, &right)) in ours.distances().iter().zip(&right).enumerate() {
        // What was found is the distance from some point of the curve; the nearest one is found up to `tolerance`.
        let is_right = d == right || d - right <= 1e-12 * largest && right - d <= tolerance * largest;
        assert!(is_right, "{what}: vertex {v}: {d}, but {right} was found\n{soup:?}\n{curve:?}");
    }
}

#[test]
fn curves_on_soups_agree() {
    for kind in KINDS {
        let mut random = Random(21);
        for case in 0..cases(40) {
            let soup = soup(kind, &mut random);
            if let Some(curve) = curve(&soup.1, &mut random) {
                check(&format!("{kind:?}, case {case}"), &soup, &curve, 1e-9);
            }
        }
    }
}

#[test]
fn curves_on_needles_agree() {
    for kind in KINDS {
        let mut random = Random(22);
        for case in 0..cases(10) {
            for width in [1e-3, 1e-6, 1e-9, 1e-12] {
                let soup = needles(kind, width, &mut random);
                if let Some(curve) = curve(&soup.1, &mut random) {
                    check(&format!("{kind:?}, {width:e}, case {case}"), &soup, &curve, 1e-9);
                }
            }
        }
    }
}

/// Each path is as long as the distance and ends on the curve, or is lost; tells how many are lost.
fn lost_paths(soup: &Soup, curve: &Curve) -> usize {
    let mesh = Mesh::from_triangles(&soup.0, &soup.1).unwrap();
    let field = field(&ExactSolver::new(&mesh).unwrap(), Source::curve(curve.clone()));
    let mut lost = 0;
    for (v, &distance) in (0..).zip(field.distances()).filter(|(_, d)| d.is_finite()) {
        let path = match field.path(Target::Vertex(v)) {
            Ok(path) => path.unwrap(),
            Err(error) => {
                assert_eq!(error.reason(), Reason::PathLost);
                lost += 1;
                continue;
            }
        };
        let length = |points: &[[f64; 3]]| points.windows(2).map(|pair| euclid(pair[0], pair[1])).sum::<f64>();
        let positions = path.positions(&mesh).unwrap();
        let long = length(&positions);
        assert!(
            (long - distance).abs() <= 1e-9 * (distance + 1e-3),
            "{v}: {long}, not {distance}\n{soup:?}\n{curve:?}"
        );
        let end = positions[positions.len() - 1];
        let curve_points = curve.positions(&mesh).unwrap();
        // On a segment the ways to its ends add up to its length.
        let beside = |pair: &[[f64; 3]]| euclid(pair[0], end) + euclid(end, pair[1]) - euclid(pair[0], pair[1]);
        let off = curve_points.windows(2).map(beside).fold(f64::INFINITY, f64::min);
        assert!(off <= 1e-9, "the path of {v} ends {off:e} beside the curve\n{soup:?}\n{curve:?}");
    }
    lost
}

fn euclid(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn paths_on_soups_end_on_the_curve() {
    for kind in KINDS {
        let mut random = Random(23);
        let mut lost = 0;
        for _ in 0..cases(500) {
            let soup = soup(kind, &mut random);
            lost += curve(&soup.1, &mut random).map_or(0, |curve| lost_paths(&soup, &curve));
        }
        // Among vertices at one place and triangles without area.
        assert!(lost as u32 <= cases(500) / 10, "{kind:?}: {lost} paths are lost");
    }
}
