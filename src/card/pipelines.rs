//! The shaders, and which buffers each of them is bound to.

use std::collections::BTreeMap;

use crate::card::buffers::{Buffers, slot};
use crate::card::device::Device;

const SOURCE: [&str; 4] = [
    include_str!("../../shaders/card/scene.wgsl"),
    include_str!("../../shaders/card/step.wgsl"),
    include_str!("../../shaders/card/body.wgsl"),
    include_str!("../../shaders/card/contact.wgsl"),
];

/// The entry points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Work {
    Begin,
    Go,
    Finish,
    Bend,
    Look,
    Anchor,
    Enclose,
    Refit,
    Gather,
    Part,
    Collect,
}

/// Every entry point with its name and the bindings that it uses.
const TABLE: [(Work, &str, &[u32]); 11] = [
    (Work::Begin, "begin", &[0, 2, 3, 4, 5, 6]),
    (Work::Go, "go", &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 33]),
    (Work::Finish, "finish", &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 33]),
    (Work::Bend, "bend", &[0, 2, 4, 6, 24, 25]),
    (Work::Look, "look", &[0, 2, 4, 7, 26, 27, 28, 29, 30, 31, 33]),
    (Work::Anchor, "anchor", &[0, 2, 4, 8]),
    (Work::Enclose, "enclose", &[0, 8, 12, 13, 16]),
    (Work::Refit, "refit", &[14, 15, 16, 32, 34]),
    (Work::Gather, "gather", &[0, 8, 12, 13, 14, 15, 16, 17, 18, 19, 26, 27, 28, 29, 30, 35]),
    (Work::Part, "part", &[0, 1, 2, 4, 8, 12, 17, 18, 19, 20, 21, 23, 26, 27, 33, 35, 36, 37, 38]),
    (Work::Collect, "collect", &[0, 8, 9, 10, 11, 22, 35, 36, 37, 38]),
];

/// The compiled shaders.
#[derive(Debug)]
pub struct Pipelines {
    of: BTreeMap<Work, (wgpu::BindGroupLayout, wgpu::ComputePipeline)>,
}

/// Buffers bound to shaders: for each of the two directions in which positions are read and written.
#[derive(Debug)]
pub struct Bound {
    groups: BTreeMap<(Work, usize), wgpu::BindGroup>,
    /// For each level of the cloth's tree: number of nodes, and the group.
    levels: Vec<(u32, wgpu::BindGroup)>,
}

impl Pipelines {
    pub fn new(device: &Device) -> Self {
        let source = wgpu::ShaderSource::Wgsl(SOURCE.concat().into());
        let module =
            device.gpu.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("draping"), source });
        let of = TABLE.iter().map(|&(work, name, bindings)| {
            let entries: Vec<_> = bindings.iter().map(|&binding| entry(binding)).collect();
            let layout = device.gpu.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(name),
                entries: &entries,
            });
            let pipeline_layout = device.gpu.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(name),
                bind_group_layouts: &[Some(&layout)],
                ..Default::default()
            });
            let pipeline = device.gpu.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(name),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(name),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
            (work, (layout, pipeline))
        });
        Self { of: of.collect() }
    }

    /// Binds `buffers`.
    pub fn bind(&self, device: &Device, buffers: &Buffers) -> Bound {
        let group = |work: Work, bindings: &[u32], turn: usize, level: Option<&wgpu::Buffer>| {
            let entries: Vec<_> = bindings
                .iter()
                .map(|&binding| {
                    let buffer = match level {
                        Some(level) if binding == slot::LEVEL => level,
                        _ => buffers.of(turned(binding, turn)),
                    };
                    wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() }
                })
                .collect();
            let layout = &self.of[&work].0;
            device.gpu.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout,
                entries: &entries,
            })
        };
        let (mut groups, mut levels) = (BTreeMap::new(), Vec::new());
        for (work, _, bindings) in TABLE {
            if work == Work::Refit {
                let of_level =
                    |(count, level): &(u32, wgpu::Buffer)| (*count, group(work, bindings, 0, Some(level)));
                levels = buffers.levels.iter().map(of_level).collect();
            } else {
                for turn in 0..2 {
                    groups.insert((work, turn), group(work, bindings, turn, None));
                }
            }
        }
        Bound { groups, levels }
    }

    /// Runs `work` for `count` items. `turn`: which of the two buffers of positions is read.
    pub fn run(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        bound: &Bound,
        (work, turn): (Work, usize),
        count: usize,
    ) {
        pass.set_pipeline(&self.of[&work].1);
        pass.set_bind_group(0, &bound.groups[&(work, turn)], &[]);
        pass.dispatch_workgroups(groups_of(count as u32), 1, 1);
    }

    /// Fits the boxes of the cloth's tree.
    pub fn refit(&self, pass: &mut wgpu::ComputePass<'_>, bound: &Bound) {
        pass.set_pipeline(&self.of[&Work::Refit].1);
        for (count, group) in &bound.levels {
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(groups_of(*count), 1, 1);
        }
    }
}

/// Groups of 64 threads.
fn groups_of(count: u32) -> u32 {
    count.div_ceil(64)
}

/// The buffer behind `binding`: positions and velocities change places with the next ones in every second step.
fn turned(binding: u32, turn: usize) -> u32 {
    match (binding, turn) {
        (slot::PLACES, 1) => slot::NEXT_PLACES,
        (slot::NEXT_PLACES, 1) => slot::PLACES,
        (slot::VELOCITIES, 1) => slot::NEXT_VELOCITIES,
        (slot::NEXT_VELOCITIES, 1) => slot::VELOCITIES,
        _ => binding,
    }
}

fn entry(binding: u32) -> wgpu::BindGroupLayoutEntry {
    let ty = match binding {
        slot::SCENE | slot::LEVEL => wgpu::BufferBindingType::Uniform,
        _ => wgpu::BufferBindingType::Storage { read_only: slot::READ_ONLY.contains(&binding) },
    };
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    }
}
