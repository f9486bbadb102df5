import * as THREE from "three";
import { ColladaLoader } from "three/examples/jsm/loaders/ColladaLoader.js";
import { ColladaComposer } from "three/examples/jsm/loaders/collada/ColladaComposer.js";
import { ColladaParser } from "three/examples/jsm/loaders/collada/ColladaParser.js";
import { numbersOf } from "./number_list.ts";

/** Long lists of numbers, which are nearly all of a file. */
const LISTS = /(<(?:float_array|vcount|p)\b[^>]*[^/>]>|<(?:vcount|p)>)([^<]*)</g;
/** Documents in which lists are more than the corners of meshes. */
const SPECIAL = /<(?:polygons|controller|animation)\b/;

/**
 * What ColladaLoader makes of a document, in half of the time and in pieces: the browser reads the document without its lists of
 * numbers, which are put in afterwards. `rest` is waited for between the pieces.
 */
export async function readCollada(text: string, folder: string, manager: THREE.LoadingManager, rest: () => Promise<void>): Promise<THREE.Object3D> {
  if (SPECIAL.test(text)) return known(new ColladaLoader(manager).parse(text, folder)).scene;
  const { short, lists } = shortened(text);
  const { library, asset, collada } = known(new ColladaParser().parse(short));
  for (const geometry of Object.values(library.geometries)) {
    for (const source of Object.values(geometry.sources)) source.array = listOf(source.array, lists);
    for (const primitive of geometry.primitives) {
      if (primitive.p !== undefined) primitive.p = listOf(primitive.p, lists);
      if (primitive.vcount !== undefined) primitive.vcount = listOf(primitive.vcount, lists);
    }
    await rest();
  }
  const { scene } = new ColladaComposer(library, collada, new THREE.TextureLoader(manager).setPath(folder)).compose();
  if (asset.upAxis === "Z_UP") scene.rotation.set(-Math.PI / 2, 0, 0);
  scene.scale.multiplyScalar(asset.unit);
  await rest();
  return scene;
}

/** The document with the number of each list in the place of it, and the lists. */
export function shortened(text: string): { short: string; lists: string[] } {
  const lists: string[] = [];
  const short = text.replace(LISTS, (_, open: string, list: string) => `${open}${lists.push(list) - 1}<`);
  return { short, lists };
}

/** `place`: the number of a list; what is empty was none. */
function listOf(place: number[], lists: string[]): number[] {
  const list = lists[place[0] ?? -1];
  return list === undefined ? place : numbersOf(list);
}

function known<T>(document: T | null): T {
  if (document === null) throw new Error("the file is no Collada document");
  return document;
}
