type Child = FakeElement | string;

/** Attributes that are properties of the same name: those that are there are true, others have their text. */
const FLAGS = ["hidden", "disabled", "draggable", "checked"];
const TEXTS = ["id", "title", "value", "type", "min", "max"];

/** As much of an element as panels need to be made, shown and pressed; it has no looks. */
export class FakeElement extends EventTarget {
  nodes: Child[] = [];
  parent: FakeElement | undefined;
  readonly dataset: Record<string, string> = {};
  readonly style = { setProperty: () => {} };
  readonly classes = new Set<string>();
  readonly classList = {
    add: (name: string) => void this.classes.add(name),
    remove: (name: string) => void this.classes.delete(name),
    contains: (name: string) => this.classes.has(name),
    toggle: (name: string, on = !this.classes.has(name)) => {
      if (on) this.classes.add(name);
      else this.classes.delete(name);
      return on;
    },
  };
  private readonly attributes = new Map<string, string>();

  constructor(readonly localName: string) {
    super();
    for (const name of FLAGS) Object.assign(this, { [name]: false });
    for (const name of TEXTS) Object.assign(this, { [name]: "" });
  }

  setAttribute(name: string, value: string): void {
    this.attributes.set(name, value);
    if (FLAGS.includes(name)) Object.assign(this, { [name]: true });
    if (TEXTS.includes(name)) Object.assign(this, { [name]: value });
    if (name === "class") value.split(" ").forEach((one) => this.classes.add(one));
  }
  getAttribute(name: string): string | null {
    return this.attributes.get(name) ?? null;
  }

  get children(): FakeElement[] {
    return this.nodes.filter((one) => typeof one !== "string");
  }
  get lastElementChild(): FakeElement | undefined {
    return this.children.at(-1);
  }
  get textContent(): string {
    return this.nodes.map((one) => (typeof one === "string" ? one : one.textContent)).join("");
  }
  set textContent(text: string) {
    this.replaceChildren(text);
  }

  append(...nodes: Child[]): void {
    for (const node of nodes) {
      if (node instanceof FakeElement) {
        node.remove();
        node.parent = this;
      }
      this.nodes.push(node);
    }
  }
  replaceChildren(...nodes: Child[]): void {
    for (const child of this.children) child.remove();
    this.nodes = [];
    this.append(...nodes);
  }
  /** What is taken out of a page loses the focus. */
  remove(): void {
    const { parent } = this;
    if (parent === undefined) return;
    parent.nodes = parent.nodes.filter((one) => one !== this);
    this.parent = undefined;
    const { activeElement } = document as unknown as { activeElement: FakeElement | null };
    if (activeElement !== null && this.all().includes(activeElement)) activeElement.blur();
  }

  focus(): void {
    Object.assign(document, { activeElement: this });
  }
  blur(): void {
    Object.assign(document, { activeElement: null });
  }
  contains(other: FakeElement): boolean {
    return this.all().includes(other);
  }
  scrollIntoView(): void {}
  getBoundingClientRect(): { top: number; bottom: number } {
    return { top: 0, bottom: 0 };
  }

  /** It and all in it. */
  all(): FakeElement[] {
    return [this, ...this.children.flatMap((child) => child.all())];
  }
  /** All in it with this text, or with this attribute. */
  find(wanted: { text?: string; attribute?: [name: string, value: string] }): FakeElement {
    const { text, attribute } = wanted;
    const found = this.all().find((one) => (text === undefined || one.textContent === text) && (attribute === undefined || one.getAttribute(attribute[0]) === attribute[1]));
    if (found === undefined) throw new Error(`there is nothing like ${JSON.stringify(wanted)}`);
    return found;
  }
  press(): void {
    this.dispatchEvent(new Event("click"));
  }
  /** It happens here; what holds it hears of that, too. */
  bubble(event: Event): void {
    Object.defineProperty(event, "target", { value: this });
    for (let at: FakeElement | undefined = this; at !== undefined; at = at.parent) at.dispatchEvent(event);
  }
  /** A key is pressed while it has the focus. */
  strike(key: string): void {
    this.bubble(Object.assign(new Event("keydown", { cancelable: true }), { key }));
  }
  /** Somebody types into the field, and is done. */
  enter(text: string): void {
    Object.assign(this, { value: text });
    this.dispatchEvent(new Event("change"));
  }
}

/** Makes a page; its parts by their ids are made when they are asked for. */
export function fakePage(): { root: FakeElement; part: (id: string) => FakeElement } {
  const parts = new Map<string, FakeElement>();
  const part = (id: string): FakeElement => {
    if (!parts.has(id)) parts.set(id, new FakeElement("div"));
    return parts.get(id) as FakeElement;
  };
  const page = Object.assign(new EventTarget(), {
    activeElement: null, body: new FakeElement("body"), getElementById: part, querySelector: () => null,
    createElement: (name: string) => new FakeElement(name), createElementNS: (_: string, name: string) => new FakeElement(name), createTextNode: (text: string) => text,
  });
  Object.defineProperty(globalThis, "document", { value: page, configurable: true });
  return { root: new FakeElement("div"), part };
}
