//! Many impacts at once, in columns.
//!
//! The same arithmetic as [`WallLaw::impact`], to the bit, in a plane: normal and tangential speed, spin (positive when it rolls forward
//! along the tangential speed) and diameter in; normal and tangential speed and spin out. The loops are compiled for AVX-512, AVX2 and
//! the plain machine; the best is chosen at run time and changes no bit of the result.
//!
//! A wall that scatters ([`crate::scatter`]) goes row by row, a microsecond or two each: [`WallLaw::impact_batch`] then takes every
//! draw at ½, [`WallLaw::impact_batch_drawn`] the draws it is given, and the columns hold the motion in the incoming plane.
//!
//! ```
//! use carom::{batch::{Incidence, Rebound}, material::Library, spec::parse_law};
//! let law = parse_law("sphere = \"copper\"\nsurface = \"aluminium\"\nnormal = \"ea\"\nfriction = 0.2\n")?;
//! let wall = law.compile(Library::builtin())?;
//! let (mut n, mut t, mut w) = ([0.0; 2], [0.0; 2], [0.0; 2]);
//! let incidence = Incidence { normal: &[1.0, 1e-3], tangential: &[2.0, 2.0], spin: &[0.0, 0.0], diameter: &[90e-6, 5e-6] };
//! wall.impact_batch(&incidence, &mut Rebound::new(&mut n, &mut t, &mut w)).expect("columns of equal length, all approaching");
//! assert!(n[0] > 0.0 && n[1] == 0.0); // the second is captured
//! # Ok::<(), carom::LawError>(())
//! ```

pub use crate::instructions::InstructionSet;

use crate::impact::{Energy, Fate, Impact, ImpactError, Outcome};
use crate::kernel::columns;
use crate::wall::WallLaw;

/// The draws of an impact that says nothing of them.
const MIDDLE: [f64; 4] = [0.5; 4];

/// Columns in, all of one length: the spheres are of the law's own density, the wall is at rest.
#[derive(Clone, Copy, Debug)]
pub struct Incidence<'a> {
    /// Normal approach speed, m/s, positive.
    pub normal: &'a [f64],
    /// Tangential speed, m/s.
    pub tangential: &'a [f64],
    /// Spin, rad/s, positive when it rolls forward along positive tangential speed.
    pub spin: &'a [f64],
    /// Diameter, m.
    pub diameter: &'a [f64],
}

/// Columns out, of the length of the columns in. A captured sphere has 0 everywhere.
#[derive(Debug)]
pub struct Rebound<'a> {
    /// Normal speed away from the wall, m/s.
    pub normal: &'a mut [f64],
    /// Tangential speed, m/s.
    pub tangential: &'a mut [f64],
    /// Spin, rad/s.
    pub spin: &'a mut [f64],
    /// Restitution e, if asked for.
    pub restitution: Option<&'a mut [f64]>,
    /// Impulse ratio μ (NaN for a capture), if asked for.
    pub impulse_ratio: Option<&'a mut [f64]>,
    /// Where the energy went, if asked for (slower: one impact at a time).
    pub energy: Option<&'a mut [Energy]>,
}

impl<'a> Rebound<'a> {
    /// Speeds and spin alone.
    pub fn new(normal: &'a mut [f64], tangential: &'a mut [f64], spin: &'a mut [f64]) -> Self {
        Self { normal, tangential, spin, restitution: None, impulse_ratio: None, energy: None }
    }
}

/// A batch that was not wholly done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BatchError {
    /// The columns differ in length; nothing was written.
    Lengths,
    /// The row `index` is no impact. Its outputs are NaN, as are those of any other such row; all other rows are done.
    Row {
        /// The first such row.
        index: usize,
        /// What is wrong with it.
        error: ImpactError,
    },
}

impl core::error::Error for BatchError {}

impl core::fmt::Display for BatchError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Lengths => f.write_str("the columns differ in length"),
            Self::Row { index, error } => write!(f, "row {index}: {error}"),
        }
    }
}

impl WallLaw {
    /// Many impacts at once; see the [module](crate::batch).
    ///
    /// # Errors
    /// Columns of different lengths; rows that are no impact (all others are done, and the first bad one is named).
    pub fn impact_batch(&self, incidence: &Incidence, rebound: &mut Rebound) -> Result<(), BatchError> {
        self.impact_batch_on(InstructionSet::best(), incidence, rebound)
    }

    /// As [`WallLaw::impact_batch`], on a given instruction set (for tests and benchmarks); one this machine lacks runs as
    /// [`InstructionSet::Portable`].
    ///
    /// # Errors
    /// As [`WallLaw::impact_batch`].
    pub fn impact_batch_on(
        &self,
        set: InstructionSet,
        incidence: &Incidence,
        rebound: &mut Rebound,
    ) -> Result<(), BatchError> {
        self.check_lengths(incidence, rebound)?;
        if self.scatter().is_some() {
            return self.by_row(incidence, |_| MIDDLE, rebound);
        }
        let all_fine = columns::run(set, self.kernel(), &self.tables(), incidence, rebound);
        if let Some(energy) = rebound.energy.as_deref_mut() {
            for (i, out) in energy.iter_mut().enumerate() {
                *out = self.planar(incidence, i, MIDDLE).map_or(Energy::default(), |o| o.energy);
            }
        }
        if all_fine { Ok(()) } else { self.first_bad_row(incidence) }
    }

    /// As [`WallLaw::impact_batch`], with the [`Impact::draws`] of each row for walls that scatter. What leaves the plane of incidence
    /// is not in the columns: tangential speed and spin are the components in it and about its normal.
    ///
    /// # Errors
    /// As [`WallLaw::impact_batch`].
    pub fn impact_batch_drawn(
        &self,
        incidence: &Incidence,
        draws: &[[f64; 4]],
        rebound: &mut Rebound,
    ) -> Result<(), BatchError> {
        self.check_lengths(incidence, rebound)?;
        if draws.len() != incidence.normal.len() {
            return Err(BatchError::Lengths);
        }
        self.by_row(incidence, |i| draws[i], rebound)
    }

    fn by_row(&self, rows: &Incidence, draws: impl Fn(usize) -> [f64; 4], out: &mut Rebound) -> Result<(), BatchError> {
        let mut bad = Ok(());
        for index in 0..rows.normal.len() {
            let met = self.planar(rows, index, draws(index));
            let [normal, tangential, spin, e, ratio] = met.as_ref().map_or([f64::NAN; 5], as_row);
            (out.normal[index], out.tangential[index], out.spin[index]) = (normal, tangential, spin);
            if let Some(column) = out.restitution.as_deref_mut() {
                column[index] = e;
            }
            if let Some(column) = out.impulse_ratio.as_deref_mut() {
                column[index] = ratio;
            }
            if let Some(column) = out.energy.as_deref_mut() {
                column[index] = met.as_ref().map_or(Energy::default(), |o| o.energy);
            }
            if let Err(error) = met {
                bad = bad.and(Err(BatchError::Row { index, error }));
            }
        }
        bad
    }

    fn check_lengths(&self, incidence: &Incidence, rebound: &Rebound) -> Result<(), BatchError> {
        let n = incidence.normal.len();
        let ins = [incidence.tangential.len(), incidence.spin.len(), incidence.diameter.len()];
        let outs = [rebound.normal.len(), rebound.tangential.len(), rebound.spin.len()];
        let optional = [
            rebound.restitution.as_ref().map(|c| c.len()),
            rebound.impulse_ratio.as_ref().map(|c| c.len()),
            rebound.energy.as_ref().map(|c| c.len()),
        ];
        if ins.into_iter().chain(outs).chain(optional.into_iter().flatten()).any(|length| length != n) {
            return Err(BatchError::Lengths);
        }
        Ok(())
    }

    /// Row `i` as one impact on a wall with normal +y.
    fn planar(&self, rows: &Incidence, i: usize, draws: [f64; 4]) -> Result<Outcome, ImpactError> {
        let mut impact = Impact::new(rows.diameter[i], [rows.tangential[i], -rows.normal[i], 0.0], [0.0, 1.0, 0.0]);
        impact.spin = [0.0, 0.0, -rows.spin[i]];
        impact.draws = draws;
        self.impact(&impact)
    }

    fn first_bad_row(&self, rows: &Incidence) -> Result<(), BatchError> {
        for index in 0..rows.normal.len() {
            if let Err(error) = self.planar(rows, index, MIDDLE) {
                return Err(BatchError::Row { index, error });
            }
        }
        Ok(())
    }

    /// One row, written out as the batch writes it; the reference the kernels are tested against.
    ///
    /// # Errors
    /// As [`WallLaw::impact`].
    pub fn impact_row(&self, rows: &Incidence, i: usize) -> Result<[f64; 5], ImpactError> {
        Ok(as_row(&self.planar(rows, i, MIDDLE)?))
    }
}

/// An outcome as a row: normal and tangential speed, spin, restitution, impulse ratio.
fn as_row(out: &Outcome) -> [f64; 5] {
    match out.fate {
        Fate::Capture => [0.0, 0.0, 0.0, 0.0, f64::NAN],
        Fate::Rebound => [out.velocity[1], out.velocity[0], -out.spin[2], out.restitution, out.impulse_ratio],
    }
}
