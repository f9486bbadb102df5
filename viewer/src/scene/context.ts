/** Said while there is no picture. */
export const NO_CONTEXT = "The browser has taken the graphics card away from this page. The picture comes back by itself once it may draw again.";

/** Where the graphics card is taken away from a page and given back, the picture is empty until it is drawn again, also of a run that stands. */
export function watchContext(canvas: Pick<EventTarget, "addEventListener">, lost: () => void, back: () => void): void {
  canvas.addEventListener("webglcontextlost", lost);
  canvas.addEventListener("webglcontextrestored", back);
}
