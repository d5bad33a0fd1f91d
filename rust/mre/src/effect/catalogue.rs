//! Every law of every effect.

use super::Effect;
use super::asymmetric::Asymmetric;
use super::backlash::Backlash;
use super::clipping::Clipping;
use super::coulomb::Coulomb;
use super::creep::Creep;
use super::cubic::OddElastic;
use super::degradation::Degradation;
use super::delay::TimeDelay;
use super::drift::Drift;
use super::end_stop::EndStop;
use super::field_dependence::FieldDependence;
use super::field_lag::FieldLag;
use super::filter_lag::FilterLag;
use super::fractional::Fractional;
use super::hysteresis::Hysteresis;
use super::inertia::Inertia;
use super::mains::Mains;
use super::maxwell::Maxwell;
use super::mullins::{Mullins, Softening};
use super::payne::{Amplitude, Payne};
use super::pinching::Pinching;
use super::quadratic_damping::QuadraticDamping;
use super::remanence::Remanence;
use super::rig::Rig;
use super::stiffness_jump::StiffnessJump;
use super::stribeck::{Fall, Stribeck};
use super::thermal::Thermal;
use super::with_current::WithCurrent;

/// The catalogue: the laws of an effect stand together, its plainest law first.
pub const CATALOGUE: &[&dyn Effect] = &[
    &Maxwell::One,
    &Maxwell::Two,
    &WithCurrent {
        law: &Maxwell::One,
        name: "one branch, with the current",
        equation: "dF_m/dt = k_m(I) v - F_m/tau, k_m affine in I",
    },
    &Fractional::Springpot,
    &Fractional::Maxwell,
    &Coulomb::Dahl,
    &Coulomb::Smoothed,
    &WithCurrent {
        law: &Coulomb::Dahl,
        name: "Dahl, with the current",
        equation: "F_f = F_c(I) z, dz/dt = v (1 - z sgn v)/z_y, F_c affine in I",
    },
    &Stribeck { fall: Fall::Gaussian, rests: false },
    &Stribeck { fall: Fall::Gaussian, rests: true },
    &Stribeck { fall: Fall::Exponential, rests: false },
    &Stribeck { fall: Fall::Exponential, rests: true },
    &Stribeck { fall: Fall::Hyperbolic, rests: false },
    &Stribeck { fall: Fall::Hyperbolic, rests: true },
    &Hysteresis::BoucWen,
    &Hysteresis::Jenkins,
    &Hysteresis::Iwan,
    &Hysteresis::PowerIwan,
    &WithCurrent {
        law: &Hysteresis::BoucWen,
        name: "Bouc-Wen, with the current",
        equation: "F_h = k_w(I) w, dw/dt = rho (v - sigma |v| |w|^(n-1) w + (sigma - 1) v |w|^n), k_w affine in I",
    },
    &WithCurrent {
        law: &Hysteresis::PowerIwan,
        name: "Iwan, power distribution of yields, with the current",
        equation: "F_h = k_h(I) mean of p(r) over yields with the share (r/r_max)^q below r, k_h affine in I",
    },
    &Inertia,
    &TimeDelay,
    &OddElastic::Cubic,
    &OddElastic::Quintic,
    &OddElastic::Sinh,
    &OddElastic::Limited,
    &OddElastic::Saturating,
    &Asymmetric::Square,
    &Asymmetric::OneSided,
    &Asymmetric::Fourth,
    &QuadraticDamping::Square,
    &QuadraticDamping::Power,
    &QuadraticDamping::Eyring,
    &WithCurrent {
        law: &QuadraticDamping::Eyring,
        name: "Eyring, with the current",
        equation: "F_d = F_e(I) asinh(v/v_e), F_e affine in I",
    },
    &Mullins { by: Softening::PseudoElastic, whole: false },
    &Mullins { by: Softening::PseudoElastic, whole: true },
    &Mullins { by: Softening::Largest, whole: false },
    &Mullins { by: Softening::Largest, whole: true },
    &Mullins { by: Softening::Power, whole: false },
    &Mullins { by: Softening::Power, whole: true },
    &Degradation { by_energy: false, saturates: false, whole: false },
    &Degradation { by_energy: false, saturates: false, whole: true },
    &Degradation { by_energy: false, saturates: true, whole: false },
    &Degradation { by_energy: false, saturates: true, whole: true },
    &Degradation { by_energy: true, saturates: false, whole: false },
    &Degradation { by_energy: true, saturates: false, whole: true },
    &Degradation { by_energy: true, saturates: true, whole: false },
    &Degradation { by_energy: true, saturates: true, whole: true },
    &Thermal { viscous: false, exponential: false, whole: false },
    &Thermal { viscous: false, exponential: false, whole: true },
    &Thermal { viscous: false, exponential: true, whole: false },
    &Thermal { viscous: false, exponential: true, whole: true },
    &Thermal { viscous: true, exponential: false, whole: false },
    &Thermal { viscous: true, exponential: false, whole: true },
    &Payne { by: Amplitude::Forgotten, whole: false },
    &Payne { by: Amplitude::Forgotten, whole: true },
    &Payne { by: Amplitude::HalfCycle, whole: false },
    &Payne { by: Amplitude::HalfCycle, whole: true },
    &Payne { by: Amplitude::Structure, whole: false },
    &Payne { by: Amplitude::Structure, whole: true },
    &StiffnessJump { whole: false, lasting: false },
    &StiffnessJump { whole: true, lasting: false },
    &StiffnessJump { whole: false, lasting: true },
    &StiffnessJump { whole: true, lasting: true },
    &Pinching { shifted: false, whole: false },
    &Pinching { shifted: false, whole: true },
    &Pinching { shifted: true, whole: false },
    &Pinching { shifted: true, whole: true },
    &Backlash::DeadZone,
    &Backlash::FreeDeadZone,
    &Backlash::Play,
    &EndStop::Both,
    &EndStop::Positive,
    &EndStop::Negative,
    &EndStop::Hertz,
    &Rig::Spring,
    &Rig::Viscoelastic,
    &Drift::Linear,
    &Drift::Decaying,
    &Drift::Slow,
    &Clipping::Both,
    &Clipping::Upper,
    &Clipping::Lower,
    &Mains { harmonics: 1 },
    &Mains { harmonics: 3 },
    &FilterLag::Force,
    &FilterLag::Displacement,
    &FilterLag::Butterworth,
    &Creep::Logarithmic,
    &Creep::Slow,
    &Creep::Ageing,
    &Creep::AgeingWhole,
    &FieldLag::One,
    &FieldLag::RiseAndFall,
    &Remanence::Play,
    &Remanence::Largest,
    &FieldDependence::Square,
    &FieldDependence::Saturating,
    &FieldDependence::Scaled { whole: false },
    &FieldDependence::Scaled { whole: true },
];

/// The law of this name of an effect.
pub fn named(effect: &str, law: &str) -> Option<&'static dyn Effect> {
    CATALOGUE.iter().copied().find(|known| known.about().effect == effect && known.about().law == law)
}
