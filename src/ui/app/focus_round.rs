//! The round of F6: panes and bars that get the keyboard one after the other; and Esc, which leads from a bar back to a pane.

use std::collections::BTreeMap;

use egui::{Context, Id, Key, Modifiers, Order, Popup, Rect, WidgetRect};

use crate::ui::actions::context::FrameContext;
use crate::ui::app::App;

/// A bar with buttons. F6 goes through them in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Bar {
    /// The drawer below the panes.
    Drawer,
    /// The side panel.
    Side,
    Toolbar,
    /// The strip of tools beside the pattern pane.
    PatternTools,
    /// The bar over the pattern pane with options of its tool.
    ToolOptions,
    /// The small buttons in the body pane.
    ViewButtons,
    Menu,
}

/// Names of the areas that float over the panes and have buttons.
const FLOATING: [&str; 5] = ["environment map", "aperture", "pictures", "tour", "demo"];

/// A place that F6 gives the keyboard to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stop {
    Pane(Id),
    /// An area that floats over the panes, by its name.
    Floating(&'static str),
    Bar(Bar),
}

/// Where the keyboard was and can go.
#[derive(Debug, Default)]
pub struct FocusRound {
    /// The panels that are shown in this frame.
    panels: BTreeMap<Bar, Rect>,
    /// The bar that had the keyboard at the end of the last frame, if nothing was typed there and no menu was open.
    bar: Option<Stop>,
    /// The pane that had the keyboard last.
    pane: Option<Id>,
}

impl FocusRound {
    /// Tells the area of a panel in this frame.
    pub fn show(&mut self, bar: Bar, area: Rect) {
        self.panels.insert(bar, area);
    }
}

impl App {
    /// Moves the keyboard focus from the pattern pane to the body pane, to what floats over it, to the bars in their order, and round
    /// again, or `back`; from anywhere else to the first of them.
    pub(in crate::ui) fn next_pane(&mut self, ctx: &Context, back: bool) {
        let mut stops = self.stops(ctx);
        if back {
            stops.reverse();
        }
        let now = self.stop_of_focus(ctx);
        let at = now.and_then(|now| stops.iter().position(|(stop, _)| *stop == now));
        let from = at.map_or(0, |at| at + 1);
        if let Some((_, id)) = stops.get(from % stops.len().max(1)) {
            ctx.memory_mut(|m| m.request_focus(*id));
        }
    }

    /// Esc in a bar gives the keyboard to the pane that had it last, and closes a bar that can be closed. It first cancels what is
    /// in progress, and closes dialogs.
    pub(in crate::ui) fn escape_from_bar(&mut self, ctx: &Context, now: &FrameContext) {
        let is_wanted = now.stops.is_some() || now.demo || self.dialog.is_some() || self.shell.is_asking();
        let Some(bar) = self.shell.round.bar.filter(|_| !is_wanted) else { return };
        if ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
            self.leave_bar(ctx, bar);
        }
    }

    /// Notes where the keyboard is at the end of a frame.
    pub(in crate::ui) fn tend_focus(&mut self, ctx: &Context) {
        let has_own_escape = ctx.text_edit_focused() || Popup::is_any_open(ctx);
        let stop = self.stop_of_focus(ctx);
        let round = &mut self.shell.round;
        if let Some(Stop::Pane(id)) = stop {
            round.pane = Some(id);
        }
        round.bar = stop.filter(|stop| !matches!(stop, Stop::Pane(_)) && !has_own_escape);
        round.panels.clear();
    }

    fn leave_bar(&mut self, ctx: &Context, bar: Stop) {
        match bar {
            Stop::Floating("environment map") => self.shell.environment.is_rotated = false,
            Stop::Floating("aperture") => self.shell.sets_aperture = false,
            _ => {}
        }
        let panes = [self.pattern_pane.id, self.scene_pane.id];
        let last = self.shell.round.pane.filter(|pane| panes.contains(&Some(*pane)));
        let is_floating = matches!(bar, Stop::Floating(_));
        let pane = self.scene_pane.id.filter(|_| is_floating).or(last).or(panes[0]).or(panes[1]);
        if let Some(pane) = pane {
            ctx.memory_mut(|m| m.request_focus(pane));
            ctx.request_repaint();
        }
    }

    /// All places that can have the keyboard now, each with the widget that gets it.
    fn stops(&self, ctx: &Context) -> Vec<(Stop, Id)> {
        let panes = [self.pattern_pane.id, self.scene_pane.id].into_iter().flatten();
        let panes = panes.map(|id| (Stop::Pane(id), id));
        let floating = FLOATING.into_iter().filter_map(|name| {
            let first = first_widget(ctx, |widget| widget.layer_id.id == Id::unique(name))?;
            Some((Stop::Floating(name), first))
        });
        let bars = self.bars().into_iter().filter_map(|(bar, area)| {
            // Edges of panels, by which their size is changed, are none of their buttons.
            let inside = area.shrink(3.0);
            let first = match bar {
                Bar::Side => self.shell.first_of_panel,
                Bar::Toolbar => self.shell.first_tool,
                _ => first_widget(ctx, |widget| is_of_panel(widget) && inside.contains(widget.rect.center())),
            };
            Some((Stop::Bar(bar), first?))
        });
        panes.chain(floating).chain(bars).collect()
    }

    /// The areas of all bars that are shown.
    fn bars(&self) -> BTreeMap<Bar, Rect> {
        let mut bars = self.shell.round.panels.clone();
        let [tools, options] = self.pattern_pane.bars;
        let buttons = self.scene_pane.buttons.filter(|_| self.scene_pane.id.is_some());
        let in_panes = [(Bar::PatternTools, tools), (Bar::ToolOptions, options), (Bar::ViewButtons, buttons)];
        bars.extend(in_panes.into_iter().filter_map(|(bar, area)| Some((bar, area?))));
        bars
    }

    /// The place that has the keyboard.
    fn stop_of_focus(&self, ctx: &Context) -> Option<Stop> {
        let id = ctx.memory(|m| m.focused())?;
        if [self.pattern_pane.id, self.scene_pane.id].contains(&Some(id)) {
            return Some(Stop::Pane(id));
        }
        let widget = ctx.viewport(|viewport| viewport.this_pass.widgets.get(id).copied())?;
        let floating = FLOATING.into_iter().find(|name| widget.layer_id.id == Id::unique(name));
        if let Some(name) = floating {
            return Some(Stop::Floating(name));
        }
        let mut bars = self.bars().into_iter().filter(|_| is_of_panel(&widget));
        bars.find(|(_, area)| area.contains(widget.rect.center())).map(|(bar, _)| Stop::Bar(bar))
    }
}

/// Whether a widget is in a panel or pane and does not float over them.
fn is_of_panel(widget: &WidgetRect) -> bool {
    widget.layer_id.order == Order::Background
}

/// The first widget of this frame that can have the keyboard and is `wanted`.
fn first_widget(ctx: &Context, wanted: impl Fn(&WidgetRect) -> bool) -> Option<Id> {
    ctx.viewport(|viewport| {
        let mut all = viewport.this_pass.widgets.layers().flat_map(|(_, widgets)| widgets);
        all.find(|widget| widget.enabled && widget.sense.is_focusable() && wanted(widget))
            .map(|widget| widget.id)
    })
}
