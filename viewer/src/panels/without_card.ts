import { h, part } from "./dom.ts";

/** What to do where the processor draws; `port`: of the program on this machine. */
export function withoutCardText(host: string, port: string): [what: string, todo: string] {
  const isHere = ["127.0.0.1", "localhost", "[::1]"].includes(host);
  const forward = isHere ? `, after ssh -L ${port}:127.0.0.1:${port} THIS_MACHINE there` : "";
  return [
    "The processor draws here, not a graphics card: pictures are few and coarse.",
    `Switch on hardware acceleration in the browser's settings, or open this link on a machine with a graphics card${forward}.`,
  ];
}

/** Says it under the picture, until it has been read. */
export function tellWithoutCard(): void {
  const line = part("without-card");
  const [what, todo] = withoutCardText(location.hostname, location.port);
  const close = h("button", { class: "small close", "aria-label": "take this message away", onclick: () => (line.hidden = true) }, "×");
  line.replaceChildren(h("span", {}, `${what} `, h("span", { class: "todo" }, todo)), close);
  line.hidden = false;
}
