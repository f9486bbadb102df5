import { h, part } from "./dom.ts";

interface Page {
  tab: HTMLButtonElement;
  panel: HTMLElement;
  /** Scroll position when it was left. */
  scrolled: number;
}

/** Tab to which a key leads from `place`; undefined: not a key of tabs. */
function placeAfter(key: string, place: number, count: number): number | undefined {
  const places: Record<string, number> = { ArrowRight: (place + 1) % count, ArrowLeft: (place + count - 1) % count, Home: 0, End: count - 1 };
  return places[key];
}

/** Panels, one visible at a time. The tab key focuses its tab, arrows move to others. */
export class Tabs {
  private readonly pages: Page[] = [];
  private shown: Page | undefined;

  constructor() {
    part("tabs").addEventListener("keydown", (event) => this.press(event));
  }

  /** Adds an empty panel under a new tab; the first is shown. */
  add(id: string, title: string): HTMLElement {
    const panel = h("div", { class: "panel", role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}`, hidden: true });
    const tab = h("button", { role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`, onclick: () => this.show(page) }, title);
    const page: Page = { tab, panel, scrolled: 0 };
    this.pages.push(page);
    part("tabs").append(tab);
    part("panels").append(panel);
    this.shown ??= page;
    this.mark();
    return panel;
  }

  /** Shows the chosen panel. */
  private mark(): void {
    for (const page of this.pages) {
      const isShown = page === this.shown;
      page.panel.hidden = !isShown;
      page.tab.setAttribute("aria-selected", String(isShown));
      page.tab.setAttribute("tabindex", isShown ? "0" : "-1");
    }
  }

  private press(event: KeyboardEvent): void {
    const place = this.pages.findIndex(({ tab }) => tab === event.target);
    const next = this.pages[placeAfter(event.key, place, this.pages.length) ?? -1];
    if (place < 0 || next === undefined || event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    this.show(next);
    next.tab.focus();
  }

  private show(page: Page): void {
    const room = part("panels");
    if (this.shown !== undefined) this.shown.scrolled = room.scrollTop;
    this.shown = page;
    this.mark();
    room.scrollTop = page.scrolled;
    const tabs = part("tabs").getBoundingClientRect();
    if (room.getBoundingClientRect().top < tabs.bottom - 1) room.scrollIntoView({ block: "start" }); // where the page scrolls and not the panel
  }
}
