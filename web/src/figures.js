// The figures with what was asked, the verdict, and the worst places.
import { html } from './dom.js';
import * as format from './format.js';

/** What was asked for: from the view, else from the summary. */
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
function enteredFaces(verify) {
  return verify.faces.filter((f) => !f.target && f.overcut_mm > verify.tolerance_mm).sort((a, b) => b.overcut_mm - a.overcut_mm);
}

function otherFaces(verify) {
  const entered = enteredFaces(verify);
  const named = entered.slice(0, 3).map((f) => `${f.face} ${format.error(f.overcut_mm)}`).join(', ');
  const more = entered.length > 3 ? ` and ${entered.length - 3} more` : '';
  return `deepest cut into any face that is not a target${named ? `: ${named}${more}` : ''}`;
}

/** Rows { key, name, value, text, wanted, state }; state is pass, fail, warn or nothing. */
export function rows(files) {
  const { verify } = files;
  const limit = asked(files);
  const verdict = (holds, otherwise = 'fail') => (holds ? 'pass' : otherwise);
  // verify.json says which figures are not as asked; files of older versions do not.
  const judged = (key, holds) => verdict(verify.reasons ? !verify.reasons.some((reason) => reason.figure === key) : holds);
  const out = [];
  if (verify) {
    const tolerance = format.tolerance(verify.tolerance_mm);
    const v = (key, name, text, wanted, state, hint) => out.push({ key, name, value: verify[key], text, wanted, state, hint });
    v('coverage', `Coverage within ±${tolerance}`, format.percent(verify.coverage),
      '', '', 'share of the target’s area that is finished');
    const reachable = 'coverage_reachable' in verify;
    const share = reachable ? verify.coverage_reachable : verify.coverage;
    v(reachable ? 'coverage_reachable' : 'coverage', 'Coverage of what is reachable', format.percent(share),
      limit.coverage === null ? '' : `≥ ${format.tick(100 * limit.coverage)}\u00a0%`,
      limit.coverage === null ? '' : judged('coverage_reachable', share >= limit.coverage),
      reachable ? `a ball of radius ${format.plain(verify.reach_radius_mm)} mm reaches ${format.percent(verify.reachable_share)} of the target` : 'of the whole target');
    v('overcut_mm', 'Overcut', format.error(verify.overcut_mm), `≤ ${tolerance}`,
      judged('overcut_mm', verify.overcut_mm <= verify.tolerance_mm), 'deepest cut into the target');
    v('gouge_mm', 'Overcut of other faces', format.error(verify.gouge_mm), `≤ ${tolerance}`,
      judged('gouge_mm', verify.gouge_mm <= verify.tolerance_mm), otherFaces(verify));
    v('undercut_covered_mm', 'Undercut where swept', format.error(verify.undercut_covered_mm), '', '', 'most material left where the tool sweeps past');
    v('undercut_mm', 'Undercut anywhere', format.error(verify.undercut_mm), '', '', 'most material left anywhere on the target');
    v('rms_mm', 'Root mean square', format.error(verify.rms_mm), '', '', 'of the error where the tool sweeps past');
    if (verify.depth === 'proved') {
      v('overcut_bound_mm', 'Overcut, proved', format.error(verify.overcut_bound_mm), `≤ ${tolerance}`,
        judged('overcut_bound_mm', verify.overcut_bound_mm <= verify.tolerance_mm), 'no place of the target is cut deeper, up to its borders');
      v('gouge_bound_mm', 'Of other faces, proved', format.error(verify.gouge_bound_mm), `≤ ${tolerance}`,
        judged('gouge_bound_mm', verify.gouge_bound_mm <= verify.tolerance_mm), 'no place of another face is cut deeper');
    } else v('sampling_bound_mm', 'Between the samples', format.error(verify.sampling_bound_mm), '', '',
      `overcut may be deeper than stated by no more than this; ${verify.samples.toLocaleString('en')} samples`);
  }
  const tool = files.view?.tool;
  if (tool && 'legitimate' in tool)
    out.push({ key: 'legitimate', name: 'Profile of the tool', value: tool.legitimate, text: tool.legitimate ? 'legitimate' : 'not legitimate', wanted: '',
      state: verdict(tool.legitimate), hint: tool.reason || 'its spheres are inscribed all along' });
  const c = largestC(files);
  if (c !== null)
    out.push({ key: 'largest_c', name: 'Regularity, largest |c|', value: c, text: format.plain(c), wanted: '< 1',
      state: verdict(c < 1, 'warn'), hint: 'along the path; at 1 the tool plunges along its own axis' });
  return out;
}

const MARKS = { pass: ['✓', 'pass'], fail: ['✗', 'fail'], warn: ['!', 'look'] };

function mark(state) {
  if (!state) return '';
  const [sign, word] = MARKS[state];
  return html('span', { class: `mark ${state}` }, html('span', { 'aria-hidden': 'true' }, sign), ` ${word}`);
}

export function table(list) {
  const body = list.map((row) =>
    html('tr', {},
      html('th', { scope: 'row', title: row.hint }, row.name, row.hint ? html('small', {}, row.hint) : null),
      html('td', { class: 'number', 'data-key': row.key, 'data-value': JSON.stringify(row.value) }, row.text),
      html('td', { class: 'number soft' }, row.wanted),
      html('td', {}, mark(row.state))));
  const head = ['Figure', 'Value', 'Asked', ''].map((name, k) =>
    html('th', { scope: 'col', class: k === 1 || k === 2 ? 'number' : '' }, name || html('span', { class: 'sr' }, 'Verdict')));
  return html('table', {}, html('thead', {}, html('tr', {}, ...head)), html('tbody', {}, ...body));
}

/** The verdict over the rows: { state, text }, and how many other faces are entered. */
export function verdict(files) {
  const list = rows(files);
  const failed = list.filter((row) => row.state === 'fail');
  const judged = list.some((row) => row.state === 'pass' || row.state === 'fail');
  const complete = files.summary?.complete !== false;
  const entered = files.verify ? enteredFaces(files.verify) : [];
  if (!judged) return { state: 'warn', text: 'Not judged', entered };
  if (!complete) return { state: 'fail', text: 'Interrupted: incomplete', entered };
  return failed.length ? { state: 'fail', text: 'Not within what was asked', entered }
    : { state: 'pass', text: 'Within what was asked', entered };
}

/** The worst places as a list; `go` is called with the place that was chosen. */
export function worstList(places, tolerance, go) {
  const shown = places.filter((place) => place.f_mm !== null);
  if (!shown.length) return html('p', { class: 'soft' }, 'Nothing is cut too deep anywhere.');
  const item = (place, k) => {
    const [x, y, z] = place.point.map((v) => format.plain(v, 4));
    const deep = place.f_mm < -tolerance;
    const button = html('button', { type: 'button', class: 'place' },
      html('b', { class: deep ? 'pin deep' : 'pin' }, String(k + 1)),
      html('span', {}, html('strong', {}, `${place.face}, ${format.error(place.f_mm)}`),
        html('small', {}, `at (${x}, ${y}, ${z})${place.strip ? `, strip ${place.strip}` : ''}`)));
    button.addEventListener('click', () => go(place, k));
    return html('li', {}, button);
  };
  return html('div', {}, html('p', { class: 'soft' }, `Deepest first; minus is overcut. The tolerance is ±${format.tolerance(tolerance)}.`),
    html('ol', { class: 'places' }, ...shown.map(item)));
}
