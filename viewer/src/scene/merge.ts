import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";

/** For meshes without an image: the colour stands at each corner. */
const COLOURED = new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide });

/**
 * The same picture with fewer calls that draw: of the meshes below `object`, in its frame, one mesh with all that has no
 * image, and one for each image. Their materials are matt and have two sides.
 */
export function merged(object: THREE.Object3D): THREE.Group {
  object.updateMatrixWorld(true);
  const toObject = object.matrixWorld.clone().invert();
  const pieces: Piece[] = [];
  object.traverse((child) => {
    if (child instanceof THREE.Mesh) pieces.push(...piecesOf(child, toObject.clone().multiply(child.matrixWorld)));
  });
  const result = new THREE.Group();
  object.matrix.decompose(result.position, result.quaternion, result.scale);
  for (const [map, group] of Map.groupBy(pieces, ({ material }) => material.map)) {
    const geometry = mergeGeometries(group.map((piece) => piece.geometry));
    result.add(new THREE.Mesh(geometry, map === null ? COLOURED : (group[0] as Piece).material));
  }
  return result;
}

/** Triangles of a mesh that have one material, in the frame of the object. */
interface Piece {
  geometry: THREE.BufferGeometry;
  material: THREE.MeshLambertMaterial;
}

function piecesOf(mesh: THREE.Mesh<THREE.BufferGeometry>, place: THREE.Matrix4): Piece[] {
  const soup = mesh.geometry.index === null ? mesh.geometry : mesh.geometry.toNonIndexed();
  if (!soup.hasAttribute("normal")) soup.computeVertexNormals();
  const materials = [mesh.material].flat() as THREE.MeshLambertMaterial[];
  const all = { start: 0, count: soup.getAttribute("position").count, materialIndex: 0 };
  return (Array.isArray(mesh.material) ? soup.groups : [all]).map(({ start, count, materialIndex }) => {
    const material = materials[materialIndex ?? 0] as THREE.MeshLambertMaterial;
    return { geometry: pieceOf(soup, start, count, material).applyMatrix4(place), material };
  }).map(({ geometry, material }) => ({ geometry: place.determinant() < 0 ? turned(geometry) : geometry, material }));
}

/** Some corners of a geometry, with its image's places or, without an image, the material's colour. */
function pieceOf(soup: THREE.BufferGeometry, start: number, count: number, { color, map }: THREE.MeshLambertMaterial): THREE.BufferGeometry {
  const piece = new THREE.BufferGeometry();
  for (const [name, size] of map === null ? SHAPE : [...SHAPE, ["uv", 2] as const]) {
    const numbers = soup.getAttribute(name)?.array.slice(size * start, size * (start + count));
    piece.setAttribute(name, new THREE.BufferAttribute(numbers ?? new Float32Array(size * count), size));
  }
  const colours = Float32Array.from({ length: 3 * count }, (_, i) => color.toArray()[i % 3] as number);
  if (map === null) piece.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  return piece;
}

const SHAPE = [["position", 3], ["normal", 3]] as const;

/** Reverses the triangles of a mirrored geometry. */
function turned(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const { count } = geometry.getAttribute("position");
  return geometry.setIndex(Array.from({ length: count }, (_, i) => count - 1 - i)).toNonIndexed();
}
