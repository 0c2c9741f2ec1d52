//! Dictionaries: names with texts or dictionaries, read without copying; macros are looked up when a value is asked for.

use std::borrow::Cow;

use regex_lite::Regex;

use super::error::{Fault, fault};
use super::header::Format;
use super::scan::Scan;

/// Dictionaries lie in each other no deeper than this.
const DEPTH: usize = 32;
/// A macro names a macro no more often than this in a row.
const CHAIN: usize = 16;
/// Texts with macros in them are no longer than this, before and after.
const EXPANDED: usize = 1 << 16;

/// Names and what they stand for.
#[derive(Debug, Default)]
pub(super) struct Dict<'a> {
    entries: Vec<Entry<'a>>,
}

#[derive(Debug)]
struct Entry<'a> {
    at: usize,
    key: Key<'a>,
    value: Value<'a>,
}

#[derive(Debug)]
enum Key<'a> {
    Name(&'a [u8]),
    Pattern(Option<Regex>),
    /// The entries of another dictionary belong here, `$name;`.
    Include(&'a [u8]),
}

/// What a name stands for.
#[derive(Debug)]
pub(super) enum Value<'a> {
    Dict(Dict<'a>),
    Text(Text<'a>),
}

/// A text as it stands in the file, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Text<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

/// Dictionaries from the outermost to the one asked.
pub(super) type Scopes<'d, 'a> = [&'d Dict<'a>];

impl<'a> Dict<'a> {
    /// Reads entries until a bracket closes or the text ends.
    pub(super) fn read(scan: &mut Scan<'a>, format: Format) -> Result<Self, Fault> {
        Self::nested(scan, format, 0)
    }

    /// Reads the entries of a dictionary whose bracket has been opened.
    pub(super) fn within(scan: &mut Scan<'a>, format: Format) -> Result<Self, Fault> {
        Self::nested(scan, format, 1)
    }

    fn nested(scan: &mut Scan<'a>, format: Format, depth: usize) -> Result<Self, Fault> {
        if depth > DEPTH {
            return Err(scan.fault("dictionaries lie too deep in each other"));
        }
        let mut dict = Self::default();
        loop {
            let next = scan.peek();
            let at = scan.at;
            let key = match next {
                None if depth == 0 => return Ok(dict),
                None => return Err(scan.fault("a dictionary does not end")),
                Some(b'}') => {
                    scan.at += 1;
                    return Ok(dict);
                }
                Some(b';') => {
                    scan.at += 1;
                    continue;
                }
                Some(b'#') => {
                    directive(scan)?;
                    continue;
                }
                Some(b'$') => {
                    scan.at += 1;
                    let name = macro_name(scan);
                    scan.take(b';');
                    dict.entries.push(Entry { at, key: Key::Include(name), value: Value::Dict(Self::default()) });
                    continue;
                }
                Some(b'"') => Key::Pattern(pattern(scan.quoted()?)),
                Some(_) => Key::Name(scan.name()),
            };
            if matches!(key, Key::Name(b"")) {
                return Err(scan.fault(format!("a name expected, found {}", scan.shown())));
            }
            let value = if scan.take(b'{') {
                Value::Dict(Self::nested(scan, format, depth + 1)?)
            } else {
                Value::Text(text(scan, format)?)
            };
            dict.entries.push(Entry { at, key, value });
        }
    }

    /// What a name stands for: that of the last entry of this name, else of the last pattern that fits.
    pub(super) fn find<'d>(&'d self, name: &[u8], scopes: &Scopes<'d, 'a>) -> Option<&'d Value<'a>> {
        self.find_in_chain(name, scopes, 0)
    }

    fn find_in_chain<'d>(&'d self, name: &[u8], scopes: &Scopes<'d, 'a>, chain: usize) -> Option<&'d Value<'a>> {
        self.named(name, scopes, chain).or_else(|| self.fitting(name))
    }

    /// That of the last entry of this very name.
    pub(super) fn exact<'d>(&'d self, name: &[u8], scopes: &Scopes<'d, 'a>) -> Option<&'d Value<'a>> {
        self.named(name, scopes, 0)
    }

    fn named<'d>(&'d self, name: &[u8], scopes: &Scopes<'d, 'a>, chain: usize) -> Option<&'d Value<'a>> {
        self.entries.iter().rev().find_map(|e| match e.key {
            Key::Name(key) => (key == name).then_some(&e.value),
            Key::Include(other) if chain < CHAIN => match lookup(other, scopes, chain + 1)? {
                Value::Dict(dict) if !std::ptr::eq(dict, self) => dict.named(name, scopes, chain + 1),
                _ => None,
            },
            _ => None,
        })
    }

    /// That of the last pattern that fits a name.
    pub(super) fn fitting(&self, name: &[u8]) -> Option<&Value<'a>> {
        let name = std::str::from_utf8(name).ok()?;
        self.entries.iter().rev().find_map(|e| match &e.key {
            Key::Pattern(Some(pattern)) => pattern.is_match(name).then_some(&e.value),
            _ => None,
        })
    }

    /// The names, in order.
    pub(super) fn names(&self) -> impl DoubleEndedIterator<Item = &'a [u8]> {
        self.entries.iter().filter_map(|e| match e.key {
            Key::Name(name) => Some(name),
            _ => None,
        })
    }

    /// A text without macros, without its quotes.
    pub(super) fn text(&self, name: &str) -> Option<Cow<'a, str>> {
        match self.named(name.as_bytes(), &[], CHAIN)? {
            Value::Text(text) => Some(plain(text.bytes)),
            Value::Dict(_) => None,
        }
    }

    /// Where the first entry begins.
    pub(super) fn start(&self) -> usize {
        self.entries.first().map_or(0, |e| e.at)
    }
}

/// A text without its quotes.
pub(super) fn plain(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\"").and_then(|b| b.strip_suffix(b"\"")).unwrap_or(bytes);
    String::from_utf8_lossy(bytes)
}

/// A regular expression over whole names; none where it is not one.
fn pattern(text: &[u8]) -> Option<Regex> {
    let text = std::str::from_utf8(text).ok().filter(|t| t.len() < 1000)?;
    Regex::new(&format!("^(?:{text})$")).ok()
}

/// Steps over a directive. Those that change nothing here are let pass.
fn directive(scan: &mut Scan<'_>) -> Result<(), Fault> {
    let before = *scan;
    let word = scan.word();
    let line = scan.rest().iter().position(|b| *b == b'\n').unwrap_or(scan.left());
    let rest = String::from_utf8_lossy(&scan.rest()[..line]);
    scan.at += line;
    // entries of patches that are what they are by the mesh
    if word == b"#includeEtc" && rest.contains("setConstraintTypes") || word == b"#inputMode" {
        return Ok(());
    }
    let word = String::from_utf8_lossy(word);
    Err(before.fault(format!("`{word}` is not read: write the file out (foamDictionary -expand)")))
}

fn macro_name<'a>(scan: &mut Scan<'a>) -> &'a [u8] {
    let start = scan.at;
    if scan.rest().first() == Some(&b'{') {
        let len = scan.rest().iter().position(|b| *b == b'}').map_or(scan.left(), |i| i + 1);
        scan.at += len;
        return scan.span(start + 1..(scan.at - 1).max(start + 1));
    }
    let part = |b: &u8| b.is_ascii_alphanumeric() || b"_.:!^/-".contains(b) || !b.is_ascii();
    scan.at += scan.rest().iter().position(|b| !part(b)).unwrap_or(scan.left());
    scan.span(start..scan.at)
}

/// Takes a text up to its semicolon.
fn text<'a>(scan: &mut Scan<'a>, format: Format) -> Result<Text<'a>, Fault> {
    scan.space();
    let start = scan.at;
    let mut depth = 0_usize;
    loop {
        let Some(next) = scan.peek() else {
            return Err(fault(start, "an entry does not end with a semicolon"));
        };
        match next {
            b';' if depth == 0 => {
                let bytes = scan.span(start..scan.at).trim_ascii_end();
                scan.at += 1;
                return Ok(Text { bytes, at: start });
            }
            b'"' => drop(scan.quoted()?),
            b'(' | b'[' | b'{' => {
                scan.at += 1;
                depth += 1;
            }
            b')' | b']' | b'}' => {
                depth = depth.checked_sub(1).ok_or_else(|| scan.fault("a bracket closes that was not opened"))?;
                scan.at += 1;
            }
            b'#' if scan.rest().starts_with(b"#{") => {
                let end = scan.rest().windows(2).position(|w| w == b"#}");
                scan.at += 2 + end.ok_or_else(|| scan.fault("code does not end"))?;
            }
            b';' => scan.at += 1,
            _ => {
                let word = scan.word();
                if word.is_empty() {
                    scan.at += 1;
                } else if format.binary && word.starts_with(b"List<") {
                    binary_list(scan, word, format)?;
                }
            }
        }
    }
}

/// Steps over a binary list of items of one size.
fn binary_list(scan: &mut Scan<'_>, word: &[u8], format: Format) -> Result<(), Fault> {
    let size = match word {
        b"List<scalar>" | b"List<sphericalTensor>" => format.scalar,
        b"List<vector>" => 3 * format.scalar,
        b"List<symmTensor>" => 6 * format.scalar,
        b"List<tensor>" => 9 * format.scalar,
        b"List<label>" => format.label,
        b"List<bool>" | b"List<char>" => 1,
        _ => return Ok(()),
    };
    if !scan.peek().is_some_and(|b| b.is_ascii_digit()) {
        return Ok(());
    }
    let count = scan.count()?;
    if count > 0 && scan.peek() == Some(b'(') {
        super::list::block(scan, count.checked_mul(size))?;
    }
    Ok(())
}

/// What a macro's name stands for, seen from the innermost of the scopes.
fn lookup<'d, 'a>(name: &[u8], scopes: &Scopes<'d, 'a>, chain: usize) -> Option<&'d Value<'a>> {
    let split = |b: &u8| matches!(b, b'.' | b'/' | b':');
    let (scopes, rest, outward) = match name {
        [b':' | b'!' | b'^' | b'/', rest @ ..] => (scopes.get(..1)?, rest, false),
        [b'.', ..] => {
            // `..name` and `../name` are the dictionary one further out, `...name` and `../../name` two
            let lead = name.iter().take_while(|b| matches!(b, b'.' | b'/')).count();
            let (lead, rest) = name.split_at(lead);
            let slashes = lead.iter().filter(|b| **b == b'/').count();
            let up = if slashes > 0 { slashes } else { lead.len() - 1 };
            (scopes.get(..scopes.len().checked_sub(up)?)?, rest, false)
        }
        rest => (scopes, rest, true),
    };
    let mut parts = rest.split(split);
    let first = parts.next()?;
    let mut found = match outward {
        // a name that holds dots itself comes before a path of names
        true => innermost(rest, scopes, chain).or_else(|| {
            let found = innermost(first, scopes, chain)?;
            parts.clone().try_fold(found, |value, part| step(value, part, scopes, chain))
        })?,
        false => scopes.last()?.find_in_chain(first, scopes, chain)?,
    };
    if !outward {
        for part in parts {
            found = step(found, part, scopes, chain)?;
        }
    }
    Some(found)
}

/// What a name is in the innermost scope that has it; patterns, which fit many, come after the names of all.
fn innermost<'d, 'a>(name: &[u8], scopes: &Scopes<'d, 'a>, chain: usize) -> Option<&'d Value<'a>> {
    let named = scopes.iter().rev().find_map(|d| d.named(name, scopes, chain));
    named.or_else(|| scopes.iter().rev().find_map(|d| d.fitting(name)))
}

fn step<'d, 'a>(value: &'d Value<'a>, name: &[u8], scopes: &Scopes<'d, 'a>, chain: usize) -> Option<&'d Value<'a>> {
    match value {
        Value::Dict(dict) => dict.find_in_chain(name, scopes, chain),
        Value::Text(_) => None,
    }
}

/// A text with what its macros stand for. Lists are left as they are.
pub(super) fn expand<'a>(text: Text<'a>, scopes: &Scopes<'_, 'a>) -> Result<Cow<'a, [u8]>, Fault> {
    expanded(text, scopes, 0)
}

fn expanded<'a>(text: Text<'a>, scopes: &Scopes<'_, 'a>, chain: usize) -> Result<Cow<'a, [u8]>, Fault> {
    let bytes = text.bytes;
    if bytes.starts_with(b"nonuniform") || bytes.len() > EXPANDED || !bytes.contains(&b'$') {
        return Ok(Cow::Borrowed(bytes));
    }
    let mut out = Vec::new();
    let mut scan = Scan::new(bytes);
    while let Some(plain) = scan.rest().iter().position(|b| *b == b'$') {
        out.extend_from_slice(&scan.rest()[..plain]);
        scan.at += plain + 1;
        let name = macro_name(&mut scan);
        let shown = String::from_utf8_lossy(name);
        let value = match lookup(name, scopes, 0) {
            Some(Value::Text(value)) if chain < CHAIN => expanded(*value, scopes, chain + 1)?,
            Some(Value::Text(_)) => return Err(fault(text.at, format!("`${shown}` goes round in a circle"))),
            Some(Value::Dict(_)) => return Err(fault(text.at, format!("`${shown}` is a dictionary"))),
            None => return Err(fault(text.at, format!("`${shown}` stands for nothing"))),
        };
        if plain == 0 && out.is_empty() && scan.left() == 0 {
            return Ok(value);
        }
        if out.len() + value.len() > EXPANDED {
            return Err(fault(text.at, "too long with its macros written out"));
        }
        out.extend_from_slice(&value);
    }
    out.extend_from_slice(scan.rest());
    Ok(Cow::Owned(out))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASCII: Format = Format { binary: false, label: 4, scalar: 8 };

    fn dict(text: &str) -> Dict<'_> {
        Dict::read(&mut Scan::new(text.as_bytes()), ASCII).unwrap()
    }

    fn value(dict: &Dict<'_>, path: &str) -> String {
        let mut scopes = vec![dict];
        let (dicts, key) = path.rsplit_once('/').map_or((vec![], path), |(d, k)| (d.split('/').collect(), k));
        for name in dicts {
            match scopes.last().unwrap().find(name.as_bytes(), &scopes).unwrap() {
                Value::Dict(d) => scopes.push(d),
                Value::Text(_) => panic!("{name}"),
            }
        }
        match scopes.last().unwrap().find(key.as_bytes(), &scopes) {
            Some(Value::Text(t)) => {
                expand(*t, &scopes).map_or_else(|f| f.what, |b| String::from_utf8(b.into_owned()).unwrap())
            }
            other => format!("{other:?}"),
        }
    }

    #[test]
    fn macros_are_looked_up_outward_upward_and_from_the_top() {
        let d = dict(
            "x 1; v (1 $x 3); a { x 2; y $x; up $..x; top $:x; b { x 3; z $x; up $..x; upup $...x; of ../x; f $../x; g $../../x; } }
             c { $a; y 5; } path ${a.b.x}; u uniform $v; self $self; no $nothing; is $a;",
        );
        for (path, expected) in [
            ("v", "(1 1 3)"),
            ("a/y", "2"),
            ("a/up", "1"),
            ("a/top", "1"),
            ("a/b/z", "3"),
            ("a/b/up", "2"),
            ("a/b/upup", "1"),
            ("a/b/f", "2"),
            ("a/b/g", "1"),
            ("c/x", "2"),
            ("c/y", "5"),
            ("path", "3"),
            ("u", "uniform (1 1 3)"),
            ("self", "`$self` goes round in a circle"),
            ("no", "`$nothing` stands for nothing"),
            ("is", "`$a` is a dictionary"),
        ] {
            assert_eq!(value(&d, path), expected, "{path}");
        }
    }

    #[test]
    fn names_come_before_patterns_and_later_ones_first() {
        let d = dict(r#"".*" 0; "w.*" 1; wall 2; "(a|b)" 3; wall 4; "[" 5;"#);
        assert_eq!(["wall", "wind", "b", "ab"].map(|k| value(&d, k)), ["4", "1", "3", "0"]);
    }

    #[test]
    fn code_texts_and_brackets_end_where_they_end() {
        let d = dict(
            r#"a "x;y"; code #{ f(); } #}; t ((0 (1;2)) // c ;
            3); dims [0 1 -1]; e; { } "#
                .trim_end_matches("{ } "),
        );
        assert_eq!(d.text("a").unwrap(), "x;y");
        assert_eq!(value(&d, "dims"), "[0 1 -1]");
        assert_eq!(value(&d, "e"), "");
        assert_eq!(d.names().count(), 5);
    }

    #[test]
    fn what_is_broken_is_refused() {
        let deep = "a {".repeat(1000);
        for bad in ["a 1", "a { b 1;", "a (1;", "a 1); ", "{ }", "#include \"x\"\n", "\"a 1;", "a #{ 1;", &deep] {
            assert!(Dict::read(&mut Scan::new(bad.as_bytes()), ASCII).is_err(), "{bad:.20}");
        }
        // no name has an end in macros that name macros
        let mut bomb = "m0 0123456789;".to_owned();
        (0..12).for_each(|i| bomb += &format!("m{} $m{i} $m{i} $m{i} $m{i} $m{i} $m{i} $m{i} $m{i};", i + 1));
        assert_eq!(value(&dict(&bomb), "m12"), "too long with its macros written out");
        let round = dict("a { $b; } b { $a; }");
        assert!(matches!(round.find(b"a", &[&round]), Some(Value::Dict(a)) if a.find(b"x", &[&round, a]).is_none()));
    }
}
