// All faces of a part in one draw call: a table says which triangles belong to which face, a texel of a texture is its colour.
import { BufferAttribute, DataTexture, DoubleSide, FrontSide, Group, Mesh, NearestFilter, Raycaster, RGBAFormat, SRGBColorSpace, Vector2 } from 'three';
import { edges, geometry } from './bodies.js';
import { channels } from './colours.js';
import { wall } from './surface.js';

/** Texels in a row of the colours. */
const ROW = 64;
/** How much lighter a face is under the pointer. */
const GLOW = 0.45;

/** Where a ray enters a box, as a multiple of its direction; Infinity if it does not. */
function entersBox(o, d, box) {
  let near = 0, far = Infinity;
  for (let k = 0; k < 3; ++k) {
    const a = (box[k] - o[k]) / d[k], b = (box[k + 3] - o[k]) / d[k];
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
  }
  return near <= far * (1 + 1e-9) + 1e-9 ? near : Infinity;
}

/** Where a ray meets a triangle of corners at a, b, c of p, from either side; Infinity if it does not. */
function meets(o, d, p, a, b, c) {
  const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
  const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
  const hx = d[1] * vz - d[2] * vy, hy = d[2] * vx - d[0] * vz, hz = d[0] * vy - d[1] * vx;
  const det = ux * hx + uy * hy + uz * hz;
  if (det === 0) return Infinity;
  const sx = o[0] - p[a], sy = o[1] - p[a + 1], sz = o[2] - p[a + 2];
  const s = (sx * hx + sy * hy + sz * hz) / det;
  if (s < 0 || s > 1) return Infinity;
  const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
  const t = (d[0] * qx + d[1] * qy + d[2] * qz) / det;
  if (t < 0 || s + t > 1) return Infinity;
  const far = (vx * qx + vy * qy + vz * qz) / det;
  return far > 0 ? far : Infinity;
}

/** How much of all area the sum of its vectors may be for a skin that closes: borders of faces share their corners, but for 16 bits. */
const OPEN = 1e-5;

/** Whether triangles close, with their backs inside: then half of them need not be drawn, and without a graphics card drawing is slow. */
function encloses(p, indices) {
  let x = 0, y = 0, z = 0, area = 0, volume = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i], 3 * indices[i + 1], 3 * indices[i + 2]];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2], vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    x += nx, y += ny, z += nz, area += Math.hypot(nx, ny, nz), volume += nx * p[a] + ny * p[a + 1] + nz * p[a + 2];
  }
  return volume > 0 && Math.hypot(x, y, z) < OPEN * area;
}

export class FaceModel {
  /** `bodies`: as readBody gives them, in the order of the part. */
  constructor(bodies) {
    this.root = new Group();
    this.bodies = bodies;
    const vertices = bodies.reduce((sum, b) => sum + b.positions.length / 3, 0);
    this.positions = new Float32Array(3 * vertices);
    this.indices = new Uint32Array(bodies.reduce((sum, b) => sum + b.indices.length, 0));
    this.rows = Math.ceil(bodies.length / ROW) || 1;
    this.uv = new Float32Array(2 * vertices);
    this.faces = [];
    bodies.forEach((body, k) => this.append(body, k));
    this.byId = new Map(this.faces.map((face) => [face.id, face]));
    this.texels = new Uint8Array(4 * ROW * this.rows).fill(255);
    this.texture = new DataTexture(this.texels, ROW, this.rows, RGBAFormat);
    Object.assign(this.texture, { colorSpace: SRGBColorSpace, magFilter: NearestFilter, minFilter: NearestFilter, generateMipmaps: false });
    const shape = geometry(this.positions, this.indices);
    shape.setAttribute('uv', new BufferAttribute(this.uv, 2));
    this.whole = this.indices.slice();
    this.mesh = new Mesh(shape, wall({ map: this.texture }));
    this.edges = edges(bodies);
    this.root.add(this.mesh, this.edges);
    this.hidden = new Set();
    this.plane = null;
    this.closed = encloses(this.positions, this.whole);
    this.sides();
  }

  /** Backs are seen where something is open: by itself, cut, or with faces hidden. */
  sides() {
    const side = this.closed && !this.plane && !this.hidden.size ? FrontSide : DoubleSide;
    if (this.mesh.material.side !== side) Object.assign(this.mesh.material, { side, needsUpdate: true });
  }

  append(body, k) {
    const before = this.faces.at(-1);
    const face = { id: body.face, first: before ? before.first + before.count : 0, count: body.indices.length,
      vertex: before ? before.vertex + before.vertices : 0, vertices: body.positions.length / 3, box: [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity] };
    this.positions.set(body.positions, 3 * face.vertex);
    for (let i = 0; i < face.count; ++i) this.indices[face.first + i] = body.indices[i] + face.vertex;
    for (let i = 0; i < body.positions.length; ++i) {
      const axis = i % 3, value = body.positions[i];
      if (value < face.box[axis]) face.box[axis] = value;
      if (value > face.box[axis + 3]) face.box[axis + 3] = value;
    }
    for (let v = face.vertex; v < face.vertex + face.vertices; ++v) {
      this.uv[2 * v] = ((k % ROW) + 0.5) / ROW;
      this.uv[2 * v + 1] = (Math.floor(k / ROW) + 0.5) / this.rows;
    }
    this.faces.push(face);
  }

  /** `colourOf(id)`: of every face, "#rrggbb"; `glowing`: the id under the pointer, or null. */
  paint(colourOf, glowing) {
    this.faces.forEach((face, k) => {
      let rgb = channels(colourOf(face.id));
      if (face.id === glowing) rgb = rgb.map((v) => Math.round(v + GLOW * (255 - v)));
      this.texels.set(rgb, 4 * k);
    });
    this.texture.needsUpdate = true;
  }

  /** The face at a place of the picture and the point on it, or null; what is hidden or cut away is passed through. */
  pick(stage, x, y) {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / stage.canvas.clientWidth - 1, 1 - (2 * y) / stage.canvas.clientHeight), stage.camera);
    const o = ray.ray.origin.toArray(), d = ray.ray.direction.toArray();
    const near = this.faces.filter((face) => !this.hidden.has(face.id)).map((face) => [entersBox(o, d, face.box), face]).filter(([at]) => at < Infinity).sort((a, b) => a[0] - b[0]);
    let best = Infinity, found = null;
    for (const [at, face] of near) {
      if (at > best) break;
      for (let i = face.first; i < face.first + face.count; i += 3) {
        const t = meets(o, d, this.positions, 3 * this.whole[i], 3 * this.whole[i + 1], 3 * this.whole[i + 2]);
        if (t < best && this.shows(ray.ray, t)) [best, found] = [t, face];
      }
    }
    return found && { id: found.id, point: ray.ray.at(best, ray.ray.origin.clone()) };
  }

  shows(ray, t) {
    return !this.plane || this.plane.distanceToPoint(ray.at(t, ray.origin.clone())) >= 0;
  }

  /** Hides faces, all others show. */
  hide(ids) {
    this.hidden = new Set(ids);
    this.indices.set(this.whole);
    for (const face of this.faces) if (this.hidden.has(face.id)) this.indices.fill(0, face.first, face.first + face.count);
    this.mesh.geometry.index.needsUpdate = true;
    this.sides();
    const shown = edges(this.bodies.filter((body) => !this.hidden.has(body.face)));
    shown.material.dispose();
    this.edges.geometry.dispose();
    this.edges.geometry = shown.geometry;
  }

  /** Cuts away what lies behind a plane of three.js; null: nothing. */
  cut(plane) {
    this.plane = plane;
    for (const { material } of [this.mesh, this.edges]) {
      material.clippingPlanes = plane ? [plane] : null;
      material.needsUpdate = true;
    }
    this.sides();
  }

  /** Low and high corner of all faces. */
  box() {
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (const { box: one } of this.faces) for (let k = 0; k < 3; ++k) {
      box[k] = Math.min(box[k], one[k]);
      box[k + 3] = Math.max(box[k + 3], one[k + 3]);
    }
    return box;
  }
}
