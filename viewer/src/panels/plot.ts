import uPlot from "uplot";
import { legIn, namesOf, partsOf, unitOf, valueText, wordsOf } from "../data/channel_names.ts";
import { Envelope } from "../data/envelope.ts";
import { scalar, type Frame } from "../data/frame.ts";
import type { FrameSource, Series } from "../data/source.ts";
import type { Schema } from "../data/schema.ts";
import { h, setText, svg } from "./dom.ts";
import { stylesOf, type LineStyle } from "./line_styles.ts";

/** With more lines the legend has no numbers. */
const MOST_NUMBERS = 6;

interface Line {
  series: Series;
  style: LineStyle;
  shown: boolean;
  unit: string;
  value: HTMLElement;
}

/** Height of the time axis [pixels]. */
const TIMES_HEIGHT = 22;

/** Some channels over time, with the time of the picture as a line. */
export class Plot {
  readonly root: HTMLElement;
  onSeek: (time: number) => void = () => {};
  onZoom: (factor: number, about: number) => void = () => {};
  onRemove: () => void = () => {};
  /** Called to add lines here. */
  onMore: () => void = () => {};
  /** Called when it must be drawn again. */
  onBuilt: () => void = () => {};
  private chart: uPlot | undefined;
  private readonly name = h("span", { class: "plot-name" });
  private readonly unit = h("span", { class: "plot-unit" });
  private readonly heading = h("span", { class: "plot-title" }, this.name, this.unit);
  private readonly legend = h("div", { class: "legend" });
  private readonly frame = h("div", { class: "chart" });
  private readonly size = new ResizeObserver(() => this.resize());
  private lines: Line[] = [];
  private time = NaN;

  /** `title`: by default what the names have in common. */
  constructor(series: Series[], private readonly schema: Schema, title?: string) {
    this.root = h("figure", { class: "plot" },
      h("figcaption", {}, this.heading,
        h("button", { class: "small more-lines", "aria-label": "add lines to this plot", title: "add lines", onclick: () => this.onMore() }, "+"),
        h("button", { class: "small remove", "aria-label": "remove this plot", title: "remove", onclick: () => this.onRemove() }, "×")),
      this.legend, this.frame);
    this.setSeries(series, title);
    this.size.observe(this.frame);
  }

  get series(): Series[] {
    return this.lines.map(({ series }) => series);
  }

  /** Sets the lines; hidden ones stay hidden. */
  setSeries(series: Series[], title?: string): void {
    const hidden = this.lines.filter(({ shown }) => !shown).map((line) => line.series);
    const names = namesOf(series, this.schema);
    const unit = unitOf(series, this.schema);
    const styles = stylesOf(series.map((one) => legIn(partsOf(one, this.schema).join("."), this.schema)));
    this.name.replaceChildren(...breakable(title ?? names.title));
    setText(this.unit, unit ? ` [${unit}]` : "");
    this.lines = series.map((one, k) => ({
      series: one, style: styles[k] as LineStyle, shown: !hidden.includes(one), value: h("output", { "aria-live": "off" }),
      unit: unit === undefined ? (this.schema.channel(one.channel)?.unit ?? "") : "",
    }));
    this.root.classList.toggle("crowded", series.length > MOST_NUMBERS);
    this.legend.replaceChildren(...this.lines.map((line, k) => this.entry(line, names.labels[k] as string)));
    if (this.chart !== undefined) this.build();
  }

  /** Legend entry of a line: sample, name and number; a press toggles the line. */
  private entry(line: Line, label: string): HTMLElement {
    const toggle = (): void => {
      line.shown = !line.shown;
      entry.setAttribute("aria-pressed", String(line.shown));
      this.build();
    };
    const name = [label, line.unit === "" ? "" : `[${line.unit}]`].filter((text) => text !== "").join(" ");
    const full = partsOf(line.series, this.schema).join(".");
    const entry = h("button", { class: "line", "aria-pressed": String(line.shown), title: `${full}: hide or show`, onclick: toggle }, sample(line.style), name, line.value);
    return entry;
  }

  private get shown(): Line[] {
    return this.lines.filter(({ shown }) => shown);
  }

  remove(): void {
    this.size.disconnect();
    this.chart?.destroy();
    this.root.remove();
  }

  clear(): void {
    this.chart?.setData([[], ...this.shown.map(() => [])] as unknown as uPlot.AlignedData);
    for (const { value } of this.lines) setText(value, "");
  }

  build(): void {
    this.chart?.destroy();
    const { clientWidth: width, clientHeight: height } = this.frame;
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string): string => style.getPropertyValue(name).trim();
    const axis = { stroke: colour("--soft"), grid: { stroke: colour("--grid"), width: 1 }, ticks: { show: false }, font: "11px system-ui" };
    this.chart = new uPlot({
      width: Math.max(width, 120), height: Math.max(height, 60),
      cursor: { sync: { key: "surefoot" }, drag: { setScale: false, x: false, y: false }, points: { size: 5 } },
      scales: { x: { time: false, range: (_u, low, high) => [low, high] } },
      axes: [{ ...axis, size: TIMES_HEIGHT, gap: 2, values: (_u, marks) => marks.map((t) => `${+t.toFixed(3)} s`) },
             { ...axis, gap: 3, ...this.valueAxis() }],
      legend: { show: false },
      series: [{}, ...this.shown.map(({ style: line }) => ({ stroke: colour(line.colour), dash: line.dash, width: 1.4, points: { show: false } }))],
      hooks: { draw: [(u) => this.drawTime(u, colour("--ink"))], ready: [(u) => this.listen(u)] },
    }, [[], ...this.shown.map(() => [])] as unknown as uPlot.AlignedData, this.frame);
    this.onBuilt();
  }

  /** Axis of numbers, or of the words that they stand for. */
  private valueAxis(): Pick<uPlot.Axis, "size" | "splits" | "values"> {
    const words = wordsOf(this.shown.map(({ series }) => series), this.schema);
    if (words === undefined) return { size: 52 };
    const longest = Math.max(...words.map((one) => one.length));
    return {
      size: Math.min(16 + 6 * longest, 120),
      splits: (_u, _axis, low, high) => words.map((_, value) => value).filter((value) => value >= low && value <= high),
      values: (_u, marks) => marks.map((value) => words[value] ?? ""),
    };
  }

  private listen(u: uPlot): void {
    const seek = (event: PointerEvent): void => {
      const box = u.over.getBoundingClientRect();
      this.onSeek(u.posToVal(event.clientX - box.left, "x"));
    };
    u.over.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      u.over.setPointerCapture(event.pointerId);
      seek(event);
      u.over.onpointermove = seek;
    });
    u.over.addEventListener("pointerup", () => (u.over.onpointermove = null));
    u.over.addEventListener("pointercancel", () => (u.over.onpointermove = null));
    u.over.addEventListener("wheel", (event) => {
      event.preventDefault();
      const box = u.over.getBoundingClientRect();
      const factor = 1.0015 ** (event.deltaY || event.deltaX);
      this.onZoom(factor, u.posToVal(event.clientX - box.left, "x"));
    }, { passive: false });
  }

  private drawTime(u: uPlot, colour: string): void {
    const x = u.valToPos(this.time, "x", true);
    if (!(x >= u.bbox.left && x <= u.bbox.left + u.bbox.width)) return;
    u.ctx.save();
    u.ctx.strokeStyle = colour;
    u.ctx.lineWidth = devicePixelRatio;
    u.ctx.setLineDash([]);
    u.ctx.beginPath();
    u.ctx.moveTo(x, u.bbox.top);
    u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
    u.ctx.stroke();
    u.ctx.restore();
  }

  /** Draws [from, to] of the source; `time`: that of the picture. */
  draw(source: FrameSource, from: number, to: number, time: number): void {
    if (this.chart === undefined) this.build();
    const chart = this.chart as uPlot;
    const series = this.shown.map((line) => line.series);
    const envelope = new Envelope(from, to, Math.max(50, Math.floor(chart.width / 2)), series.length);
    source.fill(envelope, series);
    this.time = time;
    chart.batch(() => {
      chart.setData(envelope.columns() as unknown as uPlot.AlignedData, false);
      chart.setScale("x", { min: from, max: to });
      const [low, high] = envelope.bounds();
      chart.setScale("y", { min: low, max: high });
    });
  }

  /** Shows a frame's numbers in the legend. */
  showNumbers(frame: Frame): void {
    for (const { series, value } of this.lines) setText(value, valueText(series, scalar(frame, series.channel, series.index), this.schema));
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.frame;
    if (width > 0 && height > 0) this.chart?.setSize({ width, height });
  }
}

/** Longer parts of a name may also be broken. */
const LONG_PART = 20;

/** A name with line breaks allowed after each part. */
function breakable(name: string): Node[] {
  const parts = name.split(/(?<=\.)/).flatMap((part) => (part.length > LONG_PART ? part.split(/(?<=_)/) : [part]));
  return parts.flatMap((part, k) => [...(k > 0 ? [h("wbr", {})] : []), document.createTextNode(part)]);
}

/** A piece of a line, for the legend. */
function sample({ colour, dash }: LineStyle): SVGElement {
  const line = svg("path", { d: "M0 4H18", "stroke-width": "2.4", "stroke-dasharray": dash.join(" ") || "none" });
  line.style.stroke = `var(${colour})`;
  const picture = svg("svg", { class: "sample", viewBox: "0 0 18 8", "aria-hidden": "true" });
  picture.append(line);
  return picture;
}
