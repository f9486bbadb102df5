import "uplot/dist/uPlot.min.css";
import "./style/page.css";
import "./style/view.css";
import "./style/panels.css";
import { App } from "./app.ts";
import { Notes } from "./panels/notes.ts";
import { part, setText } from "./panels/dom.ts";
import { ask, textOf } from "./protocol/ask.ts";
import { NO_ANSWER } from "./panels/stale.ts";
import { silenceOf } from "./protocol/connection.ts";
import { fetchSession } from "./protocol/session.ts";
import { followToken, tokenOf } from "./protocol/token.ts";
import { startPage } from "./start.ts";
import { expose } from "./test_window.ts";
import { Theme } from "./theme.ts";

function showLost(words: string): void {
  setText(part("link-state"), words);
  part("link-state").dataset["state"] = "lost";
}

/** Shows that the program does not answer, while a first request is pending. */
class Waiting {
  /** When the pending request was sent; Infinity: none is pending. */
  private since = Infinity;
  private readonly timer = setInterval(() => this.look(), 500);

  constructor(private readonly notes: Notes) {}

  private look(): void {
    const silence = silenceOf(this.since, performance.now());
    if (silence === 0) return;
    showLost(`no answer for ${silence} s`);
    this.notes.keep("silent", NO_ANSWER, "error");
  }

  asked(): void {
    this.since = performance.now();
  }

  failed(): void {
    this.since = Infinity;
    this.notes.take("silent");
    showLost("no connection");
  }

  answered(): void {
    clearInterval(this.timer);
    this.notes.take("silent");
  }

  broken(): void {
    showLost("page incomplete");
    part("stale").hidden = true;
  }
}

function start(): void {
  const notes = new Notes();
  const theme = new Theme(); // the first answer may take a while
  const waiting = new Waiting(notes);
  const read = () => Promise.all([fetchSession(), ask("/api/robot.urdf").then(textOf)]);
  void startPage(read, ([session, urdf]) => expose(new App(session, urdf, tokenOf(location.hash), notes, theme)), notes, waiting);
}

followToken(window);
start();
