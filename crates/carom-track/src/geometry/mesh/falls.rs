//! When a path comes down to a plane.

use super::super::bernstein::Descents;
use super::super::{Bernstein, Path};
use super::rim::Reach;
use super::surface::Flat;
use crate::vector::{Vec3, dot, scale};

/// When a path comes down to a plane from one side.
#[derive(Clone, Copy)]
pub(super) struct Fall {
    /// The gap along the path, or what is left of it without a root at the start.
    pub gap: Bernstein<6>,
    /// Whether it touches and approaches at once.
    pub now: bool,
    pub descents: Descents,
    /// Where the only descent is.
    pub at: Vec3,
}

/// From the side that it starts on, and from the other.
#[derive(Clone, Copy)]
pub(super) struct Falls {
    pub near: Fall,
    pub far: Option<Fall>,
    /// Out of the plane towards the start.
    pub normal: Vec3,
    /// Nothing in the plane is within reach.
    pub is_clear: bool,
    /// It starts on the side that the plane's own normal points to; within the clearance of the plane.
    is_up: bool,
    is_deep: bool,
}

impl Fall {
    const NONE: Self = Self { gap: Bernstein([0.0; 6]), now: false, descents: Descents::None, at: [0.0; 3] };

    #[inline(always)]
    fn new(gap: Bernstein<6>, now: bool, path: &Path) -> Self {
        let descents = gap.descents();
        let at = if let Descents::One(theta) = descents { path.at(theta) } else { path.start };
        Self { gap, now, descents, at }
    }

    /// The first contact before `best` at a place that counts.
    #[inline(always)]
    pub fn first(&self, best: f64, path: &Path, accept: impl Fn(Vec3) -> bool) -> Option<f64> {
        if self.now && accept(path.start) {
            return Some(0.0);
        }
        match self.descents {
            Descents::None => None,
            Descents::One(theta) => (theta < best && accept(self.at)).then_some(theta),
            Descents::Many => self.gap.first_descent(|theta| accept(path.at(theta))),
        }
    }
}

impl Falls {
    /// To no plane.
    pub const NONE: Self =
        Self { near: Fall::NONE, far: None, normal: [0.0; 3], is_clear: true, is_up: true, is_deep: false };

    #[inline(always)]
    pub fn new(flat: &Flat, path: &Path, reach: Reach) -> Self {
        let Reach { clearance, slack } = reach;
        let height = flat.height(path.start);
        let along = path.along(flat.normal);
        // a point that touches is on the side it moves to
        let side = if height.abs() > slack { height } else { dot(flat.normal, path.points[0]) };
        let sign = if side < 0.0 { -1.0 } else { 1.0 };
        let normal = scale(flat.normal, sign);
        let gap = sign * height - clearance;
        let change = along.scaled(sign, 0.0);
        let lowest = change.range_ahead().0;
        let is_clear = gap > slack && gap + lowest > slack;
        let mut falls = Self {
            near: Fall { gap: change, ..Fall::NONE },
            far: None,
            normal,
            is_clear,
            is_up: sign > 0.0,
            is_deep: gap < -slack,
        };
        if is_clear {
            return falls;
        }
        falls.near = if gap < -slack {
            Fall::new(change.scaled(1.0, gap), change.leads_down(), path)
        } else if gap <= slack {
            Fall::new(change.deflated(), change.leads_down(), path)
        } else {
            Fall::new(change.scaled(1.0, gap), false, path)
        };
        if sign * height + lowest < -clearance {
            let start = (-sign * height - clearance).min(-f64::MIN_POSITIVE);
            falls.far = Some(Fall::new(change.scaled(-1.0, start), false, path));
        }
        falls
    }
}

impl Falls {
    /// Whether edges and corners that stick out to some sides of the plane may be touched before `best`: on the other side of
    /// the plane the path comes only through it.
    #[inline(always)]
    pub fn may_reach(&self, rim: u32, best: f64) -> bool {
        let starts_on = if self.is_up { 1 << 6 } else { 2 << 6 };
        if rim & starts_on != 0 || self.near.now || self.is_deep {
            return true;
        }
        match self.near.descents {
            Descents::None => false,
            Descents::One(theta) => theta < best,
            Descents::Many => true,
        }
    }
}
