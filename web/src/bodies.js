// The part: its target coloured by error, everything else calm.
import {
  BufferAttribute, BufferGeometry, DataTexture, Group, LineBasicMaterial, LineSegments, Mesh, NearestFilter, RGBAFormat, SRGBColorSpace, Vector3,
} from 'three';
import { channels, ErrorTexture, SPANS } from './colours.js';
import { PLAIN, wall } from './surface.js';

/** Steps of a colour over a distance. */
const GAP_STEPS = 512;

export function geometry(positions, indices) {
  const out = new BufferGeometry();
  out.setAttribute('position', new BufferAttribute(positions, 3));
  out.setIndex(new BufferAttribute(indices, 1));
  out.computeVertexNormals();
  return out;
}

/** Where an error has its colour. */
function colourPlaces(f, tolerance) {
  const uv = new Float32Array(2 * f.length);
  for (let i = 0; i < f.length; ++i) {
    uv[2 * i] = f[i] / tolerance;
    uv[2 * i + 1] = 0.5;
  }
  return new BufferAttribute(uv, 2);
}

function coloured(body, tolerance, texture) {
  const shape = geometry(body.positions, body.indices);
  shape.setAttribute('uv', colourPlaces(body.f, tolerance));
  const mesh = new Mesh(shape, wall({ map: texture }));
  mesh.userData.body = body;
  return mesh;
}

/** Faces that nothing happens to, as one mesh. */
function merged(bodies) {
  const positions = new Float32Array(bodies.reduce((sum, b) => sum + b.positions.length, 0));
  const indices = new Uint32Array(bodies.reduce((sum, b) => sum + b.indices.length, 0));
  let vertex = 0, index = 0;
  for (const body of bodies) {
    positions.set(body.positions, vertex);
    for (let i = 0; i < body.indices.length; ++i) indices[index + i] = body.indices[i] + vertex / 3;
    vertex += body.positions.length;
    index += body.indices.length;
  }
  return new Mesh(geometry(positions, indices), wall());
}

export function edges(bodies) {
  const segments = [];
  for (const body of bodies) {
    let at = 0;
    for (const count of body.borderCounts) {
      for (let k = at; k + 1 < at + count; ++k) segments.push(...body.borders.subarray(3 * k, 3 * k + 6));
      at += count;
    }
  }
  const shape = new BufferGeometry();
  shape.setAttribute('position', new BufferAttribute(new Float32Array(segments), 3));
  return new LineSegments(shape, new LineBasicMaterial({ transparent: true, opacity: 0.45 }));
}

/** How the faces that are no targets look. */
export const OTHERS = ['solid', 'see-through', 'hidden'];
const SEE_THROUGH = 0.22;

/** A colour over a distance: `struck` below zero, `near` up to what was asked, the rest beyond. */
class GapTexture {
  constructor(reach, required) {
    Object.assign(this, { reach, required, data: new Uint8Array(4 * GAP_STEPS).fill(255) });
    this.texture = new DataTexture(this.data, GAP_STEPS, 1, RGBAFormat);
    Object.assign(this.texture, { colorSpace: SRGBColorSpace, magFilter: NearestFilter, minFilter: NearestFilter });
  }

  paint(theme, rest) {
    for (let k = 0; k < GAP_STEPS; ++k) {
      const gap = (((k + 0.5) / GAP_STEPS) * 2 - 1) * this.reach;
      this.data.set(channels(gap < 0 ? theme.struck : gap < this.required ? theme.near : rest), 4 * k);
    }
    this.texture.needsUpdate = true;
  }
}

/** What may not be touched, coloured by how far the tool's bodies stay from it. */
function gapMesh(body, texture) {
  const shape = geometry(body.positions, body.indices);
  const uv = new Float32Array(body.positions.length / 3 * 2).fill(0.5);
  for (let i = 0; i < uv.length / 2; ++i) uv[2 * i] = body.gap ? Math.max(0.001, Math.min(0.999, 0.5 + body.gap[i] / (2 * texture.reach))) : 0.999;
  shape.setAttribute('uv', new BufferAttribute(uv, 2));
  const mesh = new Mesh(shape, wall({ map: texture.texture }));
  mesh.userData.body = body;
  return mesh;
}

const veil = (mesh, look, opacity) => {
  const veiled = look === 'see-through';
  mesh.visible = look !== 'hidden';
  Object.assign(mesh.material, { transparent: veiled, opacity: veiled ? opacity : 1, depthWrite: !veiled });
  mesh.material.needsUpdate = true;
};

/** Corners of the boxes around some meshes. */
function cornersOf(meshes) {
  return meshes.flatMap(({ geometry: shape }) => {
    shape.computeBoundingBox();
    const { min, max } = shape.boundingBox;
    return min.x > max.x ? [] : [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => new Vector3(x, y, z))));
  });
}

/** The fixtures, red where the tool's bodies enter them. */
export class FixtureModel {
  /** `required`: the clearance that was asked for, mm. */
  constructor(bodies, required) {
    this.root = new Group();
    this.texture = new GapTexture(Math.max(2 * required, 2), required);
    this.meshes = bodies.map((body) => gapMesh(body, this.texture));
    this.edges = edges(bodies);
    this.root.add(...this.meshes, this.edges);
  }

  show(look) {
    for (const mesh of this.meshes) veil(mesh, look, 2 * SEE_THROUGH);
    this.edges.visible = look !== 'hidden';
  }

  corners() {
    return cornersOf(this.meshes);
  }

  paint(theme) {
    this.texture.paint(theme, theme.fixture);
    this.edges.material.color.set(theme.edge);
  }
}

export class PartModel {
  /** `struck`: the collisions of worst.js; a face that one of them names is drawn by itself. */
  constructor(bodies, tolerance, struck = []) {
    this.root = new Group();
    this.tolerance = tolerance;
    this.span = SPANS[0];
    this.colours = true;
    this.textures = { target: new ErrorTexture(), entered: new ErrorTexture() };
    const make = (chosen, texture) => bodies.filter(chosen).map((b) => coloured(b, tolerance, texture.texture));
    this.targets = make((b) => b.target && b.f, this.textures.target);
    this.entered = make((b) => !b.target && b.f, this.textures.entered);
    const named = new Set(struck.map((one) => one.obstacle));
    this.gaps = new GapTexture(2, Math.max(0, ...struck.map((one) => one.required)));
    this.struck = bodies.filter((b) => !b.f && (b.gap || named.has(b.face))).map((b) => gapMesh(b, this.gaps));
    const own = new Set(this.struck.map((mesh) => mesh.userData.body));
    const calm = bodies.filter((b) => !b.f && !own.has(b));
    this.calm = calm.length ? merged(calm) : null;
    this.edges = edges(bodies.filter((b) => b.target));
    this.otherEdges = edges(bodies.filter((b) => !b.target));
    this.root.add(...this.targets, ...this.entered, ...this.struck, this.edges, this.otherEdges);
    if (this.calm) this.root.add(this.calm);
  }

  /** Everything but the targets. */
  get others() {
    return [...this.entered, ...this.struck, ...(this.calm ? [this.calm] : [])];
  }

  corners() {
    return cornersOf([...this.targets, ...this.others]);
  }

  /** `look`: one of OTHERS. */
  showOthers(look) {
    this.otherEdges.visible = look !== 'hidden';
    for (const mesh of this.others) veil(mesh, look, mesh === this.calm ? SEE_THROUGH : 2 * SEE_THROUGH);
    this.otherEdges.material.opacity = look === 'see-through' ? 0.25 : 0.45;
  }

  /** Whether it is known what a tool that bends leaves. */
  get bends() {
    return this.targets.some((mesh) => mesh.userData.body.bent);
  }

  /** The error of a tool that bends under the load, or of a stiff one. */
  showBent(on) {
    for (const { geometry: shape, userData } of this.targets) {
      userData.shown = on && userData.body.bent ? userData.body.bent : userData.body.f;
      shape.setAttribute('uv', colourPlaces(userData.shown, this.tolerance));
    }
  }

  /** `span`: the end of the scale in tolerances. */
  showError(visible, span) {
    this.colours = visible;
    this.span = span;
    this.paint(this.theme);
  }

  paint(theme) {
    this.theme = theme;
    this.textures.target.paint(this.span, null);
    this.textures.entered.paint(this.span, theme.part);
    const paintAll = (meshes, texture, rest) => meshes.forEach(({ material }) => {
      material.map = this.colours ? texture.texture : PLAIN;
      material.color.set(this.colours ? '#ffffff' : rest);
    });
    paintAll(this.targets, this.textures.target, theme.target);
    paintAll(this.entered, this.textures.entered, theme.part);
    this.gaps.paint(theme, theme.part);
    this.calm?.material.color.set(theme.part);
    this.edges.material.color.set(theme.edge);
    this.otherEdges.material.color.set(theme.edge);
  }
}
