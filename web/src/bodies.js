// The part: its target coloured by error, everything else calm.
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh } from 'three';
import { ErrorTexture, SPANS } from './colours.js';
import { PLAIN, wall } from './surface.js';

function geometry(positions, indices) {
  const out = new BufferGeometry();
  out.setAttribute('position', new BufferAttribute(positions, 3));
  out.setIndex(new BufferAttribute(indices, 1));
  out.computeVertexNormals();
  return out;
}

function coloured(body, tolerance, texture) {
  const shape = geometry(body.positions, body.indices);
  const uv = new Float32Array(2 * body.f.length);
  for (let i = 0; i < body.f.length; ++i) {
    uv[2 * i] = body.f[i] / tolerance;
    uv[2 * i + 1] = 0.5;
  }
  shape.setAttribute('uv', new BufferAttribute(uv, 2));
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

function edges(bodies) {
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

export class PartModel {
  constructor(bodies, tolerance) {
    this.root = new Group();
    this.span = SPANS[0];
    this.colours = true;
    this.textures = { target: new ErrorTexture(), entered: new ErrorTexture() };
    const make = (chosen, texture) => bodies.filter(chosen).map((b) => coloured(b, tolerance, texture.texture));
    this.targets = make((b) => b.target && b.f, this.textures.target);
    this.entered = make((b) => !b.target && b.f, this.textures.entered);
    const calm = bodies.filter((b) => !b.f);
    this.calm = calm.length ? merged(calm) : null;
    this.edges = edges(bodies.filter((b) => b.target));
    this.otherEdges = edges(bodies.filter((b) => !b.target));
    this.root.add(...this.targets, ...this.entered, this.edges, this.otherEdges);
    if (this.calm) this.root.add(this.calm);
  }

  /** Everything but the targets. */
  get others() {
    return [...this.entered, ...(this.calm ? [this.calm] : [])];
  }

  /** `look`: one of OTHERS. */
  showOthers(look) {
    for (const mesh of this.others) mesh.visible = look !== 'hidden';
    this.otherEdges.visible = look !== 'hidden';
    for (const mesh of this.others) {
      const veiled = look === 'see-through';
      Object.assign(mesh.material, { transparent: veiled, opacity: veiled ? (mesh === this.calm ? SEE_THROUGH : 2 * SEE_THROUGH) : 1, depthWrite: !veiled });
      mesh.material.needsUpdate = true;
    }
    this.otherEdges.material.opacity = look === 'see-through' ? 0.25 : 0.45;
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
    this.calm?.material.color.set(theme.part);
    this.edges.material.color.set(theme.edge);
    this.otherEdges.material.color.set(theme.edge);
  }
}
