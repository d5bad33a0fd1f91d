//! Quantiles of Student's t distribution.

/// Steps of Simpson's rule.
const STEPS: usize = 800;
/// The density is nothing beyond, in units of the standard normal.
const FARTHEST: f64 = 12.0;

/// The t that a variable with so many degrees of freedom (at least 1, need not be whole) exceeds in
/// absolute value with probability `1 - level`.
///
/// With `t = sqrt(dof) tan(a)` the density of the angle is proportional to `cos(a)^(dof - 1)`, which is
/// integrated up to the share `level` of its whole.
pub(super) fn two_sided(level: f64, degrees_of_freedom: f64) -> f64 {
    let dof = degrees_of_freedom.max(1.0);
    let last = (FARTHEST / dof.sqrt()).min(std::f64::consts::FRAC_PI_2);
    let h = last / STEPS as f64;
    let density = |angle: f64| angle.cos().max(0.0).powf(dof - 1.0);
    let cell = |i: usize| {
        let a = i as f64 * h;
        h / 6.0 * (density(a) + 4.0 * density(a + 0.5 * h) + density(a + h))
    };
    let wanted = level * (0..STEPS).map(cell).sum::<f64>();
    let mut below = 0.0;
    for i in 0..STEPS {
        let next = below + cell(i);
        if next >= wanted {
            let start = i as f64 * h;
            let share = (wanted - below) / (next - below);
            // The density is a line within the cell.
            let (d0, d1) = (density(start), density(start + h));
            let slope = (d1 - d0) / (d0 + d1);
            let within = 2.0 * share / (1.0 - slope + ((1.0 - slope).powi(2) + 4.0 * slope * share).sqrt());
            return dof.sqrt() * (start + within * h).tan();
        }
        below = next;
    }
    dof.sqrt() * last.tan()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_quantiles() {
        let table = [
            (0.95, 1.0, 12.7062),
            (0.95, 2.0, 4.302_65),
            (0.95, 5.0, 2.570_58),
            (0.95, 26.0, 2.055_53),
            (0.95, 1000.0, 1.962_34),
            (0.95, 1e7, 1.959_96),
            (0.99, 5.0, 4.032_14),
            (0.5, 10.0, 0.699_81),
        ];
        for (level, dof, t) in table {
            let found = two_sided(level, dof);
            assert!((found / t - 1.0).abs() < 2e-5, "{level} {dof}: {found}, not {t}");
        }
    }
}
