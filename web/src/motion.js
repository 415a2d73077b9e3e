// What the machine does over time (docs/schema/motion.md): each joint, the feed, and how near to their limits the joints are.
import { html } from './dom.js';
import * as format from './format.js';
import { MachinePicture } from './machine.js';
import { SeriesPlot } from './series.js';

const most = (values) => values.reduce((a, b) => Math.max(a, b), -Infinity);
const least = (values) => values.reduce((a, b) => Math.min(a, b), Infinity);

/** Lowest and highest value with some room; a joint that stands still has a scale all the same. */
function span(values) {
  const low = least(values), high = most(values);
  const room = 0.08 * (high - low) || 0.5;
  return [low - room, high + room];
}

function jointPlot(joint) {
  const limits = [joint.low, joint.high].filter((value) => value !== null).map((value) => ({ value, name: 'travel' }));
  return { values: joint.values, name: `${joint.name}, ${joint.unit}`, range: span(joint.values), limits,
    title: `Axis ${joint.name} over time, from ${format.plain(least(joint.values))} to ${format.plain(most(joint.values))} ${joint.unit}` };
}

function feedPlot({ feed_mm_min: feed, cutting }) {
  // Links run at the rapid, far beyond: the scale is that of the strips.
  const values = feed.map((value, k) => (cutting[k] ? value : null));
  const top = most(values.map((value) => value ?? 0));
  return { values, name: 'feed, mm/min', range: [0, 1.15 * Math.max(1, top)],
    title: `Feed of the contact along the passes, at most ${format.plain(top)} mm/min` };
}

function loadPlot({ speed_share: share }) {
  return { values: share, name: 'share of speed limit', range: [0, 1.15], limits: [{ value: 1, name: 'limit' }],
    title: `Share of its speed limit that the busiest axis uses, at most ${format.percent(Math.max(0, most(share)))}` };
}

/** The machine's motion beside the planned one: the control joins blocks in its own way. */
function offPlot({ off_path_mm: off, off_path_bound_mm: bound, cutting }) {
  const values = off.map((value, k) => (cutting[k] ? 1000 * value : null));
  return { values, name: 'deviation, µm', range: [0, 1200 * bound || 1], limits: [{ value: 1000 * bound, name: 'proved bound' }],
    title: `Deviation of the machine's motion from the planned one, at most ${format.plain(most(values.map((value) => value ?? 0)))} µm` };
}

/** What post has found against the program, and what it says nothing about. */
function programWords(verdict) {
  if (!verdict) return null;
  const { pass, reasons, cautions } = verdict;
  const item = (state) => ({ text }) => html('li', { class: state }, text);
  return html('ul', { class: 'said', id: 'program-words' },
    ...(reasons.length || !pass ? reasons.map(item('fail')) : [html('li', { class: 'pass' }, 'Links and axes meet the request.')]), ...cautions.map(item('warn')));
}

/** The picture of the axes, and the plots; who points at a plot sees the axes at that time. */
export class MotionCharts {
  constructor(motion, verdict) {
    const minutes = (seconds) => (seconds < 60 ? `${format.plain(seconds, 3)} s` : `${format.plain(seconds / 60, 3)} min`);
    const text = `On ${motion.machine}: ${minutes(motion.duration_s)}, of which ${minutes(motion.cutting_s)} cutting.`;
    const machine = new MachinePicture(motion);
    this.plots = [feedPlot(motion), loadPlot(motion), ...(motion.off_path_mm ? [offPlot(motion)] : []), ...motion.joints.map(jointPlot)].map((plot) => new SeriesPlot({
      ...plot, time: motion.time_s, pointed: (at) => machine.go(at) }));
    this.root = html('div', {}, html('p', { class: 'soft' }, text), programWords(verdict), machine.root,
      html('p', { class: 'soft' }, 'Drag across a chart to zoom in, double click for the whole program.'),
      html('div', { class: 'charts' }, ...this.plots.map((plot) => plot.root)));
  }

  paint() {
    for (const plot of this.plots) plot.paint();
  }
}
