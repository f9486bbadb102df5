import { LiveSource } from "./data/live_source.ts";
import { Player } from "./data/player.ts";
import { Schema } from "./data/schema.ts";
import { scalar, type Frame } from "./data/frame.ts";
import { accountAt, levelStates } from "./data/hierarchy.ts";
import { asSentence, unreadableText } from "./data/log_words.ts";
import { GamepadReader, type Button } from "./input/gamepad.ts";
import { listenToKeys, type KeyActions } from "./input/keys.ts";
import { LiveLink } from "./live_link.ts";
import { aboutRun } from "./panels/about_run.ts";
import { Announcer } from "./panels/announcer.ts";
import { DrivePanel } from "./panels/drive_panel.ts";
import { h, part, setText } from "./panels/dom.ts";
import { endFact, showFacts, showMode } from "./panels/head.ts";
import { makeHelp } from "./panels/help.ts";
import { HierarchyPanel } from "./panels/hierarchy_panel.ts";
import { Notes } from "./panels/notes.ts";
import { KEYS as OVERLAY_KEYS, OverlayMenu } from "./panels/overlay_menu.ts";
import { PlotsPanel } from "./panels/plots_panel.ts";
import { showTime } from "./panels/stale.ts";
import { StatePanel } from "./panels/state_panel.ts";
import { Tabs } from "./panels/tabs.ts";
import { runStateOf, endedText, Transport } from "./panels/transport.ts";
import { TunePanel } from "./panels/tune_panel.ts";
import { Commands, type Ask } from "./protocol/commands.ts";
import { orderOf, type Session } from "./protocol/session.ts";
import { ReplayLink } from "./replay_link.ts";
import { NO_CONTEXT, watchContext } from "./scene/context.ts";
import { missingText } from "./scene/mesh_library.ts";
import { NoGraphics, withoutPictureText } from "./scene/stage.ts";
import { World } from "./scene/world.ts";
import type { Theme } from "./theme.ts";
import { Wish } from "./data/wish.ts";

/** Ground without a robot is drawn only after this: the rest behind it would delay the picture with both [ms]. */
const WITHOUT_ROBOT = 2000;
/** Message of a key that drives a run, in the page of a log. */
const OF_A_LOG = "This is a log: only a run can be pushed, steered or changed (`surefoot run SCENARIO --view`).";
/** Longest time that a waiting run waits for meshes [ms]. */
const LONGEST_DRESSING = 10000;
/** Commands that take effect with the next tick. */
const CHANGES = new Set(["push", "walk", "gain", "order", "friction"]);
/** Pictures whose script time is kept. */
const MOST_COSTS = 2000;
/** Texts and the time bar change this often [s]. */
const TEXT_PERIOD = 0.1;

/** The whole page: data at one end, picture and panels at the other. */
export class App {
  readonly player: Player;
  readonly world: World | undefined;
  readonly notes: Notes;
  readonly link: LiveLink | undefined;
  /** Frame of the picture; all numbers in the panels are of it. */
  frame: Frame | undefined;
  pictures = 0;
  /** Time from the page's beginning to the first picture with a robot [ms]. */
  firstPicture = NaN;
  /** Script time of each of the last pictures, until all of it is handed to the graphics [ms]. */
  readonly costs: number[] = [];
  readonly commands: Commands;
  private readonly hierarchy: HierarchyPanel;
  readonly tune: TunePanel;
  readonly drive: DrivePanel;
  private readonly state: StatePanel;
  private readonly plots: PlotsPanel;
  private readonly transport: Transport;
  private readonly menu: OverlayMenu | undefined;
  private readonly made = performance.now();
  private last = performance.now();
  private drawn = performance.now();
  private sinceText = Infinity;
  private sinceNumbers = Infinity;
  /** Frame of the numbers in the panels. */
  private shown: Frame | undefined;
  /** Line of the account, for screen readers. */
  private levels = "";
  private readonly announcer = new Announcer((text) => setText(part("events"), text));
  /** Whether commands take effect. */
  private canAct = false;
  private readonly progress: () => string;
  private readonly gamepad: GamepadReader | undefined;
  private readonly pauseWish = new Wish<boolean>();
  private hasReportedDrawn = false;

  constructor(
    public session: Session,
    urdf: string,
    token: string,
    notes: Notes,
    private readonly theme: Theme,
  ) {
    this.notes = notes;
    const schema = new Schema(session);
    const live = session.mode === "live";
    const link = live ? new LiveLink(new LiveSource(schema), session) : new ReplayLink(schema, session);
    this.player = new Player(link.source, live);
    if (link instanceof LiveLink) this.link = link;
    this.progress = () => (link instanceof ReplayLink ? link.progress : "");
    this.commands = new Commands(this.link?.connection, token);
    this.world = this.makeWorld(urdf);

    const tabs = new Tabs();
    const report = (text: string, kind?: "error" | "plain"): void => notes.say(text, kind);
    const ask: Ask = (type, fields, wish) => this.command(type, fields, wish);
    this.hierarchy = new HierarchyPanel(tabs.add("hierarchy", "Hierarchy"), session.cut !== "" && session.ended === "");
    this.state = new StatePanel(tabs.add("state", "State"), this.aboutRun(), session.header.notes);
    this.drive = new DrivePanel(live ? tabs.add("drive", "Drive") : h("div"), ask, session.limits, report, session.gaits);
    this.tune = new TunePanel(live ? tabs.add("tune", "Tune") : h("div"), ask, report);
    this.tune.show(session);
    this.plots = new PlotsPanel(part("plots"), this.player, schema);
    this.transport = new Transport(part("transport"), this.player, session.limits.speeds, {
      pause: () => this.pause(),
      step: (ticks) => this.step(ticks),
      speed: (factor) => this.speed(factor),
      reset: () => this.reset(),
    });
    this.letCommand(live);
    this.hierarchy.onOrder = (levels) => this.command("order", { levels }, this.hierarchy.wish);
    this.hierarchy.newest = orderOf(session);
    if (this.world !== undefined) this.menu = new OverlayMenu(this.world, schema.legs.map(({ name }) => name));
    this.drive.onAct = () => this.showNow();
    if (live) this.gamepad = new GamepadReader((sticks) => this.drive.drive(sticks), (button) => this.onButton(button));
    this.wire();
    link.wire(this);
    this.wireKeys();
    requestAnimationFrame((now) => this.tick(now));
  }

  private makeWorld(urdf: string): World | undefined {
    try {
      const world = new World(part("canvas"), part("labels"), [part("view-tools"), part("notes")], this.session, urdf);
      watchContext(part("canvas"), () => this.notes.keep("context", NO_CONTEXT, "error"), () => {
        this.notes.take("context");
        world.invalidate();
      });
      world.library.onMissing = () => this.notes.keep("meshes", missingText(world.library.missing));
      return world;
    } catch (error) {
      console.warn(error);
      this.goWithoutPicture(error as Error);
      return undefined;
    }
  }

  private goWithoutPicture(error: Error): void {
    part("view").classList.add("no-picture");
    if (!(error instanceof NoGraphics)) setText(part("no-picture"), withoutPictureText(error));
  }

  /** The log of a live run; "": it is not recorded. */
  private get recording(): string {
    return this.link?.status?.recording ?? "";
  }

  private get hasEnded(): boolean {
    return this.link?.status?.ended != null;
  }

  /** Why the run has ended; "": it has not, or that is not known. */
  private get ending(): string {
    return this.link === undefined ? this.session.ended : (this.link.status?.ended ?? "");
  }

  private aboutRun(): [string, string][] {
    const { link, recording, hasEnded } = this;
    const isSteered = link === undefined ? this.player.source.marks.some(({ kind }) => kind === "change") : (link.status?.changes ?? 0) > 0;
    const ended = link === undefined ? this.ending : endedText(this.ending, runStateOf(link.status, link.isHeard));
    return aboutRun(this.session, { recording, hasEnded, ended, isSteered, missing: missingText(this.world?.library.missing) });
  }

  private wire(): void {
    const { world, theme } = this;
    const recolour = (dark: boolean): void => {
      world?.recolour(dark);
      this.menu?.legend();
      this.plots.rebuild();
      this.transport.recolour();
    };
    theme.onChange = recolour;
    recolour(theme.dark);
    part("theme").addEventListener("click", () => theme.toggle());
    part("follow").addEventListener("click", () => this.follow());
    part("home").addEventListener("click", () => world?.camera.home());
    const { title, mode, source } = this.session;
    setText(part("title"), title);
    setText(part("mode"), mode);
    document.title = [title, mode === "live" ? "live" : source, "Surefoot"].join(" – ");
    if (this.session.cut !== "") this.notes.keep("cut", asSentence(this.session.cut));
  }

  /** Keys that drive a live run. In a log the letters show a message, the others are left to the browser. */
  private drivingKeys(): KeyActions {
    const { player, drive } = this;
    if (!player.live) return Object.fromEntries([..."wsadqexgp"].map((key) => [key, () => this.notes.say(OF_A_LOG)]));
    return {
      l: () => player.goLive(),
      w: () => drive.nudge("forward", 1), s: () => drive.nudge("forward", -1), a: () => drive.nudge("left", 1),
      d: () => drive.nudge("left", -1), q: () => drive.nudge("turn", 1), e: () => drive.nudge("turn", -1),
      PageUp: () => drive.nudge("height", 1), PageDown: () => drive.nudge("height", -1),
      x: () => drive.stand(), g: () => drive.giveBack(), p: () => drive.push(),
      ...Object.fromEntries(this.session.gaits.map((_, i) => [String(i + 1), () => drive.chooseGait(i)])),
    };
  }

  private onButton(button: Button): void {
    if (button === "push") this.drive.push();
    else if (button === "stand") this.drive.stand();
    else this.drive.stepGait(button === "next" ? 1 : -1);
  }

  private wireKeys(): void {
    const { player } = this;
    const shift = (seconds: number) => (event: KeyboardEvent) => player.seek(player.time + seconds * (event.shiftKey ? 10 : 1));
    const toggle = (event: KeyboardEvent): void => void this.menu?.toggleByKey(event.key);
    const shifted = (key: string) => (): void => void this.menu?.toggleByKey(key);
    const help = makeHelp(player.live, this.session.gaits);
    listenToKeys({
      " ": () => this.pause(), ",": () => this.step(-1), ".": () => this.step(1),
      ArrowLeft: shift(-0.1), ArrowRight: shift(0.1),
      "[": () => this.transport.faster(-1), "]": () => this.transport.faster(1),
      r: () => this.reset(), f: () => this.follow(), h: () => this.world?.camera.home(),
      o: () => this.menu?.toggleGhost(), t: () => this.theme.toggle(), "?": help,
      ...Object.fromEntries([...OVERLAY_KEYS].map((key) => [key, toggle])),
      ...Object.fromEntries([..."1234567890"].map((key) => [`shift+${key}`, shifted(key)])),
      ...this.drivingKeys(),
    });
  }

  private follow(): void {
    if (this.world === undefined) return;
    this.world.camera.follow = !this.world.camera.follow;
    part("follow").setAttribute("aria-pressed", String(this.world.camera.follow));
  }

  /** Sends a command; a refusal is shown, and drops the wish. */
  private command(type: string, fields: object = {}, wish?: { drop: () => void }): void {
    const taken = (): void => {
      if (this.paused && CHANGES.has(type)) this.notes.say("The run is paused: that comes with its next tick.", "plain", "waits");
    };
    this.commands.send(type, fields).then(taken, (error: Error) => {
      wish?.drop();
      this.notes.say(error.message, "error");
    });
  }

  private get paused(): boolean {
    return this.pauseWish.or(this.link?.status?.paused ?? false);
  }

  private askPause(paused: boolean): void {
    this.pauseWish.ask(paused);
    this.command(paused ? "pause" : "resume", {}, this.pauseWish);
  }

  /** Pauses the run at its newest picture, otherwise only what is shown. */
  private pause(): void {
    const { player, link } = this;
    if (!player.following || link === undefined) player.toggle();
    else if (this.hasEnded) this.notes.say("The run has ended: there is nothing to pause.", "plain", "now");
    else if (!link.isHeard) this.notes.say("The program says nothing: the run can't be paused.", "plain", "now");
    else if (this.commands.allowed) this.askPause(!this.paused);
    else player.seek(player.time);
  }

  /** Shows the present, where a command acts. */
  private showNow(): void {
    if (!this.player.past || !this.canAct) return;
    this.player.goLive();
    this.notes.say("Back to now, where that acts.", "plain", "now");
  }

  private step(ticks: number): void {
    const { player, link } = this;
    const newest = player.live && player.time >= player.source.last - 1e-9;
    if (ticks > 0 && (player.following || newest) && link !== undefined && this.commands.allowed) {
      player.goLive();
      if (this.hasEnded) return;
      if (this.paused) this.command("step", { ticks });
      else this.askPause(true);
    } else player.step(ticks);
  }

  private speed(factor: number): void {
    this.player.speed = factor;
    if (this.player.live && this.player.following && this.commands.allowed) this.command("speed", { factor }, this.transport.wish);
  }

  private reset(): void {
    if (this.link !== undefined) this.command("reset");
    else this.player.seek(this.player.source.first);
  }

  /** Enables or disables what changes the run; `now`: the program answers, and its run has not ended. */
  letCommand(now: boolean): void {
    const { allowed } = this.commands;
    this.canAct = allowed && now;
    this.transport.mayCommand = allowed;
    this.drive.allow(allowed, now);
    this.tune.allow(this.canAct);
    this.hierarchy.canReorder = this.canAct;
  }

  /** More of a log has arrived. */
  refresh(): void {
    this.plots.refresh();
    this.shown = undefined;
  }

  /** Takes a new session: tasks, order or friction changed, or the run began again. */
  use(session: Session, schema: Schema): void {
    this.session = session;
    this.plots.use(schema);
    this.shown = undefined;
    this.tune.show(session);
    this.hierarchy.newest = orderOf(session);
  }

  /** The run begins again: nothing of it is known yet. */
  restart(): void {
    this.player.restart();
    this.frame = undefined;
    this.world?.clear();
    this.hierarchy.clear();
    this.state.clear();
    this.plots.clear();
    this.drive.restart();
    this.tune.restart();
    this.transport.clear();
    showTime(NaN);
    this.levels = "";
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next));
    const begin = performance.now();
    const dt = Math.min((now - this.last) / 1000, 1);
    this.last = now;
    const { player } = this;
    this.gamepad?.read(now);
    player.advance(dt, this.link?.rate ?? 0);
    player.source.expect(player.time, player.playing ? player.speed : 0);
    const frame = player.source.at(player.time);
    const drawn = this.draw(begin, frame);
    if (drawn && frame !== undefined) {
      this.frame = frame;
      if (this.pictures++ === 0) this.firstPicture = performance.now();
    }
    this.hierarchy.paused = this.link?.status?.paused ?? false;
    this.plots.update(dt, this.frame);
    this.texts(dt);
    this.numbers(dt);
    if (!drawn) return;
    this.costs.push(performance.now() - begin);
    if (this.costs.length > MOST_COSTS) this.costs.shift();
  }

  /** Draws if something has changed and the machine is fast enough; true without WebGL. */
  private draw(now: number, frame: Frame | undefined): boolean {
    const { world, player } = this;
    if (world === undefined) return true;
    if (frame === undefined && now - this.made < WITHOUT_ROBOT) return false;
    const { quality } = world.stage;
    if (!quality.pace.begin(now)) return false;
    const dt = Math.min((now - this.drawn) / 1000, 1);
    if (!world.draw(frame, player.source, dt)) return false;
    this.drawn = now;
    quality.pace.drew(now);
    if (this.pictures > 5 && world.library.loading === 0) quality.measure();
    return true;
  }

  private texts(dt: number): void {
    this.sinceText += dt;
    if (this.sinceText < TEXT_PERIOD) return;
    this.sinceText = 0;
    const heard = this.link?.isHeard ?? false;
    this.transport.update(this.link?.status, heard);
    this.plots.showProgress(this.progress());
    this.showUnreadable();
    this.reportDrawn();
    this.state.showRun(this.aboutRun());
    setText(part("loading"), this.world?.library.progress ?? "");
    this.showHead(heard);
    this.announcer.update(this.levels, performance.now());
  }

  /** Shows facts in the head, most important first: there is not always room for all. */
  private showHead(heard: boolean): void {
    const quality = this.world?.stage.quality;
    const rate = heard || !this.player.live ? quality?.rate : "";
    const end = endFact(this.ending, this.session.cut);
    showFacts([this.session.source, end, ...(this.link?.facts ?? []), rate ?? "", quality?.coarse ?? ""], end);
    if (this.link !== undefined) showMode(this.player, runStateOf(this.link.status, heard), this.link.status?.calibrating);
  }

  /** Tells a waiting run, once, that the robot is drawn with its meshes, or that these take long. */
  private reportDrawn(): void {
    const isDressed = (this.world?.library.loading ?? 0) === 0 || performance.now() - this.firstPicture > LONGEST_DRESSING;
    if (this.hasReportedDrawn || this.pictures === 0 || !isDressed) return;
    this.hasReportedDrawn = true;
    this.link?.reportDrawn();
  }

  private showUnreadable(): void {
    const { player, frame } = this;
    if (frame !== undefined && (player.source.isUnreadable?.(player.time) ?? false)) this.notes.keep("unreadable", unreadableText(frame.time));
    else this.notes.take("unreadable");
  }

  /** Shows the picture's frame in numbers, in the same step as the picture. */
  private numbers(dt: number): void {
    const { frame } = this;
    this.sinceNumbers += dt;
    if (frame === undefined || frame === this.shown || this.sinceNumbers < TEXT_PERIOD) return;
    this.sinceNumbers = 0;
    this.shown = frame;
    this.transport.showTime(frame);
    showTime(frame.time);
    const { source } = this.player;
    const states = levelStates(frame, source.explained?.(frame.tick));
    const account = accountAt(frame, states, source.isComputing?.(frame.tick));
    this.hierarchy.show(frame, states, account);
    this.levels = account.line;
    this.state.show(frame, account);
    this.tune.showBelief(frame.schema.legs.map(({ name, friction }) => ({ name, friction: scalar(frame, friction) })));
  }
}
