import * as THREE from "three";
import { lightOf, SUN } from "./light.ts";
import type { Palette } from "./palette.ts";

/** The ground's material where the processor draws: light, fog and colours are computed at the corners, only the lines of each metre per pixel. */
export class PlainGround extends THREE.ShaderMaterial {
  constructor() {
    const colour = () => ({ value: new THREE.Color() });
    super({
      uniforms: { surface: colour(), line: colour(), far: colour(), sun: { value: SUN }, light: { value: new THREE.Vector2() } },
      vertexShader: VERTEX, fragmentShader: FRAGMENT, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
  }

  recolour(palette: Palette): void {
    const { surface, line, far, light } = this.uniforms as Record<string, THREE.IUniform>;
    for (const [uniform, colour] of [[surface, palette.ground], [line, palette.groundLine], [far, palette.background]] as const)
      (uniform?.value as THREE.Color).set(colour);
    const { sky, sun } = lightOf(palette);
    (light?.value as THREE.Vector2).set(sky, sun);
  }
}

const VERTEX = /* glsl */ `
uniform vec3 surface, line, far, sun;
uniform vec2 light;
varying vec3 gridPoint, surfaceColour, lineColour;
varying float upright;
vec3 seen(vec3 colour, float shade, float fog) {
  return mix(pow(min(colour * shade, 1.0), vec3(1.0 / 2.2)), pow(far, vec3(1.0 / 2.2)), fog);
}
void main() {
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * at;
  float shade = (light.x * (0.85 + 0.15 * normal.z) + light.y * max(0.0, dot(normal, sun))) / 3.1416;
  float fog = smoothstep(9.0, 30.0, length(at.xyz));
  surfaceColour = seen(surface, shade, fog);
  lineColour = seen(line, shade, fog);
  gridPoint = position;
  upright = step(0.5, abs(normal.z));
}
`;
const FRAGMENT = /* glsl */ `
varying vec3 gridPoint, surfaceColour, lineColour;
varying float upright;
void main() {
  vec2 p = gridPoint.xy;
  vec2 off = abs(fract(p - 0.5) - 0.5) / fwidth(p);
  gl_FragColor = vec4(min(off.x, off.y) * upright < 1.0 && upright > 0.5 ? lineColour : surfaceColour, 1.0);
}
`;
