//! The scenes that come with the program.

use super::{AnyScene, SceneError, parse};

/// A built-in scene: its name and its file.
#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    /// Name on the command line.
    pub name: &'static str,
    /// The TOML text.
    pub text: &'static str,
}

/// All built-in scenes.
pub const BUILT_IN: [BuiltIn; 22] = [
    BuiltIn { name: "experiment-1", text: include_str!("../../../scenes/experiment-1.toml") },
    BuiltIn {
        name: "experiment-1-pushes",
        text: include_str!("../../../scenes/experiment-1-pushes.toml"),
    },
    BuiltIn {
        name: "experiment-1-welded",
        text: include_str!("../../../scenes/experiment-1-welded.toml"),
    },
    BuiltIn { name: "experiment-2", text: include_str!("../../../scenes/experiment-2.toml") },
    BuiltIn {
        name: "experiment-2-welded",
        text: include_str!("../../../scenes/experiment-2-welded.toml"),
    },
    BuiltIn { name: "stand", text: include_str!("../../../scenes/stand.toml") },
    BuiltIn { name: "walk", text: include_str!("../../../scenes/walk.toml") },
    BuiltIn { name: "walk-pushed", text: include_str!("../../../scenes/walk-pushed.toml") },
    BuiltIn { name: "run", text: include_str!("../../../scenes/run.toml") },
    BuiltIn { name: "jump", text: include_str!("../../../scenes/jump.toml") },
    BuiltIn { name: "carry", text: include_str!("../../../scenes/carry.toml") },
    BuiltIn { name: "walk-estimated", text: include_str!("../../../scenes/walk-estimated.toml") },
    BuiltIn { name: "turn", text: include_str!("../../../scenes/turn.toml") },
    BuiltIn { name: "stand-loaded", text: include_str!("../../../scenes/stand-loaded.toml") },
    BuiltIn { name: "box-drop", text: include_str!("../../../scenes/box-drop.toml") },
    BuiltIn { name: "biped-flight", text: include_str!("../../../scenes/biped-flight.toml") },
    BuiltIn { name: "chain", text: include_str!("../../../scenes/chain.toml") },
    BuiltIn { name: "four-bar", text: include_str!("../../../scenes/four-bar.toml") },
    BuiltIn { name: "hinged-chain", text: include_str!("../../../scenes/hinged-chain.toml") },
    BuiltIn { name: "n-pendulum", text: include_str!("../../../scenes/n-pendulum.toml") },
    BuiltIn { name: "rigid-body", text: include_str!("../../../scenes/rigid-body.toml") },
    BuiltIn {
        name: "spherical-pendulum",
        text: include_str!("../../../scenes/spherical-pendulum.toml"),
    },
];

/// The built-in scenes, parsed.
///
/// # Errors
/// Never for the scenes as shipped: a test parses them all.
pub fn built_in() -> Result<Vec<AnyScene>, SceneError> {
    BUILT_IN.iter().map(|scene| parse(scene.name, scene.text)).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn all_built_in_scenes_are_valid() {
        let scenes = super::built_in().expect("valid");
        assert_eq!(scenes.len(), super::BUILT_IN.len());
    }
}
