//! Numbers as VTK files store them.

/// A number that stored ones become.
pub trait Number: Copy {
    /// From a text.
    fn parsed(word: &str) -> Option<Self>;
    /// From a real number.
    fn real(x: f64) -> Self;
    /// From a whole number.
    fn whole(n: i64) -> Self;
    /// From a whole number that is not negative.
    fn natural(n: u64) -> Self;
}

impl Number for f64 {
    fn parsed(word: &str) -> Option<Self> {
        word.parse().ok()
    }

    fn real(x: f64) -> Self {
        x
    }

    fn whole(n: i64) -> Self {
        n as Self
    }

    fn natural(n: u64) -> Self {
        n as Self
    }
}

impl Number for i64 {
    fn parsed(word: &str) -> Option<Self> {
        word.parse().ok()
    }

    fn real(x: f64) -> Self {
        x as Self
    }

    fn whole(n: i64) -> Self {
        n
    }

    fn natural(n: u64) -> Self {
        n.try_into().unwrap_or(Self::MAX)
    }
}

/// Numbers of points and places in lists: what does not fit is [`u32::MAX`], which is out of every range.
impl Number for u32 {
    fn parsed(word: &str) -> Option<Self> {
        word.parse().ok().map(Self::whole)
    }

    fn real(x: f64) -> Self {
        Self::whole(x as i64)
    }

    fn whole(n: i64) -> Self {
        n.try_into().unwrap_or(Self::MAX)
    }

    fn natural(n: u64) -> Self {
        n.try_into().unwrap_or(Self::MAX)
    }
}

impl Number for u8 {
    fn parsed(word: &str) -> Option<Self> {
        word.parse().ok()
    }

    fn real(x: f64) -> Self {
        x as Self
    }

    fn whole(n: i64) -> Self {
        n as Self
    }

    fn natural(n: u64) -> Self {
        n as Self
    }
}

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// 64-bit floating point.
    F64,
    /// 32-bit floating point.
    F32,
    /// Signed, 64 bits.
    I64,
    /// Unsigned, 64 bits.
    U64,
    /// Signed, 32 bits.
    I32,
    /// Unsigned, 32 bits.
    U32,
    /// Signed, 16 bits.
    I16,
    /// Unsigned, 16 bits.
    U16,
    /// Signed, 8 bits.
    I8,
    /// Unsigned, 8 bits.
    U8,
}

impl Stored {
    /// By its name in XML.
    pub fn xml(name: &str) -> Option<Self> {
        Some(match name {
            "Float64" => Self::F64,
            "Float32" => Self::F32,
            "Int64" => Self::I64,
            "UInt64" => Self::U64,
            "Int32" => Self::I32,
            "UInt32" => Self::U32,
            "Int16" => Self::I16,
            "UInt16" => Self::U16,
            "Int8" => Self::I8,
            "UInt8" => Self::U8,
            _ => return None,
        })
    }

    /// By its name in a legacy file.
    pub fn legacy(name: &str) -> Option<Self> {
        Some(match name.to_ascii_lowercase().as_str() {
            "double" => Self::F64,
            "float" => Self::F32,
            "long" | "vtktypeint64" => Self::I64,
            "unsigned_long" | "vtktypeuint64" => Self::U64,
            // VTK writes its ids as int, however wide they are in memory
            "int" | "vtkidtype" => Self::I32,
            "unsigned_int" => Self::U32,
            "short" => Self::I16,
            "unsigned_short" => Self::U16,
            "char" | "signed_char" => Self::I8,
            "unsigned_char" => Self::U8,
            _ => return None,
        })
    }

    /// Bytes of a number.
    pub fn width(self) -> usize {
        match self {
            Self::F64 | Self::I64 | Self::U64 => 8,
            Self::F32 | Self::I32 | Self::U32 => 4,
            Self::I16 | Self::U16 => 2,
            Self::I8 | Self::U8 => 1,
        }
    }

    /// The numbers that bytes hold.
    pub fn decode<T: Number>(self, bytes: &[u8], big_endian: bool) -> Vec<T> {
        macro_rules! take {
            ($type:ty, $to:ident, $as:ty) => {
                if big_endian {
                    take(bytes, |b| T::$to(<$as>::from(<$type>::from_be_bytes(b))))
                } else {
                    take(bytes, |b| T::$to(<$as>::from(<$type>::from_le_bytes(b))))
                }
            };
        }
        match self {
            Self::F64 => take!(f64, real, f64),
            Self::F32 => take!(f32, real, f64),
            Self::I64 => take!(i64, whole, i64),
            Self::U64 => take!(u64, natural, u64),
            Self::I32 => take!(i32, whole, i64),
            Self::U32 => take!(u32, natural, u64),
            Self::I16 => take!(i16, whole, i64),
            Self::U16 => take!(u16, natural, u64),
            Self::I8 => take!(i8, whole, i64),
            Self::U8 => take!(u8, natural, u64),
        }
    }
}

fn take<T, const N: usize>(bytes: &[u8], number: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.as_chunks::<N>().0.iter().map(|b| number(*b)).collect()
}
