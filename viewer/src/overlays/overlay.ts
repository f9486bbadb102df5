import * as THREE from "three";
import type { Frame } from "../data/frame.ts";
import type { FrameSource } from "../data/source.ts";
import type { Header } from "../protocol/session.ts";
import type { Colours, Palette } from "../scene/palette.ts";
import type { Labels } from "./labels.ts";

/** What overlays need to draw a picture. */
export interface Picture {
  frame: Frame;
  source: FrameSource;
  header: Header;
  labels: Labels;
  colours: Colours;
  /** Length of an arrow of 1 N [m/N]. */
  newton: number;
  /** Longest arrow of a force [m]: those of a fall would leave the picture. */
  longest: number;
  /** Moves what is planned and believed to the true robot. */
  beliefToWorld: THREE.Matrix4;
  /** Centre of mass of a body in S; false: there is no such body. */
  centreOf: (body: string, out: THREE.Vector3) => boolean;
  /** Place and axis of a joint in S; false: there is no such joint. */
  axisOf: (joint: string, place: THREE.Vector3, axis: THREE.Vector3) => boolean;
  /** Trails are drawn again in this picture. */
  trails: boolean;
}

/** A drawing over the robot that can be switched off. */
export interface Overlay {
  /** Whether its coordinates are in S, the controller's world, or in S, the simulator's. */
  readonly space: "belief" | "world";
  readonly root: THREE.Object3D;
  /** Sets the colours of its materials. */
  recolour?(palette: Palette): void;
  update(picture: Picture): void;
}

/** A vector of the frame; false where it is not known. */
export function vector(frame: Frame, name: string, out: THREE.Vector3, at = 0): boolean {
  const offset = frame.schema.offset(name);
  if (offset < 0) return false;
  out.fromArray(frame.values, offset + at);
  return !Number.isNaN(out.x + out.y + out.z);
}
