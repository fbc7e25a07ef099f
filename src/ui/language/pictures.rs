//! Why there is no picture, in the language of the window. The renderer knows none.

use crate::render::RenderError;
use crate::ui::language::say;

/// "There is no picture", and why.
pub(in crate::ui) fn no_picture(why: &RenderError) -> String {
    say!("There is no picture: {why}", why = reason(why))
}

/// Why.
pub(in crate::ui) fn reason(why: &RenderError) -> String {
    match why {
        RenderError::NoAdapter(reason) => say!(
            "no graphics adapter was found ({reason}). Pictures need Vulkan, Metal, DirectX 12 or OpenGL; on Linux the package mesa-vulkan-drivers brings a software one",
            reason
        ),
        RenderError::NoDevice { adapter, reason } => {
            say!("the graphics adapter {adapter} could not be opened: {reason}", adapter, reason)
        }
        RenderError::TooLarge { what, limit } => {
            say!("this graphics adapter cannot hold so much ({limit}): {what}", what, limit)
        }
        RenderError::Timeout(after) => say!(
            "the graphics adapter did not finish the picture within {seconds} seconds",
            seconds = after.as_secs()
        ),
        RenderError::Device(reason) => say!("the graphics adapter reported an error: {reason}", reason),
        RenderError::NoDepthOfField(adapter) => say!(
            "the graphics adapter {adapter} draws by OpenGL, which cannot draw depth of field: leave it out",
            adapter
        ),
        RenderError::Encode(reason) => say!("the picture could not be encoded: {reason}", reason),
        RenderError::UnknownView(name) => say!("there is no view {name}", name),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::language::{Table, shown_in};

    #[test]
    fn why_there_is_no_picture_is_told_in_german() {
        let words = || "x".to_owned();
        let encode = std::io::Error::other("x");
        for why in [
            RenderError::NoAdapter(words()),
            RenderError::NoDevice { adapter: words(), reason: words() },
            RenderError::TooLarge { what: words(), limit: words() },
            RenderError::Timeout(Duration::from_secs(7)),
            RenderError::Device(words()),
            RenderError::NoDepthOfField(words()),
            RenderError::Encode(image::ImageError::IoError(encode)),
            RenderError::UnknownView(words()),
        ] {
            let german = shown_in(Table::german(), || [reason(&why), no_picture(&why)]);
            assert!(german[0] != reason(&why) && german[1].starts_with("Es gibt kein Bild: "), "{german:?}");
        }
    }
}
