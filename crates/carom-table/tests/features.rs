//! A format that a build was made without is refused by name, and nothing is written.

use carom_table::{Column, Format, Table};

#[test]
fn parquet_is_written_or_refused_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("t.parquet");
    let table = Table::new([Column::count("n", [1, 2])]).expect("a table");
    let written = table.write(&path);
    assert_eq!(written.is_ok(), Format::Parquet.is_built());
    assert_eq!(path.exists(), Format::Parquet.is_built());
    if let Err(error) = written {
        let error = error.to_string();
        assert!(error.ends_with("this build writes no Parquet; build it with the feature `parquet`"), "{error}");
        assert!(carom_table::to_parquet(&table).is_err());
    }
    table.write(folder.path().join("t.csv")).expect("always there");
}
