//! Eq. 8 of the paper: how visual range and step shrink over the iterations.

/// The schedule of visual range and step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Schedule {
    /// AFSA: they stay.
    Constant,
    /// Eq. 8 read from the start: `visual_0 w(t) + visual_min`. The text and Figure 2 fit this.
    FromStart {
        /// Visual range that is left at the end.
        visual_min: f64,
        /// Step that is left at the end.
        step_min: f64,
        /// Exponent, 1 to 30.
        p: u32,
    },
    /// Eq. 8 read as an assignment: `visual_t w(t) + visual_min`.
    Recursive {
        /// Visual range that is left at the end.
        visual_min: f64,
        /// Step that is left at the end.
        step_min: f64,
        /// Exponent, 1 to 30.
        p: u32,
    },
}

/// The weight `exp(-20 (t / Tmax)^p)`.
pub fn inertia_weight(iteration: usize, iterations: usize, p: u32) -> f64 {
    (-20.0 * (iteration as f64 / iterations as f64).powi(p as i32)).exp()
}

impl Schedule {
    /// Visual range and step of an iteration (1, 2, ...), from the initial and the previous ones.
    pub(super) fn next(
        self,
        iteration: usize,
        iterations: usize,
        initial: (f64, f64),
        previous: (f64, f64),
    ) -> (f64, f64) {
        match self {
            Self::Constant => initial,
            Self::FromStart { visual_min, step_min, p } => {
                let w = inertia_weight(iteration, iterations, p);
                (initial.0 * w + visual_min, initial.1 * w + step_min)
            }
            Self::Recursive { visual_min, step_min, p } => {
                let w = inertia_weight(iteration, iterations, p);
                (previous.0 * w + visual_min, previous.1 * w + step_min)
            }
        }
    }
}
