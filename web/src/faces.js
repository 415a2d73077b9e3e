// The page of flank inspect --html: point at faces, and take their names along.
import { Chooser } from './chooser.js';
import { copy } from './copy.js';
import { packed } from './data.js';
import { byId } from './dom.js';
import * as format from './format.js';
import { watchTheme } from './theme.js';

const options = new URLSearchParams(location.hash.slice(1));
if (options.get('theme')) document.documentElement.dataset.theme = options.get('theme');
const data = packed('faces.json');
const count = (number, one) => `${number.toLocaleString('en')} ${one}${number === 1 ? '' : 's'}`;

byId('title').textContent = data.file;
byId('subtitle').textContent = `${data.format}, unit ${data.unit} · ${count(data.faces.length, 'face')} · ${count(data.solids, 'solid')} · ${data.box.high.map((h, k) => format.plain(h - data.box.low[k], 4)).join(' × ')} mm`;
for (const repair of data.repairs) byId('notices').append(Object.assign(document.createElement('p'), { className: 'notice', textContent: repair }));

/** What of the command line the chosen faces are. */
function words() {
  const names = chooser.names();
  return names ? `--face ${names}` : '';
}

async function take() {
  byId('copied').textContent = (await copy(words())) ? 'copied' : 'press Ctrl+C';
}

function changed() {
  const ids = chooser.chosen(), area = ids.reduce((sum, id) => sum + (chooser.rowOf.get(id)?.area ?? 0), 0);
  byId('chosen').hidden = !ids.length;
  byId('words').textContent = words();
  byId('sum').textContent = `${count(ids.length, 'face')}, ${format.plain(area, 4)} mm²`;
  byId('copied').textContent = '';
  if (ids.length) take();
}

const chooser = new Chooser(data, changed);
byId('part').append(chooser.view);
byId('faces').append(chooser.list);
chooser.start();
byId('copy').addEventListener('click', take);
watchTheme(() => chooser.paint(), options.get('theme'));
chooser.stage.onDraw(() => { document.documentElement.dataset.ready ??= Math.round(performance.now()); });
window.flankFaces = chooser;
