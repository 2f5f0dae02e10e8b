//! Feet that are points and edges: against dense programs of just the forces and moments there are.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use surefoot::balance::{ContactFoot, ContactLimits, ContactPatch, ContactProgram, ContactWeights};
use surefoot::qp::{ActiveRows, DenseProgram, Program, Settings, Status, solve};
use surefoot::spatial::{Twist, Wrench};
use surefoot_tests::random_trees::{random, symmetric};

/// Legs of three joints.
type Foot<'a> = ContactFoot<'a, f64, 3>;

const FRICTION: f64 = 0.5;

fn limits(patch: ContactPatch<f64>) -> ContactLimits<f64, 3> {
    ContactLimits {
        least_force: 5.0,
        greatest_force: 150.0,
        friction: FRICTION,
        patch,
        torques: [30.0; 3],
    }
}

fn turned(angles: [f64; 3]) -> Matrix3<f64> {
    nalgebra::Rotation3::from_euler_angles(angles[0], angles[1], angles[2]).into_inner()
}

/// The free directions of a foot's wrench, as columns in frame 1 about the foot.
fn directions(foot: &Foot<'_>, moments: &[usize]) -> Vec<Wrench<f64>> {
    let column = |k: usize| Vector3::from(foot.rotation.column(k));
    let forces = (0..3).map(|k| Wrench { force: column(k), torque: Vector3::zeros() });
    let moments = moments.iter().map(|k| Wrench { force: Vector3::zeros(), torque: column(*k) });
    forces.chain(moments).collect()
}

/// Four feet with `N` unknowns in all, three of them the moment that helps, against the dense
/// program: (distance of the answers, rows that bind, moment left out).
fn compare<const N: usize, const FEET: usize>(
    patch: ContactPatch<f64>,
    moments: &[usize],
    seed: u64,
) -> (f64, usize) {
    let mut rng = random(seed);
    let limits = limits(patch);
    let weights = ContactWeights::<f64>::standing();
    let help = 1e-6;
    let (mut worst, mut bound) = (0.0_f64, 0);
    for _ in 0..100 {
        let world = turned(symmetric(&mut rng).map(|x: f64| 0.3 * x));
        let spread =
            |i: usize| Vector3::new(0.2 - 0.4 * (i / 2) as f64, 0.15 - 0.3 * (i % 2) as f64, -0.3);
        let feet: [Option<Foot<'_>>; FEET] = std::array::from_fn(|i| {
            let near = Vector3::from(symmetric::<3>(&mut rng)) * 0.03;
            let joints = std::array::from_fn(|_| {
                Twist::from_array(symmetric::<6>(&mut rng).map(|x: f64| 0.3 * x))
            });
            Some(Foot {
                rotation: turned(symmetric(&mut rng).map(|x: f64| 0.4 * x)),
                position: spread(i) + near,
                joints,
                carried: Wrench { force: Vector3::z() * 3.0, torque: Vector3::zeros() },
                limits: &limits,
            })
        });
        let force = Vector3::z() * 120.0 + Vector3::from(symmetric::<3>(&mut rng)) * 60.0;
        let torque = Vector3::from(symmetric::<3>(&mut rng)) * 20.0;
        let desired = Wrench { force: world.tr_mul(&force), torque };
        let program = ContactProgram::new(&feet, &weights, &world, desired).expect("feet nearby");
        let mut active = ActiveRows::<f64, 32>::new();
        let settings = Settings::new(1e-3);
        let ours = solve(&program, &mut active, &settings).expect("finite");
        assert_eq!(ours.status, Status::Solved);
        bound += active.len();

        // The same with explicit unknowns, and a moment that helps, dear.
        let feet: Vec<_> = feet.iter().flatten().collect();
        let each = 3 + moments.len();
        let mut map = DMatrix::zeros(6, N);
        let mut norm = DVector::zeros(N);
        let (mut normals, mut bounds) = ([[0.0; N]; 128], [-1.0; 128]);
        for (i, foot) in feet.iter().enumerate() {
            for (k, direction) in directions(foot, moments).into_iter().enumerate() {
                let place = each * i + k;
                map.column_mut(place).copy_from_slice(&direction.shifted(foot.position).to_array());
                norm[place] = if k < 3 { 1.0 } else { weights.norm_length.powi(-2) };
                for row in 0..32 {
                    let Some((normal, bound)) = program.row((32 * i + row) as u8) else { continue };
                    let mut w = [Wrench::zero(); FEET];
                    w[i] = direction;
                    normals[32 * i + row][place] = program.product(&normal, &w);
                    bounds[32 * i + row] = bound;
                }
            }
        }
        for k in 0..3 {
            map[(3 + k, N - 3 + k)] = 1.0;
            norm[N - 3 + k] = 1.0 / help;
        }
        let mut task = DMatrix::zeros(6, 6);
        for block in [0, 3] {
            let omega = Vector3::from_fn(|k, _| weights.task[block + k]);
            let rows = Matrix3::from_diagonal(&omega) * world;
            task.fixed_view_mut::<3, 3>(block, block).copy_from(&rows);
        }
        let weighted = &task * &map;
        let inverse = DMatrix::from_diagonal(&norm.map(|x| 1.0 / x));
        let gram = &map * &inverse * map.transpose();
        let solved =
            gram.cholesky().expect("full").solve(&DVector::from_column_slice(&desired.to_array()));
        let minimum = &inverse * map.transpose() * solved;
        let hessian = weighted.transpose() * &weighted
            + DMatrix::from_diagonal(&(&norm * weights.regularization));
        // Rows of directions that the patch does not have are no rows.
        for (normal, bound) in normals.iter().zip(&mut bounds) {
            if normal.iter().all(|x| x.abs() < 1e-12) {
                *bound = -1.0;
            }
        }
        let dense = DenseProgram::<f64, N, 128> {
            minimum: std::array::from_fn(|i| minimum[i]),
            hessian: std::array::from_fn(|i| std::array::from_fn(|j| hessian[(i, j)])),
            normals,
            bounds,
        };
        // The same rows in force: rows of a patch without width repeat each other in the dense form.
        let mut held = ActiveRows::<f64, 32>::new();
        let mut only = dense;
        for row in 0..128 {
            if !offered(&patch, row % 32) {
                only.bounds[row] = -1e9;
            }
        }
        let theirs = solve(&only, &mut held, &settings).expect("finite");
        for (i, foot) in feet.iter().enumerate() {
            let sum = directions(foot, moments)
                .into_iter()
                .enumerate()
                .fold(Wrench::zero(), |sum, (k, d)| sum + d * theirs.x[each * i + k]);
            for (a, b) in ours.x[i].to_array().into_iter().zip(sum.to_array()) {
                worst = worst.max((a - b).abs());
            }
        }
    }
    (worst, bound)
}

/// Rows that a patch has.
fn offered(patch: &ContactPatch<f64>, row: usize) -> bool {
    let (point, along_x, along_y) = (
        *patch == ContactPatch::point(),
        *patch == ContactPatch::edge_along_x(0.1),
        *patch == ContactPatch::edge_along_y(0.1),
    );
    match row {
        0..6 | 18.. => true,
        6 | 7 => along_x,
        8 | 9 => along_y,
        // s = + alone, or t = + alone.
        10 | 11 | 14 | 15 if along_x => true,
        10 | 12 | 14 | 16 if along_y => true,
        _ => !(point || along_x || along_y),
    }
}

#[test]
fn points_and_edges_have_the_unknowns_that_they_have() {
    for (name, (error, rows)) in [
        ("four points", compare::<15, 4>(ContactPatch::point(), &[], 91)),
        ("two points", compare::<9, 2>(ContactPatch::point(), &[], 92)),
        ("two edges along x", compare::<13, 2>(ContactPatch::edge_along_x(0.1), &[1, 2], 93)),
        ("two edges along y", compare::<13, 2>(ContactPatch::edge_along_y(0.1), &[0, 2], 94)),
    ] {
        println!("{name}: {error:.1e} N, {rows} rows in force");
        assert!(error < 1e-5 && rows > 100, "{name}");
    }
}

/// The ground's moment about a point is none, whatever the leg carries.
#[test]
fn a_point_has_no_moment() {
    let limits = limits(ContactPatch::point());
    let mut rng = random(95);
    let carried = Wrench { force: Vector3::z() * 3.0, torque: Vector3::new(0.4, -0.3, 0.2) };
    let feet: [Option<Foot<'_>>; 4] = std::array::from_fn(|i| {
        let (x, y) = ((i / 2) as f64 - 0.5, (i % 2) as f64 - 0.5);
        Some(Foot {
            rotation: turned(symmetric(&mut rng)),
            position: Vector3::new(0.4 * x, 0.3 * y, -0.3),
            joints: [Twist::zero(); 3],
            carried,
            limits: &limits,
        })
    });
    let desired = Wrench { force: Vector3::z() * 120.0, torque: Vector3::new(3.0, -2.0, 1.0) };
    let weights = ContactWeights::standing();
    let world = Matrix3::identity();
    let program = ContactProgram::new(&feet, &weights, &world, desired).expect("feet nearby");
    for (foot, w) in feet.iter().flatten().zip(program.minimum()) {
        assert!((foot.rotation.tr_mul(&w.torque) + carried.torque).norm() < 1e-12);
    }
    let made = program.achieved(&program.minimum());
    // Four points make any wrench, but for the moment that helps: measured 3e-5 of it.
    assert!((made.force - desired.force).norm() < 1e-9);
    assert!((made.torque - desired.torque).norm() < 1e-3);
}
