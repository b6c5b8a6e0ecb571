//! The properties of a model that the paper sets beside its best t.
//!
//! Lengths are at the paper's size: of the mesh scaled to a bounding box of the diagonal 24.976.

use crate::error::{Error, Result};
use crate::model::Model;
use serde::{Deserialize, Serialize};
use taut::Properties;

/// A property of the paper's list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Property {
    /// N_v, the number of vertices.
    Vertices,
    /// N_e, the number of edges.
    Edges,
    /// N_f, the number of triangles.
    Faces,
    /// v_s, the source vertex.
    Source,
    /// g, the anisotropy.
    Anisotropy,
    /// ē, the mean edge length.
    MeanEdge,
    /// Var(e), the variance of the edge lengths.
    Variance,
    /// σ, their standard deviation.
    Sigma,
    /// D_e: the paper's median absolute deviation, which is the mean absolute deviation.
    MeanDeviation,
    /// The shortest edge.
    MinEdge,
    /// The longest edge.
    MaxEdge,
    /// Shortest over longest edge.
    EdgeRatio,
    /// The smallest interior angle, in degrees.
    MinAngle,
    /// The largest interior angle, in degrees.
    MaxAngle,
    /// Q₁ of the edge lengths.
    Q1,
    /// Q₂, their median.
    Q2,
    /// Q₃.
    Q3,
    /// (Q₃ - Q₁) / 2.
    QuartileDeviation,
}

impl Property {
    /// All 18, in the paper's order.
    pub const ALL: [Property; 18] = [
        Property::Vertices,
        Property::Edges,
        Property::Faces,
        Property::Source,
        Property::Anisotropy,
        Property::MeanEdge,
        Property::Variance,
        Property::Sigma,
        Property::MeanDeviation,
        Property::MinEdge,
        Property::MaxEdge,
        Property::EdgeRatio,
        Property::MinAngle,
        Property::MaxAngle,
        Property::Q1,
        Property::Q2,
        Property::Q3,
        Property::QuartileDeviation,
    ];

    /// The paper's letters for it.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Property::Vertices => "N_v",
            Property::Edges => "N_e",
            Property::Faces => "N_f",
            Property::Source => "v_s",
            Property::Anisotropy => "g",
            Property::MeanEdge => "ē",
            Property::Variance => "Var(e)",
            Property::Sigma => "σ_e",
            Property::MeanDeviation => "D_e",
            Property::MinEdge => "min_e",
            Property::MaxEdge => "max_e",
            Property::EdgeRatio => "min_e/max_e",
            Property::MinAngle => "min_α",
            Property::MaxAngle => "max_α",
            Property::Q1 => "Q1(e)",
            Property::Q2 => "Q2(e)",
            Property::Q3 => "Q3(e)",
            Property::QuartileDeviation => "QD_e",
        }
    }

    /// To which power lengths enter it: 1 for a length.
    #[must_use]
    pub fn power(self) -> i32 {
        match self {
            Property::Variance => 2,
            Property::MeanEdge
            | Property::Sigma
            | Property::MeanDeviation
            | Property::MinEdge
            | Property::MaxEdge
            | Property::Q1
            | Property::Q2
            | Property::Q3
            | Property::QuartileDeviation => 1,
            _ => 0,
        }
    }

    /// What it is, in words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Property::Vertices => "vertices",
            Property::Edges => "edges",
            Property::Faces => "triangles",
            Property::Source => "source vertex",
            Property::Anisotropy => "anisotropy",
            Property::MeanEdge => "mean edge",
            Property::Variance => "variance of the edges",
            Property::Sigma => "standard deviation of the edges",
            Property::MeanDeviation => "mean absolute deviation of the edges",
            Property::MinEdge => "shortest edge",
            Property::MaxEdge => "longest edge",
            Property::EdgeRatio => "shortest over longest edge",
            Property::MinAngle => "smallest angle",
            Property::MaxAngle => "largest angle",
            Property::Q1 => "lower quartile of the edges",
            Property::Q2 => "median of the edges",
            Property::Q3 => "upper quartile of the edges",
            Property::QuartileDeviation => "quartile deviation of the edges",
        }
    }
}

/// The properties of one model: lengths at the paper's size, angles in degrees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelProperties {
    /// s: the factor from the mesh's units to the paper's size.
    pub scale: f64,
    /// N_v.
    pub vertices: usize,
    /// N_e.
    pub edges: usize,
    /// N_f.
    pub faces: usize,
    /// v_s.
    pub source: u32,
    /// g; `None` where no triangle has an area.
    pub anisotropy: Option<f64>,
    /// ē.
    pub mean_edge: f64,
    /// Var(e).
    pub variance: f64,
    /// σ.
    pub sigma: f64,
    /// D_e of the paper: the mean of |e - ē|.
    pub mean_absolute_deviation: f64,
    /// The median of |e - Q₂|, which is not in the paper.
    pub median_absolute_deviation: f64,
    /// The shortest edge.
    pub min_edge: f64,
    /// The longest edge.
    pub max_edge: f64,
    /// Shortest over longest.
    pub edge_ratio: f64,
    /// The smallest angle, in degrees.
    pub min_angle: f64,
    /// The largest angle, in degrees.
    pub max_angle: f64,
    /// Q₁.
    pub q1: f64,
    /// Q₂.
    pub q2: f64,
    /// Q₃.
    pub q3: f64,
    /// (Q₃ - Q₁) / 2.
    pub quartile_deviation: f64,
}

impl ModelProperties {
    /// The properties of a model.
    ///
    /// # Errors
    /// [`Error::Input`] if it has no edges, or all its vertices are in one point.
    pub fn of(model: &Model) -> Result<ModelProperties> {
        let nothing = || Error::Input(format!("{}: has no size", model.name));
        let p = Properties::of(&model.mesh).filter(|p| p.paper_scale.is_finite()).ok_or_else(nothing)?;
        let s = p.paper_scale;
        Ok(ModelProperties {
            scale: s,
            vertices: p.vertices,
            edges: p.edges,
            faces: p.faces,
            source: model.source,
            anisotropy: Some(p.anisotropy).filter(|g| g.is_finite()),
            mean_edge: s * p.mean_edge,
            variance: (s * p.sigma_edge) * (s * p.sigma_edge),
            sigma: s * p.sigma_edge,
            mean_absolute_deviation: s * p.mean_absolute_deviation,
            median_absolute_deviation: s * p.median_absolute_deviation,
            min_edge: s * p.min_edge,
            max_edge: s * p.max_edge,
            edge_ratio: p.edge_ratio,
            min_angle: p.min_angle.to_degrees(),
            max_angle: p.max_angle.to_degrees(),
            q1: s * p.q1,
            q2: s * p.q2,
            q3: s * p.q3,
            quartile_deviation: s * p.quartile_deviation,
        })
    }

    /// ē²: the t of Eq. 1.
    #[must_use]
    pub fn mean_edge_squared(&self) -> f64 {
        self.mean_edge * self.mean_edge
    }

    /// One of them as a number; NaN where it is not there.
    #[must_use]
    pub fn value(&self, property: Property) -> f64 {
        match property {
            Property::Vertices => self.vertices as f64,
            Property::Edges => self.edges as f64,
            Property::Faces => self.faces as f64,
            Property::Source => f64::from(self.source),
            Property::Anisotropy => self.anisotropy.unwrap_or(f64::NAN),
            Property::MeanEdge => self.mean_edge,
            Property::Variance => self.variance,
            Property::Sigma => self.sigma,
            Property::MeanDeviation => self.mean_absolute_deviation,
            Property::MinEdge => self.min_edge,
            Property::MaxEdge => self.max_edge,
            Property::EdgeRatio => self.edge_ratio,
            Property::MinAngle => self.min_angle,
            Property::MaxAngle => self.max_angle,
            Property::Q1 => self.q1,
            Property::Q2 => self.q2,
            Property::Q3 => self.q3,
            Property::QuartileDeviation => self.quartile_deviation,
        }
    }
}
