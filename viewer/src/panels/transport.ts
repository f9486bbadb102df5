import type { Frame } from "../data/frame.ts";
import type { Player } from "../data/player.ts";
import { speedText } from "../data/speed.ts";
import { columnsOf, hintOf, type Weight } from "../data/mark_columns.ts";
import { secondsText } from "../data/numbers.ts";
import { Wish } from "../data/wish.ts";
import { VIEW_ONLY } from "../protocol/commands.ts";
import type { Status } from "../protocol/connection.ts";
import { h, setText } from "./dom.ts";
import { NumberMenu } from "./number_menu.ts";

/** Marks within this width are drawn as one [pixels]. */
const COLUMN = 4;
/** Style of a mark: colour (no leg's), width [pixels], and height as a share of the bar's. */
interface MarkStyle {
  paint: string;
  wide: number;
  tall: number;
}
/** Weightier marks are larger, so that colour is not the only difference. */
const STYLES: Record<Weight, MarkStyle> = {
  usual: { paint: "--soft", wide: 1.5, tall: 0.35 }, // higher where there are several
  change: { paint: "--ink", wide: 2, tall: 0.7 },
  notable: { paint: "--near", wide: 2.5, tall: 0.85 },
  grave: { paint: "--bad", wide: COLUMN, tall: 1 },
};

/** Height of so many usual events that are drawn as one. */
const tallOf = (usual: number): number => Math.min(STYLES.usual.tall + 0.06 * Math.log2(usual), 0.6);

const RESET = "begin again (r)", SPEED = "speed ([ and ])", PAST_SPEED = "speed of what is played again ([ and ])";

export interface TransportActions {
  pause: () => void;
  step: (ticks: number) => void;
  speed: (factor: number) => void;
  reset: () => void;
}

/** The next speed of the menu above or below `now`. */
export function nextSpeed(speeds: number[], now: number, steps: number): number | undefined {
  const further = steps > 0 ? speeds.filter((speed) => speed > now) : speeds.filter((speed) => speed < now).reverse();
  return further[Math.min(Math.abs(steps), further.length) - 1];
}

/** The shown time; of a log also its length. */
export function clockText(time: number, whole: number | undefined): string {
  return whole === undefined ? secondsText(time) : `${secondsText(time).replace(" s", "")} / ${secondsText(whole)}`;
}

/** State of a run; `unheard`: the program does not answer, and the run had not ended. */
export type RunState = "runs" | "paused" | "ended" | "unheard";

export function runStateOf(status: Pick<Status, "paused" | "ended"> | undefined, heard: boolean): RunState {
  if (status !== undefined && status.ended !== null) return "ended"; // final, even without an answer
  if (!heard || status === undefined) return "unheard";
  return status.paused ? "paused" : "runs";
}

const STATE_TEXTS: Record<RunState, string> = { runs: "the run is at", paused: "the run is paused at", ended: "the run ended at", unheard: "the newest is" };

/** Why a live run has ended, where that is known. */
export const endedText = (why: string, runState: RunState): string => why || (runState === "unheard" ? "not known" : "not yet");

/** Shown with a past time: where the run is. */
export function pastText(newest: number, runState: RunState): string {
  return `past; ${STATE_TEXTS[runState]} ${newest.toFixed(1)} s`;
}

/** Text and title of the button to the newest picture. */
export function newestText(past: boolean, runState: RunState): [text: string, title: string] {
  if (runState === "ended") return past ? ["To the end", "to the last picture of the run (l)"] : ["The end", "the last picture of the run (l)"];
  if (runState === "unheard") return past ? ["To newest", "to the newest picture that has come (l)"] : ["Newest", "the newest picture that has come (l)"];
  return [past ? "To now" : "Live", "to the newest picture (l)"];
}

/** Title of the play button; `mayCommand`: this page may change the run. */
export function playText(player: Pick<Player, "live" | "past">, running: boolean, mayCommand = true, runState: RunState = "runs"): string {
  const now = player.live && !player.past;
  if (now && runState === "ended") return mayCommand ? "the run has ended; ↺ begins it again" : "the run has ended";
  if (now && runState === "unheard") return "the program says nothing: the run can't be paused";
  if (player.past || (player.live && !mayCommand)) return running ? "stop here; the run is left alone (space)" : "play on from here; the run is left alone (space)";
  if (player.live) return running ? "pause the run (space)" : "let the run go on (space)";
  return running ? "pause (space)" : "play (space)";
}

/** Pause, step, speed, and the bar of the run's time with marks of what happened. */
export class Transport {
  private readonly playButton: HTMLButtonElement;
  /** The run may have a speed outside the menu. */
  private readonly speedMenu: NumberMenu;
  private readonly liveButton: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly canvas = h("canvas", { class: "marks", "aria-hidden": "true" });
  private readonly clock = h("output", { class: "clock", id: "clock", "aria-live": "off" });
  private readonly past = h("span", { class: "past", id: "past" });
  private readonly hint = h("span", { class: "mark-hint", hidden: true });
  private marksSeen = "";
  readonly wish = new Wish<number>();
  private readonly resetButton: HTMLButtonElement;
  /** Whether this page may change the run. */
  mayCommand = true;

  constructor(
    root: HTMLElement,
    private readonly player: Player,
    private readonly speeds: number[],
    private readonly actions: TransportActions,
  ) {
    const button = (text: string, label: string, run: () => void, id: string): HTMLButtonElement =>
      h("button", { "aria-label": label, title: label, onclick: run, id }, text);
    this.resetButton = button("↺", RESET, actions.reset, "reset");
    this.playButton = button("❚❚", playText(player, true), actions.pause, "play");
    this.speedMenu = new NumberMenu({ id: "speed", "aria-label": "speed", title: SPEED }, speeds, speedText, (speed) => this.ask(speed));
    this.speedMenu.show(1);
    this.liveButton = button("Live", "to the newest picture (l)", () => player.goLive(), "go-live");
    this.slider = h("input", {
      type: "range", id: "scrub", min: 0, max: 1, step: "any", "aria-label": "time of the run in seconds",
      oninput: () => player.seek(Number(this.slider.value)),
    });
    const bar = h("div", { class: "bar" }, this.canvas, this.slider, this.hint);
    bar.addEventListener("pointermove", (event) => this.showHint(event));
    bar.addEventListener("pointerleave", () => (this.hint.hidden = true));
    root.append(
      h("div", { class: "buttons" },
        this.resetButton,
        button("◂", "one tick back (,)", () => actions.step(-1), "step-back"),
        this.playButton,
        button("▸", "one tick on (.)", () => actions.step(1), "step"),
        this.speedMenu.select),
      bar, h("div", { class: "times" }, this.clock, player.live && this.past),
    );
    if (player.live) root.append(this.liveButton);
  }

  /** The next speed up or down. */
  faster(steps: number): void {
    if (this.speedMenu.select.disabled) return;
    const next = nextSpeed(this.speeds, this.speedMenu.value, steps);
    if (next !== undefined) this.ask(next);
  }

  private ask(speed: number): void {
    if (this.player.live && this.player.following) this.wish.ask(speed);
    this.speedMenu.show(speed);
    this.actions.speed(speed);
  }

  /** Shows the time of the picture. */
  showTime({ time }: Frame): void {
    const { live, source } = this.player;
    setText(this.clock, clockText(time, live ? undefined : source.last));
  }

  /** Shows no time until there is a picture again. */
  clear(): void {
    setText(this.clock, "");
  }

  /** The colours have changed. */
  recolour(): void {
    this.marksSeen = "";
  }

  /** `heard`: the program answers. */
  update(status: Status | undefined, heard: boolean): void {
    const { player } = this;
    const size = [this.canvas.clientWidth, this.canvas.clientHeight, devicePixelRatio].join(); // read first, to avoid a second layout
    const { first, last, marks } = player.source;
    const runState = runStateOf(status, heard);
    const running = player.following ? runState === "runs" || (runState === "unheard" && !(status?.paused ?? false)) : player.playing;
    setText(this.playButton, running ? "❚❚" : "▶");
    name(this.playButton, playText(player, running, this.mayCommand, runState));
    this.playButton.disabled = player.following && (runState === "ended" || runState === "unheard");
    const speed = player.live && player.following ? this.wish.or(status?.speed ?? 1) : player.speed;
    if (document.activeElement !== this.speedMenu.select) this.speedMenu.show(speed);
    this.liveButton.classList.toggle("on", player.following);
    this.liveButton.classList.toggle("primary", player.past);
    const [newest, title] = newestText(player.past, runState);
    setText(this.liveButton, newest);
    name(this.liveButton, title);
    this.forbid(this.resetButton, player.live && !this.mayCommand, RESET);
    this.forbid(this.speedMenu.select, player.following && !this.mayCommand, player.past ? PAST_SPEED : SPEED);
    setText(this.past, player.past && !Number.isNaN(last) ? pastText(last, runState) : "");
    if (Number.isNaN(first)) return;
    this.slider.min = String(first);
    this.slider.max = String(last);
    this.slider.value = String(player.time);
    this.slider.setAttribute("aria-valuetext", secondsText(player.time));
    const key = `${first.toFixed(1)} ${last.toFixed(1)} ${marks.length} ${size}`;
    if (key === this.marksSeen) return;
    this.marksSeen = key;
    this.drawMarks();
  }

  private forbid(control: HTMLButtonElement | HTMLSelectElement, forbidden: boolean, title: string): void {
    control.disabled = forbidden;
    const words = forbidden ? `${title}: ${VIEW_ONLY}` : title;
    if (control.title !== words) control.title = words;
  }

  private drawMarks(): void {
    const { first, last, marks } = this.player.source;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.canvas.width = width * devicePixelRatio;
    this.canvas.height = height * devicePixelRatio;
    const context = this.canvas.getContext("2d");
    if (context === null) return;
    context.scale(devicePixelRatio, devicePixelRatio);
    const style = getComputedStyle(this.canvas);
    const fill = ({ paint, wide, tall }: MarkStyle, x: number): void => {
      context.fillStyle = style.getPropertyValue(paint);
      context.fillRect(x, height * (1 - tall), wide, height * tall);
    };
    const count = Math.max(1, Math.floor(width / COLUMN));
    for (const { at, usual, other } of columnsOf(marks, first, last, count)) {
      const x = (at * width) / count;
      if (usual > 0) fill({ ...STYLES.usual, tall: tallOf(usual) }, x + 0.5);
      if (other !== undefined) fill(STYLES[other.weight], x);
    }
  }

  private showHint(event: PointerEvent): void {
    const { first, last, marks } = this.player.source;
    const box = this.canvas.getBoundingClientRect();
    const time = first + ((event.clientX - box.left) / box.width) * (last - first);
    const text = hintOf(marks, time, (5 / box.width) * (last - first));
    this.hint.hidden = text === "";
    if (text === "") return;
    setText(this.hint, text);
    const half = 0.5 * this.hint.offsetWidth + 4;
    const x = Math.min(Math.max(event.clientX, half), innerWidth - half);
    this.hint.style.left = `${x - (box.left - this.canvas.offsetLeft)}px`;
  }
}

/** Sets title and label. */
function name(button: HTMLButtonElement, words: string): void {
  if (button.title === words) return;
  button.title = words;
  button.setAttribute("aria-label", words);
}
