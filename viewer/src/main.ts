import "uplot/dist/uPlot.min.css";
import "./style/page.css";
import "./style/view.css";
import "./style/panels.css";
import { App } from "./app.ts";
import { Notes } from "./panels/notes.ts";
import { part, setText } from "./panels/dom.ts";
import { ask, textOf } from "./protocol/ask.ts";
import { fetchSession } from "./protocol/session.ts";
import { followToken, tokenOf } from "./protocol/token.ts";
import { startPage } from "./start.ts";
import { expose } from "./test_window.ts";
import { Theme } from "./theme.ts";

function showLost(words: string): void {
  setText(part("link-state"), words);
  part("link-state").dataset["state"] = "lost";
  if (words === "page incomplete") part("stale").hidden = true;
}

const notes = new Notes();
const theme = new Theme(); // the first answer may take a while
const read = () => Promise.all([fetchSession(), ask("/api/robot.urdf").then(textOf)]);
followToken(window);
void startPage(read, ([session, urdf]) => expose(new App(session, urdf, tokenOf(location.hash), notes, theme)), notes, showLost);
