import "uplot/dist/uPlot.min.css";
import "./style/page.css";
import "./style/view.css";
import "./style/panels.css";
import { App } from "./app.ts";
import { Notes } from "./panels/notes.ts";
import { part, say } from "./panels/dom.ts";
import { ask, textOf } from "./protocol/ask.ts";
import { NO_ANSWER } from "./panels/stale.ts";
import { backoff, silenceOf } from "./protocol/connection.ts";
import { fetchSession } from "./protocol/session.ts";
import { followToken, tokenOf } from "./protocol/token.ts";
import { expose } from "./test_window.ts";

function showLost(words: string): void {
  say(part("link-state"), words);
  part("link-state").dataset["state"] = "lost";
}

async function start(): Promise<void> {
  const notes = new Notes();
  let asked = performance.now();
  const waiting = setInterval(() => {
    const silence = silenceOf(asked, performance.now());
    if (silence === 0) return;
    showLost(`no answer for ${silence} s`);
    notes.keep("silent", NO_ANSWER, "error");
  }, 500);
  for (let attempt = 0; ; ++attempt) {
    asked = performance.now();
    try {
      const [session, urdf] = await Promise.all([fetchSession(), ask("/api/robot.urdf").then(textOf)]);
      clearInterval(waiting);
      for (const key of ["silent", "start"]) notes.take(key);
      expose(new App(session, urdf, tokenOf(location.hash), notes));
      return;
    } catch (error) {
      console.warn(error);
      showLost("no connection");
      notes.take("silent");
      asked = Infinity; // it has answered, or there is none to answer
      notes.keep("start", `The run can't be shown: ${(error as Error).message}. The page tries again by itself.`, "error");
      await new Promise((resolve) => setTimeout(resolve, backoff(attempt)));
    }
  }
}

followToken(window);
void start();
