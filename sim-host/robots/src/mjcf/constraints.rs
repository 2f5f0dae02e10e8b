//! `<equality>` and `<actuator>`: joints that follow others, loops, and what motors can give.

use super::bodies::Found;
use super::compiler::flag;
use super::defaults::Defaults;
use crate::description::DescribedMimic;
use crate::error::ImportError;
use crate::xml::Element;

/// Couplings of joints whose polynomial is linear become joints that follow; all others are listed.
pub(super) fn read(
    root: &Element,
    defaults: &Defaults,
    found: &mut Found,
) -> Result<(), ImportError> {
    for element in root.all("equality").flat_map(|all| &all.children) {
        // Classes have one element for all kinds.
        let mut of_class = element.clone();
        of_class.tag = "equality".into();
        let kind = element.tag.as_str();
        let element = &defaults.apply(&of_class, None)?;
        if flag(element, "active")? == Some(false) {
            continue;
        }
        let follower = element.attribute("joint1").and_then(|name| found.names.get(name));
        let [a, b, rest @ ..] =
            element.numbers::<5>("polycoef")?.unwrap_or([0.0, 1.0, 0.0, 0.0, 0.0]);
        match (kind, follower, element.attribute("joint2")) {
            ("joint", Some(&j), Some(leader)) if rest == [0.0; 3] => {
                found.joints[j].mimic =
                    Some(DescribedMimic { leader: leader.into(), multiplier: b, offset: a });
            }
            _ => found.constraints.push((element.place.clone(), describe(kind, element))),
        }
    }
    Ok(())
}

fn describe(kind: &str, element: &Element) -> String {
    let parts =
        ["name", "body1", "body2", "joint1", "joint2", "tendon1", "tendon2", "site1", "site2"];
    let stated =
        parts.iter().filter_map(|name| Some(format!("{name} {}", element.attribute(name)?)));
    format!("constraint <{kind}> of {}", stated.collect::<Vec<_>>().join(", "))
}

/// Efforts of joints that a `<motor>` with a range of its control drives.
pub(super) fn efforts(
    root: &Element,
    defaults: &Defaults,
    found: &mut Found,
) -> Result<(), ImportError> {
    for motor in root.all("actuator").flat_map(|all| all.all("motor")) {
        let motor = defaults.apply(motor, None)?;
        let Some(&j) = motor.attribute("joint").and_then(|name| found.names.get(name)) else {
            continue;
        };
        let gear = motor.list("gear")?.and_then(|gear| gear.first().copied()).unwrap_or(1.0);
        if let Some([lower, upper]) = motor.numbers::<2>("ctrlrange")? {
            let effort = gear.abs() * lower.abs().max(upper.abs());
            let properties = &mut found.joints[j].properties;
            properties.effort = properties.effort.or((effort > 0.0).then_some(effort));
        }
    }
    Ok(())
}
