import type { ChannelInfo, Order, Session } from "../protocol/session.ts";

/** The names of a quadruped's legs, and of a hexapod's. */
export const LEGS = ["LF", "RF", "LH", "RH"];
export const HEXAPOD_LEGS = ["LF", "RF", "LM", "RM", "LH", "RH"];
export const MOST_LEGS = HEXAPOD_LEGS.length;

/** One for each leg that a robot may have. */
export const perLeg = <T>(make: () => T): T[] => Array.from({ length: MOST_LEGS }, make);

/** Names of a leg's channels. */
export function channelsOf(name: string) {
  return {
    name,
    phase: `plan.feet.${name}.phase`,
    friction: `plan.feet.${name}.friction`,
    plannedFoot: `plan.feet.${name}.p_WF`,
    frictionUse: `commanded.friction_use.${name}`,
    normalForce: `commanded.normal_force.${name}`,
    pyramid: `commanded.q_WP.${name}`,
    pyramidFriction: `commanded.pyramid_friction.${name}`,
    beyond: `told.beyond.${name}`,
    foot: `model.p_WF.${name}`,
    hip: `model.p_WH.${name}`,
    force: `model.force.${name}`,
    touching: `truth.feet.${name}.touching`,
    trueForce: `truth.feet.${name}.force`,
    truePoint: `truth.feet.${name}.point`,
  };
}
/** The base's channel on a topic: the controller's topics are in its world W, what is compared with the truth in the simulator's S. */
export const baseChannel = (topic: string, quantity: "p" | "q" | "v"): string => `${topic}.${quantity}_${topic === "state" ? "W" : "S"}B`;

export type LegChannels = ReturnType<typeof channelsOf>;

/** Gives a level's residual the unit of its rows, from the header. */
function withUnit(channel: ChannelInfo, { header }: Session): ChannelInfo {
  const level = /^hierarchy\.level\.(.+)\.residual$/.exec(channel.name)?.[1];
  const unit = level === undefined ? undefined : header.level_units[header.level_names.indexOf(level)];
  return unit === undefined || channel.unit !== "" ? channel : { ...channel, unit };
}

/** Outside force and torque on each body, the world first. */
export const PUSHES = "truth.xfrc_applied";
const PUSH_PARTS = ["Fx [N]", "Fy [N]", "Fz [N]", "Tx [N·m]", "Ty [N·m]", "Tz [N·m]"];

/** Whether a channel has outside forces, and the names of all its bodies are known. */
export function hasBodies({ name, size }: ChannelInfo, { bodies }: Pick<Session, "bodies">): boolean {
  return name === PUSHES && bodies.length > 0 && size === 6 * (bodies.length + 1);
}

/** Labels outside forces by bodies, and adds words for the search. */
function withBodies(channel: ChannelInfo, { bodies }: Session): ChannelInfo {
  if (!hasBodies(channel, { bodies })) return channel;
  const labels = ["world", ...bodies].flatMap((body) => PUSH_PARTS.map((part) => `${body}.${part}`));
  return { ...channel, labels, about: `push, outside force on each body (${channel.about})` };
}

/** Weight of a robot [N]. */
export const newtonsOf = ({ mass }: { mass: number }): number => 9.81 * mass;

/** Layout of a frame, and the names of levels and rows. */
export class Schema {
  readonly channels: ChannelInfo[];
  /** Of the robot, in its order. */
  readonly legs: LegChannels[];
  readonly frameFloats: number;
  /** Of a tick [s]. */
  readonly period: number;
  /** Of the robot [N]. */
  readonly weight: number;
  readonly levels: string[];
  readonly units: string[];
  readonly rows: string[][];
  orders: Order[];
  readonly events: string[];
  /** Bodies that can be pushed, in the order of the physics. */
  readonly bodies: string[];
  private readonly byName = new Map<string, ChannelInfo>();

  constructor(session: Session) {
    this.channels = session.channels.map((channel) => withBodies(withUnit(channel, session), session));
    const parts = new Set(this.channels.flatMap(({ name }) => name.split(".")));
    this.legs = (HEXAPOD_LEGS.every((leg) => parts.has(leg)) ? HEXAPOD_LEGS : LEGS).map(channelsOf);
    this.frameFloats = session.frame_floats;
    this.period = session.period;
    this.weight = newtonsOf(session.header.robot);
    this.levels = session.header.level_names;
    this.units = session.header.level_units;
    this.rows = session.rows;
    this.orders = session.orders;
    this.events = session.header.event_names;
    this.bodies = session.bodies;
    for (const channel of this.channels) this.byName.set(channel.name, channel);
  }

  channel(name: string): ChannelInfo | undefined {
    return this.byName.get(name);
  }

  /** Index of a channel's first number in a frame; -1: there is none of that name. */
  offset(name: string): number {
    return this.byName.get(name)?.offset ?? -1;
  }

  /** Numbers of the levels as they were at a tick, highest priority first. */
  order(tick: number): number[] {
    const order = this.orders.findLast((one) => one.tick <= tick);
    if (order === undefined) return this.levels.map((_, level) => level);
    return order.levels.map((name) => this.levels.indexOf(name)).filter((level) => level >= 0);
  }

  rowName(level: number, row: number): string {
    return this.rows[level]?.[row] ?? `row ${row}`;
  }
}
