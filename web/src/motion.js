// What the machine does over time (docs/schema/motion.md): each joint, the feed, and how near to their limits the joints are.
import { html } from './dom.js';
import * as format from './format.js';
import { MachinePicture } from './machine.js';
import { Plot } from './plot.js';

const NARROW = { width: 420, height: 130, yCount: 3 };

/** Lowest and highest value with some room; a joint that stands still has a scale all the same. */
function span(values) {
  const low = Math.min(...values), high = Math.max(...values);
  const room = 0.08 * (high - low) || 0.5;
  return [low - room, high + room];
}

function jointChart(joint, time) {
  const [low, high] = span(joint.values);
  const plot = new Plot({ ...NARROW, x: [0, time[time.length - 1] || 1], y: [low, high], xName: 'time, s', yName: `${joint.name}, ${joint.unit}`,
    title: `Joint ${joint.name} over time, from ${format.plain(Math.min(...joint.values))} to ${format.plain(Math.max(...joint.values))} ${joint.unit}` });
  plot.curve(time.map((t, k) => [t, joint.values[k]]), 'curve main');
  for (const limit of [joint.low, joint.high]) if (limit !== null && limit > low && limit < high) plot.limit(limit, 'travel');
  return plot.root;
}

function feedChart({ time_s: time, feed_mm_min: feed, cutting }) {
  // Links run at the rapid, far beyond: the scale is that of the strips.
  const cut = feed.filter((value, k) => cutting[k]);
  const top = 1.15 * Math.max(1, ...cut);
  const plot = new Plot({ ...NARROW, x: [0, time[time.length - 1] || 1], y: [0, top], xName: 'time, s', yName: 'feed, mm/min',
    title: `Feed of the contact along the strips, at most ${format.plain(Math.max(0, ...cut))} mm/min` });
  plot.curve(time.map((t, k) => [t, cutting[k] ? feed[k] : null]), 'curve main');
  return plot.root;
}

function loadChart({ time_s: time, speed_share: share }) {
  const plot = new Plot({ ...NARROW, x: [0, time[time.length - 1] || 1], y: [0, 1.15], xName: 'time, s', yName: 'of the speed limit',
    title: `Largest share of its speed limit that a joint uses, at most ${format.percent(Math.max(0, ...share))}` });
  plot.curve(time.map((t, k) => [t, share[k]]), 'curve main');
  plot.limit(1, 'limit');
  return plot.root;
}

export function motionCharts(motion) {
  const minutes = (seconds) => (seconds < 60 ? `${format.plain(seconds, 3)} s` : `${format.plain(seconds / 60, 3)} min`);
  const text = `On ${motion.machine}: ${minutes(motion.duration_s)}, of which ${minutes(motion.cutting_s)} along the strips.`;
  return html('div', {}, html('p', { class: 'soft' }, text), new MachinePicture(motion).root,
    html('div', { class: 'charts' }, feedChart(motion), loadChart(motion), ...motion.joints.map((joint) => jointChart(joint, motion.time_s))));
}
