//! How many bodies the biped is made of.

use super::{PlantState, StepFailure};
use crate::multibody::{
    BodyState, Frame, Reduced, Side, System, SystemError, lumped, states_of_tree, system_of_tree,
};
use serde::{Deserialize, Serialize};
use surefoot::model::robots::biped::{FEET, TREE};

/// Bodies of §4.1.
const BODIES: usize = 13;

/// Links of the small bodies inside hips and ankles, and the neighbour that each is given to. A leg moves most about
/// the lateral axis: about that a hip's inner body turns with the central body, its outer one with the thigh, and
/// an ankle's with the shank. Their centres of mass lie where the joint's axes meet.
pub const SMALL_BODIES: [(usize, Side); 6] = [
    (1, Side::Inboard),
    (2, Side::Outboard),
    (5, Side::Inboard),
    (7, Side::Inboard),
    (8, Side::Outboard),
    (11, Side::Inboard),
];

/// Which bodies the biped has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum BipedModel {
    /// All 13 of §4.1, on hinges.
    #[default]
    Full,
    /// Seven, the small ones of hips and ankles being lumped into their neighbours: hips are spherical joints
    /// with motors, ankles universal ones. The same 18 velocities.
    Lumped,
}

impl BipedModel {
    /// How many bodies it has.
    pub fn bodies(self) -> usize {
        match self {
            Self::Full => BODIES,
            Self::Lumped => BODIES - SMALL_BODIES.len(),
        }
    }
}

impl std::fmt::Display for BipedModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Full => "full",
            Self::Lumped => "lumped",
        })
    }
}

/// The biped's system, and where its parts are in it.
#[derive(Clone, Debug)]
pub(super) struct BipedSystem {
    pub system: System,
    /// Joints with motors in the order of torques: link, and how many motors it has.
    pub joints: Vec<(usize, usize)>,
    /// Links of the left and the right foot, and the foot's frame in them.
    pub feet: [(usize, Frame); 2],
    /// The frame of §4.1's body 1 in link 0.
    pub central: Frame,
    reduced: Option<Reduced>,
}

impl BipedSystem {
    /// # Errors
    /// Never for §4.1's biped.
    pub fn new(model: BipedModel) -> Result<Self, SystemError> {
        let full = system_of_tree(&TREE)?;
        if model == BipedModel::Full {
            return Ok(Self {
                system: full,
                joints: (1..BODIES).map(|link| (link, 1)).collect(),
                feet: FEET.map(|foot| (foot, Frame::IDENTITY)),
                central: Frame::IDENTITY,
                reduced: None,
            });
        }
        let reduced = lumped(&full, &SMALL_BODIES)?;
        let carrier = |link: usize| {
            let what = "a body that stays";
            reduced.carrier(link).ok_or(SystemError::Unsupported { link, what })
        };
        let feet = [carrier(FEET[0])?, carrier(FEET[1])?];
        let central = carrier(0)?.1;
        let system = reduced.system.clone();
        let motors = |link: usize| 6 - system.links()[link].joint.constraints();
        let joints = (1..system.links().len()).map(|link| (link, motors(link))).collect();
        Ok(Self { system, joints, feet, central, reduced: Some(reduced) })
    }

    /// All bodies' states and rates.
    ///
    /// # Errors
    /// [`StepFailure::Dynamics`] for no configuration.
    pub fn start(
        &self,
        state: &PlantState,
    ) -> Result<(Vec<BodyState>, Vec<BodyState>), StepFailure> {
        let (states, rates) = states_of_tree(&TREE, &state.positions, &state.velocities)?;
        Ok(match &self.reduced {
            Some(reduced) => reduced.start(&states, &rates),
            None => (states, rates),
        })
    }
}
