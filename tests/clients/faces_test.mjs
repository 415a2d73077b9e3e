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
      const id = await hovered(page, place);
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

test('3,000 faces: the first picture, a pick, and frames while turning', async () => {
  const page = await browser.open(blisk.page, { width: 1440, height: 900 });
  const figures = await page.value(`(async () => {
    const { chooser: C } = { chooser: window.flankFaces.constructor }, few = window.flankFaces.data;
    const data = { ...few, faces: [], bodies: [] };
    for (let k = 0; k < 3000; ++k) {
      const body = few.bodies[k % few.bodies.length], row = few.faces[k % few.faces.length], id = 'F' + (k + 1), away = Math.floor(k / few.bodies.length) % 20;
      data.faces.push({ ...row, id, pieces: undefined });
      // Moved along x, and far fewer triangles each than the blisk's own: those of the first body that has some.
      data.bodies.push({ ...body, face: id, box: body.box.map(([x, y, z]) => [x + 60 * away, y + 45 * Math.floor(k / few.bodies.length / 20), z]) });
    }
    const begin = performance.now();
    window.flankFaces.dispose();
    const chooser = new C(data);
    document.querySelector('#part').replaceChildren(chooser.view);
    document.querySelector('#faces').append(chooser.list);
    chooser.start();
    const drawn = () => new Promise((done) => { let told = false; chooser.stage.onDraw(() => { if (!told) { told = true; done(); } }); chooser.stage.draw(); });
    await drawn();
    const first = performance.now() - begin;
    const picks = [];
    for (let k = 0; k < 100; ++k) {
      const from = performance.now();
      chooser.model.pick(chooser.stage, (k % 10 + 0.5) * chooser.canvas.clientWidth / 10, (Math.floor(k / 10) + 0.5) * chooser.canvas.clientHeight / 10);
      picks.push(performance.now() - from);
    }
    const turning = performance.now();
    for (let k = 0; k < 20; ++k) { chooser.stage.orbit(0.05, 0); await drawn(); }
    return { triangles: chooser.model.indices.length / 3, first, pick: picks.sort((a, b) => a - b)[95], frames: 20000 / (performance.now() - turning), calls: chooser.stage.renderer.info.render.calls };
  })()`);
  console.log(`3,000 faces, ${figures.triangles} triangles: first picture ${figures.first.toFixed(0)} ms, pick ${figures.pick.toFixed(2)} ms (95 %), ${figures.frames.toFixed(1)} frames a second, ${figures.calls} draw calls`);
  assert.equal(figures.calls, 2, 'faces and edges');
  assert.ok(figures.pick < 50);
  assert.ok(figures.first < 3000);
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
