// The operations of a wheel, as its plan tells them: each is a result of its own that can be looked at.
import { html } from './dom.js';
import { faceList } from './facelist.js';
import { seconds } from './format.js';

const KINDS = { rough: 'Roughing', side: 'Sides', floor: 'Floor', fillet: 'Root fillets', edge: 'Edges', rest: 'Rest' };
/** The name of its folder, "20-side". */
const folderOf = ({ folder }) => folder.split('/').pop();

/** [state, words] of an operation. */
function stateOf({ done, pass }) {
  if (!done) return ['fail', 'not done'];
  return pass ? ['pass', 'done'] : ['warn', 'below'];
}

function line(operation, shown, open) {
  const { id, kind, faces, tool, copies, seconds: spent, done, problem } = operation, [state, words] = stateOf(operation), name = KINDS[kind] ?? kind;
  const button = html('button', { type: 'button', class: 'operation', 'data-operation': id, 'aria-pressed': String(folderOf(operation) === shown), title: `Show the report of operation ${id}`, ...(done ? {} : { disabled: '' }) }, `${id} ${name}`);
  button.addEventListener('click', () => open(folderOf(operation)));
  return html('tr', {}, html('th', { scope: 'row' }, button), html('td', {}, faceList(faces)), html('td', {}, tool), html('td', {}, `${copies} ×`), html('td', {}, seconds(spent)),
    html('td', {}, html('span', { class: `mark ${state}`, title: problem ?? '' }, words), ...(problem ? [html('span', { class: 'soft problem' }, problem)] : [])));
}

/** What share of what is accessible is within the tolerance, by role. */
function finished(surface) {
  const open = surface.filter(({ open_mm2: area }) => area > 0);
  return open.map(({ role, open_mm2: area, within_mm2: within }) => `${role} ${((100 * within) / area).toFixed(1)} %`).join(' · ');
}

/** The table of a plan; `shown`: the folder whose report is shown; `open(folder)` shows another one, and the whole if it is empty. */
export function planTable({ operations = [], surface = [], pass }, shown, open) {
  const whole = html('button', { type: 'button', class: 'operation', 'data-operation': 'whole', 'aria-pressed': String(!shown) }, 'The whole');
  whole.addEventListener('click', () => open(''));
  const head = ['Operation', 'Faces', 'Tool', 'Copies', 'Time', 'State'].map((name) => html('th', { scope: 'col' }, name));
  return html('div', { class: 'plan' }, html('table', { 'aria-label': 'Operations of the wheel' }, html('thead', {}, html('tr', {}, ...head)), html('tbody', {}, ...operations.map((one) => line(one, shown, open)))),
    ...(pass === undefined ? [] : [html('p', { class: 'soft' }, whole, ` finished of what is accessible: ${finished(surface)}`)]));
}
