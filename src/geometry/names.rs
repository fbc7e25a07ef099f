//! Finding a thing by its name as a person types it.

/// Number of the one of `names` that is `typed`, spaces round it aside; where none is, of the only one that is it in other case.
///
/// Names that differ in nothing but case are told apart by theirs alone.
pub fn found<'a>(names: impl IntoIterator<Item = &'a str>, typed: &str) -> Option<usize> {
    let typed = typed.trim();
    let folded = typed.to_lowercase();
    let mut alike = Vec::new();
    for (i, name) in names.into_iter().enumerate() {
        if name == typed {
            return Some(i);
        }
        if name.to_lowercase() == folded {
            alike.push(i);
        }
    }
    (alike.len() == 1).then(|| alike[0])
}

#[cfg(test)]
mod tests {
    use super::found;

    #[test]
    fn case_counts_only_between_names_that_differ_by_it_alone() {
        let names = ["xs", "M", "m", "größe 40"];
        assert_eq!(found(names, " XS "), Some(0));
        assert_eq!(found(names, "m"), Some(2));
        assert_eq!(found(names, "GRÖSSE 40"), None, "another spelling");
        assert_eq!(found(names, "GRÖßE 40"), Some(3));
        assert_eq!(found(["M", "m"], "\u{1d40c}"), None);
        assert_eq!(found(["Ab", "aB"], "ab"), None, "either could be meant");
    }
}
