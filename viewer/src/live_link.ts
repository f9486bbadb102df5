import type { App } from "./app.ts";
import { paceText } from "./data/speed.ts";
import type { LiveSource, OpenBefore } from "./data/live_source.ts";
import { endOf, marksOf, type RawEvent } from "./data/marks.ts";
import { ReplaySource } from "./data/replay_source.ts";
import { Schema } from "./data/schema.ts";
import { part, setText } from "./panels/dom.ts";
import { ask, askJson, NoAnswer } from "./protocol/ask.ts";
import { runStateOf, type RunState } from "./panels/transport.ts";
import { linkText, NO_ANSWER, showLink } from "./panels/stale.ts";
import { readBlock, readBlockHead } from "./protocol/block.ts";
import { Connection, rateOf, type ConnectionState, type ServerMessage, type Status } from "./protocol/connection.ts";
import { fetchSession, type Session } from "./protocol/session.ts";

/** Most blocks that wait while the session is read again. */
const MOST_WAITING = 200;

/** Pause before a session is requested again [ms]. */
const AGAIN = 1000;

/** How often the connection is checked [ms]. */
const SILENCE_PERIOD = 500;

/** Keeps the live source up to date, across lost connections and changes of the stack. */
export class LiveLink {
  readonly connection: Connection;
  status: Status | undefined;
  /** Ticks that the server could not send to this page. */
  private dropped = 0;
  /** Ticks that were dropped here while the session was read again. */
  private skipped = 0;
  private generation: number;
  private waiting: ArrayBuffer[] = [];
  private reading = false;
  /** The connection was lost, and the session is not read yet: the program may have another run, or be another one. */
  private isBehind = false;
  private lostBefore = false;
  /** Generation of the run whose end has a mark. */
  private ended = NaN;
  private app: App | undefined;

  constructor(
    readonly source: LiveSource,
    private session: Session,
  ) {
    this.generation = session.generation;
    source.begin(session.begun, session.first_tick, this.openBefore);
    this.connection = new Connection(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/live`);
    this.connection.open(); // messages arrive once the page is made
  }

  /** Frames from before this page opened: the program keeps two minutes of them. */
  private readonly openBefore: OpenBefore = (first, ticks) => {
    const { schema } = this.source;
    const before = new ReplaySource(schema, schema.period, first, ticks, (url) => ask(url));
    before.cache.onTile = () => {
      this.app?.notes.take("before");
      this.app?.refresh();
    };
    before.cache.onError = (error) => {
      if (!(error instanceof NoAnswer)) this.app?.notes.keep("before", `What was before can't be read: ${error.message}`, "error");
    };
    return before;
  };

  /** Seconds of simulation that come in a second. */
  get rate(): number {
    return this.isHeard && this.status !== undefined ? rateOf(this.status) : 0;
  }

  /** Whether the program answers. */
  get isHeard(): boolean {
    return this.connection.state === "open" && this.connection.silence === 0;
  }

  wire(app: App): void {
    this.app = app;
    app.commands.onRefused = () => this.showUse();
    this.connection.onBlock = (block) => this.take(block);
    this.connection.onMessage = (message) => this.receive(message);
    this.connection.onState = (state) => this.changeState(state);
    this.connection.onUnreadable = (error) => app.notes.say(error.message, "error");
    this.source.onRestart = () => app.restart();
    setInterval(() => this.showState(), SILENCE_PERIOD);
  }

  private take(block: ArrayBuffer): void {
    this.showFaults(() => {
      const { dropped, generation } = readBlockHead(block);
      this.dropped = dropped;
      if (this.isBehind || this.reading || generation > this.generation) this.wait(block);
      else if (!this.source.isOld(generation)) this.read(block);
    });
  }

  /** Shows a message where bytes are no block. */
  private showFaults(read: () => void): void {
    try {
      read();
    } catch (error) {
      this.app?.notes.keep("block", (error as Error).message, "error");
    }
  }

  /** Keeps a block until its session is read. */
  private wait(block: ArrayBuffer): void {
    this.waiting.push(block);
    if (this.waiting.length > MOST_WAITING) this.skipped += readBlockHead(this.waiting.shift() as ArrayBuffer).frames;
    if (!this.reading) void this.readSession();
  }

  private read(block: ArrayBuffer): void {
    readBlock(block, this.source.schema.frameFloats, (tick, time, values, rows) => this.source.append(tick, time, values, rows));
    this.app?.notes.take("block");
  }

  private async readSession(): Promise<void> {
    this.reading = true;
    try {
      this.use(await fetchSession());
      if (this.isBehind) this.catchUp();
      this.reading = false;
      this.readWaiting();
    } catch (error) {
      this.app?.notes.say((error as Error).message, "error");
      setTimeout(() => this.readAgain(), AGAIN);
    }
  }

  /** A lost connection reads the session when it is open again. */
  private readAgain(): void {
    this.reading = false;
    if (this.connection.state === "open" && (this.isBehind || this.waiting.length > 0)) void this.readSession();
  }

  /** Continues after a lost connection: what happened meanwhile is requested. */
  private catchUp(): void {
    this.isBehind = false;
    this.source.begin(this.session.begun, this.session.first_tick, this.openBefore);
    void this.recall().then(() => this.app?.notes.say("Connected again."));
  }

  /** Reads the blocks of this session; newer ones wait for the next. Frames of all generations have the same channels. */
  private readWaiting(): void {
    const isKnown = (block: ArrayBuffer): boolean => readBlockHead(block).generation <= this.generation;
    const known = this.waiting.filter(isKnown);
    this.waiting = this.waiting.filter((block) => !isKnown(block));
    for (const block of known) if (!this.source.isOld(readBlockHead(block).generation)) this.showFaults(() => this.read(block));
    if (this.waiting.length > 0) void this.readSession();
  }

  private use(session: Session): void {
    if (session.start !== this.session.start) return location.reload();
    const schema = new Schema(session);
    this.session = session;
    this.generation = session.generation;
    this.source.schema = schema;
    this.app?.use(session, schema);
    this.source.follow(session.begun);
  }

  private receive(message: ServerMessage): void {
    const app = this.app as App;
    const { commands, tune, drive } = app;
    switch (message.type) {
      case "status":
        this.status = message;
        this.source.follow(message.begun);
        this.markEnd(message);
        drive.show(message);
        tune.showStatus(message);
        this.showState();
        break;
      case "events":
        this.markEvents(message.events);
        break;
      case "reply":
        commands.reply(message);
        break;
      case "notice":
        app.notes.say(message.text, "error");
    }
  }

  /** Marks the end of a run, once. */
  private markEnd({ ended, tick, begun }: Status): void {
    if (ended === null || this.ended === begun) return;
    this.ended = begun;
    this.source.mark(endOf((tick - 1) * this.source.schema.period, ended));
  }

  private markEvents(events: RawEvent[]): void {
    const marks = marksOf(events, this.source.schema.events);
    this.source.mark(...marks);
    for (const { kind, text } of marks) if (kind === "change") this.app?.notes.say(text, "plain", "change");
  }

  private showState(): void {
    const { state, silence } = this.connection;
    const badge = part("link-state");
    badge.dataset["state"] = silence > 0 ? "lost" : state;
    const words = { open: "connected", lost: this.connection.reason === "" ? "connection lost" : "turned away", connecting: "connecting" };
    setText(badge, silence > 0 ? `no answer for ${silence} s` : words[state]);
    showLink(linkText(this.connection, this.source.last), silence > 0 || state === "lost");
    if (silence > 0) this.app?.notes.keep("silent", NO_ANSWER, "error");
    else this.app?.notes.take("silent");
    this.showUse();
  }

  /** Enables commands while the program answers and its run has not ended. */
  private showUse(): void {
    this.app?.letCommand(this.isHeard && this.status?.ended == null);
  }

  private changeState(state: ConnectionState): void {
    const app = this.app as App;
    this.showState();
    if (state !== "open") {
      this.lostBefore = true;
      app.commands.lost();
    }
    if (state === "lost") {
      app.notes.keep("lost", lossText(this.connection.reason), "error");
      void this.lookForAnother();
    } else if (state === "open") {
      app.notes.take("lost");
      app.commands.greet();
      this.reportDrawn();
      if (this.lostBefore) this.comeBack();
      else void this.recall();
    }
  }

  /** Tells the program that the robot is drawn; a run may wait for it. */
  reportDrawn(): void {
    if ((this.app?.pictures ?? 0) > 0) this.connection.send({ type: "drawn" });
  }

  /** Reloads where another program answers: one that shows a log has no live connection. */
  private async lookForAnother(): Promise<void> {
    try {
      if ((await fetchSession()).start !== this.session.start) location.reload();
    } catch {
      // that the connection is lost is shown
    }
  }

  /** The program may be another one now: everything is read again. */
  private comeBack(): void {
    this.isBehind = true;
    this.waiting = [];
    void this.readSession();
  }

  /** Reads events that this page has missed. */
  private async recall(): Promise<void> {
    try {
      const { run } = this.source;
      const events = await askJson<RawEvent[]>("/api/events");
      if (this.source.run !== run) return; // an earlier run
      this.source.mark(...marksOf(events, this.source.schema.events));
    } catch (error) {
      console.warn(error); // that the connection is lost is shown
    }
  }

  /** The log, the speed relative to real time, lost ticks. */
  get facts(): string[] {
    const facts: string[] = [];
    const log = this.status?.recording ?? "";
    if (log !== "") facts.push(logFact(log, runStateOf(this.status, this.isHeard)));
    if (this.status !== undefined && this.rate > 0) facts.push(paceText(this.status));
    const lost = this.dropped + this.skipped;
    if (lost > 0) facts.push(`${lost} ticks not sent in time`);
    return facts.filter((fact) => fact !== "");
  }
}

/** How a run is recorded; unknown while the program does not answer. */
export function logFact(path: string, runState: RunState): string {
  const name = path.slice(path.lastIndexOf("/") + 1);
  if (runState === "unheard") return `log: ${name}`;
  return `${runState === "ended" ? "recorded in" : "recording"} ${name}`;
}

/** Why there is no connection; `reason`: the program's words. */
function lossText(reason: string): string {
  if (reason === "")
    return "The connection to the program is lost. The last picture stays. Look in its terminal: where it has ended, start it again; the page comes back by itself. Over ssh, whether the port is still forwarded.";
  return `The program has closed the connection: ${reason}. The page comes back by itself.`;
}
