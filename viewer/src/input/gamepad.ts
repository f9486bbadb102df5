/** Shares of full speed, from −1 to 1. */
export interface Sticks {
  forward: number;
  left: number;
  turn: number;
}

/** Sticks rest within this. */
const DEAD = 0.15;
/** Commands while a stick moves [ms]. */
const INTERVAL = 100;
/** Buttons of the standard layout. */
const BUTTONS = { 0: "push", 1: "stand", 4: "previous", 5: "next" } as const;

export type Button = (typeof BUTTONS)[keyof typeof BUTTONS];

interface Pad {
  axes: readonly number[];
  buttons: readonly { pressed: boolean }[];
}

/** The left stick walks, the right one turns. */
export function sticksOf({ axes }: Pick<Pad, "axes">): Sticks {
  const of = (axis: number): number => {
    const value = axes[axis] ?? 0;
    const beyond = Math.max(0, Math.abs(value) - DEAD) / (1 - DEAD);
    return Number((-Math.sign(value) * beyond).toFixed(2)) + 0;
  };
  return { forward: of(1), left: of(0), turn: of(2) };
}

/** Reads the first gamepad at each picture: calls `drive` when its sticks have moved, and `press` for its buttons. */
export class GamepadReader {
  private before: Sticks = { forward: 0, left: 0, turn: 0 };
  private readonly held = new Set<Button>();
  private told = -Infinity;

  constructor(
    private readonly drive: (sticks: Sticks) => void,
    private readonly press: (button: Button) => void,
    private readonly pads: () => readonly (Pad | null)[] = () => navigator.getGamepads(),
  ) {}

  read(now: number): void {
    const pad = this.pads().find((one) => one !== null);
    if (pad == null) return;
    for (const [index, button] of Object.entries(BUTTONS)) {
      const pressed = pad.buttons[Number(index)]?.pressed ?? false;
      if (pressed && !this.held.has(button)) this.press(button);
      if (pressed) this.held.add(button);
      else this.held.delete(button);
    }
    const sticks = sticksOf(pad);
    if (now - this.told < INTERVAL || JSON.stringify(sticks) === JSON.stringify(this.before)) return;
    this.before = sticks;
    this.told = now;
    this.drive(sticks);
  }
}
