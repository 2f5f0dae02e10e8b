//! Quadratic programs: foot wrenches within limits, and a dense program, have no panicking path.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::hint::black_box;
use nalgebra::{Matrix3, Vector3};
use surefoot::balance::{ContactFoot, ContactLimits, ContactPatch, ContactProgram, ContactWeights};
use surefoot::qp::{ActiveRows, DenseProgram, Settings, solve};
use surefoot::spatial::{Twist, Wrench};

/// Feet of which the optimiser knows nothing but their number and that of their legs' joints.
#[inline(always)]
fn opaque_contacts<const FEET: usize, const JOINTS: usize, const ROWS: usize>() {
    let patches = [
        ContactPatch::sole([-0.1, 0.1], [-0.05, 0.05], -0.03),
        ContactPatch::edge_along_x(0.1),
        ContactPatch::edge_along_y(0.1),
        ContactPatch::point(),
    ];
    let limits: [ContactLimits<f32, JOINTS>; FEET] = core::array::from_fn(|i| {
        black_box(ContactLimits {
            least_force: 20.0,
            greatest_force: 800.0,
            friction: 0.5,
            patch: patches[i % 4],
            torques: [100.0; JOINTS],
        })
    });
    let feet: [Option<ContactFoot<'_, f32, JOINTS>>; FEET] = core::array::from_fn(|i| {
        black_box(Some(ContactFoot {
            rotation: Matrix3::identity(),
            position: Vector3::new(0.0, 0.1, -1.0),
            joints: [Twist::zero(); JOINTS],
            carried: Wrench::zero(),
            limits: &limits[i],
        }))
    });
    let weights = black_box(ContactWeights::standing());
    let world = black_box(Matrix3::identity());
    let desired = black_box(Wrench { force: Vector3::z(), torque: Vector3::zeros() });
    let Some(program) = ContactProgram::new(&feet, &weights, &world, desired) else { return };
    let mut active = black_box(ActiveRows::<f32, ROWS>::new());
    let settings = black_box(Settings::new(1e-3));
    if let Ok(solution) = solve(&program, &mut active, &settings) {
        black_box(program.achieved(&solution.x));
        black_box(program.reason(&solution.x, &active));
        for (foot, w) in feet.iter().flatten().zip(&solution.x) {
            black_box(foot.clipped_torques(w));
        }
        black_box(&solution);
    }
}

#[inline(always)]
fn opaque_dense() {
    let program = black_box(DenseProgram {
        minimum: [0.0; 6],
        hessian: [[1.0; 6]; 6],
        normals: [[1.0; 6]; 20],
        bounds: [1.0_f32; 20],
    });
    let mut active = black_box(ActiveRows::<f32, 12>::new());
    let _ = black_box(solve(&program, &mut active, &black_box(Settings::new(1e-3))));
}

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    opaque_contacts::<2, 6, 16>();
    opaque_contacts::<4, 3, 24>();
    opaque_dense();
    panic_free::halt()
}
