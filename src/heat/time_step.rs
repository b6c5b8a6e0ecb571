//! The time step t of the heat flow: the paper's formulas, each over the edges of the input mesh.
//!
//! ```text
//! Eq. 1   mean edge     t = ē²
//! Eq. 2   sigma         t = σ
//! Eq. 3   mean sigma    t = (ē² + σ) / 2
//! Eq. 4   median fit    t = 1.01204 σ - 0.0001
//! Eq. 5   median mean   t = (ē² + 1.01204 σ - 0.0001) / 2
//! ```
//!
//! ē is the mean and σ the population standard deviation of the edge lengths, each edge once. t has the unit of an area,
//! but Eq. 2 to 5 set it to lengths: they depend on the unit, and hold where the paper found them, on meshes whose
//! bounding box has the diagonal 24.976. [`TimeScale::Paper`] therefore evaluates a formula on s·e with
//! s = 24.976 / diagonal, and brings the result back: t / s².
//!
//! O(E) time.
//!
//! References: K. Crane, C. Weischedel, M. Wardetzky: Geodesics in Heat: A New Approach to Computing Distance Based on
//! Heat Flow. ACM Transactions on Graphics, 2013 (Eq. 1). Wave propagation time optimization for geodesic distances
//! calculation using the Heat Method. Open Physics, 2019 (the numbers of the equations, Eq. 2 to 5).

use crate::error::{Error, Reason, Result};
use crate::mesh::Mesh;
use crate::metric::{Scale, stats::EdgeStats};

/// A formula must give at least this share of ē²: Eq. 2 gives 0 where all edges are equal, Eq. 4 less than 0.
const LEAST_SHARE: f64 = 1e-6;

/// The formulas for the time step t, from edge lengths e: mean ē, population standard deviation σ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TimeFormula {
    /// Eq. 1: t = ē², the original choice of Crane, Weischedel and Wardetzky.
    MeanEdge,
    /// Eq. 2: t = σ.
    Sigma,
    /// Eq. 3: t = (ē² + σ) / 2.
    MeanSigma,
    /// Eq. 4: t = 1.01204 σ - 0.0001.
    MedianFit,
    /// Eq. 5: t = (ē² + 1.01204 σ - 0.0001) / 2.
    MedianMean,
}

impl TimeFormula {
    /// t in squares of the unit of `mean` and `sigma`.
    fn evaluate(self, mean: f64, sigma: f64) -> f64 {
        let fit = 1.01204 * sigma - 0.0001; // Eq. 4
        match self {
            TimeFormula::MeanEdge => mean * mean,                  // Eq. 1
            TimeFormula::Sigma => sigma,                           // Eq. 2
            TimeFormula::MeanSigma => (mean * mean + sigma) / 2.0, // Eq. 3
            TimeFormula::MedianFit => fit,
            TimeFormula::MedianMean => (mean * mean + fit) / 2.0, // Eq. 5
        }
    }

    /// Its name and equation, for messages.
    fn name(self) -> &'static str {
        match self {
            TimeFormula::MeanEdge => "mean-edge (Eq. 1: t = ē²)",
            TimeFormula::Sigma => "sigma (Eq. 2: t = σ)",
            TimeFormula::MeanSigma => "mean-sigma (Eq. 3: t = (ē² + σ) / 2)",
            TimeFormula::MedianFit => "median-fit (Eq. 4: t = 1.01204 σ - 0.0001)",
            TimeFormula::MedianMean => "median-mean (Eq. 5: t = (ē² + 1.01204 σ - 0.0001) / 2)",
        }
    }
}

/// In which units a formula is evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TimeScale {
    /// At the paper's size, a bounding-box diagonal of 24.976: the result does not depend on the mesh's units.
    Paper,
    /// On the mesh's numbers as they stand.
    Raw,
}

/// The time step t of the heat flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TimeStep {
    /// A formula evaluated on the mesh, times `factor`.
    Formula {
        /// Which formula.
        formula: TimeFormula,
        /// In which units.
        scale: TimeScale,
        /// Multiplies the formula's value, positive and finite; 1 is the formula itself.
        factor: f64,
    },
    /// An explicit t in the mesh's own units squared, positive and finite.
    Value(f64),
}

impl TimeStep {
    /// The value of t on `mesh`, in mesh units squared.
    ///
    /// # Errors
    /// [`Reason::BadTimeStep`] if t is not positive and finite, if `factor` is not, or if the formula gives less than
    /// 1e-6 ē² (the message names it): near 0, where the edges are almost equal, σ says nothing about t.
    pub fn value(&self, mesh: &Mesh) -> Result<f64> {
        let scale = Scale::of(mesh);
        let t = self.unit_value(mesh, scale)?;
        positive(scale.to_mesh(scale.to_mesh(t)), "time step: t in mesh units squared")
    }

    /// The value of t in squares of the unit of `scale`, where no mesh is too large or too small for it.
    pub(super) fn unit_value(&self, mesh: &Mesh, scale: Scale) -> Result<f64> {
        match *self {
            TimeStep::Value(t) => {
                positive(t, "time step: t")?;
                let message = format!("time step: t = {t}, at the size of this mesh,");
                positive(scale.to_unit(scale.to_unit(t)), &message)
            }
            TimeStep::Formula { formula, scale: time_scale, factor } => {
                positive(factor, "time step: the factor")?;
                let t = formula_value(mesh, formula, time_scale, scale)?;
                positive(t * factor, &format!("time step: {}, times the factor {factor},", formula.name()))
            }
        }
    }
}

/// The formula's value in squares of the unit of `units`.
fn formula_value(mesh: &Mesh, formula: TimeFormula, time_scale: TimeScale, units: Scale) -> Result<f64> {
    let Some(edges) = EdgeStats::of(mesh, units).filter(|edges| edges.mean > 0.0) else {
        let message = format!("time step: {} needs edges of some length, and the mesh has none", formula.name());
        return Err(Error::new(Reason::BadTimeStep, message));
    };
    let t = match time_scale {
        TimeScale::Paper => {
            let s = edges.paper_scale();
            formula.evaluate(s * edges.mean, s * edges.sigma) / (s * s)
        }
        TimeScale::Raw => {
            let t = formula.evaluate(units.to_mesh(edges.mean), units.to_mesh(edges.sigma));
            units.to_unit(units.to_unit(t))
        }
    };
    let share = t / (edges.mean * edges.mean);
    // NaN, where numbers as they stand overflow, is not enough either.
    if share.is_nan() || share < LEAST_SHARE {
        let message =
            format!("time step: {} gives {share:.3e} ē², below {LEAST_SHARE:e} ē², on this mesh", formula.name());
        return Err(Error::new(Reason::BadTimeStep, message));
    }
    Ok(t)
}

/// `value` if it is positive and finite.
fn positive(value: f64, what: &str) -> Result<f64> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(Error::new(Reason::BadTimeStep, format!("{what} is {value}, which is not positive and finite")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [TimeFormula; 5] = [
        TimeFormula::MeanEdge,
        TimeFormula::Sigma,
        TimeFormula::MeanSigma,
        TimeFormula::MedianFit,
        TimeFormula::MedianMean,
    ];

    /// A 3-4-5 triangle times `size`: ē = 4, σ = √(2/3), diagonal 5.
    fn triangle(size: f64) -> Mesh {
        let positions = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 4.0, 0.0]].map(|p| p.map(|x| x * size));
        Mesh::from_triangles(&positions, &[[0, 1, 2]]).unwrap()
    }

    fn value(mesh: &Mesh, formula: TimeFormula, scale: TimeScale) -> f64 {
        TimeStep::Formula { formula, scale, factor: 1.0 }.value(mesh).unwrap()
    }

    fn assert_close(value: f64, expected: f64) {
        assert!((value - expected).abs() <= 1e-14 * expected, "{value} is not {expected}");
    }

    #[test]
    fn closed_forms() {
        let sigma = (2.0f64 / 3.0).sqrt();
        let raw =
            [16.0, sigma, (16.0 + sigma) / 2.0, 1.01204 * sigma - 0.0001, (16.0 + 1.01204 * sigma - 0.0001) / 2.0];
        let s = 24.976 / 5.0;
        let fit = 1.01204 * sigma / s - 0.0001 / (s * s);
        let paper = [16.0, sigma / s, (16.0 + sigma / s) / 2.0, fit, (16.0 + fit) / 2.0];
        for i in 0..5 {
            assert_close(value(&triangle(1.0), ALL[i], TimeScale::Raw), raw[i]);
            assert_close(value(&triangle(1.0), ALL[i], TimeScale::Paper), paper[i]);
        }
    }

    #[test]
    fn paper_scale_does_not_depend_on_units() {
        for formula in ALL {
            let t = value(&triangle(1.0), formula, TimeScale::Paper);
            for size in [1e-3, 1e3, 1e-150, 1e150] {
                assert_close(value(&triangle(size), formula, TimeScale::Paper), t * size * size);
            }
        }
    }

    #[test]
    fn a_factor_multiplies() {
        let step = TimeStep::Formula { formula: TimeFormula::MeanEdge, scale: TimeScale::Raw, factor: 0.5 };
        assert_close(step.value(&triangle(1.0)).unwrap(), 8.0);
    }

    #[test]
    fn useless_values_are_refused_by_name() {
        let height = 0.75f64.sqrt();
        let equal = Mesh::from_triangles(&[[0.0; 3], [1.0, 0.0, 0.0], [0.5, height, 0.0]], &[[0, 1, 2]]).unwrap();
        let point = Mesh::from_triangles(&[[1.0; 3]; 3], &[[0, 1, 2]]).unwrap();
        let empty = Mesh::from_triangles(&[[1.0; 3]; 3], &[]).unwrap();
        let refused = |mesh: &Mesh, formula: TimeFormula, scale: TimeScale| {
            let error = TimeStep::Formula { formula, scale, factor: 1.0 }.value(mesh).unwrap_err();
            assert_eq!(error.reason(), Reason::BadTimeStep);
            assert!(error.message().contains(formula.name()), "{error}");
        };
        for scale in [TimeScale::Paper, TimeScale::Raw] {
            refused(&equal, TimeFormula::Sigma, scale);
            refused(&equal, TimeFormula::MedianFit, scale);
            for mesh in [&point, &empty] {
                ALL.iter().for_each(|&formula| refused(mesh, formula, scale));
            }
        }
    }

    #[test]
    fn t_may_be_beyond_numbers_in_mesh_units_but_not_in_units() {
        let step = TimeStep::Formula { formula: TimeFormula::MeanEdge, scale: TimeScale::Paper, factor: 1.0 };
        for size in [1e-300, 1e300] {
            let mesh = triangle(size);
            assert_eq!(step.value(&mesh).unwrap_err().reason(), Reason::BadTimeStep);
            let t = step.unit_value(&mesh, Scale::of(&mesh)).unwrap();
            assert!((0.1..1.0).contains(&t), "{t}");
        }
    }

    #[test]
    fn bad_numbers_are_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let formula = TimeStep::Formula { formula: TimeFormula::MeanEdge, scale: TimeScale::Paper, factor: bad };
            for step in [TimeStep::Value(bad), formula] {
                assert_eq!(step.value(&triangle(1.0)).unwrap_err().reason(), Reason::BadTimeStep);
            }
        }
    }
}
