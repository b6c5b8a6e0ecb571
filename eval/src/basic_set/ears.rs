//! Cuts a polygon in space into triangles, ear by ear.
//!
//! An ear is a corner with its two neighbours. It may be cut if in the polygon's plane, across its vector area
//! N = ½ Σ pᵢ × pᵢ₊₁, it turns with the polygon and holds no other corner, and if no angle of it exceeds 179°. So the
//! triangles do not fold over each other. The one is cut whose plane is nearest to the polygon's. O(n³) for n corners.
//!
//! References: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82 (1975).

type Vector = [f64; 3];

/// The cosine of 179°. The largest angle in the paper's Table 3, after its slivers were corrected, is 178.96°.
const WIDEST: f64 = -0.999_847_695_156_391_3;

/// The triangles of a polygon, as indices of its corners; only diagonals are used that are allowed. `None` where no ear may
/// be cut.
pub(super) fn ears(corners: &[Vector], is_allowed: impl Fn(usize, usize) -> bool) -> Option<Vec<[usize; 3]>> {
    let polygon = Polygon::new(corners)?;
    let mut left: Vec<usize> = (0..corners.len()).collect();
    let mut triangles = Vec::with_capacity(corners.len().saturating_sub(2));
    while left.len() > 3 {
        let ears = (0..left.len()).map(|tip| (tip, around(&left, tip)));
        let good = ears.filter(|&(tip, ear)| is_allowed(ear[0], ear[2]) && polygon.is_good(ear, &left, tip));
        let ranked = good.map(|(tip, ear)| (polygon.flatness(ear), tip, ear));
        let (_, tip, ear) = ranked.reduce(|best, next| if next.0 > best.0 { next } else { best })?;
        triangles.push(ear);
        left.remove(tip);
    }
    triangles.push(left.try_into().ok()?);
    Some(triangles)
}

/// A corner with its neighbours.
fn around(left: &[usize], tip: usize) -> [usize; 3] {
    let n = left.len();
    [left[(tip + n - 1) % n], left[tip], left[(tip + 1) % n]]
}

/// A polygon about 1 large, its first corner at 0.
struct Polygon {
    corners: Vec<Vector>,
    /// Across its plane.
    normal: Vector,
}

impl Polygon {
    fn new(corners: &[Vector]) -> Option<Polygon> {
        let first = *corners.first()?;
        let largest = corners.iter().map(|&p| largest(minus(p, first))).fold(0.0, f64::max);
        let corners: Vec<Vector> = corners.iter().map(|&p| minus(p, first).map(|x| x / largest)).collect();
        let products = corners.windows(2).map(|side| cross(side[0], side[1])); // the first corner is 0
        let normal = products.reduce(plus)?;
        Some(Polygon { corners, normal })
    }

    /// Whether an ear may be cut off the corners that are left.
    fn is_good(&self, ear: [usize; 3], left: &[usize], tip: usize) -> bool {
        let [before, at, after] = ear;
        let holds =
            |p: usize| [[before, at, p], [at, after, p], [after, before, p]].iter().all(|&t| self.turn(t) >= 0.0);
        let is_empty = || !left.iter().any(|&p| !ear.contains(&p) && holds(p));
        let is_wide = |t: [usize; 3]| self.turn(t) > 0.0 && !self.is_sliver(t);
        // Of four corners the rest is a triangle too.
        is_wide(ear) && (left.len() > 4 || is_wide(around(left, (tip + 2) % 4))) && is_empty()
    }

    /// The area of a triangle in the polygon's plane, in some unit; negative if it turns the other way.
    fn turn(&self, triangle: [usize; 3]) -> f64 {
        dot(self.area(triangle), self.normal)
    }

    /// The cosine of the angle between a triangle's plane and the polygon's, in some unit.
    fn flatness(&self, triangle: [usize; 3]) -> f64 {
        self.turn(triangle) / length(self.area(triangle))
    }

    /// Whether an angle exceeds 179°.
    fn is_sliver(&self, triangle: [usize; 3]) -> bool {
        let is_below = |k: usize| {
            let [tip, p, q] = [0, 1, 2].map(|i| self.corners[triangle[(k + i) % 3]]);
            let [u, v] = [minus(p, tip), minus(q, tip)];
            dot(u, v) > WIDEST * length(u) * length(v)
        };
        !(0..3).all(is_below)
    }

    /// Twice the vector area of a triangle.
    fn area(&self, [a, b, c]: [usize; 3]) -> Vector {
        let [a, b, c] = [a, b, c].map(|i| self.corners[i]);
        cross(minus(b, a), minus(c, a))
    }
}

fn plus(u: Vector, v: Vector) -> Vector {
    [u[0] + v[0], u[1] + v[1], u[2] + v[2]]
}

pub(super) fn minus(u: Vector, v: Vector) -> Vector {
    [u[0] - v[0], u[1] - v[1], u[2] - v[2]]
}

fn dot(u: Vector, v: Vector) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

fn cross(u: Vector, v: Vector) -> Vector {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// The largest coordinate's magnitude.
fn largest(v: Vector) -> f64 {
    v.map(f64::abs).into_iter().fold(0.0, f64::max)
}

/// |v|, also where its square overflows.
pub(super) fn length(v: Vector) -> f64 {
    let largest = largest(v);
    if largest == 0.0 {
        return 0.0;
    }
    let unit = v.map(|x| x / largest);
    largest * dot(unit, unit).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(corners: &[[f64; 2]]) -> Vec<Vector> {
        corners.iter().map(|&[x, y]| [x, y, 5.0]).collect()
    }

    /// Twice the areas of the triangles in the plane.
    fn areas(corners: &[Vector], triangles: &[[usize; 3]]) -> Vec<f64> {
        triangles.iter().map(|t| t.map(|i| corners[i])).map(|[a, b, c]| cross(minus(b, a), minus(c, a))[2]).collect()
    }

    #[test]
    fn triangles_cover_a_polygon_once() {
        let shapes: [&[[f64; 2]]; 3] = [
            &[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]],
            &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]],
            &[[0.0, 0.0], [5.0, 0.0], [5.0, 4.0], [3.0, 1.0], [2.5, 3.0], [2.0, 1.0], [0.0, 4.0]],
        ];
        for (corners, expected) in shapes.map(flat).iter().zip([10.0, 8.0, 24.0]) {
            let triangles = ears(corners, |_, _| true).unwrap();
            let areas = areas(corners, &triangles);
            assert_eq!(areas.len(), corners.len() - 2);
            assert!(areas.iter().all(|&area| area > 0.0), "{areas:?}");
            assert_eq!(areas.iter().sum::<f64>(), expected);
        }
    }

    #[test]
    fn what_folds_is_not_cut() {
        let dart = flat(&[[0.0, 0.0], [3.0, 1.0], [0.0, 2.0], [1.0, 1.0]]);
        assert_eq!(ears(&dart, |i, j| i.min(j) == 0), None);
        assert_eq!(areas(&dart, &ears(&dart, |_, _| true).unwrap()), [2.0, 2.0]);
    }

    #[test]
    fn slivers_are_not_cut() {
        for (height, is_cut) in [(0.0, false), (0.008, false), (0.01, true)] {
            let kite = flat(&[[0.0, 0.0], [1.0, -height], [2.0, 0.0], [1.0, 2.0]]);
            assert_eq!(ears(&kite, |i, j| i.min(j) == 0).is_some(), is_cut, "{height}");
            assert!(ears(&kite, |i, j| i.min(j) == 1).is_some());
        }
    }

    #[test]
    fn the_flattest_ear_goes_first() {
        let roof =
            [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 1.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [0.0, 1.0, 1.0]];
        let triangles = ears(&roof, |_, _| true).unwrap();
        // The ridge, from 5 to 2, is an edge.
        assert!(
            triangles
                .iter()
                .all(|t| t.iter().all(|i| [0, 1, 2, 5].contains(i)) || t.iter().all(|i| (2..=5).contains(i)))
        );
    }
}
