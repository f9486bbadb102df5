import type { Connection, Reply } from "./connection.ts";

/** What a page without the token says wherever it can't do something. */
export const VIEW_ONLY = "this page can only look: open the link with #token=… that the program printed last";

/** Asks the run for something; a refusal is shown, and ends the wish. */
export type Ask = (type: string, fields: object, wish?: { drop: () => void }) => void;

/** Asks the server for changes of the run. Each needs the token of the link that the program printed. */
export class Commands {
  /** The program does not know the token: it is that of an earlier start, say. */
  onRefused: () => void = () => {};
  private id = 0;
  private refused = false;
  private readonly waiting = new Map<number, (reply: Reply) => void>();

  constructor(
    private readonly connection: Connection | undefined,
    private readonly token: string,
  ) {}

  /** Whether this page was opened with a token on a live run, and the program has not refused it. */
  get allowed(): boolean {
    return this.connection !== undefined && this.token !== "" && !this.refused;
  }

  /** Asks whether the program knows the token, before anybody presses something. */
  greet(): void {
    if (this.allowed) this.send("hello").catch(() => {}); // what is refused is shown, what is lost asked again
  }

  /** Ends with the server's answer; an error says why it was not done. */
  send(type: string, fields: object = {}): Promise<void> {
    if (this.connection === undefined) return Promise.reject(new Error("a log can't be changed"));
    if (!this.allowed) return Promise.reject(new Error(VIEW_ONLY));
    // What waits in the socket of a program that stands still would be done once it goes on, whenever that is.
    if (this.connection.silence > 0) return Promise.reject(new Error("the program does not answer, so it was not asked"));
    const id = ++this.id;
    if (!this.connection.send({ type, ...fields, token: this.token, id }))
      return Promise.reject(new Error("there is no connection to the program"));
    return new Promise((resolve, reject) => {
      this.waiting.set(id, (reply) => (reply.ok ? resolve() : reject(new Error(reply.error ?? "refused"))));
    });
  }

  reply(reply: Reply): void {
    if (reply.token === false && !this.refused) {
      this.refused = true;
      this.onRefused();
    }
    this.waiting.get(reply.id)?.(reply);
    this.waiting.delete(reply.id);
  }

  /** The connection is gone: what waits gets no answer. */
  lost(): void {
    for (const [id, answer] of this.waiting)
      answer({ type: "reply", id, ok: false, error: "the connection was lost before the answer" });
    this.waiting.clear();
  }
}
