//! Bodies on planes that are not level.

use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_multibody::contact::{Floor, GroundPlane, Switching};
use surefoot_multibody::{
    Body, Joint, JointConstraint, Link, NotPlanar, PlanarError, PlanarSimulation, Simulation, Site,
    System, SystemError,
};

const H: f64 = 1e-3;
const UPHILL: f64 = 0.7;
const HALF: [f64; 3] = [0.1, 0.08, 0.02];

fn block(friction: f64) -> System {
    let joint = Joint {
        outboard: [0.0; 3],
        inboard: [0.0; 3],
        home: [1.0, 0.0, 0.0, 0.0],
        constraint: JointConstraint::Floating,
    };
    let body = Body { mass: 3.0, inertia: [0.01, 0.012, 0.02] };
    let floor = Floor { static_friction: friction, dynamic_friction: friction, ..Floor::RUBBER };
    let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let site = |[x, y]: [f64; 2]| Site { link: 0, position: [x * HALF[0], y * HALF[1], -HALF[2]] };
    System::new(vec![Link { inboard: None, joint, body }], 9.81)
        .and_then(|system| {
            system.on_floor(floor, Switching::WithinTheStep, corners.map(site).to_vec())
        })
        .expect("a system")
}

/// The block at rest flat on the plane, in its equilibrium's depth.
fn played(friction: f64, slope: f64, point: Vector3<f64>, seconds: f64) -> Vec<[f64; 7]> {
    let plane = GroundPlane::new(point, slope, UPHILL);
    let system = block(friction).on_plane(0, plane).expect("a plane");
    let q = Quaternion::from_axis_angle(Vector3::new(-UPHILL.sin(), UPHILL.cos(), 0.0), -slope);
    let depth = 3.0 * 9.81 * slope.cos() / (4.0 * Floor::RUBBER.normal_stiffness);
    let place = point + plane.rotation() * Vector3::new(0.0, 0.0, HALF[2] - depth);
    let [s, i, j, k] = q.to_array();
    let state = [place.x, place.y, place.z, s, i, j, k];
    let mut simulation = Simulation::new(system, H, &[state], &[[0.0; 7]]).expect("a start");
    let steps = (seconds / H).round() as usize;
    let mut all = vec![state];
    for _ in 0..steps {
        simulation.step().expect("a step");
        all.push(simulation.state(0));
    }
    all
}

/// Below the angle of friction a block rests; beyond it slides down at `g (sin α − μ cos α)`.
#[test]
fn blocks_rest_or_slide() {
    let friction = 0.3;
    let point = Vector3::new(0.4, -0.3, 0.25);
    for slope in [-0.25, 0.1, 0.25] {
        let all = played(friction, slope, point, 0.5);
        let moved = Vector3::from_row_slice(&all[all.len() - 1][..3])
            - Vector3::from_row_slice(&all[0][..3]);
        println!("{slope}: rests within {:e} m", moved.norm());
        // The floor's springs give by m g sin α/4 k.
        assert!(moved.norm() < 2.0 * 3.0 * 9.81 * f64::sin(slope.abs()) / (4.0 * 75e3), "{slope}");
    }
    for slope in [0.35_f64, 0.6] {
        let seconds = 0.6;
        let all = played(friction, slope, point, seconds);
        let down =
            Vector3::new(UPHILL.cos() * slope.cos(), UPHILL.sin() * slope.cos(), slope.sin());
        let at = |state: &[f64; 7]| -down.dot(&Vector3::from_row_slice(&state[..3]));
        // Steady sliding: the second difference of the way.
        let n = all.len();
        let (a, b, c) = (at(&all[n - 1]), at(&all[(n - 1) / 2 + 100]), at(&all[200]));
        let span = (n - 1 - 200) as f64 / 2.0 * H;
        let acceleration = (a - 2.0 * b + c) / (span * span);
        let exact = 9.81 * (slope.sin() - friction * slope.cos());
        println!("{slope}: {acceleration} m/s², {exact} wanted");
        assert!((acceleration - exact).abs() < 1e-6 * exact, "{slope}");
    }
}

/// A level plane that lies higher: the same motion, so much higher.
#[test]
fn a_raised_plane_is_the_floor() {
    let low = played(0.3, 0.0, Vector3::zeros(), 0.1);
    let high = played(0.3, 0.0, Vector3::new(0.0, 0.0, 0.5), 0.1);
    for (a, b) in low.iter().zip(&high) {
        assert!((b[2] - a[2] - 0.5).abs() < 1e-12);
    }
}

#[test]
fn planes_that_are_none() {
    let plane = GroundPlane::new(Vector3::zeros(), 0.1, 0.0);
    let twice = block(0.3).on_plane(0, plane).and_then(|system| system.on_plane(0, plane));
    assert!(matches!(twice, Err(SystemError::Terrain { link: 0 })));
    assert!(matches!(block(0.3).on_plane(1, plane), Err(SystemError::Terrain { link: 1 })));
    let sloped = block(0.3).on_plane(0, plane).expect("a plane");
    let start = [0.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0];
    let planar = PlanarSimulation::new(sloped, H, &[start], &[[0.0; 7]]);
    assert!(matches!(planar, Err(PlanarError::NotPlanar(NotPlanar::Terrain))));
}
