//! A sinh problem from samples that pass by once and are not kept: memory does not grow with their
//! number, and an evaluation costs what it costs on a few thousand.

use nalgebra::{Matrix4, Vector4};

use std::sync::Arc;

use super::{Kernel, Problem, bounds};
use crate::error::{Error, Result};
use crate::extent::{Extent, too_small};
use crate::kernel::bessel::{LARGEST, nodes};
use crate::kernel::sinh_compressed::{Motion, OTHERS, tree};
use crate::kernel::triangle::Triangle;
use crate::kernel::{Sinh, SinhCompressed};
use crate::law::Law;
use crate::model::Model;
use crate::recording::check::usable;
use crate::recording::{LARGEST as LARGEST_SAMPLE, MIN_SAMPLES, SMALLEST};

/// Samples that are worked in together, in parallel: fixed, so that the result does not depend on how
/// the samples were cut into chunks.
const BATCH: usize = 1 << 20;

/// Takes samples chunk by chunk.
///
/// What has to be known beforehand is the largest displacement, and through it (or as a bound) the
/// largest beta: they decide the polynomials by which sinh is represented.
#[derive(Debug)]
pub struct Stream {
    given: Vec<(String, f64, f64)>,
    extent: Extent,
    largest_beta: f64,
    nodes: usize,
    /// Displacement, velocity and force that wait for a batch to fill.
    waiting: [Vec<f64>; 3],
    factor: Triangle,
    samples: usize,
    chunks: usize,
    /// Smallest and largest displacement, mm.
    range: (f64, f64),
}

impl Stream {
    /// A stream in which no displacement exceeds `largest_displacement` in mm, for a problem in which
    /// named parameters have other bounds than the default ones.
    ///
    /// # Errors
    /// A largest displacement that is not positive, or bounds as in [`Problem::new`] that cannot be; a
    /// beta beyond 25 / `largest_displacement`, which would need every sample.
    pub fn new(largest_displacement: f64, bounds: &[(String, f64, f64)]) -> Result<Self> {
        if !(SMALLEST..=LARGEST_SAMPLE).contains(&largest_displacement) {
            let wanted = format!("a positive number of mm, from {SMALLEST:e} to {LARGEST_SAMPLE:e}");
            let given = format!("{largest_displacement:?}");
            return Err(Error::setting("largest_displacement", given, wanted));
        }
        let extent = Extent {
            displacement: largest_displacement,
            shortest: largest_displacement,
            velocity: 0.0,
            force: 0.0,
            ..Extent::UNIT
        };
        // Bounds that are not given follow from the samples, but for beta.
        let unknown = Extent { velocity: 1.0, force: 1.0, ..extent };
        let mut parameters = Model::named("sinh")?.parameters(&unknown);
        let largest_beta = bounds::choose(&mut parameters, bounds, largest_displacement)?.upper()[3];
        // The default box asks for sinh(x / largest displacement).
        let largest = (largest_beta * largest_displacement).max(1.0);
        let Some(nodes) = nodes(largest).filter(|_| largest <= LARGEST) else {
            let most = LARGEST / largest_displacement;
            let wanted = format!("at most {most} 1/mm: above it every sample has to be kept");
            return Err(Error::setting("upper bound of beta", largest_beta, wanted));
        };
        Ok(Self {
            given: bounds.to_vec(),
            extent,
            largest_beta,
            nodes,
            waiting: [const { Vec::new() }; 3],
            factor: Triangle::new(nodes + OTHERS),
            samples: 0,
            chunks: 0,
            range: (f64::INFINITY, f64::NEG_INFINITY),
        })
    }

    /// Work in samples of displacement in mm, velocity in mm/s and force in N, in parallel.
    ///
    /// # Errors
    /// Different lengths, a value that is not finite, or a larger displacement than was said.
    pub fn absorb(&mut self, displacement: &[f64], velocity: &[f64], force: &[f64]) -> Result<()> {
        self.check([("displacement", displacement), ("velocity", velocity), ("force", force)])
            .map_err(|error| Error::Recording(format!("chunk {}: {error}", self.chunks)))?;
        self.chunks += 1;
        self.samples += force.len();
        let farthest = |far: f64, values: &[f64]| values.iter().fold(far, |far, v| v.abs().max(far));
        self.extent.velocity = farthest(self.extent.velocity, velocity);
        self.extent.force = farthest(self.extent.force, force);
        for x in displacement {
            self.range = (self.range.0.min(*x), self.range.1.max(*x));
        }
        let mut next = 0;
        while next < force.len() {
            let end = force.len().min(next + BATCH - self.waiting[0].len());
            for (to, from) in self.waiting.iter_mut().zip([displacement, velocity, force]) {
                to.extend_from_slice(&from[next..end]);
            }
            if self.waiting[0].len() == BATCH {
                self.work_in();
            }
            next = end;
        }
        Ok(())
    }

    fn check(&self, series: [(&'static str, &[f64]); 3]) -> Result<()> {
        let expected = series[0].1.len();
        for (what, values) in series {
            if values.len() != expected {
                let wanted = format!("{expected}, as displacement");
                return Err(Error::setting(format!("number of samples of {what}"), values.len(), wanted));
            }
            usable(what, values)?;
        }
        let most = self.extent.displacement;
        match series[0].1.iter().position(|x| x.abs() > most) {
            Some(index) => Err(Error::setting(
                format!("displacement at sample {index}"),
                series[0].1[index],
                format!("within the largest_displacement of {most} mm"),
            )),
            None => Ok(()),
        }
    }

    /// Work in what waits.
    fn work_in(&mut self) {
        let [displacement, velocity, force] = &self.waiting;
        let motion = Motion { displacement, velocity, force };
        let leaves: Vec<_> = motion.leaves(1.0, self.extent.displacement).collect();
        self.factor.join(&tree(&leaves, self.nodes));
        self.waiting.iter_mut().for_each(Vec::clear);
    }

    /// The problem of all samples so far. Its default box is that of [`Problem::new`] with the largest
    /// displacement that was said.
    ///
    /// # Errors
    /// Too few samples, or samples without motion or force.
    pub fn into_problem(mut self) -> Result<Problem> {
        self.work_in();
        let problem = match self.range {
            _ if self.samples < MIN_SAMPLES => {
                format!("{} samples: at least {MIN_SAMPLES} are needed", self.samples)
            }
            (low, high) if high - low < SMALLEST => {
                format!("displacement is {low} mm throughout: a moving device is needed")
            }
            _ if self.extent.velocity == 0.0 => {
                "velocity is zero throughout, though the displacement changes".into()
            }
            _ if self.extent.force < SMALLEST => too_small(self.extent.force),
            _ => return self.compressed(),
        };
        Err(Error::Recording(problem))
    }

    fn compressed(self) -> Result<Problem> {
        let factor = self.factor.scaled(1.0 / (self.samples as f64).sqrt());
        let mut extent = self.extent;
        let on = SinhCompressed::from_triangle(factor, self.nodes, extent.displacement, self.largest_beta);
        let mut sinh = vec![0.0; on.triangle().columns()];
        on.series(&on.bessel().all(1.0), &mut sinh);
        let column = |j: usize| (0..sinh.len()).map(|i| on.triangle().at(i, j)).collect::<Vec<f64>>();
        let (basis, force) = ([column(0), column(2), column(1), sinh.clone()], column(sinh.len() - 1));
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum();
        extent.settle(
            &Matrix4::from_fn(|i, j| product(&basis[i], &basis[j])),
            &Vector4::from_fn(|i, _| product(&basis[i], &force)),
        );
        let model = Model::named("sinh")?;
        let mut parameters = model.parameters(&extent);
        let bounds = bounds::choose(&mut parameters, &self.given, extent.displacement)?;
        let kernel = Arc::new(Kernel::Sinh(Box::new(Sinh::streamed(on, self.samples))));
        let (recordings, weights) = (Vec::new(), Vec::new());
        Ok(Problem { recordings, model, law: Law::Shared, parameters, bounds, weights, kernel })
    }
}
