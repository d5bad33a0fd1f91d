//! What is worked out of the motion of a recording when it is first asked for.

use std::sync::{Arc, OnceLock};

use super::Recording;
use crate::kernel::intervals::Plan;

/// Follows from the motion; another motion starts with none.
#[derive(Debug, Clone, Default)]
pub(super) struct Ready(OnceLock<Arc<Plan>>);

/// Recordings of one motion are equal, whatever was asked of them.
impl PartialEq for Ready {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Recording {
    /// The times between the samples, for an integrator of the hysteretic variable.
    pub(crate) fn plan(&self) -> &Arc<Plan> {
        self.ready.0.get_or_init(|| Arc::new(Plan::of(self.time(), self.displacement(), self.velocity())))
    }
}

#[cfg(test)]
mod tests {
    use crate::kernel::example;

    #[test]
    fn another_motion_has_another_plan() {
        let recording = example::recording();
        let end = |path: Vec<f64>| path[path.len() - 1];
        let way = end(recording.plan().path());
        let back = |values: &[f64]| values.iter().map(|v| -v).collect();
        let seen = recording.seen_with(back(recording.displacement()), back(recording.velocity()), None);
        assert!((end(seen.plan().path()) + way).abs() < 1e-9 * way.abs());
        assert!((end(recording.scaled(2.0).plan().path()) - 2.0 * way).abs() < 1e-9 * way.abs());
        assert_eq!(
            seen,
            recording.seen_with(back(recording.displacement()), back(recording.velocity()), None)
        );
    }
}
