import type { App } from "./app.ts";
import { Explainer, type ExplainAnswer } from "./data/explained.ts";
import { endOf, marksOf, type RawEvent } from "./data/marks.ts";
import { ReplaySource } from "./data/replay_source.ts";
import type { Schema } from "./data/schema.ts";
import type { Mark } from "./data/source.ts";
import { damageText, readText } from "./data/log_words.ts";
import { part, setText } from "./panels/dom.ts";
import { showLink } from "./panels/stale.ts";
import { ask, askJson, NoAnswer, pause } from "./protocol/ask.ts";
import { fetchSession, type Session } from "./protocol/session.ts";

/** How often the progress of the summary is requested [ms]. */
const SUMMARY_PERIOD = 700;
/** How often the server of a log is checked [ms]. */
const SERVER_PERIOD = 2000;
/** Longer loading is shown [ms]. */
const LONG = 1000;
/** Longest time of its answer [ms]; it may be busy with the log. */
const SERVER_SILENCE = 8000;

/** Fills the source of a log with what the program reads, and waits while there is no program. */
export class ReplayLink {
  readonly source: ReplaySource;
  private app: App | undefined;
  /** Pending while the program does not answer. */
  private awaited: Promise<void> | undefined;
  /** Ticks from the first on that are summarised. */
  private summarised = 0;
  /** When all requests were answered last [ms]. */
  private idle = performance.now();

  constructor(
    private readonly schema: Schema,
    private readonly session: Session,
  ) {
    const { period, first_tick, ticks } = session;
    const explainer = new Explainer(async (tick) => (await askJson<ExplainAnswer | null>(`/api/explain?tick=${tick}`)) ?? undefined, schema);
    explainer.onChange = () => this.app?.refresh();
    this.source = new ReplaySource(schema, period, first_tick, ticks, (url) => this.askForFrames(url), explainer);
  }

  wire(app: App): void {
    this.app = app;
    const { cache } = this.source;
    cache.onTile = () => {
      app.refresh();
      app.notes.take("log");
    };
    cache.onError = (error) => {
      if (error instanceof NoAnswer) void this.awaitServer();
      else app.notes.keep("log", `The log can't be read: ${error.message}`, "error");
    };
    showLink("", false);
    setText(part("link-state"), "");
    delete part("link-state").dataset["state"];
    void this.summarise();
    void this.lookForServer();
  }

  /** Loading progress of what is shown; "": it is here. */
  get progress(): string {
    const { ticks, period } = this.session;
    const now = performance.now();
    if (this.source.cache.pending === 0) this.idle = now;
    if (this.summarised < ticks) return readText(this.summarised * period, ticks * period);
    return now - this.idle > LONG ? "Loading …" : "";
  }

  /** Requests frames; waits while the program does not answer. */
  private async askForFrames(url: string): Promise<ArrayBuffer> {
    await this.awaited;
    return ask(url);
  }

  /** Reloads where another program answers, with another log. */
  private async lookForServer(): Promise<void> {
    try {
      const answer = await fetch("/api/alive", { signal: AbortSignal.timeout(SERVER_SILENCE) });
      const start = (await answer.text()).trim();
      if (answer.ok && start !== this.session.start) return location.reload();
    } catch {
      await this.awaitServer();
    }
    setTimeout(() => void this.lookForServer(), SERVER_PERIOD);
  }

  /** Shows that the program does not answer, until it does. */
  private awaitServer(): Promise<void> {
    return (this.awaited ??= this.findServer().finally(() => (this.awaited = undefined)));
  }

  private async findServer(): Promise<void> {
    const app = this.app as App;
    const badge = part("link-state");
    badge.dataset["state"] = "lost";
    setText(badge, "no answer");
    app.notes.keep("server", "The program that serves this log does not answer; if it has ended, start `surefoot replay` again. The page tries again by itself.", "error");
    let session = this.session;
    while (session === this.session) session = await nextSession(this.session);
    if (session.start !== this.session.start) return location.reload();
    setText(badge, "");
    delete badge.dataset["state"];
    app.notes.take("server");
    app.refresh();
  }

  private end(): Mark[] {
    const { ended, cut } = this.session;
    return ended === "" || cut !== "" ? [] : [endOf(this.source.last, ended)];
  }

  /** Reads marks and overviews as the program summarises the log from front to back. */
  private async summarise(): Promise<void> {
    const app = this.app as App;
    for (let session = this.session; ; session = await nextSession(session, () => void this.awaitServer())) {
      if (session.start !== this.session.start) return location.reload();
      const { summarised, damage, orders } = session;
      this.summarised = summarised;
      this.source.summarise(summarised);
      this.schema.orders = orders;
      this.session.damage = damage;
      if (damage.length > 0) app.notes.keep("damage", damageText(damage), "error");
      try {
        this.source.marks = [...marksOf(await askJson<RawEvent[]>("/api/events"), this.schema.events), ...this.end()];
      } catch {
        continue; // requested again with the next session
      }
      app.refresh();
      if (summarised >= session.ticks) return;
    }
  }
}

/** The session a little later, or `before` where it can't be read. */
async function nextSession(before: Session, failed = (): void => {}): Promise<Session> {
  await pause(SUMMARY_PERIOD);
  try {
    return await fetchSession();
  } catch {
    failed();
    return before;
  }
}
