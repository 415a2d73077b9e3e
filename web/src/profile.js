// The half profile of the tool, to scale, with dimensions; below it its curvature on the same axis.
import { html, picture, svg } from './dom.js';
import * as format from './format.js';
import { Plot } from './plot.js';
import { outline, topOf } from './tool.js';

const WIDTH = 880, LEFT = 56, RIGHT = 24;

const line = (className, x1, y1, x2, y2, more) => svg('line', { class: className, x1, y1, x2, y2, ...more });
const text = (className, x, y, content, anchor = 'middle') => svg('text', { class: className, x, y, 'text-anchor': anchor }, content);

/** Dimension line with arrows at both ends. */
function span(x1, y1, x2, y2, label, at) {
  const arrows = { 'marker-start': 'url(#arrow)', 'marker-end': 'url(#arrow)' };
  return [line('dim', x1, y1, x2, y2, arrows), text('dim', at[0], at[1], label, at[2] ?? 'middle')];
}

function defs() {
  return svg('defs', {}, svg('marker', { id: 'arrow', viewBox: '0 0 8 8', refX: 7, refY: 4, markerWidth: 6, markerHeight: 6, orient: 'auto-start-reverse' },
    svg('path', { d: 'M0 1L8 4L0 7z', class: 'arrow' })));
}

const extremes = (flank) => {
  const least = flank.reduce((a, b) => (b[1] < a[1] ? b : a));
  const most = flank.reduce((a, b) => (b[1] > a[1] ? b : a));
  return { least, most };
};

class Drawing {
  constructor(tool) {
    const shape = outline(tool);
    this.tool = tool;
    this.shape = shape;
    const all = [...shape.tip, ...shape.flank, [tool.axis_length_mm, 0], ...tool.shank, ...tool.holder];
    this.z = [Math.min(...all.map((p) => p[0])), Math.max(...all.map((p) => p[0]))];
    const tallest = Math.max(...all.map((p) => p[1]));
    this.scale = Math.min((WIDTH - LEFT - RIGHT) / (this.z[1] - this.z[0]), 150 / tallest);
    this.base = 50 + tallest * this.scale;
    this.height = this.base + 88;
  }

  x(z) { return LEFT + (z - this.z[0]) * this.scale; }
  y(rho) { return this.base - rho * this.scale; }

  path(points, className, close) {
    const d = points.map(([z, rho], k) => `${k ? 'L' : 'M'}${this.x(z).toFixed(2)} ${this.y(rho).toFixed(2)}`).join('');
    return svg('path', { d: d + (close ? 'Z' : ''), class: className });
  }

  solid() {
    const { tip, flank, end } = this.shape;
    const around = [...tip, ...flank, ...end];
    const parts = [this.path([[around[0][0], 0], ...around, [around[around.length - 1][0], 0]], 'solid', true), this.path(around, 'outline thin'), this.path(flank, 'outline')];
    for (const profile of [this.tool.shank, this.tool.holder])
      if (profile.length) parts.push(this.path([[profile[0][0], 0], ...profile, [profile[profile.length - 1][0], 0]], 'solid above', true));
    return parts;
  }

  /** The diameter at a place of the flank: a leader from the axis to the profile, named above. */
  diameter([z, rho], name, anchor) {
    const x = this.x(z), y = this.y(rho);
    const at = Math.max(62, Math.min(WIDTH - 62, x));
    return [line('dim leader', x, this.base, x, y), svg('circle', { class: 'dot', cx: x, cy: y, r: 2.6 }),
      text('dim', at, y - 9, `${name} ⌀ ${format.length(2 * rho)}`, anchor)];
  }

  dimensions() {
    const { flank } = this.shape;
    const { least, most } = extremes(flank);
    const first = flank[0], last = flank[flank.length - 1];
    const below = this.base + 22, lowest = below + 30;
    const out = [line('centre', this.x(this.z[0]) - 14, this.base, this.x(this.z[1]) + 14, this.base)];
    const L = this.tool.axis_length_mm;
    out.push(line('dim leader', this.x(0), this.base, this.x(0), below + 5), line('dim leader', this.x(L), this.base, this.x(L), below + 5),
      ...span(this.x(0), below, this.x(L), below, `axis length L = ${format.length(L, 5)}`, [this.x(L / 2), below + 16]),
      text('dim', this.x(0), below + 16, 's = 0'), text('dim', this.x(L), below + 16, 's = L'));
    const tip = -this.tool.tip_radius_mm, top = topOf(this.tool);
    out.push(...[tip, top].map((z) => line('dim leader', this.x(z), this.base, this.x(z), lowest + 5)), ...span(this.x(tip), lowest, this.x(top), lowest, '', [0, 0]),
      text('dim', this.x((tip + top) / 2), lowest + 16, `length ${format.length(top - tip, 5)} ${this.tool.shank.length ? 'with its shank' : 'without a shank'}, tip R ${format.length(this.tool.tip_radius_mm)}`));
    const near = (a, b) => Math.abs(this.x(a[0]) - this.x(b[0])) < 150;
    out.push(...this.diameter(most, 'largest'));
    if (!near(least, most)) out.push(...this.diameter(least, 'smallest'));
    for (const end of [first, last]) if (!near(end, most) && !near(end, least)) out.push(...this.diameter(end, ''));
    return out;
  }

  draw() {
    const { least, most } = extremes(this.shape.flank);
    return picture(WIDTH, this.height, `Half profile of the tool: axis length ${format.length(this.tool.axis_length_mm)}, diameter from ${format.length(2 * least[1])} to ${format.length(2 * most[1])}`,
      defs(), ...this.solid(), ...this.dimensions());
  }
}

/** The range of most values and 0: a spike at an end of the flank must not flatten the rest. */
function usual(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  const reach = 0.5 * (at(0.95) - at(0.05));
  return [Math.min(0, Math.max(sorted[0], at(0.05) - reach)), Math.max(0, Math.min(sorted[sorted.length - 1], at(0.95) + reach))];
}

/** Curvature of the meridian over z, lined up with the drawing above it. */
function curvature(drawing) {
  const points = drawing.tool.profile.filter(([, , , k]) => k !== null).map(([, z, , k]) => [z, 1000 * k]);
  if (points.length < 2) return null;
  const [low, high] = usual(points.map((p) => p[1]));
  const margin = 0.08 * (high - low) || 1;
  const drawn = LEFT + (drawing.z[1] - drawing.z[0]) * drawing.scale;
  const plot = new Plot({ width: WIDTH, height: 140, left: LEFT, right: WIDTH - drawn, x: drawing.z, y: [low - margin, high + margin],
    xName: 'z along the axis from the tip, mm', yName: 'curvature, 1/m', xCount: 8, yCount: 4,
    title: `Curvature of the profile from ${format.plain(low)} to ${format.plain(high)} per metre; positive is convex` });
  plot.curve(points, 'curve main');
  return plot.root;
}

export function profile(tool) {
  const drawing = new Drawing(tool);
  const family = tool.family === 'spline' ? 'free profile (spline)' : tool.family;
  return html('div', {}, html('p', { class: 'soft' }, `${family}${tool.name && tool.name !== tool.family ? `, “${tool.name}”` : ''}. Drawn to scale as it is ground; the heavy line cuts. Positive curvature is convex. tool.dxf holds the exact profile.`),
    html('div', { class: 'scroll', tabindex: '0', role: 'group', 'aria-label': 'Drawing of the profile' }, drawing.draw(), curvature(drawing)));
}

/** How stiff it is, and what it is held by. */
export function toolFacts(tool, summary) {
  const facts = [], fact = (name, value, key) => facts.push(html('dt', {}, name), html('dd', key ? { 'data-key': key, 'data-value': JSON.stringify(summary[key] ?? null) } : {}, value));
  const shape = (profile) => `${format.length(profile[profile.length - 1][0] - profile[0][0])} long, ⌀ ${format.length(2 * Math.max(...profile.map(([, r]) => r)))}, from z = ${format.length(profile[0][0])} on`;
  if (typeof summary?.slenderness === 'number') {
    fact('Slenderness', `${format.plain(summary.slenderness)}: bends as a cylinder of ⌀ ${format.length(summary.equivalent_diameter)}, length ${format.length(summary.slenderness * summary.equivalent_diameter)}`, 'slenderness');
    fact('Tip deflection', `${format.plain(summary.tip_deflection_um_per_100N)}\u00a0µm under 100 N across the tip, in cemented carbide`, 'tip_deflection_um_per_100N');
  }
  const concave = tool.profile.reduce((least, [, , , k]) => (k !== null && k < least ? k : least), -1e-6);
  fact('Smallest concave R', concave < -1e-6 ? `${format.length(-1 / concave)}: the grinding wheel must be smaller` : 'none: any grinding wheel');
  fact('Shank', tool.shank.length ? shape(tool.shank) : 'not given');
  fact('Holder', tool.holder.length ? shape(tool.holder) : 'not given');
  return html('dl', { id: 'tool-facts' }, ...facts);
}
