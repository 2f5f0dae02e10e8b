//! Systems to try the simulator on.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot_multibody::{
    Body, BodyState, Chain, ChainJoint, Joint, JointConstraint, Link, System,
};

/// A chain in space that turns and bends: velocities of a rigid turn, and gravity none.
pub fn floating_chain(links: usize, joint: ChainJoint) -> (System, Vec<BodyState>, Vec<BodyState>) {
    let chain = Chain { links, joint, floats: true, gravity: 0.0, ..super::motion::CHAIN };
    let states = chain.bent(0.2);
    let rates = rigid(&states, [0.3, -0.2, 0.5], [0.7, 1.1, -0.4]);
    (chain.system().expect("a system"), states, rates)
}

/// Rates of bodies that move as one.
pub fn rigid(states: &[BodyState], v: [f64; 3], w: [f64; 3]) -> Vec<BodyState> {
    states
        .iter()
        .map(|x| {
            let turn =
                [w[1] * x[2] - w[2] * x[1], w[2] * x[0] - w[0] * x[2], w[0] * x[1] - w[1] * x[0]];
            // (0, ω/2) ⋆ q with ω in the world's frame.
            let q = [
                -0.5 * (w[0] * x[4] + w[1] * x[5] + w[2] * x[6]),
                0.5 * (w[0] * x[3] + w[1] * x[6] - w[2] * x[5]),
                0.5 * (w[1] * x[3] + w[2] * x[4] - w[0] * x[6]),
                0.5 * (w[2] * x[3] + w[0] * x[5] - w[1] * x[4]),
            ];
            [v[0] + turn[0], v[1] + turn[1], v[2] + turn[2], q[0], q[1], q[2], q[3]]
        })
        .collect()
}

/// A random tree with all kinds of joints, all frames parallel at the start, turning as one.
pub fn mixed_tree(links: usize) -> (System, Vec<BodyState>, Vec<BodyState>) {
    let mut random = Pcg64Mcg::seed_from_u64(50);
    let mut uniform = |low: f64, high: f64| random.random_range(low..high);
    let (mut all, mut states) = (Vec::new(), Vec::<BodyState>::new());
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let upright = [1.0, 0.0, 0.0, 0.0];
    for k in 0..links {
        let inboard = (k > 0).then(|| (uniform(0.0, 1.0) * k as f64) as usize);
        let constraint = match k % 5 {
            _ if k == 0 => JointConstraint::Floating,
            0 => JointConstraint::Spherical,
            1 => JointConstraint::Revolute { axis: x },
            2 => JointConstraint::Universal { outboard_axis: x, inboard_axis: y },
            3 => JointConstraint::Fixed,
            _ => JointConstraint::Prismatic { axis: z },
        };
        let arm = |uniform: &mut dyn FnMut(f64, f64) -> f64| -> [f64; 3] {
            std::array::from_fn(|_| uniform(-0.2, 0.2))
        };
        let (outboard, at) = (arm(&mut uniform), arm(&mut uniform));
        let centre: [f64; 3] = match inboard {
            None => [0.0; 3],
            Some(i) => std::array::from_fn(|c| states[i][c] + at[c] - outboard[c]),
        };
        states.push([centre[0], centre[1], centre[2], 1.0, 0.0, 0.0, 0.0]);
        let body = Body {
            mass: uniform(0.5, 2.0),
            inertia: [uniform(0.02, 0.03), uniform(0.02, 0.03), uniform(0.02, 0.03)],
        };
        all.push(Link {
            inboard,
            joint: Joint { outboard, inboard: at, home: upright, constraint },
            body,
        });
    }
    // Slow enough that sliders do not fly far out.
    let rates = rigid(&states, [0.2, 0.1, -0.3], [0.3, 0.5, -0.2]);
    (System::new(all, 0.0).expect("a system"), states, rates)
}
