//! Curves through points: what a list of clicks or of a file's points means on the surface.

use super::{ExactOptions, ExactSolver};
use crate::control::{Control, Piece};
use crate::error::{Element, Error, Reason, Result};
use crate::surface::curve::{Curve, Segment};
use crate::surface::point::SurfacePoint;
use crate::surface::source::Source;
use crate::surface::target::Target;

impl ExactSolver {
    /// The open curve that goes through points in their order: straight from one to the next where a triangle holds both,
    /// else along a shortest path. Of points that follow each other at one place it has one.
    ///
    /// A straight piece costs nothing, a path a part of a field: as far as the next point. Progress counts points.
    ///
    /// # Errors
    /// [`Reason::BadArgument`] naming the point that the mesh does not have, or to which no way leads from the one before
    /// it; [`Reason::PathLost`]; and as [`ExactSolver::field`] where the control interrupts.
    pub fn curve_through(&self, points: &[SurfacePoint], control: &Control) -> Result<Curve> {
        let mesh = &self.0.mesh;
        let bad = |i: u64, message: String| Error::at(Reason::BadArgument, Element::Point(i), message);
        let check = |(i, point): (u64, &SurfacePoint)| point.checked(mesh).map_err(|message| bad(i, message));
        let points: Vec<SurfacePoint> = (0..).zip(points).map(check).collect::<Result<_>>()?;
        let mut through: Vec<SurfacePoint> = points.first().copied().into_iter().collect();
        let share = |done: u64| done as f64 / points.len() as f64;
        for (i, pair) in (1..).zip(points.windows(2)) {
            let control = Piece::whole(control).part(share(i), share(i + 1));
            control.checkpoint(0.0)?;
            let piece = match Segment::between(&pair[0], &pair[1], mesh) {
                Some(segment) if segment.ends[0] == segment.ends[1] => continue,
                Some(segment) => vec![segment.at(0.0), segment.at(1.0)],
                None => self
                    .shortest(&pair[0], &pair[1], control)?
                    .ok_or_else(|| bad(i, "no way leads there from the point before it".to_owned()))?,
            };
            through.pop();
            through.extend(piece);
        }
        control.report(1.0);
        Ok(Curve { points: through, is_closed: false })
    }

    /// The shortest path from one checked point to another.
    fn shortest(&self, from: &SurfacePoint, to: &SurfacePoint, control: Piece) -> Result<Option<Vec<SurfacePoint>>> {
        let target = Target::Point(*from);
        let options = ExactOptions { targets: vec![target], keep_windows: true, ..ExactOptions::default() };
        let path = self.field_within(&[Source::point(*to)], &options, control)?.path(target)?;
        Ok(path.map(|path| path.points))
    }
}
