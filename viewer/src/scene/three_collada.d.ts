// The two halves of three's ColladaLoader, which come without types.
declare module "three/examples/jsm/loaders/collada/ColladaParser.js" {
  interface Geometry {
    sources: Record<string, { array: number[] }>;
    primitives: { vcount?: number[]; p?: number[] }[];
  }
  export class ColladaParser {
    parse(text: string): {
      library: { geometries: Record<string, Geometry> };
      asset: { upAxis: string; unit: number };
      collada: Element;
    } | null;
  }
}
declare module "three/examples/jsm/loaders/collada/ColladaComposer.js" {
  import type { Scene, TextureLoader } from "three";
  export class ColladaComposer {
    constructor(library: object, collada: Element, textures: TextureLoader, tga?: undefined);
    compose(): { scene: Scene };
  }
}
