//! Names of undo steps in the language of the window. The session gives them in English, some with names and numbers in them.

use crate::language::sentences::translated_by;
use crate::ui::language::translated;

/// Names of steps that the session puts together, those with more words first. `{n}` stands for a number.
const NAMES: &[&str] = &[
    "take the name of mark {n} on the cloth away",
    "take the name of mark {n} on the body away",
    "name mark {n} on the cloth {name}",
    "name mark {n} on the body {name}",
    "delete mark {n} on the cloth",
    "delete mark {n} on the body",
    "mark {n} on the cloth",
    "mark {n} on the body",
    "delete marks {n}",
    "renumber a mark to {n}",
    "pull {n} pins out",
    "lock {n} pins",
    "unlock {n} pins",
    "lock pin {n}",
    "unlock pin {n}",
    "move {n} points",
    "set a rule",
    "clear a rule",
    "set {n} rules",
    "clear {n} rules",
    "unpick {n} seams",
    "unpick seam {n}",
    "turn seam {n} round",
    "change the gather of seam {n}",
    "delete {n} pieces",
    "duplicate {n} pieces",
    "move {n} pieces",
    "scale {n} pieces",
    "place {n} pieces",
    "take from the body {n} pieces",
    "lock {n} pieces",
    "unlock {n} pieces",
    "hide {n} pieces",
    "show {n} pieces",
    "wear on another layer {n} pieces",
    "activate {n} pieces",
    "freeze {n} pieces",
    "deactivate {n} pieces",
    "set the seam allowance of {n} pieces",
    "take from the body {name}",
    "wear on another layer {name}",
    "set the seam allowance of {name}",
    "rename {old} to {name}",
    "sew {one} to {other}",
    "cut a dart into {name}",
    "draw the grain of {name}",
    "make {name} symmetric",
    "open {name} out",
    "delete {name}",
    "duplicate {name}",
    "move {name}",
    "scale {name}",
    "place {name}",
    "lock {name}",
    "unlock {name}",
    "hide {name}",
    "show {name}",
    "activate {name}",
    "freeze {name}",
    "deactivate {name}",
    "add {name}",
    "redraw {name}",
    "cut {name}",
    "mirror {name}",
    "unlink {name}",
    "fold {name}",
    "take {name}",
];

/// The name of a step that the session calls `label`.
pub fn step_words(label: &str) -> String {
    let known = || translated_by(NAMES, label, |_, value| value.to_owned());
    translated(label).map(str::to_owned).or_else(known).unwrap_or_else(|| label.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::sentences::values;
    use crate::ui::language;

    #[test]
    fn names_and_numbers_are_found_in_steps() {
        let first = |label: &'static str| NAMES.iter().find_map(|name| Some((*name, values(name, label)?)));
        for (label, name, wanted) in [
            ("move 3 pieces", "move {n} pieces", vec![("n", "3")]),
            ("move two pieces", "move {name}", vec![("name", "two pieces")]),
            ("delete mark 2 on the body", "delete mark {n} on the body", vec![("n", "2")]),
            (
                "name mark 2 on the cloth my hem",
                "name mark {n} on the cloth {name}",
                vec![("n", "2"), ("name", "my hem")],
            ),
            (
                "sew left front to back",
                "sew {one} to {other}",
                vec![("one", "left front"), ("other", "back")],
            ),
            ("make front symmetric", "make {name} symmetric", vec![("name", "front")]),
        ] {
            assert_eq!(first(label), Some((name, wanted)), "{label}");
        }
        assert_eq!((first("wrap"), first("move ")), (None, None));
    }

    #[test]
    fn steps_are_named_in_the_language_of_the_window() {
        assert_eq!(step_words("move front"), "move front");
        language::show(crate::language::Table::german());
        assert_eq!(
            (step_words("wrap").as_str(), step_words("nothing known").as_str()),
            ("Anlegen", "nothing known")
        );
        assert_eq!(step_words("move Ärmel {n}"), "Ärmel {n} bewegen");
        language::show(None);
    }
}
