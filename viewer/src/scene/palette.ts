/** Colours of the scene: those of Okabe and Ito, as the report has them. */
export interface Palette {
  dark: boolean;
  background: number;
  ground: number;
  groundLine: number;
  edge: number;
  legs: [number, number, number, number];
  good: number;
  near: number;
  bad: number;
  /** What is left of a limit: the less, the stronger, and of no leg's hue. */
  margin: { good: number; near: number; bad: number };
  com: number;
  zmp: number;
  plane: number;
  ghost: number;
  push: number;
  label: string;
}

const LIGHT: Palette = {
  dark: false,
  background: 0xeef1f4,
  ground: 0xdfe3e6,
  groundLine: 0xc3c9ce,
  edge: 0x7b848c,
  legs: [0x0072b2, 0xd55e00, 0x009e73, 0xaa4499],
  good: 0x009e73,
  near: 0xe69f00,
  bad: 0xd55e00,
  margin: { good: 0xa9b3bc, near: 0xc9a100, bad: 0x000000 },
  com: 0x1c1f23,
  zmp: 0xaa4499,
  plane: 0x0072b2,
  ghost: 0x56b4e9,
  push: 0xaa4499,
  label: "#1c1f23",
};

const DARK: Palette = {
  ...LIGHT,
  dark: true,
  background: 0x14171a,
  ground: 0x23282d,
  groundLine: 0x363e45,
  edge: 0x7b868f,
  legs: [0x56b4e9, 0xf5934e, 0x3fc99c, 0xe29bd3],
  good: 0x3fc99c,
  near: 0xf0c04a,
  bad: 0xff7a4d,
  margin: { good: 0x66717b, near: 0xe8d44d, bad: 0xffffff },
  com: 0xf2f4f6,
  zmp: 0xe29bd3,
  plane: 0x56b4e9,
  push: 0xe29bd3,
  label: "#e8eaed",
};

export const paletteOf = (dark: boolean): Palette => (dark ? DARK : LIGHT);

export const css = (colour: number): string => `#${colour.toString(16).padStart(6, "0")}`;
