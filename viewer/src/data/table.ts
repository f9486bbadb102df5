import type { ActiveRow, BlockingRow, Frame } from "./frame.ts";
import type { Schema } from "./schema.ts";

/** Consecutive frames in typed arrays, appended up to a fixed capacity. */
export class FrameTable {
  readonly times: Float64Array;
  readonly ticks: Uint32Array;
  readonly values: Float32Array;
  private readonly rows: (Uint8Array | undefined)[];
  size = 0;

  constructor(
    public schema: Schema,
    readonly capacity: number,
  ) {
    this.times = new Float64Array(capacity);
    this.ticks = new Uint32Array(capacity);
    this.values = new Float32Array(capacity * schema.frameFloats);
    this.rows = new Array<Uint8Array | undefined>(capacity);
  }

  get full(): boolean {
    return this.size === this.capacity;
  }
  get first(): number {
    return this.times[0] ?? NaN;
  }
  get last(): number {
    return this.times[this.size - 1] ?? NaN;
  }

  /** `rows` holds counts and entries of active and blocking rows as in a block. */
  append(tick: number, time: number, values: Float32Array, rows: Uint8Array | undefined): void {
    const i = this.size++;
    this.ticks[i] = tick;
    this.times[i] = time;
    this.values.set(values, i * this.schema.frameFloats);
    this.rows[i] = rows;
  }

  /** Index of the last frame at or before `time`; 0 where all are later. */
  indexAt(time: number): number {
    let low = 0;
    let high = this.size;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.times[middle] as number) <= time) low = middle + 1;
      else high = middle;
    }
    return Math.max(0, low - 1);
  }

  frame(i: number): Frame {
    const n = this.schema.frameFloats;
    const values = this.values.subarray(i * n, (i + 1) * n);
    return new TableFrame(this.schema, this.ticks[i] as number, this.times[i] as number, values, this.rows[i]);
  }

  value(i: number, offset: number): number {
    return this.values[i * this.schema.frameFloats + offset] as number;
  }

  /** Whether any number of the frame is known; a log's summary has none for damaged stretches. */
  knows(i: number): boolean {
    for (let offset = 0; offset < this.schema.frameFloats; ++offset) if (!Number.isNaN(this.value(i, offset))) return true;
    return false;
  }

  /** Empties it, for another schema of the same size. */
  reuse(schema: Schema): void {
    this.schema = schema;
    this.size = 0;
  }
}

/** Rows are unpacked on demand: most frames are read for their numbers only. */
class TableFrame implements Frame {
  private unpacked: Pick<Frame, "active" | "blocking"> | undefined;

  constructor(
    readonly schema: Schema,
    readonly tick: number,
    readonly time: number,
    readonly values: Float32Array,
    private readonly rows: Uint8Array | undefined,
  ) {}

  get active(): ActiveRow[] {
    return (this.unpacked ??= unpackRows(this.rows)).active;
  }
  get blocking(): BlockingRow[] {
    return (this.unpacked ??= unpackRows(this.rows)).blocking;
  }
}

/** Unpacks rows as they stand in a block. */
function unpackRows(rows: Uint8Array | undefined): { active: ActiveRow[]; blocking: BlockingRow[] } {
  const active: ActiveRow[] = [];
  const blocking: BlockingRow[] = [];
  if (rows === undefined) return { active, blocking };
  const view = new DataView(rows.buffer, rows.byteOffset, rows.byteLength);
  const actives = view.getUint16(0, true);
  const blockings = view.getUint16(2, true);
  let at = 4;
  for (let k = 0; k < actives; ++k, at += 8)
    active.push({
      level: view.getUint8(at),
      state: view.getInt8(at + 1),
      row: view.getUint16(at + 2, true),
      by: view.getFloat32(at + 4, true),
    });
  for (let k = 0; k < blockings; ++k, at += 8)
    blocking.push({
      level: view.getUint8(at),
      by: view.getUint8(at + 1),
      row: view.getUint16(at + 2, true),
      cost: view.getFloat32(at + 4, true),
    });
  return { active, blocking };
}
