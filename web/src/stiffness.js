// What every step of stiffness costs: coverage and error of the tools that were tried, against their slenderness.
import { html, svg } from './dom.js';
import * as format from './format.js';
import { Plot } from './plot.js';

const WIDE = { width: 420, height: 170, xName: 'slenderness L:D (stiffer to the left)', yCount: 4 };

/** Errors as people read them beside a tolerance of this size. */
const unitOf = (tolerance) => (tolerance < 1 ? { factor: 1000, unit: 'µm' } : { factor: 1, unit: 'mm' });

/** Axis of the slenderness, with room for the dots at its ends. */
function range(steps) {
  const values = steps.map((step) => step.slenderness);
  const room = 0.06 * (Math.max(...values) - Math.min(...values)) || 0.5;
  return [Math.max(0, Math.min(...values) - room), Math.max(...values) + room];
}

const describe = (step) =>
  `L:D ${format.plain(step.slenderness)}: ${format.percent(step.coverage)} of the whole face finished${typeof step.coverage_reachable === 'number' ? `, ${format.percent(step.coverage_reachable)} of the accessible area` : ''}, gouge ${format.error(step.overcut)}, of other faces ${format.error(step.other_faces_overcut)}, ` +
  `rms ${format.error(step.rms)}, axis ${format.length(step.axis_length)}, largest radius ${format.length(step.largest_radius)}` +
  `${step.chosen ? ' (chosen)' : step.judged ? '' : ' (the planner’s estimate)'}`;

/** A dot for every tool: full where the judge measured, with a ring around the chosen one. */
function dots(plot, steps, value, className) {
  for (const step of steps) {
    const at = { cx: plot.px(step.slenderness), cy: plot.py(value(step)) };
    if (step.chosen) plot.root.append(svg('circle', { ...at, r: 6.5, class: 'ring' }));
    plot.root.append(svg('circle', { ...at, r: 3, class: `${className}${step.judged ? '' : ' estimate'}` }, svg('title', {}, describe(step))));
  }
}

/** The judged tools are one curve; estimates are dots beside it. */
const judged = (steps, value) => steps.filter((step) => step.judged).map((step) => [step.slenderness, value(step)]);

function coverageChart(steps) {
  const value = (step) => 100 * step.coverage;
  const low = Math.min(...steps.map(value));
  const plot = new Plot({ ...WIDE, x: range(steps), y: [Math.max(0, low - 0.1 * (100 - low)), 100], yName: 'of the whole face, %',
    title: `Finished area against the tool’s slenderness L:D, from ${format.plain(low)} to ${format.plain(Math.max(...steps.map(value)))} %` });
  plot.curve(judged(steps, value), 'curve main');
  dots(plot, steps, value, 'step');
  return plot.root;
}

function errorChart(steps, tolerance) {
  const { factor, unit } = unitOf(tolerance);
  const kinds = [{ name: 'gouge', class: 'over', value: (step) => factor * Math.max(step.overcut, step.other_faces_overcut) },
    { name: 'rms', class: 'under', value: (step) => factor * step.rms }];
  // A tool that cuts far too deep must not flatten all others.
  const top = Math.min(4 * tolerance * factor, 1.1 * Math.max(tolerance * factor, ...steps.flatMap((step) => kinds.map((kind) => kind.value(step)))));
  const plot = new Plot({ ...WIDE, x: range(steps), y: [0, top], yName: `gouge and RMS error, ${unit}`,
    title: 'Deepest gouge, of the machined or another face, and RMS error against the tool’s slenderness L:D' });
  for (const kind of kinds) {
    plot.curve(judged(steps, kind.value), `curve ${kind.class}`);
    dots(plot, steps, kind.value, `step ${kind.class}`);
  }
  plot.limit(tolerance * factor, 'tolerance');
  return plot.root;
}

/** `steps`: summary.stiffness, of at least two tools. */
export function stiffnessCharts(steps, tolerance) {
  const chosen = steps.find((step) => step.chosen);
  const estimates = steps.some((step) => !step.judged) ? ' Hollow dots are the planner’s estimates.' : '';
  const text = `${steps.length} tools were tried; the ring is the one that was chosen${chosen ? ` (L:D ${format.plain(chosen.slenderness)})` : ''}.${estimates}`;
  return html('div', {}, html('p', { class: 'soft' }, text), html('div', { class: 'charts' }, coverageChart(steps), errorChart(steps, tolerance)));
}
