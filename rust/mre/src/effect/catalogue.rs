//! Every law of every effect.

use super::Effect;
use super::adiabatic::Adiabatic;
use super::asymmetric::Asymmetric;
use super::backlash::Backlash;
use super::bent_branch::BentBranch;
use super::bristles::Bristles;
use super::clipping::Clipping;
use super::coulomb::Coulomb;
use super::creep::Creep;
use super::cubic::OddElastic;
use super::degradation::{Degradation, Form, Progress};
use super::delay::TimeDelay;
use super::drift::Drift;
use super::end_stop::EndStop;
use super::field_dependence::{FieldDependence, Of};
use super::field_lag::FieldLag;
use super::field_yield::FieldYield;
use super::filter_lag::FilterLag;
use super::fractional::Fractional;
use super::hysteresis::Hysteresis;
use super::inertia::Inertia;
use super::loose_spring::LooseSpring;
use super::mains::Mains;
use super::maxwell::Maxwell;
use super::mullins::{Mullins, Softening};
use super::on_part::OnPart;
use super::own_share::OwnShare;
use super::payne::{Amplitude, Payne};
use super::pinched::Pinched;
use super::pinching::{Middle, Pinching};
use super::quadratic_damping::QuadraticDamping;
use super::recorded_temperature::{RecordedTemperature, Softer};
use super::remanence::Remanence;
use super::rig::Rig;
use super::slipping::Slipping;
use super::spread_yields::SpreadYields;
use super::stiffness_jump::StiffnessJump;
use super::stribeck::{Fall, Stribeck};
use super::thermal::Thermal;
use super::wearing::Wearing;
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
    &BentBranch::Spring,
    &BentBranch::Dashpot,
    &Fractional::Springpot,
    &Fractional::Maxwell,
    &WithCurrent {
        law: &Fractional::Springpot,
        name: "springpot, with the current",
        equation: "F_a = c_a(I) D^a x, c_a affine in I",
    },
    &Coulomb::Dahl,
    &Coulomb::DahlOf,
    &Coulomb::Slider,
    &Coulomb::Smoothed,
    &Coulomb::Rounded,
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
    &Bristles,
    &Hysteresis::BoucWen,
    &Hysteresis::Jenkins,
    &Hysteresis::Iwan,
    &Hysteresis::PowerIwan,
    &SpreadYields,
    &Hysteresis::Play,
    &Hysteresis::Plays,
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
    &TimeDelay::Motion,
    &TimeDelay::Drifting,
    &OddElastic::Cubic,
    &OddElastic::Quintic,
    &OddElastic::Sinh,
    &OddElastic::Limited,
    &OddElastic::Saturating,
    &OddElastic::Power,
    &WithCurrent {
        law: &OddElastic::Cubic,
        name: "cubic, with the current",
        equation: "F_n = k_3(I) x^3, k_3 affine in I",
    },
    &Asymmetric::Square,
    &Asymmetric::OneSided,
    &Asymmetric::Rounded,
    &Asymmetric::Fourth,
    &Asymmetric::Exponential,
    &Asymmetric::Up,
    &Asymmetric::Down,
    &WithCurrent {
        law: &Asymmetric::Square,
        name: "square, with the current",
        equation: "F_a = k_2(I) x^2, k_2 affine in I",
    },
    &QuadraticDamping::Square,
    &QuadraticDamping::Power,
    &QuadraticDamping::Eyring,
    &QuadraticDamping::Carreau,
    &QuadraticDamping::OneWay,
    &QuadraticDamping::EachWay,
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
    &OnPart::springs(&Mullins { by: Softening::PseudoElastic, whole: false }, "Ogden-Roxburgh, spring"),
    &OnPart::springs(&Mullins { by: Softening::Largest, whole: false }, "largest strain, spring"),
    &OnPart::springs(&Mullins { by: Softening::Power, whole: false }, "power of the largest strain, spring"),
    &OnPart::springs(&Mullins { by: Softening::Distance, whole: false }, "reloading, spring"),
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
    &OnPart::springs(&Thermal { by: Work::Passed, exponential: false, whole: false }, "linear, spring"),
    &OnPart::springs(&Thermal { by: Work::Passed, exponential: true, whole: false }, "exponential, spring"),
    &Adiabatic { by: Work::Passed, whole: false },
    &Adiabatic { by: Work::Passed, whole: true },
    &Adiabatic { by: Work::Net, whole: false },
    &Adiabatic { by: Work::Net, whole: true },
    &Adiabatic { by: Work::Viscous, whole: false },
    &Adiabatic { by: Work::Viscous, whole: true },
    &OnPart::springs(
        &Thermal { by: Work::Net, exponential: false, whole: false },
        "dissipated power, spring",
    ),
    &OnPart::springs(
        &Thermal { by: Work::Net, exponential: true, whole: false },
        "dissipated power, exponential, spring",
    ),
    &OnPart::springs(&Adiabatic { by: Work::Passed, whole: false }, "no cooling, spring"),
    &OnPart::springs(&Adiabatic { by: Work::Net, whole: false }, "dissipated power, no cooling, spring"),
    &OnPart::hysteretic(
        &Thermal { by: Work::Passed, exponential: true, whole: false },
        "exponential, hysteretic force",
        "k_w -> k_w exp(-s T/T_r), dT/dt = |F v| - T/tau",
    ),
    &OnPart::hysteretic(
        &Thermal { by: Work::Net, exponential: false, whole: false },
        "dissipated power, hysteretic force",
        "k_w -> k_w (1 - s T/T_r), dT/dt = F v - T/tau",
    ),
    &OnPart::hysteretic(
        &Thermal { by: Work::Net, exponential: true, whole: false },
        "dissipated power, exponential, hysteretic force",
        "k_w -> k_w exp(-s T/T_r), dT/dt = F v - T/tau",
    ),
    &OnPart::hysteretic(
        &Adiabatic { by: Work::Net, whole: false },
        "dissipated power, no cooling, hysteretic force",
        "k_w -> k_w (1 - s T/T_max), T the largest integral of F v so far",
    ),
    &OnPart::dashpot(
        &Thermal { by: Work::Passed, exponential: false, whole: false },
        "linear, damping",
        "c -> c (1 - s T/T_r), dT/dt = |F v| - T/tau",
    ),
    &OnPart::dashpot(
        &Thermal { by: Work::Passed, exponential: true, whole: false },
        "exponential, damping",
        "c -> c exp(-s T/T_r), dT/dt = |F v| - T/tau",
    ),
    &OnPart::dashpot(
        &Thermal { by: Work::Viscous, exponential: false, whole: false },
        "viscous heat, damping",
        "c -> c (1 - s T/T_r), dT/dt = v^2 - T/tau",
    ),
    &OnPart::dashpot(
        &Thermal { by: Work::Viscous, exponential: true, whole: false },
        "viscous heat, exponential, damping",
        "c -> c exp(-s T/T_r), dT/dt = v^2 - T/tau",
    ),
    &OnPart::dashpot(
        &Adiabatic { by: Work::Net, whole: false },
        "dissipated power, no cooling, damping",
        "c -> c (1 - s T/T_max), T the largest integral of F v so far",
    ),
    &OwnShare {
        law: &Thermal { by: Work::Passed, exponential: false, whole: false },
        name: "damping by a share of its own",
        equation: "k -> k (1 - s T/T_r), c -> c (1 - r s T/T_r), dT/dt = |F v| - T/tau",
    },
    &OwnShare {
        law: &Adiabatic { by: Work::Passed, whole: false },
        name: "no cooling, damping by a share of its own",
        equation: "k -> k (1 - s T/T_max), c -> c (1 - r s T/T_max), dT/dt = |F v|",
    },
    &OwnShare {
        law: &Thermal { by: Work::Net, exponential: false, whole: false },
        name: "dissipated power, damping by a share of its own",
        equation: "k -> k (1 - s T/T_r), c -> c (1 - r s T/T_r), dT/dt = F v - T/tau",
    },
    &OwnShare {
        law: &Adiabatic { by: Work::Net, whole: false },
        name: "dissipated power, no cooling, damping by a share of its own",
        equation: "k -> k (1 - s T/T_max), c -> c (1 - r s T/T_max), T the largest integral of F v so far",
    },
    &RecordedTemperature { softer: Softer::Stiffness, exponential: false },
    &RecordedTemperature { softer: Softer::Whole, exponential: false },
    &RecordedTemperature { softer: Softer::Damping, exponential: false },
    &RecordedTemperature { softer: Softer::Each, exponential: false },
    &RecordedTemperature { softer: Softer::Stiffness, exponential: true },
    &RecordedTemperature { softer: Softer::Whole, exponential: true },
    &RecordedTemperature { softer: Softer::Damping, exponential: true },
    &RecordedTemperature { softer: Softer::Each, exponential: true },
    &Degradation { by: Progress::Path, form: Form::Steady, whole: false },
    &Degradation { by: Progress::Path, form: Form::Steady, whole: true },
    &Degradation { by: Progress::Path, form: Form::Saturating, whole: false },
    &Degradation { by: Progress::Path, form: Form::Saturating, whole: true },
    &Degradation { by: Progress::Energy(Work::Passed), form: Form::Steady, whole: false },
    &Degradation { by: Progress::Energy(Work::Passed), form: Form::Steady, whole: true },
    &Degradation { by: Progress::Energy(Work::Passed), form: Form::Saturating, whole: false },
    &Degradation { by: Progress::Energy(Work::Passed), form: Form::Saturating, whole: true },
    &Degradation { by: Progress::Energy(Work::Net), form: Form::Steady, whole: false },
    &Degradation { by: Progress::Energy(Work::Net), form: Form::Steady, whole: true },
    &Degradation { by: Progress::Energy(Work::Net), form: Form::Saturating, whole: false },
    &Degradation { by: Progress::Energy(Work::Net), form: Form::Saturating, whole: true },
    &Degradation { by: Progress::Energy(Work::Viscous), form: Form::Steady, whole: false },
    &Degradation { by: Progress::Energy(Work::Viscous), form: Form::Steady, whole: true },
    &Degradation { by: Progress::Energy(Work::Viscous), form: Form::Saturating, whole: false },
    &Degradation { by: Progress::Energy(Work::Viscous), form: Form::Saturating, whole: true },
    &Degradation { by: Progress::Energy(Work::Passed), form: Form::Hyperbolic, whole: false },
    &Degradation { by: Progress::Energy(Work::Net), form: Form::Hyperbolic, whole: false },
    &Degradation { by: Progress::Strokes, form: Form::Saturating, whole: false },
    &Degradation { by: Progress::Strokes, form: Form::Hyperbolic, whole: false },
    &Degradation { by: Progress::Path, form: Form::Logarithmic, whole: false },
    &Degradation { by: Progress::Path, form: Form::Logarithmic, whole: true },
    &Degradation { by: Progress::Path, form: Form::Power, whole: false },
    &Degradation { by: Progress::Path, form: Form::Power, whole: true },
    &OnPart::springs(&Degradation { by: Progress::Path, form: Form::Steady, whole: false }, "path, spring"),
    &OnPart::springs(
        &Degradation { by: Progress::Path, form: Form::Saturating, whole: false },
        "path, saturating, spring",
    ),
    &OnPart::springs(
        &Degradation { by: Progress::Path, form: Form::Logarithmic, whole: false },
        "path, logarithmic, spring",
    ),
    &OnPart::springs(
        &Degradation { by: Progress::Path, form: Form::Power, whole: false },
        "path, power, spring",
    ),
    &OnPart::springs(
        &Degradation { by: Progress::Energy(Work::Passed), form: Form::Steady, whole: false },
        "energy, spring",
    ),
    &OnPart::springs(
        &Degradation { by: Progress::Energy(Work::Passed), form: Form::Saturating, whole: false },
        "energy, saturating, spring",
    ),
    &OnPart::springs(
        &Degradation { by: Progress::Energy(Work::Passed), form: Form::Hyperbolic, whole: false },
        "energy, hyperbolic, spring",
    ),
    &OnPart::springs(
        &Degradation { by: Progress::Strokes, form: Form::Hyperbolic, whole: false },
        "strokes, hyperbolic, spring",
    ),
    &OnPart::springs(
        &Degradation { by: Progress::Energy(Work::Net), form: Form::Steady, whole: false },
        "dissipated energy, spring",
    ),
    &OnPart::springs(
        &Degradation { by: Progress::Energy(Work::Net), form: Form::Saturating, whole: false },
        "dissipated energy, saturating, spring",
    ),
    &OnPart::hysteretic(
        &Degradation { by: Progress::Path, form: Form::Steady, whole: false },
        "path, hysteretic force",
        "k_w -> k_w (1 - s P/P_max), P the path travelled",
    ),
    &OnPart::hysteretic(
        &Degradation { by: Progress::Energy(Work::Net), form: Form::Steady, whole: false },
        "dissipated energy, hysteretic force",
        "k_w -> k_w (1 - s E/E_max), E the largest integral of F v so far",
    ),
    &OnPart::hysteretic(
        &Degradation { by: Progress::Energy(Work::Net), form: Form::Saturating, whole: false },
        "dissipated energy, saturating, hysteretic force",
        "k_w -> k_w (1 - s (1 - exp(-E/E_c))), E the largest integral of F v so far",
    ),
    &OnPart::dashpot(
        &Degradation { by: Progress::Path, form: Form::Steady, whole: false },
        "path, damping",
        "c -> c (1 - s P/P_max), P the path travelled",
    ),
    &OnPart::dashpot(
        &Degradation { by: Progress::Path, form: Form::Saturating, whole: false },
        "path, saturating, damping",
        "c -> c (1 - s (1 - exp(-P/P_c))), P the path travelled",
    ),
    &OnPart::dashpot(
        &Degradation { by: Progress::Energy(Work::Net), form: Form::Steady, whole: false },
        "dissipated energy, damping",
        "c -> c (1 - s E/E_max), E the largest integral of F v so far",
    ),
    &OwnShare {
        law: &Degradation { by: Progress::Path, form: Form::Steady, whole: false },
        name: "path, damping by a share of its own",
        equation: "k -> k (1 - s P/P_max), c -> c (1 - r s P/P_max), P the path travelled",
    },
    &OwnShare {
        law: &Degradation { by: Progress::Energy(Work::Passed), form: Form::Steady, whole: false },
        name: "energy, damping by a share of its own",
        equation: "k -> k (1 - s E/E_max), c -> c (1 - r s E/E_max), E the integral of |F v|",
    },
    &OwnShare {
        law: &Degradation { by: Progress::Energy(Work::Net), form: Form::Steady, whole: false },
        name: "dissipated energy, damping by a share of its own",
        equation: "k -> k (1 - s E/E_max), c -> c (1 - r s E/E_max), E the largest integral of F v so far",
    },
    &Wearing::Strength,
    &Wearing::Stiffness,
    &Wearing::Both,
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
    &OnPart::springs(&Payne { by: Amplitude::Forgotten, whole: false }, "Kraus, spring"),
    &OnPart::springs(&Payne { by: Amplitude::HalfCycle, whole: false }, "last half cycle, spring"),
    &OnPart::springs(&Payne { by: Amplitude::MeanSquare, whole: false }, "mean square, spring"),
    &OnPart::springs(&Payne { by: Amplitude::Structure, whole: false }, "structure, spring"),
    &StiffnessJump { whole: false, lasting: false },
    &StiffnessJump { whole: true, lasting: false },
    &StiffnessJump { whole: false, lasting: true },
    &StiffnessJump { whole: true, lasting: true },
    &OnPart::springs(&StiffnessJump { whole: false, lasting: false }, "spring"),
    &OnPart::springs(&StiffnessJump { whole: false, lasting: true }, "spring, lasting"),
    &Pinching { at: Middle::Centred, whole: false },
    &Pinching { at: Middle::Centred, whole: true },
    &Pinching { at: Middle::Shifted, whole: false },
    &Pinching { at: Middle::Shifted, whole: true },
    &Pinching { at: Middle::Edged, whole: false },
    &Pinching { at: Middle::Edged, whole: true },
    &Pinching { at: Middle::Wide, whole: false },
    &Pinching { at: Middle::Wide, whole: true },
    &OnPart::springs(&Pinching { at: Middle::Centred, whole: false }, "centred, spring"),
    &OnPart::springs(&Pinching { at: Middle::Shifted, whole: false }, "shifted, spring"),
    &OnPart::springs(&Pinching { at: Middle::Edged, whole: false }, "edged, spring"),
    &OnPart::hysteretic(
        &Pinching { at: Middle::Centred, whole: false },
        "centred, hysteretic force",
        "k_w -> k_w (1 - s exp(-(x/w)^2))",
    ),
    &OnPart::hysteretic(
        &Pinching { at: Middle::Shifted, whole: false },
        "shifted, hysteretic force",
        "k_w -> k_w (1 - s exp(-((x - x_s sgn v)/w)^2))",
    ),
    &Slipping::ByForce,
    &Slipping::ByPlace,
    &Pinched::ByForce,
    &Pinched::ByPlace,
    &Backlash::DeadZone,
    &Backlash::RoundDeadZone,
    &Backlash::FreeDeadZone,
    &Backlash::OffCentre,
    &Backlash::FreeOffCentre,
    &Backlash::Play,
    &Backlash::SpringPlay,
    &LooseSpring,
    &EndStop::Both,
    &EndStop::Positive,
    &EndStop::Negative,
    &EndStop::Hertz,
    &EndStop::HuntCrossley,
    &EndStop::Flat,
    &EndStop::Power,
    &EndStop::Uneven,
    &EndStop::UnevenHertz,
    &Rig::Spring,
    &Rig::Viscoelastic,
    &Rig::Uneven,
    &Rig::Joint,
    &Drift::Constant,
    &Drift::Linear,
    &Drift::Offset,
    &Drift::Decaying,
    &Drift::Slow,
    &Clipping::Both,
    &Clipping::Upper,
    &Clipping::Lower,
    &Clipping::Gradual,
    &Mains { harmonics: 1 },
    &Mains { harmonics: 3 },
    &FilterLag::Force,
    &FilterLag::Displacement,
    &FilterLag::Butterworth,
    &FilterLag::Two,
    &FilterLag::Third,
    &FilterLag::Fourth,
    &Creep::Logarithmic,
    &Creep::Box,
    &Creep::Slow,
    &Creep::Ageing,
    &Creep::AgeingWhole,
    &Creep::AgeingPower,
    &Creep::AgeingToAnEnd,
    &OnPart::springs(&Creep::Ageing, "ageing, spring"),
    &OnPart::springs(&Creep::AgeingPower, "ageing by a power, spring"),
    &OnPart::springs(&Creep::AgeingToAnEnd, "ageing to an end, spring"),
    &FieldLag::One,
    &FieldLag::Twice,
    &FieldLag::Ringing,
    &FieldLag::RiseAndFall,
    &FieldLag::Jumping,
    &FieldLag::JumpingRiseAndFall,
    &Remanence::Play,
    &Remanence::Largest,
    &Remanence::LargestSeen,
    &Remanence::PlaysSeen,
    &Remanence::RaisedPlaysSeen,
    &Remanence::FollowingPlaysSeen,
    &FieldDependence::Square,
    &FieldDependence::Saturating,
    &FieldDependence::Force,
    &FieldDependence::Scaled(Of::Stiffness),
    &FieldDependence::Scaled(Of::Damping),
    &FieldDependence::Scaled(Of::Whole),
    &FieldDependence::ScaledSaturating(Of::Stiffness),
    &FieldDependence::ScaledSaturating(Of::Damping),
    &FieldDependence::ScaledSaturating(Of::Whole),
    &FieldYield,
    &OnPart::springs(&FieldDependence::Scaled(Of::Stiffness), "spring scaled"),
    &OnPart::springs(&FieldDependence::ScaledSaturating(Of::Stiffness), "spring scaled, saturating"),
];

/// The law of this name of an effect.
pub fn named(effect: &str, law: &str) -> Option<&'static dyn Effect> {
    CATALOGUE.iter().copied().find(|known| known.about().effect == effect && known.about().law == law)
}
