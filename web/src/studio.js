// The studio: part, job and result side by side. Everything that is computed is computed by the command.
import { get } from './api.js';
import { packed } from './data.js';
import { byId, html } from './dom.js';
import { JobPane } from './jobpane.js';
import { PartPane } from './partpane.js';
import { ResultPane } from './resultpane.js';
import { watchTheme } from './theme.js';
import { warm } from './warm.js';

/** Milliseconds between two looks at the folder: another page may work in it, too. */
const LOOK = 1000;
/** Milliseconds of rest before the graphics are made ready. */
const WARM = 200;

const start = packed('start.json');
const result = new ResultPane();
const parts = new PartPane({ part: () => job.part(), faces: () => job.changed() });
const job = new JobPane(parts, async (id) => {
  await look();
  result.choose(id);
});

async function look() {
  try {
    const state = await get('state');
    if (byId('subtitle').textContent !== state.folder) byId('subtitle').textContent = state.folder;
    byId('notices').replaceChildren();
    parts.list(state.parts);
    result.list(state.jobs);
    return state;
  } catch (error) {
    byId('notices').replaceChildren(html('p', { class: 'notice', role: 'alert' }, error.message));
    return null;
  }
}

async function again() {
  await look();
  setTimeout(again, LOOK);
}

document.addEventListener('keydown', (event) => {
  if (event.key === 'Enter' && (event.ctrlKey || event.metaKey) && !byId('run').disabled) byId('run').click();
});
// A page that nobody looks at is slowed down by the browser.
document.addEventListener('visibilitychange', () => { if (!document.hidden) result.live?.again(0); });
watchTheme(() => {
  parts.paint();
  result.paint();
}, new URLSearchParams(location.hash.slice(1)).get('theme'));
async function begin() {
  await job.choose('fit');
  const state = await look();
  const first = start.part || (state?.parts.length === 1 ? state.parts[0] : '');
  if (first) await parts.show(first);
  setTimeout(again, LOOK);
  document.documentElement.dataset.ready = Math.round(performance.now());
  // Whoever has no part yet will drop one soon.
  if (!first) setTimeout(() => {
    warm();
    document.documentElement.dataset.warm = 'yes';
  }, WARM);
}

window.flankStudio = { parts, job, result };
begin();
