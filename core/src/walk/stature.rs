//! What a gait must know of a robot: measured once, standing.

use super::heading::{Heading, wrapped, yaw};
use super::{StatureFault, WalkInput};
use crate::Real;
use crate::balance::{ObservedFoot, ObservedMotion};
use nalgebra::Vector2;

/// With which others a foot steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left foot; of a quadruped, one diagonal.
    Left,
    /// The right foot; the other diagonal.
    Right,
}

/// A foot that steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteppingFoot<T> {
    /// With which others.
    pub side: Side,
    /// Standing, from the mean point of its side's feet: forward and left, m.
    pub offset: Vector2<T>,
    /// Yaw of the sole's first axis, standing, from the central body's, rad.
    pub yaw: T,
}

/// What a description says of a robot before it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandingRobot<T> {
    /// kg
    pub mass: T,
    /// m/s²
    pub gravity: T,
    /// Hip to ankle (or point of contact) with the leg straight, m.
    pub leg_length: T,
    /// Yaw of forward from the central body's first axis, rad.
    pub forward: T,
    /// Half of a sole along its axes (length and width), m; zeros for a point.
    pub sole: Vector2<T>,
    /// How far from the sole's centre one foot can shift its pressure, m: the sole, where no moment is
    /// missing in its contact; zero across an edge.
    pub pressure_reach: Vector2<T>,
}

/// A robot's measures, standing with bent knees as it is to walk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stature<T, const FEET: usize> {
    /// What was known before.
    pub robot: StandingRobot<T>,
    /// `z`: centre of mass above the feet, m.
    pub height: T,
    /// Hip above ankle, m.
    pub hip_height: T,
    /// `W`: between the mean points of both sides, m; zero for a quadruped's diagonals.
    pub width: T,
    /// The feet; none where the robot has none.
    pub feet: [Option<SteppingFoot<T>>; FEET],
}

impl Side {
    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// `s`: 1 for the left, −1 for the right.
    pub fn sign<T: Real>(self) -> T {
        match self {
            Self::Left => T::one(),
            Self::Right => -T::one(),
        }
    }
}

impl core::fmt::Display for Side {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Left => "left",
            Self::Right => "right",
        })
    }
}

impl<T: Real, const FEET: usize> Stature<T, FEET> {
    /// Of a robot as it stands, with the sides of its feet.
    ///
    /// # Errors
    /// [`StatureFault`]: no foot on a side, or a number that cannot be.
    pub fn measured(
        robot: &StandingRobot<T>,
        sides: &[Option<Side>; FEET],
        standing: &ObservedMotion<T, FEET>,
    ) -> Result<Self, StatureFault> {
        let [left, right] = [Side::Left, Side::Right].map(|side| mean(sides, standing, side));
        let (left, right) = (
            left.ok_or(StatureFault::NoFoot(Side::Left))?,
            right.ok_or(StatureFault::NoFoot(Side::Right))?,
        );
        if robot.sole == Vector2::zeros() {
            for side in [Side::Left, Side::Right] {
                if sides.iter().filter(|of| **of == Some(side)).count() > 2 {
                    return Err(StatureFault::TooManyPoints(side));
                }
            }
        }
        let psi = yaw(&standing.central_rotation);
        let heading = Heading::new(psi + robot.forward);
        let stepping = || {
            let feet = sides.iter().zip(&standing.feet);
            feet.filter_map(|(side, foot)| side.map(|_| foot))
        };
        let count = T::of(stepping().count() as f64);
        let mean_of = |number: fn(&ObservedFoot<T>) -> T| {
            stepping().fold(T::zero(), |sum, foot| sum + number(foot)) / count
        };
        let ground = mean_of(|foot| foot.position.z);
        let mut feet = [None; FEET];
        let all = feet.iter_mut().zip(sides).zip(&standing.feet).enumerate();
        for (number, ((to, side), foot)) in all {
            let Some(side) = *side else { continue };
            let center = if side == Side::Left { left } else { right };
            let offset = heading.of_world(foot.position.xy() - center);
            let own = wrapped(yaw(&foot.rotation) - psi);
            if !(offset.x + offset.y + own + foot.leg.z).is_finite() {
                return Err(StatureFault::NotFinite(WalkInput::Foot(number)));
            }
            *to = Some(SteppingFoot { side, offset, yaw: own });
        }
        let width = heading.of_world(left - right).y;
        let stature = Self {
            robot: *robot,
            height: standing.center_of_mass.z - ground,
            hip_height: -mean_of(|foot| foot.leg.z),
            // A pair's mean points differ by what rounding leaves.
            width: if width.abs() < robot.leg_length * T::of(1e-3) {
                T::zero()
            } else {
                width.abs()
            },
            feet,
        };
        stature.check().map(|()| stature)
    }

    /// Whether every number can be.
    ///
    /// # Errors
    /// [`StatureFault`]: the first that cannot.
    pub fn check(&self) -> Result<(), StatureFault> {
        for (what, number) in [
            ("mass", self.robot.mass),
            ("gravity", self.robot.gravity),
            ("height of the centre of mass above the feet", self.height),
            ("height of the hips above the ankles", self.hip_height),
            ("length of a leg", self.robot.leg_length),
        ] {
            if !(number > T::zero() && number.is_finite()) {
                return Err(StatureFault::NotPositive(what));
            }
        }
        let halves = self.robot.sole.iter().chain(&self.robot.pressure_reach);
        let is_possible =
            halves.fold(true, |so_far, half| so_far && *half >= T::zero() && half.is_finite());
        if is_possible && self.robot.forward.is_finite() { Ok(()) } else { Err(StatureFault::Sole) }
    }

    /// Whether the contact is a point.
    pub(super) fn is_on_points(&self) -> bool {
        self.robot.sole == Vector2::zeros()
    }

    /// How many feet step on a side.
    pub(super) fn count(&self, side: Side) -> usize {
        self.feet.iter().flatten().filter(|foot| foot.side == side).count()
    }
}

/// Mean point of a side's feet in the world's plane.
fn mean<T: Real, const FEET: usize>(
    sides: &[Option<Side>; FEET],
    observed: &ObservedMotion<T, FEET>,
    side: Side,
) -> Option<Vector2<T>> {
    let feet = sides.iter().zip(&observed.feet);
    let points = feet.filter(|(of, _)| **of == Some(side)).map(|(_, foot)| foot.position.xy());
    let (sum, count) = points.fold((Vector2::zeros(), 0), |(sum, n), point| (sum + point, n + 1));
    (count > 0).then(|| sum / T::of(f64::from(count)))
}
