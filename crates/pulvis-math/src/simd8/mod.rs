//! Eight numbers in the registers of one instruction set, with loads and stores of rows in memory.
//!
//! The loops of the engine are written once, as a [`Kernel`] over any [`Simd8`], and compiled for
//! every instruction set; which one runs is chosen while the program runs. The vector types cannot be
//! named outside of this crate: code gets them as the type parameter of [`Kernel::run`], which
//! [`InstructionSet::run`] calls only where the processor has the instructions.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(target_arch = "x86_64")]
mod operators;
mod plain;
#[cfg(target_arch = "x86_64")]
mod sse2;

use std::fmt;

use crate::array::F64Array;
use crate::real::Real;
use crate::vector::Vector3;

/// A vector and one more number: 32 bytes, which one load instruction reads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Packed4 {
    /// The vector.
    pub vector: Vector3,
    /// The number beside it.
    pub scalar: f64,
}

impl Packed4 {
    /// A vector and a number.
    #[inline(always)]
    pub const fn new(vector: Vector3, scalar: f64) -> Self {
        Self { vector, scalar }
    }
}

/// The four numbers of a [`Packed4`] in a register.
pub trait Simd4: Copy {
    /// Loads a packed vector from memory.
    fn load(packed: &Packed4) -> Self;
    /// Stores into memory.
    fn store(self, packed: &mut Packed4);
    /// Four equal numbers.
    fn splat(value: f64) -> Self;
    /// Sum, number by number.
    fn plus(self, other: Self) -> Self;
    /// Difference, number by number.
    fn minus(self, other: Self) -> Self;
    /// Product, number by number.
    fn times(self, other: Self) -> Self;
    /// The vector of `self` with the scalar of `other`.
    fn with_scalar_of(self, other: Self) -> Self;
}

/// Two adjacent [`Packed4`]s in registers.
pub trait Simd4Pair: Copy {
    /// Loads both packed vectors from memory.
    fn load(packed: &[Packed4; 2]) -> Self;
    /// Stores into memory.
    fn store(self, packed: &mut [Packed4; 2]);
    /// Sum, number by number.
    fn plus(self, other: Self) -> Self;
    /// The difference of the first packed vectors and the sum of the second ones, number by number.
    fn minus_plus(self, other: Self) -> Self;
}

impl<R: Simd4> Simd4Pair for [R; 2] {
    #[inline(always)]
    fn load(packed: &[Packed4; 2]) -> Self {
        [R::load(&packed[0]), R::load(&packed[1])]
    }
    #[inline(always)]
    fn store(self, packed: &mut [Packed4; 2]) {
        self[0].store(&mut packed[0]);
        self[1].store(&mut packed[1]);
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        [self[0].plus(other[0]), self[1].plus(other[1])]
    }
    #[inline(always)]
    fn minus_plus(self, other: Self) -> Self {
        [self[0].minus(other[0]), self[1].plus(other[1])]
    }
}

/// The pairs of eight rows and of eight others.
#[inline(always)]
fn side_by_side<R: Simd4>(a: [R; 8], b: [R; 8]) -> [[R; 2]; 8] {
    [
        [a[0], b[0]],
        [a[1], b[1]],
        [a[2], b[2]],
        [a[3], b[3]],
        [a[4], b[4]],
        [a[5], b[5]],
        [a[6], b[6]],
        [a[7], b[7]],
    ]
}

/// Eight numbers, one per lane.
pub trait Simd8: Real {
    /// Four numbers at a time.
    type Simd4: Simd4;
    /// Two rows at a time.
    type Simd4Pair: Simd4Pair;
    /// Loads eight numbers from memory.
    fn load(source: &F64Array<8>) -> Self;
    /// Stores into memory.
    fn store(self, target: &mut F64Array<8>);
    /// The eight numbers as an array.
    #[inline(always)]
    fn to_array(self) -> F64Array<8> {
        let mut lanes = F64Array::default();
        self.store(&mut lanes);
        lanes
    }
    /// The columns of eight rows: x, y, z and the scalar of each.
    fn columns(rows: [Self::Simd4; 8]) -> [Self; 4];
    /// The columns of eight pairs of rows: the differences of x, y and z, and the sums of the scalars.
    #[inline(always)]
    fn apart(ones: [Self::Simd4; 8], others: [Self::Simd4; 8]) -> [Self; 4] {
        let ([x, y, z, scalar], other) = (Self::columns(ones), Self::columns(others));
        [x - other[0], y - other[1], z - other[2], scalar + other[3]]
    }
    /// The rows of four columns.
    fn rows(columns: [Self; 4]) -> [Self::Simd4; 8];
    /// The rows of two times four columns; two rows with the same lane are adjacent.
    fn row_pairs(first: [Self; 4], second: [Self; 4]) -> [Self::Simd4Pair; 8];
    /// A routine compiled for the instruction set of this type.
    fn pointer<T: Task, P: Routine<T>>() -> Pointer<T, Self>;
}

/// What a [`Routine`] works on, for any vector type.
pub trait Task: 'static {
    /// The data; vectors in it are handed over in memory.
    type Data<'a, R: Simd8>;
}

/// A function that is compiled once for every instruction set and called through a [`Pointer`], in place of being compiled
/// into every [`Kernel`] that may need it.
pub trait Routine<T: Task> {
    /// The function. As [`Kernel::run`], it and everything that it calls with values of type `R` must be
    /// `#[inline(always)]`.
    fn call<R: Simd8>(data: &mut T::Data<'_, R>);
}

/// A pointer to a [`Routine`] compiled for the instruction set of `R`.
pub struct Pointer<T: Task, R: Simd8>(unsafe fn(&mut T::Data<'_, R>));

impl<T: Task, R: Simd8> Clone for Pointer<T, R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Task, R: Simd8> Copy for Pointer<T, R> {}

impl<T: Task, R: Simd8> Pointer<T, R> {
    /// Calls the routine.
    #[inline(always)]
    pub fn call(self, data: &mut T::Data<'_, R>) {
        // SAFETY: a pointer comes from `Simd8::pointer`, and a vector type that needs instructions can be named as the
        // parameter of a running kernel only, which runs where the processor has them.
        unsafe { (self.0)(data) }
    }
}

/// A loop that is compiled for every instruction set.
pub trait Kernel {
    /// Its result.
    type Output;
    /// The loop. Implementations must be `#[inline(always)]`, and so must everything that they call
    /// with values of type `R`: code that is not inlined is compiled without the vector instructions.
    fn run<R: Simd8>(self) -> Self::Output;
}

/// The instructions that loops can be compiled for. All give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Level {
    Plain,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// An instruction set that this processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InstructionSet(Level);

impl InstructionSet {
    /// All instruction sets that this processor can run, from the narrowest to the widest.
    pub fn available() -> Vec<Self> {
        #[allow(unused_mut)] // elsewhere than on x86-64
        let mut found = vec![Self(Level::Plain)];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                found.push(Self(Level::Avx2));
                let wide = is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw");
                if wide {
                    found.push(Self(Level::Avx512));
                }
            }
        }
        found
    }

    /// The widest of them.
    pub fn widest() -> Self {
        Self::available().pop().unwrap_or(Self(Level::Plain))
    }

    /// The one of that name (see [`Display`](fmt::Display)), if this processor can run it.
    pub fn named(name: &str) -> Option<Self> {
        Self::available().into_iter().find(|set| set.to_string() == name)
    }

    /// Runs the kernel compiled for this instruction set.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Level::Plain => sse2::run(kernel),
            #[cfg(not(target_arch = "x86_64"))]
            Level::Plain => run_plain(kernel),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `available`, which alone makes this value, has found the instructions.
            Level::Avx2 => unsafe { avx2::run(kernel) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: as above.
            Level::Avx512 => unsafe { avx512::run(kernel) },
        }
    }
}

impl Default for InstructionSet {
    fn default() -> Self {
        Self::widest()
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self.0 {
            #[cfg(target_arch = "x86_64")]
            Level::Plain => "sse2",
            #[cfg(not(target_arch = "x86_64"))]
            Level::Plain => "plain",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "avx512",
        })
    }
}

/// Plain Rust: used by processors without a file of their own, and as the reference in tests of the others.
#[cfg(any(test, not(target_arch = "x86_64")))]
#[inline(never)]
fn run_plain<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<F64Array<8>>()
}

#[cfg(test)]
mod tests;
