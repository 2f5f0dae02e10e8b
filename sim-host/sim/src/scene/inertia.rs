//! Which principal inertias a body can have: each at most the others' sum, as each is a sum of two second moments.

/// By how much the largest may exceed the others' sum, over itself, to count as a flat body whose numbers were rounded.
/// A file of three digits has each inertia right to half a unit of the third: at most 0.5 % of it, and the three of a
/// plate are together twice the largest.
const ROUNDING: f64 = 1e-2;
/// What is left of an exact equality in binary numbers.
const ROUND_OFF: f64 = 1e-14;

/// What is expected of a body's mass and inertias.
pub(super) const POSITIVE: &str = "a mass and three inertias above zero";

/// By how much the largest exceeds the others' sum, over itself; not positive for what a body can have.
fn excess([a, b, c]: &[f64; 3]) -> f64 {
    let largest = a.max(*b).max(*c);
    (2.0 * largest - (a + b + c)) / largest
}

/// What is wrong with principal inertias, if anything is.
pub(super) fn impossible(inertia: &[f64; 3]) -> Option<String> {
    if !inertia.iter().all(|i| i.is_finite() && *i > 0.0) {
        return Some(POSITIVE.to_owned());
    }
    let excess = excess(inertia);
    (excess > ROUNDING).then(|| {
        format!(
            "three inertias above zero, none above the others' sum (the largest is by {:.1} % of itself, and {:.0} % \
             count as rounding)",
            100.0 * excess,
            100.0 * ROUNDING
        )
    })
}

/// What was done about inertias that are only nearly those of a body.
pub(super) fn rounded(field: &str, inertia: &[f64; 3]) -> Option<String> {
    let excess = excess(inertia);
    (excess > ROUND_OFF).then(|| {
        format!(
            "{field}: the largest exceeds the others' sum by {excess:.0e} of itself; taken as it is, for a flat body \
             whose numbers were rounded"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Plates of every thickness, rounded to three digits and more, are taken; what is off by more is not.
    #[test]
    fn rounded_plates_are_possible() {
        for digits in 3..=16_usize {
            for k in 1..200 {
                let a: f64 = 0.011 * f64::from(k);
                let b = 1.7 - 0.5 * a;
                let rounded = [a, b, a + b].map(|i| {
                    let text = format!("{:.*e}", digits - 1, i);
                    text.parse::<f64>().expect("a number")
                });
                assert_eq!(impossible(&rounded), None, "{rounded:?}");
            }
        }
        assert_eq!(impossible(&[0.1, 0.7, 0.8]), None);
        assert_eq!(rounded("here", &[0.1, 0.7, 0.8]), None);
        assert!(rounded("here", &[0.1, 0.7, 0.801]).is_some_and(|text| text.contains("1e-3")));
        for bad in [[1.0, 2.0, 3.1], [0.0023, 0.0027, 1.676], [1.0, 1.0, 0.0], [f64::NAN, 1.0, 1.0]]
        {
            assert!(impossible(&bad).is_some(), "{bad:?}");
        }
    }
}
