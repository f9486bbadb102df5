import * as THREE from "three";
import { leaderOf, spread, type Box, type Leader, type Wanted } from "./label_layout.ts";

interface Label {
  element: HTMLElement;
  words: Text;
  /** The line to its point. */
  line: HTMLElement;
  text: string;
  className: string;
  place: string;
  leader: string;
}

/** Estimated size of a text; measuring would force a layout [pixels]. */
const LETTER = 8;
const PADDING = 12;
const HEIGHT = 16;

/** Order of placing: pushes, ground forces, leg lengths, estimates, and friction use, which colours show as well. */
function rankOf(className: string): number {
  return className === "push" ? 0 : className.startsWith("limb ") ? 2 : className === "believed" ? 3 : className.startsWith("use ") ? 4 : 1;
}

/** Labels of forces whose arrows leave the picture stand at its edge, if they end within half its width or height of it. Others vanish. */
const BEYOND = 2;
export const reachOf = (className: string): number => (className === "push" || className.startsWith("leg") ? BEYOND : 1);

/** Margin around elements over the picture [pixels]. */
const AROUND = 8;

/** Bounding box of points in S, in a picture of this size; undefined where all are behind the camera. */
export function boxOf(points_S: THREE.Vector3[], camera: THREE.Camera, width: number, height: number): Box | undefined {
  const seen = points_S.map((p_S) => p_S.clone().project(camera)).filter(({ z }) => z <= 1);
  if (seen.length === 0) return undefined;
  const x = seen.map((at) => 0.5 * (1 + at.x) * width), y = seen.map((at) => 0.5 * (1 - at.y) * height);
  return { left: Math.min(...x), right: Math.max(...x), top: Math.min(...y), bottom: Math.max(...y) };
}

/** Short texts near points of the scene that do not overlap. Elements are reused and moved without a layout. */
export class Labels {
  private readonly pool: Label[] = [];
  private readonly wanted: Wanted[] = [];
  private width = 0;
  private height = 0;
  private readonly at = new THREE.Vector3();
  private covers: Box[] = [];
  private readonly marks: Box[] = [];

  /** `over`: elements over the picture at its upper edge. */
  constructor(
    private readonly layer: HTMLElement,
    over: Element[],
    private readonly camera: THREE.Camera,
  ) {
    const look = (): void => void (this.covers = over.flatMap((one) => this.coverOf(one)));
    const observer = new ResizeObserver(look);
    for (const one of [layer, ...over]) observer.observe(one);
  }

  /** The part of the picture that an element covers, if any. */
  private coverOf(one: Element): Box[] {
    const picture = this.layer.getBoundingClientRect(), box = one.getBoundingClientRect();
    if (box.height === 0 || box.top > picture.top + 0.5 * picture.height) return [];
    const [left, top, right, bottom] = [box.left - picture.left - AROUND, box.top - picture.top, box.right - picture.left + AROUND, box.bottom - picture.top + AROUND];
    return [{ left, top, right, bottom }];
  }

  /** `width`, `height`: of the picture [pixels of the page]. */
  begin(width: number, height: number): void {
    this.wanted.length = this.marks.length = 0;
    this.width = width;
    this.height = height;
  }

  /** Texts should leave the box of these points of S free. */
  spare(points_S: THREE.Vector3[]): void {
    const box = boxOf(points_S, this.camera, this.width, this.height);
    if (box !== undefined) this.marks.push(box);
  }

  /** `p_S`: a point of the scene in S; `under`: the text stands below it rather than above. */
  put(p_S: THREE.Vector3, text: string, className = "", under = false): void {
    this.at.copy(p_S).project(this.camera);
    const rank = rankOf(className), reach = reachOf(className);
    if (this.at.z > 1 || Math.abs(this.at.x) > reach || Math.abs(this.at.y) > reach) return;
    const label = this.next();
    const { element } = label;
    if (label.text !== text) label.words.data = label.text = text;
    if (label.className !== className) element.className = `label ${(label.className = className)}`;
    const x = 0.5 * (1 + this.at.x) * this.width;
    const y = 0.5 * (1 - this.at.y) * this.height;
    this.wanted.push({ x, y, width: LETTER * text.length + PADDING, height: HEIGHT, rank, under });
  }

  end(): void {
    const places = spread(this.wanted, this.width, this.height, this.covers, this.marks);
    this.pool.forEach((label, k) => {
      const place = places[k];
      if (label.element.hidden !== (place === undefined)) label.element.hidden = place === undefined;
      if (place === undefined) return;
      const transform = `translate(${place[0].toFixed(1)}px, ${place[1].toFixed(1)}px) translate(-50%, -50%)`;
      if (label.place !== transform) label.element.style.transform = label.place = transform;
      this.lead(label, leaderOf(this.wanted[k] as Wanted, place));
    });
  }

  /** Draws the line from a text to its point. */
  private lead(label: Label, leader: Leader | undefined): void {
    if (label.line.hidden !== (leader === undefined)) label.line.hidden = leader === undefined;
    if (leader === undefined) return;
    const { x, y, length, angle } = leader;
    const transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) rotate(${angle.toFixed(3)}rad) scaleX(${length.toFixed(1)})`;
    if (label.leader !== transform) label.line.style.transform = label.leader = transform;
  }

  private next(): Label {
    const known = this.pool[this.wanted.length];
    if (known !== undefined) return known;
    const label = { element: document.createElement("span"), words: new Text(), line: document.createElement("i"), text: "", className: "none", place: "", leader: "" };
    label.element.append(label.line, label.words);
    this.layer.append(label.element);
    this.pool.push(label);
    return label;
  }
}
