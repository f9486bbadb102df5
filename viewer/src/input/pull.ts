import * as THREE from "three";
import type { Commands } from "../protocol/commands.ts";
import type { Status } from "../protocol/connection.ts";
import type { Limits } from "../protocol/session.ts";
import { Arrows, paintOverBodies } from "../overlays/arrow.ts";
import type { World } from "../scene/world.ts";
import { Grip } from "./grip.ts";

/** The force grows to its limit over this way of the mouse [m]. */
const FULL_REACH = 1;

/** What the pointer holds: a body, and where, in its frame. */
interface Held {
  body: string;
  link: THREE.Object3D;
  point: THREE.Vector3;
}

/** Force of a spring from `p` to `q` that reaches `most` at `FULL_REACH` and grows no further [N]. */
export function springForce(p: THREE.Vector3, q: THREE.Vector3, most: number, out: THREE.Vector3): THREE.Vector3 {
  out.copy(q).sub(p).multiplyScalar(most / FULL_REACH);
  return out.clampLength(0, most);
}

/** What stands beside a pull: the force that is asked for, and what the program says of the one that acts. */
export function pullText(asked: number, most: number, status: Pick<Status, "pull" | "pull_is_weaker"> | undefined): string {
  const pull = status?.pull ?? null;
  const newtons = pull !== null && status?.pull_is_weaker ? Math.hypot(...pull.force) : asked;
  const limit = status?.pull_is_weaker || asked > 0.999 * most ? " (no more is allowed now)" : "";
  return `pull ${newtons.toFixed(0)} N${limit}, ${(pull?.given ?? 0).toFixed(1)} N·s so far`;
}

/** Dragging a body of the robot pulls it like a spring. */
export class Pull {
  onError: (error: Error) => void = () => {};
  private readonly ray = new THREE.Raycaster();
  private readonly pointer = new THREE.Vector2();
  private readonly plane = new THREE.Plane();
  private readonly edge = new Arrows(paintOverBodies(), 0.016, 1, 3);
  private readonly arrow = new Arrows(paintOverBodies(), 0.011, 1, 4);
  private readonly colour = new THREE.Color();
  private readonly direction = new THREE.Vector3();
  private readonly from = new THREE.Vector3();
  private readonly to = new THREE.Vector3();
  private readonly stretched = new THREE.Vector3();
  private readonly force = new THREE.Vector3();
  private held: Held | undefined;
  private grip: Grip | undefined;

  constructor(
    private readonly world: World,
    private readonly canvas: HTMLCanvasElement,
    private readonly commands: Commands,
    private readonly limits: Limits,
    private readonly mayPull: () => boolean,
  ) {
    world.extras.add(this.edge.root, this.arrow.root);
    canvas.addEventListener("pointerdown", (event) => this.begin(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"] as const)
      canvas.addEventListener(end, () => this.end());
  }

  private aim(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    this.pointer.set(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
  }

  private begin(event: PointerEvent): void {
    if (event.button !== 0 || event.shiftKey || event.pointerType === "touch" || !this.mayPull()) return;
    this.aim(event);
    this.ray.setFromCamera(this.pointer, this.world.stage.camera);
    const hit = this.ray.intersectObject(this.world.robot.root, true).find(({ object }) => isShown(object));
    const body = hit === undefined ? undefined : this.world.robot.bodyOf(hit.object);
    if (hit === undefined || body === undefined) return;
    const held = { body: body.name, link: body.link, point: body.link.worldToLocal(hit.point.clone()) };
    this.held = held;
    this.world.held = body.name;
    this.world.camera.controls.enabled = false;
    this.grip?.drop();
    this.stretch(held);
    this.grip = new Grip(() => this.stretch(held), (force) => this.send(held.body, held.point, force), this.mayPull, () => this.end());
    this.canvas.setPointerCapture(event.pointerId);
  }

  private move(event: PointerEvent): void {
    if (this.held === undefined) return;
    this.aim(event);
    this.grip?.moved();
  }

  private end(): void {
    if (this.held === undefined) return;
    this.grip?.end();
    this.held = undefined;
    this.world.held = undefined;
    for (const arrow of [this.edge, this.arrow]) {
      arrow.begin();
      arrow.end();
    }
    this.world.camera.controls.enabled = true;
  }

  /** The force of the spring as it is now, whether a picture is drawn or not. */
  private stretch({ link, point }: Held): number[] {
    this.world.invalidate();
    link.localToWorld(this.from.copy(point));
    this.follow();
    return springForce(this.from, this.to, this.limits.push_newtons, this.force).toArray();
  }

  /** The spring ends under the pointer, as far from the camera as the point that is held, wherever both go. */
  private follow(): void {
    const { camera } = this.world.stage;
    this.plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(this.direction), this.from);
    this.ray.setFromCamera(this.pointer, camera);
    this.ray.ray.intersectPlane(this.plane, this.to);
  }

  /** Draws the spring; what it has given so far is as the program says. */
  draw(status: Status | undefined): void {
    if (this.held === undefined) return;
    this.edge.begin();
    this.edge.add(this.from, this.stretched.copy(this.to).sub(this.from), this.colour.set(this.world.palette.halo));
    this.edge.end();
    this.arrow.begin();
    if (this.arrow.add(this.from, this.stretched.copy(this.to).sub(this.from), this.colour.set(this.world.palette.push)))
      this.world.labels.put(this.arrow.tip, pullText(this.force.length(), this.limits.push_newtons, status), "push");
    this.arrow.end();
  }

  private send(body: string, point: THREE.Vector3, force: number[]): void {
    const short = (value: number): number => Number(value.toFixed(4));
    this.commands
      .send("pull", { body, point: point.toArray().map(short), force: force.map(short) })
      .catch((error: Error) => this.onError(error));
  }
}

function isShown(object: THREE.Object3D): boolean {
  for (let at: THREE.Object3D | null = object; at !== null; at = at.parent) if (!at.visible) return false;
  return true;
}
