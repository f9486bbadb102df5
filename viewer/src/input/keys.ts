/** Keys that repeat while they are held; all others act once a press. */
const GO_ON = new Set([",", ".", "[", "]", "ArrowLeft", "ArrowRight", "w", "s", "a", "d", "q", "e", "PageUp", "PageDown"]);
/** Keys that move a slider. */
const SLIDER_KEYS = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "PageUp", "PageDown", "Home", "End"]);
/** The time slider: its arrows move the time in the page's own steps. */
const TIME_SLIDER = "scrub";

/** Keys that move between tabs. */
const TAB_KEYS = new Set(["ArrowLeft", "ArrowRight", "Home", "End"]);

/** Whether the focused element needs the key itself. */
export function keeps(focused: Pick<Element, "localName" | "id" | "getAttribute">, key: string): boolean {
  const { localName, id } = focused;
  if (localName === "input") {
    const type = focused.getAttribute("type");
    if (type === "checkbox") return key === " ";
    if (type !== "range") return true;
    return SLIDER_KEYS.has(key) && !(id === TIME_SLIDER && key.startsWith("Arrow"));
  }
  if (localName === "select" || localName === "textarea") return true;
  const isTab = focused.getAttribute("role") === "tab";
  if (isTab && TAB_KEYS.has(key)) return true;
  return key === " " && (localName === "button" || localName === "summary" || isTab);
}

/** Whether the key is the browser's or the system's. AltGr, which some keyboards need for brackets, reports Ctrl and Alt too. */
function isForOthers(event: KeyboardEvent): boolean {
  return event.metaKey || ((event.ctrlKey || event.altKey) && !event.getModifierState("AltGraph"));
}

/** Name of a key: a digit with shift, whatever the keyboard makes of it, is `shift+1`. */
function keyOf({ key, code, shiftKey }: KeyboardEvent): string {
  if (shiftKey && /^Digit\d$/.test(code ?? "")) return `shift+${code.slice(-1)}`;
  return key.length === 1 ? key.toLowerCase() : key;
}

export type KeyActions = Record<string, (event: KeyboardEvent) => void>;

/** Calls the action of a key. Keys for a field or slider are left to it; Escape leaves a search. */
export function listenToKeys(actions: KeyActions): void {
  let byPointer = false;
  document.addEventListener("pointerdown", () => (byPointer = true), { capture: true });
  document.addEventListener("keydown", (event) => {
    byPointer = false;
    if (isForOthers(event)) return;
    const target = event.target as HTMLElement;
    if (event.key === "Escape" && target.matches("input[type=search]")) target.blur();
    if (keeps(target, event.key) || (document.querySelector("dialog[open]") !== null && event.key !== "?")) return;
    const key = keyOf(event);
    const action = actions[key];
    if (action === undefined) return;
    event.preventDefault();
    if (!event.repeat || GO_ON.has(key)) action(event);
  });
  // An element pressed with a pointer gives up the focus, and with it its keys.
  const leave = (event: Event, what: string): void => {
    if (byPointer) (event.target as HTMLElement).closest<HTMLElement>(what)?.blur();
  };
  document.addEventListener("click", (event) => leave(event, "button, summary, [role=tab], input[type=checkbox]"));
  document.addEventListener("change", (event) => leave(event, "select"));
}
