/** Steps between numbers that are read easily, the easiest first; times a power of ten. */
const STEPS = [[1, 2, 5], [4], [2.5], [3, 6, 8], [1.5, 7, 9]];

/** Multiples of a step within [low, high]. */
function multiples(low: number, high: number, step: number): number[] {
  const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, k) => (first + k) * step + 0);
}

/** Numbers of an axis from `low` to `high`, at most `most` and at least two: of a single one nothing can be read off. */
export function ticksOf(low: number, high: number, most: number): number[] {
  if (!(high > low)) return [];
  const room = Math.max(2, most);
  const power = 10 ** Math.floor(Math.log10(high - low));
  for (const factors of STEPS) {
    const tries = [0.1, 1].flatMap((scale) => factors.map((factor) => multiples(low, high, factor * scale * power)));
    const found = tries.filter(({ length }) => length >= 2 && length <= room).sort((a, b) => b.length - a.length)[0];
    if (found !== undefined) return found;
  }
  const [least, greatest] = [low, high].map((end) => Math.round(end / (0.1 * power)) * 0.1 * power) as [number, number];
  return [least < low ? least + 0.1 * power : least, greatest > high ? greatest - 0.1 * power : greatest];
}

/** As they stand beside an axis, with as many digits as tell them apart. */
export function tickTexts(ticks: number[]): string[] {
  const step = Math.abs((ticks[1] ?? 0) - (ticks[0] ?? 0)), size = Math.max(...ticks.map(Math.abs));
  const count = step > 0 && size > 0 ? Math.min(15, Math.max(4, Math.ceil(Math.log10(size / step)) + 2)) : 4;
  return ticks.map((tick) => `${Number((Math.abs(tick) < 1e-9 * size ? 0 : tick).toPrecision(count))}`.replace("-", "−"));
}
