import { rotate } from "../math/geometry.ts";
import type { TerrainPiece } from "../protocol/session.ts";

/** Grid lines of an endless plane, on either side of its middle [m]: hours of walking. On triangles of kilometres rounding would lose the
 * millimetres by which marks lie above the ground. */
const PLANE_LINES = [0, 2, 4, 6, 9, 14, 20, 40, 100, 300, 2000];

/** Triangles and sharp edges of the ground in S, as plain arrays. */
export class TerrainGeometry {
  readonly positions: number[] = [];
  readonly normals: number[] = [];
  readonly indices: number[] = [];
  /** Pairs of points. */
  readonly edges: number[] = [];

  constructor(pieces: TerrainPiece[]) {
    for (const piece of pieces) {
      if (piece.shape === "plane") this.addPlane(piece);
      else if (piece.shape === "box") this.addBox(piece);
      else this.addHeights(piece);
    }
  }

  private vertex(piece: TerrainPiece, p_G: number[], n_G: number[]): number {
    const p = rotate(piece.q_SG, p_G);
    for (let i = 0; i < 3; ++i) this.positions.push((p[i] as number) + (piece.position[i] as number));
    this.normals.push(...rotate(piece.q_SG, n_G));
    return this.positions.length / 3 - 1;
  }

  private quad(piece: TerrainPiece, corners: number[][], normal: number[]): void {
    const [a, b, c, d] = corners.map((corner) => this.vertex(piece, corner, normal)) as [number, number, number, number];
    this.indices.push(a, b, c, a, c, d);
  }

  private addPlane(piece: TerrainPiece): void {
    const lines = [...PLANE_LINES.slice(1).map((at) => -at).reverse(), ...PLANE_LINES];
    for (let i = 1; i < lines.length; ++i) {
      for (let j = 1; j < lines.length; ++j) {
        const [x, X, y, Y] = [lines[i - 1], lines[i], lines[j - 1], lines[j]] as [number, number, number, number];
        this.quad(piece, [[x, y, 0], [X, y, 0], [X, Y, 0], [x, Y, 0]], [0, 0, 1]);
      }
    }
  }

  private addBox(piece: TerrainPiece): void {
    const half = piece.size.map((edge) => edge / 2);
    for (let axis = 0; axis < 3; ++axis) {
      for (const side of [-1, 1]) {
        const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([u, v]) => {
          const p = [0, 0, 0];
          p[axis] = side * (half[axis] as number);
          p[(axis + 1) % 3] = side * (u as number) * (half[(axis + 1) % 3] as number);
          p[(axis + 2) % 3] = (v as number) * (half[(axis + 2) % 3] as number);
          return p;
        });
        const normal = [0, 0, 0];
        normal[axis] = side;
        this.quad(piece, corners, normal);
        if (axis === 2) this.addEdges(piece, corners, side);
      }
    }
  }

  /** All edges of the top face, and the uprights from the bottom face. */
  private addEdges(piece: TerrainPiece, corners: number[][], side: number): void {
    corners.forEach((corner, k) => {
      const other = side > 0 ? (corners[(k + 1) % 4] as number[]) : [corner[0], corner[1], -(corner[2] as number)];
      for (const point of [corner, other]) {
        const p = rotate(piece.q_SG, point as number[]);
        for (let i = 0; i < 3; ++i) this.edges.push((p[i] as number) + (piece.position[i] as number));
      }
    });
  }

  private addHeights(piece: TerrainPiece): void {
    const { columns, rows, heights } = piece;
    if (columns < 2 || rows < 2) return;
    const dx = (piece.size[0] as number) / (columns - 1);
    const dy = (piece.size[1] as number) / (rows - 1);
    const height = (i: number, j: number): number =>
      heights[Math.min(Math.max(j, 0), rows - 1) * columns + Math.min(Math.max(i, 0), columns - 1)] as number;
    const first = this.positions.length / 3;
    for (let j = 0; j < rows; ++j) {
      for (let i = 0; i < columns; ++i) {
        const normal = [(height(i - 1, j) - height(i + 1, j)) / (2 * dx), (height(i, j - 1) - height(i, j + 1)) / (2 * dy), 1];
        const length = Math.hypot(...normal);
        const p = [(i - (columns - 1) / 2) * dx, (j - (rows - 1) / 2) * dy, height(i, j)];
        this.vertex(piece, p, normal.map((n) => n / length));
      }
    }
    for (let j = 0; j + 1 < rows; ++j) {
      for (let i = 0; i + 1 < columns; ++i) {
        const a = first + j * columns + i;
        this.indices.push(a, a + 1, a + columns + 1, a, a + columns + 1, a + columns);
      }
    }
  }
}
