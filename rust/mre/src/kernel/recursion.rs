//! First-order recursions in place, four steps at a time: one step alone waits for the one before it.

/// `y[i] = a y[i-1] + x[i]` in the place of `x`, from `y[-1]`.
pub(crate) fn forward(a: f64, before: f64, x: &mut [f64]) {
    let mut y = before;
    let mut fours = x.chunks_exact_mut(4);
    for four in &mut fours {
        let next = steps(a, y, [four[0], four[1], four[2], four[3]]);
        four.copy_from_slice(&next);
        y = next[3];
    }
    for x in fours.into_remainder() {
        y = a * y + *x;
        *x = y;
    }
}

/// `y[i] = a y[i+1] + x[i]` in the place of `x`, from the `y` behind the last.
pub(crate) fn backward(a: f64, behind: f64, x: &mut [f64]) {
    let mut y = behind;
    let mut fours = x.rchunks_exact_mut(4);
    for four in &mut fours {
        let [last, third, second, first] = steps(a, y, [four[3], four[2], four[1], four[0]]);
        four.copy_from_slice(&[first, second, third, last]);
        y = first;
    }
    for x in fours.into_remainder().iter_mut().rev() {
        y = a * y + *x;
        *x = y;
    }
}

/// Four steps, each from `y`: only the last product is waited for.
#[inline(always)]
fn steps(a: f64, y: f64, x: [f64; 4]) -> [f64; 4] {
    let (a2, a3) = (a * a, a * a * a);
    let one = x[1] + a * x[0];
    let two = x[2] + a * one;
    let three = (x[3] + a * x[2]) + a2 * one;
    [x[0] + a * y, one + a2 * y, two + a3 * y, three + a2 * a2 * y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_steps_at_a_time_are_as_many_single_ones() {
        for n in 0..23_u32 {
            let x: Vec<f64> = (0..n).map(|i| f64::from(i * i % 7) - 2.0).collect();
            for a in [-0.27, 0.4, 0.999] {
                let one_by_one = |y: &mut f64, x: &f64| {
                    *y = a * *y + x;
                    Some(*y)
                };
                let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13 * 50.0);
                let mut found = x.clone();
                forward(a, 3.0, &mut found);
                let wanted: Vec<f64> = x.iter().scan(3.0, one_by_one).collect();
                assert!(near(&found, &wanted), "{n} {a}");
                found.clone_from(&x);
                backward(a, 3.0, &mut found);
                let mut wanted: Vec<f64> = x.iter().rev().scan(3.0, one_by_one).collect();
                wanted.reverse();
                assert!(near(&found, &wanted), "{n} {a} backward");
            }
        }
    }
}
