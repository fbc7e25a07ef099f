//! The table of all actions; menus, buttons, tooltips, keys and the command palette read it.

mod edit;
mod file;
mod garment;
mod help;
mod pattern;
mod view;

use std::sync::LazyLock;

use crate::body::NamedPose;
use crate::cloth::Fabric;
use crate::fit::MapKind;
use crate::render::{Light, View};
use crate::session::demos::Demo;
use crate::session::samples::Sample;
use crate::ui::actions::Action;
use crate::ui::actions::row::{Need, Row, row};
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::scenery::body_look::BodyLook;

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    let mut rows = [file::ROWS, edit::ROWS, pattern::ROWS, garment::ROWS, view::ROWS, help::ROWS].concat();
    rows.extend(
        Sample::ALL
            .map(|sample| row("File › Samples", Action::Sample(sample), sample.name(), "Open this sample")),
    );
    rows.extend(NamedPose::ALL.map(|pose| {
        let tip = "Put the body in this pose; the cloth on it follows";
        row("Pose", Action::Pose(pose), pose.title(), tip).needs(&[Need::NotGrowing, Need::Joints])
    }));
    rows.extend((0_u8..).zip(Fabric::presets()).map(|(number, fabric)| {
        row("Fabric", Action::Fabric(number), &fabric.name, "Cut all pieces from this fabric")
    }));
    rows.extend(MapKind::ALL.map(|kind| {
        let map = row("View › Map", Action::Map(Some(kind)), kind.title(), kind.tip());
        map.needs(&[Need::Dressed]).in_demos()
    }));
    rows.extend(LengthUnit::ALL.map(|unit| {
        let row = row("View › Unit", Action::Unit(unit), unit.name(), "Show lengths in this unit");
        row.in_demos().on_start_page()
    }));
    rows.extend(Light::ALL.map(|light| {
        let (text, tip) = match light {
            Light::Studio => ("Studio light", "A lamp in a bright room"),
            Light::Daylight => ("Daylight", "The sun in a blue sky"),
            Light::Evening => ("Evening light", "The low sun of the evening"),
        };
        row("View › Theme", Action::Light(light), text, tip).in_demos()
    }));
    rows.extend(BodyLook::ALL.map(|look| {
        let (text, tip) = match look {
            BodyLook::Skin => ("Skin", "Show the body in its own colour"),
            BodyLook::Form => ("Dress form", "Show the body as a dress form covered in linen"),
        };
        row("View › Look of the body", Action::BodyLook(look), text, tip).in_demos()
    }));
    rows.extend(Mouse::ALL.map(|mouse| {
        row("View › Mouse", Action::Mouse(mouse), mouse.name(), mouse.tip()).in_demos().on_start_page()
    }));
    rows.extend(Demo::ALL.map(|demo| {
        let menu = if demo.is_walk() { "Help › Walks" } else { "Help › Demos" };
        row(menu, Action::Demo(demo), demo.name(), demo.tells()).in_demos()
    }));
    rows
});

/// The row of views without a name.
static OTHER_VIEW: Row =
    row("View", Action::Look(View::ThreeQuarter), "View", "Look from there").in_demos().aside();

/// All actions that can be chosen at any time. Left out are those for proposed marks, whose keys have precedence while there are
/// any, and recent files.
pub fn all() -> impl Iterator<Item = Action> {
    ROWS.iter().filter(|row| !row.aside).map(|row| row.action)
}

impl Action {
    /// The row of the action in the table.
    pub fn row(self) -> &'static Row {
        let known = match self {
            Self::OpenRecent(_) => Self::OpenRecent(0),
            action => action,
        };
        ROWS.iter().find(|row| row.action == known).unwrap_or(&OTHER_VIEW)
    }

    /// The action's name in files, which does not depend on the language of the interface.
    pub fn id(self) -> String {
        match self {
            // So it is called in the files of earlier versions.
            Self::Cancel => "CancelWrap".to_owned(),
            action => format!("{action:?}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_action_is_there_once_and_says_what_it_does() {
        for (i, row) in ROWS.iter().enumerate() {
            assert!(
                ROWS[i + 1..].iter().all(|other| other.action != row.action),
                "{:?} is there twice",
                row.action
            );
            assert!(!row.menu.is_empty() && !row.text.is_empty() && !row.tip.is_empty(), "{:?}", row.action);
        }
        let count = |is: fn(&Action) -> bool| all().filter(is).count();
        assert_eq!(count(|action| matches!(action, Action::Sample(_))), Sample::ALL.len());
        assert_eq!(count(|action| matches!(action, Action::Map(Some(_)))), MapKind::ALL.len());
        assert_eq!(count(|action| matches!(action, Action::Demo(_))), Demo::ALL.len());
        assert_eq!(count(|action| matches!(action, Action::Pose(_))), NamedPose::ALL.len());
        assert_eq!(count(|action| matches!(action, Action::Fabric(_))), Fabric::presets().len());
    }

    #[test]
    fn what_the_manual_names_can_be_chosen_by_the_keys_it_gives() {
        use crate::manual::{TOPICS, parts};
        use crate::ui::actions::keymap::written;
        for topic in TOPICS {
            let words = topic.text.replace('`', "'");
            let all: Vec<(bool, &str)> = parts(&words).collect();
            for (at, (_, name)) in all.iter().enumerate().filter(|(_, (is_name, _))| *is_name) {
                let (menu, text) = name.rsplit_once(" › ").unwrap_or(("", name));
                let found = ROWS.iter().find(|row| row.text == text && row.menu.starts_with(menu));
                let keys = all.get(at + 1).and_then(|(_, after)| after.strip_prefix(" (")?.split_once(')'));
                let is_elsewhere = menu.is_empty() && keys.is_none();
                assert!(
                    found.is_some() || is_elsewhere || is_submenu(menu, text),
                    "{}: *{name}*",
                    topic.name
                );
                if let (Some(row), Some((keys, _))) = (found, keys) {
                    assert!(
                        row.keys.iter().any(|k| written(*k) == keys),
                        "{}: *{name}* ({keys})",
                        topic.name
                    );
                }
            }
        }
    }

    #[test]
    fn the_german_manual_names_what_the_english_one_names() {
        use crate::language::Table;
        use crate::manual::{GERMAN, TOPICS, parts};
        let table = Table::german().expect("a table");
        let marked = |text: &str| {
            // What is typed stays as it is; only menu entries are compared.
            let words = text.replace('`', "'");
            let all: Vec<String> =
                parts(&words).filter(|(is, _)| *is).map(|(_, name)| name.to_owned()).collect();
            all
        };
        let mut wrong = Vec::new();
        for (english, ours) in TOPICS.iter().zip(GERMAN) {
            for (line, other) in english.text.lines().zip(ours.text.lines()) {
                // Sections of the side panel are written with their numbers.
                let shown = |one: &str| {
                    let whole = |end: &str| {
                        let text = table.text(&format!("{one}{end}"))?;
                        Some(text.strip_suffix(end)?.to_owned())
                    };
                    let text = table.text(one).map(str::to_owned);
                    text.or_else(|| whole(" ({count})"))
                        .or_else(|| whole(" {size}"))
                        .unwrap_or(one.to_owned())
                };
                let translated = |name: String| name.split(" › ").map(shown).collect::<Vec<_>>().join(" › ");
                let mut expected: Vec<String> = marked(line).into_iter().map(translated).collect();
                let mut found = marked(other);
                expected.sort();
                found.sort();
                if expected != found {
                    wrong.push(format!("{}: {expected:?}, not {found:?}", english.name));
                }
            }
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }

    /// Whether some menu holds a menu called `text`.
    fn is_submenu(menu: &str, text: &str) -> bool {
        ROWS.iter().any(|row| row.menu == format!("{menu} › {text}"))
    }
}
