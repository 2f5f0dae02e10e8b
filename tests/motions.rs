//! Motions of the multibody simulator that are timed, here and by peers: declared once.

use crate::workloads::{biped_positions, wave};
use nalgebra::Vector3;
use surefoot::model::robots::biped::{FEET, SoleOutline, TREE};
use surefoot_multibody::contact::{Floor, Switching};
use surefoot_multibody::{
    BodyState, Chain, ChainJoint, JointLaw, Simulation, Site, System, states_of_tree,
    system_of_tree,
};

/// A system and its start.
pub struct MotionStart {
    /// What it is called.
    pub name: String,
    /// Bodies, joints, and what acts on them.
    pub system: System,
    /// All bodies' states.
    pub states: Vec<BodyState>,
    /// Their rates.
    pub rates: Vec<BodyState>,
}

impl MotionStart {
    /// The motion with steps of `h`.
    ///
    /// # Panics
    /// Never for those declared here.
    pub fn simulation(&self, h: f64) -> Simulation {
        Simulation::new(self.system.clone(), h, &self.states, &self.rates).expect("a start")
    }
}

/// A hanging chain of rods on hinges about x and y in turn, let go bent.
pub fn hanging_chain(links: usize, length: f64, bend: f64) -> MotionStart {
    let chain = Chain {
        links,
        mass: 1.0,
        length,
        radius: 0.1 * length,
        joint: ChainJoint::Alternating,
        floats: false,
        gravity: 9.81,
    };
    MotionStart {
        name: format!("chain-{links}"),
        system: chain.system().expect("a system"),
        states: chain.bent(bend),
        rates: vec![[0.0; 7]; links],
    }
}

/// The biped under gravity, far from any floor, all joints moving.
pub fn biped_in_flight() -> MotionStart {
    let (states, rates) =
        states_of_tree(&TREE, &biped_positions(), &wave(0.4)).expect("a configuration");
    let system = system_of_tree(&TREE).expect("a system");
    MotionStart { name: "biped-flight".to_owned(), system, states, rates }
}

/// Springs and dampers that hold the standing biped's joints.
pub const HOLDING: JointLaw = JointLaw { stiffness: 3000.0, damping: 100.0, ..JointLaw::NONE };

/// The biped on both feet, eight points in contact, joints held by springs.
pub fn biped_on_feet() -> MotionStart {
    let mut positions: [f64; 19] = [0.0; 19];
    positions[2] = 1.03;
    positions[3] = 1.0;
    for leg in [7, 13] {
        positions[leg + 1] = 40.0_f64.to_radians();
        positions[leg + 3] = -77.4595_f64.to_radians();
        positions[leg + 5] = (77.4595_f64 - 40.0).to_radians();
    }
    let corners = SoleOutline::A.corners();
    let sites = FEET.into_iter().flat_map(|foot| {
        corners.map(|corner: Vector3<f64>| Site { link: foot, position: corner.into() })
    });
    let mut system = system_of_tree(&TREE)
        .expect("a system")
        .on_floor(Floor::RUBBER, Switching::default(), sites.collect())
        .expect("sites");
    for k in 1..13 {
        let law = JointLaw { rest: positions[6 + k], ..HOLDING };
        system = system.with_law(k, law).expect("a hinge");
    }
    let (states, rates) = states_of_tree(&TREE, &positions, &[0.0; 18]).expect("a configuration");
    MotionStart { name: "biped-feet".to_owned(), system, states, rates }
}
