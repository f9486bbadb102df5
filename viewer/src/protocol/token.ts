/** The key of this start, from the link's fragment `#token=…`; it is not sent with any request of a page. */
export function tokenOf(hash: string): string {
  return new URLSearchParams(hash.slice(1)).get("token") ?? "";
}

type Page = Pick<Window, "addEventListener"> & { location: Pick<Location, "hash" | "reload"> };

/** Loads the page again once its link has another token: where only the fragment of an address changes, a browser doesn't. */
export function followToken(page: Page): void {
  const token = tokenOf(page.location.hash);
  page.addEventListener("hashchange", () => {
    if (tokenOf(page.location.hash) !== token) page.location.reload();
  });
}
