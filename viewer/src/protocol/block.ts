/** Reads blocks of frames (viewer/README.md). */

const MAGIC = 0x31564653; // "SFV1", little-endian
const BLOCK_HEAD = 16;
const FRAME_HEAD = 16;

export interface BlockHead {
  frames: number;
  dropped: number;
  generation: number;
}

export type FrameSink = (
  tick: number,
  time: number,
  values: Float32Array,
  rows: Uint8Array | undefined,
) => void;

export function readBlockHead(buffer: ArrayBuffer): BlockHead {
  const view = new DataView(buffer);
  if (buffer.byteLength < BLOCK_HEAD || view.getUint32(0, true) !== MAGIC)
    throw new Error("what came is no block of frames: program and page are of different versions, load the page again");
  return {
    frames: view.getUint32(4, true),
    dropped: view.getUint32(8, true),
    generation: view.getUint32(12, true),
  };
}

/** Hands each frame of the block to `sink`; `values` is a view that ends with the block. */
export function readBlock(buffer: ArrayBuffer, frameFloats: number, sink: FrameSink): BlockHead {
  const head = readBlockHead(buffer);
  const view = new DataView(buffer);
  const least = FRAME_HEAD + 4 * frameFloats + 4;
  let at = BLOCK_HEAD;
  for (let k = 0; k < head.frames; ++k) {
    if (at + FRAME_HEAD > buffer.byteLength) throw new Error(`frame ${k} of ${head.frames} is cut off`);
    const bytes = view.getUint32(at, true);
    if (bytes < least || bytes % 8 !== 0 || at + bytes > buffer.byteLength)
      throw new Error(`frame ${k} has ${bytes} bytes, at least ${least} were expected`);
    const rowsAt = at + FRAME_HEAD + 4 * frameFloats;
    sink(
      view.getUint32(at + 4, true),
      view.getFloat64(at + 8, true),
      new Float32Array(buffer, at + FRAME_HEAD, frameFloats),
      copyRows(view, rowsAt, at + bytes),
    );
    at += bytes;
  }
  return head;
}

function copyRows(view: DataView, at: number, end: number): Uint8Array | undefined {
  const size = 8 * (view.getUint16(at, true) + view.getUint16(at + 2, true));
  if (at + 4 + size > end) throw new Error("a frame's list of rows is cut off");
  return size === 0 ? undefined : new Uint8Array(view.buffer.slice(at, at + 4 + size));
}
