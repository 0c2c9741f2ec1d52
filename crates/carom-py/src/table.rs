//! Tables that any reader of Arrow's C stream takes without a copy: pyarrow, pandas, polars.

use crate::materials::html;
use crate::numbers::numpy;
use arrow_array::builder::StringBuilder;
use arrow_array::cast::AsArray as _;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::types::{Float64Type, Int64Type, UInt64Type};
use arrow_array::{
    Array as _, ArrayRef, ArrowPrimitiveType, Float64Array, Int64Array, RecordBatch, RecordBatchIterator, StringArray,
    UInt64Array,
};
use arrow_schema::{ArrowError, DataType, Field, Schema};
use carom_table::{TableReader, Values};
use carom_track::tables;
use numpy::{PyArray1, PyArrayMethods as _};
use pyo3::exceptions::{PyFileNotFoundError, PyKeyError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Named columns of one length, with SI units.
///
/// Readers of Arrow's C stream take it without a copy: ``pyarrow.table(t)``, ``polars.DataFrame(t)``, ``pandas.DataFrame.from_arrow(t)``.
/// ``t["x"]`` is a NumPy array.
///
/// Attributes
/// ----------
/// column_names : list of str
/// units : dict of str to str
///     Empty for a number.
#[pyclass(frozen, module = "carom")]
pub struct Table {
    batch: RecordBatch,
}

fn failed(error: &ArrowError) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// A field with its unit as metadata.
fn field(name: &str, unit: &str, kind: DataType) -> Field {
    let field = Field::new(name, kind, true);
    if unit.is_empty() { field } else { field.with_metadata(HashMap::from([("unit".to_owned(), unit.to_owned())])) }
}

impl Table {
    /// Of columns with their fields.
    fn new(columns: Vec<(Field, ArrayRef)>) -> PyResult<Self> {
        let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = columns.into_iter().unzip();
        let batch = RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).map_err(|e| failed(&e))?;
        Ok(Self { batch })
    }

    /// Of a file, CSV or Parquet, in memory.
    pub fn of_file(path: &Path, schema: carom_table::Schema) -> PyResult<Self> {
        let wrong = |e: carom_table::TableError| PyRuntimeError::new_err(e.to_string());
        let mut reader = TableReader::open(path, schema.clone()).map_err(wrong)?;
        let mut columns: Vec<Grown> = schema.iter().map(|f| Grown::new(f.kind)).collect();
        while let Some(batch) = reader.next_batch().map_err(wrong)? {
            for (grown, column) in columns.iter_mut().zip(batch.columns()) {
                grown.push(&column.values);
            }
        }
        let finished = schema.iter().zip(columns).map(|(f, grown)| {
            let array = grown.finish();
            (field(&f.name, &f.unit, array.data_type().clone()), array)
        });
        Self::new(finished.collect())
    }

    /// Of a table in memory.
    pub fn of_table(table: &carom_table::Table) -> PyResult<Self> {
        let columns = table.columns().iter().map(|column| {
            let mut grown = Grown::new(column.values.kind());
            grown.push(&column.values);
            let array = grown.finish();
            (field(&column.name, &column.unit, array.data_type().clone()), array)
        });
        Self::new(columns.collect())
    }

    /// Of arrays of one shape, by name.
    pub fn of_arrays(arrays: &Bound<'_, PyDict>, units: &[(&str, &str)]) -> PyResult<Self> {
        let mut columns = Vec::new();
        for (name, array) in arrays {
            let name = name.extract::<String>()?;
            let flat = array.call_method0("ravel")?;
            let kind: String = flat.getattr("dtype")?.getattr("kind")?.extract()?;
            let array: ArrayRef = match kind.as_str() {
                "f" => Arc::new(Float64Array::from(flat.cast::<PyArray1<f64>>()?.try_readonly()?.as_slice()?.to_vec())),
                "u" => {
                    let counts = flat.call_method1("astype", ("uint64",))?;
                    Arc::new(UInt64Array::from(counts.cast::<PyArray1<u64>>()?.try_readonly()?.as_slice()?.to_vec()))
                }
                _ => Arc::new(StringArray::from(flat.call_method0("tolist")?.extract::<Vec<String>>()?)),
            };
            let unit = units.iter().find(|(n, _)| *n == name).map_or("", |(_, unit)| *unit);
            columns.push((field(&name, unit, array.data_type().clone()), array));
        }
        Self::new(columns)
    }

    fn column(&self, name: &str) -> PyResult<&ArrayRef> {
        let known = || self.column_names().join(", ");
        self.batch
            .column_by_name(name)
            .ok_or_else(|| PyKeyError::new_err(format!("no column '{name}'; there are {}", known())))
    }
}

/// Whole numbers as they are, or as floats with NaN where one is missing.
fn whole_numbers<'py, T: ArrowPrimitiveType<Native: numpy::Element>>(
    py: Python<'py>,
    column: &ArrayRef,
    float: impl Fn(T::Native) -> f64,
) -> Bound<'py, PyAny> {
    let column = column.as_primitive::<T>();
    if column.null_count() == 0 {
        return PyArray1::from_slice(py, column.values()).into_any();
    }
    let values: Vec<f64> = column.iter().map(|v| v.map_or(f64::NAN, &float)).collect();
    PyArray1::from_vec(py, values).into_any()
}

/// A column that grows batch by batch.
enum Grown {
    Float(Vec<f64>),
    Integer(Vec<Option<i64>>),
    Count(Vec<Option<u64>>),
    Text(StringBuilder),
}

impl Grown {
    fn new(kind: carom_table::Kind) -> Self {
        match kind {
            carom_table::Kind::Float => Self::Float(Vec::new()),
            carom_table::Kind::Integer => Self::Integer(Vec::new()),
            carom_table::Kind::Count => Self::Count(Vec::new()),
            carom_table::Kind::Text => Self::Text(StringBuilder::new()),
        }
    }

    fn push(&mut self, values: &Values) {
        match (self, values) {
            (Self::Float(to), Values::Float(from)) => to.extend_from_slice(from),
            (Self::Integer(to), Values::Integer(from)) => to.extend_from_slice(from),
            (Self::Count(to), Values::Count(from)) => to.extend_from_slice(from),
            (Self::Text(to), Values::Text(from)) => from.iter().for_each(|text| to.append_option(text.as_deref())),
            _ => debug_assert!(false, "a column keeps its kind"),
        }
    }

    fn finish(self) -> ArrayRef {
        match self {
            // a missing number stays NaN, so that the values are NumPy's without a copy
            Self::Float(v) => Arc::new(Float64Array::from(v)),
            Self::Integer(v) => Arc::new(Int64Array::from(v)),
            Self::Count(v) if v.iter().all(Option::is_some) => {
                Arc::new(UInt64Array::from(v.into_iter().flatten().collect::<Vec<u64>>()))
            }
            Self::Count(v) => Arc::new(UInt64Array::from(v)),
            Self::Text(mut v) => Arc::new(v.finish()),
        }
    }
}

#[pymethods]
impl Table {
    /// A table of a run's folder by its name: impacts, fates, trajectories, deposition.
    #[staticmethod]
    fn of_run(folder: PathBuf, name: &str) -> PyResult<Self> {
        let Some(schema) = tables::schema(name) else {
            return Err(PyFileNotFoundError::new_err(format!("a run has no table '{name}'")));
        };
        for extension in ["parquet", "csv"] {
            let path = folder.join(format!("{name}.{extension}"));
            if path.exists() {
                return Self::of_file(&path, schema);
            }
        }
        Err(PyFileNotFoundError::new_err(format!("{}: no table of {name}: the case writes none", folder.display())))
    }

    #[getter]
    fn column_names(&self) -> Vec<String> {
        self.batch.schema().fields().iter().map(|f| f.name().clone()).collect()
    }

    /// SI units by column.
    #[getter]
    fn units(&self) -> HashMap<String, String> {
        let schema = self.batch.schema();
        schema
            .fields()
            .iter()
            .map(|f| (f.name().clone(), f.metadata().get("unit").cloned().unwrap_or_default()))
            .collect()
    }

    fn __len__(&self) -> usize {
        self.batch.num_rows()
    }

    /// A column as a NumPy array.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let column = self.column(name)?;
        match column.data_type() {
            DataType::Float64 => Ok(PyArray1::from_slice(py, column.as_primitive::<Float64Type>().values()).into_any()),
            DataType::UInt64 => Ok(whole_numbers::<UInt64Type>(py, column, |v| v as f64)),
            DataType::Int64 => Ok(whole_numbers::<Int64Type>(py, column, |v| v as f64)),
            _ => {
                let texts: Vec<&str> = column.as_string::<i32>().iter().map(Option::unwrap_or_default).collect();
                numpy(py)?.call_method1("array", (texts,))
            }
        }
    }

    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for name in self.column_names() {
            all.set_item(&name, self.__getitem__(py, &name)?)?;
        }
        Ok(all)
    }

    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("pandas")?.getattr("DataFrame")?.call1((self.to_dict(py)?,))
    }

    fn to_polars<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("polars")?.call_method1("DataFrame", (slf,))
    }

    fn to_arrow<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("pyarrow")?.call_method1("table", (slf,))
    }

    /// The table by Arrow's PyCapsule interface.
    #[pyo3(signature = (requested_schema=None))]
    pub fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // a schema is a wish: what is there is given as it is
        let _ = requested_schema;
        let batches = RecordBatchIterator::new([Ok(self.batch.clone())], self.batch.schema());
        PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(batches)), c"arrow_array_stream")
    }

    fn __repr__(&self) -> String {
        format!("<carom.Table: {} rows of {}>", self.batch.num_rows(), self.column_names().join(", "))
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        const SHOWN: usize = 10;
        let names = self.column_names();
        let units = self.units();
        let heads: String = names
            .iter()
            .map(|n| match units.get(n).map_or("", String::as_str) {
                "" => format!("<th>{}</th>", html(n)),
                unit => format!("<th>{} ({})</th>", html(n), html(unit)),
            })
            .collect();
        let columns = names.iter().map(|n| self.__getitem__(py, n)).collect::<PyResult<Vec<_>>>()?;
        let mut rows = String::new();
        for row in 0..self.batch.num_rows().min(SHOWN) {
            let cells = columns.iter().map(|c| Ok(format!("<td>{}</td>", html(&c.get_item(row)?.str()?.to_string()))));
            rows += &format!("<tr>{}</tr>", cells.collect::<PyResult<String>>()?);
        }
        let more = self.batch.num_rows().saturating_sub(SHOWN);
        let caption = if more > 0 { format!("<caption>{more} more rows</caption>") } else { String::new() };
        Ok(format!("<table>{caption}<tr>{heads}</tr>{rows}</table>"))
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(PyValueError::new_err("a table is not pickled: pass its file, or the Arrow table made of it"))
    }
}
