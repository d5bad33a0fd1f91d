//! An assembly at given shapes on whitened data: its best coefficients, and how its force moves with the shapes.

use rayon::prelude::*;

use super::bounded;
use super::clipped::{clipped, clipped_as_measured};
use super::least_squares::{Data, Fitted};
use super::moves::Moves;
use super::normal::{Normal, whitened};
use crate::assembly::{Assembly, Columns};
use crate::kernel::filter::dot;

/// Recordings whose columns are made at a time: as many as a kernel has lanes, and no more are kept.
const TOGETHER: usize = 8;
/// Fits at most until those samples are clipped whose force is beyond the level.
const CLIPPINGS: usize = 12;

/// An assembly at given shapes, with its best coefficients.
pub(super) struct Point {
    pub(super) fitted: Fitted,
    pub(super) recordings: Vec<Local>,
    normal: Normal,
}

/// Force in N of a fit, by recording.
pub(super) fn forces(assembly: &Assembly, data: Data, fitted: &Fitted) -> Vec<Vec<f64>> {
    let point = Point::at(assembly, data, fitted.unit.clone());
    point.recordings.into_iter().map(|local| local.force).collect()
}

/// One recording at a point.
pub(super) struct Local {
    /// Whitened columns with their places.
    pub(super) columns: Vec<(usize, Vec<f64>)>,
    /// Force of the point, N.
    pub(super) force: Vec<f64>,
    /// Whitened residual.
    pub(super) residual: Vec<f64>,
}

impl Point {
    /// The best coefficients for given shapes.
    pub(super) fn at(assembly: &Assembly, data: Data, unit: Vec<f64>) -> Self {
        let shapes = assembly.physical(&unit);
        let assembly = &assembly.knowing(&shapes);
        let count = assembly.campaign().recordings().len();
        let jobs: Vec<(usize, &[f64])> = (0..count).map(|r| (r, shapes.as_slice())).collect();
        let raw: Vec<Columns> = assembly.columns_of(&jobs);
        let coefficients = assembly.coefficients();
        let mut values = vec![0.0; coefficients.len()];
        let mut masks = clipped_as_measured(assembly, &raw);
        // Which samples are clipped follows from the force, and the force from the fit without them.
        let mut normal = Normal::zeros(values.len());
        let mut whitened = Vec::new();
        for _ in 0..CLIPPINGS {
            (whitened, normal) = gather(assembly, data, &raw, &masks, values.len());
            for (i, known) in assembly.known_of_coefficients().into_iter().enumerate() {
                normal.gram[(i, i)] += known;
            }
            let lower: Vec<f64> = coefficients.iter().map(|p| p.smallest).collect();
            let upper: Vec<f64> = coefficients.iter().map(|p| p.largest).collect();
            values = bounded::minimise(&normal.gram, &normal.right, &lower, &upper);
            let now: Vec<Vec<bool>> = raw.iter().map(|c| clipped(c, &values)).collect();
            if now == masks {
                break;
            }
            masks = now;
        }
        let recordings: Vec<Local> = raw
            .iter()
            .zip(whitened)
            .map(|(c, (columns, target))| {
                let mut residual = target;
                for (place, column) in &columns {
                    for (e, value) in residual.iter_mut().zip(column) {
                        *e -= values[*place] * value;
                    }
                }
                Local { columns, force: c.measured(&values), residual }
            })
            .collect();
        let left: f64 = recordings.iter().map(|l| dot(&l.residual, &l.residual)).sum();
        let left = if left.is_finite() { left } else { f64::INFINITY };
        let fitted = Fitted { unit, coefficients: values, left, rows: normal.rows };
        Self { fitted, recordings, normal }
    }

    /// The same model, its parameters kept, where motions are others: its columns and forces; nothing is measured there.
    pub(super) fn elsewhere(&self, assembly: &Assembly, data: Data) -> Self {
        let shapes = assembly.physical(&self.fitted.unit);
        let jobs: Vec<(usize, &[f64])> = (0..self.recordings.len()).map(|r| (r, shapes.as_slice())).collect();
        let local = |(r, raw): (usize, Columns)| {
            let force = raw.measured(&self.fitted.coefficients);
            let white = |c: Vec<f64>| whitened(data.noise, r, &data.rows[r], &c);
            let columns = raw.places.into_iter().zip(raw.columns.into_iter().map(white)).collect();
            Local { columns, force, residual: Vec::new() }
        };
        let raw = assembly.columns_of(&jobs);
        let recordings = raw.into_par_iter().enumerate().map(local).collect();
        Self { fitted: self.fitted.clone(), recordings, normal: Normal::zeros(0) }
    }

    /// The force in N of the same model alone, by recording.
    pub(super) fn force_elsewhere(&self, assembly: &Assembly) -> Vec<Vec<f64>> {
        let shapes = assembly.physical(&self.fitted.unit);
        let jobs: Vec<(usize, &[f64])> = (0..self.recordings.len()).map(|r| (r, shapes.as_slice())).collect();
        let columns = assembly.columns_of(&jobs);
        columns.iter().map(|columns| columns.measured(&self.fitted.coefficients)).collect()
    }

    /// Normal equations of coefficients and shapes together, for the residual; the samples are let go.
    pub(super) fn with_tangents(self, assembly: &Assembly, data: Data) -> Normal {
        let (k, d) = (self.fitted.coefficients.len(), self.fitted.unit.len());
        let parts: Vec<Normal> = self
            .tangents(assembly, data)
            .into_par_iter()
            .zip(&self.recordings)
            .map(|(tangents, local)| {
                let first = local.columns.len();
                let columns: Vec<(usize, &[f64])> =
                    local.columns.iter().chain(&tangents).map(|(i, c)| (*i, c.as_slice())).collect();
                let mut normal = Normal::zeros(k + d);
                // Only the new products: those of the linear columns are known.
                for (i, a) in &columns {
                    normal.right[*i] += dot(a, &local.residual);
                }
                for n in first..columns.len() {
                    for m in 0..=n {
                        let ((i, a), (j, b)) = (columns[n], columns[m]);
                        let product = dot(a, b);
                        normal.gram[(i, j)] += product;
                        if i != j {
                            normal.gram[(j, i)] += product;
                        }
                    }
                }
                normal
            })
            .collect();
        let mut system = Normal::zeros(k + d);
        for part in &parts {
            system.merge(part);
        }
        for i in 0..k {
            for j in 0..k {
                system.gram[(i, j)] = self.normal.gram[(i, j)];
            }
        }
        system
    }

    /// Whitened tangents of the shapes that bear on each recording.
    pub(super) fn tangents(&self, assembly: &Assembly, data: Data) -> Vec<Vec<(usize, Vec<f64>)>> {
        let assembly = &assembly.knowing(&assembly.physical(&self.fitted.unit));
        let moves = Moves::of(assembly, &self.fitted);
        let count = self.recordings.len();
        let places: Vec<(usize, usize)> =
            (0..count).flat_map(|r| moves.bearing(assembly, r).map(move |j| (r, j))).collect();
        let mut found = vec![Vec::new(); count];
        for places in places.chunks(TOGETHER) {
            let jobs: Vec<(usize, &[f64])> = places.iter().map(|(r, j)| (*r, moves.shapes(*j))).collect();
            let changes: Vec<(usize, Vec<f64>)> = assembly
                .columns_of(&jobs)
                .into_par_iter()
                .zip(places)
                .map(|(columns, (r, j))| {
                    let (coefficients, before) = (&self.fitted.coefficients, &self.recordings[*r].force);
                    let (place, change) = moves.slope(*j, &columns, coefficients, before);
                    (place, whitened(data.noise, *r, &data.rows[*r], &change))
                })
                .collect();
            for (change, (r, _)) in changes.into_iter().zip(places) {
                found[*r].push(change);
            }
        }
        found
    }
}

type Whitened = (Vec<(usize, Vec<f64>)>, Vec<f64>);

fn gather(
    assembly: &Assembly,
    data: Data,
    raw: &[Columns],
    masks: &[Vec<bool>],
    coefficients: usize,
) -> (Vec<Whitened>, Normal) {
    let locals: Vec<(Whitened, Normal)> = raw
        .par_iter()
        .enumerate()
        .map(|(r, c)| {
            let measured = assembly.campaign().recordings()[r].force().unwrap_or_default();
            let mut target: Vec<f64> = match &c.given {
                Some(given) => measured.iter().zip(given).map(|(f, g)| f - g).collect(),
                None => measured.to_vec(),
            };
            let mask = &masks[r];
            if let Some((low, high)) = c.clip {
                for (i, _) in mask.iter().enumerate().filter(|(_, masked)| **masked) {
                    let level = if measured[i] > 0.5 * (low + high) { high } else { low };
                    target[i] = measured[i] - level;
                }
            }
            let columns: Vec<(usize, Vec<f64>)> = c
                .columns
                .iter()
                .zip(&c.places)
                .map(|(column, place)| {
                    let series = if mask.is_empty() {
                        whitened(data.noise, r, &data.rows[r], column)
                    } else {
                        let kept: Vec<f64> =
                            column.iter().zip(mask).map(|(v, m)| if *m { 0.0 } else { *v }).collect();
                        whitened(data.noise, r, &data.rows[r], &kept)
                    };
                    (*place, series)
                })
                .collect();
            let target = whitened(data.noise, r, &data.rows[r], &target);
            let mut normal = Normal::zeros(coefficients);
            normal.add(&columns, &target);
            ((columns, target), normal)
        })
        .collect();
    let mut normal = Normal::zeros(coefficients);
    let mut all = Vec::with_capacity(locals.len());
    for (columns, part) in locals {
        normal.merge(&part);
        all.push(columns);
    }
    (all, normal)
}
