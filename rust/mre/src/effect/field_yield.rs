//! Field dependence of a hysteretic base model itself: its state yields at a displacement that follows the current.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | r | rho at the highest current, over that at the lowest | - | 0.1 to 10 |
//!
//! Between the levels rho is affine in the current, as the coefficients of the base model are.
//! Reference: Kwok, Ha, Nguyen, Li and Samali, ISA Trans. 46 (2007) 167.
//! Known limit: only for a hysteretic base model, and where the current changes in a recording.

use super::{About, Effect, Pace, Sizes, StateChange, order_within};
use crate::parameter::Parameter;

/// Most that rho grows or falls by.
const MOST: f64 = 10.0;

/// The yield of the state follows the current.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct FieldYield;

impl Effect for FieldYield {
    fn about(&self) -> About {
        About {
            effect: "field_dependence",
            law: "yield displacement of the state",
            plain: "the displacement at which the device yields follows the current",
            equation: "rho -> rho (1 + (r - 1) u), u = (I - I_low)/(I_high - I_low)",
            reference: "Kwok and others 2007",
            limit: "only for a hysteretic base model, and where the current changes in a recording",
        }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        sizes.current_varies
    }

    fn on_a_part(&self) -> bool {
        true
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        vec![order_within("r", "", 1.0 / MOST, MOST)]
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        [0.3, 0.7, 1.4, 3.0].map(|ratio| vec![ratio]).to_vec()
    }

    fn state_change(&self, sizes: &Sizes, shape: &[f64]) -> Option<StateChange> {
        let low = sizes.current.map_or(0.0, |(low, _)| low);
        let pace = Pace { low, span: sizes.current_span(), ratio: shape[0] };
        Some(StateChange { pace: Some(pace), ..StateChange::default() })
    }
}
