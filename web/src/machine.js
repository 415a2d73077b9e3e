// A simple picture of the machine's axes: table, head, part and tool where they are at a time of the program.
import { html, picture, svg } from './dom.js';
import * as format from './format.js';

const WIDTH = 420, HEIGHT = 320, MARGIN = 14;
const COS = Math.cos(Math.PI / 6), SIN = Math.sin(Math.PI / 6);
/** Corners of a circle. */
const ROUND = 20;
/** How many times of a program the picture's scale is made for. */
const LOOKS = 60;

const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const unit = (a) => scaled(a, 1 / Math.hypot(...a));

/** A point moved by a joint's value, mm or degrees. */
export function moved(joint, value, p) {
  if (joint.unit === 'mm') return add(p, joint.direction, value);
  const n = joint.direction, at = add(p, joint.point_mm, -1), angle = (value * Math.PI) / 180, c = Math.cos(angle), s = Math.sin(angle);
  return add(joint.point_mm, add(add(scaled(at, c), cross(n, at), s), n, (1 - c) * dot(n, at)));
}

/** Where a point of a link is, seen from the bed: `link` joints lie between the work and it. */
export function placed(motion, values, link, p) {
  const bed = motion.joints.filter((joint) => joint.table).length;
  let q = p;
  for (let k = link; k < bed; k++) q = moved(motion.joints[k], -values[k], q);
  for (let k = link; k-- > bed;) q = moved(motion.joints[k], values[k], q);
  return q;
}

function boxCorners([a, b, c, d, e, f]) {
  return [a, d].flatMap((x) => [b, e].flatMap((y) => [c, f].map((z) => [x, y, z])));
}

function cylinderCorners(from, to, radius) {
  const axis = unit(add(to, from, -1)), side = unit(cross(axis, Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0])), other = cross(axis, side);
  return [from, to].flatMap((end) => Array.from({ length: ROUND }, (_, k) => {
    const t = (2 * Math.PI * k) / ROUND;
    return add(add(end, side, radius * Math.cos(t)), other, radius * Math.sin(t));
  }));
}

/** What is drawn: the file's outlines, or a plate and a spindle where it has none; the part, and the tool as a line. */
function solids(motion) {
  const { gauge_mm: gauge, axis, tool_length_mm: length } = motion.spindle;
  const list = motion.bodies.map((body) => ({ name: body.name, link: body.link, kind: 'body',
    corners: body.box_mm ? boxCorners(body.box_mm) : cylinderCorners(body.cylinder_mm.slice(0, 3), body.cylinder_mm.slice(3), body.radius_mm) }));
  if (!list.some((body) => body.link === 0)) list.push({ name: 'table', link: 0, kind: 'body', corners: boxCorners([-90, -90, -15, 90, 90, 0]) });
  if (!list.some((body) => body.link === motion.joints.length))
    list.push({ name: 'spindle', link: motion.joints.length, kind: 'body', corners: cylinderCorners(gauge, add(gauge, axis, 90), 30) });
  if (motion.part_corners_mm.length) list.push({ name: 'part', link: 0, kind: 'part', corners: motion.part_corners_mm });
  list.push({ name: 'tool', link: motion.joints.length, kind: 'tool', corners: [gauge, add(gauge, axis, -length)] });
  return list;
}

const seen = ([x, y, z]) => [(y - x) * -COS, (x + y) * -SIN - z];

/** The hull of points in the plane, in order (Andrew's chain). */
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turn = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1 && turn(chain.at(-2), chain.at(-1), p) <= 0) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return sorted.length < 3 ? sorted : [...half(sorted), ...half(sorted.reverse())];
}

/** The part of the page: a picture, a slider, and the values of the joints. */
export class MachinePicture {
  constructor(motion) {
    Object.assign(this, { motion, solids: solids(motion) });
    this.drawing = picture(WIDTH, HEIGHT, `The axes of ${motion.machine}: table, part, tool and spindle, seen from the side and above`);
    this.drawing.classList.add('axes');
    this.fit();
    this.shapes = this.solids.map(({ kind, name }) => svg(kind === 'tool' ? 'polyline' : 'polygon', { class: `solid ${kind}`, 'data-name': name }));
    this.drawing.append(...this.shapes);
    this.slider = html('input', { id: 'machine-time', type: 'range', min: 0, max: motion.time_s.length - 1, value: 0, 'aria-label': 'Time of the program' });
    this.slider.addEventListener('input', () => this.set(Number(this.slider.value)));
    this.words = html('p', { class: 'soft', id: 'machine-where' });
    this.root = html('div', { class: 'machine' }, this.drawing, this.slider, this.words);
    this.set(0);
  }

  /** To a time that was chosen elsewhere. */
  go(time) {
    this.slider.value = time;
    this.set(time);
  }

  values(time) {
    return this.motion.joints.map((joint) => joint.values[time]);
  }

  corners(solid, values) {
    return solid.corners.map((p) => seen(placed(this.motion, values, solid.link, p)));
  }

  /** One scale for the whole program. */
  fit() {
    const count = this.motion.time_s.length, step = Math.max(1, Math.floor(count / LOOKS));
    const all = [];
    for (let k = 0; k < count; k += step) for (const solid of this.solids) all.push(...this.corners(solid, this.values(k)));
    const low = [0, 1].map((k) => all.reduce((m, p) => Math.min(m, p[k]), Infinity)), high = [0, 1].map((k) => all.reduce((m, p) => Math.max(m, p[k]), -Infinity));
    const scale = Math.min((WIDTH - 2 * MARGIN) / (high[0] - low[0] || 1), (HEIGHT - 2 * MARGIN) / (high[1] - low[1] || 1));
    this.onPage = (p) => [WIDTH / 2 + scale * (p[0] - (low[0] + high[0]) / 2), HEIGHT / 2 + scale * (p[1] - (low[1] + high[1]) / 2)];
  }

  set(time) {
    const values = this.values(time);
    this.solids.forEach((solid, k) => {
      const points = this.corners(solid, values).map(this.onPage);
      this.shapes[k].setAttribute('points', (solid.kind === 'tool' ? points : hull(points)).map((p) => p.map((x) => x.toFixed(1)).join(',')).join(' '));
    });
    const { joints, time_s: times, cutting } = this.motion;
    const words = joints.map((joint, k) => `${joint.name} ${values[k].toFixed(joint.unit === 'mm' ? 1 : 2)} ${joint.unit}`).join(', ');
    this.words.textContent = `${format.plain(times[time], 4)} s, ${cutting[time] ? 'cutting' : 'on a link'}: ${words}`;
    this.slider.setAttribute('aria-valuetext', this.words.textContent);
  }
}
