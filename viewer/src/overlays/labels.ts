import * as THREE from "three";

interface Label {
  element: HTMLElement;
  text: string;
  className: string;
  place: string;
}

/** Short texts over the picture, at points of the scene. Made once, moved without a new layout, and hidden. */
export class Labels {
  private readonly pool: Label[] = [];
  private used = 0;
  private width = 0;
  private height = 0;
  private readonly at = new THREE.Vector3();

  constructor(
    private readonly layer: HTMLElement,
    private readonly camera: THREE.Camera,
  ) {}

  /** Of the picture [pixels of the page]. */
  begin(width: number, height: number): void {
    this.used = 0;
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
    const place = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -120%)`;
    if (label.place !== place) element.style.transform = label.place = place;
    if (element.hidden) element.hidden = false;
  }

  end(): void {
    for (let i = this.used; i < this.pool.length; ++i) hide((this.pool[i] as Label).element);
  }

  private next(): Label {
    const known = this.pool[this.used++];
    if (known !== undefined) return known;
    const label = { element: document.createElement("span"), text: "", className: "none", place: "" };
    this.layer.append(label.element);
    this.pool.push(label);
    return label;
  }
}

function hide(element: HTMLElement): void {
  if (!element.hidden) element.hidden = true;
}
