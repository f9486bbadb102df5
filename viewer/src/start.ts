import type { Notes } from "./panels/notes.ts";
import { pause } from "./protocol/ask.ts";
import { backoff } from "./protocol/connection.ts";

/** Hears how far it has come with what is asked of the program. */
export interface Asking {
  asked(): void;
  failed(): void;
  answered(): void;
  /** The page can't be made of what has come. */
  broken(): void;
}

type Told = Pick<Notes, "keep" | "take">;

/** What `read` gives, asked for until it does. */
async function readRun<T>(read: () => Promise<T>, notes: Told, asking: Asking): Promise<T> {
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

/** Makes the page of the run once that is read: what can't be made is not made better by a second one on top of it. */
export async function startPage<T>(read: () => Promise<T>, make: (run: T) => void, notes: Told, asking: Asking): Promise<void> {
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
