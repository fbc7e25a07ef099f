//! Command line options of fabrics, colours, prints and images.

use clap::Args;

use crate::cli::art_options::ArtOptions;
use crate::session::Print;

/// Options of fabrics and colours.
#[derive(Clone, Debug, Default, Args)]
pub struct ClothOptions {
    /// The colourway of the project with this name: its fabrics, colours and prints
    #[arg(long, value_name = "NAME")]
    pub colourway: Option<String>,
    /// The fabric (a preset) of all pieces that have none of their own
    #[arg(long, value_name = "NAME")]
    pub fabric: Option<String>,
    /// The colour of all pieces that have none of their own, as RRGGBB
    #[arg(long, value_name = "RRGGBB", value_parser = colour)]
    pub colour: Option<[u8; 3]>,
    /// The print of all pieces that have none of their own: stripes, hoops, checks or dots, the repeat in millimetres and the
    /// colour
    #[arg(long, value_name = "MOTIF:MM:RRGGBB", value_parser = print)]
    pub print: Option<Print>,
    #[command(flatten)]
    pub art: ArtOptions,
}

impl ClothOptions {
    /// Whether none of them is given.
    pub fn is_empty(&self) -> bool {
        let Self { colourway, fabric, colour, print, art } = self;
        colourway.is_none()
            && fabric.is_none()
            && colour.is_none()
            && print.is_none()
            && art.files().next().is_none()
    }
}

fn colour(text: &str) -> Result<[u8; 3], String> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    let number =
        u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6 && !digits.starts_with('+'));
    let number =
        number.ok_or_else(|| format!("{text:?} is not a colour of six hexadecimal digits, as ff8000"))?;
    let [_, red, green, blue] = number.to_be_bytes();
    Ok([red, green, blue])
}

fn print(text: &str) -> Result<Print, String> {
    let parts: Vec<&str> = text.split(':').collect();
    let [motif, repeat, ink] = parts[..] else {
        return Err(format!("{text:?} is not MOTIF:MM:RRGGBB, as checks:20:ffffff"));
    };
    let repeat = repeat.parse::<f64>().ok().filter(|mm| mm.is_finite());
    let millimetres =
        repeat.ok_or_else(|| format!("the repeat in {text:?} is not a number of millimetres"))?;
    Ok(Print { motif: motif.parse()?, repeat_m: millimetres / 1e3, colour: colour(ink)? })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::Motif;

    #[test]
    fn colours_and_prints_are_read_or_refused_in_words() {
        assert_eq!(colour("#ff8000"), Ok([255, 128, 0]));
        assert_eq!(colour("0000fF"), Ok([0, 0, 255]));
        for wrong in ["", "red", "ff80", "ff80001", "+ff800", "ff800é"] {
            assert!(colour(wrong).is_err_and(|words| words.contains("hexadecimal")), "{wrong}");
        }
        let checks = Print { motif: Motif::Checks, repeat_m: 0.0125, colour: [1, 2, 3] };
        assert_eq!(print("checks:12.5:010203"), Ok(checks));
        for wrong in ["checks", "checks:12:010203:4", "plaid:1:010203", "dots:nan:010203", "dots:x:010203"] {
            assert!(print(wrong).is_err(), "{wrong}");
        }
    }
}
