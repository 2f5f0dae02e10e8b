//! The observer of disturbances in the loop: what a controller is told beside its state.

use super::at_rest::nominal;
use super::friction::Friction;
use super::whole_body_settings::FEET;
use crate::plant::PlantState;
use crate::robot::Contacts;
use crate::scene::{Disturbance, Scene};
use nalgebra::Vector3;
use surefoot::Real;
use surefoot::balance::{Reference, WholeBody, WholeBodyState};
use surefoot::disturbance::{DisturbanceObserver, DisturbanceSettings};
use surefoot::model::Tree;
use surefoot::spatial::Wrench;

/// What is remembered beside state, torques and residual.
const NUMBERS: usize = 6 + 1 + 6 + 10;

/// An observer of a robot of any size.
pub(super) trait Observe<T> {
    /// Another tick's state. A state that is none leaves all as it was.
    fn look(&mut self, state: &PlantState);

    /// Which feet touch the ground at the next tick.
    fn touch(&mut self, feet: &[bool]);

    /// The torques of the robot's joints that are sent until the next tick, N·m.
    fn sent(&mut self, torques: &[T]);

    /// The wrench from outside on the central body, world axes.
    fn wrench(&self) -> Wrench<T>;

    /// The set point, moved so that the robot stands over its feet.
    fn reference(&self, wanted: &Reference<T>) -> Reference<T>;

    /// Sum of the ground's forces on the feet in the central body's axes, N, while all of them stand and have settled.
    fn support(&self) -> Option<[f64; 3]>;

    /// All that it remembers.
    fn memory(&self) -> Vec<f64>;

    /// Goes on with it; `false` if it is of another robot.
    fn resume(&mut self, memory: &[f64]) -> bool;
}

/// Of a scene whose controller observes disturbances.
///
/// # Panics
/// For a scene that is not checked.
pub(super) fn observer<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: Tree<T, N, NQ, NV>,
    scene: &Scene,
) -> Option<Box<dyn Observe<T>>> {
    (scene.controller.disturbance == Disturbance::Observed)
        .then(|| Box::new(Observing::new(tree, scene)) as Box<dyn Observe<T>>)
}

struct Observing<T, const N: usize, const NQ: usize, const NV: usize> {
    tree: Tree<T, N, NQ, NV>,
    model: WholeBody<T, FEET, NV>,
    observer: DisturbanceObserver<T, N, NQ, NV>,
    contacts: [bool; FEET],
    torques: [T; NV],
    friction: Option<Friction<T>>,
    state: Option<WholeBodyState<T, NQ, NV>>,
    support: Option<Vector3<T>>,
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Observing<T, N, NQ, NV> {
    fn new(tree: Tree<T, N, NQ, NV>, scene: &Scene) -> Self {
        let robot = scene.robot();
        let contacts = Contacts::of(&robot).expect("a robot with feet on legs");
        let feet = contacts.feet.map(|foot| foot.map(|foot| foot.rounded()));
        let model = WholeBody::new(&tree, &feet).expect("a robot with feet on legs");
        let (nominal, height) = nominal(scene);
        let gravity = robot.tree.gravity().norm();
        let settings = DisturbanceSettings::scaled(
            T::of(robot.tree.mass()),
            T::of(gravity),
            T::of(height),
            T::of(1.0 / scene.controller.rate_hz),
            nominal.map(T::of),
        );
        let settings = settings.expect("a robot with mass above its feet");
        Self {
            observer: DisturbanceObserver::new(settings).expect("starting values, a checked rate"),
            tree,
            model,
            contacts: [true; FEET],
            torques: [T::zero(); NV],
            friction: Friction::of(scene),
            state: None,
            support: None,
        }
    }
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Observe<T>
    for Observing<T, N, NQ, NV>
{
    fn look(&mut self, state: &PlantState) {
        let of = |numbers: &[f64], i: usize| T::of(numbers.get(i).copied().unwrap_or(0.0));
        let state = WholeBodyState {
            positions: std::array::from_fn(|i| of(&state.positions, i)),
            velocities: std::array::from_fn(|i| of(&state.velocities, i)),
        };
        let Self { tree, model, observer, contacts, torques, .. } = self;
        let seen = observer.update(tree, model, &state, torques, contacts);
        self.state = seen.is_ok().then_some(state);
        let stands = contacts.iter().all(|touches| *touches) && observer.has_settled();
        self.support = seen.ok().flatten().filter(|_| stands).map(|seen| seen.support);
    }

    fn touch(&mut self, feet: &[bool]) {
        for (to, touches) in self.contacts.iter_mut().zip(feet) {
            *to = *touches;
        }
    }

    fn sent(&mut self, torques: &[T]) {
        self.torques[6..].iter_mut().zip(torques).for_each(|(to, torque)| *to = *torque);
        if let (Some(friction), Some(state)) = (&self.friction, &self.state) {
            friction.take(&mut self.torques[6..], &state.velocities[6..]);
        }
    }

    fn wrench(&self) -> Wrench<T> {
        self.observer.wrench.wrench
    }

    fn reference(&self, wanted: &Reference<T>) -> Reference<T> {
        let Some(state) = &self.state else { return *wanted };
        let seen = Vector3::from_fn(|i, _| state.positions[i]);
        let position = self.observer.balance.reference(seen, wanted.position);
        Reference { position, ..*wanted }
    }

    fn support(&self) -> Option<[f64; 3]> {
        self.support.map(|force| force.map(Real::to_f64).into())
    }

    fn memory(&self) -> Vec<f64> {
        let Some(state) = &self.state else { return Vec::new() };
        let DisturbanceObserver { residual, wrench, balance, since, .. } = &self.observer;
        let is_some = |there: bool| T::of(f64::from(u8::from(there)));
        let rest = wrench.at_rest.unwrap_or(Wrench::zero()).to_array();
        let mut all = Vec::new();
        for part in [&state.positions[..], &state.velocities, &self.torques, residual.r()] {
            all.extend(part.iter().map(|x| x.to_f64()));
        }
        for part in [
            &wrench.wrench.to_array()[..],
            &[is_some(wrench.at_rest.is_some())],
            &rest,
            &[wrench.awake, is_some(balance.from_feet.is_some())],
            &balance.from_feet.unwrap_or([T::zero(); 2]),
            &balance.offset,
            balance.feet.as_slice(),
            &[*since],
        ] {
            all.extend(part.iter().map(|x| x.to_f64()));
        }
        all
    }

    fn resume(&mut self, memory: &[f64]) -> bool {
        let mut numbers = memory.iter().map(|x| T::of(*x));
        let mut take = || numbers.next();
        let mut read = || -> Option<()> {
            let mut state =
                WholeBodyState { positions: [T::zero(); NQ], velocities: [T::zero(); NV] };
            let mut r = [T::zero(); NV];
            let mut torques = r;
            for part in [&mut state.positions[..], &mut state.velocities, &mut torques, &mut r] {
                for x in part {
                    *x = take()?;
                }
            }
            let mut rest = [T::zero(); NUMBERS];
            for x in &mut rest {
                *x = take()?;
            }
            let (wrench, rest) = rest.split_first_chunk::<6>()?;
            let (rests, rest) = rest.split_first()?;
            let (at_rest, rest) = rest.split_first_chunk::<6>()?;
            let [awake, stands, x, y, dx, dy, fx, fy, fz, since] = *rest.first_chunk::<10>()?;
            let observer = &mut self.observer;
            observer.residual.restore(&self.tree, &state, &r);
            observer.wrench.wrench = Wrench::from_array(*wrench);
            observer.wrench.at_rest = (*rests != T::zero()).then(|| Wrench::from_array(*at_rest));
            observer.wrench.awake = awake;
            observer.balance.from_feet = (stands != T::zero()).then_some([x, y]);
            observer.balance.offset = [dx, dy];
            observer.balance.feet = Vector3::new(fx, fy, fz);
            observer.since = since;
            self.torques = torques;
            self.state = Some(state);
            Some(())
        };
        read().is_some()
    }
}
