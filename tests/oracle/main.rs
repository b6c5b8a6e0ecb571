//! The exact engine against a brute-force search of our own, on thousands of small soups.

mod curves;
mod soups;
mod unfolding;

use soups::{KINDS, Random, Soup, needles, soup};
use taut::{Control, ExactOptions, ExactSolver, Mesh, Reason, Source, Target};

/// The engine's distances from each vertex.
fn engine((points, triangles): &Soup) -> Vec<Vec<f64>> {
    let solver = ExactSolver::new(&Mesh::from_triangles(points, triangles).unwrap()).unwrap();
    let from = |v| solver.field(&[Source::vertex(v)], &ExactOptions::default(), &Control::new()).unwrap();
    (0..points.len() as u32).map(|v| from(v).distances().to_vec()).collect()
}

/// The largest difference of the two, as a share of the largest distance, and between which vertices; infinite where
/// only one of them finds a way.
fn disagreement(soup: &Soup) -> (f64, [usize; 2]) {
    let [ours, right] = [engine(soup), unfolding::distances(&soup.0, &soup.1)];
    let largest = right.iter().flatten().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
    let mut worst = (0.0, [0; 2]);
    for (a, row) in right.iter().enumerate() {
        for (b, &d) in row.iter().enumerate().filter(|&(b, &d)| d != ours[a][b]) {
            let off = (d - ours[a][b]).abs() / largest;
            if off > worst.0 || off.is_nan() {
                worst = (off, [a, b]);
            }
        }
    }
    worst
}

#[track_caller]
fn assert_agreement(what: &str, case: u32, soup: &Soup, tolerance: f64) {
    let (off, [a, b]) = disagreement(soup);
    assert!(off <= tolerance, "{what}, case {case}: {off:e} off between {a} and {b}\n{soup:?}");
}

/// How many soups of each kind to look at; TAUT_ORACLE_FACTOR asks for many times more.
fn cases(usual: u32) -> u32 {
    std::env::var("TAUT_ORACLE_FACTOR").map_or(usual, |factor| usual * factor.parse::<u32>().unwrap())
}

#[test]
fn the_search_knows_the_cube_and_a_triangle_without_area() {
    let corners: Vec<[f64; 3]> = (0..8).map(|v| [v & 1, v >> 1 & 1, v >> 2].map(f64::from)).collect();
    let squares = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let cube: Vec<[u32; 3]> = squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let expected = [0.0, 1.0, 1.0, 2.0, 1.0, 2.0, 2.0, 5.0].map(f64::sqrt);
    for (found, expected) in unfolding::distances(&corners, &cube)[0].iter().zip(expected) {
        assert!((found - expected).abs() < 1e-15, "{found} should be {expected}");
    }
    // Vertex 2 lies on the edge from 0 to 1, joined to it by a triangle without area, and sees 3 beyond.
    let points = [[0.0; 3], [4.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [2.0, -1.0, 0.0]];
    assert_eq!(unfolding::distances(&points, &[[0, 1, 2], [1, 0, 3]])[2], [1.0, 3.0, 0.0, 2f64.sqrt(), f64::INFINITY]);
}

#[test]
fn soups_agree() {
    let mut random = Random(1);
    for case in 0..cases(5_000) {
        for kind in KINDS {
            assert_agreement(&format!("{kind:?}"), case, &soup(kind, &mut random), 1e-12);
        }
    }
}

/// Needles: some vertices lie next to another.
#[test]
fn needles_agree() {
    let mut random = Random(2);
    for case in 0..cases(500) {
        for kind in KINDS {
            for width in [1e-2, 1e-3] {
                let soup = needles(kind, width, &mut random);
                assert_agreement(&format!("{kind:?}, {width:e}"), case, &soup, 1e-11);
            }
        }
    }
}

/// Needles down to 1e-12. The shape of such a triangle has few digits, but a straight line through it passes its vertices
/// as closely, so that the distances keep all of theirs.
#[test]
fn thin_needles_agree() {
    let mut random = Random(5);
    for case in 0..cases(300) {
        for kind in KINDS {
            for width in [1e-7, 1e-9, 1e-12] {
                let soup = needles(kind, width, &mut random);
                ends(&soup, &format!("{kind:?}, {width:e}, case {case}"));
                assert_agreement(&format!("{kind:?}, {width:e}"), case, &soup, 1e-9);
            }
        }
    }
}

/// Fails where the engine has no answer within ten seconds; a call that hangs cannot be cancelled, so it is left behind.
fn ends(soup: &Soup, what: &str) {
    let (done, is_done) = std::sync::mpsc::channel();
    let of_thread = soup.clone();
    std::thread::spawn(move || {
        engine(&of_thread);
        done.send(())
    });
    let answer = is_done.recv_timeout(std::time::Duration::from_secs(10));
    assert!(answer.is_ok(), "{what}: no answer\n{soup:?}");
}

/// Two copies of a needle and a third triangle on one of its edges.
#[test]
fn a_folded_needle_of_three_triangles_ends() {
    let points = vec![
        [0.0, 1.0, 0.0],
        [0.0, 1.0, 2.0],
        [-2.906496794100075e-9, 1.0000000005842424, -3.401496483786648e-9],
        [3.514876694358063e-10, 0.9999999911901645, 1.9999999893479659],
    ];
    ends(&(points, vec![[1, 3, 0], [1, 0, 3], [2, 3, 0]]), "three triangles");
}

/// Rays that wind around a needle are beaten by those that do not; 2π / width windows crossed these two triangles.
#[test]
fn rays_do_not_wind_around_a_needle() {
    for width in [1e-3, 1e-4, 1e-5, 2e-6] {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, width, 0.0]];
        let solver = ExactSolver::new(&Mesh::from_triangles(&points, &[[0, 1, 2], [2, 1, 0]]).unwrap()).unwrap();
        let field = solver.field(&[Source::vertex(1)], &ExactOptions::default(), &Control::new()).unwrap();
        assert!(field.windows() < 100, "width {width:e}: {} windows", field.windows());
    }
}

/// Looks at the path of each vertex to each: as long as the distance, or lost. Tells how many are lost.
fn lost_paths((points, triangles): &Soup) -> usize {
    let mesh = Mesh::from_triangles(points, triangles).unwrap();
    let solver = ExactSolver::new(&mesh).unwrap();
    let mut lost = 0;
    for source in 0..points.len() as u32 {
        let field = solver.field(&[Source::vertex(source)], &ExactOptions::default(), &Control::new()).unwrap();
        for (v, &distance) in (0..).zip(field.distances()).filter(|&(v, d)| d.is_finite() && v != source) {
            let path = match field.path(Target::Vertex(v)) {
                Ok(path) => path.unwrap(),
                Err(error) => {
                    assert_eq!(error.reason(), Reason::PathLost);
                    lost += 1;
                    continue;
                }
            };
            let positions = path.positions(&mesh).unwrap();
            let squared = |pair: &[[f64; 3]]| (0..3).map(|k| (pair[0][k] - pair[1][k]).powi(2)).sum::<f64>();
            let length: f64 = positions.windows(2).map(|pair| squared(pair).sqrt()).sum();
            assert!(
                (length - distance).abs() <= 1e-9 * (distance + 1e-3),
                "{source} to {v}: {length}, not {distance}\n{points:?}"
            );
        }
    }
    lost
}

#[test]
fn paths_are_as_long_as_their_distances() {
    for kind in KINDS {
        let mut random = Random(11);
        let soups = cases(500);
        let lost: usize = (0..soups).map(|_| lost_paths(&soup(kind, &mut random))).sum();
        // Among vertices at one place and triangles without area.
        assert!(lost as u32 <= soups / 10, "{kind:?}: {lost} paths are lost in {soups} soups");
    }
}
