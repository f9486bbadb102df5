import type { Notes } from "./panels/notes.ts";
import { pause } from "./protocol/ask.ts";
import { backoff } from "./protocol/connection.ts";

/** Progress of the first requests. */
export interface Asking {
  asked(): void;
  failed(): void;
  answered(): void;
  /** The page can't show the answers. */
  broken(): void;
}

type KeptNotes = Pick<Notes, "keep" | "take">;

/** Repeats `read` until it succeeds. */
async function readRun<T>(read: () => Promise<T>, notes: KeptNotes, asking: Asking): Promise<T> {
  for (let attempt = 0; ; ++attempt) {
    asking.asked();
    try {
      return await read();
    } catch (error) {
      console.warn(error);
      asking.failed();
      notes.keep("start", `The run can't be shown: ${(error as Error).message}. The page tries again by itself.`, "error");
      await pause(backoff(attempt));
    }
  }
}

/** Reads the run and makes its page, once: a second page on top of a broken one would not help. */
export async function startPage<T>(read: () => Promise<T>, make: (run: T) => void, notes: KeptNotes, asking: Asking): Promise<void> {
  const run = await readRun(read, notes, asking);
  asking.answered();
  notes.take("start");
  try {
    make(run);
  } catch (error) {
    console.error(error);
    asking.broken();
    notes.keep("start", `The page can't show this run: ${(error as Error).message}. Load it again; where that does not help, program and page may be of different versions.`, "error");
  }
}
