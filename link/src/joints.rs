//! Entries of a robot's joints: an array with room for more.
//!
//! A target has room for its own joints. A host that is compiled for all robots has room for the largest, and
//! both write the same bytes: the number of entries, then the entries.

use core::ops::{Deref, DerefMut};
use heapless::Vec;
use serde::de::{Deserialize, Deserializer};
use serde::ser::{Serialize, Serializer};

/// Up to `MOST` entries, one a joint.
#[derive(Clone, Copy)]
pub struct Joints<T, const MOST: usize> {
    /// Those from `count` on mean nothing.
    entries: [T; MOST],
    count: usize,
}

impl<T: Copy, const MOST: usize> Joints<T, MOST> {
    /// The first of `entries`, and no more than there is room for.
    pub fn new(entries: [T; MOST], count: usize) -> Self {
        Self { entries, count: if count < MOST { count } else { MOST } }
    }
}

impl<T, const MOST: usize> From<[T; MOST]> for Joints<T, MOST> {
    fn from(entries: [T; MOST]) -> Self {
        Self { entries, count: MOST }
    }
}

impl<T, const MOST: usize> Deref for Joints<T, MOST> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        self.entries.get(..self.count).unwrap_or(&self.entries)
    }
}

impl<T, const MOST: usize> DerefMut for Joints<T, MOST> {
    fn deref_mut(&mut self) -> &mut [T] {
        let count = if self.count < MOST { self.count } else { MOST };
        self.entries.split_at_mut(count).0
    }
}

impl<'a, T, const MOST: usize> IntoIterator for &'a Joints<T, MOST> {
    type Item = &'a T;
    type IntoIter = core::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<T: PartialEq, const MOST: usize> PartialEq for Joints<T, MOST> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: core::fmt::Debug, const MOST: usize> core::fmt::Debug for Joints<T, MOST> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        (**self).fmt(f)
    }
}

impl<T: Serialize, const MOST: usize> Serialize for Joints<T, MOST> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de, T: Copy + Default + Deserialize<'de>, const MOST: usize> Deserialize<'de>
    for Joints<T, MOST>
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let given = Vec::<T, MOST>::deserialize(deserializer)?;
        let mut entries = [T::default(); MOST];
        entries.iter_mut().zip(&given).for_each(|(to, from)| *to = *from);
        Ok(Self { entries, count: given.len() })
    }
}
