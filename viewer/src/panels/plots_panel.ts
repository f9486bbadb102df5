import type { Frame } from "../data/frame.ts";
import type { Player } from "../data/player.ts";
import type { Schema } from "../data/schema.ts";
import { hasBodies } from "../data/schema.ts";
import type { Series } from "../data/source.ts";
import { digits } from "../data/numbers.ts";
import { choicesOf, type Choice } from "../data/channel_names.ts";
import type { ChannelInfo } from "../protocol/session.ts";
import { h, setText } from "./dom.ts";
import { MOST_LINES } from "./line_styles.ts";
import { NumberMenu } from "./number_menu.ts";
import { Plot } from "./plot.ts";

/** Plots are drawn again this often [s]. */
const PERIOD = 0.1;
const LIVE_SPAN = 10;
/** Time spans of the menu [s]; 0: all. */
const SPANS = [2, 10, 30, 120, 0];
const SPAN_WORDS: Record<number, string> = { 120: "2 min", 0: "all" };
const LONGEST_LIST = 60;
/** Channels with more components offer them only when searched for. */
const MOST_CHOICES = 40;
const SEARCH = "plot a channel …";

function spanText(seconds: number): string {
  const number = SPANS.includes(seconds) ? String(seconds) : digits(seconds);
  return SPAN_WORDS[seconds] ?? `${number} s`;
}

/** A found channel with its choices; `isPart`: only choices match. */
interface Match {
  channel: ChannelInfo;
  choices: Choice[];
  isPart: boolean;
}

/** Channels and components whose names and descriptions contain every typed word. */
export function search(schema: Schema, typed: string): Match[] {
  const words = typed.trim().toLowerCase().split(/\s+/);
  const holds = (text: string): boolean => words.every((word) => text.toLowerCase().includes(word));
  const found = schema.channels.flatMap((channel): Match[] => {
    const text = `${channel.about} ${channel.unit}`;
    const choices = choicesOf(channel, schema);
    const few = hasBodies(channel, schema) ? choices.slice(0, MOST_CHOICES) : choices.length > MOST_CHOICES ? [] : choices;
    if (holds(`${channel.name} ${text}`)) return [{ channel, choices: few, isPart: false }];
    const some = choices.filter(({ name }) => holds(`${channel.name}.${name} ${text}`));
    return some.length > 0 ? [{ channel, choices: some.slice(0, MOST_CHOICES), isPart: true }] : [];
  });
  return typed.trim() === "" ? found : found.sort((a, b) => rankOf(a.channel.name, words) - rankOf(b.channel.name, words));
}

/** Topics in the order of interest, for channels that match equally well. */
const TOPICS = ["command", "readings", "state", "truth", "alignment", "plan", "model"];

/** Smaller is better: exact names, then names that contain the words, then descriptions. */
function rankOf(name: string, words: string[]): number {
  const parts = name.toLowerCase().split(".");
  const end = words.join(".").split(".");
  const isIt = end.every((part, k) => parts.at(k - end.length) === part);
  const fit = isIt ? 0 : words.every((word) => name.toLowerCase().includes(word)) ? 1 : 2;
  const topic = TOPICS.indexOf(parts[0] ?? "");
  return fit * (TOPICS.length + 1) + (topic < 0 ? TOPICS.length : topic);
}

/** Lines of a whole channel; of outside forces only the first choice, as most numbers are always 0. */
export function allOf(channel: ChannelInfo, choices: Choice[], schema: Schema): Series[] {
  const whole = Array.from({ length: channel.size }, (_, index) => ({ channel: channel.name, index }));
  return hasBodies(channel, schema) ? (choices[0]?.series ?? whole) : whole;
}

/** Room before the shown time, as a share of the span. */
const BEFORE = 0.05;

/** Range of live plots while the past is shown: from that time to now, at least `span` [s]. */
export function rangeOfPast(time: number, first: number, last: number, span: number): [number, number] {
  const from = Math.max(first, Math.min(last - span, time - (BEFORE / (1 - BEFORE)) * (last - time)));
  return [from, Math.max(last, from + span)];
}

/** Beginning of a span around this time, within the frames. */
function fromAround(time: number, first: number, last: number, span: number): number {
  return Math.max(first, Math.min(time - 0.5 * span, last - span));
}

/** Plots of any channels over the same time range. */
export class PlotsPanel {
  private readonly plots: Plot[] = [];
  private readonly row = h("div", { class: "plot-row" });
  private readonly search: HTMLInputElement;
  private readonly found = h("ul", { class: "found popover", "aria-label": "channels", hidden: true });
  /** The plot to which lines are added while the list is open; undefined: the next choice gets its own plot. */
  private target: Plot | undefined;
  /** The wheel can set other spans. */
  private readonly spans = new NumberMenu({ "aria-label": "time shown in the plots", id: "span" }, SPANS, spanText, (span) => this.setSpan(span));
  private schema: Schema;
  /** Shown time span [s]; 0: all. */
  private span: number;
  private from = NaN;
  private since = Infinity;
  private sincePicture = Infinity;
  /** Last drawn ranges, and the time of the picture then. */
  private drawn = "";
  private pictured = NaN;
  private readonly progress = h("span", { class: "soft", id: "plots-progress" });

  constructor(root: HTMLElement, private readonly player: Player, schema: Schema) {
    this.schema = schema;
    this.span = player.live ? LIVE_SPAN : 0;
    this.search = h("input", {
      type: "search", id: "channel-search", placeholder: SEARCH, "aria-label": "search a channel to plot",
      oninput: () => this.list(), onfocus: () => this.list(), autocomplete: "off",
    });
    this.spans.show(this.span);
    this.search.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.found.querySelector<HTMLElement>(".best")?.click();
    });
    root.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.closeList();
    });
    document.addEventListener("pointerdown", (event) => {
      if (!root.contains(event.target as Node)) this.closeList();
    });
    const chooser: HTMLElement = h("div", { class: "chooser", onfocusout: (event) => this.leave(chooser, event as FocusEvent) }, this.search, this.found);
    root.append(h("div", { class: "plot-tools" }, chooser, this.spans.select, this.progress), this.row);
    this.addFirst();
  }

  private addFirst(): void {
    this.add(this.schema.legs.map(({ trueForce }) => ({ channel: trueForce, index: 2 })), "vertical foot forces");
    this.add([0, 1, 2].map((index) => ({ channel: "state.v_WB", index })), "velocity, believed");
  }

  private add(series: Series[], title?: string): Plot | undefined {
    const known = series.filter(({ channel }) => this.schema.offset(channel) >= 0);
    if (known.length === 0) return undefined;
    const plot = new Plot(known, this.schema, title);
    plot.onSeek = (time) => this.player.seek(time);
    plot.onZoom = (factor, about) => this.zoom(factor, about);
    plot.onRemove = () => this.remove(plot);
    plot.onMore = () => this.addTo(plot);
    plot.onBuilt = () => this.refresh();
    this.plots.push(plot);
    this.row.append(plot.root);
    this.refresh();
    return plot;
  }

  private remove(plot: Plot): void {
    if (plot === this.target) this.closeList();
    this.plots.splice(this.plots.indexOf(plot), 1);
    plot.remove();
  }

  /** Adds the next choices to this plot. */
  private addTo(plot: Plot | undefined): void {
    this.target?.root.classList.remove("target");
    this.target = plot;
    plot?.root.classList.add("target");
    this.search.placeholder = plot === undefined ? SEARCH : "add to the framed plot …";
    if (plot !== undefined) this.search.focus();
  }

  /** Closes the list when the focus leaves search and list. */
  private leave(chooser: HTMLElement, { relatedTarget }: FocusEvent): void {
    if (relatedTarget !== null && !chooser.contains(relatedTarget as Node)) this.closeList();
  }

  private closeList(): void {
    this.found.hidden = true;
    this.addTo(undefined);
  }

  private list(): void {
    const matching = search(this.schema, this.search.value);
    this.found.replaceChildren(...matching.slice(0, LONGEST_LIST).map((match, k) => this.item(match, k === 0)));
    if (matching.length > LONGEST_LIST) this.found.append(h("li", { class: "soft" }, `and ${matching.length - LONGEST_LIST} more`));
    if (matching.length === 0) this.found.append(h("li", { class: "soft" }, "no channel is called so"));
    this.found.hidden = false;
  }

  /** A channel and its choices; `first`: the return key takes its best match. */
  private item({ channel, choices, isPart }: Match, first: boolean): HTMLElement {
    const { name, unit, about } = channel;
    const all = allOf(channel, choices, this.schema);
    const chips = choices.map((choice, k) =>
      h("button", { class: first && isPart && k === 0 ? "chip best" : "chip", onclick: () => this.choose(choice.series) }, choice.name));
    return h("li", {},
      h("button", { class: first && !isPart ? "channel best" : "channel", onclick: () => this.chooseAll(all) },
        h("b", {}, name), ` ${unit === "" ? "" : `[${unit}] `}`, h("span", { class: "soft" }, about)),
      chips.length > 0 && h("div", { class: "chips" }, ...chips));
  }

  /** Adds lines to the target, or to a new plot that becomes the target if there is none or it would have too many lines. */
  private choose(series: Series[]): void {
    const { target } = this;
    const has = (one: Series): boolean => target?.series.some(({ channel, index }) => channel === one.channel && index === one.index) ?? false;
    const more = series.filter((one) => !has(one));
    const count = (target?.series.length ?? 0) + more.length;
    if (target === undefined || count > MOST_LINES) this.addTo(this.add(more));
    else if (more.length > 0) target.setSeries([...target.series, ...more]);
    this.target?.root.scrollIntoView({ block: "nearest", inline: "nearest" });
    this.refresh();
  }

  private chooseAll(series: Series[]): void {
    for (let begin = 0; begin < series.length; begin += MOST_LINES) {
      if (begin > 0) this.addTo(undefined);
      this.choose(series.slice(begin, begin + MOST_LINES));
    }
    this.closeList();
    this.search.value = "";
  }

  private setSpan(span: number): void {
    const { past, time, source } = this.player;
    this.span = span;
    this.from = past && span > 0 ? fromAround(time, source.first, source.last, span) : NaN;
    this.since = Infinity;
  }

  private zoom(factor: number, about: number): void {
    const [from, to] = this.range();
    const { first, last } = this.player.source;
    const span = Math.min(Math.max((to - from) * factor, 0.05), Math.max(last - first, 0.05));
    this.span = span;
    this.from = Math.min(Math.max(about - ((about - from) / (to - from)) * span, first), last - span);
    this.since = Infinity;
    this.spans.show(span);
  }

  private range(): [number, number] {
    const { time, source, following, past } = this.player;
    const { first, last } = source;
    const span = this.span === 0 ? Math.max(last - first, 0.1) : this.span;
    if (following) {
      this.from = NaN;
      const from = this.span === 0 ? first : Math.max(first, time - span);
      return [from, from + span];
    }
    if (past && Number.isNaN(this.from)) return rangeOfPast(time, first, last, span);
    if (Number.isNaN(this.from)) this.from = fromAround(time, first, last, span);
    if (time < this.from || time > this.from + span) this.from = Math.max(first, Math.min(time - 0.1 * span, last - span));
    return [this.from, this.from + span];
  }

  /** New data has arrived. */
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

  /** Colours or sizes have changed. */
  rebuild(): void {
    for (const plot of this.plots) plot.build();
    this.since = Infinity;
  }

  /** Shows the loading progress; "": all is here. */
  showProgress(text: string): void {
    setText(this.progress, text);
  }

  /** `frame`: the picture's. */
  update(dt: number, frame: Frame | undefined): void {
    const { time } = this.player;
    const pictured = frame?.time ?? time;
    const isNew = pictured !== this.pictured; // drawn in the same step as the picture
    this.since += dt;
    this.sincePicture += dt;
    if ((isNew ? this.sincePicture : this.since) < PERIOD || Number.isNaN(time)) return;
    const [from, to] = this.range();
    const drawn = [time, this.player.source.last, from, to].join();
    if (!isNew && drawn === this.drawn && this.since !== Infinity) return;
    if (this.row.offsetParent === null) return;
    this.since = 0;
    if (isNew) this.sincePicture = 0;
    this.drawn = drawn;
    this.pictured = pictured;
    for (const plot of this.plots) {
      plot.draw(this.player.source, from, to, pictured);
      if (frame !== undefined) plot.showNumbers(frame);
    }
  }
}
