//! What the force of a device takes from its own motion.

/// What gives way in series with a device, to first order: `t du/dt + u = f F`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Flexibility {
    /// What it takes from the motion for each newton in the end, mm/N. Zero: the effect only follows from the force.
    pub size: f64,
    /// Retardation time, s; zero where it gives way at once.
    pub retardation: f64,
}

impl Flexibility {
    /// True where it takes anything from the motion.
    pub(crate) fn gives_way(self) -> bool {
        self.size > 0.0
    }

    /// Nearly that of two in series.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let size = self.size + other.size;
        let slow = self.size * self.retardation + other.size * other.retardation;
        Self { size, retardation: if size > 0.0 { slow / size } else { 0.0 } }
    }
}
