//! Fields on a mesh.

/// A quantity of `N` components on a mesh, SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Field<const N: usize> {
    /// Values of cells and of the patches' faces.
    Cells {
        /// One for each cell.
        cells: Vec<[f64; N]>,
        /// One for each face of the boundary, in the order of the faces. Where a file gives none, it is the cell's.
        boundary: Vec<[f64; N]>,
    },
    /// Values of points.
    Points(Vec<[f64; N]>),
}

/// The fields that a result has, SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fields {
    /// Velocity of the fluid, m/s.
    pub velocity: Option<Field<3>>,
    /// Turbulent kinetic energy, m²/s².
    pub k: Option<Field<1>>,
    /// Its dissipation rate, m²/s³.
    pub epsilon: Option<Field<1>>,
    /// Its specific dissipation rate ε/(0.09 k), 1/s.
    pub omega: Option<Field<1>>,
    /// Density, kg/m³.
    pub density: Option<Field<1>>,
    /// Temperature, K.
    pub temperature: Option<Field<1>>,
    /// Pressure, Pa; of an incompressible result over the density, m²/s².
    pub pressure: Option<Field<1>>,
    /// Names of the fields that were there and are of no use here.
    pub others: Vec<String>,
}

impl Fields {
    /// The scalar fields by name, in a fixed order.
    pub fn scalars(&self) -> [(&'static str, Option<&Field<1>>); 6] {
        [
            ("k", self.k.as_ref()),
            ("epsilon", self.epsilon.as_ref()),
            ("omega", self.omega.as_ref()),
            ("density", self.density.as_ref()),
            ("temperature", self.temperature.as_ref()),
            ("pressure", self.pressure.as_ref()),
        ]
    }
}
