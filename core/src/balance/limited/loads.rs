//! What the wanted acceleration asks of the legs: those that stand and those that hang.

use super::WrenchLimits;
use crate::Real;
use crate::balance::ground_wrench::ground_biases;
use crate::balance::robot::LEG;
use crate::balance::tick::big_base_wrench;
use crate::balance::workspace_dynamics::{
    fixed_foot_wrench_of_legs, hanging_leg, inertial_wrench, leg_wrench,
};
use crate::balance::{
    CentralBody, Controller, Fault, LegJacobian, LegKinematics, WorkspaceForm, sole_axes,
};
use crate::spatial::{Twist, Wrench};
use nalgebra::Matrix3;

/// All of it, in frame 1.
pub(super) struct Loads<T, const LEGS: usize> {
    /// On the central body.
    pub desired: Wrench<T>,
    /// What the ground gives each standing foot beside the wrench of its joints, sole axes.
    pub carried: [Wrench<T>; LEGS],
    /// Frame 1 from the sole axes of each foot.
    pub axes: [Matrix3<T>; LEGS],
    /// Torques of the legs that hang, N·m; zero for those that stand.
    pub hanging: [[T; LEG]; LEGS],
}

/// For the acceleration `x` of the central body: what the plain tick asks for while all feet stand.
#[inline(always)]
pub(super) fn loads<T: Real, const LEGS: usize>(
    controller: &Controller<'_, T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    x: Twist<T>,
) -> Result<Loads<T, LEGS>, Fault> {
    let (robot, singularity) = (controller.robot, controller.singularity);
    let mut at_ankles = [Wrench::zero(); LEGS];
    let held = |leg: usize, w| {
        if let Some(entry) = at_ankles.get_mut(leg) {
            *entry = w;
        }
    };
    let fixed =
        fixed_foot_wrench_of_legs::<T, LEGS, true>(robot, central, legs, singularity, x, held)?;
    let desired = match controller.form {
        WorkspaceForm::FixedFoot => fixed,
        WorkspaceForm::BigBase { factor } => big_base_wrench(controller, central, legs, factor, x)?,
    };
    let axes = sole_axes(robot, legs);
    let carried = ground_biases(robot, central, legs, &axes, at_ankles);
    Ok(Loads { desired, carried, axes, hanging: [[T::zero(); LEG]; LEGS] })
}

/// The same where limits bind, or a foot is in the air: then feet creep, and what moves comes to rest.
#[inline(always)]
pub(super) fn loads_at_rest<T: Real, const LEGS: usize>(
    controller: &Controller<'_, T, LEGS>,
    limits: &WrenchLimits<T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    contacts: &[bool; LEGS],
    x: Twist<T>,
) -> Result<Loads<T, LEGS>, Fault> {
    let robot = controller.robot;
    let mut at_ankles = [Wrench::zero(); LEGS];
    let mut hanging = [[T::zero(); LEG]; LEGS];
    let v = central.velocity;
    let a = x.linear + v.angular.cross(&v.linear) - central.gravity;
    let mut desired =
        inertial_wrench(&robot.central, &Matrix3::identity(), v.angular, x.angular, a);
    let given = robot.legs.iter().zip(legs).zip(&robot.reach).zip(contacts);
    let taken = at_ankles.iter_mut().zip(&mut hanging);
    for (number, ((((links, leg), reach), stands), (at_ankle, torques))) in
        given.zip(taken).enumerate()
    {
        if *stands {
            let jacobian = LegJacobian::new(leg, *reach, controller.singularity)
                .ok_or(Fault::SingularLeg { leg: number })?;
            let rate = Some(limits.rest_rate);
            let inertial =
                leg_wrench::<T, true>(links, leg, &jacobian, central, (x.angular, a), rate);
            desired += inertial.links - inertial.ground.shifted(leg.origins[LEG - 1]);
            *at_ankle = inertial.ground;
        } else {
            let leg = hanging_leg(links, leg, central, x.angular, a, limits.rest_rate);
            desired += leg.on_central_body;
            *torques = leg.torques;
        }
    }
    let axes = sole_axes(robot, legs);
    let carried = ground_biases(robot, central, legs, &axes, at_ankles);
    Ok(Loads { desired, carried, axes, hanging })
}
