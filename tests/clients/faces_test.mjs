// The page of flank inspect --html in a real browser: what is under the pointer is what inspect calls so. Run by ctest (label clients);
// exit 77 means skipped.
import assert from 'node:assert/strict';
import { statSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Browser, findBrowser } from './browser.mjs';
import { BINARY, flank, must, root } from './folder.mjs';
import { hovered, inFrontOf } from './pointing.mjs';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
if (!BINARY) skip('FLANK_BINARY does not name the command');
if (!findBrowser()) skip('no Chromium here; `make test-clients` installs it');
if (/without the report page/.test(flank('report', '/').stderr)) skip('built without the report page');

/** A part with its table and its page. */
function make(example, ...more) {
  const part = join(root, `${example}.step`), page = join(root, `${example}.html`);
  must('example', example, '-o', part, '--quiet', ...more);
  must('inspect', part, '--html', page, '--quiet');
  return { part, page, faces: JSON.parse(must('inspect', part, '--json')).faces };
}

let browser, blade, cavity, blisk;
before(() => {
  browser = new Browser();
  blade = make('twisted-blade');
  cavity = make('cavity-barrel', '--end-wall');
  blisk = make('rotor37-blisk');
});
after(() => browser.close());
const chosen = 'window.flankFaces.names()';

test('opens without a complaint, asks the network for nothing, and lists every face', async () => {
  const page = await browser.open(blisk.page);
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests.filter((url) => !/^(file|data|blob):/.test(url)), []);
  assert.equal(await page.value('window.flankFaces.data.faces.length'), blisk.faces.length);
  assert.match(await page.value('document.title'), /rotor37-blisk\.step/);
  await page.close();
});

test('what is under the pointer is what inspect calls so, on three parts', async () => {
  for (const { page: file, faces } of [blade, cavity, blisk]) {
    const page = await browser.open(file);
    let pointed = 0;
    for (const row of faces) {
      const place = await inFrontOf(page, 'window.flankFaces', row);
      if (!place) continue;
      // Other faces may stand in front of it.
      await page.value(`window.flankFaces.hideFaces(${JSON.stringify(faces.map(({ id }) => id).filter((id) => id !== row.id))})`);
      const id = await hovered(page, place);
      await page.value('window.flankFaces.hideFaces([])');
      // The centre of a bent face may lie beside it, and a hole in it: then nothing is there, but never another face of the same place.
      if (id) assert.equal(id, row.id);
      pointed += id ? 1 : 0;
    }
    assert.ok(pointed >= Math.min(2, faces.length), `${pointed} of ${faces.length} faces were met`);
    await page.close();
  }
});

test('a click chooses, a shift-click adds, the names are those of the command line', async () => {
  const page = await browser.open(blisk.page);
  const met = [];
  for (const row of blisk.faces) {
    const place = await inFrontOf(page, 'window.flankFaces', row);
    if (met.length === 2 || !place || (await hovered(page, place)) !== row.id) continue;
    await page.press(...place, met.length > 0);
    met.push(row.id);
  }
  assert.equal(met.length, 2);
  const words = await page.value('document.querySelector("#words").textContent');
  assert.equal(words, `--face ${await page.value(chosen)}`);
  assert.equal(await page.value('[...window.flankFaces.marks.keys()].join()'), met.join());
  assert.equal(await page.value('document.querySelectorAll("tr.chosen").length > 0'), true);
  await page.close();
});

test('the table chooses, too, and sorts and filters as inspect does', async () => {
  const page = await browser.open(blisk.page);
  await page.click('button.face[data-id="F2"]');
  assert.equal(await page.value(chosen), 'F2');
  await page.click('th.c-area .sort');
  const ids = await page.value('window.flankFaces.table.shown.filter((row) => !row.piece).map((row) => row.id)');
  assert.deepEqual(ids, JSON.parse(must('inspect', blisk.part, '--json', '--sort', 'area')).faces.map((row) => row.id));
  const type = blisk.faces[0].type;
  await page.click(`.kind[data-kind="${type}"]`);
  const kind = await page.value('[...new Set(window.flankFaces.table.shown.filter((row) => !row.piece).map((row) => row.id))].sort()');
  assert.deepEqual(kind, JSON.parse(must('inspect', blisk.part, '--json', '--type', type.toLowerCase())).faces.map((row) => row.id).sort());
  await page.close();
});

test('what is hidden is out of the way of the pointer', async () => {
  const page = await browser.open(blade.page);
  const place = await inFrontOf(page, 'window.flankFaces', blade.faces[0]);
  assert.equal(await hovered(page, place), 'F1');
  await page.value('window.flankFaces.hideFaces(["F1"])');
  assert.equal(await hovered(page, place), '');
  await page.value('window.flankFaces.hideFaces([])');
  assert.equal(await hovered(page, place), 'F1');
  await page.close();
});

test('a wheel is named and coloured by the roles of its faces', async () => {
  const part = join(root, 'wheel.step'), file = join(root, 'wheel.html');
  must('example', 'impeller', '-o', part);
  must('inspect', part, '--wheel', '--html', file, '--quiet');
  const roles = JSON.parse(must('inspect', part, '--wheel', '--json'));
  const page = await browser.open(file);
  const rows = JSON.parse(await page.value('JSON.stringify([...flankFaces.rowOf.values()].map(({ id, of, role }) => [id, of, role]))'));
  const found = new Map(rows.map(([id, of, role]) => [id, { of, role }]));
  for (const id of roles.hub) assert.deepEqual(found.get(id), { of: 'hub', role: 'hub' });
  roles.blades.forEach((blade, k) => {
    const side = blade.kind === 'splitter' ? 'splitter side' : 'blade side';
    for (const id of blade.ahead) assert.deepEqual(found.get(id), { of: `${blade.kind} ${k + 1} ahead`, role: side });
    for (const { face } of blade.fillets) assert.equal(found.get(face).role, 'fillet');
  });
  const kinds = await page.value('[...document.querySelectorAll(".kind")].map((button) => button.dataset.kind).join()');
  assert.ok(kinds.includes('hub') && kinds.includes('blade side'), kinds);
  await page.close();
});

test('a picture is written', () => {
  const png = join(root, 'blisk.png');
  must('inspect', blisk.part, '--png', png, '--quiet');
  assert.ok(statSync(png).size > 20000);
});

test('nothing that is read is written over', () => {
  const { status, stderr } = flank('inspect', blade.part, '--html', blade.part);
  assert.equal(status, 3);
  assert.match(stderr, /blade\.step/);
  assert.equal(JSON.parse(must('inspect', blade.part, '--json')).faces.length, 1);
});
