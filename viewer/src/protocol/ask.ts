/** There is no server, or it does not answer in time. */
export class NoAnswer extends Error {
  constructor() {
    super("the program does not answer");
  }
}

export type Fetch = (url: string) => Promise<Response>;

/** Longest time of a whole answer [ms]. */
const LONGEST = 20000;

const fetchInTime: Fetch = (url) => fetch(url, { signal: AbortSignal.timeout(LONGEST) });

/** The server's answer. Throws an error with the server's words, or `NoAnswer`. */
export async function ask(url: string, fetchFrom = fetchInTime): Promise<ArrayBuffer> {
  let answer: Response;
  let bytes: ArrayBuffer;
  try {
    answer = await fetchFrom(url);
    bytes = await answer.arrayBuffer();
  } catch {
    throw new NoAnswer();
  }
  if (!answer.ok) throw new Error(textOf(bytes).trim() || `the server answered ${answer.status}`);
  return bytes;
}

/** The same, but calls `wait` and asks again while there is no server. */
export async function askUntilAnswered(url: string, wait: () => Promise<void>, fetchFrom: Fetch = fetch): Promise<ArrayBuffer> {
  for (;;) {
    try {
      return await ask(url, fetchFrom);
    } catch (error) {
      if (!(error instanceof NoAnswer)) throw error;
      await wait();
    }
  }
}

/** Reads a JSON answer. */
export async function askJson<T>(url: string): Promise<T> {
  return JSON.parse(textOf(await ask(url))) as T;
}

/** Ends after this long [ms]. */
export const pause = (ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));

export function textOf(bytes: ArrayBuffer): string {
  return new TextDecoder().decode(bytes);
}
