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
    entries.push(['Path', `${summary.strips} pass${summary.strips === 1 ? '' : 'es'}, ${summary.poses} CL points, chord error ${format.error(summary.chord_bound)}`]);
    entries.push(['Machined face', `diagonal ${format.length(summary.diagonal)}; gouge divided by it ${format.plain((verify?.overcut_mm ?? summary.overcut) / summary.diagonal, 2)}`]);
  }
  if (view) entries.push(['Part', `${view.part}, machined ${view.faces}`]);
  const notes = summary?.notes ?? [];
  if (notes.length) entries.push(['Notes', html('ul', {}, ...notes.map((note) => html('li', {}, note)))]);
  return html('div', {}, list(entries),
    html('p', { class: 'soft' }, 'All lengths are in millimetres. The error is the signed distance from the machined face to the surface that the tool leaves: minus is a gouge, plus is excess material. It is computed from tool, CL points and part alone, without the planner’s figures.'));
}
