/** The token of this start, from the link's fragment `#token=…`, which browsers do not send. */
export function tokenOf(hash: string): string {
  return new URLSearchParams(hash.slice(1)).get("token") ?? "";
}

type Page = Pick<Window, "addEventListener"> & { location: Pick<Location, "hash" | "reload"> };

/** Reloads the page when its link gets another token: a browser does not, where only the fragment changes. */
export function followToken(page: Page): void {
  const token = tokenOf(page.location.hash);
  page.addEventListener("hashchange", () => {
    if (tokenOf(page.location.hash) !== token) page.location.reload();
  });
}
