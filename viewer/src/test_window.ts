import type { App } from "./app.ts";
import { levelStates } from "./data/hierarchy.ts";

type Point = [number, number, number];

/** Shows the state of the page to tests and measurements, as `window.surefoot`. Times are in s, of the run; lengths in m. */
export function expose(app: App): void {
  const { player, world } = app;
  const view = {
    get time() { return player.time; },
    /** Of the picture, as are the channels and the levels. */
    get tick() { return app.frame?.tick ?? -1; },
    /** Times of the first and last frame. */
    get first() { return player.source.first; },
    get last() { return player.source.last; },
    /** Time of the frame in the picture. */
    get drawn() { return world?.drawn ?? NaN; },
    get status() { return app.link?.status; },
    /** Of the session that the page has read. */
    get generation() { return app.session.generation; },
    get playing() { return player.playing; },
    get following() { return player.following; },
    get pictures() { return app.pictures; },
    /** Whether the picture shows all changes so far. */
    get isDrawn() { return world?.isDrawn ?? true; },
    /** Time from the page's beginning to the first picture with a robot [ms]. */
    get firstPicture() { return app.firstPicture; },
    /** Script times of the pictures since the last call [ms]. */
    get costs() { return app.costs.splice(0); },
    get connection() { return app.link?.connection.state ?? "none"; },
    get meshesMissing() { return [...(world?.library.missing.keys() ?? [])]; },
    get meshesLoading() { return world?.library.loading ?? 0; },
    get triangles() { return world?.stage.renderer.info.render.triangles ?? 0; },
    get frameTime() { return world?.stage.quality.frameTime ?? NaN; },
    get quality() { return world?.stage.quality.step ?? -1; },
    /** Whether nothing moves, so that the picture is as fine as it gets here. */
    get atRest() { return world?.stage.quality.resting ?? false; },
    /** Where the camera is, in S. */
    get camera() { return world?.stage.camera.position.toArray() ?? []; },
    /** Place of a point of S in the page [pixels]. */
    place: (p_S: Point) => world?.place(p_S),
    /** Height of the ground in the picture. */
    ground: (x: number, y: number) => world?.groundAt(x, y),
    /** Place of a link's frame in S, as it is drawn. */
    position: (link: string) => world?.positionOf(link),
    channel(name: string) {
      const info = app.frame?.schema.channel(name);
      return info && [...(app.frame?.values.subarray(info.offset, info.offset + info.size) ?? [])];
    },
    levels: () => (app.frame === undefined ? [] : levelStates(app.frame, player.source.explained?.(app.frame.tick))),
    /** Colour of the picture at a point of S: red, green, blue, from 0 to 255. */
    pixel: (p_S: Point) => world?.pixelAt(...world.place(p_S)),
    /** The same at a place of the page [pixels]. */
    pixelAt: (x: number, y: number) => world?.pixelAt(x, y),
  };
  Object.defineProperty(window, "surefoot", { value: Object.freeze(view) });
}
