//! The language of the window: which it is, its shortcuts, and the fields in which numbers are typed. The texts themselves are those
//! of [`crate::language`].

pub(crate) mod choice;
pub(in crate::ui) mod fields;
pub(in crate::ui) mod keys;
pub(in crate::ui) mod pictures;
#[cfg(test)]
mod reasons;

pub(in crate::ui) use crate::language::{
    code, counted, decimal_sign, localised, number, parsed, said, say, short, show, signed, tr, translated,
    unbroken,
};
