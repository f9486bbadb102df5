import { Color } from "three";

/** Colours of the scene. The first four legs have Okabe and Ito's, as in the report and the plots; no mark has a leg's colour. All can be distinguished with
 * red-green blindness. */
export interface Palette {
  dark: boolean;
  background: number;
  ground: number;
  groundLine: number;
  edge: number;
  /** In the robot's order, of as many as a robot may have. */
  legs: [number, number, number, number, number, number];
  /** For shares of a limit: stronger the less is left, and of no leg's hue. */
  margin: { good: number; near: number; bad: number };
  /** Outline of pyramids that are nearly used up: as bright as the ground, to stand out from any body. */
  alarmEdge: number;
  com: number;
  /** Plan of the centre of mass. */
  plan: number;
  zmp: number;
  support: number;
  plane: number;
  ghost: number;
  push: number;
  /** Outline of arrows over bodies of any colour. */
  halo: number;
}

const LIGHT: Palette = {
  dark: false,
  background: 0xeef1f4,
  ground: 0xdfe3e6,
  groundLine: 0xc3c9ce,
  edge: 0x7b848c,
  legs: [0x0072b2, 0xd55e00, 0x009e73, 0xaa4499, 0x650c84, 0x3589fd],
  margin: { good: 0x868f98, near: 0xa67f00, bad: 0xe4003a },
  alarmEdge: 0xffffff,
  com: 0x1c1f23,
  plan: 0x5226d8,
  zmp: 0xcc0032,
  support: 0x316767,
  plane: 0xacac52,
  ghost: 0x7cb2e8,
  push: 0xf0e442,
  halo: 0x1c1f23,
};

const DARK: Palette = {
  ...LIGHT,
  dark: true,
  background: 0x14171a,
  ground: 0x23282d,
  groundLine: 0x363e45,
  edge: 0x7b868f,
  legs: [0x56b4e9, 0xf5934e, 0x3fc99c, 0xd070c0, 0xa837c2, 0x2661fc],
  margin: { good: 0x66717b, near: 0x9c7a00, bad: 0xff7088 },
  alarmEdge: 0x000000,
  com: 0xf2f4f6,
  plan: 0x9c88ff,
  zmp: 0xe05151,
  support: 0x428989,
  plane: 0xefdda8,
  ghost: 0xa8ddef,
};

export const paletteOf = (dark: boolean): Palette => (dark ? DARK : LIGHT);

/** The colours of overlays that paint many things with one material. */
export function coloursOf({ legs, com, plan, push, halo, margin, alarmEdge }: Palette) {
  const colour = (hex: number): Color => new Color(hex);
  return {
    legs: legs.map(colour), com: colour(com), plan: colour(plan), push: colour(push), halo: colour(halo),
    margin: { good: colour(margin.good), near: colour(margin.near), bad: colour(margin.bad) }, alarmEdge: colour(alarmEdge),
  };
}
export type Colours = ReturnType<typeof coloursOf>;

export const css = (colour: number): string => `#${colour.toString(16).padStart(6, "0")}`;
