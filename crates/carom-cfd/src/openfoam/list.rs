//! Lists of numbers, ASCII and binary.

use super::error::Fault;
use super::header::Format;
use super::scan::Scan;
use crate::Polygons;

/// What lists are made of.
pub(super) trait Item: Copy {
    /// Bytes of one in a binary list.
    fn size(format: Format) -> usize;
    /// One, from as many bytes.
    fn decode(bytes: &[u8], format: Format) -> Self;
    /// One, from text.
    fn read(scan: &mut Scan<'_>) -> Result<Self, Fault>;
}

fn real(bytes: &[u8]) -> f64 {
    match *bytes {
        [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
        [a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => f64::NAN,
    }
}

impl Item for i64 {
    fn size(format: Format) -> usize {
        format.label
    }

    fn decode(bytes: &[u8], _: Format) -> Self {
        match *bytes {
            [a, b, c, d] => Self::from(i32::from_le_bytes([a, b, c, d])),
            [a, b, c, d, e, f, g, h] => Self::from_le_bytes([a, b, c, d, e, f, g, h]),
            _ => -1,
        }
    }

    fn read(scan: &mut Scan<'_>) -> Result<Self, Fault> {
        scan.integer()
    }
}

/// A number of something, which is not negative; what does not fit is [`u32::MAX`], out of every range.
impl Item for u32 {
    fn size(format: Format) -> usize {
        format.label
    }

    fn decode(bytes: &[u8], format: Format) -> Self {
        Self::try_from(i64::decode(bytes, format)).unwrap_or(Self::MAX)
    }

    fn read(scan: &mut Scan<'_>) -> Result<Self, Fault> {
        let before = *scan;
        let value = scan.integer()?;
        Self::try_from(value).map_err(|_| before.fault(format!("{value} is out of range")))
    }
}

impl Item for [f64; 1] {
    fn size(format: Format) -> usize {
        format.scalar
    }

    fn decode(bytes: &[u8], _: Format) -> Self {
        [real(bytes)]
    }

    fn read(scan: &mut Scan<'_>) -> Result<Self, Fault> {
        Ok([scan.number()?])
    }
}

impl Item for [f64; 3] {
    fn size(format: Format) -> usize {
        3 * format.scalar
    }

    fn decode(bytes: &[u8], format: Format) -> Self {
        let s = format.scalar;
        [real(&bytes[..s]), real(&bytes[s..2 * s]), real(&bytes[2 * s..3 * s])]
    }

    fn read(scan: &mut Scan<'_>) -> Result<Self, Fault> {
        scan.expect(b'(')?;
        let v = [scan.number()?, scan.number()?, scan.number()?];
        scan.expect(b')')?;
        Ok(v)
    }
}

/// Reads a list. No more room is taken than its bytes can fill; one value for all is taken for `most` of them at most.
pub(super) fn list<T: Item>(scan: &mut Scan<'_>, format: Format, most: usize) -> Result<Vec<T>, Fault> {
    let start = *scan;
    let count = if scan.peek() == Some(b'(') { None } else { Some(scan.count()?) };
    match scan.peek() {
        Some(b'{') => {
            let count = count.unwrap_or(0);
            if count > most {
                return Err(start.fault(format!("{count} equal values where {most} are due at most")));
            }
            scan.at += 1;
            let value = T::read(scan)?;
            scan.expect(b'}')?;
            Ok(vec![value; count])
        }
        // an empty list in binary has no brackets
        next if count == Some(0) && next != Some(b'(') => Ok(Vec::new()),
        _ if count == Some(0) || !format.binary => ascii(scan, count),
        _ => binary(scan, format, count),
    }
}

fn ascii<T: Item>(scan: &mut Scan<'_>, count: Option<usize>) -> Result<Vec<T>, Fault> {
    let start = *scan;
    scan.expect(b'(')?;
    // an item has a digit and a space at least
    let mut items = Vec::with_capacity(count.unwrap_or(0).min(scan.left() / 2 + 1));
    while !scan.take(b')') {
        if count.is_some_and(|count| items.len() == count) {
            return Err(scan.fault(format!("a list of {} goes on", items.len())));
        }
        items.push(T::read(scan)?);
    }
    match count {
        Some(count) if count != items.len() => {
            Err(start.fault(format!("a list of {count} ends after {}", items.len())))
        }
        _ => Ok(items),
    }
}

fn binary<T: Item>(scan: &mut Scan<'_>, format: Format, count: Option<usize>) -> Result<Vec<T>, Fault> {
    let Some(count) = count else {
        return Err(scan.fault("a binary list begins with its length"));
    };
    let bytes = block(scan, count.checked_mul(T::size(format)))?;
    Ok(bytes.chunks_exact(T::size(format)).map(|b| T::decode(b, format)).collect())
}

/// Bytes in brackets.
pub(super) fn block<'a>(scan: &mut Scan<'a>, len: Option<usize>) -> Result<&'a [u8], Fault> {
    scan.expect(b'(')?;
    let bytes = scan.raw(len)?;
    if scan.rest().first() != Some(&b')') {
        return Err(scan.fault("a binary list does not end where its length says (other sizes of numbers?)"));
    }
    scan.at += 1;
    Ok(bytes)
}

/// Reads faces: a list of lists (`faceList`), or where each begins and all their corners (`faceCompactList`).
pub(super) fn faces(scan: &mut Scan<'_>, format: Format, compact: bool) -> Result<Polygons, Fault> {
    if compact {
        let start = *scan;
        let mut starts: Vec<u32> = list(scan, format, 0)?;
        let corners: Vec<u32> = list(scan, format, 0)?;
        if starts.is_empty() {
            starts.push(0);
        }
        let ordered = starts[0] == 0 && starts.is_sorted() && *starts.last().unwrap_or(&0) as usize == corners.len();
        return if ordered {
            Ok(Polygons { starts, corners })
        } else {
            Err(start.fault("faces do not follow each other"))
        };
    }
    let count = scan.count()?;
    let mut faces = Polygons { starts: Vec::with_capacity(count.min(scan.left()) + 1), corners: Vec::new() };
    faces.starts.push(0);
    if count == 0 && scan.peek() != Some(b'(') {
        return Ok(faces);
    }
    // most faces have three or four corners of some digits
    faces.corners.reserve(count.saturating_mul(4).min(scan.left() / 2));
    scan.expect(b'(')?;
    for _ in 0..count {
        let corners = if scan.peek() == Some(b'(') { None } else { Some(scan.count()?) };
        if format.binary {
            let bytes = block(scan, corners.and_then(|n| n.checked_mul(format.label)))?;
            faces.corners.extend(bytes.chunks_exact(format.label).map(|b| u32::decode(b, format)));
        } else {
            scan.expect(b'(')?;
            let before = faces.corners.len();
            while !scan.take(b')') {
                faces.corners.push(u32::read(scan)?);
            }
            if corners.is_some_and(|n| n != faces.corners.len() - before) {
                return Err(scan.fault("a face has not as many corners as it says"));
            }
        }
        faces.starts.push(u32::try_from(faces.corners.len()).map_err(|_| scan.fault("too many corners of faces"))?);
    }
    scan.expect(b')')?;
    Ok(faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASCII: Format = Format { binary: false, label: 4, scalar: 8 };

    fn read<T: Item>(bytes: &[u8], format: Format) -> Result<Vec<T>, Fault> {
        list(&mut Scan::new(bytes), format, 5)
    }

    #[test]
    fn lists_in_every_way_of_writing() {
        assert_eq!(read::<u32>(b"3(1 2 3)", ASCII).unwrap(), [1, 2, 3]);
        assert_eq!(read::<u32>(b"\n2\n(\n1 // one\n2\n)\n", ASCII).unwrap(), [1, 2]);
        assert_eq!(read::<u32>(b"(4 5)", ASCII).unwrap(), [4, 5]);
        assert_eq!(read::<[f64; 1]>(b"4{2.5}", ASCII).unwrap(), [[2.5]; 4]);
        assert_eq!(read::<[f64; 3]>(b"2((1 2 3)(4 5 6))", ASCII).unwrap(), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        for empty in [b"0()".as_slice(), b"0", b"0;", b"()"] {
            assert!(read::<u32>(empty, ASCII).unwrap().is_empty());
        }
        for (label, scalar) in [(4, 4), (4, 8), (8, 4), (8, 8)] {
            let format = Format { binary: true, label, scalar };
            let mut bytes = b"2\n(".to_vec();
            for v in [7_i64, 40] {
                bytes.extend(&v.to_le_bytes()[..label]);
            }
            bytes.extend(b") 1\n(");
            for v in [0.5_f64, -2.0, 1.25] {
                match scalar {
                    4 => bytes.extend((v as f32).to_le_bytes()),
                    _ => bytes.extend(v.to_le_bytes()),
                }
            }
            bytes.extend(b")");
            let mut scan = Scan::new(&bytes);
            assert_eq!(list::<u32>(&mut scan, format, 0).unwrap(), [7, 40]);
            assert_eq!(list::<[f64; 3]>(&mut scan, format, 0).unwrap(), [[0.5, -2.0, 1.25]]);
            assert_eq!(scan.left(), 0);
        }
    }

    #[test]
    fn lists_that_are_not_what_they_say_are_refused() {
        let binary = Format { binary: true, ..ASCII };
        for bad in
            [b"3(1 2)".as_slice(), b"1(1 2)", b"2(1 x)", b"2(1 2", b"-1()", b"9{1}", b"2(1 -2)", b"1(5000000000)"]
        {
            assert!(read::<u32>(bad, ASCII).is_err(), "{}", String::from_utf8_lossy(bad));
        }
        for bad in [b"999999999999999999(abc)".as_slice(), b"1(abcde)", b"1(abcd", b"1(ab", b"(abcd)"] {
            assert!(read::<u32>(bad, binary).is_err(), "{}", String::from_utf8_lossy(bad));
        }
    }

    #[test]
    fn faces_in_every_way_of_writing() {
        let expected = Polygons { starts: vec![0, 3, 7], corners: vec![0, 1, 2, 3, 4, 5, 6] };
        let f = |bytes: &[u8], format, compact| faces(&mut Scan::new(bytes), format, compact);
        assert_eq!(f(b"2\n(\n3(0 1 2)\n4(3 4 5 6)\n)", ASCII, false).unwrap(), expected);
        assert_eq!(f(b"3(0 3 7) 7(0 1 2 3 4 5 6)", ASCII, true).unwrap(), expected);
        let binary = Format { binary: true, ..ASCII };
        let mut bytes = b"2(3\n(".to_vec();
        (0..3_i32).for_each(|i| bytes.extend(i.to_le_bytes()));
        bytes.extend(b")\n4\n(");
        (3..7_i32).for_each(|i| bytes.extend(i.to_le_bytes()));
        bytes.extend(b"))");
        assert_eq!(f(&bytes, binary, false).unwrap(), expected);
        for bad in [b"3(0 8 7) 7(0 1 2 3 4 5 6)".as_slice(), b"2(0 3) 7(0 1 2 3 4 5 6)", b"2(1 2) 2(1 2)"] {
            assert!(f(bad, ASCII, true).is_err());
        }
        for bad in [b"2(3(0 1 2))".as_slice(), b"1(4(0 1 2))", b"1(3(0 1 2)", b"99999999999(3(0 1 2))"] {
            assert!(f(bad, ASCII, false).is_err());
        }
    }
}
