//! The f32 tick in a linked program for the target. `cargo xtask target` reads its symbols: nothing
//! of `core::panicking` may be among them. On the host this program has nothing to do.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(not(target_os = "none"))]
fn main() {
    println!("this program is for the target; `cargo xtask target` builds and inspects it");
}

#[cfg(target_os = "none")]
mod target {
    use core::hint::black_box;
    use nalgebra::Vector3;
    use surefoot::balance::{
        Command, Controller, Fault, FootLimits, LeggedRobot, Reference, RobotState, Sole,
        WorkspaceForm, tick,
    };
    use surefoot::model::robots::biped;
    use surefoot::spatial::{Quaternion, Twist};

    const ROBOT_F64: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
    static ROBOT: LeggedRobot<f32, 2> = ROBOT_F64.to_f32(&biped::TREE_F32);

    /// Inputs that the compiler knows nothing about, so that every branch of the tick is linked.
    #[inline(never)]
    fn run_tick() -> Result<Command<f32, 2>, Fault> {
        let mut controller = Controller::new(&ROBOT);
        controller.form = black_box(WorkspaceForm::BigBase { factor: 1e3 });
        controller.foot_limits = black_box(Some(FootLimits {
            least_normal_force: 0.0,
            friction: Some(0.3),
            sole: Some(Sole { x: [-0.2, 0.05], y: [-0.05, 0.05], z: -0.06 }),
        }));
        let state = RobotState {
            position: Vector3::zeros(),
            orientation: Quaternion::identity(),
            velocity: Twist::zero(),
            joint_angles: [[0.0; 6]; 2],
            joint_rates: [[0.0; 6]; 2],
        };
        let reference = Reference::at_rest(Vector3::zeros(), Quaternion::identity());
        tick(black_box(&controller), &black_box(state), &black_box(reference))
    }

    #[cortex_m_rt::entry]
    fn entry() -> ! {
        loop {
            let result = black_box(run_tick());
            #[cfg(feature = "prove-check")]
            black_box(result.expect("a panicking path on purpose"));
            #[cfg(not(feature = "prove-check"))]
            let _ = result;
        }
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
        loop {
            black_box(());
        }
    }
}
