/** Calls by key; keys that are typed into a field are left alone, but Escape leaves a search. */
export function listenToKeys(actions: Record<string, (event: KeyboardEvent) => void>): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    const typing = target.matches("input:not([type=range]):not([type=checkbox]), select, textarea");
    if (event.key === "Escape" && target.matches("input[type=search]")) target.blur();
    const pressing = event.key === " " && target.matches("button, summary, [role=tab]");
    if (typing || pressing || document.querySelector("dialog[open]") !== null && event.key !== "?") return;
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (action === undefined) return;
    event.preventDefault();
    action(event);
  });
  // A button that was clicked with a pointer does not keep the space bar for itself.
  document.addEventListener("click", (event) => {
    const button = (event.target as HTMLElement).closest<HTMLElement>("button, summary, [role=tab]");
    if (event.detail > 0) button?.blur();
  });
}
