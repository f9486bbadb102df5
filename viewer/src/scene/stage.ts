import * as THREE from "three";
import { drawsInSoftware, Quality } from "./quality.ts";
import { lightOf, SUN_OFFSET } from "./light.ts";
import type { Palette } from "./palette.ts";

THREE.Object3D.DEFAULT_UP.set(0, 0, 1);
/** Reach of the shadows around the camera's target [m]. */
const SHADOW_REACH = 1.6;

/** The browser has no WebGL. */
export class NoGraphics extends Error {}

function makeRenderer(canvas: HTMLCanvasElement, antialias: boolean): THREE.WebGLRenderer {
  try {
    return new THREE.WebGLRenderer({ canvas, antialias });
  } catch (error) {
    throw new NoGraphics((error as Error).message);
  }
}

/** Why there is no picture although there is WebGL. */
export function withoutPictureText(error: Error): string {
  return `There is no picture, as the robot can't be shown: ${error.message}. All else works.`;
}

/** Renderer, lights and camera. */
export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(42, 1, 0.02, 120);
  readonly renderer: THREE.WebGLRenderer;
  readonly quality: Quality;
  onResize: () => void = () => {};
  /** Size of the picture [pixels of the page]. */
  width = 1;
  height = 1;
  private fits = false;
  private readonly sun = new THREE.DirectionalLight(0xffffff, 2.4);
  private readonly sky = new THREE.HemisphereLight(0xffffff, 0xb8bec4, 1.5);

  /** `NoGraphics` where the browser has no WebGL. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    const software = drawsInSoftware();
    this.renderer = makeRenderer(canvas, !software);
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.quality = new Quality(this.renderer, () => this.resize(), software);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.bias = -0.0005;
    this.sun.shadow.normalBias = 0.01;
    const shadow = this.sun.shadow.camera;
    shadow.left = shadow.bottom = -SHADOW_REACH;
    shadow.right = shadow.top = SHADOW_REACH;
    shadow.near = 0.5;
    shadow.far = 12;
    this.scene.add(this.sky, this.sun, this.sun.target);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.fit();
  }

  recolour(palette: Palette): void {
    this.scene.background = new THREE.Color(palette.background);
    this.scene.fog = new THREE.Fog(palette.background, 9, 30);
    this.sky.groundColor.set(palette.dark ? 0x6b747c : 0xb8bec4);
    const { sky, sun } = lightOf(palette);
    this.sky.intensity = sky;
    this.sun.intensity = sun;
  }

  /** The light comes from the same side wherever the robot is. */
  lightAt(target: THREE.Vector3): void {
    this.sun.target.position.copy(target);
    this.sun.position.copy(target).add(SUN_OFFSET);
  }

  /** Resizing empties the picture, so it is done when the next one is drawn. */
  private resize(): void {
    this.fits = false;
    this.onResize();
  }

  /** Before each picture. */
  fit(): void {
    if (this.fits) return;
    this.fits = true;
    const { clientWidth, clientHeight } = this.canvas; // below it there are the key and messages
    this.width = Math.max(1, clientWidth);
    this.height = Math.max(1, clientHeight);
    this.renderer.setPixelRatio(this.quality.pixelRatio);
    this.renderer.setSize(this.width, this.height, false);
    this.camera.aspect = this.width / this.height;
    this.camera.updateProjectionMatrix();
  }

  render(): void {
    this.sun.castShadow = this.quality.shadows;
    this.renderer.render(this.scene, this.camera);
  }
}
