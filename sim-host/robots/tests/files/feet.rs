//! Contact points of feet, against the shapes' own geometry.

use crate::{BODY, file, robot};
use nalgebra::Vector3;
use surefoot_robots::{Options, Sole, import};

/// The points of a foot whose frame is 1 m below the base and rotated by a quarter turn about x, with this
/// collision element's content.
fn points(test: &str, collision: &str) -> Vec<Vector3<f64>> {
    let text = robot(&format!(
        r#"<link name="base">{BODY}</link>
        <link name="foot">{BODY}{collision}</link>
        <joint name="j" type="revolute"><parent link="base"/><child link="foot"/>
          <origin xyz="0 0 -1" rpy="1.5707963267948966 0 0"/></joint>"#
    ));
    let options = Options { feet: vec!["foot".into()], ..Options::default() };
    import(&file(test, &text), &options).expect("a foot").robot.feet[0].points.clone()
}

fn collision(origin: &str, shape: &str) -> String {
    format!("<collision><origin {origin}/><geometry>{shape}</geometry></collision>")
}

/// World z is the foot's y: down is −y.
fn assert_points(mut found: Vec<Vector3<f64>>, mut expected: Vec<[f64; 3]>) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    let key = |v: &Vector3<f64>| (v.map(|x| (x * 1e9).round() as i64)).data.0[0];
    found.sort_by_key(key);
    expected.sort_by_key(|v| key(&Vector3::from(*v)));
    for (a, b) in found.iter().zip(expected) {
        assert!((a - Vector3::from(b)).norm() < 1e-12, "{a} is not {b:?}");
    }
}

#[test]
fn a_box_stands_on_its_lowest_face() {
    let found = points("box.urdf", &collision("xyz='0 0.1 0'", "<box size='0.2 0.06 0.4'/>"));
    let y = 0.1 - 0.03;
    assert_points(found, vec![[0.1, y, 0.2], [-0.1, y, 0.2], [0.1, y, -0.2], [-0.1, y, -0.2]]);
}

#[test]
fn round_shapes_stand_on_their_lowest_points() {
    let found = points("sphere.urdf", &collision("xyz='0.3 0 0'", "<sphere radius='0.05'/>"));
    assert_points(found, vec![[0.3, -0.05, 0.0]]);
    // Along z, which lies: the ends of its lowest line.
    let lying = points("lying.urdf", &collision("", "<cylinder radius='0.05' length='0.2'/>"));
    assert_points(lying, vec![[0.0, -0.05, 0.1], [0.0, -0.05, -0.1]]);
    let capsule = points("capsule.urdf", &collision("", "<capsule radius='0.05' length='0.2'/>"));
    assert_points(capsule, vec![[0.0, -0.05, 0.1], [0.0, -0.05, -0.1]]);
    // Turned upright: a square in the rim of its lower end.
    let upright =
        collision("rpy='1.5707963267948966 0 0'", "<cylinder radius='0.05' length='0.2'/>");
    let r = 0.05 * std::f64::consts::FRAC_1_SQRT_2;
    let expected = vec![[r, -0.1, r], [-r, -0.1, r], [r, -0.1, -r], [-r, -0.1, -r]];
    assert_points(points("upright.urdf", &upright), expected);
}

/// What is 5 mm above the lowest point is no part of the sole.
#[test]
fn a_foot_of_several_shapes_stands_on_the_lowest() {
    let two = collision("xyz='0.1 0 0'", "<sphere radius='0.05'/>")
        + &collision("xyz='-0.1 0.01 0'", "<sphere radius='0.05'/>")
        + &collision("xyz='-0.2 0.001 0'", "<sphere radius='0.05'/>");
    assert_points(points("several.urdf", &two), vec![[0.1, -0.05, 0.0], [-0.2, -0.049, 0.0]]);
}

/// The same pyramid on its square, as STL, OBJ and DAE; the DAE in centimetres and with y up.
#[test]
fn a_mesh_stands_on_the_corners_of_its_lowest_face() {
    let (mut stl, mut obj, mut dae) = ("solid p\n".to_owned(), String::new(), String::new());
    let corners =
        [[0.1, 0.0, 0.2], [-0.1, 0.0, 0.2], [-0.1, 0.0, -0.2], [0.1, 0.0, -0.2], [0.0, 0.3, 0.0]];
    for [x, y, z] in corners {
        obj += &format!("v {x} {y} {z}\n");
        // x, y, z of the foot from the file's y-up axes: rotated by a quarter turn about x.
        dae += &format!("{} {} {} ", 100.0 * x, 100.0 * z, -100.0 * y);
    }
    for face in [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 1, 2], [0, 2, 3]] {
        stl += "facet normal 0 1 0\nouter loop\n";
        for [x, y, z] in face.map(|i: usize| corners[i]) {
            stl += &format!("vertex {x} {y} {z}\n");
        }
        stl += "endloop\nendfacet\n";
        obj += &format!("f {} {} {}\n", face[0] + 1, face[1] + 1, face[2] + 1);
    }
    stl += "endsolid p\n";
    let dae = format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema">
        <asset><unit meter="0.01"/><up_axis>Y_UP</up_axis></asset>
        <library_geometries><geometry id="g"><mesh><source id="p"><float_array>{dae}</float_array></source>
          <vertices id="v"><input semantic="POSITION" source="#p"/></vertices></mesh></geometry></library_geometries>
        <library_visual_scenes><visual_scene><node><translate>0 0 1</translate>
          <matrix>1 0 0 0 0 1 0 0 0 0 1 -1 0 0 0 1</matrix><instance_geometry url="#g"/></node></visual_scene>
        </library_visual_scenes></COLLADA>"##
    );
    for (name, text) in [("p.stl", stl), ("p.obj", obj), ("p.dae", dae)] {
        file(name, &text);
        let mesh = collision("xyz='0 0.5 0'", &format!("<mesh filename='{name}' scale='2 1 1'/>"));
        let found = points(&format!("{name}.urdf"), &mesh);
        // Meshes are in single precision.
        let rounded = found.iter().map(|v| v.map(|x| (x * 1e6).round() / 1e6)).collect();
        let expected = vec![[0.2, 0.5, 0.2], [-0.2, 0.5, 0.2], [-0.2, 0.5, -0.2], [0.2, 0.5, -0.2]];
        assert_points(rounded, expected);
    }
}

#[test]
fn a_stated_sole_replaces_shapes_and_a_foot_without_any_is_refused() {
    let bare = robot(&format!(
        r#"<link name="base">{BODY}</link><link name="foot"/>
        <joint name="j" type="fixed"><parent link="base"/><child link="foot"/><origin xyz="0 0 -1"/></joint>"#
    ));
    let path = file("bare.urdf", &bare);
    let feet = vec!["foot".to_owned()];
    let refused = import(&path, &Options { feet: feet.clone(), ..Options::default() });
    let message = refused.expect_err("no sole").to_string();
    assert!(message.contains("foot foot") && message.contains("--sole"), "{message}");
    let soles = vec![Sole { link: "foot".into(), rectangle: [-0.1, 0.2, -0.05, 0.05, -0.02] }];
    let robot = import(&path, &Options { soles, ..Options::default() }).expect("a foot").robot;
    let z = -1.02;
    let expected = vec![[-0.1, -0.05, z], [0.2, -0.05, z], [0.2, 0.05, z], [-0.1, 0.05, z]];
    assert_eq!(robot.feet[0].link, 0);
    assert_points(robot.feet[0].points.clone(), expected);
}
