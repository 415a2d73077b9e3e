// Puts the page together from what lies in the folder; what is missing is said, not hidden.
import { cavityCharts } from './cavity.js';
import { PathCharts, histogram } from './charts.js';
import { packed } from './data.js';
import { byId, html } from './dom.js';
import { asked, enteredFaces, rows, table } from './figures.js';
import * as format from './format.js';
import { made } from './made.js';
import { MotionCharts } from './motion.js';
import { PathModel } from './path.js';
import { Player } from './player.js';
import { profile, toolFacts } from './profile.js';
import { stiffnessCharts } from './stiffness.js';
import { watchTheme } from './theme.js';
import { cautions, earlier, programVerdict, reasons, verdict } from './verdict.js';
import { View } from './view.js';
import { collisions, places, worstList } from './worst.js';

/** Of fewer tools a chart over their slenderness shows nothing. */
const LEAST_TOOLS = 3;
/** Where the tool may stand at first: on the path, not at its ends. */
const FIRST_SHARES = [0.14, 0.26, 0.74, 0.86];

function notice(text) {
  byId('notices').append(html('p', { class: 'notice' }, text));
}

function subtitle({ view, summary }) {
  const parts = [];
  if (view) {
    const radii = view.tool.profile.map(([, , rho]) => rho);
    const kind = view.tool.family === 'spline' ? 'free tool' : view.tool.family;
    parts.push(`${kind}, ⌀ ${format.plain(2 * Math.min(...radii))} to ${format.length(2 * Math.max(...radii), 3)}, axis ${format.length(view.tool.axis_length_mm, 3)}`);
    parts.push(`${view.strips.length} pass${view.strips.length === 1 ? '' : 'es'}`);
  }
  const tolerance = view?.tolerance_mm ?? summary?.tolerance;
  if (tolerance) parts.push(`tolerance ±${format.tolerance(tolerance)}`);
  return parts.join(' · ');
}

/** A pill beside the verdict; without a text there is none. */
function pill(id, state, text, title) {
  byId(id).hidden = !text;
  if (!text) return;
  byId(id).classList.add(state);
  byId(id).textContent = text;
  if (title) byId(id).title = title;
}

const count = (number, one, more = `${one}s`) => `${number} ${number === 1 ? one : more}`;

/** Below the title: each reason, each caution, and what of the files is not as it should be. */
function said(files) {
  const line = (state, word) => ({ text }) => byId('said').append(html('li', { class: state }, html('strong', {}, word), ` ${text}`));
  if (!files.tied) line('warn untied', 'NO MANIFEST')({ text: 'The folder has no manifest.json, so these files may be edited, or of different results or parts. “flank verify” checks them again.' });
  reasons(files).forEach(line('fail', 'NO'));
  earlier(files).forEach(line('warn', 'EARLIER RUN'));
  const program = programVerdict(files);
  program?.reasons.forEach(line('fail', 'PROGRAM'));
  cautions(files).forEach(line('warn', 'CAUTION'));
  program?.cautions.forEach(line('warn', 'CAUTION, PROGRAM'));
  byId('said').hidden = !byId('said').childElementCount;
}

function head(files) {
  const { view, summary } = files;
  const part = view?.part ?? summary?.part?.split('/').pop();
  const title = part ? `${view?.faces ?? summary.faces} of ${part}` : 'OpenFlank report';
  byId('title').textContent = title;
  byId('subtitle').textContent = subtitle(files);
  const { state, text } = verdict(files);
  pill('verdict', state, text);
  const amber = cautions(files), entered = files.verify ? enteredFaces(files.verify) : [], program = programVerdict(files);
  pill('cautions', 'warn', amber.length ? count(amber.length, 'caution') : '', amber.map((one) => one.text).join('\n'));
  pill('program', program?.pass ? 'warn' : 'fail', !program ? '' : !program.pass ? 'Program: does NOT pass' : program.cautions.length ? `Program: ${count(program.cautions.length, 'caution')}` : '');
  pill('entered', 'fail', entered.length ? `Gouges ${count(entered.length, 'other face')}` : '', entered.map((f) => `${f.face} by ${format.error(f.overcut_mm)}`).join(', '));
  said(files);
}

/** Takes a section away; the 3D view with the column that holds it. */
function drop(id) {
  (byId(id)?.closest('.column') ?? byId(id))?.remove();
}

/** Draws one part of the page; a file that lacks what it needs costs that part alone. */
function part(id, draw) {
  try {
    return draw();
  } catch (error) {
    const name = byId(id)?.querySelector('h2')?.textContent ?? byId(id)?.getAttribute('aria-label') ?? id;
    drop(id);
    notice(`“${name}” cannot be shown: ${error.message}.`);
    return null;
  }
}

function still(files, page) {
  const { verify, view } = files;
  part('figures', () => {
    const list = rows(files);
    list.length ? byId('table').append(table(list)) : byId('figures').remove();
  });
  if (verify) {
    part('worst', () => byId('places').append(worstList(places(verify, asked(files).tolerance), asked(files).tolerance, page.go)));
    part('spread', () => byId('histogram').append(histogram(verify)));
  } else for (const id of ['worst', 'spread']) byId(id).remove();
  view ? part('tool', () => byId('profile').append(profile(view.tool), toolFacts(view.tool, files.summary))) : byId('tool').remove();
  files.summary?.stiffness?.length >= LEAST_TOOLS ? part('stiffness', () => byId('steps').append(stiffnessCharts(files.summary.stiffness, asked(files).tolerance))) : byId('stiffness').remove();
  files.summary?.cavity ? part('cavity', () => byId('cycles').append(cavityCharts(files.summary.cavity, verify?.stock))) : byId('cavity').remove();
  if (files.motion) page.motion = part('machine', () => {
    const charts = new MotionCharts(files.motion, programVerdict(files));
    byId('motion').append(charts.root);
    return charts;
  });
  else byId('machine').remove();
  part('origin', () => byId('made').append(made(files, document.querySelector('meta[name=generator]').content)));
}

/** What moves: the 3D view, its player and the charts that follow it. Whatever cannot be had is null. */
function moving(files, options, page) {
  const path = part('along', () => new PathModel(files.view));
  if (path) page.charts = part('along', () => new PathCharts(byId('charts'), path, files.view.tolerance_mm, (share) => page.player?.set(share, true)));
  page.path = path;
  page.view = part('stage', () => {
    const view = new View(files, path, page.go);
    const at = options.get('at');
    // What collides is seen first.
    const struck = collisions(files.verify).find((place) => place.strip && place.deep);
    const there = struck ? page.shareOf(struck) : null;
    const share = view.open(path, at !== null ? [Number(at)] : there !== null ? [there] : FIRST_SHARES, struck);
    page.player = new Player(path, (place, where) => { view.move(place); page.charts?.move(where); },
      () => { view.axis.choose(path.chosen); page.charts?.rebuild(); });
    page.player.set(share);
    return view;
  });
  byId('canvas')?.setAttribute('aria-label', `${byId('title').textContent}, coloured by the signed error; the tool stands on the path. Arrow keys turn, plus and minus zoom, Home resets.`);
}

function missing(files) {
  const wanted = { view: 'the 3D view, the tool and the charts along the path', verify: 'the figures of the check', summary: 'the summary of the result' };
  for (const [name, what] of Object.entries(wanted))
    if (!files[name]) notice(`The folder holds no ${name}.json, so ${what} ${name === 'summary' ? 'is' : 'are'} missing here.${name === 'summary' ? '' : ' “flank verify” writes it.'}`);
}

function start(files, options) {
  const page = { view: null, player: null, charts: null, path: null, motion: null };
  /** Where on what is shown of the path a place is; null: not there. */
  page.shareOf = (place) => {
    const strip = page.path?.strips.find((s) => s.id === place.strip) ?? page.path?.strips[place.strip - 1];
    return strip && page.path.shown().includes(strip) ? page.path.shareOf(strip, place.t) : null;
  };
  page.go = (place) => {
    const share = page.shareOf(place);
    if (page.player && share !== null) page.player.set(share, true);
  };
  part('heading', () => head(files));
  still(files, page);
  missing(files);
  if (files.view) moving(files, options, page);
  else for (const id of ['stage', 'along']) drop(id);
  watchTheme(() => {
    page.view?.paint();
    page.motion?.paint();
  }, options.get('theme'));
  return page;
}

function shortcuts({ player }) {
  document.addEventListener('keydown', (event) => {
    if (event.key !== ' ' || !player || /^(BUTTON|SELECT|INPUT|A)$/.test(event.target.tagName)) return;
    event.preventDefault();
    player.toggle();
  });
}

const options = new URLSearchParams(location.hash.slice(1));
const files = { view: packed('view.json'), verify: packed('verify.json'), summary: packed('summary.json'), motion: packed('motion.json'),
  tied: document.querySelector('meta[name=flank-manifest]')?.content === 'whole' };
if (options.get('theme')) document.documentElement.dataset.theme = options.get('theme');
const page = start(files, options);
shortcuts(page);
/** Says when all is there: after the first frame where there is a 3D view. */
const ready = () => { document.documentElement.dataset.ready ??= Math.round(performance.now()); };
page.view ? page.view.stage.onDraw(ready) : ready();
window.flankReport = page;
