import * as THREE from "three";
import { spread, type Wanted } from "./label_layout.ts";

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

/** What is pushed comes before what carries, that before lengths of legs, and shares of friction, which colours tell as well, last. */
function rankOf(className: string): number {
  return className === "push" ? 0 : className === "limb" ? 2 : className.startsWith("use ") ? 3 : 1;
}

/** Short texts over the picture, near points of the scene, none over another. Made once, moved without a new layout, and hidden. */
export class Labels {
  private readonly pool: Label[] = [];
  private readonly wanted: Wanted[] = [];
  private width = 0;
  private height = 0;
  private readonly at = new THREE.Vector3();

  constructor(
    private readonly layer: HTMLElement,
    private readonly camera: THREE.Camera,
  ) {}

  /** Of the picture [pixels of the page]. */
  begin(width: number, height: number): void {
    this.wanted.length = 0;
    this.width = width;
    this.height = height;
  }

  /** `p_W`: a point of the scene in W. */
  put(p_W: THREE.Vector3, text: string, className = ""): void {
    this.at.copy(p_W).project(this.camera);
    if (this.at.z > 1 || Math.abs(this.at.x) > 1.05 || Math.abs(this.at.y) > 1.05) return;
    const label = this.next();
    const { element } = label;
    if (label.text !== text) element.textContent = label.text = text;
    if (label.className !== className) element.className = `label ${(label.className = className)}`;
    const x = 0.5 * (1 + this.at.x) * this.width;
    const y = 0.5 * (1 - this.at.y) * this.height;
    this.wanted.push({ x, y, width: LETTER * text.length + PADDING, height: HEIGHT, rank: rankOf(className) });
  }

  end(): void {
    const places = spread(this.wanted);
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
