//! VTK
