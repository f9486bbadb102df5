import type * as THREE from "three";

interface Step {
  /** Most pixels of the picture for one of the page. */
  ratio: number;
  shadows: boolean;
  /** Meshes with as many triangles as their files have. */
  fine: boolean;
  meshes: boolean;
}

/** From the finest picture to the quickest. */
export const STEPS: readonly Step[] = [
  { ratio: 2, shadows: true, fine: true, meshes: true },
  { ratio: 1, shadows: true, fine: true, meshes: true },
  { ratio: 1, shadows: false, fine: false, meshes: true },
  { ratio: 0.75, shadows: false, fine: false, meshes: true },
  { ratio: 0.6, shadows: false, fine: false, meshes: false },
];

/** Whether the processor draws, without a graphics card. */
export function drawsInSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  const info = context?.getExtension("WEBGL_debug_renderer_info");
  const name = info == null ? "" : String(context?.getParameter(info.UNMASKED_RENDERER_WEBGL));
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** A picture that takes longer than this is too slow [ms]. */
const TOO_SLOW = 110;
/** Slow pictures in a row before the next step. */
const PATIENCE = 12;

/** Takes the picture down a step where the machine can't follow. */
export class Quality {
  step = 0;
  /** Mean time of a picture [ms]. */
  frameTime = NaN;
  onStep: () => void = () => {};
  private slow = 0;

  constructor(
    renderer: THREE.WebGLRenderer,
    private readonly resize: () => void,
    software: boolean,
  ) {
    if (software) this.step = 2;
    else if (window.devicePixelRatio <= 1) this.step = 1;
    renderer.shadowMap.enabled = this.shadows;
    this.apply = () => (renderer.shadowMap.enabled = this.shadows);
  }

  private readonly apply: () => void;

  private get current(): Step {
    return STEPS[this.step] as Step;
  }
  get pixelRatio(): number {
    return Math.min(window.devicePixelRatio, this.current.ratio);
  }
  get shadows(): boolean {
    return this.current.shadows;
  }
  get fine(): boolean {
    return this.current.fine;
  }
  get meshes(): boolean {
    return this.current.meshes;
  }

  /** `dt`: since the picture before [ms]. Long pauses are a tab that slept, not a slow machine. */
  measure(dt: number): void {
    if (dt > 3000) return;
    this.frameTime = Number.isNaN(this.frameTime) ? dt : this.frameTime + 0.1 * (dt - this.frameTime);
    this.slow = dt > TOO_SLOW ? this.slow + 1 : Math.max(0, this.slow - 2);
    if (this.slow >= PATIENCE && this.step + 1 < STEPS.length) this.use(this.step + 1);
  }

  use(step: number): void {
    this.step = step;
    this.slow = 0;
    this.apply();
    this.resize();
    this.onStep();
  }
}
