//! MJCF: defaults, units, frames, includes, inertias of geoms, against closed forms.

use crate::{file, read};
use std::f64::consts::{FRAC_PI_2, PI};
use surefoot_robots::{Imported, RobotMotion};

fn model(test: &str, content: &str) -> Imported {
    let text = format!("<mujoco model=\"m\">\n{content}\n</mujoco>");
    read(test, &text).unwrap_or_else(|error| panic!("{error}"))
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-14 * (1.0 + b.abs()), "{a} is not {b}");
}

/// Classes inherit, an element's own attribute wins, `childclass` goes down, and ranges are in degrees.
#[test]
fn defaults_and_units() {
    let robot = model(
        "defaults.xml",
        r#"<default><joint damping="1" armature="0.5"/><geom density="500"/>
             <default class="leg"><joint damping="2" axis="1 0 0" range="-90 45"/>
               <default class="foot"><joint damping="3"/></default></default></default>
           <worldbody><body name="a"><joint name="main"/><geom size="0.1"/>
             <body name="b" childclass="leg"><joint name="leg"/><geom size="0.1" density="1000"/>
               <body name="c"><joint name="foot" class="foot" range="0 10" damping="4"/><geom size="0.1"/>
               </body></body></body></worldbody>"#,
    )
    .robot;
    let joint = |k: usize| &robot.links[k].joint;
    assert_eq!((joint(0).motion, joint(0).properties.damping), (RobotMotion::Continuous, 1.0));
    assert_eq!((joint(0).axis.z, joint(0).properties.armature), (1.0, 0.5));
    assert_eq!((joint(1).axis.x, joint(1).properties.damping), (1.0, 2.0));
    assert_eq!((joint(1).motion, joint(1).properties.armature), (RobotMotion::Revolute, 0.5));
    let [lower, upper] = joint(1).properties.range.expect("limits");
    near(lower, -FRAC_PI_2);
    near(upper, 0.5 * FRAC_PI_2);
    assert_eq!(joint(2).properties.damping, 4.0);
    let ball = 4.0 / 3.0 * PI * 1e-3;
    near(robot.links[0].inertial.mass, 500.0 * ball);
    near(robot.links[1].inertial.mass, 1000.0 * ball);
}

/// Mass and inertia of every shape, of density 1000 kg/m³; the shapes' half sizes are 0.1, 0.2, 0.3 m.
#[test]
fn inertias_of_geoms() {
    let (a, b, c) = (0.1_f64, 0.2_f64, 0.3_f64);
    let capsule_ball = 4.0 / 3.0 * PI * a.powi(3);
    let capsule_rod = 2.0 * PI * a * a * b;
    let cases = [
        ("sphere", "0.1", capsule_ball, [0.4 * a * a; 3]),
        (
            "box",
            "0.1 0.2 0.3",
            8.0 * a * b * c,
            [(b * b + c * c) / 3.0, (a * a + c * c) / 3.0, (a * a + b * b) / 3.0],
        ),
        (
            "ellipsoid",
            "0.1 0.2 0.3",
            4.0 / 3.0 * PI * a * b * c,
            [(b * b + c * c) / 5.0, (a * a + c * c) / 5.0, (a * a + b * b) / 5.0],
        ),
        (
            "cylinder",
            "0.1 0.2",
            capsule_rod,
            [a * a / 4.0 + b * b / 3.0, a * a / 4.0 + b * b / 3.0, a * a / 2.0],
        ),
    ];
    for (kind, size, volume, moments) in cases {
        let text = format!(
            r#"<worldbody><body><freejoint/><geom type="{kind}" size="{size}" pos="1 2 3"/></body></worldbody>"#
        );
        let body = model(&format!("{kind}.xml"), &text).robot.links[0].inertial;
        near(body.mass, 1000.0 * volume);
        assert_eq!(body.center, nalgebra::Vector3::new(1.0, 2.0, 3.0));
        for i in 0..3 {
            near(body.inertia[(i, i)], body.mass * moments[i]);
        }
    }
    // A capsule across, by its ends: the integral over slices, numerically.
    let text = r#"<worldbody><body><freejoint/><geom type="capsule" size="0.1" fromto="0 0.2 0 0 -0.2 0"/></body></worldbody>"#;
    let body = model("capsule.xml", text).robot.links[0].inertial;
    near(body.mass, 1000.0 * (capsule_ball + capsule_rod));
    let slices = 200_000;
    let h = 2.0 * (a + b) / f64::from(slices);
    let (mut along, mut across) = (0.0, 0.0);
    for i in 0..slices {
        let z = (f64::from(i) + 0.5) * h - (a + b);
        let beyond = (z.abs() - b).max(0.0);
        let r2 = a * a - beyond * beyond;
        let mass = 1000.0 * PI * r2 * h;
        along += 0.5 * mass * r2;
        across += mass * (0.25 * r2 + z * z);
    }
    assert!((body.inertia.m22 / along - 1.0).abs() < 1e-9, "{} {along}", body.inertia.m22);
    assert!((body.inertia.m11 / across - 1.0).abs() < 1e-9, "{} {across}", body.inertia.m11);
}

/// Five ways to write the same rotation: a quarter turn about x.
#[test]
fn orientations() {
    let s = 0.5_f64.sqrt();
    let quat = format!(r#"quat="{s} {s} 0 0""#);
    let ways = [
        quat.as_str(),
        r#"axisangle="1 0 0 90""#,
        r#"euler="90 0 0""#,
        r#"xyaxes="2 0 0 0.5 0 1""#,
        r#"zaxis="0 -1 0""#,
    ];
    for (i, way) in ways.iter().enumerate() {
        let text = format!(
            r#"<worldbody><frame euler="0 0 0"><body {way}><freejoint/><geom size="1"/>
            <body name="tip" pos="0 1 0"/></body></frame></worldbody>"#
        );
        let robot = model(&format!("orientation-{i}.xml"), &text).robot;
        let z = robot.links[0].joint.origin.rotation * nalgebra::Vector3::z();
        assert!((z + nalgebra::Vector3::y()).norm() < 1e-15, "{way}: {z}");
    }
    // Two quarter turns, about axes that move along (small letters) or fixed ones: where an axis goes.
    let [x, y, z] = [nalgebra::Vector3::x(), nalgebra::Vector3::y(), nalgebra::Vector3::z()];
    for (sequence, from, to) in [
        // About x, y goes to z; about the y that has moved there, it stays.
        ("xyz", y, z),
        // About x, y goes to z; about the world's y, on to x.
        ("XYZ", y, x),
        // About z, x goes to y; about the y that has moved to −x, to −z.
        ("zyx", x, -z),
    ] {
        let text = format!(
            r#"<compiler angle="radian" eulerseq="{sequence}"/><worldbody>
            <body euler="{FRAC_PI_2} {FRAC_PI_2} 0"><freejoint/><geom size="1"/></body></worldbody>"#
        );
        let robot = model(&format!("euler-{sequence}.xml"), &text).robot;
        let found = robot.links[0].joint.origin.rotation * from;
        assert!((found - to).norm() < 1e-15, "{sequence}: {found}");
    }
}

/// Several joints of a body are a chain; the coordinate is 0 where the file's is, whatever `ref` is.
#[test]
fn chains_frames_and_references() {
    let robot = model(
        "chain.xml",
        r#"<option gravity="0 0 -1.62"/>
           <worldbody><frame pos="0 0 1"><body name="b" pos="1 0 0"><joint name="x" type="slide" axis="1 0 0" ref="0.25"/>
             <joint name="turn" axis="0 0 2" pos="0 1 0" ref="90"/><inertial pos="0 0 0.1" mass="2" fullinertia="2 2.5 3 0.1 0.2 0.3"/>
             </body></frame></worldbody>"#,
    )
    .robot;
    assert_eq!(robot.gravity, [0.0, 0.0, -1.62]);
    let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    assert_eq!(names, ["b/x", "b"]);
    // At coordinates 0.25 and 90° the body is where the file has it.
    let at = robot.links[0].joint.pose_at(0.25) * robot.links[1].joint.pose_at(FRAC_PI_2);
    let expected = nalgebra::Isometry3::translation(1.0, 0.0, 1.0);
    assert!((at.to_homogeneous() - expected.to_homogeneous()).norm() < 1e-15, "{at}");
    let inertia = robot.links[1].inertial.inertia;
    assert_eq!((inertia.m12, inertia.m13, inertia.m23), (0.1, 0.2, 0.3));
}

#[test]
fn includes_couplings_and_efforts() {
    file(
        "part.xml",
        r#"<mujocoinclude><body name="b"><joint name="j2"/><geom size="0.1"/></body></mujocoinclude>"#,
    );
    let imported = model(
        "whole.xml",
        r#"<worldbody><body name="a"><joint name="j1"/><geom size="0.1"/><include file="part.xml"/></body></worldbody>
           <equality><joint joint1="j2" joint2="j1" polycoef="0.1 2 0 0 0"/></equality>
           <actuator><motor joint="j1" gear="-5" ctrlrange="-1 2"/></actuator>
           <sensor><jointpos joint="j1"/></sensor>"#,
    );
    let robot = imported.robot;
    assert_eq!(robot.links.len(), 2);
    assert_eq!(robot.links[0].joint.properties.effort, Some(10.0));
    let coupling = robot.links[1].joint.follows.expect("a coupling");
    assert_eq!((coupling.leader, coupling.multiplier, coupling.offset), (0, 2.0, 0.1));
    assert!(imported.unread.contains_key("mujoco/sensor"), "{:?}", imported.unread);
}
