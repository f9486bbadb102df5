/** Corners of triangles in the order of the file, not indexed. */
export interface Soup {
  position: Float32Array;
  uv?: Float32Array;
}

export interface Coarse {
  position: Float32Array;
  uv?: Float32Array;
  index: number[];
  /** Beginning and number of corners in `index`, for each group of triangles. */
  ranges: [begin: number, count: number][];
}

/**
 * Reduces triangles: corners within a cell of a grid are merged, and triangles without area are dropped. `cell`: edge length, in the unit of the
 * positions; `ranges`: groups of corners that stay separate.
 */
export function simplify(soup: Soup, cell: number, ranges: [begin: number, count: number][]): Coarse {
  const { position, uv } = soup;
  const ids = new Map<number, number>();
  const sums: number[] = [];
  const counts: number[] = [];
  const uvs: number[] = [];
  const vertexOf = (i: number): number => {
    const [x, y, z] = [position[3 * i] as number, position[3 * i + 1] as number, position[3 * i + 2] as number];
    const key = (Math.round(x / cell) + 5e4) * 1e10 + (Math.round(y / cell) + 5e4) * 1e5 + (Math.round(z / cell) + 5e4);
    let id = ids.get(key);
    if (id === undefined) {
      ids.set(key, (id = counts.length));
      counts.push(0);
      sums.push(0, 0, 0);
      if (uv !== undefined) uvs.push(uv[2 * i] as number, uv[2 * i + 1] as number);
    }
    counts[id] = (counts[id] as number) + 1;
    sums[3 * id] = (sums[3 * id] as number) + x;
    sums[3 * id + 1] = (sums[3 * id + 1] as number) + y;
    sums[3 * id + 2] = (sums[3 * id + 2] as number) + z;
    return id;
  };
  const index: number[] = [];
  const kept: [number, number][] = ranges.map(([begin, count]) => {
    const first = index.length;
    const seen = new Set<string>();
    for (let i = begin; i + 2 < begin + count; i += 3) {
      const [a, b, c] = [vertexOf(i), vertexOf(i + 1), vertexOf(i + 2)];
      if (a === b || b === c || c === a) continue;
      const key = a < b && a < c ? `${a},${b},${c}` : b < c ? `${b},${c},${a}` : `${c},${a},${b}`;
      if (seen.has(key)) continue;
      seen.add(key);
      index.push(a, b, c);
    }
    return [first, index.length - first];
  });
  const mean = Float32Array.from(sums, (sum, i) => sum / (counts[Math.floor(i / 3)] as number));
  return { position: mean, uv: uv && Float32Array.from(uvs), index, ranges: kept };
}
