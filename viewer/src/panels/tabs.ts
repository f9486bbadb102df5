import { h, part } from "./dom.ts";

/** Panels of which one is seen at a time. */
export class Tabs {
  private readonly panels = new Map<string, { tab: HTMLButtonElement; panel: HTMLElement }>();

  /** An empty panel under a new tab; the first is shown. */
  add(id: string, title: string): HTMLElement {
    const panel = h("div", { class: "panel", role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}`, hidden: this.panels.size > 0 });
    const tab = h("button", { role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`, "aria-selected": String(this.panels.size === 0), onclick: () => this.show(id) }, title);
    this.panels.set(id, { tab, panel });
    part("tabs").append(tab);
    part("panels").append(panel);
    return panel;
  }

  show(id: string): void {
    for (const [name, { tab, panel }] of this.panels) {
      panel.hidden = name !== id;
      tab.setAttribute("aria-selected", String(name === id));
    }
  }
}
