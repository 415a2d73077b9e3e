// The tool as a body of revolution about its axis, and the surface that its axis runs through.
import {
  BufferAttribute, BufferGeometry, Group, LatheGeometry, Line, LineBasicMaterial, LineSegments, Mesh, Quaternion, Vector2,
  Vector3,
} from 'three';
import { surface } from './surface.js';

const AROUND = 72;
const CAP = 20;
const UP = new Vector3(0, 1, 0);

/** The sphere's arc from the axis to the profile: at the tip (side -1) or at the upper end (+1). */
function cap(centre, radius, z, rho, side) {
  const from = side < 0 ? Math.PI : Math.atan2(rho, z - centre);
  const to = side < 0 ? Math.atan2(rho, z - centre) : 0;
  const out = [];
  for (let k = 0; k <= CAP; ++k) {
    const angle = from + ((to - from) * k) / CAP;
    out.push([centre + radius * Math.cos(angle), Math.max(0, radius * Math.sin(angle))]);
  }
  return out;
}

/** The outline [z, rho] of the flank with its round ends, from the tip upwards. */
export function outline(tool) {
  const flank = tool.profile.map(([, z, rho]) => [z, rho]);
  const first = flank[0], last = flank[flank.length - 1];
  return {
    tip: cap(0, tool.tip_radius_mm, first[0], first[1], -1),
    flank,
    end: cap(tool.axis_length_mm, tool.end_radius_mm, last[0], last[1], +1),
  };
}

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
  constructor(tool) {
    this.root = new Group();
    this.length = tool.axis_length_mm;
    this.ends = [[0, tool.tip_radius_mm], [tool.axis_length_mm, tool.end_radius_mm]];
    const shape = outline(tool);
    this.materials = {
      flank: surface({ specular: 0x555555 }),
      shank: surface({ specular: 0x444444 }),
      holder: surface({ specular: 0x222222 }),
      axis: new LineBasicMaterial({ transparent: true, opacity: 0.8 }),
    };
    this.root.add(lathe([...shape.tip, ...shape.flank.slice(1, -1), ...shape.end], this.materials.flank));
    if (tool.shank.length) this.root.add(lathe(closed(tool.shank), this.materials.shank));
    if (tool.holder.length) this.root.add(lathe(closed(tool.holder), this.materials.holder));
    const top = Math.max(tool.axis_length_mm + tool.end_radius_mm, ...tool.shank.map((p) => p[0]), ...tool.holder.map((p) => p[0]));
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

  /** Corners of boxes around both ends of the flank, where the tool stands. */
  extremes() {
    this.root.updateMatrixWorld(true);
    return this.ends.flatMap(([s, r]) => [[-r, 0, 0], [r, 0, 0], [0, 0, -r], [0, 0, r], [0, s ? r : -r, 0]]
      .map(([x, y, z]) => this.root.localToWorld(new Vector3(x, y + s, z))));
  }

  paint(theme) {
    this.materials.flank.color.set(theme.tool);
    this.materials.shank.color.set(theme.shank);
    this.materials.holder.color.set(theme.holder);
    this.materials.axis.color.set(theme.axis);
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
