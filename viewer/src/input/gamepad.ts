import type { Walk } from "../protocol/commands.ts";
import type { Axis } from "../panels/drive_panel.ts";

const DEAD_ZONE = 0.12;
/** What the sticks say is sent this often [s]. */
const PERIOD = 0.1;
/** The program may have heard of it or not. */
const UNSURE = "unsure";

/** A stick's value without its dead zone, from −1 to 1. */
export function beyondDeadZone(value: number): number {
  const size = Math.max(0, Math.abs(value) - DEAD_ZONE) / (1 - DEAD_ZONE);
  return Math.sign(value) * size;
}

/** What a gamepad does. */
export interface GamepadActions {
  walk: (walk: Omit<Walk, "height">) => void;
  stand: () => void;
  giveBack: () => void;
  /** Something that the user is to know. */
  tell: (text: string) => void;
}

/** Walks by the first gamepad whose layout the browser knows (what rests at an end, as a trigger, is no stick): what it asks for
 * changes only while somebody holds a stick that was let go before. */
export class GamepadInput {
  private since = 0;
  /** What was asked for last; "": nothing. */
  private last = "";
  private pressed = [false, false];
  /** Until the sticks are let go they ask for nothing. */
  private waits = true;
  private readonly toldOf = new Set<string>();

  constructor(private readonly most: Record<Axis, number>, private readonly actions: GamepadActions) {}

  /** `canAct`: whether there is something to command. */
  update(dt: number, canAct: boolean): void {
    this.since += dt;
    if (this.since < PERIOD) return;
    this.since = 0;
    if (!canAct) return this.pause();
    const pad = this.pad();
    if (pad === undefined) return this.release();
    const held = this.held(pad);
    this.press(pad);
    if (held.isNone && this.waits) this.waits = false;
    else if (!this.waits) this.ask(held.velocity, held.yaw_rate);
  }

  /** Nobody holds a stick any more: the gamepad is gone, or nobody sees the page. */
  release(): void {
    this.waits = true;
    if (this.last !== "") this.ask([0, 0], 0);
  }

  /** The run begins again: nothing was asked of it. */
  restart(): void {
    this.last = "";
  }

  private pause(): void {
    if (this.last !== "") this.last = UNSURE;
  }

  private pad(): Gamepad | undefined {
    const pads = [...(navigator.getGamepads?.() ?? [])].filter((one): one is Gamepad => one !== null && one.connected);
    const known = pads.find(({ mapping }) => mapping === "standard");
    if (known === undefined) for (const { id } of pads) this.tellUnknown(id);
    return known;
  }

  private tellUnknown(id: string): void {
    if (this.toldOf.has(id)) return;
    this.toldOf.add(id);
    this.actions.tell(`The gamepad “${id}” does nothing here: this browser does not know where its sticks are.`);
  }

  /** Who stands or gives back means it, also with a stick in the hand. */
  private press(pad: Gamepad): void {
    [this.actions.stand, this.actions.giveBack].forEach((run, k) => {
      const down = pad.buttons[k]?.pressed ?? false;
      if (down && !this.pressed[k]) {
        run();
        this.waits = true;
        this.last = "";
      }
      this.pressed[k] = down;
    });
  }

  private held({ axes }: Gamepad): { velocity: [number, number]; yaw_rate: number; isNone: boolean } {
    const [left, forward, turn] = [0, 1, 2].map((axis) => beyondDeadZone(-(axes[axis] ?? 0))) as [number, number, number];
    const short = (value: number): number => Number(value.toFixed(3)) + 0;
    const velocity: [number, number] = [short(forward * this.most.forward), short(left * this.most.left)];
    const yaw_rate = short(turn * this.most.turn);
    return { velocity, yaw_rate, isNone: [...velocity, yaw_rate].every((one) => one === 0) };
  }

  private ask(velocity: [number, number], yaw_rate: number): void {
    const key = `${velocity} ${yaw_rate}`;
    if (key === this.last || (this.last === "" && key === "0,0 0")) return;
    this.last = key;
    this.actions.walk({ walk: true, velocity, yaw_rate });
  }
}
