import * as THREE from "three";

/** Of all that has no image: the colour stands at each corner. */
const COLOURED = new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide });

/** Triangles of a mesh that have one material. */
interface Piece {
  mesh: THREE.Mesh<THREE.BufferGeometry>;
  material: THREE.MeshLambertMaterial;
  /** Numbers of the mesh's corners that it needs, and its triangles in numbers of these. */
  corners: number[];
  triangles: number[];
}

/**
 * The same picture with fewer calls that draw: of the meshes below `object`, in its frame, one mesh with all that has no
 * image, and one for each image. Their materials are matt and have two sides.
 */
export function merged(object: THREE.Object3D): THREE.Group {
  object.updateMatrixWorld(true);
  const byImage = new Map<THREE.Texture | null, Piece[]>();
  object.traverse((child) => {
    if (!(child instanceof THREE.Mesh)) return;
    for (const piece of piecesOf(child)) {
      const { map } = piece.material;
      byImage.set(map, [...(byImage.get(map) ?? []), piece]);
    }
  });
  const result = new THREE.Group();
  result.position.copy(object.position);
  result.quaternion.copy(object.quaternion);
  result.scale.copy(object.scale);
  const toObject = object.matrixWorld.clone().invert();
  for (const pieces of byImage.values()) result.add(join(pieces, toObject));
  return result;
}

function piecesOf(mesh: THREE.Mesh<THREE.BufferGeometry>): Piece[] {
  const { geometry } = mesh;
  const materials = (Array.isArray(mesh.material) ? mesh.material : [mesh.material]) as THREE.MeshLambertMaterial[];
  const all = { start: 0, count: geometry.index?.count ?? geometry.getAttribute("position").count, materialIndex: 0 };
  return (Array.isArray(mesh.material) ? geometry.groups : [all]).map(({ start, count, materialIndex }) => {
    const numbers = new Map<number, number>();
    const triangles: number[] = [];
    for (let i = start; i < start + count; ++i) {
      const corner = geometry.index?.getX(i) ?? i;
      const number = numbers.get(corner) ?? numbers.size;
      numbers.set(corner, number);
      triangles.push(number);
    }
    return { mesh, material: materials[materialIndex ?? 0] as THREE.MeshLambertMaterial, corners: [...numbers.keys()], triangles };
  });
}

function join(pieces: Piece[], toObject: THREE.Matrix4): THREE.Mesh {
  const { map } = (pieces[0] as Piece).material;
  const count = pieces.reduce((sum, { corners }) => sum + corners.length, 0);
  const position = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
  const normal = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
  const look = map === null ? new THREE.BufferAttribute(new Float32Array(3 * count), 3) : new THREE.BufferAttribute(new Float32Array(2 * count), 2);
  const index: number[] = [];
  const place = new THREE.Matrix4();
  const turn = new THREE.Matrix3();
  const at = new THREE.Vector3();
  let first = 0;
  for (const { mesh, material, corners, triangles } of pieces) {
    const { geometry } = mesh;
    const [points, normals, uvs] = ["position", "normal", "uv"].map((name) => geometry.getAttribute(name)) as THREE.BufferAttribute[];
    place.multiplyMatrices(toObject, mesh.matrixWorld);
    turn.getNormalMatrix(place);
    corners.forEach((corner, k) => {
      at.fromBufferAttribute(points as THREE.BufferAttribute, corner).applyMatrix4(place);
      position.setXYZ(first + k, at.x, at.y, at.z);
      if (normals !== undefined) at.fromBufferAttribute(normals, corner).applyMatrix3(turn).normalize();
      normal.setXYZ(first + k, at.x, at.y, at.z);
      if (map === null) look.setXYZ(first + k, material.color.r, material.color.g, material.color.b);
      else if (uvs !== undefined) look.setXY(first + k, uvs.getX(corner), uvs.getY(corner));
    });
    const mirrored = place.determinant() < 0;
    for (let i = 0; i + 2 < triangles.length; i += 3)
      for (const k of mirrored ? [i, i + 2, i + 1] : [i, i + 1, i + 2]) index.push(first + (triangles[k] as number));
    first += corners.length;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", position);
  geometry.setAttribute("normal", normal);
  geometry.setAttribute(map === null ? "color" : "uv", look);
  geometry.setIndex(index);
  return new THREE.Mesh(geometry, map === null ? COLOURED : (pieces[0] as Piece).material);
}
