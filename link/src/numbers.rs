//! Arrays whose length is a parameter, on the wire: one entry after the other, without their number,
//! which both ends know.

use core::marker::PhantomData;
use heapless::Vec;
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeTuple, Serializer};

pub fn serialize<S: Serializer, T: Serialize, const N: usize>(
    entries: &[T; N],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut tuple = serializer.serialize_tuple(N)?;
    entries.iter().try_for_each(|entry| tuple.serialize_element(entry))?;
    tuple.end()
}

pub fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    deserializer: D,
) -> Result<[T; N], D::Error> {
    deserializer.deserialize_tuple(N, Entries(PhantomData))
}

struct Entries<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Entries<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{N} entries")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<[T; N], A::Error> {
        let mut entries = Vec::<T, N>::new();
        while let Some(entry) = sequence.next_element()? {
            entries.push(entry).map_err(|_| A::Error::invalid_length(N + 1, &self))?;
        }
        entries.into_array().map_err(|short| A::Error::invalid_length(short.len(), &self))
    }
}
