import * as THREE from "three";

/** Short texts over the picture, at points of the scene. Made once, moved and hidden. */
export class Labels {
  private readonly pool: HTMLElement[] = [];
  private used = 0;
  private readonly at = new THREE.Vector3();

  constructor(
    private readonly layer: HTMLElement,
    private readonly camera: THREE.Camera,
  ) {}

  begin(): void {
    this.used = 0;
  }

  /** `p_W`: a point of the scene in W. */
  put(p_W: THREE.Vector3, text: string, className = ""): void {
    this.at.copy(p_W).project(this.camera);
    if (this.at.z > 1 || Math.abs(this.at.x) > 1.05 || Math.abs(this.at.y) > 1.05) return;
    const label = this.next();
    if (label.textContent !== text) label.textContent = text;
    label.className = `label ${className}`;
    const x = (50 * (this.at.x + 1)).toFixed(2);
    const y = (50 * (1 - this.at.y)).toFixed(2);
    label.style.left = `${x}%`;
    label.style.top = `${y}%`;
    label.hidden = false;
  }

  end(): void {
    for (let i = this.used; i < this.pool.length; ++i) (this.pool[i] as HTMLElement).hidden = true;
  }

  private next(): HTMLElement {
    const known = this.pool[this.used++];
    if (known !== undefined) return known;
    const label = document.createElement("span");
    this.layer.append(label);
    this.pool.push(label);
    return label;
  }
}
