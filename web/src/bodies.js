// The part: its target coloured by error, everything else calm.
import {
  BufferAttribute, BufferGeometry, DoubleSide, Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial,
} from 'three';
import { errorTexture, texturePlace } from './colours.js';

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
    uv[2 * i] = texturePlace(body.f[i] / tolerance);
    uv[2 * i + 1] = 0.5;
  }
  shape.setAttribute('uv', new BufferAttribute(uv, 2));
  const material = new MeshLambertMaterial({ map: texture, side: DoubleSide, polygonOffset: true,
    polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  const mesh = new Mesh(shape, material);
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
  const material = new MeshLambertMaterial({ side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1,
    polygonOffsetUnits: 1 });
  return new Mesh(geometry(positions, indices), material);
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

export class PartModel {
  constructor(bodies, tolerance) {
    this.root = new Group();
    this.targets = bodies.filter((b) => b.target && b.f).map((b) => coloured(b, tolerance, errorTexture(null)));
    this.entered = bodies.filter((b) => !b.target && b.f);
    this.tolerance = tolerance;
    this.enteredMeshes = this.entered.map((b) => coloured(b, tolerance, errorTexture('#cccccc')));
    const calm = bodies.filter((b) => !b.f);
    this.calm = calm.length ? merged(calm) : null;
    this.edges = edges(bodies);
    this.root.add(...this.targets, ...this.enteredMeshes, this.edges);
    if (this.calm) this.root.add(this.calm);
  }

  /** Everything but the targets. */
  get others() {
    return [...this.enteredMeshes, ...(this.calm ? [this.calm] : [])];
  }

  showOthers(visible) {
    for (const mesh of this.others) mesh.visible = visible;
  }

  showError(visible) {
    for (const mesh of [...this.targets, ...this.enteredMeshes]) {
      mesh.material.map = visible ? mesh.userData.map : null;
      mesh.material.color.set(visible ? '#ffffff' : mesh.userData.rest);
      mesh.material.needsUpdate = true;
    }
  }

  paint(theme) {
    for (const mesh of this.targets) {
      mesh.userData.map ??= mesh.material.map;
      mesh.userData.rest = theme.target;
    }
    const texture = errorTexture(theme.part);
    for (const mesh of this.enteredMeshes) {
      mesh.userData.map = texture;
      mesh.userData.rest = theme.part;
      if (mesh.material.map) mesh.material.map = texture;
    }
    this.calm?.material.color.set(theme.part);
    this.edges.material.color.set(theme.edge);
  }
}
