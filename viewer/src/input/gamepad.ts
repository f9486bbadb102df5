import type { Walk } from "../protocol/commands.ts";
import type { Axis } from "../panels/drive_panel.ts";

const DEAD_ZONE = 0.12;
/** What the sticks say is sent this often [s]. */
const PERIOD = 0.1;

/** A stick's value without its dead zone, from −1 to 1. */
export function beyondDeadZone(value: number): number {
  const size = Math.max(0, Math.abs(value) - DEAD_ZONE) / (1 - DEAD_ZONE);
  return Math.sign(value) * size;
}

/** Walks by the first gamepad: what it asks for changes only while somebody holds a stick. */
export class GamepadInput {
  private since = 0;
  private last = "";
  private pressed = [false, false];

  constructor(
    private readonly most: Record<Axis, number>,
    private readonly walk: (walk: Omit<Walk, "height">) => void,
    private readonly stand: () => void,
    private readonly giveBack: () => void,
  ) {}

  update(dt: number): void {
    this.since += dt;
    if (this.since < PERIOD) return;
    this.since = 0;
    const pad = navigator.getGamepads?.().find((one) => one !== null && one.connected);
    if (pad == null) return this.release();
    [this.stand, this.giveBack].forEach((run, k) => {
      const down = pad.buttons[k]?.pressed ?? false;
      if (down && !this.pressed[k]) run();
      this.pressed[k] = down;
    });
    const [left, forward, turn] = [0, 1, 2].map((axis) => beyondDeadZone(-(pad.axes[axis] ?? 0))) as [number, number, number];
    const short = (value: number): number => Number(value.toFixed(3)) + 0;
    this.ask([short(forward * this.most.forward), short(left * this.most.left)], short(turn * this.most.turn));
  }

  /** Nobody holds a stick any more: the gamepad is gone, or nobody sees the page. */
  release(): void {
    if (this.last !== "") this.ask([0, 0], 0);
  }

  private ask(velocity: [number, number], yaw_rate: number): void {
    const key = `${velocity} ${yaw_rate}`;
    if (key === this.last || (this.last === "" && key === "0,0 0")) return;
    this.last = key;
    this.walk({ walk: true, velocity, yaw_rate });
  }
}
