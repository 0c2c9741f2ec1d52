//! Tables through their files and back.

use std::fs;
use std::io::{self, Write};

use carom_table::{Cell, Column, Field, Format, Table, TableError, TableReader, TableWriter, Values};
use parquet::basic::Compression;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field as Read;

const NUMBERS: [f64; 7] = [0.1 + 0.2, 1.0e-300, 90.0e-6, -0.0, 1.7976931348623157e308, f64::NAN, 1.0 / 3.0];

fn sample() -> Table {
    Table::new([
        Column::count("particle", [Some(0), Some(u64::MAX), None, Some(3), Some(4), Some(5), Some(6)]),
        Column::integer("shift", [-1, i64::MIN, i64::MAX, 0, 1, 2, 3]),
        Column::float("time", "s", NUMBERS),
        Column::optional_text(
            "wall",
            [Some("floor"), None, Some("a, \"b\""), Some("zwei\nZeilen"), Some("µ"), Some("floor"), Some("é")],
        ),
    ])
    .unwrap()
}

#[test]
fn csv_reads_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.CSV");
    sample().write(&path).unwrap();
    let mut reader = csv::Reader::from_path(&path).unwrap();
    assert_eq!(reader.headers().unwrap(), vec!["particle", "shift", "time", "wall"]);
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), NUMBERS.len());
    for (row, number) in rows.iter().zip(NUMBERS) {
        if number.is_nan() {
            assert_eq!(&row[2], "");
        } else {
            assert_eq!(row[2].parse::<f64>().unwrap().to_bits(), number.to_bits());
        }
    }
    assert_eq!(&rows[0][2], "0.30000000000000004", "all the digits that tell it from 0.3");
    assert_eq!(&rows[2][2], "9e-5", "and no more");
    assert_eq!((&rows[1][0], &rows[2][0]), ("18446744073709551615", ""));
    assert_eq!(&rows[1][1], "-9223372036854775808");
    assert_eq!((&rows[1][3], &rows[2][3], &rows[3][3]), ("", "a, \"b\"", "zwei\nZeilen"));
}

#[test]
fn json_reads_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.json");
    sample().write(&path).unwrap();
    let rows: Vec<serde_json::Value> = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    for (row, number) in rows.iter().zip(NUMBERS) {
        match row["time"].as_f64() {
            Some(read) => assert_eq!(read.to_bits(), number.to_bits()),
            None => assert!(row["time"].is_null() && number.is_nan()),
        }
    }
    assert_eq!(rows[1]["particle"].as_u64(), Some(u64::MAX));
    assert!(rows[2]["particle"].is_null() && rows[1]["wall"].is_null());
    assert_eq!(rows[3]["wall"], "zwei\nZeilen");
    assert_eq!(rows.len(), NUMBERS.len());
}

#[test]
fn json_has_null_for_infinity_and_an_empty_array_for_no_rows() {
    let table = Table::new([Column::float("x", "", [f64::INFINITY])]).unwrap();
    assert_eq!(table.to_json().unwrap(), "[\n{\"x\":null}\n]\n");
    let empty = Table::with_schema(&[Field::float("x", "")]).unwrap();
    assert_eq!(empty.to_json().unwrap(), "[]\n");
    assert_eq!(empty.to_csv().unwrap(), "x\n");
}

#[test]
fn parquet_reads_back_typed_with_nulls_and_units() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.parquet");
    sample().write(&path).unwrap();
    let reader = SerializedFileReader::new(fs::File::open(&path).unwrap()).unwrap();
    let file = reader.metadata().file_metadata();
    let units = file.key_value_metadata().unwrap().iter().find(|kv| kv.key == "units").unwrap();
    assert_eq!(units.value.as_deref(), Some("{\"time\":\"s\"}"));
    assert_eq!(reader.metadata().row_group(0).column(2).compression(), Compression::SNAPPY);
    let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    assert_eq!(rows.len(), NUMBERS.len());
    for (row, number) in rows.iter().zip(NUMBERS) {
        match row.get_column_iter().nth(2).unwrap().1 {
            Read::Double(read) => assert_eq!(read.to_bits(), number.to_bits()),
            other => assert!(*other == Read::Null && number.is_nan(), "{other:?}"),
        }
    }
    let cell = |row: usize, column: usize| rows[row].get_column_iter().nth(column).unwrap().1.clone();
    assert_eq!(cell(1, 0), Read::ULong(u64::MAX));
    assert_eq!((cell(2, 0), cell(1, 3)), (Read::Null, Read::Null));
    assert_eq!(cell(1, 1), Read::Long(i64::MIN));
    assert_eq!(cell(4, 3), Read::Str("µ".to_owned()));
}

#[test]
fn a_long_stream_becomes_several_row_groups_and_loses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let schema = vec![Field::count("particle"), Field::float("x", "m")];
    let paths = ["long.parquet", "long.csv"].map(|name| folder.path().join(name));
    let mut writers = paths.each_ref().map(|path| TableWriter::create(path, schema.clone()).unwrap());
    let mut block = Table::with_schema(&schema).unwrap();
    let (blocks, rows) = (200_u64, 1000_u64);
    for b in 0..blocks {
        block.clear();
        for r in 0..rows {
            let n = b * rows + r;
            block.push([n.into(), (n as f64 * 0.1).into()]).unwrap();
        }
        writers.iter_mut().for_each(|w| w.write(&block).unwrap());
    }
    writers.into_iter().for_each(|w| w.finish().unwrap());
    let reader = SerializedFileReader::new(fs::File::open(&paths[0]).unwrap()).unwrap();
    assert_eq!(reader.metadata().num_row_groups(), 4);
    let sum: u64 = reader
        .get_row_iter(None)
        .unwrap()
        .map(|row| match row.unwrap().get_column_iter().next().unwrap().1 {
            Read::ULong(n) => *n,
            other => panic!("{other:?}"),
        })
        .sum();
    let n = blocks * rows;
    assert_eq!(sum, n * (n - 1) / 2);
    assert_eq!(csv::Reader::from_path(&paths[1]).unwrap().records().count() as u64, n);
}

#[test]
fn nothing_is_at_the_path_before_the_end_and_nothing_beside_it_after() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.csv");
    fs::write(&path, "old").unwrap();
    let names = || fs::read_dir(folder.path()).unwrap().count();
    let mut writer = TableWriter::create(&path, sample().schema()).unwrap();
    writer.write(&sample()).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    drop(writer);
    assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names()), ("old", 1));
    sample().write(&path).unwrap();
    assert!(fs::read_to_string(&path).unwrap().starts_with("particle,"));
    assert_eq!(names(), 1);
}

#[cfg(unix)]
#[test]
fn a_result_is_readable_like_any_new_file() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().unwrap();
    let (plain, path) = (folder.path().join("plain"), folder.path().join("out.csv"));
    fs::write(&plain, "").unwrap();
    sample().write(&path).unwrap();
    let mode = |p| fs::metadata(p).unwrap().permissions().mode();
    assert_eq!(mode(&path), mode(&plain));
}

#[test]
fn an_unknown_extension_names_the_known_ones() {
    for path in ["out.xlsx", "out", ".csv", "dir.csv/out.txt"] {
        let message = Format::from_path(path).unwrap_err().to_string();
        assert_eq!(
            message,
            format!("{path}: cannot tell the format from the extension; known are .csv, .parquet and .json")
        );
    }
    assert_eq!(Format::from_path("a.b/c.Parquet").unwrap(), Format::Parquet);
}

#[test]
fn a_missing_folder_is_an_error_with_the_path() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("no/such/out.csv");
    let error = sample().write(&path).unwrap_err();
    assert!(matches!(error, TableError::File { .. }), "{error:?}");
    assert!(error.to_string().contains("no/such/out.csv"), "{error}");
}

#[test]
fn a_stream_that_fails_is_an_error_in_every_format() {
    struct Full;
    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::Error::other("disk full"))
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    for format in [Format::Csv, Format::Json, Format::Parquet] {
        let result = TableWriter::to_stream(Full, format, sample().schema()).and_then(|mut writer| {
            writer.write(&sample())?;
            writer.finish_stream().map(|_| ())
        });
        assert!(result.unwrap_err().to_string().contains("disk full"), "{format:?}");
    }
}

#[test]
fn what_does_not_fit_together_is_refused() {
    let message = |result: Result<Table, TableError>| result.unwrap_err().to_string();
    let short = Table::new([Column::float("a", "", [1.0, 2.0]), Column::float("b", "", [1.0])]);
    assert_eq!(message(short), "column \"b\" has 1 rows, \"a\" has 2");
    let twice = Table::new([Column::float("a", "", [1.0]), Column::float("a", "", [1.0])]);
    assert_eq!(message(twice), "two columns are named \"a\"");

    let mut table = Table::with_schema(&[Field::count("n"), Field::text("wall")]).unwrap();
    assert!(table.push([Cell::from(1_u64)]).is_err());
    assert!(table.push([Cell::from(1_u64), Cell::from(2.0)]).is_err());
    assert_eq!(table.rows(), 0, "a refused row leaves no part of itself");
    assert!(table.columns().iter().all(|c| c.values.is_empty()));
    table.push([Cell::Missing, Cell::from("floor")]).unwrap();
    assert_eq!(table.rows(), 1);

    let mut writer = TableWriter::to_stream(Vec::new(), Format::Csv, vec![Field::float("x", "m")]).unwrap();
    let other = Table::new([Column::float("x", "mm", [1.0])]).unwrap();
    let error = writer.write(&other).unwrap_err().to_string();
    assert!(error.contains("\"mm\"") && error.contains("\"m\""), "{error}");
}

#[test]
fn text_is_aligned() {
    let table = Table::new([
        Column::text("fate", ["rebound", "capture"]),
        Column::float("diameter", "µm", [90.0, f64::NAN]),
        Column::float("e", "", [0.1 + 0.2, 1.0 / 3.0]),
    ])
    .unwrap();
    let want = "\
fate     diameter (µm)         e
-------  -------------  --------
rebound             90       0.3
capture              -  0.333333
";
    assert_eq!(table.to_text(), want);
}

#[test]
fn what_was_written_is_read_again_bit_for_bit_and_column_by_column() {
    let folder = tempfile::tempdir().unwrap();
    let schema =
        vec![Field::float("time", "s"), Field::text("wall"), Field::count("particle"), Field::integer("shift")];
    for name in ["table.csv", "table.parquet"] {
        let path = folder.path().join(name);
        let mut writer = TableWriter::create(&path, sample().schema()).unwrap();
        // several batches of CSV and two row groups
        let copies = 10_000;
        (0..copies).for_each(|_| writer.write(&sample()).unwrap());
        writer.finish().unwrap();
        let mut reader = TableReader::open(&path, schema.clone()).unwrap();
        let mut read = Table::with_schema(&schema).unwrap();
        while let Some(batch) = reader.next_batch().unwrap() {
            read.append(batch).unwrap();
        }
        assert_eq!(read.rows(), copies * NUMBERS.len(), "{name}");
        for field in &schema {
            let (written, read) = (sample().column(&field.name).unwrap().clone(), read.column(&field.name).unwrap());
            match (&written.values, &read.values) {
                (Values::Float(w), Values::Float(r)) => {
                    let bits = |v: &f64| if v.is_nan() { None } else { Some(v.to_bits()) };
                    assert!(r.iter().map(bits).eq(w.iter().cycle().take(r.len()).map(bits)), "{name}");
                }
                (Values::Text(w), Values::Text(r)) => assert!(r.iter().eq(w.iter().cycle().take(r.len())), "{name}"),
                (Values::Count(w), Values::Count(r)) => assert!(r.iter().eq(w.iter().cycle().take(r.len())), "{name}"),
                (Values::Integer(w), Values::Integer(r)) => {
                    assert!(r.iter().eq(w.iter().cycle().take(r.len())), "{name}")
                }
                _ => panic!("{name}: {} is of another kind", field.name),
            }
        }
    }
}

#[test]
fn a_file_of_something_else_is_refused_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["table.csv", "table.parquet"] {
        let path = folder.path().join(name);
        sample().write(&path).unwrap();
        let missing = TableReader::open(&path, vec![Field::float("speed", "m/s")]).err().unwrap().to_string();
        assert!(missing.contains(name) && missing.contains("no column \"speed\""), "{missing}");
        let mut reader = TableReader::open(&path, vec![Field::float("wall", "")]).unwrap();
        let kind = reader.next_batch().unwrap_err().to_string();
        assert!(kind.contains(name) && kind.contains("\"wall\""), "{kind}");
    }
    let torn = folder.path().join("torn.parquet");
    let bytes = fs::read(folder.path().join("table.parquet")).unwrap();
    fs::write(&torn, &bytes[..bytes.len() / 2]).unwrap();
    assert!(TableReader::open(&torn, sample().schema()).is_err());
    fs::write(folder.path().join("table.csv"), "particle,time\n1,0.5\n2,x\n").unwrap();
    let mut reader = TableReader::open(folder.path().join("table.csv"), vec![Field::float("time", "s")]).unwrap();
    let bad = reader.next_batch().unwrap_err().to_string();
    assert!(bad.contains("line 3: 'x' in column \"time\""), "{bad}");
}

#[test]
fn a_sample_is_the_same_rows_of_csv_and_parquet() {
    let folder = tempfile::tempdir().unwrap();
    let rows = 150_000_u64;
    let sampled = |name: &str, one_in: u64| {
        let path = folder.path().join(name);
        Table::new([Column::count("particle", 0..rows), Column::float("time", "s", (0..rows).map(|i| i as f64))])
            .unwrap()
            .write(&path)
            .unwrap();
        let mut reader = TableReader::open(&path, vec![Field::count("particle")]).unwrap().one_in(one_in);
        let mut taken: Vec<u64> = Vec::new();
        while let Some(batch) = reader.next_batch().unwrap() {
            let Values::Count(v) = &batch.columns()[0].values else { unreachable!() };
            taken.extend(v.iter().flatten());
        }
        taken
    };
    for one_in in [0, 1] {
        assert!(sampled("table.csv", one_in).into_iter().eq(0..rows));
    }
    let taken = sampled("table.csv", 7);
    assert!(taken == sampled("table.parquet", 7));
    // four standard errors of a binomial count; the even rows are half of them
    let count = |even: u64| taken.iter().filter(|i| *i % 2 == even).count() as f64;
    for even in [0, 1] {
        assert!((count(even) - 75_000.0 / 7.0).abs() < 4.0 * (75_000.0 * 6.0 / 49.0_f64).sqrt(), "{}", count(even));
    }
    assert!(sampled("table.parquet", 1_000_000_000).is_empty());
}
