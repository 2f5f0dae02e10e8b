//! Sine and cosine together, by one argument reduction and two polynomials.
//!
//! # Why not `libm`
//! `libm::sincosf` works in double precision inside, which a Cortex-M4F has to emulate: thousands of
//! instructions per call, and twelve calls a tick. Here all arithmetic is in the scalar itself.
//!
//! # Notation
//! - `k` nearest integer to `x / (π/2)`; `r = x − k π/2`, |r| ≤ π/4 (1)
//! - `z = r²`
//!
//! π/2 is subtracted in three parts (Cody and Waite, *Software Manual for the Elementary Functions*,
//! 1980), the leading ones with so few bits that `k` times them is exact within the stated range.
//! Polynomials on |r| ≤ π/4: f64, those of fdlibm (`k_sin.c`, `k_cos.c`, Sun Microsystems 1993);
//! f32, those of Cephes (`sinf.c`, Moshier 1992).

/// Largest |x| for which `k · PI_2_HIGH` is exact in f64: 33-bit constant, 20 bits left for `k`.
const RANGE_F64: f64 = 1.0e5;
/// Largest |x| for which the first two products are exact in f32: parts of 7 and 11 bits.
const RANGE_F32: f32 = 8.0e3;

// π/2 in three parts (fdlibm `e_rem_pio2.c`: pio2_1, pio2_2, pio2_2t).
const PI_2_HIGH: f64 = 1.570_796_326_734_125_6;
const PI_2_MIDDLE: f64 = 6.077_100_506_303_966e-11;
const PI_2_LOW: f64 = 2.022_266_248_795_950_6e-21;

// π/2 in three parts (twice Cephes' DP1, DP2, DP3, which sum to π/4).
const PI_2_HIGH_F32: f32 = 1.570_312_5;
const PI_2_MIDDLE_F32: f32 = 4.837_513e-4;
const PI_2_LOW_F32: f32 = 7.549_79e-8;

/// Adding and subtracting 1.5 · 2⁵² rounds to an integer, whose low bits stay in the sum's mantissa.
const ROUND_F64: f64 = 6_755_399_441_055_744.0;
/// The same in f32: 1.5 · 2²³.
const ROUND_F32: f32 = 12_582_912.0;

/// `(sin x, cos x)` in double precision.
#[inline]
pub(super) fn f64(x: f64) -> (f64, f64) {
    if is_near_f64(x) { near_f64(x) } else { libm::sincos(x) }
}

/// Whether `x` lies in the range of [`near_f64`].
#[inline(always)]
pub(super) fn is_near_f64(x: f64) -> bool {
    x.abs() <= RANGE_F64
}

/// The same within the range; outside, a number or NaN without meaning. No branch, so that a loop
/// over many angles takes several at once.
#[inline(always)]
pub(super) fn near_f64(x: f64) -> (f64, f64) {
    let shifted = x * core::f64::consts::FRAC_2_PI + ROUND_F64;
    let k = shifted - ROUND_F64;
    let quadrant = shifted.to_bits();
    // (1)
    let r = ((x - k * PI_2_HIGH) - k * PI_2_MIDDLE) - k * PI_2_LOW;
    let z = r * r;
    let sine = r + r
        * z
        * (-1.666_666_666_666_663_2e-1
            + z * (8.333_333_333_322_49e-3
                + z * (-1.984_126_982_985_795e-4
                    + z * (2.755_731_370_707_006_8e-6
                        + z * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10)))));
    let cosine = 1.0 - 0.5 * z
        + z * z
            * (4.166_666_666_666_66e-2
                + z * (-1.388_888_888_887_411e-3
                    + z * (2.480_158_728_947_673e-5
                        + z * (-2.755_731_435_139_066_3e-7
                            + z * (2.087_572_321_298_175e-9 + z * -1.135_964_755_778_819_5e-11)))));
    let (a, b) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    (
        f64::from_bits(a.to_bits() ^ ((quadrant & 2) << 62)),
        f64::from_bits(b.to_bits() ^ ((quadrant.wrapping_add(1) & 2) << 62)),
    )
}

/// `(sin x, cos x)` in single precision.
#[inline]
pub(super) fn f32(x: f32) -> (f32, f32) {
    if is_near_f32(x) { near_f32(x) } else { libm::sincosf(x) }
}

/// Whether `x` lies in the range of [`near_f32`].
#[inline(always)]
pub(super) fn is_near_f32(x: f32) -> bool {
    x.abs() <= RANGE_F32
}

/// The same as [`near_f64`] in single precision.
#[inline(always)]
pub(super) fn near_f32(x: f32) -> (f32, f32) {
    let shifted = x * core::f32::consts::FRAC_2_PI + ROUND_F32;
    let k = shifted - ROUND_F32;
    let quadrant = shifted.to_bits();
    // (1)
    let r = ((x - k * PI_2_HIGH_F32) - k * PI_2_MIDDLE_F32) - k * PI_2_LOW_F32;
    let z = r * r;
    let sine = r + r * z * (-1.666_665_5e-1 + z * (8.332_161e-3 + z * -1.951_529_6e-4));
    let cosine =
        1.0 - 0.5 * z + z * z * (4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5));
    let (a, b) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    (
        f32::from_bits(a.to_bits() ^ ((quadrant & 2) << 30)),
        f32::from_bits(b.to_bits() ^ ((quadrant.wrapping_add(1) & 2) << 30)),
    )
}

#[cfg(test)]
mod tests {
    /// libm as the independent reference, over the whole stated range.
    #[test]
    fn agrees_with_libm_to_one_ulp_of_one() {
        let mut x: f64 = 1.0e-9;
        while x < super::RANGE_F64 {
            for x in [x, -x] {
                let (s, c) = super::f64(x);
                assert!((s - libm::sin(x)).abs() <= 2.3e-16, "sin {x}");
                assert!((c - libm::cos(x)).abs() <= 2.3e-16, "cos {x}");
            }
            x *= 1.000_1;
        }
        let mut x: f32 = 1.0e-6;
        while x < super::RANGE_F32 {
            for x in [x, -x] {
                let (s, c) = super::f32(x);
                assert!((f64::from(s) - libm::sin(f64::from(x))).abs() <= 1.2e-7, "sin {x}");
                assert!((f64::from(c) - libm::cos(f64::from(x))).abs() <= 1.2e-7, "cos {x}");
            }
            x *= 1.000_1;
        }
    }

    #[test]
    fn beyond_its_range_it_is_libm_and_never_hangs() {
        for x in [1.0e6, -3.0e15, 1.0e300] {
            assert_eq!(super::f64(x), libm::sincos(x));
        }
        for x in [1.0e5_f32, -3.0e15, 1.0e38] {
            assert_eq!(super::f32(x), libm::sincosf(x));
        }
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(super::f64(x).0.is_nan() && super::f64(x).1.is_nan());
            assert!(super::f32(x as f32).0.is_nan() && super::f32(x as f32).1.is_nan());
        }
    }

    #[test]
    fn zero_and_signs() {
        assert_eq!(super::f64(0.0), (0.0, 1.0));
        assert_eq!(super::f32(-0.0), (0.0, 1.0));
        let (s, c) = super::f64(-core::f64::consts::FRAC_PI_2);
        assert_eq!(s, -1.0);
        assert!(c.abs() < 1e-16);
    }
}
