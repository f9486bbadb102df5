import type { App } from "./app.ts";
import type { Status } from "./protocol/connection.ts";
import { levelStates, type LevelState } from "./data/hierarchy.ts";

/** What tests may look at: the state of the page, read-only. */
export interface SurefootWindow {
  readonly time: number;
  readonly tick: number;
  /** Times of the first and last frame there is [s]. */
  readonly first: number;
  readonly last: number;
  readonly status: Status | undefined;
  readonly playing: boolean;
  readonly following: boolean;
  readonly pictures: number;
  readonly connection: string;
  readonly meshesMissing: string[];
  readonly meshesLoading: number;
  readonly triangles: number;
  readonly frameTime: number;
  readonly quality: number;
  /** Place of a link's frame in W, as it is drawn [m]. */
  position(link: string): number[] | undefined;
  channel(name: string): number[] | undefined;
  levels(): LevelState[];
  /** Colour of the picture where a point of W is in it: red, green, blue, from 0 to 255. */
  pixel(p_W: [number, number, number]): number[] | undefined;
}

export function expose(app: App): void {
  const view: SurefootWindow = {
    get time() {
      return app.player.time;
    },
    get tick() {
      return app.frame?.tick ?? -1;
    },
    get first() {
      return app.player.source.first;
    },
    get last() {
      return app.player.source.last;
    },
    get status() {
      return app.link?.status;
    },
    get playing() {
      return app.player.playing;
    },
    get following() {
      return app.player.following;
    },
    get pictures() {
      return app.pictures;
    },
    get connection() {
      return app.link?.connection.state ?? "none";
    },
    get meshesMissing() {
      return [...(app.world?.library.missing.keys() ?? [])];
    },
    get meshesLoading() {
      return app.world?.library.loading ?? 0;
    },
    get triangles() {
      return app.world?.stage.renderer.info.render.triangles ?? 0;
    },
    get frameTime() {
      return app.world?.stage.quality.frameTime ?? NaN;
    },
    get quality() {
      return app.world?.stage.quality.step ?? -1;
    },
    position: (link) => app.world?.positionOf(link),
    channel(name) {
      const info = app.frame?.schema.channel(name);
      return info && [...(app.frame?.values.subarray(info.offset, info.offset + info.size) ?? [])];
    },
    levels: () => (app.frame === undefined ? [] : levelStates(app.frame)),
    pixel: (p_W) => app.world?.pixel(p_W),
  };
  Object.defineProperty(window, "surefoot", { value: Object.freeze(view) });
}
