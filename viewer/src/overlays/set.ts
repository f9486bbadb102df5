import * as THREE from "three";
import { read, type Frame } from "../data/frame.ts";
import { wrap, yawOf } from "../math/geometry.ts";
import { coloursOf, paletteOf, type Palette } from "../scene/palette.ts";
import { CentreOfMass } from "./com.ts";
import { Footholds, LimbLimits, SwingCurves } from "./feet.ts";
import { GroundForces, OutsideForce, WantedForces } from "./forces.ts";
import { JointAxes } from "./joints.ts";
import { SupportPolygon, TerrainPlane, ZeroMomentPoint } from "./ground_marks.ts";
import type { Overlay, Picture } from "./overlay.ts";
import { FrictionPyramids } from "./pyramids.ts";

export interface OverlaySwitch {
  id: string;
  name: string;
  about: string;
  on: boolean;
}

const ENTRIES: [id: string, name: string, about: string, on: boolean, make: () => Overlay][] = [
  ["forces", "Contact forces", "of the ground on each foot, in N", true, () => new GroundForces()],
  ["pyramids", "Friction pyramids", "that hold the forces of the solution; 100 % used: at a face", true, () => new FrictionPyramids()],
  ["support", "Support polygon", "hull of the feet that carry", true, () => new SupportPolygon()],
  ["com", "Centre of mass", "plumb line to a disc over the support polygon, beside it to a ring; violet: its plan", true, () => new CentreOfMass()],
  ["zmp", "Zero-moment point", "ring: from the forces; square: of the plan", true, () => new ZeroMomentPoint()],
  ["swing", "Swing curves", "way of each foot, and its reference", true, () => new SwingCurves()],
  ["footholds", "Footholds", "where feet stood and stand", true, () => new Footholds()],
  ["push", "Outside force", "what pushes, in N; pale: what the controller believes", true, () => new OutsideForce()],
  ["limbs", "Hip–foot limits", "spheres between which a foot must stay; its distance from the hip, and what is left, in cm", false, () => new LimbLimits()],
  ["wanted", "Forces of the solution", "that the controller asks for", false, () => new WantedForces()],
  ["plane", "Terrain plane", "that the controller walks by", false, () => new TerrainPlane()],
  ["joints", "Joints", "name and axis of each; a positive angle turns about the arrow by the right hand", false, () => new JointAxes()],
];

/** All overlays. What the controller believes is moved to the true robot. */
export class OverlaySet {
  readonly root = new THREE.Group();
  private readonly beliefToWorld = new THREE.Matrix4();
  private colours = coloursOf(paletteOf(false));
  readonly switches: OverlaySwitch[];
  private readonly overlays: Overlay[];
  private readonly holders: THREE.Group[] = [];
  private readonly belief = new THREE.Group();
  private readonly moved = new THREE.Vector3();
  private readonly p = [0, 0, 0];
  private readonly q = [1, 0, 0, 0];
  private readonly p_true = [0, 0, 0];
  private readonly q_true = [1, 0, 0, 0];
  private fresh = new Set<Overlay>();

  constructor() {
    this.switches = ENTRIES.map(([id, name, about, on]) => ({ id, name, about, on }));
    this.overlays = ENTRIES.map(([, , , , make]) => make());
    this.belief.matrixAutoUpdate = false;
    this.root.add(this.belief);
    for (const overlay of this.overlays) {
      const holder = new THREE.Group().add(overlay.root);
      this.holders.push(holder);
      (overlay.space === "belief" ? this.belief : this.root).add(holder);
    }
  }

  recolour(palette: Palette): void {
    this.colours = coloursOf(palette);
    for (const overlay of this.overlays) overlay.recolour?.(palette);
  }

  toggle(id: string): void {
    const entry = this.switches.find((one) => one.id === id);
    if (entry === undefined) return;
    entry.on = !entry.on;
    this.fresh = new Set(this.overlays);
  }

  update(seen: Omit<Picture, "colours" | "beliefToWorld">): void {
    const picture = { ...seen, colours: this.colours, beliefToWorld: this.beliefToWorld };
    this.align(picture.frame);
    this.belief.matrix.copy(this.beliefToWorld);
    this.belief.matrixWorldNeedsUpdate = true;
    this.overlays.forEach((overlay, k) => {
      const on = (this.switches[k] as OverlaySwitch).on;
      if (on) overlay.update(this.fresh.has(overlay) ? { ...picture, trails: true } : picture);
      (this.holders[k] as THREE.Group).visible = on;
    });
    this.fresh.clear();
  }

  /** Sets the turn about z and the shift that take the believed base to the true one. */
  private align(frame: Frame): void {
    this.beliefToWorld.identity();
    if (!read(frame, "truth.p_SB", this.p_true) || !read(frame, "truth.q_SB", this.q_true)) return;
    if (!read(frame, "state.p_WB", this.p) || !read(frame, "state.q_WB", this.q)) return;
    this.beliefToWorld.makeRotationZ(wrap(yawOf(this.q_true) - yawOf(this.q)));
    this.moved.fromArray(this.p).applyMatrix4(this.beliefToWorld);
    this.beliefToWorld.setPosition(
      (this.p_true[0] as number) - this.moved.x,
      (this.p_true[1] as number) - this.moved.y,
      (this.p_true[2] as number) - this.moved.z,
    );
  }
}
