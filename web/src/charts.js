// Histogram of the error, and what happens along the path.
import { colourAt, css, SPANS } from './colours.js';
import { html, svg } from './dom.js';
import * as format from './format.js';
import { Plot } from './plot.js';

/** Micrometres or millimetres for a chart whose largest value is this. */
const scaleOf = (mm) => (mm < 1 ? { factor: 1000, unit: 'µm' } : { factor: 1, unit: 'mm' });

export function histogram(verify) {
  const { edges_mm: edges, area_mm2: areas } = verify.histogram;
  const total = areas.reduce((sum, area) => sum + area, 0);
  if (!areas.length || !(total > 0)) return html('p', { class: 'soft' }, 'No area was measured.');
  const { factor, unit } = scaleOf(edges[edges.length - 1]);
  const shares = areas.map((area) => (100 * area) / total);
  const top = Math.max(...shares) * 1.12;
  const plot = new Plot({ x: [edges[0] * factor, edges[edges.length - 1] * factor], y: [0, top], height: 230, top: 22,
    xName: `signed error, ${unit}  (− gouge, + excess material)`, yName: 'share of the area, %', xCount: 8,
    title: `Histogram of the signed error: ${format.percent(verify.coverage)} of the whole face${typeof verify.coverage_reachable === 'number' ? ` (${format.percent(verify.coverage_reachable)} of the accessible area)` : ''} lies within the tolerance of ${format.tolerance(verify.tolerance_mm)}` });
  const t = verify.tolerance_mm;
  shares.forEach((share, k) => {
    const middle = 0.5 * (edges[k] + edges[k + 1]);
    const open = k === 0 ? -3 : k + 1 === shares.length ? 3 : middle / t;
    plot.bar(edges[k] * factor, edges[k + 1] * factor, share, css(colourAt(open, SPANS[0])));
  });
  for (const side of [-1, 1]) {
    const x = plot.px(side * t * factor);
    plot.root.append(svg('line', { class: 'limit', x1: x, x2: x, y1: plot.top, y2: plot.bottom }),
      svg('text', { class: 'limit', x, y: plot.top - 6, 'text-anchor': 'middle' }, side < 0 ? '− tolerance' : '+ tolerance'));
  }
  return html('div', {}, plot.root, html('p', { class: 'soft' }, 'The first and the last bar also hold all larger errors.'));
}

/** [travel over all strips shown, ...values] of every place. */
function along(path, pick) {
  const out = [];
  let before = 0;
  for (const strip of path.shown()) {
    strip.places.t.forEach((t, k) => out.push([before + strip.travelOf(t), ...pick(strip.places, k)]));
    before += strip.length;
    out.push([before, null, null]);
  }
  return out;
}

const extreme = (points, at, choose, otherwise) => {
  const values = points.map((p) => p[at]).filter((v) => v !== null && v !== undefined);
  return values.length ? choose(...values) : otherwise;
};

function errorChart(path, tolerance) {
  const points = along(path, (p, k) => [p.lowest_f_mm[k], p.highest_f_mm[k]]);
  const low = Math.min(-1.25 * tolerance, extreme(points, 1, Math.min, 0));
  const high = Math.max(1.25 * tolerance, extreme(points, 2, Math.max, 0));
  const { factor, unit } = scaleOf(tolerance);
  // A single place that nothing reached must not flatten all others.
  const most = 3.2 * tolerance;
  const y = [Math.max(low * 1.06, -most) * factor, Math.min(high * 1.06, most) * factor];
  const plot = new Plot({ x: [0, path.total() || 1], y, xName: 'travel of the middle of the tool axis, mm', yName: `error, ${unit}`,
    title: `Error of the machined face along the path, from ${format.error(extreme(points, 1, Math.min, 0))} to ${format.error(extreme(points, 2, Math.max, 0))}` });
  const scaled = points.map(([x, a, b]) => [x, a === null ? null : a * factor, b === null ? null : b * factor]);
  plot.band(scaled, 'band');
  plot.curve(scaled.map(([x, , b]) => [x, b]), 'curve under');
  plot.curve(scaled.map(([x, a]) => [x, a]), 'curve over');
  plot.limit(tolerance * factor, '+ tolerance: excess material');
  plot.limit(-tolerance * factor, '− tolerance: gouge', 11);
  return plot;
}

function regularityChart(path) {
  const points = along(path, (p, k) => [p.largest_c[k] ?? 99, 0]);
  const largest = extreme(points, 1, Math.max, 0);
  const top = Math.min(2, Math.max(1.15, 1.1 * largest));
  const plot = new Plot({ x: [0, path.total() || 1], y: [0, top], height: 150, xName: 'travel of the middle of the tool axis, mm', yName: 'axial slip (1: plunge)', yCount: 3,
    title: `Axial slip along the path: the largest |c| is ${format.plain(largest)}; at 1 the tool plunges` });
  plot.curve(points, 'curve main');
  plot.limit(1, 'plunges');
  return plot;
}

function clearanceChart(path) {
  const points = along(path, (p, k) => [p.clearance_mm[k], 0]);
  const low = Math.min(0, extreme(points, 1, Math.min, 0)), high = extreme(points, 1, Math.max, 1);
  const plot = new Plot({ x: [0, path.total() || 1], y: [low * 1.1, Math.max(high * 1.1, 1e-3)], height: 150, xName: 'travel of the middle of the tool axis, mm',
    yName: 'clearance, mm', yCount: 3, title: `Clearance of shank, holder and fixtures along the path, at least ${format.length(extreme(points, 1, Math.min, 0))}` });
  plot.curve(points, 'curve main');
  plot.limit(0, 'touches');
  return plot;
}

/** Charts over the travel of what is shown, with a cursor; `go` is called with a share from 0 to 1. */
export class PathCharts {
  constructor(holder, path, tolerance, go) {
    Object.assign(this, { holder, path, tolerance, go });
    this.rebuild();
  }

  rebuild() {
    this.plots = [errorChart(this.path, this.tolerance), regularityChart(this.path)];
    if (this.path.shown().length && this.path.shown().every((strip) => strip.places.clearance_mm)) this.plots.push(clearanceChart(this.path));
    this.cursors = this.plots.map((plot) => {
      const cursor = svg('line', { class: 'cursor', y1: plot.top, y2: plot.bottom });
      plot.root.append(cursor);
      plot.root.addEventListener('click', (event) => this.clicked(plot, event));
      return cursor;
    });
    this.holder.replaceChildren(...this.plots.map((plot) => plot.root));
  }

  clicked(plot, event) {
    const box = plot.root.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * plot.width;
    this.go(Math.max(0, Math.min(1, (x - plot.left) / (plot.right - plot.left))));
  }

  move(share) {
    this.plots.forEach((plot, k) => {
      const x = plot.px(share * (this.path.total() || 1));
      this.cursors[k].setAttribute('x1', x);
      this.cursors[k].setAttribute('x2', x);
    });
  }
}
