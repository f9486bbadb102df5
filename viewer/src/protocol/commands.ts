import type { Connection, Reply } from "./connection.ts";

/** Message of a page without the token. */
export const VIEW_ONLY = "this page can only look: open the link with #token=… that the program printed last";

/** Sends a command; a refusal is shown, and drops the wish. */
export type Ask = (type: string, fields: object, wish?: { drop: () => void }) => void;

/** Sends commands to the server. Each needs the token of the link that the program printed. */
export class Commands {
  /** The program does not know the token, such as that of an earlier start. */
  onRefused: () => void = () => {};
  private id = 0;
  private refused = false;
  private readonly waiting = new Map<number, (reply: Reply) => void>();

  constructor(
    private readonly connection: Connection | undefined,
    private readonly token: string,
  ) {}

  /** Whether the page has a token for a live run that the program has not refused. */
  get allowed(): boolean {
    return this.connection !== undefined && this.token !== "" && !this.refused;
  }

  /** Asks whether the program knows the token, before the first command. */
  greet(): void {
    if (this.allowed) this.send("hello").catch(() => {}); // a refusal is shown; a lost question is asked again
  }

  /** Ends with the server's answer; the error says why the command was not done. */
  send(type: string, fields: object = {}): Promise<void> {
    if (this.connection === undefined) return Promise.reject(new Error("a log can't be changed"));
    if (!this.allowed) return Promise.reject(new Error(VIEW_ONLY));
    // A stopped program would execute the command whenever it continues.
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

  /** The connection is lost: commands that wait get no answer. */
  lost(): void {
    for (const [id, answer] of this.waiting)
      answer({ type: "reply", id, ok: false, error: "the connection was lost before the answer" });
    this.waiting.clear();
  }
}
