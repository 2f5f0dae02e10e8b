//! What a tree makes of its description: axes kept to the last place, axes against the frame's, and
//! links that no robot has.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use surefoot::dynamics::{
    body_poses, body_velocities, forward_dynamics, forward_kinematics, inverse_dynamics,
    joint_poses, mass_matrix,
};
use surefoot::model::{Link, LinkFault, Tree, TreeFault};
use surefoot_tests::random_trees::{random, symmetric};
use surefoot_tests::vectors::relative_error;

/// Links of the chain.
const M: usize = 4;

/// A chain on the ground with these axes, the last of which is a slide; all of it described in axes
/// that are turned by `turn`.
fn chain(axes: [Vector3<f64>; M], turn: &Rotation3<f64>) -> Tree<f64, M, M, M> {
    let described = |v: Vector3<f64>| <[f64; 3]>::from(turn * v);
    let orientation = UnitQuaternion::from_rotation_matrix(turn);
    let q = [orientation.w, orientation.i, orientation.j, orientation.k];
    let links = std::array::from_fn(|k| {
        let at = k as f64;
        let point = described(Vector3::new(0.3 * at, 0.05 * at, 0.1));
        let center = described(Vector3::new(0.3 * at + 0.12, 0.03, 0.1 - 0.04 * at));
        let axis = described(axes[k]);
        let link =
            if k == M - 1 { Link::prismatic(k, axis) } else { Link::revolute(k, axis, point) };
        link.body(1.0 + at, [0.03, 0.05, 0.06], center).oriented(q)
    });
    Tree::new(links).with_gravity(described(Vector3::new(0.0, 0.0, -9.81)))
}

/// Torques, accelerations, mass matrix and, in the chain's own axes, the last body's pose and twist.
fn results(tree: &Tree<f64, M, M, M>, turn: &Rotation3<f64>, sense: [f64; M]) -> Vec<f64> {
    let signed = |all: [f64; M]| std::array::from_fn(|i| all[i] * sense[i]);
    let q = signed([0.4, -0.7, 1.1, 0.2]);
    let v = signed([0.9, -0.3, 0.5, -0.8]);
    let a = signed([-0.2, 0.6, 0.8, 0.3]);
    let poses = joint_poses(tree, &q).expect("finite");
    let torques = signed(inverse_dynamics(tree, &poses, &v, &a, None));
    let found = forward_dynamics(tree, &poses, &v, &signed([1.0, 2.0, -3.0, 4.0]), None);
    let m = mass_matrix(tree, &poses);
    let last = body_poses(tree, &poses)[M - 1];
    let twist = body_velocities(tree, &poses, &v)[M - 1];
    let kinematics = forward_kinematics(tree, &poses, &v, &a)[M - 1];
    let own = |v: Vector3<f64>| turn.inverse() * v;
    let rotation: Matrix3<f64> = turn.inverse() * last.rotation;
    let mut all: Vec<f64> = torques.to_vec();
    all.extend(signed(found.expect("regular")));
    all.extend((0..M).flat_map(|i| (0..M).map(move |j| m[i][j] * sense[i] * sense[j])));
    all.extend(own(last.position).iter().chain(rotation.iter()));
    // Twists are in the body's own frame, which turns with the description.
    for twist in [twist, kinematics.velocity, kinematics.acceleration] {
        all.extend(twist.linear.iter().chain(twist.angular.iter()));
    }
    all
}

fn straight() -> [Vector3<f64>; M] {
    [Vector3::z(), Vector3::y(), Vector3::x(), Vector3::z()]
}

/// Joint `k`'s axis turned by `angle` about an axis across it.
fn tilted(k: usize, angle: f64) -> [Vector3<f64>; M] {
    let mut axes = straight();
    let across = axes[k].cross(&Vector3::new(0.3, 0.5, -0.8)).normalize();
    axes[k] = axes[k] * angle.cos() + across.cross(&axes[k]) * angle.sin();
    axes
}

/// A description in other axes, in which nothing is along a coordinate axis, takes the general way.
#[test]
fn a_robot_does_not_depend_on_the_axes_that_describe_it() {
    let mut rng = random(51);
    let mut worst = 0.0_f64;
    for _ in 0..50 {
        let turn = Rotation3::new(Vector3::from(symmetric(&mut rng)) * 2.0);
        for angle in [0.0, 1e-12, 1e-9, 1e-7, 1e-3, 0.4] {
            for k in 0..M {
                let axes = tilted(k, angle);
                let own =
                    results(&chain(axes, &Rotation3::identity()), &Rotation3::identity(), [1.0; M]);
                let general = results(&chain(axes, &turn), &turn, [1.0; M]);
                worst = worst.max(relative_error(&general, &own));
            }
        }
    }
    println!("largest relative error {worst:e}");
    // Measured: 1.8e-15.
    assert!(worst < 2e-14, "{worst:e}");
}

/// Results change in proportion to the tilt of an axis, however small: none is taken for the nearest
/// coordinate axis.
#[test]
fn small_tilts_of_an_axis_are_kept() {
    let none = Rotation3::identity();
    let at = |k: usize, angle: f64| results(&chain(tilted(k, angle), &none), &none, [1.0; M]);
    for k in 0..M {
        let slope: Vec<f64> = {
            let h = 1e-4;
            at(k, h).iter().zip(at(k, -h)).map(|(p, m)| (p - m) / (2.0 * h)).collect()
        };
        let steepest = slope.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(steepest > 0.5, "joint {k} does not matter");
        for angle in [1e-7, 1e-9, 1e-12] {
            let change: Vec<f64> =
                at(k, angle).iter().zip(at(k, 0.0)).map(|(p, m)| (p - m) / angle).collect();
            let error = slope.iter().zip(&change).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // Curvature, and round-off of numbers up to 100.
            let allowed = 100.0 * angle + 3e-14 / angle + 1e-5;
            println!("joint {k}, {angle:e} rad: slope {steepest:.1}, error {error:e}");
            assert!(error < allowed, "joint {k}, {angle:e}: {error:e} of {steepest}");
        }
        // Round-off of a computed axis is no tilt.
        assert_eq!(at(k, 1e-15), at(k, 0.0));
    }
}

/// A joint about −e is one about e that counts backwards, to the last bit: the same frames, the same
/// operations.
#[test]
fn a_negative_axis_is_the_positive_one_backwards() {
    let none = Rotation3::identity();
    let positive = results(&chain(straight(), &none), &none, [1.0; M]);
    for senses in 0..1 << M {
        let sense: [f64; M] =
            std::array::from_fn(|i| if senses >> i & 1 == 1 { -1.0 } else { 1.0 });
        let mut axes = straight();
        for (axis, sense) in axes.iter_mut().zip(sense) {
            *axis *= sense;
        }
        let tree = chain(axes, &none);
        assert_eq!(results(&tree, &none, sense), positive, "{sense:?}");
        for k in 0..M {
            let shape = tree.body_shape(k).expect("a body");
            assert_eq!(shape.axis, axes[k]);
        }
    }
}

fn one(link: Link) -> Result<(), TreeFault> {
    Tree::<f64, 1, 1, 1>::try_new([link]).map(|_| ())
}

#[test]
fn links_that_no_robot_has() {
    use LinkFault::*;
    let z = [0.0, 0.0, 1.0];
    let hinge = Link::revolute(0, z, [0.0; 3]);
    let sound = hinge.body(1.0, [0.1; 3], [0.0; 3]);
    assert_eq!(one(sound), Ok(()));
    let refused = |link: Link, reason: LinkFault| {
        // Not the first of the list, so that the index says something.
        let found = Tree::<f64, 2, 2, 2>::try_new([sound, link]).map(|_| ());
        assert_eq!(found, Err(TreeFault::Link { index: 1, reason }));
        let words = format!("{}", TreeFault::Link { index: 1, reason });
        assert!(words.starts_with("links[1]: ") && words.len() > 20, "{words}");
    };
    let body = |mass, inertia| hinge.body(mass, inertia, [0.0; 3]);
    refused(Link::revolute(2, z, [0.0; 3]).body(1.0, [0.1; 3], [0.0; 3]), Inboard);
    refused(Link::floating(1).body(1.0, [0.1; 3], [0.0; 3]), FloatingInboard);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        refused(Link::revolute(0, [0.0, bad, 1.0], [0.0; 3]).body(1.0, [0.1; 3], [0.0; 3]), Axis);
        refused(Link::revolute(0, z, [bad, 0.0, 0.0]).body(1.0, [0.1; 3], [0.0; 3]), Point);
        refused(hinge.body(1.0, [0.1; 3], [0.0, bad, 0.0]), Center);
        refused(sound.oriented([bad, 0.0, 0.0, 0.0]), Orientation);
        refused(body(bad, [0.1; 3]), Mass);
        refused(body(1.0, [0.1, bad, 0.1]), Inertia);
        let products = [0.1, 0.1, 0.1, 0.0, bad, 0.0];
        refused(hinge.body_with_products(1.0, products, [0.0; 3]), Inertia);
    }
    refused(hinge.body(1.0, [0.1; 3], [1e200, 0.0, 0.0]), Center);
    refused(Link::prismatic(0, [0.0; 3]).body(1.0, [0.1; 3], [0.0; 3]), Axis);
    refused(sound.oriented([0.9, 0.0, 0.0, 0.0]), Orientation);
    refused(body(-1.0, [0.1; 3]), Mass);
    refused(body(0.0, [1e-9, 1e-9, 1e-9]), InertiaWithoutMass);
    refused(
        hinge.body_with_products(0.0, [0.0, 0.0, 0.0, 1e-9, 0.0, 0.0], [0.0; 3]),
        InertiaWithoutMass,
    );
    refused(body(1.0, [-0.1, 0.1, 0.1]), Moments);
    refused(body(1.0, [0.1, 0.1, 0.3]), Moments);
    let products = [0.1, 0.1, 0.1, 0.09, 0.09, 0.09];
    refused(hinge.body_with_products(1.0, products, [0.0; 3]), Products);
    refused(hinge, LeafWithoutMass);
    let mut joint = surefoot::model::robots::branching::UNIVERSAL;
    joint.degrees_of_freedom = 9;
    refused(Link::general(0, [0.0; 3], joint).body(1.0, [0.1; 3], [0.0; 3]), GeneralJoint);

    assert!(matches!(Tree::<f64, 0, 0, 0>::try_new([]), Err(TreeFault::Empty)));
    let given = Tree::<f64, 1, 2, 1>::try_new([sound]).map(|_| ());
    assert_eq!(given, Err(TreeFault::Coordinates { given: 2, needed: 1 }));
    let given = Tree::<f64, 1, 1, 0>::try_new([sound]).map(|_| ());
    assert_eq!(given, Err(TreeFault::Velocities { given: 0, needed: 1 }));
    // Axes of any length are directions.
    for length in [1e-300, 1e-9, 1e300] {
        let axis = [0.0, 0.6 * length, 0.8 * length];
        assert_eq!(one(Link::revolute(0, axis, [0.0; 3]).body(1.0, [0.1; 3], [0.0; 3])), Ok(()));
    }
}

/// What a body can have does not depend on its size: a robot that is scaled by any length and mass is
/// accepted where it was, and refused where it was.
#[test]
fn inertias_are_judged_at_any_size() {
    let hinge = Link::revolute(0, [0.0, 0.0, 1.0], [0.0; 3]);
    for length in [1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6] {
        for mass in [1e-18, 1e-6, 1.0, 1e6] {
            let scaled = |moments: [f64; 3]| {
                let inertia = moments.map(|x| x * mass * length * length);
                one(hinge.body(mass, inertia, [0.5 * length, 0.0, 0.0]))
            };
            // A flat plate's, exact, and with the rounding of nine printed digits.
            assert_eq!(scaled([0.1, 0.2, 0.3]), Ok(()), "{length:e} m, {mass:e} kg");
            assert_eq!(scaled([0.1, 0.2, 0.300_000_000_3]), Ok(()));
            let refused = Err(TreeFault::Link { index: 0, reason: LinkFault::Moments });
            assert_eq!(scaled([0.1, 0.2, 0.300_001]), refused, "{length:e} m, {mass:e} kg");
        }
    }
    // A link of iCub: 0.746 kg, 1.8 cm from its joint, with moments of 1e-20 that no body has. They
    // are nothing beside m l² = 2.4e-4.
    let noise = hinge.body(0.746, [7.2e-21, 3.9e-20, 4.87e-20], [0.018, 0.0, 0.0]);
    assert_eq!(one(noise), Ok(()));
    // At the joint itself there is nothing to compare them with but themselves.
    let noise = hinge.body(0.746, [7.2e-21, 3.9e-20, 4.87e-20], [0.0; 3]);
    assert!(one(noise).is_err());
}
