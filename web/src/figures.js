// The figures with what is required, and under each of them why it does not pass.
import { html } from './dom.js';
import * as format from './format.js';
import { capital, cautions, earlier, nameOf, reasons } from './verdict.js';

/** What is required: from the view, else from the summary. */
export function asked({ view, verify, summary }) {
  return {
    tolerance: verify?.tolerance_mm ?? view?.tolerance_mm ?? summary?.tolerance ?? null,
    coverage: view?.least_coverage ?? summary?.least_coverage ?? null,
  };
}

/** Over the poses that are there, else over the whole motion of the fit. */
function largestC({ view, summary }) {
  const along = (view?.strips ?? []).flatMap((strip) => strip.places.largest_c);
  if (along.length) return along.includes(null) ? 99 : Math.max(...along);
  return typeof summary?.largest_c === 'number' ? summary.largest_c : null;
}

/** Which faces are entered, the deepest first. */
export function enteredFaces(verify) {
  return verify.faces.filter((f) => !f.target && f.overcut_mm > verify.tolerance_mm).sort((a, b) => b.overcut_mm - a.overcut_mm);
}

function otherFaces(verify) {
  const entered = enteredFaces(verify);
  const named = entered.slice(0, 3).map((f) => `${f.face} ${format.error(f.overcut_mm)}`).join(', ');
  const more = entered.length > 3 ? ` and ${entered.length - 3} more` : '';
  return `deepest cut into any face that is not machined${named ? `: ${named}${more}` : ''}`;
}

const at = (point) => `(${point.map((v) => format.plain(v, 4)).join(', ')})`;

/** Both shares, side by side: neither says how good the face is without the other. */
function shareRows(verify, { coverage }) {
  const tolerance = format.tolerance(verify.tolerance_mm);
  const list = [{ key: 'coverage', figure: 'coverage', name: 'Finished, whole face', text: format.percent(verify.coverage),
    hint: `share of the whole face within ±${tolerance}, accessible or not` }];
  if (!('coverage_reachable' in verify)) return list;
  const least = coverage === null ? '' : `≥ ${format.tick(100 * coverage)}\u00a0%`;
  list.push({ key: 'coverage_reachable', figure: 'coverage_reachable', name: 'Finished, accessible area', text: format.percent(verify.coverage_reachable),
    wanted: least, hint: `${format.percent(verify.reachable_share)} of the face is accessible to a ball of radius ${format.plain(verify.reach_radius_mm)} mm` });
  if (typeof verify.coverage_reachable_bound === 'number')
    list.push({ key: 'coverage_reachable_bound', figure: 'coverage_bound', name: 'Finished, proved', text: format.percent(Math.floor(1e4 * verify.coverage_reachable_bound) / 1e4),
      wanted: least, hint: 'share of the accessible area that is proved to be finished' });
  return list;
}

function depthRows(verify) {
  const tolerance = `≤ ${format.tolerance(verify.tolerance_mm)}`;
  const row = (key, name, wanted, hint) => ({ key, name, text: format.error(verify[key]), wanted, hint, ...(wanted ? { figure: key } : {}) });
  const list = [row('overcut_mm', 'Gouge', tolerance, 'deepest cut found into the machined face')];
  if (verify.depth === 'proved') list.push(row('overcut_bound_mm', 'Gouge, proved', tolerance, 'the machined face is nowhere cut deeper, up to its borders'));
  list.push(row('gouge_mm', 'Gouge of other faces', tolerance, otherFaces(verify)));
  if (verify.depth === 'proved') list.push(row('gouge_bound_mm', 'Gouge of other faces, proved', tolerance, 'no other face is anywhere cut deeper'));
  else list.push(row('sampling_bound_mm', 'Between the samples', '', `between the ${verify.samples.toLocaleString('en')} samples a gouge may be deeper by at most this`));
  if (verify.allowance_mm > 0)
    list.unshift({ key: 'allowance_mm', name: 'Left on purpose', value: verify.allowance_mm, text: format.length(verify.allowance_mm, 3),
      hint: 'requested; gouge and excess are measured from the faces moved out by this' });
  const { buried = [] } = verify;
  list.push({ key: 'buried.count', figure: 'buried', asks: true, name: 'Passes inside the material', value: buried.length, text: buried.length ? String(buried.length) : 'none',
    hint: buried.length ? `pass ${buried[0].strip}, near ${at(buried[0].point)}` : 'no pass runs inside a solid or behind its sheet' });
  list.push(row('undercut_covered_mm', 'Excess material, where the tool passes', '', 'most material left on the part of the face that a pass goes over, finished or not'),
    row('undercut_mm', 'Excess material, anywhere', '', 'most material left anywhere on the machined face'),
    row('rms_mm', 'RMS error', '', 'root mean square of the error where the tool passes over the face'));
  return list;
}

const AGAINST = { target: 'the machined face', part: 'other faces', fixture: 'fixtures' };

/** Shank, holder and flank against what they must keep clear of: the judge says of each whether it is kept. */
function clearanceRows(verify) {
  return (verify.clearance ?? []).map((f) => {
    const enters = f.clearance_mm < 0;
    return { key: `clearance.${f.body}.${f.against}`, figure: 'clearance', name: `${capital(f.body)} to ${AGAINST[f.against] ?? f.against}`, value: f.clearance_mm,
      text: format.error(f.clearance_mm), wanted: `≥ ${format.error(f.required_mm)}`,
      state: f.kept ? 'pass' : 'fail',
      hint: `${enters ? 'collides with ' : 'nearest: '}${f.obstacle}${f.point ? ` at ${at(f.point)}` : ''}${f.strip ? `, pass ${f.strip}, CL point ${format.plain(f.t + 1, 4)}` : ''}; accurate to ±${format.error(f.bound_mm)}` };
  });
}

function bendRows(summary) {
  const bends = summary?.bend_radius;
  if (!bends) return [];
  const least = summary.least_bend_radius;
  const radius = (mm) => (mm === null || mm > 1e6 ? 'straight' : format.length(mm, 3));
  return [['tip', 'of the tip'], ['holder_end', 'of the holder end']].map(([end, words]) => ({ key: `bend_radius.${end}`, figure: 'bend_radius', name: `Smallest path radius ${words}`,
    value: bends[end], text: radius(bends[end]), wanted: least === undefined ? '' : `≥ ${format.length(least, 3)}`, hint: 'smallest radius of curvature of its path',
    ...(least !== undefined ? { state: bends[end] === null || bends[end] >= least ? 'pass' : 'fail' } : {}) }));
}

function cavityRows(cavity) {
  if (!cavity) return [];
  const done = cavity.layers.filter((layer) => layer.status === 'done').length;
  return [{ key: 'engagement', figure: 'engagement', name: 'Engagement, planned', value: cavity.engagement, text: `${format.plain(cavity.engagement, 4)}°`,
    wanted: `≤ ${format.plain(cavity.most_engagement)}°`, hint: 'largest engagement angle of the planned cycles' },
  { key: 'cycles', figure: 'cycles', asks: true, name: 'Layers', value: done, text: `${done} of ${cavity.layers.length}`, wanted: 'all',
    hint: `${cavity.layers.reduce((sum, layer) => sum + layer.cycles, 0)} cycles; layers that are complete` }];
}

/** The whole program in the judge's stock: one verdict over three figures. */
function stockRows(stock, cavity) {
  if (!stock) return [];
  const list = [{ key: 'stock.engagement_deg', figure: 'stock', asks: true, name: 'Engagement, simulated', value: stock.engagement_deg, text: `${format.plain(stock.engagement_deg, 4)}°`,
    wanted: cavity ? `≤ ${format.plain(cavity.most_engagement)}°${stock.resolution_deg ? ` + ${format.plain(stock.resolution_deg, 2)}°` : ''}` : '',
    hint: 'in the stock simulation; the second figure of the limit is the resolution of its cells. The verdict of the whole simulation stands in this row' }];
  if (typeof stock.uncut_mm === 'number') list.push({ key: 'stock.uncut_mm', name: 'Material left between the sides', value: stock.uncut_mm, text: format.length(stock.uncut_mm, 3),
    hint: stock.uncut_mm > 0 && stock.uncut_point ? `longest stretch of material on a line from ${at(stock.uncut_point)} to the middle of the cavity` : 'no material is left between them' });
  if (typeof stock.entered_mm === 'number') list.push({ key: 'stock.entered_mm', name: 'Gouge, simulated', value: stock.entered_mm, text: format.error(stock.entered_mm),
    hint: 'deepest place where the simulated stock lies below a checked face' });
  list.push({ key: 'stock.left_mm3', name: 'Stock left', value: stock.left_mm3, text: `${format.plain(stock.left_mm3 / 1000, 4)}\u00a0cm³`,
    hint: `of ${format.plain(stock.before_mm3 / 1000, 4)} cm³ of the blank that lie in the range of the tool` });
  return list;
}

function toolRows(files) {
  const out = [], tool = files.view?.tool;
  if (tool && 'legitimate' in tool)
    out.push({ key: 'legitimate', figure: 'legitimate', asks: true, name: 'Tool profile', value: tool.legitimate, text: tool.legitimate ? 'valid' : 'not valid',
      ...(tool.legitimate ? {} : { state: 'fail' }), hint: tool.reason || 'the profile can be ground, and its flank cuts along its whole length' });
  const c = largestC(files);
  if (c !== null)
    out.push({ key: 'largest_c', name: 'Axial slip, largest |c|', value: c, text: format.plain(c), wanted: '< 1', ...(c < 1 ? {} : { state: 'warn' }),
      hint: 'how much the tool moves along its own axis where it touches; at 1 it plunges' });
  return out;
}

/** Gives each reason to the row that is about its figure and fails, or a row of its own: none is without one. */
function attach(list, said, state) {
  for (const { figure, text } of said) {
    // A row that the judge has found kept is about something else.
    const about = list.filter((row) => row.figure === figure && row.state !== 'pass');
    let row = about.find((one) => one.state === 'fail') ?? about[0];
    if (!row) list.push(row = { key: `reason.${figure}`, figure, name: nameOf(figure), value: null, text: '' });
    if (row.state !== 'fail') row.state = state;
    (row.why ??= []).push({ text, state });
  }
}

/** Rows { key, figure, name, value, text, wanted, state, hint, why }; state is pass, fail, warn or nothing, by the judge's word. */
export function rows(files) {
  const { verify, summary } = files;
  const list = verify ? [...shareRows(verify, asked(files)), ...depthRows(verify), ...clearanceRows(verify)] : [];
  for (const row of list) row.value ??= verify[row.key];
  list.push(...bendRows(summary), ...cavityRows(summary?.cavity), ...stockRows(verify?.stock, summary?.cavity), ...toolRows(files));
  attach(list, reasons(files), 'fail');
  attach(list, earlier(files).map(({ figure, text }) => ({ figure, text: `when the result was made: ${text}` })), 'warn');
  attach(list, cautions(files), 'warn');
  // What is asked and has no reason against it is kept; a file without reasons says nothing.
  if (Array.isArray(verify?.reasons))
    for (const row of list) if (row.figure && (row.wanted || row.asks)) row.state ??= 'pass';
  return list;
}

const MARKS = { pass: ['✓', 'pass'], fail: ['✗', 'fail'], warn: ['!', 'look'] };

function mark(state) {
  if (!state) return '';
  const [sign, word] = MARKS[state];
  return html('span', { class: `mark ${state}` }, html('span', { 'aria-hidden': 'true' }, sign), ` ${word}`);
}

export function table(list) {
  const body = list.flatMap((row) => [
    html('tr', { 'data-figure': row.figure, 'data-state': row.state },
      html('th', { scope: 'row', title: row.hint }, row.name),
      html('td', { class: 'number', 'data-key': row.key, 'data-value': JSON.stringify(row.value ?? null) }, row.text),
      html('td', { class: 'number soft' }, row.wanted ?? ''),
      html('td', {}, mark(row.state))),
    html('tr', { class: 'more' }, html('td', { colspan: 4 }, row.hint ? html('small', {}, row.hint) : null,
      ...(row.why ?? []).map(({ text, state }) => html('em', { class: `why ${state}` }, text)))),
  ]);
  const head = ['Figure', 'Value', 'Required', ''].map((name, k) =>
    html('th', { scope: 'col', class: k === 1 || k === 2 ? 'number' : '' }, name || html('span', { class: 'sr' }, 'Verdict')));
  return html('table', {}, html('thead', {}, html('tr', {}, ...head)), html('tbody', {}, ...body));
}
