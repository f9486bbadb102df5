import uPlot from "uplot";
import { Envelope } from "../data/envelope.ts";
import { scalar, type Frame } from "../data/frame.ts";
import type { FrameSource, Series } from "../data/source.ts";
import type { Schema } from "../data/schema.ts";
import { digits } from "../data/numbers.ts";
import { h, say } from "./dom.ts";

/** Colours of a plot's lines, in turn; as the report's. */
export const LINES = ["--c0", "--c1", "--c2", "--c3", "--c5", "--soft"];

/** Some channels over time, with the time of the picture as a line. */
export class Plot {
  readonly root: HTMLElement;
  onSeek: (time: number) => void = () => {};
  onZoom: (factor: number, about: number) => void = () => {};
  private chart: uPlot | undefined;
  private readonly legend = h("span", { class: "legend" });
  private readonly values: HTMLElement[] = [];
  private time = NaN;

  constructor(
    readonly title: string,
    readonly series: Series[],
    private readonly schema: Schema,
    onRemove: () => void,
  ) {
    this.root = h("figure", { class: "plot" },
      h("figcaption", {}, h("span", { class: "plot-title" }, title), this.legend,
        h("button", { class: "small", "aria-label": `remove the plot ${title}`, title: "remove", onclick: onRemove }, "×")),
      h("div", { class: "chart" }));
    series.forEach((one, k) => {
      const value = h("output", {});
      const swatch = h("i", {});
      swatch.style.background = `var(${LINES[k % LINES.length] as string})`;
      this.values.push(value);
      this.legend.append(h("span", {}, swatch, this.shortLabel(one), " ", value));
    });
  }

  clear(): void {
    this.chart?.setData([[], ...this.series.map(() => [])] as unknown as uPlot.AlignedData);
    for (const value of this.values) say(value, "");
  }

  private get frame(): HTMLElement {
    return this.root.lastElementChild as HTMLElement;
  }

  build(): void {
    this.chart?.destroy();
    const { clientWidth: width, clientHeight: height } = this.frame;
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string): string => style.getPropertyValue(name).trim();
    const axis = { stroke: colour("--soft"), grid: { stroke: colour("--grid"), width: 1 }, ticks: { show: false }, font: "11px system-ui" };
    this.chart = new uPlot({
      width: Math.max(width, 120), height: Math.max(height, 80),
      cursor: { sync: { key: "surefoot" }, drag: { setScale: false, x: false, y: false }, points: { size: 5 } },
      scales: { x: { time: false, range: (_u, low, high) => [low, high] } },
      axes: [{ ...axis, size: 22, gap: 2, values: (_u, marks) => marks.map((t) => `${+t.toFixed(3)} s`) },
             { ...axis, size: 52, gap: 3, values: (_u, marks) => marks.map((y) => `${+y.toPrecision(4)}`) }],
      legend: { show: false },
      series: [{}, ...this.series.map((_, k) => ({ stroke: colour(LINES[k % LINES.length] as string), width: 1.4, points: { show: false } }))],
      hooks: { draw: [(u) => this.drawTime(u, colour("--ink"))], ready: [(u) => this.listen(u)] },
    }, [[], ...this.series.map(() => [])] as unknown as uPlot.AlignedData, this.frame);
  }

  /** What tells a line from the others: its component, or the part of the name in which they differ. */
  private shortLabel(one: Series): string {
    const parts = this.series.map(({ channel }) => channel.split("."));
    const differs = parts[0]?.findIndex((part, i) => parts.some((other) => other[i] !== part)) ?? -1;
    if (differs >= 0) return one.channel.split(".")[differs] ?? one.channel;
    const info = this.schema.channel(one.channel);
    return info?.labels?.[one.index] ?? (info?.size === 1 ? "" : String(one.index));
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
      this.onZoom(1.0015 ** event.deltaY, u.posToVal(event.clientX - box.left, "x"));
    }, { passive: false });
  }

  private drawTime(u: uPlot, colour: string): void {
    const x = u.valToPos(this.time, "x", true);
    if (!(x >= u.bbox.left && x <= u.bbox.left + u.bbox.width)) return;
    u.ctx.save();
    u.ctx.strokeStyle = colour;
    u.ctx.lineWidth = devicePixelRatio;
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
    const envelope = new Envelope(from, to, Math.max(50, Math.floor(chart.width / 2)), this.series.length);
    source.fill(envelope, this.series);
    this.time = time;
    chart.batch(() => {
      chart.setData(envelope.columns() as unknown as uPlot.AlignedData, false);
      chart.setScale("x", { min: from, max: to });
      const [low, high] = envelope.bounds();
      chart.setScale("y", { min: low, max: high });
    });
  }

  /** The numbers of this frame, beside the lines' names. */
  tell(frame: Frame): void {
    this.series.forEach(({ channel, index }, k) => say(this.values[k] as HTMLElement, digits(scalar(frame, channel, index))));
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.frame;
    if (width > 0 && height > 0) this.chart?.setSize({ width, height });
  }
}
