//! The arguments of benchmarks, and of the generated garments that some of them dress.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::body::NamedPose;
use crate::cli::arguments::WorkOptions;
use crate::draft::{BodySize, Corpus, Kind, SIZES, Shard};

/// Options that choose generated garments.
#[derive(Clone, Debug, Default, PartialEq, Args)]
pub struct CorpusOptions {
    /// Number of designs, each for every body in every pose; 500 when left out
    #[arg(long, value_name = "DESIGNS", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub count: Option<u32>,
    /// Seed of the random designs; 1 when left out
    #[arg(long)]
    pub seed: Option<u64>,
    /// Only one part of the garments, such as 2/8 for the second of eight
    #[arg(long, value_name = "PART/OF")]
    pub shard: Option<Shard>,
    /// Only for these bodies: xs, s, m, l, xl, xxl; several with commas
    #[arg(long, value_name = "SIZES", value_delimiter = ',')]
    pub body_sizes: Vec<BodySize>,
    /// Only in these poses: a, t; several with commas
    #[arg(long, value_name = "POSES", value_delimiter = ',', value_parser = corpus_pose)]
    pub poses: Vec<NamedPose>,
    /// Only these kinds, such as shirt,raglan,trousers; several with commas
    #[arg(long, value_name = "KINDS", value_delimiter = ',')]
    pub kinds: Vec<Kind>,
}

fn corpus_pose(text: &str) -> Result<NamedPose, String> {
    let pose = text.parse().ok().filter(|pose| [NamedPose::A, NamedPose::T].contains(pose));
    pose.ok_or_else(|| format!("{text:?} is neither a nor t: patterns are placed for arms half up or level"))
}

impl CorpusOptions {
    /// The corpus of garments that the options choose.
    pub fn corpus(&self) -> Corpus {
        let or_all = |own: &[BodySize]| if own.is_empty() { SIZES.to_vec() } else { own.to_vec() };
        Corpus {
            seed: self.seed.unwrap_or(1),
            designs: self.count.unwrap_or(500),
            sizes: or_all(&self.body_sizes),
            poses: if self.poses.is_empty() { vec![NamedPose::A, NamedPose::T] } else { self.poses.clone() },
            kinds: self.kinds.clone(),
        }
    }
}

/// Measures how fast and how accurate the program is on this machine, against its limits
#[derive(Debug, Args)]
pub struct Bench {
    /// What to measure; speed and accuracy when left out
    pub what: Option<BenchKind>,
    /// Number of runs of each scene; the median counts
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub runs: u16,
    /// Approximate number of triangles of each garment; the limits are for 10000, those of ticks for 20000, which are the
    /// defaults
    #[arg(long, value_parser = clap::value_parser!(u32).range(200..=1_000_000))]
    pub triangles: Option<u32>,
    /// Writes a picture of error against time, or of cost against size, to this file (SVG)
    #[arg(long, value_name = "SVG")]
    pub plot: Option<PathBuf>,
    /// Holds every figure against what the same bench printed with --json into this file; more than a tenth worse is a loss (exit
    /// code 1)
    #[arg(long, value_name = "JSON")]
    pub against: Option<PathBuf>,
    #[command(flatten)]
    pub corpus: CorpusOptions,
    #[command(flatten)]
    pub trust: TrustOptions,
    /// For corpus: limit of ticks for a garment; as for dress when left out
    #[arg(long)]
    pub max_ticks: Option<u64>,
    /// Keeps in this folder, for corpus, what was not dressed well (pattern, report, picture and the command line), and for
    /// trust, the files that a reader could not handle
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub work: WorkOptions,
    /// Prints a JSON object a line
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

/// Options of the benchmark `trust`.
#[derive(Clone, Debug, Default, PartialEq, Args)]
pub struct TrustOptions {
    /// Number of damaged files for each reader; 1000 when left out
    #[arg(long, value_name = "FILES", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub mutations: Option<u64>,
    /// Number of the first damaged file: the same number gives the same file
    #[arg(long, value_name = "NUMBER")]
    pub first: Option<u64>,
    /// Only these readers, such as obj,svg
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub readers: Vec<String>,
}

/// A benchmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BenchKind {
    /// Time of what a user waits for
    Speed,
    /// Error against time, where the exact answer is known
    Accuracy,
    /// Cost of cloth under physics at a tenth, once and four times --triangles: sheets that swing and fall, a dress sewn
    Drape,
    /// Share of garments of our own (see generate) that are dressed without a fault, by kind, with times and reasons
    Corpus,
    /// The longest tick and the longest request of every stage: a cancel or another request waits for no more than that
    Ticks,
    /// A dress draped by the processor and on the graphics card
    Card,
    /// Files damaged at random: each is read or refused in words, in time
    Trust,
}
