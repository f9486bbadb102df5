import * as THREE from "three";
import type { Commands } from "../protocol/commands.ts";
import type { Limits } from "../protocol/session.ts";
import { Arrow, paint } from "../overlays/arrow.ts";
import type { World } from "../scene/world.ts";

/** The force grows to its limit over this way of the mouse [m]. */
const FULL_REACH = 0.5;
/** A pull is renewed this often [ms]; the server ends one that is older than 0.6 s. */
const RENEWAL = 60;

/** Force of a spring from `p` to `q` that reaches `most` at `FULL_REACH` and grows no further [N]. */
export function springForce(p: THREE.Vector3, q: THREE.Vector3, most: number, out: THREE.Vector3): THREE.Vector3 {
  out.copy(q).sub(p).multiplyScalar(most / FULL_REACH);
  return out.clampLength(0, most);
}

/** Dragging a body of the robot pulls it like a spring. */
export class Pull {
  onError: (error: Error) => void = () => {};
  private readonly ray = new THREE.Raycaster();
  private readonly pointer = new THREE.Vector2();
  private readonly plane = new THREE.Plane();
  private readonly material = paint();
  private readonly arrow = new Arrow(this.material, 0.011);
  private readonly direction = new THREE.Vector3();
  private readonly from = new THREE.Vector3();
  private readonly to = new THREE.Vector3();
  private readonly force = new THREE.Vector3();
  private held: { body: string; link: THREE.Object3D; point: THREE.Vector3 } | undefined;
  private timer = 0;

  constructor(
    private readonly world: World,
    private readonly canvas: HTMLCanvasElement,
    private readonly commands: Commands,
    private readonly limits: Limits,
    private readonly mayPull: () => boolean,
  ) {
    world.extras.add(this.arrow.root);
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
    this.held = { body: body.name, link: body.link, point: body.link.worldToLocal(hit.point.clone()) };
    this.world.held = true;
    this.world.camera.controls.enabled = false;
    this.timer = window.setInterval(() => this.renew(), RENEWAL);
    this.canvas.setPointerCapture(event.pointerId);
  }

  private move(event: PointerEvent): void {
    if (this.held !== undefined) this.aim(event);
  }

  private end(): void {
    if (this.held === undefined) return;
    this.send(this.held.body, this.held.point, [0, 0, 0]);
    this.held = undefined;
    this.world.held = false;
    clearInterval(this.timer);
    this.arrow.hide();
    this.world.camera.controls.enabled = true;
  }

  /** Renews the pull, whether a picture is drawn or not. */
  private renew(): void {
    if (this.held === undefined) return;
    this.world.invalidate();
    const { body, link, point } = this.held;
    link.localToWorld(this.from.copy(point));
    this.follow();
    springForce(this.from, this.to, this.limits.push_newtons, this.force);
    this.send(body, point, this.force.toArray());
  }

  /** The spring ends under the pointer, as far from the camera as the point that is held, wherever both go. */
  private follow(): void {
    const { camera } = this.world.stage;
    this.plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(this.direction), this.from);
    this.ray.setFromCamera(this.pointer, camera);
    this.ray.ray.intersectPlane(this.plane, this.to);
  }

  /** Draws the spring; `given`: by the pull so far, as the program says [N·s]. */
  draw(given: number): void {
    if (this.held === undefined) return;
    this.material.color.set(this.world.palette.push);
    const newtons = this.force.length();
    const most = newtons > 0.999 * this.limits.push_newtons ? " (most)" : "";
    if (this.arrow.set(this.from, this.to.clone().sub(this.from)))
      this.world.labels.put(this.arrow.tip, `pull ${newtons.toFixed(0)} N${most}, ${given.toFixed(1)} N·s so far`, "push");
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
