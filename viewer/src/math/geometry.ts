/** Geometry on plain arrays, without the scene. */

export type Point = [number, number];
export type Point3 = [number, number, number];

/** Convex hull seen from above, counter-clockwise; points on an edge are left out. */
export function convexHull<P extends Point | Point3>(points: P[]): P[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const half = (list: P[]): P[] => {
    const chain: P[] = [];
    for (const p of list) {
      while (chain.length >= 2 && cross(chain.at(-2) as P, chain.at(-1) as P, p) <= 0) chain.pop();
      chain.push(p);
    }
    chain.pop();
    return chain;
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

type Seen = Point | Point3;

function cross(o: Seen, a: Seen, b: Seen): number {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

/** How far p lies outside of a convex hull, seen from above; 0 within it. */
export function distanceOutside(hull: Seen[], p: Point): number {
  if (hull.length === 0) return Infinity;
  const sides = hull.map((a, k) => [a, hull[(k + 1) % hull.length] as Seen] as const);
  if (hull.length > 2 && sides.every(([a, b]) => cross(a, b, p) >= 0)) return 0;
  return Math.min(...sides.map(([a, b]) => distanceToSide(a, b, p)));
}

function distanceToSide(a: Seen, b: Seen, p: Point): number {
  const [x, y] = [b[0] - a[0], b[1] - a[1]];
  const along = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
  const at = Number.isNaN(along) ? 0 : Math.min(Math.max(along, 0), 1);
  return Math.hypot(p[0] - a[0] - at * x, p[1] - a[1] - at * y);
}

/** Heading of a body from its orientation w, x, y, z [rad]. */
export function yawOf(q: number[]): number {
  const [w, x, y, z] = q as [number, number, number, number];
  return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

/** Angle within (−π, π]. */
export function wrap(angle: number): number {
  return angle - 2 * Math.PI * Math.ceil((angle - Math.PI) / (2 * Math.PI));
}

/** z of the plane through `point` with `normal`, over (x, y). */
export function planeHeight(point: number[], normal: number[], x: number, y: number): number {
  const [px, py, pz] = point as [number, number, number];
  const [nx, ny, nz] = normal as [number, number, number];
  return pz - (nx * (x - px) + ny * (y - py)) / nz;
}

/**
 * Zero-moment point of forces on the ground: where their normal parts balance.
 * Undefined where nothing carries.
 */
export function centreOfPressure(points: number[][], forces: number[][]): [number, number, number] | undefined {
  let total = 0;
  const sum: [number, number, number] = [0, 0, 0];
  points.forEach((point, k) => {
    const f = Math.max(0, (forces[k] as number[])[2] as number);
    total += f;
    for (let i = 0; i < 3; ++i) sum[i] = (sum[i] as number) + f * (point[i] as number);
  });
  return total > 1 ? [sum[0] / total, sum[1] / total, sum[2] / total] : undefined;
}

/** q as w, x, y, z takes v to the other frame. */
export function rotate(q: number[], v: number[]): [number, number, number] {
  const [w, x, y, z] = q as [number, number, number, number];
  const [a, b, c] = v as [number, number, number];
  const tx = 2 * (y * c - z * b);
  const ty = 2 * (z * a - x * c);
  const tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}
