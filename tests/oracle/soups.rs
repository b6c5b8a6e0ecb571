//! Random soups of four to a dozen triangles. All coordinates are of the order of one.

pub(crate) type Soup = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A small deterministic generator.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// A number in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A whole number below `end`.
    pub(crate) fn below(&mut self, end: u32) -> u32 {
        (self.unit() * f64::from(end)) as u32
    }

    fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i as u32 + 1) as usize);
        }
    }
}

/// What makes up a soup: where its points lie, how its triangles hang together, what is then done to it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kind {
    /// Any three of 4 to 9 lattice points: edges with many triangles, triangles without area or with a repeated index,
    /// edges without length.
    Lattice,
    /// The same on the plane: everything overlaps, most points are collinear with others.
    FlatLattice,
    /// The same with points anywhere.
    Anywhere,
    /// Triangles in a row, each on the last edge of the one before, over points anywhere.
    Strip,
    /// The same over lattice points.
    LatticeStrip,
    /// An open 2 by 3 grid of squares with random heights.
    Heights,
    /// Three to five pages on one edge, each of two or three triangles.
    Fan,
    /// Lattice soups whose triangles are cut in four at the midpoints of their edges.
    Halved,
    /// Lattice soups whose triangles are cut in three at a point inside, which then moves out of the plane or stays.
    Pierced,
    /// Two soups without a common vertex.
    Parts,
}

pub(crate) const KINDS: [Kind; 10] = [
    Kind::Lattice,
    Kind::FlatLattice,
    Kind::Anywhere,
    Kind::Strip,
    Kind::LatticeStrip,
    Kind::Heights,
    Kind::Fan,
    Kind::Halved,
    Kind::Pierced,
    Kind::Parts,
];

pub(crate) fn soup(kind: Kind, random: &mut Random) -> Soup {
    let (points, mut triangles) = match kind {
        Kind::Lattice => of_any_three(random, on_lattice, 4..13),
        Kind::FlatLattice => of_any_three(random, on_flat_lattice, 4..13),
        Kind::Anywhere => of_any_three(random, anywhere, 4..13),
        Kind::Strip => strip(random, anywhere),
        Kind::LatticeStrip => strip(random, on_lattice),
        Kind::Heights => heights(random),
        Kind::Fan => fan(random),
        Kind::Halved => halved(of_any_three(random, on_lattice, 2..4)),
        Kind::Pierced => pierced(of_any_three(random, on_lattice, 2..5), random),
        Kind::Parts => parts(random),
    };
    random.shuffle(&mut triangles);
    triangles.iter_mut().for_each(|corners| random.shuffle(corners));
    (points, triangles)
}

/// A soup with a few vertices moved to within `width` of another.
pub(crate) fn needles(kind: Kind, width: f64, random: &mut Random) -> Soup {
    let (mut points, triangles) = soup(kind, random);
    for _ in 0..=random.below(3) {
        let [moved, beside] = [0; 2].map(|_| random.below(points.len() as u32) as usize);
        points[moved] = points[beside].map(|x| x + width * (2.0 * random.unit() - 1.0));
    }
    (points, triangles)
}

fn on_lattice(random: &mut Random) -> [f64; 3] {
    [0; 3].map(|_| f64::from(random.below(3)))
}

fn on_flat_lattice(random: &mut Random) -> [f64; 3] {
    [f64::from(random.below(4)), f64::from(random.below(4)), 0.0]
}

fn anywhere(random: &mut Random) -> [f64; 3] {
    [0; 3].map(|_| random.unit())
}

fn of_any_three(random: &mut Random, point: fn(&mut Random) -> [f64; 3], faces: std::ops::Range<u32>) -> Soup {
    let vertices = 4 + random.below(6);
    let faces = faces.start + random.below(faces.end - faces.start);
    let points = (0..vertices).map(|_| point(random)).collect();
    (points, (0..faces).map(|_| [0; 3].map(|_| random.below(vertices))).collect())
}

fn strip(random: &mut Random, point: fn(&mut Random) -> [f64; 3]) -> Soup {
    let faces = 4 + random.below(9);
    let points = (0..faces + 2).map(|_| point(random)).collect();
    let mut last = [0, 1];
    let next = |c: u32| {
        let triangle = [last[0], last[1], c];
        last = [last[random.below(2) as usize], c];
        triangle
    };
    (points, (2..faces + 2).map(next).collect())
}

fn heights(random: &mut Random) -> Soup {
    let points = (0..12).map(|v| [f64::from(v % 4), f64::from(v / 4), random.unit()]).collect();
    let squares = (0..6).map(|square| square / 3 * 4 + square % 3);
    (points, squares.flat_map(|a| [[a, a + 1, a + 5], [a, a + 5, a + 4]]).collect())
}

fn fan(random: &mut Random) -> Soup {
    let mut points = vec![on_lattice(random), on_lattice(random)];
    let mut triangles = Vec::new();
    for _ in 0..3 + random.below(3) {
        let mut last = [0, 1];
        for _ in 0..2 + random.below(2) {
            let c = points.len() as u32;
            points.push(on_lattice(random));
            triangles.push([last[0], last[1], c]);
            last = [last[random.below(2) as usize], c];
        }
    }
    (points, triangles)
}

fn parts(random: &mut Random) -> Soup {
    let (mut points, mut triangles) = of_any_three(random, on_lattice, 2..6);
    let (more_points, more) = of_any_three(random, anywhere, 2..6);
    let first = points.len() as u32;
    points.extend(more_points);
    triangles.extend(more.iter().map(|triangle| triangle.map(|v| first + v)));
    (points, triangles)
}

/// Midpoints of lattice points are exact.
fn halved((points, triangles): Soup) -> Soup {
    let shape = taut::shapes::subdivided(&taut::shapes::Shape { positions: points, triangles });
    (shape.positions, shape.triangles)
}

/// Weights of eighths keep the coordinates of lattice points exact.
fn pierced((mut points, triangles): Soup, random: &mut Random) -> Soup {
    let mut pieces = Vec::new();
    for corners in triangles {
        let weight = [1 + random.below(3), 1 + random.below(3)].map(f64::from);
        let weights = [weight[0], weight[1], 8.0 - weight[0] - weight[1]].map(|w| w / 8.0);
        let mut inside = [0.0; 3];
        for (w, v) in weights.into_iter().zip(corners) {
            (0..3).for_each(|axis| inside[axis] += w * points[v as usize][axis]);
        }
        inside[random.below(3) as usize] += f64::from(random.below(2)) / 4.0;
        let c = points.len() as u32;
        points.push(inside);
        let [p, q, r] = corners;
        pieces.extend([[p, q, c], [q, r, c], [r, p, c]]);
    }
    (points, pieces)
}
