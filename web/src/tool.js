// The tool as a body of revolution about its axis, and the surface that its axis runs through.
import {
  BufferAttribute, BufferGeometry, Group, LatheGeometry, Line, LineBasicMaterial, LineSegments, Mesh, Quaternion, Vector2,
  Vector3,
} from 'three';
import { surface } from './surface.js';

const AROUND = 72;
const CAP = 20;
const UP = new Vector3(0, 1, 0);

/** The arc of the tip's sphere, from the axis to where the flank begins. */
function tipArc(radius, [z, rho]) {
  const to = Math.atan2(rho, z), out = [];
  for (let k = 0; k <= CAP; ++k) {
    const angle = Math.PI + ((to - Math.PI) * k) / CAP;
    out.push([radius * Math.cos(angle), Math.max(0, radius * Math.sin(angle))]);
  }
  return out;
}

/** The outline [z, rho] of what is ground, from the tip upwards: as tool.dxf and tool.step have it, it ends flat where the flank does. */
export function outline(tool) {
  const flank = tool.profile.map(([, z, rho]) => [z, rho]);
  const last = flank[flank.length - 1];
  return { tip: tipArc(tool.tip_radius_mm, flank[0]), flank, end: [last, [last[0], 0]] };
}

/** Where the tool ends, z: of the flank, or of the shank that it has. */
export const topOf = (tool) => Math.max(...tool.profile.map(([, z]) => z), ...tool.shank.map(([z]) => z));

function lathe(points, material) {
  return new Mesh(new LatheGeometry(points.map(([z, rho]) => new Vector2(rho, z)), AROUND), material);
}

/** Profiles given as corners keep them: every corner twice, so that its normals are not blended. */
function closed(profile) {
  if (!profile.length) return [];
  const points = [[profile[0][0], 0], ...profile, [profile[profile.length - 1][0], 0]];
  return points.flatMap((p, k) => (k > 0 && k + 1 < points.length ? [p, p] : [p]));
}

export class ToolModel {
  /** `struck`: which of flank, shank and holder come too near to something. */
  constructor(tool, struck = []) {
    this.root = new Group();
    this.struck = new Set(struck);
    this.length = tool.axis_length_mm;
    this.ends = [[0, tool.tip_radius_mm], [tool.axis_length_mm, tool.end_radius_mm]];
    this.above = [...tool.shank, ...tool.holder];
    const shape = outline(tool);
    this.materials = {
      flank: surface({ specular: 0x555555 }),
      shank: surface({ specular: 0x444444 }),
      holder: surface({ specular: 0x222222 }),
      axis: new LineBasicMaterial({ transparent: true, opacity: 0.8 }),
    };
    this.root.add(lathe([...shape.tip, ...shape.flank.slice(1), ...shape.end], this.materials.flank));
    if (tool.shank.length) this.root.add(lathe(closed(tool.shank), this.materials.shank));
    if (tool.holder.length) this.root.add(lathe(closed(tool.holder), this.materials.holder));
    const top = Math.max(topOf(tool), tool.axis_length_mm, ...tool.holder.map((p) => p[0]));
    const line = new BufferGeometry().setFromPoints([new Vector3(0, -2 * tool.tip_radius_mm, 0), new Vector3(0, top + 0.25 * tool.axis_length_mm, 0)]);
    this.root.add(new Line(line, this.materials.axis));
  }

  place(pose) {
    this.root.position.copy(pose.tip);
    this.root.quaternion.copy(new Quaternion().setFromUnitVectors(UP, pose.axis));
  }

  /** Points of its surface, where the tool stands. */
  surface() {
    this.root.updateMatrixWorld(true);
    const out = [], point = new Vector3();
    for (const mesh of this.root.children.filter((child) => child.isMesh)) {
      const p = mesh.geometry.attributes.position;
      for (let k = 0; k < p.count; k += 3) out.push(...point.fromBufferAttribute(p, k).applyMatrix4(mesh.matrixWorld).toArray());
    }
    return new Float32Array(out);
  }

  /** The same around shank and holder. */
  upperExtremes() {
    this.root.updateMatrixWorld(true);
    return this.above.flatMap(([z, r]) => [[-r, 0], [r, 0], [0, -r], [0, r]].map(([x, y]) => this.root.localToWorld(new Vector3(x, z, y))));
  }

  /** Corners of boxes around both ends of the flank, where the tool stands. */
  extremes() {
    this.root.updateMatrixWorld(true);
    return this.ends.flatMap(([s, r]) => [[-r, 0, 0], [r, 0, 0], [0, 0, -r], [0, 0, r], [0, s ? r : -r, 0]]
      .map(([x, y, z]) => this.root.localToWorld(new Vector3(x, y + s, z))));
  }

  paint(theme) {
    const rest = { flank: theme.tool, shank: theme.shank, holder: theme.holder };
    for (const [body, colour] of Object.entries(rest)) this.materials[body].color.set(this.struck.has(body) ? theme.body : colour);
    this.materials.axis.color.set(this.struck.has('axis') ? theme.struck : theme.axis);
  }
}

/** The ruled surface of one strip: both rails and some rulings as lines, a veil between them. */
function axisSurface(strip, length, materials) {
  const count = strip.tips.length;
  const positions = new Float32Array(6 * count);
  strip.tips.forEach((tip, k) => {
    positions.set([tip.x, tip.y, tip.z], 6 * k);
    const top = tip.clone().addScaledVector(strip.axes[k], length);
    positions.set([top.x, top.y, top.z], 6 * k + 3);
  });
  const faces = [], lines = [];
  for (let k = 0; k + 1 < count; ++k) {
    faces.push(2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 1, 2 * k + 3, 2 * k + 2);
    lines.push(2 * k, 2 * k + 2, 2 * k + 1, 2 * k + 3);
  }
  for (let k = 0, rulings = 12; k <= rulings; ++k) {
    const at = k === rulings ? count - 1 : strip.at((strip.length * k) / rulings)[0];
    lines.push(2 * at, 2 * at + 1);
  }
  const shape = new BufferGeometry();
  shape.setAttribute('position', new BufferAttribute(positions, 3));
  const wires = shape.clone();
  shape.setIndex(faces);
  shape.computeVertexNormals();
  wires.setIndex(lines);
  return [new Mesh(shape, materials.veil), new LineSegments(wires, materials.lines)];
}

export class AxisModel {
  constructor(path, length) {
    this.root = new Group();
    this.materials = {
      veil: surface({ transparent: true, opacity: 0.06, depthWrite: false }),
      lines: new LineBasicMaterial({ transparent: true, opacity: 0.5 }),
    };
    this.groups = path.strips.map((strip) => {
      const group = new Group();
      if (strip.tips.length > 1) group.add(...axisSurface(strip, length, this.materials));
      this.root.add(group);
      return group;
    });
  }

  choose(chosen) {
    this.groups.forEach((group, k) => { group.visible = chosen === null || chosen === k; });
  }

  paint(theme) {
    this.materials.veil.color.set(theme.axis);
    this.materials.lines.color.set(theme.axis);
  }
}
