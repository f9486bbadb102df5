import type { App } from "./app.ts";
import type { Status } from "./protocol/connection.ts";
import { levelStates, type LevelState } from "./data/hierarchy.ts";

/** What tests and measurements may look at: the state of the page. */
export interface SurefootWindow {
  readonly time: number;
  /** Of the picture, as are the channels and the levels. */
  readonly tick: number;
  /** Times of the first and last frame there is [s]. */
  readonly first: number;
  readonly last: number;
  /** Time of the frame that is drawn [s]. */
  readonly drawn: number;
  readonly status: Status | undefined;
  /** Of the session that the page has read. */
  readonly generation: number;
  readonly playing: boolean;
  readonly following: boolean;
  readonly pictures: number;
  /** Whether the picture is as all that has changed it, as its colours. */
  readonly isDrawn: boolean;
  /** Time from the page's beginning to the first picture with a robot [ms]. */
  readonly firstPicture: number;
  /** Script times of the frames since this was read last [ms]. */
  readonly costs: number[];
  readonly connection: string;
  readonly meshesMissing: string[];
  readonly meshesLoading: number;
  readonly triangles: number;
  readonly frameTime: number;
  readonly quality: number;
  /** Whether nothing moves, so that the picture is as fine as it gets here. */
  readonly atRest: boolean;
  /** Where the camera is, in W [m]. */
  readonly camera: number[];
  /** Place of a point of W in the page [pixels]. */
  place(p_W: [number, number, number]): number[] | undefined;
  /** Height of the ground as it is drawn [m]. */
  ground(x: number, y: number): number | undefined;
  /** Place of a link's frame in W, as it is drawn [m]. */
  position(link: string): number[] | undefined;
  channel(name: string): number[] | undefined;
  levels(): LevelState[];
  /** Draws all overlays as often as for this many robots. */
  repeatOverlays(robots: number): void;
  /** Colour of the picture where a point of W is in it: red, green, blue, from 0 to 255. */
  pixel(p_W: [number, number, number]): number[] | undefined;
  /** The same at a place of the page [pixels]. */
  pixelAt(x: number, y: number): number[] | undefined;
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
    get drawn() {
      return app.world?.drawn ?? NaN;
    },
    get generation() {
      return app.session.generation;
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
    get isDrawn() {
      return app.world?.isDrawn ?? true;
    },
    get firstPicture() {
      return app.firstPicture;
    },
    get costs() {
      const costs = app.costs.values;
      app.costs.clear();
      return costs;
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
    get atRest() {
      return app.world?.stage.quality.resting ?? false;
    },
    get camera() {
      return app.world?.stage.camera.position.toArray() ?? [];
    },
    place: (p_W) => app.world?.place(p_W),
    ground: (x, y) => app.world?.groundAt(x, y),
    position: (link) => app.world?.positionOf(link),
    channel(name) {
      const info = app.frame?.schema.channel(name);
      return info && [...(app.frame?.values.subarray(info.offset, info.offset + info.size) ?? [])];
    },
    levels: () => (app.frame === undefined ? [] : levelStates(app.frame, app.player.source.explained?.(app.frame.tick))),
    repeatOverlays: (robots) => app.world?.repeatOverlays(robots),
    pixel: (p_W) => app.world?.pixel(p_W),
    pixelAt: (x, y) => app.world?.pixelAt(x, y),
  };
  Object.defineProperty(window, "surefoot", { value: Object.freeze(view) });
}
