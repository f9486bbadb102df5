import type { Notes } from "./panels/notes.ts";
import { NO_ANSWER } from "./panels/stale.ts";
import { pause } from "./protocol/ask.ts";
import { backoff, silenceOf } from "./protocol/connection.ts";

type KeptNotes = Pick<Notes, "keep" | "take">;
type Show = (words: string) => void;

/** How often a pending request is checked [ms]. */
const PERIOD = 500;

/** Repeats `read` until it succeeds; shows that the program does not answer meanwhile. */
async function readRun<T>(read: () => Promise<T>, notes: KeptNotes, show: Show): Promise<T> {
  for (let attempt = 0; ; ++attempt) {
    const begin = performance.now();
    const timer = setInterval(() => {
      const silence = silenceOf(begin, performance.now());
      if (silence === 0) return;
      show(`no answer for ${silence} s`);
      notes.keep("silent", NO_ANSWER, "error");
    }, PERIOD);
    try {
      return await read();
    } catch (error) {
      console.warn(error);
      show("no connection");
      notes.keep("start", `The run can't be shown: ${(error as Error).message}. The page tries again by itself.`, "error");
    } finally {
      clearInterval(timer);
      notes.take("silent");
    }
    await pause(backoff(attempt));
  }
}

/** Reads the run and makes its page, once: a second page on top of a broken one would not help. `show`: shows a lost connection, in words. */
export async function startPage<T>(read: () => Promise<T>, make: (run: T) => void, notes: KeptNotes, show: Show): Promise<void> {
  const run = await readRun(read, notes, show);
  notes.take("start");
  try {
    make(run);
  } catch (error) {
    console.error(error);
    show("page incomplete");
    notes.keep("start", `The page can't show this run: ${(error as Error).message}. Load it again; where that does not help, program and page may be of different versions.`, "error");
  }
}
