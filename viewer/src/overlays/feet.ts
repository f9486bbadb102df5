import * as THREE from "three";
import { read, scalar } from "../data/frame.ts";
import { LEG_CHANNELS, LEGS } from "../data/schema.ts";
import type { Palette } from "../scene/palette.ts";
import { paint } from "./arrow.ts";
import { TRAIL_SECONDS } from "./com.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";
import { Trail, trailMaterial } from "./trail.ts";

const X = new THREE.Vector3(1, 0, 0);

/** Ways of the feet: the references (thin) with the planned way ahead as far as it is known, and where they really went. */
export class SwingCurves implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly planned = LEGS.map(() => trailMaterial(0.55));
  private readonly real = LEGS.map(() => trailMaterial());
  private readonly plannedTrails = this.planned.map((material) => new Trail(material));
  private readonly realTrails = this.real.map((material) => new Trail(material));
  private readonly targets = LEGS.map(() => new THREE.Mesh(new THREE.SphereGeometry(0.009, 12, 8), paint()));
  private readonly foot = new THREE.Vector3();

  constructor() {
    for (const trail of [...this.plannedTrails, ...this.realTrails]) this.root.add(trail.line);
    this.root.add(...this.targets);
  }

  wear(palette: Palette): void {
    LEGS.forEach((_, k) => {
      const colour = palette.legs[k] as number;
      (this.planned[k] as THREE.LineBasicMaterial).color.set(colour);
      (this.real[k] as THREE.LineBasicMaterial).color.set(colour);
      (this.targets[k] as THREE.Mesh<THREE.SphereGeometry, THREE.MeshBasicMaterial>).material.color.set(colour);
    });
  }

  update(picture: Picture): void {
    LEGS.forEach((_, k) => {
      const target = this.targets[k] as THREE.Mesh;
      target.visible = scalar(picture.frame, LEG_CHANNELS.phase[k] as string) >= 2;
      vector(picture.frame, LEG_CHANNELS.plannedFoot[k] as string, target.position);
    });
    if (picture.trails) this.drawTrails(picture);
  }

  private drawTrails({ frame, source }: Picture): void {
    for (const trail of [...this.plannedTrails, ...this.realTrails]) trail.begin();
    source.sample(frame.time - TRAIL_SECONDS, frame.time + TRAIL_SECONDS, 240, (one) => {
      LEGS.forEach((_, k) => {
        if (vector(one, LEG_CHANNELS.plannedFoot[k] as string, this.foot))
          (this.plannedTrails[k] as Trail).add(this.foot.x, this.foot.y, this.foot.z);
        if (one.time <= frame.time && vector(one, LEG_CHANNELS.foot[k] as string, this.foot))
          (this.realTrails[k] as Trail).add(this.foot.x, this.foot.y, this.foot.z);
      });
    });
    for (const trail of [...this.plannedTrails, ...this.realTrails]) trail.end();
  }
}

/** Prints where feet stand, stood, and (where the future is known) will stand. */
export class Footholds implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly perLeg = 6;
  private readonly discs = LEGS.map(() =>
    Array.from({ length: this.perLeg }, () => {
      const disc = new THREE.Mesh(new THREE.RingGeometry(0.02, 0.031, 28), paint(0.6));
      disc.visible = false;
      return disc;
    }),
  );
  private readonly last = LEGS.map(() => [NaN, NaN, NaN]);
  private readonly foot = [0, 0, 0];

  constructor() {
    for (const discs of this.discs) this.root.add(...discs);
  }

  wear(palette: Palette): void {
    this.discs.forEach((discs, k) => discs.forEach((disc) => disc.material.color.set(palette.legs[k] as number)));
  }

  update({ frame, source, header, trails }: Picture): void {
    if (!trails) return;
    const counts = [0, 0, 0, 0];
    for (const last of this.last) last.fill(NaN);
    source.sample(frame.time - 4 * TRAIL_SECONDS, frame.time + TRAIL_SECONDS, 120, (one) => {
      LEGS.forEach((_, k) => {
        if (!(scalar(one, LEG_CHANNELS.phase[k] as string) <= 1) || !read(one, LEG_CHANNELS.plannedFoot[k] as string, this.foot)) return;
        const last = this.last[k] as number[];
        if (Math.hypot(...this.foot.map((x, i) => x - (last[i] as number))) < 0.03) return;
        const disc = (this.discs[k] as THREE.Mesh[])[(counts[k] as number) % this.perLeg] as THREE.Mesh;
        counts[k] = (counts[k] as number) + 1;
        this.foot.forEach((x, i) => (last[i] = x));
        disc.position.fromArray(this.foot).setZ((this.foot[2] as number) - header.robot.foot_radius + 0.003);
      });
    });
    this.discs.forEach((discs, k) => discs.forEach((disc, i) => (disc.visible = i < (counts[k] as number))));
  }
}

/** Spheres around the hips between which the feet must stay; plainer the nearer a foot is to one. */
export class LimbLimits implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly shells = LEGS.map(() => ({ min: shell(), max: shell() }));
  private readonly legMaterial = LEGS.map(() => trailMaterial());
  private readonly lines = this.legMaterial.map((material) => new Trail(material, 2));
  private readonly colours = { good: 0, near: 0, bad: 0 };
  private readonly hip = new THREE.Vector3();
  private readonly foot = new THREE.Vector3();

  constructor() {
    for (const { min, max } of this.shells) this.root.add(min, max);
    for (const line of this.lines) this.root.add(line.line);
  }

  wear(palette: Palette): void {
    Object.assign(this.colours, palette.margin);
  }

  update({ frame, header, labels, beliefToWorld }: Picture): void {
    const { min, max, form } = header.limb;
    LEGS.forEach((_, k) => {
      const shells = this.shells[k] as { min: Shell; max: Shell };
      const line = this.lines[k] as Trail;
      const known =
        vector(frame, LEG_CHANNELS.hip[k] as string, this.hip) && vector(frame, LEG_CHANNELS.foot[k] as string, this.foot);
      line.line.visible = known;
      shells.min.visible = known && min !== null;
      shells.max.visible = known && max !== null;
      if (!known) return;
      const length = form === "vertical" ? Math.abs(this.hip.z - this.foot.z) : this.hip.distanceTo(this.foot);
      const room = Math.min(max === null ? 1 : max - length, min === null ? 1 : length - min);
      const colour = this.colours[room > 0.03 ? "good" : room > 0 ? "near" : "bad"];
      place(shells.max, this.hip, max ?? 0, max === null ? 1 : max - length, colour);
      place(shells.min, this.hip, min ?? 0, min === null ? 1 : length - min, colour);
      (this.legMaterial[k] as THREE.LineBasicMaterial).color.set(colour);
      line.begin();
      line.add(this.hip.x, this.hip.y, this.hip.z);
      line.add(this.foot.x, this.foot.y, this.foot.z);
      line.end();
      labels.put(this.hip.lerp(this.foot, 0.5).applyMatrix4(beliefToWorld), `${(100 * length).toFixed(1)} cm`, "limb");
    });
  }
}

type Shell = THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;

/** A sphere of radius 1 as circles: through the poles, and around the axis z. */
const GLOBE = globe(4, 5, 36);

function globe(meridians: number, parallels: number, sides: number): THREE.BufferGeometry {
  const points: number[] = [];
  const circle = (at: (angle: number) => THREE.Vector3): void => {
    for (let i = 0; i < sides; ++i) for (const k of [i, i + 1]) points.push(...at((2 * Math.PI * k) / sides).toArray());
  };
  for (let i = 0; i < meridians; ++i)
    circle((angle) => new THREE.Vector3().setFromSphericalCoords(1, angle, (Math.PI * i) / meridians).applyAxisAngle(X, Math.PI / 2));
  for (let i = 1; i <= parallels; ++i) {
    const latitude = Math.PI * (i / (parallels + 1) - 0.5);
    circle((angle) => new THREE.Vector3(Math.cos(latitude) * Math.cos(angle), Math.cos(latitude) * Math.sin(angle), Math.sin(latitude)));
  }
  return new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
}

function shell(): Shell {
  return new THREE.LineSegments(GLOBE, trailMaterial(0.1));
}

function place(shell: Shell, hip: THREE.Vector3, radius: number, room: number, colour: number): void {
  shell.position.copy(hip);
  shell.scale.setScalar(radius);
  shell.material.color.set(colour);
  shell.material.opacity = 0.1 + 0.4 * Math.max(0, 1 - Math.max(0, room) / 0.1);
}
