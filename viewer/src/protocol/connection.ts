/** What the server says in text messages. */
export interface Status {
  type: "status";
  paused: boolean;
  speed: number;
  real_factor: number;
  time: number;
  tick: number;
  clients: number;
  can_command: boolean;
  ended: string | null;
  recording: string;
  generation: number;
  command: { walk: boolean; velocity: number[]; yaw_rate: number; height: number; by: string };
  undo: number;
  push: { force: number[]; body: string; until: number } | null;
}

export interface Change {
  type: "change";
  time: number;
  kind: string;
  text: string;
}

export interface Reply {
  type: "reply";
  id: number;
  ok: boolean;
  error?: string;
}

export interface Notice {
  type: "notice";
  text: string;
}

export type ServerMessage = Status | Change | Reply | Notice;

export type ConnectionState = "connecting" | "open" | "lost";

const FIRST_WAIT = 250;
const LONGEST_WAIT = 5000;

/** Milliseconds before attempt `n` to connect again; twice as long each time. */
export function backoff(attempt: number): number {
  return Math.min(LONGEST_WAIT, FIRST_WAIT * 2 ** attempt);
}

/** Seconds of simulation that come in a second: as measured, but not more than was asked for just now. */
export function rateOf({ paused, ended, speed, real_factor }: Status): number {
  if (paused || ended !== null) return 0;
  return real_factor > 0 ? Math.min(real_factor, speed) : speed;
}

/** The socket of a live run; opens again by itself. */
export class Connection {
  state: ConnectionState = "connecting";
  onBlock: (block: ArrayBuffer) => void = () => {};
  onMessage: (message: ServerMessage) => void = () => {};
  onState: (state: ConnectionState) => void = () => {};

  private socket: WebSocket | undefined;
  private attempt = 0;

  constructor(private readonly url: string) {}

  open(): void {
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.attempt = 0;
      this.enter("open");
    };
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data === "string") this.onMessage(JSON.parse(data) as ServerMessage);
      else this.onBlock(data);
    };
    socket.onclose = () => {
      this.enter("lost");
      setTimeout(() => this.open(), backoff(this.attempt++));
    };
  }

  /** False where there is no connection. */
  send(message: object): boolean {
    if (this.state !== "open" || this.socket === undefined) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private enter(state: ConnectionState): void {
    this.state = state;
    this.onState(state);
  }
}
