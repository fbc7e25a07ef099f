//! Sentences that rooms without a language put together in English: they are found by the templates that made them.

use std::fmt::Display;

use crate::language::{filled, shown, translated};

/// `text`, which one of `templates` may have made, in the language that is shown. The first that fits is taken. `value` gives each
/// value of the template in that language, from its name and its English text. None if no template made it, if the table lacks it,
/// and in English.
pub fn translated_by(
    templates: &[&'static str],
    text: &str,
    value: impl Fn(&str, &str) -> String,
) -> Option<String> {
    shown()?;
    let (template, values) =
        templates.iter().find_map(|template| Some((*template, values(template, text)?)))?;
    let values: Vec<(&str, String)> =
        values.into_iter().map(|(name, english)| (name, value(name, english))).collect();
    let values: Vec<(&str, &dyn Display)> =
        values.iter().map(|(name, value)| (*name, value as &dyn Display)).collect();
    Some(filled(translated(template)?, &values))
}

/// What stands in `text` in place of each `{name}` of `template`; None if it is not made by it. `{n}` is a whole number.
pub fn values<'a>(template: &'a str, text: &'a str) -> Option<Vec<(&'a str, &'a str)>> {
    let Some((before, mut template)) = template.split_once('{') else {
        return (template == text).then(Vec::new);
    };
    let mut text = text.strip_prefix(before)?;
    let mut found = Vec::new();
    loop {
        let (name, after) = template.split_once('}')?;
        let (value, rest) = match after.split_once('{') {
            Some((between, next)) => {
                template = next;
                text.split_once(between)?
            }
            None => (text.strip_suffix(after)?, ""),
        };
        if value.is_empty() || (name == "n" && value.parse::<u32>().is_err()) {
            return None;
        }
        found.push((name, value));
        if !after.contains('{') {
            return Some(found);
        }
        text = rest;
    }
}
