import { askJson } from "./ask.ts";

/** What `/api/session` answers (viewer/README.md). */
export interface ChannelInfo {
  name: string;
  unit: string;
  about: string;
  size: number;
  labels?: string[];
  values?: string[];
  offset: number;
}

export interface MeshInfo {
  id: number;
  uri: string;
  found: boolean;
}

export interface TerrainPiece {
  shape: string;
  position: number[];
  q_SG: number[];
  size: number[];
  columns: number;
  rows: number;
  heights: number[];
}

export interface TaskNumber {
  name: string;
  value: number;
  unit: string;
  about: string;
  min: number;
  max: number;
}

export interface TaskInfo {
  level: number;
  level_name: string;
  task: string;
  numbers: TaskNumber[];
}

export interface LimbLimits {
  level: number;
  form: string;
  min: number | null;
  max: number | null;
}

export interface Header {
  scenario: string;
  stack: string;
  description: string;
  command: string;
  seed: number;
  estimation: string;
  level_names: string[];
  level_units: string[];
  event_names: string[];
  robot: {
    name: string;
    joint_names: string[];
    torque_limit: number[];
    mass: number;
    foot_radius: number;
  };
  limb: LimbLimits;
  terrain: TerrainPiece[];
  notes: string[];
}

export interface Limits {
  push_newton_seconds: number;
  push_newtons: number;
  push_seconds: number;
  speeds: number[];
  /** Limits of a walk command: m/s, rad/s, m. */
  walk_velocity: number;
  walk_yaw_rate: number;
  walk_height: number;
  friction_min: number;
  friction_max: number;
}

/** The levels' order from a tick on. */
export interface Order {
  tick: number;
  levels: string[];
}

export interface Session {
  protocol: number;
  /** Names a start of the program: another start serves another run. */
  start: string;
  mode: "live" | "replay";
  version: string;
  title: string;
  header: Header;
  source: string;
  /** Of a log: why the run does not end where it should; "": it does. */
  cut: string;
  /** Of a log: why its run ended; "": that is not known. Of a live run its status says so. */
  ended: string;
  period: number;
  first_tick: number;
  ticks: number;
  /** Of a log: ticks from the first on that are summarised by now. */
  summarised: number;
  /** Of a log: sentences on what of it can't be read, so far. */
  damage: string[];
  channels: ChannelInfo[];
  frame_floats: number;
  rows: string[][];
  bodies: string[];
  meshes: MeshInfo[];
  limits: Limits;
  /** Names of the gaits that a command may ask for. */
  gaits: string[];
  orders: Order[];
  generation: number;
  /** Generation at which the present run began; it changes with each reset. */
  begun: number;
  /** Friction that the operator gave the controller. */
  friction: number;
  tasks: TaskInfo[];
}

/** The levels' order as it is now. */
export function orderOf({ orders, header }: Session): string[] {
  return orders.at(-1)?.levels ?? header.level_names;
}

export const PROTOCOL = 2;

/** Reads the session; the error says what is wrong in a sentence. */
export async function fetchSession(): Promise<Session> {
  const session = await askJson<Session>("/api/session");
  if (session.protocol !== PROTOCOL)
    throw new Error(
      `the program speaks version ${session.protocol} of the protocol, this page version ${PROTOCOL}: load the page again`,
    );
  return session;
}
