//! What is minimised, and how the inverse of its Hessian acts.
//!
//! # Notation
//! `T`: six rows of the task by the unknowns x of all feet, weighted by the roots of λ and α and by m;
//! `t` what they are to be at; `D`: what the unknowns themselves cost, a diagonal.
//! ```text
//! H = Tᵀ T + D,     K = 1 + T D⁻¹ Tᵀ                                               (1)
//! H⁻¹ g = D⁻¹ (g − Tᵀ K⁻¹ T D⁻¹ g)                                                 (2)
//! x₀ = H⁻¹ Tᵀ t = D⁻¹ Tᵀ K⁻¹ t                                                     (3)
//! ```
//! One 6 × 6 factorisation serves any number of feet. In f32, (2) loses the digits by which K is above 1:
//! two to three where feet stand, none at `x₀`.

use super::super::leg_inverse::DIRECTIONS;
use super::dynamics::{MotionDynamics, Unknowns};
use crate::Real;
use crate::balance::whole_body::MotionTask;
use crate::balance::{AngularTask, LinearTask};
use crate::qp::Ldl;
use crate::spatial::{Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// What counts how much where not all can be had.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionWeights<T> {
    /// λ: acceleration of the centre of mass.
    pub linear: T,
    /// α: angular acceleration of the central body, m².
    pub angular: T,
    /// σ: acceleration of a swinging foot's reference point.
    pub swing_linear: T,
    /// ρ: its angular acceleration, m².
    pub swing_angular: T,
    /// ε: a pressing foot's force over the mass.
    pub regularization: T,
    /// ℓ, m: its moment counts as a force at this length.
    pub norm_length: T,
}

impl<T: Real> MotionWeights<T> {
    /// Starting values for a centre of mass at the height `z` (m) under gravity `g` (m/s²). With
    /// z₀ = 0.82 m: λ = 1, α = 0.01 (z/z₀)², σ = 0.05, ρ = 0.005 (z/z₀)², and ε such that a force of
    /// m g/7.3 counts as 0.1 m/s²; ℓ = z/8.2. A weight of a swinging foot above some tenths takes the
    /// ground's force for it; one of the trunk above α keeps it more level, and takes from pushes.
    pub fn scaled(height: T, gravity: T) -> Self {
        let square = height * height;
        Self {
            linear: T::one(),
            angular: square * T::of(0.01 / (0.82 * 0.82)),
            swing_linear: T::of(0.05),
            swing_angular: square * T::of(0.005 / (0.82 * 0.82)),
            regularization: T::of(0.01 * 7.3 * 7.3) / (gravity * gravity),
            norm_length: height / T::of(8.2),
        }
    }
}

/// What the objective reads beside the dynamics.
pub(super) struct Surroundings<'a, T> {
    /// World axes from frame 1.
    pub central: &'a Matrix3<T>,
    /// Frame 1's origin, m.
    pub position: Vector3<T>,
    /// m/s²
    pub gravity: Vector3<T>,
    pub mass: T,
}

/// (1), factored.
pub(super) struct Objective<T, const FEET: usize> {
    /// Columns of `T`, by unknown.
    columns: [[[T; 6]; DIRECTIONS]; FEET],
    /// `D⁻¹`; zero where there is no unknown.
    inverse: [Unknowns<T>; FEET],
    factors: Ldl<T, 6>,
    /// `x₀`
    pub minimum: [Unknowns<T>; FEET],
}

impl<T: Real, const FEET: usize> Objective<T, FEET> {
    /// `free` is X where all unknowns are zero. `None` where a number is not finite.
    #[inline(never)]
    pub fn new<const NV: usize>(
        dynamics: &MotionDynamics<'_, T, FEET, NV>,
        weights: &MotionWeights<T>,
        around: &Surroundings<'_, T>,
        task: &MotionTask<T, FEET>,
        free: Twist<T>,
    ) -> Option<Self> {
        let (zero, one) = (T::zero(), T::one());
        let mass = around.mass;
        let square = mass * mass;
        let (linear, angular) = (weights.linear.sqrt(), weights.angular.sqrt() * mass);
        let mut columns = [[[zero; 6]; DIRECTIONS]; FEET];
        let mut inverse = [[zero; DIRECTIONS]; FEET];
        // Angular rows: of the central body in frame 1's axes.
        let wanted = match &task.angular {
            AngularTask::CentralBody(acceleration) => {
                for row in 3..6 {
                    let mut unit = [zero; 6];
                    unit[row] = one;
                    let of_feet = dynamics.per_unknown(&dynamics.for_base(&unit));
                    for (columns, of_foot) in columns.iter_mut().zip(&of_feet) {
                        for (column, x) in columns.iter_mut().zip(of_foot) {
                            column[row] = *x * angular;
                        }
                    }
                }
                (around.central.tr_mul(acceleration) - free.angular) * angular
            }
            AngularTask::Momentum { rate, inertia } => {
                let per_inertia = angular / *inertia;
                momentum_rows(dynamics, around, per_inertia, &mut columns);
                rate * per_inertia
            }
        };
        let goal = linear_goal(&task.linear, around) * linear;
        let goal = [goal.x, goal.y, goal.z, wanted.x, wanted.y, wanted.z];
        for ((columns, inverse), foot) in columns.iter_mut().zip(&mut inverse).zip(dynamics.feet) {
            let Some(foot) = foot else { continue };
            let contact = &foot.contact;
            let [force, moment] = if foot.limits.is_some() {
                let to_world = around.central * contact.rotation;
                let point = around.position + around.central * contact.position;
                for (k, column) in columns.iter_mut().enumerate() {
                    let axis = |i: usize| to_world.column(i).into_owned();
                    let w = match k {
                        0..3 => Wrench { force: axis(k), torque: Vector3::zeros() },
                        _ => Wrench { force: Vector3::zeros(), torque: axis(k - 3) },
                    };
                    let rows = linear_rows(&task.linear, around, point, &w) * linear;
                    [column[0], column[1], column[2]] = rows.into();
                }
                let length = weights.norm_length;
                [one / weights.regularization, length * length / weights.regularization]
            } else {
                let inverse = |weight: T| one / (weight * square);
                [inverse(weights.swing_linear), inverse(weights.swing_angular)]
            };
            let costs = [force, force, force, moment, moment, moment];
            for ((to, cost), exists) in inverse.iter_mut().zip(costs).zip(contact.directions) {
                *to = if exists { cost } else { zero };
            }
        }
        let mut matrix = [[zero; 6]; 6];
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] = one;
        }
        for (columns, inverse) in columns.iter().zip(&inverse) {
            for (column, inverse) in columns.iter().zip(inverse) {
                for i in 0..6 {
                    let x = column[i] * *inverse;
                    for j in 0..=i {
                        matrix[i][j] += x * column[j];
                    }
                }
            }
        }
        let factors = Ldl::new(&matrix)?;
        // (3)
        let minimum = spread(&columns, &inverse, &factors.solve(&goal));
        Some(Self { columns, inverse, factors, minimum })
    }

    /// (2)
    #[inline(never)]
    pub fn response(&self, gradient: &[Unknowns<T>; FEET]) -> [Unknowns<T>; FEET] {
        let mut scaled = *gradient;
        let mut task = [T::zero(); 6];
        for ((scaled, inverse), columns) in scaled.iter_mut().zip(&self.inverse).zip(&self.columns)
        {
            for ((x, inverse), column) in scaled.iter_mut().zip(inverse).zip(columns) {
                *x *= *inverse;
                for (sum, c) in task.iter_mut().zip(column) {
                    *sum += *c * *x;
                }
            }
        }
        let less = spread(&self.columns, &self.inverse, &self.factors.solve(&task));
        for (x, less) in scaled.as_flattened_mut().iter_mut().zip(less.as_flattened()) {
            *x -= *less;
        }
        scaled
    }
}

/// `D⁻¹ Tᵀ y`
#[inline(always)]
fn spread<T: Real, const FEET: usize>(
    columns: &[[[T; 6]; DIRECTIONS]; FEET],
    inverse: &[Unknowns<T>; FEET],
    y: &[T; 6],
) -> [Unknowns<T>; FEET] {
    let mut x = *inverse;
    for (x, column) in x.as_flattened_mut().iter_mut().zip(columns.as_flattened()) {
        *x *= column.iter().zip(y).fold(T::zero(), |sum, (c, y)| sum + *c * *y);
    }
    x
}

/// What the unknowns add to the rate of the angular momentum about the centre of mass (world axes), times a factor:
/// moments of feet that press.
#[cold]
#[inline(never)]
fn momentum_rows<T: Real, const FEET: usize, const NV: usize>(
    dynamics: &MotionDynamics<'_, T, FEET, NV>,
    around: &Surroundings<'_, T>,
    factor: T,
    columns: &mut [[[T; 6]; DIRECTIONS]; FEET],
) {
    let center = dynamics.center_of_mass(around.mass);
    for (columns, foot) in columns.iter_mut().zip(dynamics.feet) {
        let Some(foot) = foot.as_ref().filter(|foot| foot.limits.is_some()) else { continue };
        let to_world = around.central * foot.contact.rotation;
        let arm = around.central * (foot.contact.position - center);
        for (k, column) in columns.iter_mut().enumerate() {
            let moment = match k {
                0..3 => arm.cross(&to_world.column(k)),
                _ => to_world.column(k - 3).into_owned(),
            };
            [column[3], column[4], column[5]] = (moment * factor).into();
        }
    }
}

/// What a wrench (world axes) about the point `at` adds to `m c̈` as the task counts it.
#[inline(always)]
fn linear_rows<T: Real>(
    task: &LinearTask<T>,
    around: &Surroundings<'_, T>,
    at: Vector3<T>,
    w: &Wrench<T>,
) -> Vector3<T> {
    match task {
        LinearTask::CenterOfMass(_) => w.force,
        LinearTask::CenterOfPressure { point: [x, y], per_length, .. } => {
            let per_moment = *per_length / around.gravity.norm();
            let (dx, dy) = (at.x - *x, at.y - *y);
            Vector3::new(
                (w.torque.y - dx * w.force.z) * per_moment,
                -(w.torque.x + dy * w.force.z) * per_moment,
                w.force.z,
            )
        }
        LinearTask::Free => Vector3::zeros(),
    }
}

/// What these rows are to be: forces, N.
#[inline(always)]
fn linear_goal<T: Real>(task: &LinearTask<T>, around: &Surroundings<'_, T>) -> Vector3<T> {
    let wanted = match task {
        LinearTask::CenterOfMass(acceleration) => *acceleration - around.gravity,
        LinearTask::CenterOfPressure { vertical, .. } => {
            Vector3::new(T::zero(), T::zero(), *vertical - around.gravity.z)
        }
        LinearTask::Free => Vector3::zeros(),
    };
    wanted * around.mass
}
