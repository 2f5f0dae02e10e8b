//! Where the controller runs, and in which precision.

use clap::Args;
use serde::Serialize;
use std::path::PathBuf;
use surefoot_sim::closed_loop::firmware::{
    Emulator, LinkError, SerialPort, firmware_controller, image_for,
};
use surefoot_sim::closed_loop::{self, Controller, Scalar};
use surefoot_sim::scene::{Disturbance, Scene};

/// Options of `run` about the controller.
#[derive(Debug, Args)]
pub struct ControllerOptions {
    /// Precision of the controller on the host (default: f64); the target's is f32
    #[arg(long, value_enum)]
    scalar: Option<Scalar>,
    /// Where the controller runs
    #[arg(long = "controller", value_enum, default_value = "host")]
    pub place: Place,
    /// With `--controller firmware`: the image to run in the emulator, instead of the one built for the scene's robot
    #[arg(long, value_name = "ELF", conflicts_with = "port")]
    firmware: Option<PathBuf>,
    /// With `--controller firmware`: the serial port of a board, in place of the emulator
    #[arg(long)]
    port: Option<String>,
}

/// Where the controller runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// In this process, under its supervisor.
    Host,
    /// In this process, without a supervisor.
    Bare,
    /// On the target: in the emulator, or on a board.
    Firmware,
}

impl ControllerOptions {
    /// Whether anything differs from what is assumed.
    pub fn was_chosen(&self) -> bool {
        self.place != Place::Host
            || self.scalar.is_some()
            || self.firmware.is_some()
            || self.port.is_some()
    }

    /// The precision in effect.
    pub fn scalar(&self) -> Scalar {
        match self.place {
            Place::Host | Place::Bare => self.scalar.unwrap_or(Scalar::F64),
            Place::Firmware => Scalar::F32,
        }
    }

    /// Refuses options that the controller in effect would ignore.
    pub fn check(&self) -> Result<(), String> {
        let idle = match self.place {
            Place::Host | Place::Bare if self.port.is_some() => Some("--port"),
            Place::Host | Place::Bare if self.firmware.is_some() => Some("--firmware"),
            _ => None,
        };
        if let Some(option) = idle {
            return Err(format!("{option}: only with --controller firmware"));
        }
        if self.place == Place::Firmware && self.scalar == Some(Scalar::F64) {
            return Err("--scalar f64: the target's controller is in f32".to_owned());
        }
        Ok(())
    }

    /// Refuses a scene whose controller does what the one in effect cannot.
    pub fn serves(&self, scene: &Scene) -> Result<(), String> {
        let settings = &scene.controller;
        let wanted = match self.place {
            Place::Host | Place::Bare => None,
            Place::Firmware if settings.disturbance == Disturbance::Observed => {
                Some("observes disturbances (`controller.disturbance`)")
            }
            Place::Firmware if settings.friction_share > 0.0 => {
                Some("makes up for friction (`controller.friction_share`)")
            }
            Place::Firmware => None,
        };
        wanted.map_or(Ok(()), |what| {
            Err(format!(
                "--controller firmware: {}'s controller {what}, the target's does not",
                scene.name
            ))
        })
    }

    /// A controller for a scene, ready for its first tick.
    pub fn controller(&self, scene: &Scene) -> Result<Box<dyn Controller>, LinkError> {
        match self.place {
            Place::Host => return Ok(closed_loop::controller(scene, self.scalar())),
            Place::Bare => return Ok(closed_loop::bare_controller(scene, self.scalar())),
            Place::Firmware => {}
        }
        if let Some(port) = &self.port {
            return firmware_controller(SerialPort::open(port)?, scene);
        }
        let image = match &self.firmware {
            Some(image) => image.clone(),
            None => image_for(scene)?,
        };
        firmware_controller(Emulator::start(&image, &std::env::temp_dir())?, scene)
    }
}
