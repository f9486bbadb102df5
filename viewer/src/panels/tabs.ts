import { h, part } from "./dom.ts";

/** Panels of which one is seen at a time. */
export class Tabs {
  private readonly panels = new Map<string, { tab: HTMLButtonElement; panel: HTMLElement }>();
  private shown = "";
  /** How far each was scrolled when it was left. */
  private readonly scrolled = new Map<string, number>();

  /** An empty panel under a new tab; the first is shown. */
  add(id: string, title: string): HTMLElement {
    const panel = h("div", { class: "panel", role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}`, hidden: this.panels.size > 0 });
    const tab = h("button", { role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`, "aria-selected": String(this.panels.size === 0), onclick: () => this.show(id) }, title);
    this.panels.set(id, { tab, panel });
    part("tabs").append(tab);
    part("panels").append(panel);
    this.shown ||= id;
    return panel;
  }

  show(id: string): void {
    const room = part("panels");
    this.scrolled.set(this.shown, room.scrollTop);
    this.shown = id;
    for (const [name, { tab, panel }] of this.panels) {
      panel.hidden = name !== id;
      tab.setAttribute("aria-selected", String(name === id));
    }
    room.scrollTop = this.scrolled.get(id) ?? 0;
    const tabs = part("tabs").getBoundingClientRect();
    if (room.getBoundingClientRect().top < tabs.bottom - 1) room.scrollIntoView({ block: "start" });  // where the page scrolls and not the panel
  }
}
