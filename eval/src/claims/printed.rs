//! The paper's figures that its claims rest on.

/// A mesh of the basic set, in Tables 1, 2, 6 and 8.
pub(super) struct Printed {
    pub(super) vertices: f64,
    pub(super) anisotropy: f64,
    pub(super) sigma: f64,
    pub(super) mean_error: f64,
    pub(super) mean_t: f64,
    pub(super) median_t: f64,
}

const fn row(vertices: f64, anisotropy: f64, sigma: f64, mean: [f64; 2], median_t: f64) -> Printed {
    Printed { vertices, anisotropy, sigma, mean_error: mean[0], mean_t: mean[1], median_t }
}

/// 1.obj to 5.obj.
pub(super) const BASIC: [Printed; 5] = [
    row(14290.0, 1.079, 0.02505, [0.53031, 0.0254], 0.0246),
    row(13848.0, 1.137, 0.03904, [0.60318, 0.0361], 0.0365),
    row(13398.0, 1.208, 0.05155, [0.7676, 0.0486], 0.0553),
    row(12863.0, 1.296, 0.06813, [0.85488, 0.0749], 0.0815),
    row(12478.0, 1.349, 0.07287, [0.92221, 0.064], 0.0613),
];

/// The coefficient of σ with the best t, and the least |r| in the same table: Tables 7 and 9.
pub(super) const SIGMA_R: [[f64; 2]; 2] = [[0.9593, 0.6933], [0.9113, 0.7017]];

/// The slope of Eq. 4, and its constant.
pub(super) const EQUATION_4: [f64; 2] = [1.01204, -0.0001];

/// How many models it has, and where the best t is in them: between Eq. 1 and Eq. 2, below both, above both.
pub(super) const MODELS: usize = 35;
pub(super) const PLACES: [usize; 3] = [16, 10, 9];
