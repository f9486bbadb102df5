import type { Frame } from "../data/frame.ts";
import type { Player } from "../data/player.ts";
import type { Schema } from "../data/schema.ts";
import { LEGS } from "../data/schema.ts";
import type { Series } from "../data/source.ts";
import { h, say } from "./dom.ts";
import { Plot } from "./plot.ts";

/** Plots are drawn anew this often while time goes on [s]. */
const PERIOD = 0.1;
const LIVE_SPAN = 10;
const LONGEST_LIST = 60;
/** More lines than this can't be told apart. */
const MOST_LINES = 6;

/** Plots of any channel, all over the same stretch of time. */
export class PlotsPanel {
  private readonly plots: Plot[] = [];
  private readonly row = h("div", { class: "plot-row" });
  private readonly search: HTMLInputElement;
  private readonly found = h("ul", { class: "found popover", role: "listbox", hidden: true });
  private readonly spanSelect: HTMLSelectElement;
  private schema: Schema;
  /** Width of what is shown [s]; 0: all of a log. */
  private span: number;
  private from = NaN;
  private since = Infinity;
  private sincePicture = Infinity;
  /** Times of the player and of the picture when the plots were drawn last. */
  private drawn = NaN;
  private pictured = NaN;
  private readonly progress = h("span", { class: "soft", id: "plots-progress" });

  constructor(root: HTMLElement, private readonly player: Player, schema: Schema) {
    this.schema = schema;
    this.span = player.live ? LIVE_SPAN : 0;
    this.search = h("input", {
      type: "search", id: "channel-search", placeholder: "plot a channel …", "aria-label": "search a channel to plot",
      oninput: () => this.list(), onfocus: () => this.list(), autocomplete: "off",
    });
    this.spanSelect = h("select", { "aria-label": "time shown in the plots", id: "span", onchange: () => this.setSpan(Number(this.spanSelect.value)) });
    for (const [seconds, text] of [[2, "2 s"], [10, "10 s"], [30, "30 s"], [120, "2 min"], [0, "all"]] as const)
      this.spanSelect.append(h("option", { value: seconds }, text));
    this.spanSelect.value = String(this.span);
    this.search.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.found.hidden = true;
      if (event.key === "Enter") this.found.querySelector("button")?.click();
    });
    document.addEventListener("pointerdown", (event) => {
      if (!root.contains(event.target as Node)) this.found.hidden = true;
    });
    root.append(h("div", { class: "plot-tools" }, this.search, this.spanSelect, this.progress, this.found), this.row);
    new ResizeObserver(() => this.plots.forEach((plot) => plot.resize())).observe(this.row);
    this.addFirst();
  }

  private addFirst(): void {
    this.add("normal forces", LEGS.map((leg) => ({ channel: `truth.feet.${leg}.force`, index: 2 })));
    this.add("base velocity", [0, 1, 2].map((index) => ({ channel: "state.v_WB", index })));
  }

  add(title: string, series: Series[]): void {
    const known = series.filter(({ channel }) => this.schema.offset(channel) >= 0);
    if (known.length === 0) return;
    const plot: Plot = new Plot(this.titleOf(title, known), known, this.schema, () => this.remove(plot));
    plot.onSeek = (time) => this.player.seek(time);
    plot.onZoom = (factor, about) => this.zoom(factor, about);
    this.plots.push(plot);
    this.row.append(plot.root);
    this.since = Infinity;
  }

  private titleOf(title: string, series: Series[]): string {
    const unit = this.schema.channel((series[0] as Series).channel)?.unit ?? "";
    return unit === "" ? title : `${title} [${unit}]`;
  }

  private remove(plot: Plot): void {
    this.plots.splice(this.plots.indexOf(plot), 1);
    plot.root.remove();
  }

  /** The channels that hold every word of what was typed. */
  private list(): void {
    const words = this.search.value.toLowerCase().split(/\s+/);
    const matching = this.schema.channels.filter((channel) => {
      const text = `${channel.name} ${channel.about} ${channel.unit}`.toLowerCase();
      return words.every((part) => text.includes(part));
    });
    this.found.replaceChildren(...matching.slice(0, LONGEST_LIST).map((channel) =>
      h("li", {},
        h("button", { onclick: () => this.choose(channel.name, channel.size) },
          h("b", {}, channel.name), ` ${channel.unit === "" ? "" : `[${channel.unit}] `}`, h("span", { class: "soft" }, channel.about)))));
    if (matching.length > LONGEST_LIST) this.found.append(h("li", { class: "soft" }, `and ${matching.length - LONGEST_LIST} more`));
    if (matching.length === 0) this.found.append(h("li", { class: "soft" }, "no channel is called so"));
    this.found.hidden = false;
  }

  private choose(name: string, size: number): void {
    for (let begin = 0; begin < size; begin += MOST_LINES)
      this.add(name, Array.from({ length: Math.min(MOST_LINES, size - begin) }, (_, k) => ({ channel: name, index: begin + k })));
    this.found.hidden = true;
    this.search.value = "";
  }

  private setSpan(span: number): void {
    this.span = span;
    this.from = NaN;
    this.since = Infinity;
  }

  private zoom(factor: number, about: number): void {
    const [from, to] = this.range();
    const { first, last } = this.player.source;
    const span = Math.min(Math.max((to - from) * factor, 0.05), Math.max(last - first, 0.05));
    this.span = span;
    this.from = Math.min(Math.max(about - ((about - from) / (to - from)) * span, first), last - span);
    this.since = Infinity;
  }

  private range(): [number, number] {
    const { time, source, following } = this.player;
    const { first, last } = source;
    const span = this.span === 0 ? Math.max(last - first, 0.1) : this.span;
    if (following) {
      this.from = NaN;
      const from = this.span === 0 ? first : Math.max(first, time - span);
      return [from, from + span];
    }
    if (Number.isNaN(this.from)) this.from = Math.max(first, Math.min(time - 0.5 * span, last - span));
    if (time < this.from || time > this.from + span) this.from = Math.max(first, Math.min(time - 0.1 * span, last - span));
    return [this.from, this.from + span];
  }

  /** Something that plots show has come. */
  refresh(): void {
    this.since = Infinity;
  }

  use(schema: Schema): void {
    this.schema = schema;
  }

  /** Empties all plots until the next tick. */
  clear(): void {
    for (const plot of this.plots) plot.clear();
    this.from = NaN;
    this.since = Infinity;
  }

  /** Colours or sizes are others. */
  rebuild(): void {
    for (const plot of this.plots) plot.build();
    this.since = Infinity;
  }

  /** How far what they show has come; "": it is here. */
  showProgress(text: string): void {
    say(this.progress, text);
  }

  /** `frame`: that of the picture. */
  update(dt: number, frame: Frame | undefined): void {
    const { time } = this.player;
    const pictured = frame?.time ?? time;
    const isNew = pictured !== this.pictured; // drawn in the same step as the picture
    this.since += dt;
    this.sincePicture += dt;
    if ((isNew ? this.sincePicture : this.since) < PERIOD || Number.isNaN(time)) return;
    if (!isNew && time === this.drawn && this.since !== Infinity) return;
    if (this.row.offsetParent === null) return;
    this.since = 0;
    if (isNew) this.sincePicture = 0;
    this.drawn = time;
    this.pictured = pictured;
    const [from, to] = this.range();
    for (const plot of this.plots) {
      plot.draw(this.player.source, from, to, pictured);
      if (frame !== undefined) plot.tell(frame);
    }
  }
}
