//! How and when a report was made.

use std::fmt;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// The line at the head of a report.
pub struct Made {
    /// Seconds since 1970, UTC.
    at: u64,
    command: String,
    took: Option<Duration>,
}

impl Made {
    /// By this command, now or when SOURCE_DATE_EPOCH says; `took` is how long the run did.
    pub fn now(took: Option<Duration>) -> Self {
        let fixed = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|s| s.trim().parse().ok());
        let now = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
        let words = std::env::args_os().skip(1).map(|word| quoted(&word.to_string_lossy()));
        let command = std::iter::once("carom".to_owned()).chain(words).collect::<Vec<_>>().join(" ");
        Self { at: fixed.unwrap_or_else(now), command, took }
    }
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,+%@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

impl fmt::Display for Made {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (days, seconds) = (self.at / 86_400, self.at % 86_400);
        let [year, month, day] = date(days);
        let (hour, minute) = (seconds / 3600, seconds / 60 % 60);
        write!(f, "carom {}, {year}-{month:02}-{day:02} {hour:02}:{minute:02} UTC", env!("CARGO_PKG_VERSION"))?;
        match self.took.map(|t| t.as_secs_f64()) {
            Some(s) if s < 1.0 => write!(f, ", run in {:.0} ms", (1e3 * s).max(1.0))?,
            Some(s) if s < 120.0 => write!(f, ", run in {s:.1} s")?,
            Some(s) if s < 7200.0 => write!(f, ", run in {:.0} min", s / 60.0)?,
            Some(s) => write!(f, ", run in {:.1} h", s / 3600.0)?,
            None => {}
        }
        write!(f, ": {}", self.command)
    }
}

/// Year, month and day so many days after 1970-01-01.
fn date(mut days: u64) -> [u64; 3] {
    let leap = |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    // the calendar repeats every 400 years
    let mut year = 1970 + 400 * (days / 146_097);
    days %= 146_097;
    while days >= 365 + u64::from(leap(year)) {
        days -= 365 + u64::from(leap(year));
        year += 1;
    }
    let lengths = [31, 28 + u64::from(leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut month = 1;
    for length in lengths {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    [year, month, days + 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_dates_and_words_are_quoted() {
        assert_eq!(date(0), [1970, 1, 1]);
        assert_eq!(date(11_016), [2000, 2, 29]);
        assert_eq!(date(20_783), [2026, 11, 26]);
        assert_eq!(date(20_818), [2026, 12, 31]);
        assert_eq!([quoted("a.toml"), quoted("it's so"), quoted("")], ["a.toml", "'it'\\''s so'", "''"]);
        let made = Made {
            at: 86_400 * 59 + 3_660,
            command: "carom run a.toml".to_owned(),
            took: Some(Duration::from_millis(4_230)),
        };
        let version = env!("CARGO_PKG_VERSION");
        assert_eq!(made.to_string(), format!("carom {version}, 1970-03-01 01:01 UTC, run in 4.2 s: carom run a.toml"));
    }
}
