import * as THREE from "three";
import { GROUND_ORDER } from "../overlays/arrow.ts";
import type { TerrainPiece } from "../protocol/session.ts";
import type { Palette } from "./palette.ts";
import { PlainGround } from "./plain_ground.ts";
import { TerrainGeometry } from "./terrain_geometry.ts";

const FLAT: TerrainPiece = { shape: "plane", position: [0, 0, 0], q_SG: [1, 0, 0, 0], size: [0, 0, 0], columns: 0, rows: 0, heights: [] };

/** The ground, with lines each 0.1 m and stronger lines each metre. */
export class Terrain {
  readonly root = new THREE.Group();
  private readonly surface: THREE.MeshLambertMaterial | PlainGround;
  private readonly edges: THREE.LineBasicMaterial;
  private readonly lineColour = { value: new THREE.Color() };

  /** `plain`: quick to draw. */
  constructor(pieces: TerrainPiece[], plain: boolean) {
    const parts = new TerrainGeometry(pieces.length > 0 ? pieces : [FLAT]);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(parts.positions, 3));
    geometry.setAttribute("normal", new THREE.Float32BufferAttribute(parts.normals, 3));
    geometry.setIndex(parts.indices);
    this.surface = plain ? new PlainGround() : this.fineGround();
    const mesh = new THREE.Mesh(geometry, this.surface);
    mesh.receiveShadow = true;
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.Float32BufferAttribute(parts.edges, 3));
    this.edges = new THREE.LineBasicMaterial();
    this.root.renderOrder = GROUND_ORDER;
    this.root.add(mesh, new THREE.LineSegments(lines, this.edges));
  }

  private fineGround(): THREE.MeshLambertMaterial {
    const surface = new THREE.MeshLambertMaterial({ polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }); // behind its edges
    surface.onBeforeCompile = (shader) => this.addGrid(shader);
    return surface;
  }

  recolour(palette: Palette): void {
    if (this.surface instanceof PlainGround) this.surface.recolour(palette);
    else this.surface.color.set(palette.ground);
    this.edges.color.set(palette.edge);
    this.lineColour.value.set(palette.groundLine);
  }

  /** Lines at round x, y and z, as thin as a pixel and fading with the distance. */
  private addGrid(shader: THREE.WebGLProgramParametersWithUniforms): void {
    shader.uniforms["lineColour"] = this.lineColour;
    const insert = (code: string, behind: string, text: string): string => code.replace(`#include <${behind}>`, `#include <${behind}>\n${text}`);
    shader.vertexShader = insert(shader.vertexShader, "common", "varying vec3 gridPoint;\nvarying vec3 gridNormal;");
    shader.vertexShader = insert(shader.vertexShader, "begin_vertex", "gridPoint = position;\ngridNormal = abs(normal);");
    shader.fragmentShader = insert(shader.fragmentShader, "common", GRID);
    shader.fragmentShader = insert(shader.fragmentShader, "color_fragment", "diffuseColor.rgb = mix(diffuseColor.rgb, lineColour, gridShare());");
  }
}

const GRID = /* glsl */ `
varying vec3 gridPoint;
varying vec3 gridNormal;
uniform vec3 lineColour;
float gridLines(vec2 p, float width) {
  vec2 pixel = max(fwidth(p), 1e-5);
  vec2 line = clamp(width - abs(fract(p - 0.5) - 0.5) / pixel + 0.5, 0.0, 1.0);
  return max(line.x, line.y) * clamp(1.2 - 2.5 * max(pixel.x, pixel.y), 0.0, 1.0);
}
float gridShare() {
  vec2 p = gridNormal.z > 0.5 ? gridPoint.xy : gridNormal.x > 0.5 ? gridPoint.yz : gridPoint.xz;
  return max(gridLines(p, 1.0), 0.35 * gridLines(10.0 * p, 0.6));
}
`;
