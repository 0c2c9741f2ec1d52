//! Rows of CSV, written straight into bytes.
//!
//! Numbers have the shortest digits that read back to the same number; a missing one (NaN) is an empty field.

/// Rows under way.
#[derive(Default)]
pub(crate) struct Rows {
    bytes: Vec<u8>,
}

impl Rows {
    /// A whole number.
    pub fn count(&mut self, n: u64) {
        self.bytes.extend_from_slice(itoa::Buffer::new().format(n).as_bytes());
        self.bytes.push(b',');
    }

    /// A real number.
    pub fn float(&mut self, x: f64) {
        if x == 0.0 && x.is_sign_positive() {
            // much of a table of shares is zero
            self.bytes.extend_from_slice(b"0.0,");
            return;
        }
        if !x.is_nan() {
            self.bytes.extend_from_slice(zmij::Buffer::new().format(x).as_bytes());
        }
        self.bytes.push(b',');
    }

    /// A word that needs no quotes, or one made safe by [`quoted`].
    pub fn word(&mut self, word: &str) {
        self.bytes.extend_from_slice(word.as_bytes());
        self.bytes.push(b',');
    }

    /// Ends the row, which has fields.
    pub fn end(&mut self) {
        if let Some(last) = self.bytes.last_mut() {
            *last = b'\n';
        }
    }

    /// All rows.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

/// A text as a field: in quotes where it must be.
pub(crate) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_read_back_to_what_was_written() {
        let numbers = [0.0, -0.0, 1.0, 1e-5, 5e-324, f64::MAX, 1e16, 123_456_789.0, 2.0 / 3.0, f64::INFINITY, 1e22];
        let texts = ["plain", "a, b", "\"quoted\"", "two\nlines", "", " spaces ", "caf\u{e9}"];
        let mut rows = Rows::default();
        for text in texts {
            rows.count(u64::MAX);
            rows.word(&quoted(text));
            rows.word("one two");
            rows.word("");
            numbers.iter().for_each(|x| rows.float(*x));
            rows.float(f64::NAN);
            rows.end();
        }
        let bytes = rows.into_bytes();
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(bytes.as_slice());
        let read: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert_eq!(read.len(), texts.len());
        for (row, text) in read.iter().zip(texts) {
            assert_eq!([&row[0], &row[1], &row[2], &row[3]], ["18446744073709551615", text, "one two", ""]);
            for (field, number) in row.iter().skip(4).zip(numbers) {
                assert_eq!(field.parse::<f64>().map(f64::to_bits), Ok(number.to_bits()), "{field}");
            }
            assert_eq!(&row[4 + numbers.len()], "");
        }
    }
}
