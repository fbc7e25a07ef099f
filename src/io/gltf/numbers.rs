//! Reads the numbers of glTF accessors from the buffers, each within its bounds.

use glam::DVec3;
use gltf::Accessor;
use gltf::accessor::{DataType, sparse::Sparse};
use gltf::buffer::View;

use super::{GltfError, fault};
use crate::geometry::words::words;
use crate::io::Limits;

/// Largest number of values of one accessor.
const MOST: usize = 100_000_000;

/// The buffers of a file.
pub struct Numbers<'a> {
    pub buffers: &'a [Vec<u8>],
}

impl Numbers<'_> {
    /// Vectors of finite numbers, with coordinates within [`Limits`].
    pub fn vectors(&self, accessor: &Accessor<'_>) -> Result<Vec<DVec3>, GltfError> {
        let most = Limits::default().vertices;
        if accessor.count() > most {
            return Err(GltfError::OverLimit(words!("more than {most} vertices", most)));
        }
        let vectors: Vec<DVec3> = self.floats::<3>(accessor)?.into_iter().map(DVec3::from_array).collect();
        let largest = Limits::default().coordinate;
        match vectors.iter().all(|v| v.abs().max_element() <= largest) {
            true => Ok(vectors),
            false => Err(fault(words!("a coordinate is more than {most}", most = largest))),
        }
    }

    /// Finite numbers in groups of `N`. Normalised integers become fractions in -1..=1 or 0..=1.
    pub fn floats<const N: usize>(&self, accessor: &Accessor<'_>) -> Result<Vec<[f64; N]>, GltfError> {
        let normalised = accessor.normalized();
        let whole = |value: f64, largest: f64| if normalised { (value / largest).max(-1.0) } else { value };
        let numbers = self.elements::<N, f64>(accessor, |kind, bytes| match (kind, bytes) {
            (DataType::F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            (DataType::U8, &[a]) => whole(f64::from(a), 255.0),
            (DataType::I8, &[a]) => whole(f64::from(a as i8), 127.0),
            (DataType::U16, &[a, b]) => whole(f64::from(u16::from_le_bytes([a, b])), 65535.0),
            (DataType::I16, &[a, b]) => whole(f64::from(i16::from_le_bytes([a, b])), 32767.0),
            _ => f64::NAN,
        })?;
        match numbers.iter().flatten().all(|x| x.is_finite()) {
            true => Ok(numbers),
            false => Err(fault(words!("accessor {n} holds what is no number", n = accessor.index()))),
        }
    }

    /// Unsigned integers in groups of `N`.
    pub fn integers<const N: usize>(&self, accessor: &Accessor<'_>) -> Result<Vec<[u32; N]>, GltfError> {
        if !matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32) {
            return Err(fault(words!("accessor {n} does not hold whole numbers", n = accessor.index())));
        }
        self.elements::<N, u32>(accessor, |_, bytes| match *bytes {
            [a] => u32::from(a),
            [a, b] => u32::from(u16::from_le_bytes([a, b])),
            [a, b, c, d] => u32::from_le_bytes([a, b, c, d]),
            _ => 0,
        })
    }

    fn elements<const N: usize, T: Copy + Default>(
        &self,
        accessor: &Accessor<'_>,
        number: impl Fn(DataType, &[u8]) -> T,
    ) -> Result<Vec<[T; N]>, GltfError> {
        let n = accessor.index();
        let dimensions = accessor.dimensions().multiplicity();
        if dimensions != N {
            return Err(fault(words!(
                "accessor {n} holds {dimensions} numbers at a time, not {expected}",
                n,
                dimensions,
                expected = N
            )));
        }
        let count = accessor.count();
        if count.saturating_mul(N) > MOST {
            return Err(GltfError::OverLimit(words!(
                "accessor {n} holds more than {most} numbers",
                n,
                most = MOST
            )));
        }
        let kind = accessor.data_type();
        let size = kind.size();
        let element = |bytes: &[u8]| {
            let mut all = [T::default(); N];
            let each = all.iter_mut().zip(bytes.chunks_exact(size));
            each.for_each(|(slot, bytes)| *slot = number(kind, bytes));
            all
        };
        let outside = || fault(words!("accessor {n} reaches beyond its buffer", n));
        let mut elements = match accessor.view() {
            Some(view) => {
                let rows = self.rows(view, accessor.offset(), size * N, count).ok_or_else(outside)?;
                rows.map(element).collect()
            }
            None => vec![[T::default(); N]; count],
        };
        if let Some(sparse) = accessor.sparse() {
            let (places, values) = self.replaced(&sparse, size * N).ok_or_else(outside)?;
            let mut before = None;
            for (at, value) in places.zip(values) {
                let slot = elements.get_mut(at).filter(|_| before < Some(at));
                let words = || {
                    words!(
                        "accessor {n}: the places of its sparse values do not rise below {count}",
                        n,
                        count
                    )
                };
                *slot.ok_or_else(|| fault(words()))? = element(value);
                before = Some(at);
            }
        }
        Ok(elements)
    }

    /// Indices of the elements that a sparse accessor replaces, and their new values of `size` bytes each.
    fn replaced(
        &self,
        sparse: &Sparse<'_>,
        size: usize,
    ) -> Option<(impl Iterator<Item = usize>, impl Iterator<Item = &[u8]>)> {
        let (places, values) = (sparse.indices(), sparse.values());
        let bytes = self.rows(places.view(), places.offset(), places.index_type().size(), sparse.count())?;
        let whole = |bytes: &[u8]| bytes.iter().rev().fold(0, |sum, &byte| sum << 8 | usize::from(byte));
        Some((bytes.map(whole), self.rows(values.view(), values.offset(), size, sparse.count())?))
    }

    /// `count` rows of `size` bytes in `view`, starting at `offset`; None where they reach beyond the view or its buffer.
    fn rows(
        &self,
        view: View<'_>,
        offset: usize,
        size: usize,
        count: usize,
    ) -> Option<impl Iterator<Item = &[u8]>> {
        let buffer = self.buffers.get(view.buffer().index())?;
        let bytes = buffer.get(view.offset()..view.offset().checked_add(view.length())?)?;
        let stride = view.stride().unwrap_or(size);
        if let Some(last) = count.checked_sub(1) {
            let end = last.checked_mul(stride)?.checked_add(offset)?.checked_add(size)?;
            bytes.get(..end)?;
        }
        let start = move |i: usize| i * stride + offset;
        Some((0..count).map(move |i| &bytes[start(i)..start(i) + size]))
    }
}
