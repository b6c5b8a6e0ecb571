//! What crosses the border by value: views of the caller's buffers, structs that state their own size.

use super::guard::null;
use crate::{ElementType, Error, IndexType, Reason, Result, Rows, ScalarType};
use libc::c_void;
use std::mem::MaybeUninit;

/// Element type of a buffer; 0 means `double` where real numbers are asked for and `uint32_t` where indices are.
pub type taut_type = u32;
/// `float`.
pub const TAUT_TYPE_F32: taut_type = 1;
/// `double`.
pub const TAUT_TYPE_F64: taut_type = 2;
/// `uint16_t`.
pub const TAUT_TYPE_U16: taut_type = 3;
/// `uint32_t`.
pub const TAUT_TYPE_U32: taut_type = 4;
/// `uint64_t`.
pub const TAUT_TYPE_U64: taut_type = 5;
/// `int32_t`; a negative index is an error.
pub const TAUT_TYPE_I32: taut_type = 6;
/// `int64_t`; a negative index is an error.
pub const TAUT_TYPE_I64: taut_type = 7;

/// A buffer that a call reads: `count` rows, `stride` bytes apart, of as many elements as the parameter says.
///
/// A plain `const double *xyz` with n vertices is `{ .data = xyz, .count = n }`; a numpy array is its data, shape,
/// stride and type. Alignment does not matter, and nothing of the buffer is kept after the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_input {
    /// The first row; may be NULL if `count` is 0.
    pub data: *const c_void,
    /// How many rows there are.
    pub count: usize,
    /// Bytes from one row to the next; 0 means that rows follow each other without a gap.
    pub stride: usize,
    /// Type of an element; 0 means `double` or `uint32_t`.
    pub r#type: taut_type,
    /// 0.
    pub reserved: u32,
}

/// A buffer that a call fills, laid out like `taut_input`.
///
/// A call fills all the rows it has or, on failure, none. Bytes between rows are left alone. The rows must not overlap.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_output {
    /// The first row; may be NULL if `count` is 0.
    pub data: *mut c_void,
    /// How many rows there is room for; more than needed is fine, the rest is left alone.
    pub count: usize,
    /// Bytes from one row to the next; 0 means that rows follow each other without a gap.
    pub stride: usize,
    /// Type of an element; 0 means `double` or `uint32_t`. A `float` receives the nearest value.
    pub r#type: taut_type,
    /// 0.
    pub reserved: u32,
}

/// A struct that grows at its end from version to version.
///
/// # Safety
/// `repr(C)`; the first field is `struct_size: usize`. One that is read from the caller must be valid for any bytes,
/// and must end without padding, where a later version's field would find garbage.
pub(super) unsafe trait SizedStruct: Copy {}

/// No struct is as large; a size beyond it was never set.
const MOST_STRUCT_SIZE: usize = 4096;

/// The size that a caller's struct states.
///
/// # Safety
/// The first field is readable.
unsafe fn stated_size<T: SizedStruct>(pointer: *const T, name: &str) -> Result<usize> {
    // SAFETY: as the caller promises.
    let size = unsafe { pointer.cast::<usize>().read_unaligned() };
    if (size_of::<usize>()..=MOST_STRUCT_SIZE).contains(&size) {
        return Ok(size);
    }
    let message = format!("`{name}.struct_size` is {size}; set it to sizeof(the struct)");
    Err(Error::new(Reason::BadArgument, message))
}

/// A caller's struct; fields that it does not have, and all fields if it is NULL, are zero.
///
/// # Safety
/// `pointer` is NULL or points to as many readable bytes as its first field says.
pub(super) unsafe fn read_sized<T: SizedStruct>(pointer: *const T, name: &str) -> Result<T> {
    let mut copy = MaybeUninit::<T>::zeroed();
    if !pointer.is_null() {
        let bytes = pointer.cast::<u8>();
        // SAFETY: the struct has at least its size field.
        let size = unsafe { stated_size(pointer, name)? };
        let known = size.min(size_of::<T>());
        // SAFETY: the caller promises `size` readable bytes.
        let unknown = unsafe { std::slice::from_raw_parts(bytes.add(known), size - known) };
        if unknown.iter().any(|&byte| byte != 0) {
            let message = format!("`{name}` sets a field that this version of the library does not know");
            return Err(Error::new(Reason::BadArgument, message));
        }
        // SAFETY: both sides have `known` bytes, and a local variable overlaps nothing of the caller's.
        unsafe { copy.as_mut_ptr().cast::<u8>().copy_from_nonoverlapping(bytes, known) };
    }
    // SAFETY: a SizedStruct that is read is valid for any bytes, and all of them are set.
    Ok(unsafe { copy.assume_init() })
}

/// Fills the fields that the caller's struct has and this version knows, and zeroes the others but the size; all of them
/// where there is no value.
///
/// # Safety
/// `out` is NULL or points to as many writable bytes as its first field says.
pub(super) unsafe fn write_sized<T: SizedStruct>(out: *mut T, value: Option<&T>, name: &str) -> Result<()> {
    if out.is_null() {
        return Err(null(name));
    }
    let head = size_of::<usize>();
    // SAFETY: the struct has at least its size field, and the caller promises `size` writable bytes; both sides have the
    // bytes that are copied, and `value` is ours.
    unsafe {
        let size = stated_size(out, name)?;
        let body = out.cast::<u8>().add(head);
        body.write_bytes(0, size - head);
        if let Some(value) = value {
            let from = std::ptr::from_ref(value).cast::<u8>().add(head);
            body.copy_from_nonoverlapping(from, size.min(size_of::<T>()) - head);
        }
    }
    Ok(())
}

impl taut_input {
    /// The rows as real numbers.
    ///
    /// # Safety
    /// The view describes readable memory that nobody writes while the result lives.
    pub(super) unsafe fn scalars<'a>(self, width: usize, name: &str) -> Result<Rows<'a, ScalarType>> {
        // SAFETY: as the caller promises.
        unsafe { self.rows(width, scalar_type(self.r#type, name)?, name) }
    }

    /// One real number a row.
    ///
    /// # Safety
    /// The view describes readable memory.
    pub(super) unsafe fn numbers(self, name: &str) -> Result<Vec<f64>> {
        // SAFETY: as the caller promises.
        let rows = unsafe { self.scalars(1, name)? };
        Ok((0..rows.count()).map(|row| rows.scalar(row, 0)).collect())
    }

    /// The rows as indices.
    ///
    /// # Safety
    /// As [`taut_input::scalars`].
    pub(super) unsafe fn indices<'a>(self, width: usize, name: &str) -> Result<Rows<'a, IndexType>> {
        // SAFETY: as the caller promises.
        unsafe { self.rows(width, index_type(self.r#type, name)?, name) }
    }

    /// # Safety
    /// As [`taut_input::scalars`].
    unsafe fn rows<'a, T: ElementType>(self, width: usize, kind: T, name: &str) -> Result<Rows<'a, T>> {
        check_reserved(self.reserved, name)?;
        let layout = Layout::new(self.data, self.count, self.stride, width, kind, name)?;
        let bytes = match self.count {
            0 => &[],
            // SAFETY: the pointer is not NULL, the span does not overflow, and the caller promises readable memory.
            _ => unsafe { std::slice::from_raw_parts(self.data.cast::<u8>(), layout.span) },
        };
        Rows::new(bytes, self.count, width, layout.stride, kind)
    }
}

impl taut_output {
    /// Writes rows of real numbers, all or none.
    ///
    /// # Safety
    /// The view describes writable memory that nobody else uses during the call.
    pub(super) unsafe fn write_scalars<const WIDTH: usize>(self, rows: &[[f64; WIDTH]], name: &str) -> Result<()> {
        // SAFETY: as the caller promises.
        unsafe { self.write_scalar_rows(rows, WIDTH, name) }
    }

    /// Writes rows of `width` real numbers, all or none.
    ///
    /// # Safety
    /// As [`taut_output::write_scalars`].
    pub(super) unsafe fn write_scalar_rows<R: AsRef<[f64]>>(self, rows: &[R], width: usize, name: &str) -> Result<()> {
        let (kind, layout) = self.scalar_layout(rows.len(), width, name)?;
        // SAFETY: the layout is checked against the view, and the caller promises writable memory.
        unsafe {
            match kind {
                // Rounds to the nearest f32, as documented.
                ScalarType::F32 => layout.write(self.data, rows, |x: f64| x as f32),
                ScalarType::F64 => layout.write(self.data, rows, |x: f64| x),
            }
        }
        Ok(())
    }

    /// Whether `needed` rows of real numbers can be written; asked first where the work is long, or fills several views.
    pub(super) fn scalar_layout(self, needed: usize, width: usize, name: &str) -> Result<(ScalarType, Layout)> {
        let kind = scalar_type(self.r#type, name)?;
        Ok((kind, self.layout(needed, width, kind, name)?))
    }

    /// Whether `needed` rows of indices can be written, but for their size.
    pub(super) fn index_layout(self, needed: usize, width: usize, name: &str) -> Result<(IndexType, Layout)> {
        let kind = index_type(self.r#type, name)?;
        Ok((kind, self.layout(needed, width, kind, name)?))
    }

    /// Writes rows of indices, all or none.
    ///
    /// # Safety
    /// As [`taut_output::write_scalars`].
    pub(super) unsafe fn write_indices<const WIDTH: usize>(self, rows: &[[u32; WIDTH]], name: &str) -> Result<()> {
        let largest = rows.iter().flatten().copied().max().unwrap_or(0);
        // SAFETY: as the caller promises.
        unsafe { self.write_integers(rows, largest.into(), u64::from, name) }
    }

    /// Writes rows of one offset, all or none; they never decrease.
    ///
    /// # Safety
    /// As [`taut_output::write_scalars`].
    pub(super) unsafe fn write_offsets(self, offsets: &[usize], name: &str) -> Result<()> {
        let bits = |offset: usize| offset as u64;
        let largest = offsets.last().copied().map_or(0, bits);
        // SAFETY: as the caller promises.
        unsafe { self.write_integers(offsets.as_chunks::<1>().0, largest, bits, name) }
    }

    /// Writes rows of one index, all or none; no index is all ones in an unsigned type, -1 in a signed one.
    ///
    /// # Safety
    /// As [`taut_output::write_scalars`].
    pub(super) unsafe fn write_optional_indices(self, indices: &[Option<u32>], name: &str) -> Result<()> {
        // One more than the largest must fit too, so that no index looks like none.
        let largest = indices.iter().flatten().max().map_or(0, |&i| u64::from(i) + 1);
        let bits = |index: Option<u32>| index.map_or(u64::MAX, u64::from);
        // SAFETY: as the caller promises.
        unsafe { self.write_integers(indices.as_chunks::<1>().0, largest, bits, name) }
    }

    /// Writes the low `bits` of rows of integers, if the `largest` fits.
    ///
    /// # Safety
    /// As [`taut_output::write_scalars`].
    unsafe fn write_integers<S: Copy, const WIDTH: usize>(
        self,
        rows: &[[S; WIDTH]],
        largest: u64,
        bits: impl Fn(S) -> u64,
        name: &str,
    ) -> Result<()> {
        let (kind, layout) = self.index_layout(rows.len(), WIDTH, name)?;
        let fits = match kind {
            IndexType::U16 => u16::try_from(largest).is_ok(),
            IndexType::U32 => u32::try_from(largest).is_ok(),
            IndexType::I32 => i32::try_from(largest).is_ok(),
            IndexType::U64 | IndexType::I64 => true,
        };
        if !fits {
            let message = format!("`{name}.type` is too small for the index {largest}");
            return Err(Error::new(Reason::BadArgument, message));
        }
        // SAFETY: as in write_scalars. The casts lose nothing of an index: the largest fits.
        unsafe {
            match kind {
                IndexType::U16 => layout.write(self.data, rows, |i| bits(i) as u16),
                IndexType::U32 => layout.write(self.data, rows, |i| bits(i) as u32),
                IndexType::U64 => layout.write(self.data, rows, bits),
                IndexType::I32 => layout.write(self.data, rows, |i| bits(i) as i32),
                IndexType::I64 => layout.write(self.data, rows, |i| bits(i) as i64),
            }
        }
        Ok(())
    }

    /// The checked layout of `needed` rows in this view.
    fn layout<T: ElementType>(self, needed: usize, width: usize, kind: T, name: &str) -> Result<Layout> {
        check_reserved(self.reserved, name)?;
        let layout = Layout::new(self.data, self.count, self.stride, width, kind, name)?;
        if self.count < needed {
            let message = format!("`{name}` has room for {} rows, but {needed} are needed", self.count);
            return Err(Error::new(Reason::BufferTooSmall, message));
        }
        if layout.stride < width * kind.size() {
            return Err(Error::new(
                Reason::BadArgument,
                format!("the rows of `{name}` overlap: its stride is too small"),
            ));
        }
        Ok(layout)
    }
}

/// Where the rows of a view lie.
pub(super) struct Layout {
    /// Elements in a row.
    width: usize,
    /// Bytes from one row to the next.
    stride: usize,
    /// Bytes from the first to past the last.
    span: usize,
}

impl Layout {
    fn new<T: ElementType>(
        data: *const c_void,
        count: usize,
        stride: usize,
        width: usize,
        kind: T,
        name: &str,
    ) -> Result<Layout> {
        let stride = if stride == 0 { width * kind.size() } else { stride };
        if data.is_null() && count > 0 {
            return Err(Error::new(Reason::NullPointer, format!("`{name}.data` is NULL, but its count is {count}")));
        }
        let span = Rows::span(count, width, stride, kind)?;
        if isize::try_from(span).is_err() {
            return Err(Error::new(Reason::TooManyElements, format!("`{name}` spans more memory than there can be")));
        }
        Ok(Layout { width, stride, span })
    }

    /// Writes `rows` to `data`, which need not be aligned.
    ///
    /// # Safety
    /// As many rows of elements of type `T` in this layout are writable.
    unsafe fn write<S: Copy, T>(&self, data: *mut c_void, rows: &[impl AsRef<[S]>], convert: impl Fn(S) -> T) {
        for (i, row) in rows.iter().enumerate() {
            for (k, &element) in row.as_ref().iter().take(self.width).enumerate() {
                // SAFETY: element (i, k) lies in the layout's span, which does not overflow.
                unsafe {
                    data.cast::<u8>().add(i * self.stride).cast::<T>().add(k).write_unaligned(convert(element));
                }
            }
        }
    }
}

fn scalar_type(kind: taut_type, name: &str) -> Result<ScalarType> {
    match kind {
        0 | TAUT_TYPE_F64 => Ok(ScalarType::F64),
        TAUT_TYPE_F32 => Ok(ScalarType::F32),
        _ => Err(bad_enum(&format!("{name}.type"), kind)),
    }
}

fn index_type(kind: taut_type, name: &str) -> Result<IndexType> {
    match kind {
        0 | TAUT_TYPE_U32 => Ok(IndexType::U32),
        TAUT_TYPE_U16 => Ok(IndexType::U16),
        TAUT_TYPE_U64 => Ok(IndexType::U64),
        TAUT_TYPE_I32 => Ok(IndexType::I32),
        TAUT_TYPE_I64 => Ok(IndexType::I64),
        _ => Err(bad_enum(&format!("{name}.type"), kind)),
    }
}

/// A later version may give these bytes a meaning, which this one must not miss.
pub(super) fn check_reserved(reserved: u32, name: &str) -> Result<()> {
    if reserved == 0 { Ok(()) } else { Err(bad_enum(&format!("{name}.reserved"), reserved)) }
}

/// The error of an enum parameter or field whose value means nothing there.
pub(super) fn bad_enum(name: &str, value: u32) -> Error {
    Error::new(Reason::BadArgument, format!("`{name}` cannot be {value}"))
}
