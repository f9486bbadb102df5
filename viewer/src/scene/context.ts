/** Message while there is no picture. */
export const NO_CONTEXT = "The browser has taken the graphics card away from this page. The picture comes back by itself once it may draw again.";

/** Calls when the browser takes the graphics context away and gives it back; the picture must then be drawn again. */
export function watchContext(canvas: Pick<EventTarget, "addEventListener">, lost: () => void, back: () => void): void {
  canvas.addEventListener("webglcontextlost", lost);
  canvas.addEventListener("webglcontextrestored", back);
}
