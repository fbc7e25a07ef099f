//! Names of edits that may be of one piece or of several, for menus.

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};
use crate::pattern::Pattern;
use crate::pattern::edit::find;

/// The name of an edit of the one piece that is called so, and of an edit of so many.
pub(super) type Label = (fn(&str) -> Words, fn(usize) -> Words);

pub(super) const DELETE: Label = (|name| words!("delete {name}", name), |n| words!("delete {n} pieces", n));
pub(super) const DUPLICATE: Label =
    (|name| words!("duplicate {name}", name), |n| words!("duplicate {n} pieces", n));
pub(super) const MOVE: Label = (|name| words!("move {name}", name), |n| words!("move {n} pieces", n));
pub(super) const SCALE: Label = (|name| words!("scale {name}", name), |n| words!("scale {n} pieces", n));
pub(super) const PLACE: Label = (|name| words!("place {name}", name), |n| words!("place {n} pieces", n));
pub(super) const TAKE: Label =
    (|name| words!("take from the body {name}", name), |n| words!("take from the body {n} pieces", n));
pub(super) const LOCK: Label = (|name| words!("lock {name}", name), |n| words!("lock {n} pieces", n));
pub(super) const UNLOCK: Label = (|name| words!("unlock {name}", name), |n| words!("unlock {n} pieces", n));
pub(super) const HIDE: Label = (|name| words!("hide {name}", name), |n| words!("hide {n} pieces", n));
pub(super) const SHOW: Label = (|name| words!("show {name}", name), |n| words!("show {n} pieces", n));
pub(super) const LAYER: Label =
    (|name| words!("wear on another layer {name}", name), |n| words!("wear on another layer {n} pieces", n));
pub(super) const ACTIVATE: Label =
    (|name| words!("activate {name}", name), |n| words!("activate {n} pieces", n));
pub(super) const FREEZE: Label = (|name| words!("freeze {name}", name), |n| words!("freeze {n} pieces", n));
pub(super) const DEACTIVATE: Label =
    (|name| words!("deactivate {name}", name), |n| words!("deactivate {n} pieces", n));
pub(super) const ALLOWANCE: Label = (
    |name| words!("set the seam allowance of {name}", name),
    |n| words!("set the seam allowance of {n} pieces", n),
);

/// Name of an edit of the pieces `ids`. Err when one of them does not exist, or none is named.
pub(super) fn named(pattern: &Pattern, what: Label, ids: &[PieceId]) -> Result<Words, Words> {
    for &id in ids {
        find(pattern, id)?;
    }
    match ids {
        [] => Err(words!("no piece was named")),
        [one] => Ok(what.0(&find(pattern, *one)?.name)),
        _ => Ok(what.1(ids.len())),
    }
}
