import * as THREE from "three";
import { spread, type Corner, type Wanted } from "./label_layout.ts";

interface Label {
  element: HTMLElement;
  text: string;
  className: string;
  place: string;
}

/** Size of a text without asking the browser, which would lay the page out anew [pixels]. */
const LETTER = 8;
const PADDING = 12;
const HEIGHT = 16;

/** What is pushed comes before what carries, that before lengths of legs, what is believed and shares of friction, which colours tell as well. */
function rankOf(className: string): number {
  return className === "push" ? 0 : className.startsWith("limb ") ? 2 : className === "believed" ? 3 : className.startsWith("use ") ? 4 : 1;
}

/** Forces whose arrows end beyond the picture have their numbers at its edge: half of its width or height further, at most. All else has its text where
 * its point is, or none. */
const BEYOND = 2;
export const reachOf = (className: string): number => (className === "push" || className.startsWith("leg") ? BEYOND : 1);

/** Over the picture, with a little around them [pixels]. */
const AROUND_BUTTONS = 8;

/** Short texts over the picture, near points of the scene, none over another. Made once, moved without a new layout, and hidden. */
export class Labels {
  private readonly pool: Label[] = [];
  private readonly wanted: Wanted[] = [];
  private width = 0;
  private height = 0;
  private readonly at = new THREE.Vector3();
  private corner: Corner = { width: 0, height: 0 };

  /** `buttons`: that lie in the upper left corner of the picture. */
  constructor(
    private readonly layer: HTMLElement,
    buttons: HTMLElement,
    private readonly camera: THREE.Camera,
  ) {
    new ResizeObserver(() => {
      const { offsetLeft, offsetTop, offsetWidth, offsetHeight } = buttons;
      this.corner = { width: offsetLeft + offsetWidth + AROUND_BUTTONS, height: offsetTop + offsetHeight + AROUND_BUTTONS };
    }).observe(buttons);
  }

  /** Of the picture [pixels of the page]. */
  begin(width: number, height: number): void {
    this.wanted.length = 0;
    this.width = width;
    this.height = height;
  }

  /** `p_W`: a point of the scene in W. */
  put(p_W: THREE.Vector3, text: string, className = ""): void {
    this.at.copy(p_W).project(this.camera);
    const rank = rankOf(className), reach = reachOf(className);
    if (this.at.z > 1 || Math.abs(this.at.x) > reach || Math.abs(this.at.y) > reach) return;
    const label = this.next();
    const { element } = label;
    if (label.text !== text) element.textContent = label.text = text;
    if (label.className !== className) element.className = `label ${(label.className = className)}`;
    const x = 0.5 * (1 + this.at.x) * this.width;
    const y = 0.5 * (1 - this.at.y) * this.height;
    this.wanted.push({ x, y, width: LETTER * text.length + PADDING, height: HEIGHT, rank });
  }

  end(): void {
    const places = spread(this.wanted, this.width, this.height, this.corner);
    this.pool.forEach((label, k) => {
      const place = places[k];
      if (label.element.hidden !== (place === undefined)) label.element.hidden = place === undefined;
      if (place === undefined) return;
      const transform = `translate(${place[0].toFixed(1)}px, ${place[1].toFixed(1)}px) translate(-50%, -50%)`;
      if (label.place !== transform) label.element.style.transform = label.place = transform;
    });
  }

  private next(): Label {
    const known = this.pool[this.wanted.length];
    if (known !== undefined) return known;
    const label = { element: document.createElement("span"), text: "", className: "none", place: "" };
    this.layer.append(label.element);
    this.pool.push(label);
    return label;
  }
}
