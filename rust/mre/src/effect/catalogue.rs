//! Every law of every effect.

use super::Effect;
use super::adiabatic::Adiabatic;
use super::asymmetric::Asymmetric;
use super::backlash::Backlash;
use super::clipping::Clipping;
use super::coulomb::Coulomb;
use super::creep::Creep;
use super::cubic::OddElastic;
use super::degradation::{Degradation, Progress};
use super::delay::TimeDelay;
use super::drift::Drift;
use super::end_stop::EndStop;
use super::field_dependence::{FieldDependence, Of};
use super::field_lag::FieldLag;
use super::filter_lag::FilterLag;
use super::fractional::Fractional;
use super::hysteresis::Hysteresis;
use super::inertia::Inertia;
use super::mains::Mains;
use super::maxwell::Maxwell;
use super::mullins::{Mullins, Softening};
use super::on_spring::OnSpring;
use super::payne::{Amplitude, Payne};
use super::pinched::Pinched;
use super::pinching::Pinching;
use super::quadratic_damping::QuadraticDamping;
use super::remanence::Remanence;
use super::rig::Rig;
use super::stiffness_jump::StiffnessJump;
use super::stribeck::{Fall, Stribeck};
use super::thermal::Thermal;
use super::with_current::WithCurrent;
use super::work::Work;

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
    &TimeDelay::Continued,
    &TimeDelay::Held,
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
    &Mullins { by: Softening::Distance, whole: false },
    &Mullins { by: Softening::Distance, whole: true },
    &OnSpring {
        law: &Mullins { by: Softening::PseudoElastic, whole: false },
        name: "Ogden-Roxburgh, spring",
    },
    &OnSpring { law: &Mullins { by: Softening::Largest, whole: false }, name: "largest strain, spring" },
    &OnSpring {
        law: &Mullins { by: Softening::Power, whole: false },
        name: "power of the largest strain, spring",
    },
    &OnSpring { law: &Mullins { by: Softening::Distance, whole: false }, name: "reloading, spring" },
    &Thermal { by: Work::Passed, exponential: false, whole: false },
    &Thermal { by: Work::Passed, exponential: false, whole: true },
    &Thermal { by: Work::Passed, exponential: true, whole: false },
    &Thermal { by: Work::Passed, exponential: true, whole: true },
    &Thermal { by: Work::Net, exponential: false, whole: false },
    &Thermal { by: Work::Net, exponential: false, whole: true },
    &Thermal { by: Work::Net, exponential: true, whole: false },
    &Thermal { by: Work::Net, exponential: true, whole: true },
    &Thermal { by: Work::Viscous, exponential: false, whole: false },
    &Thermal { by: Work::Viscous, exponential: false, whole: true },
    &OnSpring {
        law: &Thermal { by: Work::Passed, exponential: false, whole: false },
        name: "linear, spring",
    },
    &OnSpring {
        law: &Thermal { by: Work::Passed, exponential: true, whole: false },
        name: "exponential, spring",
    },
    &Adiabatic { by: Work::Passed, whole: false },
    &Adiabatic { by: Work::Passed, whole: true },
    &Adiabatic { by: Work::Net, whole: false },
    &Adiabatic { by: Work::Net, whole: true },
    &Adiabatic { by: Work::Viscous, whole: false },
    &Adiabatic { by: Work::Viscous, whole: true },
    &OnSpring {
        law: &Thermal { by: Work::Net, exponential: false, whole: false },
        name: "dissipated power, spring",
    },
    &OnSpring {
        law: &Thermal { by: Work::Net, exponential: true, whole: false },
        name: "dissipated power, exponential, spring",
    },
    &OnSpring { law: &Adiabatic { by: Work::Passed, whole: false }, name: "no cooling, spring" },
    &OnSpring {
        law: &Adiabatic { by: Work::Net, whole: false },
        name: "dissipated power, no cooling, spring",
    },
    &Degradation { by: Progress::Path, saturates: false, whole: false },
    &Degradation { by: Progress::Path, saturates: false, whole: true },
    &Degradation { by: Progress::Path, saturates: true, whole: false },
    &Degradation { by: Progress::Path, saturates: true, whole: true },
    &Degradation { by: Progress::Energy(Work::Passed), saturates: false, whole: false },
    &Degradation { by: Progress::Energy(Work::Passed), saturates: false, whole: true },
    &Degradation { by: Progress::Energy(Work::Passed), saturates: true, whole: false },
    &Degradation { by: Progress::Energy(Work::Passed), saturates: true, whole: true },
    &Degradation { by: Progress::Energy(Work::Net), saturates: false, whole: false },
    &Degradation { by: Progress::Energy(Work::Net), saturates: false, whole: true },
    &Degradation { by: Progress::Energy(Work::Net), saturates: true, whole: false },
    &Degradation { by: Progress::Energy(Work::Net), saturates: true, whole: true },
    &Degradation { by: Progress::Energy(Work::Viscous), saturates: false, whole: false },
    &Degradation { by: Progress::Energy(Work::Viscous), saturates: false, whole: true },
    &Degradation { by: Progress::Energy(Work::Viscous), saturates: true, whole: false },
    &Degradation { by: Progress::Energy(Work::Viscous), saturates: true, whole: true },
    &OnSpring {
        law: &Degradation { by: Progress::Path, saturates: false, whole: false },
        name: "path, spring",
    },
    &OnSpring {
        law: &Degradation { by: Progress::Path, saturates: true, whole: false },
        name: "path, saturating, spring",
    },
    &OnSpring {
        law: &Degradation { by: Progress::Energy(Work::Passed), saturates: false, whole: false },
        name: "energy, spring",
    },
    &OnSpring {
        law: &Degradation { by: Progress::Energy(Work::Passed), saturates: true, whole: false },
        name: "energy, saturating, spring",
    },
    &OnSpring {
        law: &Degradation { by: Progress::Energy(Work::Net), saturates: false, whole: false },
        name: "dissipated energy, spring",
    },
    &OnSpring {
        law: &Degradation { by: Progress::Energy(Work::Net), saturates: true, whole: false },
        name: "dissipated energy, saturating, spring",
    },
    &Payne { by: Amplitude::Forgotten, whole: false },
    &Payne { by: Amplitude::Forgotten, whole: true },
    &Payne { by: Amplitude::HalfCycle, whole: false },
    &Payne { by: Amplitude::HalfCycle, whole: true },
    &Payne { by: Amplitude::MeanSquare, whole: false },
    &Payne { by: Amplitude::MeanSquare, whole: true },
    &Payne { by: Amplitude::Recording, whole: false },
    &Payne { by: Amplitude::Recording, whole: true },
    &Payne { by: Amplitude::Structure, whole: false },
    &Payne { by: Amplitude::Structure, whole: true },
    &OnSpring { law: &Payne { by: Amplitude::Forgotten, whole: false }, name: "Kraus, spring" },
    &OnSpring { law: &Payne { by: Amplitude::HalfCycle, whole: false }, name: "last half cycle, spring" },
    &OnSpring { law: &Payne { by: Amplitude::MeanSquare, whole: false }, name: "mean square, spring" },
    &OnSpring { law: &Payne { by: Amplitude::Structure, whole: false }, name: "structure, spring" },
    &StiffnessJump { whole: false, lasting: false },
    &StiffnessJump { whole: true, lasting: false },
    &StiffnessJump { whole: false, lasting: true },
    &StiffnessJump { whole: true, lasting: true },
    &OnSpring { law: &StiffnessJump { whole: false, lasting: false }, name: "spring" },
    &OnSpring { law: &StiffnessJump { whole: false, lasting: true }, name: "spring, lasting" },
    &Pinching { shifted: false, whole: false },
    &Pinching { shifted: false, whole: true },
    &Pinching { shifted: true, whole: false },
    &Pinching { shifted: true, whole: true },
    &OnSpring { law: &Pinching { shifted: false, whole: false }, name: "centred, spring" },
    &OnSpring { law: &Pinching { shifted: true, whole: false }, name: "shifted, spring" },
    &Pinched,
    &Backlash::DeadZone,
    &Backlash::FreeDeadZone,
    &Backlash::Play,
    &EndStop::Both,
    &EndStop::Positive,
    &EndStop::Negative,
    &EndStop::Hertz,
    &Rig::Spring,
    &Rig::Viscoelastic,
    &Rig::Joint,
    &Drift::Constant,
    &Drift::Linear,
    &Drift::Offset,
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
    &OnSpring { law: &Creep::Ageing, name: "ageing, spring" },
    &FieldLag::One,
    &FieldLag::Twice,
    &FieldLag::Ringing,
    &FieldLag::RiseAndFall,
    &Remanence::Play,
    &Remanence::Largest,
    &Remanence::LargestSeen,
    &Remanence::PlaysSeen,
    &Remanence::RaisedPlaysSeen,
    &Remanence::FollowingPlaysSeen,
    &FieldDependence::Square,
    &FieldDependence::Saturating,
    &FieldDependence::Scaled(Of::Stiffness),
    &FieldDependence::Scaled(Of::Damping),
    &FieldDependence::Scaled(Of::Whole),
    &FieldDependence::ScaledSaturating(Of::Stiffness),
    &FieldDependence::ScaledSaturating(Of::Damping),
    &FieldDependence::ScaledSaturating(Of::Whole),
    &OnSpring { law: &FieldDependence::Scaled(Of::Stiffness), name: "spring scaled" },
    &OnSpring { law: &FieldDependence::ScaledSaturating(Of::Stiffness), name: "spring scaled, saturating" },
];

/// The law of this name of an effect.
pub fn named(effect: &str, law: &str) -> Option<&'static dyn Effect> {
    CATALOGUE.iter().copied().find(|known| known.about().effect == effect && known.about().law == law)
}
