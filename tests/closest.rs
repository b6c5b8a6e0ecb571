//! The surface point nearest to a point in space: against exact arithmetic, brute force, known answers, hostile meshes.

mod common;

use std::cmp::Ordering;
use taut::{Closest, ClosestPoint, Control, Element, Mesh, Reason, shapes};

fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Mesh {
    Mesh::from_triangles(positions, triangles).unwrap()
}

/// Numbers that look random and are the same each time (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % end
    }

    /// In [0, 1).
    fn share(&mut self) -> f64 {
        self.below(1 << 53) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, low: [f64; 3], high: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| low[k] + self.share() * (high[k] - low[k]))
    }

    /// Triangles of any vertices; some repeat one and are ignored.
    fn soup(&mut self, vertices: u64, triangles: usize) -> Vec<[u32; 3]> {
        (0..triangles).map(|_| std::array::from_fn(|_| self.below(vertices) as u32)).collect()
    }
}

fn minus<T: Copy + std::ops::Sub<Output = T>>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot<T: Copy + std::ops::Mul<Output = T> + std::ops::Add<Output = T>>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<T: Copy + std::ops::Mul<Output = T> + std::ops::Sub<Output = T>>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// What every answer must be, wherever it lies.
#[track_caller]
fn assert_consistent(mesh: &Mesh, query: [f64; 3], found: &ClosestPoint) {
    let weights = found.point.barycentric;
    assert!(weights.iter().all(|&w| w >= 0.0), "{found:?}");
    assert!((weights.iter().sum::<f64>() - 1.0).abs() <= 4.0 * f64::EPSILON, "{found:?}");
    assert!(!mesh.ignored_triangles().contains(&found.point.face), "{found:?}");
    let distance = norm(minus(found.point.position(mesh).unwrap(), query));
    assert!((found.distance - distance).abs() <= 4.0 * f64::EPSILON * distance, "{found:?} {distance}");
}

/// The squared distance from a lattice point to a lattice triangle as an exact fraction, and where it is taken: the
/// corners that have a weight.
fn exact(corners: [[i64; 3]; 3], q: [i64; 3]) -> ((i64, i64), Vec<usize>) {
    let [a, b, c] = corners;
    let n = cross(minus(b, a), minus(c, a));
    let area = |k: usize| dot(n, cross(minus(corners[(k + 1) % 3], q), minus(corners[(k + 2) % 3], q)));
    if n != [0; 3] && (0..3).all(|k| area(k) > 0) {
        let height = dot(n, minus(q, a));
        return ((height * height, dot(n, n)), vec![0, 1, 2]);
    }
    let vertices = (0..3).map(|k| ((dot(minus(q, corners[k]), minus(q, corners[k])), 1), vec![k]));
    let sides = (0..3).filter_map(|k| {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let (side, r) = (minus(to, from), minus(q, from));
        let off = cross(r, side);
        let is_between = 0 < dot(r, side) && dot(r, side) < dot(side, side);
        is_between.then(|| {
            let mut ends = vec![k, (k + 1) % 3];
            ends.sort();
            ((dot(off, off), dot(side, side)), ends)
        })
    });
    vertices.chain(sides).min_by(|a, b| compare(a.0, b.0)).unwrap()
}

fn compare(a: (i64, i64), b: (i64, i64)) -> Ordering {
    (a.0 * b.1).cmp(&(b.0 * a.1))
}

#[test]
fn lattice_soups_agree_with_exact_arithmetic() {
    let mut random = Random(1);
    let lattice = |random: &mut Random, size| -> [i64; 3] { std::array::from_fn(|_| random.below(size) as i64) };
    let [mut insides, mut shared] = [0, 0];
    for _ in 0..4_000 {
        let positions: Vec<[i64; 3]> = (0..9).map(|_| lattice(&mut random, 4)).collect();
        let triangles = random.soup(9, 12);
        let mesh = mesh(&positions.iter().map(|p| p.map(|x| x as f64)).collect::<Vec<_>>(), &triangles);
        let Ok(closest) = Closest::new(&mesh) else { continue };
        for _ in 0..10 {
            let q = lattice(&mut random, 7).map(|x| x - 1);
            let found = closest.point(q.map(|x| x as f64)).unwrap();
            assert_consistent(&mesh, q.map(|x| x as f64), &found);

            let corners = |f: u32| triangles[f as usize].map(|v| positions[v as usize]);
            let kept = (0..12).filter(|f| !mesh.ignored_triangles().contains(f));
            let answers: Vec<_> = kept.map(|f| (f, exact(corners(f), q))).collect();
            let least = answers.iter().map(|&(_, (squared, _))| squared).min_by(|&a, &b| compare(a, b)).unwrap();
            let distance = (least.0 as f64 / least.1 as f64).sqrt();
            assert!((found.distance - distance).abs() <= 1e-14, "{positions:?} {triangles:?} {q:?} {found:?}");

            let face = found.point.face;
            let (own, with_weight) = exact(corners(face), q);
            assert_eq!(compare(own, least), Ordering::Equal, "{positions:?} {triangles:?} {q:?} {found:?}");
            let [a, b, c] = corners(face);
            if cross(minus(b, a), minus(c, a)) == [0; 3] {
                continue; // several of its sides may have the place
            }
            let used: Vec<usize> = (0..3).filter(|&k| found.point.barycentric[k] != 0.0).collect();
            assert_eq!(used, with_weight, "the zeros are exact: {positions:?} {triangles:?} {q:?} {found:?}");
            let place = |f: u32, with_weight: &[usize]| {
                let mut ends: Vec<_> = with_weight.iter().map(|&k| corners(f)[k]).collect();
                ends.sort();
                ends
            };
            let own = place(face, &with_weight);
            let mut sharing = answers.iter().filter(|(f, (_, with))| place(*f, with) == own).map(|&(f, _)| f);
            match used.len() {
                3 => insides += 1,
                _ => assert_eq!(sharing.next(), Some(face), "the first: {positions:?} {triangles:?} {q:?} {found:?}"),
            }
            shared += usize::from(sharing.next().is_some());
        }
    }
    assert!(insides > 1_000 && shared > 10_000, "{insides} inside, {shared} shared");
}

/// The distance to a triangle by another way: normal equations of the plane and of each line, clamped.
fn brute_force(corners: [[f64; 3]; 3], q: [f64; 3]) -> f64 {
    let [a, b, c] = corners;
    let [u, v, r] = [minus(b, a), minus(c, a), minus(q, a)];
    let [uu, uv, vv, ru, rv] = [dot(u, u), dot(u, v), dot(v, v), dot(r, u), dot(r, v)];
    let determinant = uu * vv - uv * uv;
    let [s, t] = [(ru * vv - rv * uv) / determinant, (rv * uu - ru * uv) / determinant];
    if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        return norm(std::array::from_fn(|k| r[k] - s * u[k] - t * v[k]));
    }
    let side = |from: [f64; 3], to: [f64; 3]| {
        let [along, r] = [minus(to, from), minus(q, from)];
        let t = (dot(r, along) / dot(along, along)).clamp(0.0, 1.0);
        norm(std::array::from_fn(|k| r[k] - t * along[k]))
    };
    side(a, b).min(side(b, c)).min(side(c, a))
}

#[track_caller]
fn assert_as_brute_force(mesh: &Mesh, queries: impl Iterator<Item = [f64; 3]>, tolerance: f64) {
    let closest = Closest::new(mesh).unwrap();
    let kept: Vec<_> = (0..).zip(mesh.triangles()).filter(|(f, _)| !mesh.ignored_triangles().contains(f)).collect();
    for q in queries {
        let found = closest.point(q).unwrap();
        assert_consistent(mesh, q, &found);
        let corners = |t: &[u32; 3]| t.map(|v| mesh.positions()[v as usize]);
        let least = kept.iter().map(|(_, t)| brute_force(corners(t), q)).fold(f64::INFINITY, f64::min);
        assert!((found.distance - least).abs() <= tolerance, "{q:?} {found:?} {least}");
    }
}

#[test]
fn random_soups_agree_with_brute_force() {
    let mut random = Random(2);
    for _ in 0..300 {
        let positions: Vec<[f64; 3]> = (0..30).map(|_| random.within([0.0; 3], [1.0; 3])).collect();
        let triangles = random.soup(30, 40);
        let queries: Vec<_> = (0..50).map(|_| random.within([-0.5; 3], [1.5; 3])).collect();
        assert_as_brute_force(&mesh(&positions, &triangles), queries.into_iter(), 1e-13);
    }
}

#[test]
fn real_meshes_agree_with_brute_force() {
    let Some(corpus) = common::corpus() else { return };
    let names = [
        "boeing_soup.off",
        "klingon_starship.off",
        "office_chair_bad.obj",
        "triceratops_slivers.off",
        "mpi_near_degenerate.off",
        "anchor_dense.off",
        "bunny10k_unref.ply",
        "moebius.obj",
    ];
    for name in names {
        let mesh = Mesh::read(corpus.join(name)).unwrap();
        let used = || mesh.triangles().iter().flatten().map(|&v| mesh.positions()[v as usize]);
        let low = used().reduce(|a, b| std::array::from_fn(|k| a[k].min(b[k]))).unwrap();
        let high = used().reduce(|a, b| std::array::from_fn(|k| a[k].max(b[k]))).unwrap();
        let size = norm(minus(high, low));
        let mut random = Random(3);
        let anywhere: Vec<_> = (0..200).map(|_| random.within(low, high)).collect();
        // Thin triangles cost the normal equations digits, not ours.
        assert_as_brute_force(&mesh, anywhere.into_iter(), 1e-11 * size);
        // A vertex is its own nearest place, at distance 0.
        let closest = Closest::new(&mesh).unwrap();
        for f in (0..mesh.triangle_count()).step_by(97).filter(|&f| !mesh.ignored_triangles().contains(&(f as u32))) {
            let vertex = mesh.positions()[mesh.triangles()[f][0] as usize];
            let found = closest.point(vertex).unwrap();
            assert_eq!((found.point.position(&mesh).unwrap(), found.distance), (vertex, 0.0), "{name} {f}");
            let centre = std::array::from_fn(|k| {
                mesh.triangles()[f].map(|v| mesh.positions()[v as usize][k] / 3.0).iter().sum()
            });
            assert!(closest.point(centre).unwrap().distance <= 1e-15 * size, "{name} {f}");
        }
    }
}

/// A rotation, and places moved by it.
fn turned(p: [f64; 3]) -> [f64; 3] {
    let rows = [[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]];
    rows.map(|row: [f64; 3]| dot(row, p) / 3.0)
}

#[test]
fn above_a_shared_edge_or_vertex_of_a_tilted_plane_the_first_triangle_is_told() {
    let shape = shapes::grid(5, 4);
    let positions: Vec<_> = shape.positions.iter().map(|&p| turned(p)).collect();
    let mesh = mesh(&positions, &shape.triangles);
    let closest = Closest::new(&mesh).unwrap();
    let first_with = |corners: &[u32]| {
        let position = mesh.triangles().iter().position(|t| corners.iter().all(|v| t.contains(v)));
        position.unwrap() as u32
    };
    for height in [1e-9, 0.3, -1.0, 50.0] {
        let above = |p: [f64; 3]| turned([p[0], p[1], p[2] + height]);
        for t in &shape.triangles {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                let [from, to] = [a, b].map(|v| shape.positions[v as usize]);
                for share in [0.0, 1e-3, 0.3, 0.5] {
                    let p = std::array::from_fn(|k| (1.0 - share) * from[k] + share * to[k]);
                    let found = closest.point(above(p)).unwrap();
                    let corners = if share == 0.0 { vec![a] } else { vec![a, b] };
                    assert_eq!(found.point.face, first_with(&corners), "{corners:?} {share} {found:?}");
                    let zeros = found.point.barycentric.iter().filter(|&&w| w == 0.0).count();
                    assert_eq!(zeros, 3 - corners.len(), "{found:?}");
                    assert!((found.distance - height.abs()).abs() <= 1e-14 * height.abs().max(1.0), "{found:?}");
                }
            }
        }
    }
}

#[test]
fn beside_an_edge_the_place_is_in_the_right_triangle() {
    // The squared distance of the edge, 1 + 1e-18, rounds to 1 too.
    let closest = Closest::new(&mesh(
        &[[0.0, 0.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [2.0, 0.0, 0.0]],
        &[[0, 1, 2], [1, 3, 2]],
    ));
    let found = closest.unwrap().point([1.0 + 1e-9, 0.0, 1.0]).unwrap();
    assert_eq!((found.point.face, found.point.barycentric[1]), (1, (1.0_f64 + 1e-9) - 1.0));
}

#[test]
fn needles_keep_their_digits() {
    let mut random = Random(4);
    for _ in 0..40_000 {
        // Before it is turned it lies in the plane z = 0, where its lines tell what is inside.
        let height = f64::powi(10.0, -(random.below(18) as i32));
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [random.share(), height, 0.0]];
        let above = if random.below(5) == 0 { 0.0 } else { f64::powi(10.0, 1 - random.below(18) as i32) };
        let q = [2.0 * random.share() - 0.5, height * (3.0 * random.share() - 1.0), above];
        let side = |k: usize| {
            let [from, to] = [corners[k], corners[(k + 1) % 3]];
            let [along, r] = [minus(to, from), minus(q, from)];
            let t = (dot(r, along) / dot(along, along)).clamp(0.0, 1.0);
            (cross(along, r)[2] > 0.0, norm(std::array::from_fn(|k| r[k] - t * along[k])))
        };
        let sides = [0, 1, 2].map(side);
        let is_inside = sides.iter().all(|side| side.0);
        let expected = if is_inside { above } else { sides.iter().map(|side| side.1).fold(f64::INFINITY, f64::min) };

        let first = random.below(3) as usize;
        let order: [usize; 3] = std::array::from_fn(|k| (first + k) % 3);
        let mesh = mesh(&order.map(|k| turned(corners[k])), &[[0, 1, 2]]);
        let found = Closest::new(&mesh).unwrap().point(turned(q)).unwrap();
        assert_consistent(&mesh, turned(q), &found);
        assert!((found.distance - expected).abs() <= 4e-15 * above.max(1.0), "{corners:?} {q:?} {found:?} {expected}");
    }
}

#[test]
fn powers_of_two_and_the_order_of_triangles_change_nothing() {
    let shape = shapes::knot(60, 9, 0.3);
    let flat = mesh(&shape.positions, &shape.triangles);
    let reversed: Vec<_> = shape.triangles.iter().rev().copied().collect();
    let closest = Closest::new(&flat).unwrap();
    let of_reversed = mesh(&shape.positions, &reversed);
    let from_reversed = Closest::new(&of_reversed).unwrap();
    let mut random = Random(5);
    let queries: Vec<_> = (0..500).map(|_| random.within([-4.0; 3], [4.0; 3])).collect();
    for exponent in [-1000, -333, 3, 1000] {
        let scaled = |p: &[f64; 3]| p.map(|x| x * f64::powi(2.0, exponent));
        let larger = mesh(&shape.positions.iter().map(scaled).collect::<Vec<_>>(), &shape.triangles);
        let larger = Closest::new(&larger).unwrap();
        for q in &queries {
            let (one, other) = (closest.point(*q).unwrap(), larger.point(scaled(q)).unwrap());
            assert_eq!(one.point, other.point);
            assert_eq!(one.distance * f64::powi(2.0, exponent), other.distance);
        }
    }
    for q in queries {
        let (one, other) = (closest.point(q).unwrap(), from_reversed.point(q).unwrap());
        assert_eq!(one.point.position(&flat).unwrap(), other.point.position(&of_reversed).unwrap());
    }
}

#[test]
fn coordinates_at_the_ends_of_the_range() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for size in [1e308, 1e-300, 1e-320] {
        let scaled = triangle.map(|p| p.map(|x: f64| x * size));
        let closest = Closest::new(&mesh(&scaled, &[[0, 1, 2]])).unwrap();
        let found = closest.point([0.0, 0.0, size]).unwrap();
        assert_eq!((found.point.barycentric, found.distance), ([1.0, 0.0, 0.0], size));
        assert_eq!(closest.point([1e308, -1e308, 0.0]).unwrap().point.barycentric, [0.0, 1.0, 0.0]);
    }
    // From one end of the range to the other; a distance that is no number is infinite.
    let wide = mesh(&[[-1.7e308; 3], [1.7e308, -1.7e308, -1.7e308], [-1.7e308, 1.7e308, -1.7e308]], &[[0, 1, 2]]);
    let found = Closest::new(&wide).unwrap().point([1.7e308; 3]).unwrap();
    assert_eq!((found.point.barycentric, found.distance), ([0.0, 0.5, 0.5], f64::INFINITY));
    // All at one end, where nothing but one coordinate tells the vertices apart; and a point at the other end.
    let far = mesh(&[[1e308, 0.0, 0.0], [1e308, 1e-300, 0.0], [1e308, 0.0, 1e-300]], &[[0, 1, 2]]);
    let far = Closest::new(&far).unwrap();
    let found = far.point([1e308, 3e-300, 0.0]).unwrap();
    assert_eq!((found.point.barycentric, found.distance), ([0.0, 1.0, 0.0], 3e-300 - 1e-300));
    assert_eq!(far.point([0.0; 3]).unwrap().distance, 1e308);
    assert_eq!(far.point([-1e308, 0.0, 0.0]).unwrap().distance, f64::INFINITY);
}

#[test]
fn nothing_to_be_near_to_and_points_that_are_not_finite() {
    for (positions, triangles) in [(&[][..], &[][..]), (&[[0.0; 3]; 3], &[]), (&[[0.0; 3]; 3], &[[0, 1, 1]])] {
        let error = Closest::new(&mesh(positions, triangles)).unwrap_err();
        assert_eq!((error.reason(), error.element()), (Reason::BadArgument, None));
        assert!(error.message().contains("no triangles"), "{error}");
    }
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f64::NAN; 3], [f64::INFINITY; 3]];
    let closest = Closest::new(&mesh(&corners, &[[3, 4, 3], [0, 1, 2]])).unwrap();
    assert_eq!(closest.points(&[], &Control::new()).unwrap(), []);
    assert_eq!(closest.clone().point([-1.0, 0.0, 0.0]).unwrap().point.face, 1);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = closest.point([0.0, bad, 0.0]).unwrap_err();
        assert_eq!((error.reason(), error.element()), (Reason::BadArgument, None));
        let error = closest.points(&[[0.0; 3], [1.0; 3], [0.0, 0.0, bad], [bad; 3]], &Control::new()).unwrap_err();
        assert_eq!((error.reason(), error.element()), (Reason::BadArgument, Some(Element::Point(2))));
        assert_eq!(error.to_string(), "point 2: has a coordinate that is not finite");
    }
}

#[test]
fn triangles_without_area() {
    let at_one_place = Closest::new(&mesh(&[[2.0; 3]; 3], &[[0, 1, 2]])).unwrap();
    let found = at_one_place.point([2.0, 2.0, 5.0]).unwrap();
    assert!(found.point.barycentric.contains(&1.0) && found.distance == 3.0, "{found:?}");
    for order in [[0, 1, 2], [1, 2, 0], [2, 1, 0]] {
        let line = mesh(&[[0.0; 3], [3.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[order]);
        let found = Closest::new(&line).unwrap().point([2.0, 0.0, 1.0]).unwrap();
        assert_eq!((found.point.position(&line).unwrap(), found.distance), ([2.0, 0.0, 0.0], 1.0));
    }
}

#[test]
fn a_hundred_thousand_triangles_in_one_place_need_no_deep_stack() {
    let ask = || {
        let count = 100_000_u32;
        let positions: Vec<_> = (0..3 * count).map(|v| [f64::from(v % 3), f64::from(v % 2), 0.0]).collect();
        let triangles: Vec<_> = (0..count).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
        Closest::new(&mesh(&positions[..3].repeat(count as usize), &triangles))
            .unwrap()
            .point([-1.0, 0.0, 0.0])
            .unwrap()
    };
    let found = std::thread::Builder::new().stack_size(256 * 1024).spawn(ask).unwrap().join().unwrap();
    assert_eq!((found.point.face, found.point.barycentric, found.distance), (0, [1.0, 0.0, 0.0], 1.0));
}

#[test]
fn from_the_centre_of_a_sphere_the_nearest_triangle_is_told() {
    let sphere = shapes::icosphere(3).mesh().unwrap();
    let found = Closest::new(&sphere).unwrap().point([0.0; 3]).unwrap();
    assert_consistent(&sphere, [0.0; 3], &found);
    let corners = |t: &[u32; 3]| t.map(|v| sphere.positions()[v as usize]);
    let least = sphere.triangles().iter().map(|t| brute_force(corners(t), [0.0; 3])).fold(f64::INFINITY, f64::min);
    assert!((found.distance - least).abs() <= 1e-15);
}

#[test]
fn threads_share_it() {
    fn shared<T: Clone + Send + Sync>() {}
    shared::<Closest>();
}
