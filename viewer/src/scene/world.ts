import * as THREE from "three";
import type { Frame } from "../data/frame.ts";
import { newtonsOf } from "../data/schema.ts";
import type { FrameSource } from "../data/source.ts";
import { Axes } from "../overlays/axes.ts";
import { Labels } from "../overlays/labels.ts";
import { OverlaySet } from "../overlays/set.ts";
import type { Session } from "../protocol/session.ts";
import { FollowCamera } from "./follow_camera.ts";
import { MeshLibrary } from "./mesh_library.ts";
import { paletteOf, type Palette } from "./palette.ts";
import { Posture } from "./posture.ts";
import { Robot } from "./robot.ts";
import { Stage } from "./stage.ts";
import { Terrain } from "./terrain.ts";

/** Length of an arrow of the robot's weight [m]. */
const WEIGHT_LENGTH = 0.75;
/** Longest arrow: twice the weight. */
const LONGEST = 2 * WEIGHT_LENGTH;
const SETTLING = 1;
/** Trails are drawn again this often [s]. */
const TRAIL_PERIOD = 0.1;

/** The picture: ground, robot, the estimator's ghost and overlays. */
export class World {
  readonly stage: Stage;
  readonly camera: FollowCamera;
  readonly overlays = new OverlaySet();
  readonly robot: Robot;
  readonly ghost: Robot;
  readonly library: MeshLibrary;
  readonly labels: Labels;
  readonly newton: number;
  palette: Palette = paletteOf(false);
  private readonly axes = new Axes();
  private readonly terrain: Terrain;
  private readonly ghostPaint = new THREE.MeshLambertMaterial({ transparent: true, opacity: 0.3 });
  private sinceTrails = Infinity;
  private shown = NaN;
  private dirty = true;
  /** The first picture is still to be drawn: robot and ground alone, since compiling each material takes a while. */
  private first = true;
  private wantsGhost = false;
  /** Time for which pictures continue after the last change, for the camera and the trails [s]. */
  private settling = SETTLING;
  private readonly view = new THREE.Matrix4();
  private onFirstPicture: () => void = () => {};
  private readonly posture: Posture;
  private readonly target = new THREE.Vector3();

  constructor(
    canvas: HTMLCanvasElement,
    labelLayer: HTMLElement,
    over: HTMLElement[],
    private readonly session: Session,
    urdf: string,
  ) {
    this.posture = new Posture(session.header.robot.joint_names.length);
    this.stage = new Stage(canvas);
    this.camera = new FollowCamera(this.stage.camera, canvas);
    labelLayer.after(this.axes.root);
    this.labels = new Labels(labelLayer, [...over, this.axes.root], this.stage.camera);
    this.library = new MeshLibrary(session.meshes, new Promise((resolve) => (this.onFirstPicture = resolve)), () => this.stage.quality.detail);
    this.robot = new Robot(urdf, this.library);
    this.ghost = new Robot(urdf, this.library, this.ghostPaint);
    this.terrain = new Terrain(session.header.terrain, this.stage.quality.software);
    this.newton = WEIGHT_LENGTH / newtonsOf(session.header.robot);
    this.stage.scene.add(this.terrain.root, this.robot.root, this.overlays.root);
    this.clear();
    this.stage.quality.onStep = () => this.invalidate();
    this.library.onLoad = () => this.invalidate();
    this.stage.onResize = () => this.invalidate();
  }

  recolour(dark: boolean): void {
    this.palette = paletteOf(dark);
    this.stage.recolour(this.palette);
    this.terrain.recolour(this.palette);
    this.overlays.recolour(this.palette);
    this.sinceTrails = Infinity; // their colours are in their points
    this.ghostPaint.color.set(this.palette.ghost);
    this.invalidate();
  }

  get ghostShown(): boolean {
    return this.wantsGhost;
  }
  set ghostShown(shown: boolean) {
    this.wantsGhost = shown;
    if (shown) this.stage.scene.add(this.ghost.root);
    else this.ghost.root.removeFromParent(); // else three.js visits its many parts
    this.invalidate();
  }

  /** Hides the robot and its overlays until there is a frame. */
  clear(): void {
    this.setVisible(false);
    this.shown = NaN;
    this.invalidate();
  }

  private setVisible(visible: boolean): void {
    this.robot.root.visible = this.ghost.root.visible = this.overlays.root.visible = visible;
  }

  /** Whether the picture shows all changes so far. */
  get isDrawn(): boolean {
    return !this.dirty;
  }

  /** The picture must be drawn again although the time is the same. */
  invalidate(): void {
    this.dirty = true;
  }

  /**
   * Whether the picture would differ from the last. The camera's controls move it on input; updating them here would move it by a rounding error
   * again and again.
   */
  private changed(frame: Frame | undefined): boolean {
    this.stage.camera.updateMatrixWorld();
    const moved = !this.view.equals(this.stage.camera.matrixWorld);
    return this.dirty || moved || frame?.time !== this.shown || this.settling > 0;
  }

  /** Draws the frame if the picture would differ from the last; `dt`: time since that [s]. */
  draw(frame: Frame | undefined, source: FrameSource, dt: number): boolean {
    const { quality } = this.stage;
    if (this.changed(frame)) quality.move();
    else if (frame === undefined || !quality.rest()) return false;
    this.settling = frame?.time !== this.shown ? SETTLING : this.settling - dt;
    this.dirty = false;
    this.stage.fit();
    this.labels.begin(this.stage.width, this.stage.height);
    if (frame !== undefined) this.show(frame, source, dt);
    if (this.first) this.overlays.root.visible = false;
    this.view.copy(this.stage.camera.matrixWorld);
    this.axes.turn(this.stage.camera);
    this.stage.render();
    if (frame !== undefined) this.completed();
    this.labels.end();
    return true;
  }

  /** The robot is in the picture. */
  private completed(): void {
    if (!this.first) return this.onFirstPicture();
    this.first = false;
    this.invalidate();
  }

  private show(frame: Frame, source: FrameSource, dt: number): void {
    this.setVisible(true);
    this.robot.root.visible = this.pose(this.robot, frame, "truth", "truth") || this.pose(this.robot, frame, "state", "state");
    if (this.ghostShown)
      this.ghost.root.visible = this.pose(this.ghost, frame, "estimate", "state", this.robot) || this.pose(this.ghost, frame, "state", "state", this.robot);
    this.target.copy(this.robot.root.position);
    this.camera.update(this.target, dt);
    this.stage.lightAt(this.target);
    this.stage.camera.updateMatrixWorld();
    this.sinceTrails += dt;
    const trails = this.sinceTrails > TRAIL_PERIOD && (frame.time !== this.shown || this.sinceTrails > 1);
    if (trails) this.sinceTrails = 0;
    this.shown = frame.time;
    const { header } = this.session;
    const { labels, newton, centreOf, axisOf } = this;
    this.overlays.update({ frame, source, header, labels, newton, longest: LONGEST, trails, centreOf, axisOf });
  }

  /** `base`, `legs`: topics with their positions. False: the base's pose is not known. */
  private pose(robot: Robot, frame: Frame, base: string, legs: string, like?: Robot): boolean {
    const known = this.posture.read(frame, base, legs);
    if (known) robot.pose(this.posture, this.session.header.robot.joint_names, like);
    return known;
  }

  private readonly axisOf = (joint: string, place: THREE.Vector3, axis: THREE.Vector3): boolean => this.robot.axisOf(joint, place, axis);
  private readonly centreOf = (body: string, out: THREE.Vector3): boolean => this.robot.centreOf(body, out);

  /** Place of a link's frame in S [m]. */
  positionOf(link: string): number[] | undefined {
    const found = this.robot.urdf.links[link];
    return found === undefined ? undefined : found.getWorldPosition(new THREE.Vector3()).toArray();
  }

  /** Time of the frame in the picture [s]. */
  get drawn(): number {
    return this.shown;
  }

  /** Place of a point of S in the page [pixels]. */
  place(p_S: [number, number, number]): [number, number] {
    const at = new THREE.Vector3(...p_S).project(this.stage.camera);
    const box = this.stage.renderer.domElement.getBoundingClientRect();
    return [box.left + 0.5 * (1 + at.x) * box.width, box.top + 0.5 * (1 - at.y) * box.height];
  }

  /** Height of the ground as it is drawn [m]. */
  groundAt(x: number, y: number): number | undefined {
    const ray = new THREE.Raycaster(new THREE.Vector3(x, y, 50), new THREE.Vector3(0, 0, -1));
    return ray.intersectObject(this.terrain.root, true).find(({ face }) => face)?.point.z;
  }

  /** Colour of the picture at a place of the page [pixels]: red, green, blue, from 0 to 255. */
  pixelAt(x: number, y: number): number[] {
    this.stage.render(); // the browser has cleared what it showed
    const context = this.stage.renderer.getContext();
    const box = this.stage.renderer.domElement.getBoundingClientRect();
    const bytes = new Uint8Array(4);
    const column = ((x - box.left) / box.width) * context.drawingBufferWidth;
    const row = (1 - (y - box.top) / box.height) * context.drawingBufferHeight;
    context.readPixels(Math.floor(column), Math.floor(row), 1, 1, context.RGBA, context.UNSIGNED_BYTE, bytes);
    return [...bytes.subarray(0, 3)];
  }
}
