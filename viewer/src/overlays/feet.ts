import * as THREE from "three";
import { scalar, type Frame } from "../data/frame.ts";
import { isFollowed } from "../data/hierarchy.ts";
import { MOST_LEGS, perLeg } from "../data/schema.ts";
import { paint } from "./arrow.ts";
import { TRAIL_SECONDS } from "./com.ts";
import { Copies } from "./copies.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";
import { Pen, Trails } from "./trail.ts";

const X = new THREE.Vector3(1, 0, 0);

/** Paths of the feet: references (thin), ahead as far as they are known, and the paths that the feet took. */
export class SwingCurves implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly planned = new Trails(0.55, 1020);
  /** Visible while the robot follows it. */
  private readonly plan = new THREE.Group();
  private readonly real = new Trails(1, 1020);
  private readonly plannedPens = perLeg(() => new Pen(this.planned));
  private readonly realPens = perLeg(() => new Pen(this.real));
  private readonly targets = new Copies(new THREE.SphereGeometry(0.009, 12, 8), paint(), MOST_LEGS);
  private readonly foot = new THREE.Vector3();
  private readonly place = new THREE.Matrix4();

  constructor() {
    this.plan.add(this.planned.lines, this.targets.mesh);
    this.root.add(this.plan, this.real.lines);
  }

  update(picture: Picture): void {
    const { frame, colours } = picture;
    this.plan.visible = isFollowed(frame);
    this.targets.begin();
    if (this.plan.visible) frame.schema.legs.forEach(({ phase, plannedFoot }, k) => {
      if (scalar(frame, phase) >= 2 && vector(frame, plannedFoot, this.foot)) this.targets.add(this.place.setPosition(this.foot), colours.legs[k] as THREE.Color);
    });
    this.targets.end();
    if (picture.trails) this.drawTrails(picture);
  }

  private drawTrails({ frame, source, colours }: Picture): void {
    this.planned.begin();
    this.real.begin();
    for (const pens of [this.plannedPens, this.realPens]) pens.forEach((pen, k) => pen.begin(colours.legs[k] as THREE.Color));
    source.sample(frame.time - TRAIL_SECONDS, frame.time + TRAIL_SECONDS, 240, (one) => {
      const isPlanned = isFollowed(one);
      one.schema.legs.forEach(({ plannedFoot, foot }, k) => {
        const planned = this.plannedPens[k] as Pen;
        if (!isPlanned) planned.lift();
        else if (vector(one, plannedFoot, this.foot)) planned.to(this.foot);
        if (one.time <= frame.time && vector(one, foot, this.foot)) (this.realPens[k] as Pen).to(this.foot);
      });
    });
    this.planned.end();
    this.real.end();
  }
}

/** Planned footholds: present, past and, as far as they are known, future. */
export class Footholds implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly eachLeg = 6;
  private readonly discs = new Copies(new THREE.RingGeometry(0.02, 0.031, 28), paint(0.6), this.eachLeg * MOST_LEGS);
  /** The latest of each leg; the oldest is reused. */
  private readonly prints = perLeg(() => Array.from({ length: this.eachLeg }, () => new THREE.Vector3()));
  private readonly counts = perLeg(() => 0);
  private readonly last = perLeg(() => new THREE.Vector3());
  private readonly foot = new THREE.Vector3();
  private readonly place = new THREE.Matrix4();

  constructor() {
    this.root.add(this.discs.mesh);
  }

  update(picture: Picture): void {
    this.root.visible = isFollowed(picture.frame);
    if (!picture.trails) return;
    this.collect(picture);
    this.discs.begin();
    this.prints.forEach((prints, k) => {
      for (const print of prints.slice(0, this.counts[k])) this.discs.add(this.place.setPosition(print), picture.colours.legs[k] as THREE.Color);
    });
    this.discs.end();
  }

  private collect({ frame, source, header }: Picture): void {
    this.counts.fill(0);
    source.sample(frame.time - 4 * TRAIL_SECONDS, frame.time + TRAIL_SECONDS, 120, (one) => {
      if (!isFollowed(one)) return;
      one.schema.legs.forEach(({ phase, plannedFoot }, k) => {
        if (!(scalar(one, phase) <= 1) || !vector(one, plannedFoot, this.foot)) return;
        const count = this.counts[k] as number;
        const last = this.last[k] as THREE.Vector3;
        if (count > 0 && this.foot.distanceTo(last) < 0.03) return;
        this.counts[k] = count + 1;
        last.copy(this.foot);
        const print = (this.prints[k] as THREE.Vector3[])[count % this.eachLeg] as THREE.Vector3;
        print.copy(this.foot).setZ(this.foot.z - header.robot.foot_radius + 0.003);
      });
    });
  }
}

/** A leg this near to a limit is at it: labels have 0.1 cm [m]. */
const AT_LIMIT = 0.0005;

type Brake = "" | "braked" | "not braked enough";

/** Text of a leg's length and of the room to its nearer limit; `brake`: how the limit acts before it is reached. */
export function limbText(leg: string, length: number, room: number, brake: Brake = ""): string {
  const cm = (metres: number): string => `${(100 * metres).toFixed(1)} cm`;
  const left = !Number.isFinite(room) ? "" : Math.abs(room) < AT_LIMIT ? ", at limit" : room >= 0 ? `, ${cm(room)} left` : `, ${cm(-room)} beyond`;
  return `${leg} ${cm(length)}${left}${brake !== "" && room >= AT_LIMIT ? `, ${brake}` : ""}`;
}

/** Names of the controller's rows of these limits end with this. */
export const LIMB_ROW = " extension";

/** How a leg's limit acts: it bounds the acceleration before the leg reaches its length, and its row is kept or violated. */
export function brakeOf({ active, schema }: Frame, leg: string, limits: number): Brake {
  const acting = active.filter(({ level, row }) => level === limits && schema.rowName(level, row).includes(leg + LIMB_ROW));
  if (acting.length === 0) return "";
  return acting.some(({ state }) => Math.abs(state) > 1) ? "not braked enough" : "braked";
}

/** Spheres around the hips between which the feet must stay; more opaque the nearer a foot is to one. */
export class LimbLimits implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly shells = perLeg(() => ({ min: shell(), max: shell() }));
  private readonly lines = new Trails(1, MOST_LEGS);
  private readonly hip = new THREE.Vector3();
  private readonly foot = new THREE.Vector3();

  constructor() {
    for (const { min, max } of this.shells) this.root.add(min, max);
    this.root.add(this.lines.lines);
  }

  update({ frame, header, labels, colours, beliefToWorld }: Picture): void {
    const { min, max, form } = header.limb;
    this.lines.begin();
    frame.schema.legs.forEach(({ name, hip, foot }, k) => {
      const shells = this.shells[k] as { min: Shell; max: Shell };
      const known = vector(frame, hip, this.hip) && vector(frame, foot, this.foot);
      shells.min.visible = known && min !== null;
      shells.max.visible = known && max !== null;
      if (!known) return;
      const length = form === "vertical" ? Math.abs(this.hip.z - this.foot.z) : this.hip.distanceTo(this.foot);
      const [above, below] = [max === null ? Infinity : max - length, min === null ? Infinity : length - min];
      const colour = colours.legs[k] as THREE.Color;
      place(shells.max, this.hip, max ?? 0, above, colour);
      place(shells.min, this.hip, min ?? 0, below, colour);
      this.lines.add(this.hip, this.foot, colour);
      labels.put(this.hip.lerp(this.foot, 0.5).applyMatrix4(beliefToWorld), limbText(name, length, Math.min(above, below), brakeOf(frame, name, header.limb.level)), `limb leg${k}`);
    });
    this.lines.end();
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
  const made = new THREE.LineSegments(GLOBE, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.1, fog: false }));
  made.visible = false;
  return made;
}

function place(shell: Shell, hip: THREE.Vector3, radius: number, room: number, colour: THREE.Color): void {
  shell.position.copy(hip);
  shell.scale.setScalar(radius);
  shell.material.color.copy(colour);
  shell.material.opacity = 0.3 + 0.6 * Math.max(0, 1 - Math.max(0, room) / 0.1);
}
