import { pause } from "../protocol/ask.ts";
import { readBlock } from "../protocol/block.ts";
import type { Schema } from "./schema.ts";
import { FrameTable } from "./table.ts";

/** Frames that one request asks for. */
export const TILE_FRAMES = 512;

/** A tile of the log: `TILE_FRAMES` frames of every `stride`th tick, or least and greatest of each stride. */
export interface TileKey {
  stride: number;
  index: number;
  minMax: boolean;
}

export type FetchBlock = (url: string) => Promise<ArrayBuffer>;

/** A cache of tiles that drops the least recently used; requests a few at a time. */
export class TileCache {
  private readonly tiles = new Map<string, FrameTable>();
  private readonly wanted = new Map<string, TileKey>();
  private readonly running = new Set<string>();
  /** Requested before they were fully summarised. */
  private readonly unfinished = new Set<string>();
  /** More is known by now: kept until the new answer arrives. */
  private readonly stale = new Set<string>();
  private readonly capacity: number;
  /** Summarised ticks from the first on; long strides are answered from the summary. */
  summarised = Infinity;
  /** Called when a tile arrived. */
  onTile: () => void = () => {};
  onError: (error: Error) => void = () => {};

  constructor(
    private readonly schema: Schema,
    bytes: number,
    private readonly fetchBlock: FetchBlock,
    private readonly firstTick: number,
    private readonly mostRunning = 3,
  ) {
    this.capacity = Math.max(8, Math.floor(bytes / (TILE_FRAMES * (4 * schema.frameFloats + 16))));
  }

  /** Ticks that a tile spans. */
  static span(key: TileKey): number {
    return key.minMax ? (TILE_FRAMES / 2) * key.stride : TILE_FRAMES * key.stride;
  }

  /** The tile if it is here. A missing or stale tile is requested. */
  get(key: TileKey): FrameTable | undefined {
    const name = `${key.stride}:${key.index}:${key.minMax}`;
    const tile = this.tiles.get(name);
    if (tile !== undefined) {
      this.tiles.delete(name); // the most recently used is last
      this.tiles.set(name, tile);
    }
    if ((tile === undefined || this.stale.has(name)) && !this.running.has(name)) {
      this.wanted.delete(name);
      this.wanted.set(name, key);
      this.pump();
    }
    return tile;
  }

  /** More is summarised: unfinished tiles become stale, also those on their way. */
  renewUnfinished(): void {
    for (const name of this.unfinished) this.stale.add(name);
    this.unfinished.clear();
  }

  get pending(): number {
    return this.running.size + this.wanted.size;
  }

  private pump(): void {
    while (this.running.size < this.mostRunning && this.wanted.size > 0) {
      const [name, key] = [...this.wanted].at(-1) as [string, TileKey]; // the latest request matters most
      this.wanted.delete(name);
      this.running.add(name);
      void this.load(name, key);
    }
    while (this.wanted.size > 24) this.wanted.delete(this.wanted.keys().next().value as string);
  }

  private async load(name: string, key: TileKey): Promise<void> {
    const from = this.firstTick + key.index * TileCache.span(key);
    const query = `from=${from}&count=${TILE_FRAMES}&stride=${key.stride}${key.minMax ? "&min_max=1" : ""}`;
    const end = (key.index + 1) * TileCache.span(key);
    this.stale.delete(name);
    if (key.stride > 1 && end > this.summarised) this.unfinished.add(name);
    try {
      const block = await this.fetchBlock(`/api/frames?${query}`);
      const tile = new FrameTable(this.schema, TILE_FRAMES);
      readBlock(block, this.schema.frameFloats, (tick, time, values, rows) => {
        if (!tile.full) tile.append(tick, time, values, rows);
      });
      this.keep(name, tile);
      this.onTile();
    } catch (error) {
      this.stale.add(name);
      this.onError(error as Error);
      await pause(1000); // requested again, but not at once
    }
    this.running.delete(name);
    this.pump();
  }

  private keep(name: string, tile: FrameTable): void {
    this.tiles.set(name, tile);
    while (this.tiles.size > this.capacity) this.tiles.delete(this.tiles.keys().next().value as string);
  }
}
