// A cavity's program: what was planned cycle by cycle (summary.json), and what the judge's stock measured (verify.json).
import { html } from './dom.js';
import * as format from './format.js';
import { Plot } from './plot.js';

const WIDE = { width: 420, height: 150, yCount: 4 };

/** Highest value with some room. */
const above = (values, least = 0) => 1.12 * Math.max(1e-9, least, ...values);

/** Sums of what came before and of this. */
function running(values) {
  let sum = 0;
  return values.map((value) => (sum += value));
}

function layerTable(layers) {
  const columns = ['Layer', 'Cycles', 'Cutting', 'Return', 'Sides', 'Links', 'Engagement', 'Removed'];
  const head = columns.map((name, k) => html('th', { scope: 'col', class: k ? 'number' : '' }, name));
  const number = (text) => html('td', { class: 'number' }, text);
  const body = layers.map((layer, k) =>
    html('tr', {},
      html('th', { scope: 'row' }, `${k + 1}`, layer.status === 'done' ? null : html('small', {}, layer.status)),
      number(String(layer.cycles)), ...['fronts', 'backs', 'sides', 'links'].map((name) => number(format.length(layer[name]))),
      number(`${format.plain(Math.max(layer.front_engagement, layer.back_engagement), 4)}°`), number(`${format.plain(layer.volume / 1000, 4)} cm³`)));
  return html('table', {}, html('thead', {}, html('tr', {}, ...head)), html('tbody', {}, ...body));
}

/** One value a cycle, all layers one after the other; the first cycle of a layer has no line from the one before. */
function byCycle(layers, value) {
  const points = [];
  let count = 0;
  for (const layer of layers) {
    if (count) points.push([count + 0.5, null]);
    layer.cycle_engagement.forEach((_, k) => points.push([++count, value(layer, k)]));
  }
  return points;
}

function plannedEngagement({ layers, most_engagement: limit }) {
  const points = byCycle(layers, (layer, k) => layer.cycle_engagement[k]);
  const plot = new Plot({ ...WIDE, x: [0, points[points.length - 1][0]], y: [0, above([], limit)], xName: 'cycle', yName: 'planned, degrees',
    title: `Largest engagement of each cycle, as planned; the limit is ${format.plain(limit)} degrees` });
  plot.curve(points, 'curve main');
  plot.limit(limit, 'limit');
  return plot.root;
}

function removalRate({ layers }) {
  const points = byCycle(layers, (layer, k) => (layer.cycle_way[k] > 0 ? layer.cycle_volume[k] / layer.cycle_way[k] : null));
  const rates = points.map(([, y]) => y ?? 0);
  const plot = new Plot({ ...WIDE, x: [0, points[points.length - 1][0]], y: [0, above(rates)], xName: 'cycle', yName: 'removed, mm³/mm',
    title: `Removed volume per millimetre of path in each cycle, at most ${format.plain(Math.max(...rates))} mm³` });
  plot.curve(points, 'curve main');
  return plot.root;
}

function measured(stock, limit) {
  const way = running(stock.strip_way_mm).map((mm) => mm / 1000);
  const plot = new Plot({ ...WIDE, x: [0, way[way.length - 1] || 1], y: [0, above(stock.strip_engagement_deg, limit)], xName: 'path length, m', yName: 'simulated, degrees',
    title: `Largest engagement of each move in the stock simulation, at most ${format.plain(stock.engagement_deg, 4)} degrees` });
  // A bar as wide as its strip is long: cutting and return moves take turns.
  way.forEach((x, k) => plot.bar(k ? way[k - 1] : 0, x, stock.strip_engagement_deg[k], 'var(--accent)'));
  plot.limit(limit, 'limit');
  return plot.root;
}

function leftOver(stock) {
  const way = running(stock.strip_way_mm).map((mm) => mm / 1000), taken = running(stock.strip_volume_mm3);
  const points = way.map((x, k) => [x, (stock.before_mm3 - taken[k]) / 1000]);
  const plot = new Plot({ ...WIDE, x: [0, way[way.length - 1] || 1], y: [0, above([stock.before_mm3 / 1000])], xName: 'path length, m', yName: 'left, cm³',
    title: `Stock left along the path, from ${format.plain(stock.before_mm3 / 1000)} cm³ to ${format.plain(stock.left_mm3 / 1000)} cm³` });
  plot.curve([[0, stock.before_mm3 / 1000], ...points], 'curve main');
  return plot.root;
}

export function cavityCharts(cavity, stock) {
  const planned = cavity.layers.some((layer) => layer.cycles > 0) ? [plannedEngagement(cavity), removalRate(cavity)] : [];
  const replayed = stock && stock.strip_way_mm.length ? [measured(stock, cavity.most_engagement), leftOver(stock)] : [];
  const text = `Path length ${format.length(cavity.way)}, ${format.plain(cavity.minutes)} min.`;
  return html('div', {}, html('p', { class: 'soft' }, text), layerTable(cavity.layers), html('div', { class: 'charts' }, ...planned, ...replayed));
}
