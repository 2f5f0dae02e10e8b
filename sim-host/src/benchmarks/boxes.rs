//! Gazebo's measure: largest errors of energy, angular momentum and position over the whole flight.

use super::play::Trace;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_sim::scene::{JointEntry, Mechanism, MechanismScene};

/// The least errors of ODE, Bullet, Simbody and DART at 1 ms (scpeters/benchmark, 86fcb71): energy (J), angular momentum
/// (N·m·s), position (m); all three Simbody's.
const BEST: [f64; 3] = [0.00623, 0.00643, 0.0245];

/// The largest of the three errors, each over the best of the four engines'; none of another scene.
pub(super) fn over_engines(scene: &MechanismScene, traces: &[Trace]) -> Option<f64> {
    let Mechanism::Multibody(all) = &scene.mechanism else { return None };
    let [body] = &all.bodies[..] else { return None };
    let JointEntry::Floating { velocity_m_s, .. } = body.joint else { return None };
    let inertia = Vector3::from(body.inertia_kg_m2);
    let spin = |trace: &Trace| {
        let [_, _, _, a, b, c, d] = *trace.configuration.first_chunk::<7>()?;
        let [_, _, _, e, f, g, h] = *trace.velocity.first_chunk::<7>()?;
        let (q, rate) =
            (Quaternion::from_array([a, b, c, d]), Quaternion::from_array([e, f, g, h]));
        let omega = q.conjugate().product(rate).v * 2.0;
        Some(q.rotate(inertia.component_mul(&omega)))
    };
    let first = traces.first()?;
    let at_start = spin(first)?;
    let mut largest = 0.0_f64;
    for trace in traces {
        let t = trace.time_s;
        let fallen = Vector3::new(0.0, 0.0, -0.5 * all.gravity_m_s2 * t * t);
        let exact = Vector3::from(body.center_m) + Vector3::from(velocity_m_s) * t + fallen;
        let [x, y, z] = *trace.configuration.first_chunk::<3>()?;
        let errors = [
            (trace.energy - first.energy).abs(),
            (spin(trace)? - at_start).norm(),
            (Vector3::new(x, y, z) - exact).norm(),
        ];
        for (error, best) in errors.iter().zip(BEST) {
            largest = largest.max(error / best);
        }
    }
    Some(largest)
}
