//! A robot that walks: core's planner over its whole-body controller, from commands of a scene.

use super::carrying::Carrying;
use super::controller::{Commanded, ControlFailure, Controller, Scalar, measured};
use super::filter::FilterPlace;
use super::gait::GaitTally;
use super::limiting::LimitTally;
use super::supervised::{of_state, recorded, remembered};
use super::whole_body::{WholeBodyHost, padded};
use super::whole_body_settings::FEET;
use crate::plant::PlantState;
use crate::record;
use crate::robot::{LEG, Limits, MOST_LEGS, WalkerShape, with_tree};
use crate::scene::{GaitName, Scene, WalkCommand};
use nalgebra::{Vector2, Vector3};
use surefoot::Real;
use surefoot::balance::{
    Fault, ObservedMotion, Reference, RobotState, SafetyLimits, StopReason, Supervisor,
    WholeBodyCommand, WholeBodyController, WholeBodyState, observe, whole_body_motion_tick_under,
};
use surefoot::model::Tree;
use surefoot::spatial::{Quaternion, Wrench};
use surefoot::walk::{
    self, JumpOrder, LANDING_RATE, Leeway, Phase, PlaneMotion, Planner, RANGE_MARGIN,
    StandingRobot, Stature, WalkMemory,
};

/// What a target must know of a robot that walks.
pub(super) struct WalkStart {
    pub stature: Stature<f32, FEET>,
    /// Yaw of the central body, rad.
    pub heading: f32,
    /// Of the central body, m.
    pub height: f32,
}

/// Of a scene's robot.
pub(super) fn start(scene: &Scene) -> WalkStart {
    with_tree!(&scene.robot().tree, tree => {
        let walker = Walker::new::<1>(tree.to_f32(), scene, 1.0_f32, None);
        let (stature, heading) = (walker.planner.stature, walker.memory.heading);
        WalkStart { stature, heading, height: walker.height }
    })
}

/// What a robot is to do at a time.
pub(super) fn asked<T: Real>(commands: &[WalkCommand], time_s: f64) -> walk::WalkCommand<T> {
    let until = commands.partition_point(|command| command.at_s <= time_s);
    let Some(now) = until.checked_sub(1).and_then(|last| commands.get(last)) else {
        return walk::WalkCommand::stand();
    };
    walk::WalkCommand {
        walk: (!now.stands()).then(|| PlaneMotion {
            velocity: Vector2::new(T::of(now.forward_mps), T::of(now.left_mps)),
            turning_rate: T::of(now.turn_deg_per_s.to_radians()),
        }),
        runs: now.gait == GaitName::Run,
        // Commands are followed once each: more than 255 of them are numbered anew.
        jump: (now.jump_m > 0.0).then(|| JumpOrder {
            rise: T::of(now.jump_m),
            hops: now.hops,
            number: until as u8,
        }),
        lowered: T::of(now.lowered_m),
    }
}

/// When a robot is first told to walk (where it never is, to jump), and when then to stand, s.
pub(super) fn told(commands: &[WalkCommand]) -> [Option<f64>; 2] {
    let first = commands.iter().position(|command| !command.stands());
    let first = first.or_else(|| commands.iter().position(|command| !command.stand));
    let after = |first: usize| commands[first..].iter().skip(1).find(|command| command.stands());
    let at = |command: &WalkCommand| command.at_s;
    [first.map(|first| at(&commands[first])), first.and_then(after).map(at)]
}

/// What the supervisor of a robot that walks allows.
pub(super) fn walking_limits(standing: &Limits) -> Limits {
    let mut limits = standing.clone();
    limits.joints.iter_mut().for_each(|joint| joint.rate *= f64::from(LANDING_RATE));
    limits
}

/// Planner and controller in precision `T`, with a supervisor unless it is bare.
pub(super) struct WalkingHost<
    T,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const ROWS: usize,
> {
    walker: Walker<T, N, NQ, NV>,
    supervisor: Option<Supervisor<T, ROWS>>,
}

struct Walker<T, const N: usize, const NQ: usize, const NV: usize> {
    body: WholeBodyHost<T, N, NQ, NV>,
    planner: Planner<T, FEET>,
    memory: WalkMemory<T, FEET>,
    commands: Vec<WalkCommand>,
    forces: [T; FEET],
    period: T,
    /// Height of the central body at the start, for the supervisor.
    height: T,
    /// Of the lower foot at the start, and at the last tick, m.
    ground: [T; 2],
    carrying: Carrying<T>,
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize, const ROWS: usize>
    WalkingHost<T, N, NQ, NV, ROWS>
{
    /// Of a robot that stands as its scene starts.
    ///
    /// # Panics
    /// For a scene that is not checked.
    pub fn new(
        tree: Tree<T, N, NQ, NV>,
        limits: Option<SafetyLimits<T, ROWS>>,
        scene: &Scene,
    ) -> Self {
        let period = T::of(1.0 / scene.controller.rate_hz);
        let walker = Walker::new(tree, scene, period, limits.as_ref());
        let supervisor = limits.map(|limits| {
            let mut supervisor = Supervisor::new(of_state(limits, scene), period)
                .expect("limits of the robot, period of a checked scene");
            supervisor.arm();
            supervisor
        });
        Self { walker, supervisor }
    }
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Walker<T, N, NQ, NV> {
    fn new<const ROWS: usize>(
        tree: Tree<T, N, NQ, NV>,
        scene: &Scene,
        period: T,
        limits: Option<&SafetyLimits<T, ROWS>>,
    ) -> Self {
        let mut body = WholeBodyHost::new(tree, scene);
        let start = scene.start();
        let shape = WalkerShape::of(&body.robot).expect("a robot of a checked scene");
        let home = body.seen(&PlantState::home(body.robot.joint_count()));
        let feet = body.robot.feet.len();
        let legs = home.feet.iter().take(feet).map(|foot| foot.leg.norm());
        let leg_length = legs.fold(T::zero(), |sum, leg| sum + leg) / T::of(feet as f64);
        let robot = StandingRobot {
            mass: T::of(shape.robot.mass),
            gravity: T::of(shape.robot.gravity),
            leg_length,
            forward: T::of(shape.robot.forward),
            sole: shape.robot.sole.map(T::of),
            pressure_reach: shape.robot.pressure_reach.map(T::of),
        };
        let standing = body.seen(&start);
        let stature = Stature::measured(&robot, &shape.sides, &standing).expect("a robot on feet");
        // Starting values belong to the height of the centre of mass here.
        body.settings = body.settings.for_walks(stature.height, robot.gravity, feet);
        if let Some(limits) = limits {
            body.settings = body.settings.within(limits, T::of(RANGE_MARGIN.into()));
        }
        let rotation = standing.central_rotation;
        let ground = lower_foot(&stature, &standing);
        Self {
            planner: Planner::new(stature),
            memory: WalkMemory::standing(rotation.m21.atan2(rotation.m11)),
            commands: scene.walk.clone(),
            forces: [T::zero(); FEET],
            period,
            height: T::of(start.positions[2]),
            ground: [ground; 2],
            carrying: Carrying::new(robot.mass * robot.gravity, stature.height),
            body,
        }
    }

    /// What the robot is to do now.
    fn asked(&self) -> walk::WalkCommand<T> {
        asked(&self.commands, self.body.time_s)
    }

    fn command(
        &mut self,
        state: &WholeBodyState<T, NQ, NV>,
    ) -> Result<WholeBodyCommand<T, FEET, NV>, Fault> {
        let asked = self.asked();
        let Self { body, planner, memory, forces, period, ground, carrying, .. } = self;
        let WholeBodyHost { tree, model, settings, memory: rows, friction, observer, .. } = body;
        let controller = WholeBodyController { tree, robot: model, settings };
        let observed = observe(&controller, state)?;
        let mut motion = observed.motion(&controller)?;
        let external = observer.as_ref().map(|observer| {
            let stands = matches!(memory.phase, Phase::Standing);
            carrying.read(&observer.wrench(), memory.heading, stands);
            let center = &mut motion.center_of_mass;
            let d = carrying.offset(
                center.xy() - Vector2::new(state.positions[0], state.positions[1]),
                memory.heading,
            );
            (center.x, center.y) = (center.x + d.x, center.y + d.y);
            carrying.wrench(memory.heading)
        });
        // In a flight no foot tells where the ground is.
        if planner.planned(memory).contains(&true) {
            ground[1] = lower_foot(&planner.stature, &motion);
        }
        let task = planner.plan(memory, &motion, forces, &asked, *period)?;
        let mut command =
            whole_body_motion_tick_under(&controller, &observed, &task.motion, external, rows)?;
        if let Some(friction) = friction {
            let wanted = Some(&command.accelerations[6..]);
            friction.add(&mut command.torques[6..], &state.velocities[6..], wanted);
        }
        body.count(&command.limits);
        body.tally.last.capture_point = Some(task.capture_point.map(Real::to_f64).into());
        Ok(command)
    }

    /// Where the supervisor is to expect the robot: here, as high above its lower foot as at the start, or as far below
    /// as what is planned takes it.
    fn reference(&self, state: &PlantState, leeway: Leeway<T>) -> Reference<T> {
        let [x, y] = [state.positions[0], state.positions[1]].map(T::of);
        let [first, last] = self.ground;
        let height = self.height + (last - first) - leeway.sinks;
        Reference::at_rest(Vector3::new(x, y, height), Quaternion::identity())
    }

    /// Which feet the plan has on the ground.
    fn planned(&self) -> [bool; MOST_LEGS] {
        self.planner.planned(&self.memory)
    }
}

/// Height of the lower of the feet that step, m.
fn lower_foot<T: Real>(stature: &Stature<T, FEET>, seen: &ObservedMotion<T, FEET>) -> T {
    let own = stature.feet.iter().zip(&seen.feet).filter(|(foot, _)| foot.is_some());
    own.map(|(_, foot)| foot.position.z).reduce(|a, b| a.min(b)).unwrap_or(T::zero())
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> WholeBodyHost<T, N, NQ, NV> {
    /// The model's motion at a state of the robot that is one.
    fn seen(&self, state: &PlantState) -> ObservedMotion<T, FEET> {
        let Self { tree, model, settings, .. } = self;
        let controller = WholeBodyController { tree, robot: model, settings };
        let state = WholeBodyState {
            positions: padded(&state.positions),
            velocities: padded(&state.velocities),
        };
        let seen = observe(&controller, &state).and_then(|seen| seen.motion(&controller));
        seen.expect("a state of the robot")
    }
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize, const ROWS: usize> Controller
    for WalkingHost<T, N, NQ, NV, ROWS>
{
    fn filter_place(&self) -> FilterPlace {
        FilterPlace::Host(Scalar::of::<T>())
    }

    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let Self { walker, supervisor } = self;
        walker.body.look(state);
        let Some(supervisor) = supervisor else {
            let state = WholeBodyState {
                positions: padded(&state.positions),
                velocities: padded(&state.velocities),
            };
            let command = walker.command(&state).map_err(ControlFailure::Fault)?;
            walker.body.sent(&command.torques[6..]);
            return Ok(walker.body.commanded(&command.torques[6..], command.desired_wrench));
        };
        let mut in_rows = state.clone();
        in_rows.positions.resize(7 + ROWS * LEG, 0.0);
        in_rows.velocities.resize(6 + ROWS * LEG, 0.0);
        let leeway = walker.planner.leeway(&walker.memory);
        let reference = walker.reference(state, leeway);
        if leeway.leaps {
            supervisor.expect_leap();
        }
        let tick = |now: &RobotState<T, ROWS>| {
            let command = walker.command(&WholeBodyState::of_rows(now))?;
            Ok(command.in_rows())
        };
        let answer = supervisor.step_with(Some(&measured(&in_rows)), &reference, false, tick);
        self.walker.body.sent(answer.joint_torques.as_flattened());
        let wrench = answer.command.map_or_else(Wrench::zero, |command| command.desired_wrench);
        Ok(self.walker.body.commanded(answer.joint_torques.as_flattened(), wrench))
    }

    fn press(&mut self, time_s: f64, normal_forces: &[f64]) {
        self.walker.body.time_s = time_s;
        for (to, force) in self.walker.forces.iter_mut().zip(normal_forces) {
            *to = T::of(*force);
        }
        let planned = self.walker.planned();
        if let Some(observer) = &mut self.walker.body.observer {
            let pressed = normal_forces.iter().zip(planned);
            let stands: Vec<bool> = pressed.map(|(f, planned)| *f > 0.0 && planned).collect();
            observer.touch(&stands);
        }
    }

    fn support(&self) -> Option<[f64; 3]> {
        let Walker { body, memory, .. } = &self.walker;
        // While a swinging leg or a landing shakes it, the feet's force does not point up.
        let stands = matches!(memory.phase, Phase::Standing);
        body.observer.as_ref().filter(|_| stands)?.support()
    }

    fn planned(&self) -> Option<[bool; MOST_LEGS]> {
        Some(self.walker.planned())
    }

    fn gait(&self) -> Option<GaitTally> {
        let walker = &self.walker;
        Some(GaitTally { steps: walker.memory.steps, told_s: told(&walker.commands) })
    }

    fn limits(&self) -> Option<LimitTally> {
        Some(self.walker.body.tally.clone())
    }

    fn stop(&mut self, reason: StopReason) {
        if let Some(supervisor) = &mut self.supervisor {
            supervisor.stop(reason);
        }
    }

    fn stopped(&self) -> Option<StopReason> {
        self.supervisor.as_ref()?.reason()
    }

    fn memory(&self) -> Option<record::SupervisorMemory> {
        Some(recorded(self.supervisor.as_ref()?.memory()))
    }

    fn remember(&mut self, memory: &record::SupervisorMemory) -> bool {
        let Some(supervisor) = &mut self.supervisor else { return false };
        remembered(memory).is_some_and(|memory| {
            supervisor.remember(memory);
            true
        })
    }
}
