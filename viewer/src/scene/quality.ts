import type * as THREE from "three";
import { Pace } from "./pace.ts";

interface Step {
  /** What a user may notice; "": nothing. */
  words: string;
  /** Most pixels of the picture for one of the page. */
  ratio: number;
  shadows: boolean;
  /** The smallest that is kept of a mesh, as a share of its size; 0: as many triangles as its file has. */
  detail: number;
}

/** From the finest picture to the quickest. Meshes stay: coarse ones cost little more than primitives. */
export const STEPS: readonly Step[] = [
  { words: "", ratio: 2, shadows: true, detail: 0 },
  { words: "", ratio: 1, shadows: true, detail: 0 },
  { words: "no shadows", ratio: 1, shadows: false, detail: 1 / 14 },
  { words: "coarse picture", ratio: 0.6, shadows: false, detail: 1 / 14 },
  { words: "coarse picture", ratio: 0.4, shadows: false, detail: 1 / 14 },
];
/** Steps where the processor draws: at first, and at rest. */
const SOFTWARE = 3;
const SOFTWARE_AT_REST = 2;

/** Whether the processor draws because there is no graphics card. */
export function drawsInSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  const info = context?.getExtension("WEBGL_debug_renderer_info");
  const name = info == null ? "" : String(context?.getParameter(info.UNMASKED_RENDERER_WEBGL));
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** A picture that takes longer is too slow; one below `QUICK` allows a finer one [ms]. */
const TOO_SLOW = 110;
const QUICK = 30;
/** Total time of slow pictures before the next step; of quick ones before the step back [ms]. */
const PATIENCE = 1500;
const TRUST = 20000;

/** Lowers the picture's quality where the machine is too slow, and raises it again. */
export class Quality {
  step = 0;
  /** Mean time from a picture to the next [ms]. */
  frameTime = NaN;
  readonly pace = new Pace(globalThis.document);
  onStep: () => void = () => {};
  /** Nothing moves: the finest picture that this machine draws. */
  resting = false;
  private slow = 0;
  private quick = 0;
  private readonly finest: number;

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly resize: () => void,
    /** The processor draws. */
    readonly software: boolean,
  ) {
    this.finest = software ? SOFTWARE_AT_REST : window.devicePixelRatio <= 1 ? 1 : 0;
    this.step = software ? SOFTWARE : this.finest;
    renderer.shadowMap.enabled = this.shadows;
  }

  private get current(): Step {
    return STEPS[this.resting ? this.finest : this.step] as Step;
  }
  get pixelRatio(): number {
    return Math.min(window.devicePixelRatio, this.current.ratio);
  }
  get shadows(): boolean {
    return this.current.shadows;
  }
  get detail(): number {
    return this.current.detail;
  }

  /** Nothing moves any more. True: a finer picture is to be drawn. */
  rest(): boolean {
    if (this.resting) return false;
    this.resting = true;
    return this.step !== this.finest && this.refine();
  }

  /** Something moves again. The time of the fine picture does not count. */
  move(): void {
    if (!this.resting) return;
    this.resting = false;
    if (this.step === this.finest) return;
    this.pace.took = NaN;
    this.refine();
  }

  /** Pictures a second, while there are any. */
  get rate(): string {
    const rate = 1000 / this.frameTime;
    return rate > 0 && !this.resting ? `${rate.toFixed(rate < 9.5 ? 1 : 0)} fps` : "";
  }

  /** What the pictures leave out, and why. */
  get coarse(): string {
    const { words } = this.current;
    return words === "" ? "" : `${words}: ${this.software ? "the processor draws" : "drawing is slow here"}`;
  }

  /** After each picture. */
  measure(): void {
    const { took, period } = this.pace;
    if (Number.isNaN(took)) return;
    this.frameTime = Number.isNaN(this.frameTime) ? period : this.frameTime + 0.1 * (period - this.frameTime);
    this.slow = took > TOO_SLOW ? this.slow + took : Math.max(0, this.slow - 2 * TOO_SLOW);
    this.quick = took < QUICK ? this.quick + period : 0;
    if (this.slow >= PATIENCE && this.step + 1 < STEPS.length) this.use(this.step + 1);
    else if (this.quick >= TRUST && this.step > this.finest) this.use(this.step - 1);
  }

  private use(step: number): void {
    this.step = step;
    this.slow = this.quick = 0;
    this.refine();
  }

  /** Applies another step. */
  private refine(): true {
    this.renderer.shadowMap.enabled = this.shadows;
    this.resize();
    this.onStep();
    return true;
  }
}
