import type { RawEvent } from "../data/marks.ts";

/** State of the run, a text message of the server. */
export interface Status {
  type: "status";
  paused: boolean;
  speed: number;
  /** Measured speed relative to real time; 0: not measured yet. */
  real_factor: number;
  time: number;
  tick: number;
  /** Seconds of the run until the robot has calibrated itself, 0 where it takes longer than usual; null: it does not calibrate. */
  calibrating: number | null;
  ended: string | null;
  recording: string;
  generation: number;
  /** Generation at which the present run began. */
  begun: number;
  command: { walk: boolean; velocity: number[]; yaw_rate: number; height: number; gait: string; by: string };
  /** Changes from outside since the run began. */
  changes: number;
}

export interface Reply {
  type: "reply";
  id: number;
  ok: boolean;
  error?: string;
  /** False: the program does not know the token of this page, which can only look. */
  token?: boolean;
}

export interface Notice {
  type: "notice";
  text: string;
}

/** Events, as in `/api/events`. */
export interface Events {
  type: "events";
  events: RawEvent[];
}

export type ServerMessage = Status | Events | Reply | Notice;

/** Reads a text message; throws where it is none. */
function readMessage(text: string): ServerMessage {
  const message = parsed(text) as Partial<ServerMessage> | null | undefined;
  if (typeof message?.type !== "string") throw new Error("what the program said is no message: program and page are of different versions, load the page again");
  return message as ServerMessage;
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

export type ConnectionState = "connecting" | "open" | "lost";

const FIRST_WAIT = 250;
const LONGEST_WAIT = 5000;

/** Milliseconds before attempt `n` to connect again; twice as long each time. */
export function backoff(attempt: number): number {
  return Math.min(LONGEST_WAIT, FIRST_WAIT * 2 ** attempt);
}

/** Seconds of simulation that come in a second: as measured, but not more than was asked for just now. */
export function rateOf({ paused, ended, speed, real_factor }: Pick<Status, "paused" | "ended" | "speed" | "real_factor">): number {
  if (paused || ended !== null) return 0;
  return real_factor > 0 ? Math.min(real_factor, speed) : speed;
}

/** Without messages for this long, the program does not answer; it sends its state four times a second [ms]. */
const SILENCE = 3000;

/** Whole seconds since the last message where these are too many, otherwise 0. */
export function silenceOf(heard: number, now: number): number {
  return now - heard < SILENCE ? 0 : Math.floor((now - heard) / 1000);
}

/** A connection without messages for this long is replaced [ms]: a browser that only receives does not notice that the other machine is gone. */
const GIVEN_UP = 20000;
/** Period of that check [ms]. */
const WATCH_PERIOD = 1000;

/** The socket of a live run; opens again by itself. */
export class Connection {
  state: ConnectionState = "connecting";
  onBlock: (block: ArrayBuffer) => void = () => {};
  onMessage: (message: ServerMessage) => void = () => {};
  onState: (state: ConnectionState) => void = () => {};
  /** A message can't be read. */
  onUnreadable: (error: Error) => void = () => {};
  /** Why the program closed the connection last, in its words; "": no reason given. */
  reason = "";

  private socket: WebSocket | undefined;
  private attempt = 0;
  private heard = performance.now();

  constructor(private readonly url: string) {
    setInterval(() => this.watch(), WATCH_PERIOD);
  }

  /** Whole seconds since the last message. */
  get quiet(): number {
    return Math.max(0, Math.floor((performance.now() - this.heard) / 1000));
  }

  /** Seconds without messages on a connection that is open or first opening; 0 where that is normal. */
  get silence(): number {
    return this.state === "lost" ? 0 : silenceOf(this.heard, performance.now());
  }

  open(): void {
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      this.heard = performance.now();
      if (this.state !== "open") this.welcome();
      if (typeof data === "string") this.read(data);
      else this.onBlock(data);
    };
    socket.onclose = ({ reason }) => {
      this.reason = reason;
      this.enter("lost");
      setTimeout(() => this.open(), backoff(this.attempt++));
    };
  }

  private read(text: string): void {
    let message: ServerMessage;
    try {
      message = readMessage(text);
    } catch (error) {
      return this.onUnreadable(error as Error);
    }
    this.onMessage(message);
  }

  /** The first message means that the program has accepted the page: a refused page gets none. */
  private welcome(): void {
    this.attempt = 0;
    this.enter("open");
  }

  private watch(): void {
    if (this.state !== "open" || this.socket === undefined || performance.now() - this.heard < GIVEN_UP) return;
    this.socket.onmessage = this.socket.onclose = null;
    this.socket.close();
    this.enter("connecting");
    this.open();
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
