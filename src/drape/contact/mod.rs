//! Penalty contact of cloth with a body and, in implicit steps, with itself. Small steps keep cloth from crossing itself by
//! `contact::separation`.

pub mod body;
pub mod itself;
mod pair;

pub use body::{Collider, Contacts};
