//! Foot-wrench programs: those of the vectors, and random ones.

use crate::vectors::{array, matrix, parse};
use nalgebra::{Matrix3, Vector3};
use rand::RngExt;
use rand_pcg::Pcg64;
use serde_json::Value;
use surefoot::Real;
use surefoot::balance::{ContactFoot, ContactLimits, ContactPatch, ContactProgram, ContactWeights};
use surefoot::qp::{ActiveRows, Fault, Settings, Solution, solve};
use surefoot::spatial::{Twist, Wrench};

/// Joints of a leg in these problems.
pub const JOINTS: usize = 6;

/// A foot and its leg's Jacobian, which own their limits.
#[derive(Clone, Copy, Debug)]
pub struct Foot<T> {
    /// Frame 1 from sole axes.
    pub rotation: Matrix3<T>,
    /// Reference point, frame 1, m.
    pub position: Vector3<T>,
    /// Its twist per rate of each joint.
    pub joints: [Twist<T>; JOINTS],
    /// Least and greatest x and y of the sole, from the reference point, m.
    pub sole: [[T; 2]; 2],
    /// Its height over that point, m.
    pub height: T,
    /// `c`, sole axes.
    pub carried: Wrench<T>,
    /// What can be given.
    pub limits: ContactLimits<T, JOINTS>,
}

/// A program with all that it refers to.
#[derive(Clone, Copy, Debug)]
pub struct Problem<T, const FEET: usize> {
    /// The feet, all in contact.
    pub feet: [Foot<T>; FEET],
    /// World axes from frame 1.
    pub world: Matrix3<T>,
    /// Desired wrench, frame 1.
    pub desired: Wrench<T>,
    /// How the split is measured.
    pub weights: ContactWeights<T>,
}

impl<T: Real, const FEET: usize> Problem<T, FEET> {
    /// As the program takes them.
    pub fn contacts(&self) -> [Option<ContactFoot<'_, T, JOINTS>>; FEET] {
        self.feet.each_ref().map(|foot| {
            Some(ContactFoot {
                rotation: foot.rotation,
                position: foot.position,
                joints: foot.joints,
                carried: foot.carried,
                limits: &foot.limits,
            })
        })
    }

    /// The program over these contacts.
    pub fn program<'a>(
        &'a self,
        contacts: &'a [Option<ContactFoot<'a, T, JOINTS>>; FEET],
    ) -> ContactProgram<'a, T, FEET, JOINTS> {
        ContactProgram::new(contacts, &self.weights, &self.world, self.desired)
            .expect("feet nearby")
    }

    /// Solves it.
    #[inline(never)]
    pub fn solve<const K: usize>(
        &self,
        active: &mut ActiveRows<T, K>,
        settings: &Settings<T>,
    ) -> Result<Solution<T, [Wrench<T>; FEET]>, Fault> {
        let contacts = self.contacts();
        let program = ContactProgram::new(&contacts, &self.weights, &self.world, self.desired);
        solve(&program.ok_or(Fault::NotFinite)?, active, settings)
    }

    /// Wrenches in frame 1's axes turned into sole axes, one after the other.
    pub fn in_sole_axes(&self, wrenches: &[Wrench<T>; FEET]) -> Vec<f64> {
        let each = self.feet.iter().zip(wrenches);
        each.flat_map(|(foot, w)| {
            let turn = |v| foot.rotation.tr_mul(v);
            Wrench { force: turn(&w.force), torque: turn(&w.torque) }.to_array()
        })
        .map(T::to_f64)
        .collect()
    }

    /// `Σ G w`, frame 1.
    pub fn achieved(&self, wrenches: &[Wrench<T>; FEET]) -> Vec<f64> {
        let sum = self
            .feet
            .iter()
            .zip(wrenches)
            .fold(Wrench::zero(), |sum, (foot, w)| sum + w.shifted(foot.position));
        sum.to_array().map(T::to_f64).to_vec()
    }
}

impl<const FEET: usize> Problem<f32, FEET> {
    /// The same numbers in double precision: what an answer in single precision is compared with.
    pub fn to_f64(&self) -> Problem<f64, FEET> {
        let vector = |v: Vector3<f32>| v.map(f64::from);
        let wrench = |w: Wrench<f32>| Wrench { force: vector(w.force), torque: vector(w.torque) };
        Problem {
            feet: self.feet.map(|foot| Foot {
                rotation: foot.rotation.map(f64::from),
                position: vector(foot.position),
                joints: foot
                    .joints
                    .map(|j| Twist { linear: vector(j.linear), angular: vector(j.angular) }),
                sole: foot.sole.map(|range| range.map(f64::from)),
                height: foot.height.into(),
                carried: wrench(foot.carried),
                limits: foot.limits.to_f64(),
            }),
            world: self.world.map(f64::from),
            desired: wrench(self.desired),
            weights: ContactWeights {
                task: self.weights.task.map(f64::from),
                regularization: f64::from(self.weights.regularization),
                norm_length: f64::from(self.weights.norm_length),
            },
        }
    }
}

impl<const FEET: usize> Problem<f64, FEET> {
    /// Every number rounded to the nearest.
    pub fn to_f32(&self) -> Problem<f32, FEET> {
        let vector = |v: Vector3<f64>| v.map(|x| x as f32);
        let wrench = |w: Wrench<f64>| Wrench { force: vector(w.force), torque: vector(w.torque) };
        Problem {
            feet: self.feet.map(|foot| Foot {
                rotation: foot.rotation.map(|x| x as f32),
                position: vector(foot.position),
                joints: foot
                    .joints
                    .map(|j| Twist { linear: vector(j.linear), angular: vector(j.angular) }),
                sole: foot.sole.map(|range| range.map(|x| x as f32)),
                height: foot.height as f32,
                carried: wrench(foot.carried),
                limits: foot.limits.to_f32(),
            }),
            world: self.world.map(|x| x as f32),
            desired: wrench(self.desired),
            weights: ContactWeights {
                task: self.weights.task.map(|x| x as f32),
                regularization: self.weights.regularization as f32,
                norm_length: self.weights.norm_length as f32,
            },
        }
    }
}

/// Cases of the vectors with `FEET` feet, with their answers.
pub fn cases<const FEET: usize>() -> Vec<(Problem<f64, FEET>, Value)> {
    let text = include_str!("vectors/wrench_qp_vectors.json");
    let Value::Array(cases) = parse(text)["cases"].take() else { panic!("cases") };
    let with_feet = cases.into_iter().filter(|case| case["feet"].as_array().unwrap().len() == FEET);
    with_feet.map(|case| (problem(&case), case)).collect()
}

fn vector(value: &Value) -> Vector3<f64> {
    array::<3>(value).into()
}

fn rotation(value: &Value) -> Matrix3<f64> {
    let [a, b, c] = matrix::<3, 3>(value);
    Matrix3::from_rows(&[a.into(), b.into(), c.into()].map(|row: Vector3<f64>| row.transpose()))
}

/// A revolute joint's column: at `origin` about `axis`, the point being at `p`.
fn revolute(axis: Vector3<f64>, origin: Vector3<f64>, p: Vector3<f64>) -> Twist<f64> {
    Twist { linear: axis.cross(&(p - origin)), angular: axis }
}

fn problem<const FEET: usize>(case: &Value) -> Problem<f64, FEET> {
    let feet = case["feet"].as_array().unwrap().iter().map(|foot| {
        let (limits, position) = (&foot["limits"], vector(&foot["p"]));
        let axes = matrix::<JOINTS, 3>(&foot["axes"]);
        let origins = matrix::<JOINTS, 3>(&foot["origins"]);
        let sole = [array(&limits["sole_x"]), array(&limits["sole_y"])];
        let height = limits["sole_z"].as_f64().unwrap();
        Foot {
            rotation: rotation(&foot["R"]),
            position,
            joints: std::array::from_fn(|k| revolute(axes[k].into(), origins[k].into(), position)),
            sole,
            height,
            carried: Wrench::from_array(array(&foot["c"])),
            limits: ContactLimits {
                least_force: limits["force_min"].as_f64().unwrap(),
                greatest_force: limits["force_max"].as_f64().unwrap(),
                friction: limits["friction"].as_f64().unwrap(),
                patch: ContactPatch::sole(sole[0], sole[1], height),
                torques: array(&limits["torque"]),
            },
        }
    });
    let feet: Vec<_> = feet.collect();
    Problem {
        feet: feet.try_into().unwrap_or_else(|_| panic!("{FEET} feet")),
        world: rotation(&case["R01"]),
        desired: Wrench::from_array(array(&case["F_d"])),
        weights: ContactWeights {
            task: array(&case["task_weights"]),
            regularization: case["regularization"].as_f64().unwrap(),
            norm_length: case["norm_length"].as_f64().unwrap(),
        },
    }
}

fn random_vector(random: &mut Pcg64, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.random_range(-size..size))
}

fn random_rotation(random: &mut Pcg64, angle: f64) -> Matrix3<f64> {
    let axis = nalgebra::Unit::new_normalize(random_vector(random, 1.0));
    nalgebra::Rotation3::from_axis_angle(&axis, random.random_range(-angle..angle)).into_inner()
}

/// The same some time later: another wrench is desired, by at most these forces (N) and moments (N·m).
pub fn later<const FEET: usize>(
    problem: &Problem<f64, FEET>,
    random: &mut Pcg64,
    [force, moment]: [f64; 2],
) -> Problem<f64, FEET> {
    let change =
        Wrench { force: random_vector(random, force), torque: random_vector(random, moment) };
    Problem { desired: problem.desired + change, ..*problem }
}

/// A harsh random program: a robot of about 75 kg asked for anything, on soles of any size, with legs
/// like the biped's in any posture (straight ones too), weak or strong.
pub fn random_problem<const FEET: usize>(random: &mut Pcg64) -> Problem<f64, FEET> {
    let count = FEET as f64;
    let strength = 10_f64.powf(random.random_range(-0.5..0.5));
    let friction = random.random_range(0.05..0.9);
    let feet = std::array::from_fn(|i| {
        let side = if i % 2 == 0 { -1.0 } else { 1.0 };
        let ahead = if FEET > 2 { 0.3 * (i / 2) as f64 - 0.15 } else { 0.0 };
        let hip = Vector3::new(ahead, 0.15 * side, -0.27);
        leg(random, hip, friction, strength, count)
    });
    let weight = Vector3::new(0.0, 0.0, 700.0);
    let world = random_rotation(random, 0.3);
    let force =
        weight + random_vector(random, 250.0) + Vector3::z() * random.random_range(-200.0..500.0);
    Problem {
        feet,
        world,
        desired: Wrench { force: world.tr_mul(&force), torque: random_vector(random, 80.0) },
        weights: ContactWeights {
            regularization: *pick(random, &[0.01, 0.01, 0.001, 0.1]),
            norm_length: *pick(random, &[0.1, 1.0]),
            ..ContactWeights::standing()
        },
    }
}

fn pick<'a, X>(random: &mut Pcg64, of: &'a [X]) -> &'a X {
    &of[random.random_range(0..of.len())]
}

/// Hip yaw, roll, pitch; knee; ankle pitch, roll.
fn leg(
    random: &mut Pcg64,
    hip: Vector3<f64>,
    friction: f64,
    strength: f64,
    feet: f64,
) -> Foot<f64> {
    let knee: f64 = *pick(random, &[1.3, 0.9, 0.5, 0.1, 0.02]) * random.random_range(0.7..1.3);
    let pitch = 0.5 * knee + random.random_range(-0.3..0.3);
    let angles = [
        random.random_range(-0.2..0.2),
        random.random_range(-0.2..0.2),
        pitch,
        -knee,
        knee - pitch + random.random_range(-0.2..0.2),
        random.random_range(-0.2..0.2),
    ];
    let turn = [Vector3::z(), Vector3::x(), Vector3::y(), Vector3::y(), Vector3::y(), Vector3::x()];
    let offset = |k: usize| match k {
        3 => Vector3::new(0.0, 0.0, -0.4),
        4 => Vector3::new(0.0, 0.0, -0.42),
        _ => Vector3::zeros(),
    };
    let (mut r, mut q) = (Matrix3::identity(), hip);
    let (mut axes, mut origins) = ([Vector3::zeros(); JOINTS], [Vector3::zeros(); JOINTS]);
    for k in 0..JOINTS {
        q += r * offset(k);
        axes[k] = r * turn[k];
        origins[k] = q;
        let unit = nalgebra::Unit::new_unchecked(turn[k]);
        r *= nalgebra::Rotation3::from_axis_angle(&unit, angles[k]).into_inner();
    }
    let position = q + r * Vector3::new(-0.02, 0.0, -0.03);
    let least_force = *pick(random, &[0.0, 20.0, 20.0, 60.0]);
    let half = [random.random_range(0.02..0.14), random.random_range(0.015..0.07)];
    let middle = [random.random_range(-0.04..0.04), random.random_range(-0.01..0.01)];
    let range = |k: usize| [middle[k] - half[k], middle[k] + half[k]];
    let (sole, height) = ([range(0), range(1)], -0.0347);
    Foot {
        rotation: r,
        position,
        joints: std::array::from_fn(|k| revolute(axes[k], origins[k], position)),
        sole,
        height,
        carried: Wrench {
            force: Vector3::new(0.0, 0.0, 72.0) + random_vector(random, 40.0),
            torque: random_vector(random, 6.0),
        },
        limits: ContactLimits {
            least_force,
            greatest_force: least_force + random.random_range(100.0..1200.0) * 2.0 / feet.max(2.0),
            friction,
            patch: ContactPatch::sole(sole[0], sole[1], height),
            torques: [100.0, 150.0, 150.0, 200.0, 150.0, 100.0].map(|x| x * strength),
        },
    }
}
