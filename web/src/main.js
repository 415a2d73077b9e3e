// Puts the page together from what lies in the folder; what is missing is said, not hidden.
import { cavityCharts } from './cavity.js';
import { PathCharts, histogram } from './charts.js';
import { packed } from './data.js';
import { byId, html } from './dom.js';
import { asked, rows, table, verdict, worstList } from './figures.js';
import * as format from './format.js';
import { made } from './made.js';
import { MotionCharts } from './motion.js';
import { PathModel } from './path.js';
import { Player } from './player.js';
import { profile } from './profile.js';
import { stiffnessCharts } from './stiffness.js';
import { watchTheme } from './theme.js';
import { View } from './view.js';

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
    parts.push(`${view.strips.length} strip${view.strips.length === 1 ? '' : 's'}`);
  }
  const tolerance = view?.tolerance_mm ?? summary?.tolerance;
  if (tolerance) parts.push(`tolerance ±${format.tolerance(tolerance)}`);
  return parts.join(' · ');
}

function head(files) {
  const { view, summary } = files;
  const part = view?.part ?? summary?.part?.split('/').pop();
  const title = part ? `${view?.faces ?? summary.faces} of ${part}` : 'OpenFlank report';
  byId('title').textContent = title;
  byId('subtitle').textContent = subtitle(files);
  const { state, text, entered } = verdict(files);
  byId('verdict').textContent = text;
  byId('verdict').classList.add(state);
  if (entered.length) {
    byId('entered').hidden = false;
    byId('entered').classList.add('warn');
    byId('entered').textContent = `Enters ${entered.length} other face${entered.length === 1 ? '' : 's'}`;
    byId('entered').title = entered.map((f) => `${f.face} by ${format.error(f.overcut_mm)}`).join(', ');
  }
}

/** Draws one part of the page; a file that lacks what it needs costs that part alone. */
function part(id, draw) {
  try {
    return draw();
  } catch (error) {
    const name = byId(id)?.querySelector('h2')?.textContent ?? byId(id)?.getAttribute('aria-label') ?? id;
    byId(id)?.remove();
    notice(`“${name}” is missing here: ${error.message}.`);
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
    part('worst', () => byId('places').append(worstList(verify.worst_places, asked(files).tolerance, page.go)));
    part('spread', () => byId('histogram').append(histogram(verify)));
  } else for (const id of ['worst', 'spread']) byId(id).remove();
  view ? part('tool', () => byId('profile').append(profile(view.tool))) : byId('tool').remove();
  files.summary?.stiffness?.length > 1 ? part('stiffness', () => byId('steps').append(stiffnessCharts(files.summary.stiffness, asked(files).tolerance))) : byId('stiffness').remove();
  files.summary?.cavity ? part('cavity', () => byId('cycles').append(cavityCharts(files.summary.cavity, verify?.stock))) : byId('cavity').remove();
  if (files.motion) page.motion = part('machine', () => {
    const charts = new MotionCharts(files.motion);
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
    const share = view.open(path, at === null ? FIRST_SHARES : [Number(at)]);
    page.player = new Player(path, (place, where) => { view.move(place); page.charts?.move(where); },
      () => { view.axis.choose(path.chosen); page.charts?.rebuild(); });
    page.player.set(share);
    return view;
  });
  byId('canvas')?.setAttribute('aria-label', `${byId('title').textContent}, coloured by the signed error; the tool stands on the path. Arrow keys turn, plus and minus zoom, Home resets.`);
}

function missing(files) {
  const wanted = { view: 'the 3D view, the tool and the charts along the path', verify: 'the figures of the judge', summary: 'the summary of the fit' };
  for (const [name, what] of Object.entries(wanted))
    if (!files[name]) notice(`The folder holds no ${name}.json, so ${what} ${name === 'summary' ? 'is' : 'are'} missing here.${name === 'summary' ? '' : ' “flank verify” writes it.'}`);
}

function start(files, options) {
  const page = { view: null, player: null, charts: null, path: null, motion: null };
  page.go = (place) => {
    const strip = page.path?.strips.find((s) => s.id === place.strip) ?? page.path?.strips[place.strip - 1];
    if (page.player && strip && page.path.shown().includes(strip)) page.player.set(page.path.shareOf(strip, place.t), true);
  };
  part('heading', () => head(files));
  still(files, page);
  missing(files);
  if (files.view) moving(files, options, page);
  else for (const id of ['stage', 'along']) byId(id).remove();
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
const files = { view: packed('view.json'), verify: packed('verify.json'), summary: packed('summary.json'), motion: packed('motion.json') };
if (options.get('theme')) document.documentElement.dataset.theme = options.get('theme');
const page = start(files, options);
shortcuts(page);
/** Says when all is there: after the first frame where there is a 3D view. */
const ready = () => { document.documentElement.dataset.ready ??= Math.round(performance.now()); };
page.view ? page.view.stage.onDraw(ready) : ready();
window.flankReport = page;
