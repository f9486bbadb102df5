const KEY = "surefoot-theme";

/** The last choice; a browser that blocks storage throws. */
function kept(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function keep(theme: string): void {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // the next page follows the system
  }
}

/** Light or dark: follows the system until the user chooses. */
export class Theme {
  onChange: (dark: boolean) => void = () => {};
  private readonly system = matchMedia("(prefers-color-scheme: dark)");
  private chosen: boolean | undefined;

  constructor() {
    const before = kept();
    if (before !== null) this.chosen = before === "dark";
    this.system.addEventListener("change", () => this.apply());
    this.apply();
  }

  get dark(): boolean {
    return this.chosen ?? this.system.matches;
  }

  toggle(): void {
    this.chosen = !this.dark;
    keep(this.chosen ? "dark" : "light");
    this.apply();
  }

  private apply(): void {
    document.documentElement.dataset["theme"] = this.dark ? "dark" : "light";
    this.onChange(this.dark);
  }
}
