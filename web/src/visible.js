// How much of the target shows from a direction, by points: quick on any machine, with or without a graphics card.
import { Vector3 } from 'three';

/** Cells of the picture across the target's diameter; occluders are sampled more closely than that. */
const CELLS = 40;
/** Only so many triangles are sampled: of more, every second, third, ... one. */
const MOST_TRIANGLES = 120000;

/** Points on the triangles of some meshes, no two in one voxel of side h, none farther than `reach` from `centre`. */
export function surfacePoints(meshes, h, centre, reach) {
  const taken = new Set(), out = [];
  const add = (x, y, z) => {
    const i = Math.floor((x - centre.x) / h), j = Math.floor((y - centre.y) / h), k = Math.floor((z - centre.z) / h);
    const key = (i * 4096 + j) * 4096 + k;
    if (Math.hypot(i, j, k) * h > reach || taken.has(key)) return;
    taken.add(key);
    out.push(x, y, z);
  };
  for (const { geometry } of meshes) {
    const p = geometry.attributes.position.array, index = geometry.index.array;
    const stride = 3 * Math.max(1, Math.ceil(index.length / 3 / MOST_TRIANGLES));
    for (let t = 0; t < index.length; t += stride) sampleTriangle(p, 3 * index[t], 3 * index[t + 1], 3 * index[t + 2], h, add);
  }
  return new Float32Array(out);
}

function sampleTriangle(p, a, b, c, h, add) {
  const side = Math.max(Math.abs(p[b] - p[a]), Math.abs(p[b + 1] - p[a + 1]), Math.abs(p[b + 2] - p[a + 2]),
    Math.abs(p[c] - p[a]), Math.abs(p[c + 1] - p[a + 1]), Math.abs(p[c + 2] - p[a + 2]));
  const n = Math.min(200, Math.max(1, Math.ceil(side / h)));
  for (let i = 0; i <= n; ++i)
    for (let j = 0; i + j <= n; ++j) {
      const u = i / n, v = j / n, w = 1 - u - v;
      add(w * p[a] + u * p[b] + v * p[c], w * p[a + 1] + u * p[b + 1] + v * p[c + 1], w * p[a + 2] + u * p[b + 2] + v * p[c + 2]);
    }
}

/** Knows the target's points; asks how many of them stay visible. */
export class Visibility {
  constructor(points, centre, radius) {
    Object.assign(this, { points, centre, radius });
    this.h = (2 * radius) / CELLS;
    this.depth = new Float32Array(CELLS * CELLS);
  }

  /** Calls visit(cell, depth) for every point of a cloud that falls into the picture seen against `direction`. */
  project(cloud, direction, up, visit) {
    const side = new Vector3().crossVectors(up, direction).normalize(), top = new Vector3().crossVectors(direction, side);
    const { centre, h } = this;
    for (let k = 0; k < cloud.length; k += 3) {
      const x = cloud[k] - centre.x, y = cloud[k + 1] - centre.y, z = cloud[k + 2] - centre.z;
      const i = Math.floor((x * side.x + y * side.y + z * side.z) / h + CELLS / 2);
      const j = Math.floor((x * top.x + y * top.y + z * top.z) / h + CELLS / 2);
      if (i >= 0 && i < CELLS && j >= 0 && j < CELLS) visit(j * CELLS + i, x * direction.x + y * direction.y + z * direction.z);
    }
  }

  /** Cells of the picture in which a cloud shows behind what is in the depth buffer. */
  shown(cloud, direction, up) {
    const cells = new Set();
    this.project(cloud, direction, up, (cell, d) => { if (d > this.depth[cell] - 1.5 * this.h) cells.add(cell); });
    return cells.size;
  }

  /** Cells in which the target and the tool show, seen from `direction` among the other faces. */
  count(direction, up, [others, tool]) {
    this.depth.fill(-Infinity);
    for (const cloud of [others, tool, this.points])
      this.project(cloud, direction, up, (cell, d) => { if (d > this.depth[cell]) this.depth[cell] = d; });
    return { target: this.shown(this.points, direction, up), tool: this.shown(tool, direction, up) };
  }
}
