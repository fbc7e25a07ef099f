//! Lengths as people read and type them: centimetres, millimetres or inches, with arithmetic.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::ui::language::{decimal_sign, say, short, tr};

/// The unit in which lengths are shown, and of numbers typed without a unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LengthUnit {
    #[default]
    Cm,
    Mm,
    Inch,
}

impl LengthUnit {
    /// All units, in the order of the menu.
    pub const ALL: [Self; 3] = [Self::Cm, Self::Mm, Self::Inch];

    /// Name for menus.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cm => "Centimetres",
            Self::Mm => "Millimetres",
            Self::Inch => "Inches",
        }
    }

    /// Symbol after numbers.
    pub fn sign(self) -> &'static str {
        match self {
            Self::Cm => "cm",
            Self::Mm => "mm",
            Self::Inch => "in",
        }
    }

    /// Length of the unit, metres.
    pub fn metres(self) -> f64 {
        match self {
            Self::Cm => 0.01,
            Self::Mm => 0.001,
            Self::Inch => 0.0254,
        }
    }

    /// A length without its unit, rounded to what can be drawn by hand.
    pub fn number(self, metres: f64) -> String {
        let digits = match self {
            Self::Cm => 2,
            Self::Mm => 1,
            Self::Inch => 3,
        };
        short(metres / self.metres(), digits)
    }

    /// A length with its unit.
    pub fn text(self, metres: f64) -> String {
        format!("{} {}", self.number(metres), self.sign())
    }

    /// A point with its unit: "12.5, 30 cm"; where numbers have commas, "12,5; 30 cm".
    pub fn point(self, p: DVec2) -> String {
        let between = if decimal_sign() == ',' { ';' } else { ',' };
        format!("{}{between} {}", self.number(p.x), self.text(p.y))
    }

    /// Steps of grid and rulers, metres; each is a whole multiple of an earlier one.
    pub fn steps(self) -> &'static [f64] {
        match self {
            Self::Cm | Self::Mm => &[0.001, 0.005, 0.01, 0.05, 0.1, 0.5, 1.0],
            Self::Inch => &[0.003175, 0.0127, 0.0254, 0.1524, 0.3048, 0.9144],
        }
    }
}

/// An angle in degrees, for people.
pub fn degrees(radians: f64) -> String {
    short(radians.to_degrees(), 1)
}

/// Numbers typed while drawing or dragging.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Typed {
    /// A length in the direction of the pointer: "12". Metres.
    Length(f64),
    /// A position on the table, or a width and height: "30,40". Metres.
    At(DVec2),
    /// An offset from the last point: "@10,0", or by length and angle in degrees: "10<45". Metres.
    By(DVec2),
}

/// Parses typed numbers. x and y are separated by a semicolon; by a comma, too, where that is not the decimal sign of the language.
pub fn typed(text: &str, unit: LengthUnit) -> Result<Typed, String> {
    let text = text.trim();
    let (relative, text) = match text.strip_prefix('@') {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    if let Some((far, turn)) = text.split_once('<') {
        let turn = number(turn.trim().trim_end_matches('°'))?.to_radians();
        return Ok(Typed::By(DVec2::from_angle(turn) * length(far, unit)?));
    }
    let comma = || if decimal_sign() == ',' { None } else { text.split_once(',') };
    let parts = text.split_once(';').or_else(comma);
    match parts {
        Some((x, y)) => {
            let p = DVec2::new(length(x, unit)?, length(y, unit)?);
            Ok(if relative { Typed::By(p) } else { Typed::At(p) })
        }
        None => Ok(Typed::Length(length(text, unit)?)),
    }
}

/// Parses a length: "12.5cm+1/2in", "3 1/2 in", "(40-2)/3". A number without a unit is in `unit`. The result is in metres.
pub fn length(text: &str, unit: LengthUnit) -> Result<f64, String> {
    let value = Reader::read(text, unit)?;
    match value.power {
        0 => Ok(value.amount * unit.metres()),
        1 => Ok(value.amount),
        _ => Err(tr("that is not a length").to_owned()),
    }
    .and_then(finite)
}

/// Parses a plain number, with arithmetic.
pub fn number(text: &str) -> Result<f64, String> {
    let value = Reader::read(text, LengthUnit::Cm)?;
    if value.power == 0 {
        finite(value.amount)
    } else {
        Err(tr("here belongs a number without a unit").to_owned())
    }
}

fn finite(x: f64) -> Result<f64, String> {
    if x.is_finite() && x.abs() < 1e6 { Ok(x) } else { Err(tr("that number is too large").to_owned()) }
}

/// A value during parsing: `power` is 0 for a number, 1 for a length in metres, others for products and quotients of lengths.
#[derive(Clone, Copy, Debug)]
struct Value {
    amount: f64,
    power: i32,
}

/// A parser of sums of products of numbers, fractions, units and brackets.
struct Reader<'a> {
    rest: &'a str,
    unit: LengthUnit,
    depth: u32,
}

/// Largest nesting depth of brackets.
const DEEPEST: u32 = 40;

impl<'a> Reader<'a> {
    fn read(text: &'a str, unit: LengthUnit) -> Result<Value, String> {
        let mut reader = Self { rest: text.trim(), unit, depth: 0 };
        if reader.rest.is_empty() {
            return Err(tr("type a number").to_owned());
        }
        let value = reader.sum()?;
        match reader.rest.chars().next() {
            None => Ok(value),
            Some(c) => Err(say!("'{c}' is not understood here", c)),
        }
    }

    fn take(&mut self, sign: char) -> bool {
        self.rest = self.rest.trim_start();
        match self.rest.strip_prefix(sign) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn sum(&mut self) -> Result<Value, String> {
        let mut total = self.product()?;
        loop {
            let sign = if self.take('+') {
                1.0
            } else if self.take('-') {
                -1.0
            } else {
                return Ok(total);
            };
            let mut next = self.product()?;
            // In a sum of a length and a plain number, such as "12 cm + 3", the number is in the shown unit.
            if total.power + next.power == 1 {
                for value in [&mut total, &mut next].into_iter().filter(|value| value.power == 0) {
                    *value = Value { amount: value.amount * self.unit.metres(), power: 1 };
                }
            }
            if total.power != next.power {
                return Err(tr("a length and an area cannot be added").to_owned());
            }
            total.amount += sign * next.amount;
        }
    }

    fn product(&mut self) -> Result<Value, String> {
        let mut total = self.factor()?;
        loop {
            if self.take('*') || self.take('×') {
                let next = self.factor()?;
                total = Value { amount: total.amount * next.amount, power: total.power + next.power };
            } else if self.take('/') {
                let next = self.factor()?;
                if next.amount == 0.0 {
                    return Err(tr("nothing can be divided by zero").to_owned());
                }
                total = Value { amount: total.amount / next.amount, power: total.power - next.power };
            } else {
                return Ok(total);
            }
        }
    }

    fn factor(&mut self) -> Result<Value, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(tr("that is too deeply nested").to_owned());
        }
        let value = if self.take('-') {
            let Value { amount, power } = self.factor()?;
            Value { amount: -amount, power }
        } else if self.take('+') {
            self.factor()?
        } else if self.take('(') {
            let inner = self.sum()?;
            if !self.take(')') {
                return Err(tr("a bracket is not closed").to_owned());
            }
            self.with_unit(inner)
        } else {
            let amount = self.mixed()?;
            self.with_unit(Value { amount, power: 0 })
        };
        self.depth -= 1;
        Ok(value)
    }

    /// Parses a number: "3", "3.5", "3,5", "3 1/2", and "1/2" where a unit follows.
    fn mixed(&mut self) -> Result<f64, String> {
        let whole = self.digits()?;
        let fraction = |text: &'a str| -> Option<(f64, &'a str)> {
            let text = text.trim_start();
            let (top, text) = whole_number(text)?;
            let (bottom, text) = whole_number(text.strip_prefix('/')?)?;
            (bottom > 0.0).then_some((top / bottom, text))
        };
        if self.rest.starts_with(' ')
            && let Some((part, rest)) = fraction(self.rest)
        {
            self.rest = rest;
            return Ok(whole + part);
        }
        if let Some((bottom, rest)) =
            self.rest.trim_start().strip_prefix('/').and_then(|t| whole_number(t.trim_start()))
            && bottom > 0.0
            && unit_of(rest).is_some()
        {
            self.rest = rest;
            return Ok(whole / bottom);
        }
        Ok(whole)
    }

    fn digits(&mut self) -> Result<f64, String> {
        self.rest = self.rest.trim_start();
        let end = self
            .rest
            .find(|c: char| !(c.is_ascii_digit() || c == '.' || c == ','))
            .unwrap_or(self.rest.len());
        let (number, rest) = self.rest.split_at(end);
        let value = number.replace(',', ".").parse::<f64>();
        let Ok(value) = value else {
            return Err(match self.rest.chars().next() {
                Some(c) if number.is_empty() => say!("'{c}' is not understood here", c),
                Some(_) => say!("'{number}' is no number", number),
                None => tr("something is missing at the end").to_owned(),
            });
        };
        self.rest = rest;
        Ok(value)
    }

    fn with_unit(&mut self, value: Value) -> Value {
        match unit_of(self.rest) {
            Some((metres, rest)) if value.power == 0 => {
                self.rest = rest;
                Value { amount: value.amount * metres, power: 1 }
            }
            _ => value,
        }
    }
}

fn whole_number(text: &str) -> Option<(f64, &str)> {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let value = text[..end].parse().ok()?;
    Some((value, &text[end..]))
}

/// The unit at the beginning of `text` as metres, and the rest of the text.
fn unit_of(text: &str) -> Option<(f64, &str)> {
    let text = text.trim_start();
    let units = [
        ("mm", 0.001),
        ("cm", 0.01),
        ("inch", 0.0254),
        ("in", 0.0254),
        ("\"", 0.0254),
        ("″", 0.0254),
        ("ft", 0.3048),
        ("'", 0.3048),
        ("m", 1.0),
    ];
    units.iter().find_map(|(sign, metres)| text.strip_prefix(sign).map(|rest| (*metres, rest)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Table, shown_in};

    #[test]
    fn lengths_are_read_with_units_and_arithmetic() {
        for (text, metres) in [
            ("12", 0.12),
            ("12.5cm+1/2in", 0.125 + 0.0127),
            ("3 1/2 in", 0.0889),
            ("3 1/2\"", 0.0889),
            ("1/2 in", 0.0127),
            ("12,5", 0.125),
            ("0.3 m - 5 cm", 0.25),
            ("(40-2)/4", 0.095),
            ("2*(10 cm + 5 mm)", 0.21),
            ("-4", -0.04),
            ("12cm + 3", 0.15),
            ("2*(1+1)*2cm", 0.08),
            ("100mm/2", 0.05),
            ("  7  ", 0.07),
        ] {
            let found = length(text, LengthUnit::Cm).unwrap_or_else(|why| panic!("{text}: {why}"));
            assert!((found - metres).abs() < 1e-12, "{text}: {found}");
        }
        assert!((length("2", LengthUnit::Inch).expect("two inches") - 0.0508).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_length_is_told() {
        let deep = "(".repeat(1000);
        for text in
            ["", "abc", "3cm*4cm", "1/0", "(1", "1)", "1..2", "12 cm cm", "1e9999", &deep, "9999999 m"]
        {
            assert!(length(text, LengthUnit::Cm).is_err(), "{text}");
        }
    }

    #[test]
    fn points_are_read_absolute_relative_and_polar() {
        let read = |text| typed(text, LengthUnit::Cm);
        assert_eq!(read("12"), Ok(Typed::Length(0.12)));
        assert_eq!(read("30,40"), Ok(Typed::At(DVec2::new(0.3, 0.4))));
        assert_eq!(read("30,5;-40"), Ok(Typed::At(DVec2::new(0.305, -0.4))));
        assert_eq!(read("@10,0"), Ok(Typed::By(DVec2::new(0.1, 0.0))));
        let Ok(Typed::By(p)) = read("10<90") else { panic!("polar") };
        assert!((p - DVec2::new(0.0, 0.1)).length() < 1e-12);
        assert!(read("10,").is_err());
    }

    #[test]
    fn in_german_lengths_have_commas_and_both_signs_are_read() {
        shown_in(Table::german(), || {
            assert_eq!([LengthUnit::Cm.text(0.12345), degrees(0.5)], ["12,35 cm", "28,6"]);
            for text in ["12,5", "12.5", "12,5 cm"] {
                assert_eq!(length(text, LengthUnit::Cm), Ok(0.125), "{text}");
                assert_eq!(typed(text, LengthUnit::Cm), Ok(Typed::Length(0.125)), "{text}");
            }
            let p = DVec2::new(0.305, 0.4);
            assert_eq!(typed("30,5;40", LengthUnit::Cm), Ok(Typed::At(p)));
            assert_eq!(LengthUnit::Cm.point(p), "30,5; 40 cm");
        });
        assert_eq!(LengthUnit::Cm.point(DVec2::new(0.305, 0.4)), "30.5, 40 cm");
    }

    #[test]
    fn lengths_are_shown_short() {
        assert_eq!(LengthUnit::Cm.text(0.12), "12 cm");
        assert_eq!(LengthUnit::Cm.text(0.12345), "12.35 cm");
        assert_eq!(LengthUnit::Inch.text(0.0127), "0.5 in");
        assert_eq!(LengthUnit::Mm.text(-1e-9), "0 mm");
        assert_eq!(degrees(std::f64::consts::FRAC_PI_4), "45");
        for unit in LengthUnit::ALL {
            assert!(unit.steps().windows(2).all(|w| (w[1] / w[0] - (w[1] / w[0]).round()).abs() < 1e-9));
        }
    }
}
