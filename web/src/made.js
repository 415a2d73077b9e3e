// Where the result comes from, and what the program had to say about it.
import { html } from './dom.js';
import * as format from './format.js';

function list(entries) {
  return html('dl', {}, ...entries.flatMap(([name, ...value]) => [html('dt', {}, name), html('dd', {}, ...value)]));
}

export function made({ view, summary, verify }, program) {
  const entries = [];
  if (view) entries.push(['Command', html('code', {}, view.command)]);
  const programs = [view ? `computed by ${view.program}` : null, `page by ${program}`].filter(Boolean);
  entries.push(['Program', programs.join(', ')]);
  if (summary) {
    entries.push(['Path', `${summary.strips} strip${summary.strips === 1 ? '' : 's'}, ${summary.poses} poses, joined within ${format.error(summary.chord_bound)} of the motion`]);
    entries.push(['Target', `diagonal ${format.length(summary.diagonal)}; errors relative to it: overcut ${format.plain((verify?.overcut_mm ?? summary.overcut) / summary.diagonal, 2)}`]);
  }
  if (view) entries.push(['Part', `${view.part}, target ${view.faces}`]);
  const notes = summary?.notes ?? [];
  if (notes.length) entries.push(['Notes', html('ul', {}, ...notes.map((note) => html('li', {}, note)))]);
  return html('div', {}, list(entries),
    html('p', { class: 'soft' }, 'All lengths are in millimetres. The error is the signed distance between the target and what the tool leaves: minus where it cuts too deep, plus where material is left. It comes from tool, poses and part alone, not from the planner.'));
}
