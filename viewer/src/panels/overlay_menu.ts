import type { World } from "../scene/world.ts";
import { css } from "../scene/palette.ts";
import { h, part } from "./dom.ts";

export const KEYS = "1234567890-=";

/** Overlays of one colour, named as in the palette. */
const MARKS = ["support", "com", "zmp", "push", "plane", "ghost"] as const;
type Mark = (typeof MARKS)[number];
const isMark = (id: string): id is Mark => (MARKS as readonly string[]).includes(id);

/** The menu of overlays, and the legend. */
export class OverlayMenu {
  private readonly boxes = new Map<string, HTMLInputElement>();
  private readonly ghost: HTMLInputElement;
  private readonly swatches = new Map<Mark, HTMLElement>();

  /** `legs`: their names. */
  constructor(private readonly world: World, private readonly legs: string[]) {
    const menu = part("overlays");
    const open = part<HTMLButtonElement>("overlays-open");
    // Over the whole page, so that a low picture does not cut it off.
    menu.addEventListener("beforetoggle", () => {
      menu.style.left = `${part("view").getBoundingClientRect().left + 8}px`;
      menu.style.setProperty("--top", `${open.getBoundingClientRect().bottom + 6}px`);
      menu.style.setProperty("--below", `${innerHeight - part("transport").getBoundingClientRect().top + 6}px`);
    });
    menu.addEventListener("toggle", (event) => open.setAttribute("aria-expanded", String(event.newState === "open")));
    world.overlays.switches.forEach(({ id, name, about, on }, k) => {
      const box = h("input", { type: "checkbox", checked: on, "data-overlay": id, onchange: () => this.toggle(id) });
      this.boxes.set(id, box);
      menu.append(this.line(box, name, about, KEYS[k] ?? ""));
    });
    this.ghost = h("input", { type: "checkbox", "data-overlay": "ghost", onchange: () => (world.ghostShown = this.ghost.checked) });
    menu.append(this.line(this.ghost, "Estimator's ghost", "where the controller believes to be, counted from the start", "o"));
    this.legend();
  }

  private line(box: HTMLInputElement, name: string, about: string, key: string): HTMLElement {
    const id = box.dataset["overlay"] ?? "";
    const swatch = h("i", { class: isMark(id) ? "overlay-colour" : "overlay-colour none" });
    if (isMark(id)) this.swatches.set(id, swatch);
    return h("label", { class: "overlay-line", title: about }, box, swatch, h("span", {}, h("b", {}, name), h("small", {}, about)), h("kbd", {}, key));
  }

  private toggle(id: string): void {
    this.world.overlays.toggle(id);
    this.world.invalidate();
  }

  /** Toggles an overlay by its key; false where the key has none. */
  toggleByKey(key: string): boolean {
    const entry = this.world.overlays.switches[KEYS.indexOf(key)];
    if (!KEYS.includes(key) || entry === undefined) return false;
    this.toggle(entry.id);
    (this.boxes.get(entry.id) as HTMLInputElement).checked = entry.on;
    return true;
  }

  toggleGhost(): void {
    this.ghost.checked = this.world.ghostShown = !this.world.ghostShown;
  }

  /** Updates the colours of menu and legend. */
  legend(): void {
    const { legs: colours, margin } = this.world.palette;
    for (const [mark, swatch] of this.swatches) swatch.style.background = css(this.world.palette[mark]);
    const entry = (colour: number, text: string, shape = ""): HTMLElement => {
      const swatch = h("i", { class: shape });
      swatch.style.background = css(colour);
      return h("span", {}, swatch, text);
    };
    part("legend").replaceChildren(
      h("span", { class: "legend-group", "data-legend": "legs" }, h("b", {}, "Legs"), ...this.legs.map((leg, k) => entry(colours[k] as number, leg))),
      h("span", { class: "legend-group", "data-legend": "friction" }, h("b", {}, "Share of the pyramid used"),
        entry(margin.good, "< 60 %", "pyramid"), entry(margin.near, "60 – 90 %", "pyramid"), entry(margin.bad, "> 90 %", "pyramid")),
    );
  }
}
