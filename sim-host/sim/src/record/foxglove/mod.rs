//! The record as MCAP, in the schemas that Foxglove and other viewers know. Times are simulated ones.
//!
//! | topic | schema | when |
//! |---|---|---|
//! | `/tf` | FrameTransforms: world to each body, and to the block | each frame of the replay |
//! | `/robot` | SceneUpdate: solids on the bodies' frames, the set point | once |
//! | `/forces` | SceneUpdate: arrows in the world's frame | each frame of the replay |
//! | `/joints` | JointStates: angle, rate and torque by name | each sample |
//! | `/tracking` | JSON, of a robot: errors, desired wrench, forces on the feet | each sample |
//! | `/conserved` | JSON, of a mechanism: energies, angular momentum, constraints | each sample |
//! | `/events` | Log | each event |

mod arrows;
mod messages;

use super::{Event, Record};
use crate::picture::frames;
use ::foxglove::Encode;
use ::foxglove::messages::{FrameTransforms, JointStates, Log, SceneUpdate};
use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions, Writer};
use std::collections::BTreeMap;
use std::io::{Seek, Write};

/// Why a record could not be written.
#[derive(Debug, thiserror::Error)]
pub enum RecordFailure {
    /// The file.
    #[error(transparent)]
    Mcap(#[from] McapError),
    /// A message.
    #[error("a message of {topic} cannot be encoded: {reason}")]
    Message {
        /// Its topic.
        topic: &'static str,
        /// Why.
        reason: String,
    },
}

/// Writes a run's samples and events. The same run gives the same bytes.
///
/// # Errors
/// A [`RecordFailure`].
pub fn write_mcap<W: Write + Seek>(
    record: &dyn Record,
    events: &[Event],
    to: W,
) -> Result<(), RecordFailure> {
    let (shown, times) = (record.shown(), record.times());
    let options = WriteOptions::new().compression(None).library("surefoot");
    let mut writer = Writer::with_options(to, options)?;
    let mut transforms = Topic::new::<FrameTransforms, W>(&mut writer, "/tf")?;
    let mut solids = Topic::new::<SceneUpdate, W>(&mut writer, "/robot")?;
    let mut forces = Topic::new::<SceneUpdate, W>(&mut writer, "/forces")?;
    let mut joints = Topic::new::<JointStates, W>(&mut writer, "/joints")?;
    let mut log = Topic::new::<Log, W>(&mut writer, "/events")?;
    let details = record.details();
    let schema = details.schema.to_string();
    let schema = writer.add_schema(details.schema_name, "jsonschema", schema.as_bytes())?;
    let mut detail = Topic::with(&mut writer, schema, details.topic, "json")?;

    let mut frames = frames(&times, shown.bodies.len()).into_iter().peekable();
    let mut events = events.iter().peekable();
    for (i, time) in times.iter().copied().enumerate() {
        while let Some(event) = events.next_if(|event| event.time_s <= time) {
            log.write(&mut writer, event.time_s, &messages::log(event))?;
        }
        if i == 0 {
            solids.write(&mut writer, time, &messages::solids(shown, time))?;
        }
        if frames.next_if_eq(&i).is_some() {
            // A run that diverged ends in what is no configuration: there is nothing to show of it.
            if let Ok(moment) = record.moment(i) {
                let all = messages::transforms(shown, time, &moment);
                transforms.write(&mut writer, time, &all)?;
                forces.write(&mut writer, time, &messages::forces(shown, time, &moment))?;
            }
        }
        joints.write(&mut writer, time, &messages::joints(time, &record.joints(i)))?;
        detail.append(&mut writer, time, record.detail(i).to_string().as_bytes())?;
    }
    for event in events {
        log.write(&mut writer, event.time_s, &messages::log(event))?;
    }
    writer.finish()?;
    Ok(())
}

/// A topic of the file.
struct Topic {
    name: &'static str,
    channel: u16,
    written: u32,
    bytes: Vec<u8>,
}

impl Topic {
    /// Of messages in a schema of Foxglove's.
    fn new<M: Encode, W: Write + Seek>(
        writer: &mut Writer<W>,
        name: &'static str,
    ) -> Result<Self, RecordFailure> {
        let schema = match M::get_schema() {
            Some(schema) => writer.add_schema(&schema.name, &schema.encoding, &schema.data)?,
            None => 0,
        };
        Self::with(writer, schema, name, &M::get_message_encoding())
    }

    fn with<W: Write + Seek>(
        writer: &mut Writer<W>,
        schema: u16,
        name: &'static str,
        encoding: &str,
    ) -> Result<Self, RecordFailure> {
        let channel = writer.add_channel(schema, name, encoding, &BTreeMap::new())?;
        Ok(Self { name, channel, written: 0, bytes: Vec::new() })
    }

    fn write<M: Encode, W: Write + Seek>(
        &mut self,
        writer: &mut Writer<W>,
        time_s: f64,
        message: &M,
    ) -> Result<(), RecordFailure> {
        let mut bytes = std::mem::take(&mut self.bytes);
        bytes.clear();
        message.encode(&mut bytes).map_err(|error| RecordFailure::Message {
            topic: self.name,
            reason: error.to_string(),
        })?;
        let written = self.append(writer, time_s, &bytes);
        self.bytes = bytes;
        written
    }

    fn append<W: Write + Seek>(
        &mut self,
        writer: &mut Writer<W>,
        time_s: f64,
        bytes: &[u8],
    ) -> Result<(), RecordFailure> {
        let time = nanoseconds(time_s);
        let header = MessageHeader {
            channel_id: self.channel,
            sequence: self.written,
            log_time: time,
            publish_time: time,
        };
        self.written = self.written.wrapping_add(1);
        Ok(writer.write_to_known_channel(&header, bytes)?)
    }
}

fn nanoseconds(time_s: f64) -> u64 {
    (time_s * 1e9).round() as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_loop::{Scalar, controller, run};
    use crate::record::{RobotRecord, Sample};
    use crate::scene::load;
    use ::foxglove::Decode;
    use std::io::Cursor;

    fn written() -> (Vec<u8>, Vec<Sample>, Vec<Event>) {
        let mut scene = load("experiment-1").expect("a built-in scene");
        scene.duration_s = 0.1;
        let run = run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
        let mut bytes = Cursor::new(Vec::new());
        let record = RobotRecord::new(&scene, &run.samples);
        write_mcap(&record, &run.events, &mut bytes).expect("written");
        (bytes.into_inner(), run.samples, run.events)
    }

    #[test]
    fn what_is_read_back_is_what_was_recorded() {
        let (bytes, samples, events) = written();
        let times: Vec<f64> = samples.iter().map(|sample| sample.time_s).collect();
        let frames = frames(&times, 13);
        let messages: Vec<mcap::Message<'_>> = mcap::MessageStream::new(&bytes)
            .expect("MCAP")
            .map(|message| message.expect("a message"))
            .collect();
        let of = |topic: &str| -> Vec<&mcap::Message<'_>> {
            messages.iter().filter(|message| message.channel.topic == topic).collect()
        };
        for (topic, count, schema) in [
            ("/tf", frames.len(), "foxglove.FrameTransforms"),
            ("/forces", frames.len(), "foxglove.SceneUpdate"),
            ("/robot", 1, "foxglove.SceneUpdate"),
            ("/joints", samples.len(), "foxglove.JointStates"),
            ("/tracking", samples.len(), "surefoot.Tracking"),
            ("/events", events.len(), "foxglove.Log"),
        ] {
            let all = of(topic);
            assert_eq!(all.len(), count, "{topic}");
            assert_eq!(all[0].channel.schema.as_ref().expect("a schema").name, schema);
            assert!(all.windows(2).all(|pair| pair[0].log_time <= pair[1].log_time));
        }
        let last = samples.last().expect("samples");
        for (message, sample) in [(of("/tf")[0], &samples[0]), (of("/tf")[frames.len() - 1], last)]
        {
            assert_eq!(message.log_time, nanoseconds(sample.time_s));
            let transforms = FrameTransforms::decode(&message.data[..]).expect("transforms");
            assert_eq!(transforms.transforms.len(), 13);
            let body = &transforms.transforms[0];
            assert_eq!(body.child_frame_id, "central_body");
            let at = body.translation.expect("a place");
            assert_eq!([at.x, at.y, at.z], sample.positions[..3]);
            let turn = body.rotation.expect("a direction");
            let turn = [turn.w, turn.x, turn.y, turn.z];
            for (ours, expected) in turn.iter().zip(&sample.positions[3..7]) {
                assert!((ours - expected).abs() < 1e-9);
            }
        }
        let joints =
            JointStates::decode(&of("/joints")[samples.len() - 1].data[..]).expect("joints");
        assert_eq!(joints.joints[9].name, "right knee (11)");
        assert_eq!(joints.joints[9].position, Some(last.positions[16]));
        assert_eq!(joints.joints[9].effort, Some(last.torques[9]));
        let tracking: serde_json::Value =
            serde_json::from_slice(&of("/tracking")[0].data).expect("JSON");
        assert_eq!(tracking["desired_force_n"]["z"], samples[0].desired_wrench[2]);
    }

    #[test]
    fn the_same_run_gives_the_same_bytes() {
        assert!(written().0 == written().0);
    }
}
