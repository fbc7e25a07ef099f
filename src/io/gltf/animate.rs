//! Evaluates glTF animations at a given time (glTF 2.0, section 3.11 and appendix C).

use glam::{DQuat, DVec3, DVec4};
use gltf::animation::{Interpolation, Property};

use super::numbers::Numbers;
use super::{GltfError, Pose, channel_place, fault, turn};
use crate::geometry::words::words;

/// Largest number of keyframes of one channel.
const MOST_KEYS: usize = 1_000_000;

/// One animation.
#[derive(Debug)]
pub struct Clip {
    pub name: String,
    pub seconds: f64,
    tracks: Vec<Track>,
}

/// One animation channel: the keyframes of one property of one node.
#[derive(Debug)]
struct Track {
    node: usize,
    property: Property,
    interpolation: Interpolation,
    /// Times of the keyframes, seconds, ascending.
    times: Vec<f64>,
    /// `width` values for each keyframe; for cubic splines 3 × `width`: in-tangent, value, out-tangent.
    values: Vec<f64>,
    width: usize,
}

impl Clip {
    pub fn new(animation: &gltf::Animation<'_>, numbers: &Numbers<'_>) -> Result<Self, GltfError> {
        let tracks = animation.channels().enumerate().map(|(i, channel)| {
            Track::new(&channel, numbers).map_err(|error| match error {
                GltfError::File(why) => fault(channel_place(animation.index(), i).and(": ", why)),
                over => over,
            })
        });
        let tracks: Vec<Track> = tracks.collect::<Result<_, _>>()?;
        let seconds = tracks.iter().filter_map(|track| track.times.last().copied()).fold(0.0, f64::max);
        Ok(Self { name: animation.name().unwrap_or_default().to_owned(), seconds, tracks })
    }

    /// Sets the node poses and morph weights that this animation moves to their values at a time in seconds.
    pub fn apply(&self, seconds: f64, poses: &mut [Pose], weights: &mut [Vec<f64>]) {
        for track in &self.tracks {
            let value = track.value(seconds);
            let pose = &mut poses[track.node];
            match (track.property, &value[..]) {
                (Property::Translation, &[x, y, z]) => pose.translation = DVec3::new(x, y, z),
                (Property::Scale, &[x, y, z]) => pose.scale = DVec3::new(x, y, z),
                (Property::Rotation, &[x, y, z, w]) => pose.rotation = turn([x, y, z, w]),
                (Property::MorphTargetWeights, _) => weights[track.node] = value,
                _ => {}
            }
        }
    }
}

impl Track {
    fn new(channel: &gltf::animation::Channel<'_>, numbers: &Numbers<'_>) -> Result<Self, GltfError> {
        let sampler = channel.sampler();
        let times: Vec<f64> = numbers.floats::<1>(&sampler.input())?.into_iter().map(|[t]| t).collect();
        if times.is_empty() || times.len() > MOST_KEYS {
            let (n, most) = (times.len(), MOST_KEYS);
            return Err(fault(words!("it has {n} keys, 1 to {most} are read", n, most)));
        }
        if times.windows(2).any(|pair| pair[0] > pair[1]) || times[0] < 0.0 {
            return Err(fault(words!("the times of its keys do not rise from 0")));
        }
        let (property, output) = (channel.target().property(), sampler.output());
        let values: Vec<f64> = match property {
            Property::Translation | Property::Scale => numbers.floats::<3>(&output)?.concat(),
            Property::Rotation => numbers.floats::<4>(&output)?.concat(),
            Property::MorphTargetWeights => numbers.floats::<1>(&output)?.concat(),
        };
        let interpolation = sampler.interpolation();
        let keys = times.len() * if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let width = values.len() / keys;
        let expected = match property {
            Property::Translation | Property::Scale => 3,
            Property::Rotation => 4,
            Property::MorphTargetWeights => width,
        };
        if width == 0 || width != expected || values.len() != keys * width {
            return Err(fault(words!("it has other numbers of times and of values")));
        }
        Ok(Self { node: channel.target().node().index(), property, interpolation, times, values, width })
    }

    /// The value of keyframe `i`. With cubic splines `which` selects the in-tangent (0), the value (1) or the out-tangent (2);
    /// else it is ignored.
    fn key(&self, i: usize, which: usize) -> &[f64] {
        let at = match self.interpolation {
            Interpolation::CubicSpline => 3 * i + which,
            _ => i,
        };
        &self.values[at * self.width..(at + 1) * self.width]
    }

    fn value(&self, seconds: f64) -> Vec<f64> {
        let next = self.times.partition_point(|&t| t <= seconds);
        let Some(i) = next.checked_sub(1) else { return self.key(0, 1).to_vec() };
        if next == self.times.len() {
            return self.key(i, 1).to_vec();
        }
        let span = self.times[next] - self.times[i];
        let t = (seconds - self.times[i]) / span;
        let (from, to) = (self.key(i, 1), self.key(next, 1));
        match self.interpolation {
            Interpolation::Step => from.to_vec(),
            Interpolation::Linear if self.property == Property::Rotation => {
                let [from, to] = [from, to].map(|q| turn([q[0], q[1], q[2], q[3]]));
                DVec4::from(shorter(from, to).slerp(to, t)).to_array().to_vec()
            }
            Interpolation::Linear => from.iter().zip(to).map(|(a, b)| a + (b - a) * t).collect(),
            Interpolation::CubicSpline => {
                let (t2, t3) = (t * t, t * t * t);
                let shares = [2.0 * t3 - 3.0 * t2 + 1.0, t3 - 2.0 * t2 + t, 3.0 * t2 - 2.0 * t3, t3 - t2];
                let (out, into) = (self.key(i, 2), self.key(next, 0));
                let each = |k: usize| {
                    from[k] * shares[0]
                        + out[k] * span * shares[1]
                        + to[k] * shares[2]
                        + into[k] * span * shares[3]
                };
                (0..self.width).map(each).collect()
            }
        }
    }
}

/// `turn` or `-turn`, which stand for the same rotation: whichever is nearer to `other`, so that slerp takes the shorter way.
fn shorter(turn: DQuat, other: DQuat) -> DQuat {
    if turn.dot(other) < 0.0 { -turn } else { turn }
}
