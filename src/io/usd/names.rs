//! Names of prims: ASCII identifiers, each once among its siblings.

use std::collections::BTreeSet;

/// The names that siblings have.
#[derive(Debug, Default)]
pub(super) struct Names(BTreeSet<String>);

impl Names {
    /// A name like `wanted` that no sibling has, and which it has from now on. Without letters or digits in `wanted`, one like
    /// `otherwise`.
    pub fn take(&mut self, wanted: &str, otherwise: &str) -> String {
        let name = identifier(wanted).unwrap_or_else(|| otherwise.to_owned());
        let numbered = (2_usize..).map(|i| format!("{name}_{i}"));
        let free = std::iter::once(name.clone()).chain(numbered).find(|name| !self.0.contains(name));
        let name = free.unwrap_or(name);
        self.0.insert(name.clone());
        name
    }
}

/// `name` with an underscore for everything but ASCII letters and digits, and before a digit at its beginning; None without
/// such letters and digits.
fn identifier(name: &str) -> Option<String> {
    let plain: String =
        name.trim().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.chars().all(|c| c == '_') {
        return None;
    }
    Some(if plain.starts_with(|c: char| c.is_ascii_digit()) { format!("_{plain}") } else { plain })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_identifiers() {
        let mut names = Names::default();
        let mut take = |name: &str| names.take(name, "piece");
        assert_eq!(take("front left"), "front_left");
        assert_eq!(take("front-left"), "front_left_2");
        assert_eq!(take("front_left_2"), "front_left_2_2");
        assert_eq!(take(" 2nd sleeve "), "_2nd_sleeve");
        assert_eq!(take("Ärmel"), "_rmel");
        assert_eq!(take("袖"), "piece");
        assert_eq!(take(""), "piece_2");
        assert_eq!(take("a/b.c:d\"e"), "a_b_c_d_e");
    }
}
