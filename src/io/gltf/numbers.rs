//! Numbers out of the buffers of a glTF file, each within its bounds.

use glam::DVec3;
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

use super::{GltfError, fault};
use crate::io::Limits;

/// Numbers of one accessor.
const MOST: usize = 100_000_000;

/// The buffers of a file.
pub struct Numbers<'a> {
    pub buffers: &'a [Vec<u8>],
}

impl Numbers<'_> {
    /// Finite vectors, within the span of a body.
    pub fn vectors(&self, accessor: &Accessor<'_>) -> Result<Vec<DVec3>, GltfError> {
        let most = Limits::default().vertices;
        if accessor.count() > most {
            return Err(GltfError::OverLimit(format!("more than {most} vertices")));
        }
        let vectors: Vec<DVec3> = self.floats::<3>(accessor)?.into_iter().map(DVec3::from_array).collect();
        let largest = Limits::default().coordinate;
        match vectors.iter().all(|v| v.abs().max_element() <= largest) {
            true => Ok(vectors),
            false => Err(fault(format!("a coordinate is more than {largest}"))),
        }
    }

    /// Finite numbers, `N` at a time. Whole numbers that stand for parts of one become these.
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
            false => Err(fault(format!("accessor {} holds what is no number", accessor.index()))),
        }
    }

    /// Whole numbers from 0, `N` at a time.
    pub fn integers<const N: usize>(&self, accessor: &Accessor<'_>) -> Result<Vec<[u32; N]>, GltfError> {
        if !matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32) {
            return Err(fault(format!("accessor {} does not hold whole numbers", accessor.index())));
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
        let place = format!("accessor {}", accessor.index());
        let dimensions = match accessor.dimensions() {
            Dimensions::Scalar => 1,
            Dimensions::Vec2 => 2,
            Dimensions::Vec3 => 3,
            Dimensions::Vec4 | Dimensions::Mat2 => 4,
            Dimensions::Mat3 => 9,
            Dimensions::Mat4 => 16,
        };
        if dimensions != N {
            return Err(fault(format!("{place} holds {dimensions} numbers at a time, not {N}")));
        }
        if accessor.sparse().is_some() {
            return Err(fault(format!("{place} is sparse, which is not read: write it in full")));
        }
        let count = accessor.count();
        if count.saturating_mul(N) > MOST {
            return Err(GltfError::OverLimit(format!("{place} holds more than {MOST} numbers")));
        }
        let Some(view) = accessor.view() else { return Ok(vec![[T::default(); N]; count]) };
        let size = match accessor.data_type() {
            DataType::I8 | DataType::U8 => 1,
            DataType::I16 | DataType::U16 => 2,
            DataType::U32 | DataType::F32 => 4,
        };
        let outside = || fault(format!("{place} reaches beyond its buffer"));
        let stride = view.stride().unwrap_or(size * N);
        let end = view.offset().checked_add(view.length()).ok_or_else(outside)?;
        let buffer = self.buffers.get(view.buffer().index()).ok_or_else(outside)?;
        let bytes = buffer.get(view.offset()..end).ok_or_else(outside)?;
        let element = |i: usize| {
            let start = i.checked_mul(stride)?.checked_add(accessor.offset())?;
            let own = bytes.get(start..start.checked_add(size * N)?)?;
            let mut all = [T::default(); N];
            let each = all.iter_mut().zip(own.chunks_exact(size));
            each.for_each(|(slot, bytes)| *slot = number(accessor.data_type(), bytes));
            Some(all)
        };
        (0..count).map(|i| element(i).ok_or_else(outside)).collect()
    }
}
