//! Balls that drop into the floor: what a contact takes from a method's order, against the closed form of
//! a damped spring. Twenty heights, so that touch-down is anywhere within a step.

use super::contender::{Contender, Start};
use super::course::{Conserved, Course};
use super::measure::Span;
use super::problem::Problem;
use super::tree_contenders::AT_MIDPOINTS;
use surefoot_mechanics::integrators::{Method, Progress, StepError};
use surefoot_multibody::contact::{Floor, Switching};
use surefoot_multibody::{
    Body, Joint, JointConstraint, Link, Simulation, Site, System, SystemError,
};

/// How many.
const BALLS: u32 = 20;
/// kg
const MASS: f64 = 70.0;
/// m/s²
const GRAVITY: f64 = 9.81;
/// Of the lowest, m; 0.3 mm between neighbours.
const HEIGHT: f64 = 0.1;
const APART: f64 = 3e-4;
/// At its end all balls are in the floor, s.
const DURATION: f64 = 0.16;

fn floor() -> Floor {
    // Damped little enough to swing.
    Floor { normal_damping: 500.0, ..Floor::RUBBER }
}

fn height(ball: u32) -> f64 {
    HEIGHT + APART * f64::from(ball)
}

/// Balls that drop into the floor.
pub(super) fn touch_down() -> Problem {
    let contender = |name: String, switching: Switching| {
        let start: Start = Box::new(move |h, _| {
            let course: Box<dyn Course> = Box::new(Balls::new(switching, h)?);
            Ok(course)
        });
        Contender::stepping(name, Some(2), start)
    };
    Problem {
        name: "touch-down".to_owned(),
        description: "Twenty balls that drop into the floor of §5.3, against the closed form"
            .to_owned(),
        span: Span { duration_s: DURATION, samples: 4 },
        contenders: vec![
            contender(Method::Variational.name(), Switching::WithinTheStep),
            contender(AT_MIDPOINTS.to_owned(), Switching::AtMidpoint),
        ],
        omitted: Vec::new(),
        keeps_energy: false,
        closed_form: Some(Box::new(|span| {
            let time = |sample| span.duration_s * f64::from(sample) / f64::from(span.samples);
            (1..=span.samples)
                .map(|sample| (0..BALLS).map(|ball| exact(height(ball), time(sample))).collect())
                .collect()
        })),
        scene: None,
    }
}

/// Height of a ball's centre, which is what touches the floor, before it leaves it again.
fn exact(drop: f64, time: f64) -> f64 {
    let floor = floor();
    let (k, b, m, g) = (floor.normal_stiffness, floor.normal_damping, MASS, GRAVITY);
    let meets = (2.0 * drop / g).sqrt();
    if time <= meets {
        return drop - 0.5 * g * time * time;
    }
    let (t, decay) = (time - meets, b / (2.0 * m));
    let omega = (k / m - decay * decay).sqrt();
    // z = rest + e^{−decay t} (A cos ωt + B sin ωt), z(0) = 0, z'(0) = −g·meets
    let rest = -m * g / k;
    let (a, c) = (-rest, (-g * meets - decay * rest) / omega);
    rest + (-decay * t).exp() * (a * (omega * t).cos() + c * (omega * t).sin())
}

struct Balls {
    all: Vec<Simulation>,
    progress: Progress,
}

impl Balls {
    fn new(switching: Switching, h: f64) -> Result<Self, SystemError> {
        let ball = |number: u32| {
            let joint = Joint {
                outboard: [0.0; 3],
                inboard: [0.0; 3],
                home: [1.0, 0.0, 0.0, 0.0],
                constraint: JointConstraint::Floating,
            };
            let body = Body { mass: MASS, inertia: [1.0; 3] };
            let site = Site { link: 0, position: [0.0; 3] };
            let system = System::new(vec![Link { inboard: None, joint, body }], GRAVITY)?
                .on_floor(floor(), switching, vec![site])?;
            let start = [0.0, 0.0, height(number), 1.0, 0.0, 0.0, 0.0];
            Simulation::new(system, h, &[start], &[[0.0; 7]])
        };
        let all = (0..BALLS).map(ball).collect::<Result<_, _>>()?;
        Ok(Self { all, progress: Progress::new(h) })
    }
}

impl Course for Balls {
    fn step(&mut self) -> Result<(), StepError> {
        let mut together = Progress::new(self.progress.h);
        for ball in &mut self.all {
            ball.step()?;
            let made = ball.progress();
            together.evaluated(made.evaluations);
            together.iterations += made.iterations;
            together.most_iterations = together.most_iterations.max(made.most_iterations);
            together.split_steps += made.split_steps;
            (together.steps, together.time_s) = (made.steps, made.time_s);
        }
        self.progress = together;
        Ok(())
    }

    fn place(&mut self) -> Result<Vec<f64>, StepError> {
        Ok(self.all.iter().map(|ball| ball.state(0)[2]).collect())
    }

    fn conserved(&mut self) -> Result<Conserved, StepError> {
        Ok(Conserved { energy: 0.0, momentum: Vec::new(), constraint: 0.0 })
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}
