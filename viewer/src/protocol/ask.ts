/** There is no server at the other end, or it went away meanwhile, or does not answer in time. */
export class NoAnswer extends Error {
  constructor() {
    super("the program does not answer");
  }
}

export type Fetch = (url: string) => Promise<Response>;

/** A whole answer that takes longer than this does not come [ms]. */
const LONGEST = 20000;

const fetchInTime: Fetch = (url) => fetch(url, { signal: AbortSignal.timeout(LONGEST) });

/** What the server gives; an error says in its words why not, and is a `NoAnswer` where there is no server. */
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

/** The same, but waits for a server that went away. */
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
