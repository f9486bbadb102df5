/** Light or dark: as the system has it until somebody chooses. */
export class Theme {
  onChange: (dark: boolean) => void = () => {};
  private readonly system = matchMedia("(prefers-color-scheme: dark)");
  private chosen: boolean | undefined;

  constructor() {
    const kept = localStorage.getItem("surefoot-theme");
    if (kept !== null) this.chosen = kept === "dark";
    this.system.addEventListener("change", () => this.apply());
    this.apply();
  }

  get dark(): boolean {
    return this.chosen ?? this.system.matches;
  }

  toggle(): void {
    this.chosen = !this.dark;
    localStorage.setItem("surefoot-theme", this.chosen ? "dark" : "light");
    this.apply();
  }

  private apply(): void {
    document.documentElement.dataset["theme"] = this.dark ? "dark" : "light";
    this.onChange(this.dark);
  }
}
