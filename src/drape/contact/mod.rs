//! What cloth does against a body and, in implicit steps, against itself. What keeps it from crossing in small steps is
//! `contact::separation`.

pub mod body;
pub mod itself;
mod pair;

pub use body::{Collider, Contacts};
