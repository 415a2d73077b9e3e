// The report's verdict in a real browser: for every figure that a verdict can be about (the library's own list, written out by
// figure_folders) the page says no when that figure alone is false, and is amber when there is a caution about it. What collides is
// drawn, and no section of the page covers another. Run by ctest (label clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Browser, findBrowser } from './browser.mjs';
import { BINARY, flank, json, must, root, without } from './folder.mjs';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
if (!BINARY) skip('FLANK_BINARY does not name the command');
if (!process.env.FLANK_FIGURE_FOLDERS) skip('FLANK_FIGURE_FOLDERS does not name figure_folders');
if (!findBrowser()) skip('no Chromium here; `make test-clients` installs it');
if (/without the report page/.test(flank('report', '/').stderr)) skip('built without the report page');

const figures = join(root, 'figures');
let browser, names;
before(() => {
  names = execFileSync(process.env.FLANK_FIGURE_FOLDERS, [figures], { encoding: 'utf8' }).trim().split('\n');
  browser = new Browser();
});
after(() => browser.close());

const open = (folder, options) => browser.open(join(folder, 'report.html'), options);

/** What a reader sees of the verdict: { pill, state, cautions, program, said, rows }. */
const told = `(() => {
  const state = (e) => ['pass', 'warn', 'fail'].find((name) => e.classList.contains(name)) ?? '';
  const pill = (id) => { const e = document.getElementById(id); return e.hidden ? null : { text: e.textContent, state: state(e) }; };
  return { pill: pill('verdict'), cautions: pill('cautions'), program: pill('program'),
    said: [...document.querySelectorAll('#said li')].map((e) => ({ text: e.textContent, state: state(e) })),
    rows: [...document.querySelectorAll('#table tr[data-figure]')].map((e) => ({ figure: e.dataset.figure, state: e.dataset.state,
      mark: e.querySelector('.mark')?.textContent.trim() ?? '', more: e.nextElementSibling.textContent })) };
})()`;

/** One tab for many pages. */
async function tell(page, folder) {
  const { complaints } = page;
  await page.send('Page.navigate', { url: `file://${join(folder, 'report.html')}` });
  await page.until(`location.pathname.endsWith(${JSON.stringify(join(folder, 'report.html'))}) && document.documentElement?.dataset.ready !== undefined`, 30);
  const all = await page.value(told);
  assert.deepEqual(complaints, [], folder);
  return all;
}

test('a sound result is green, and nothing else is said', async () => {
  const page = await open(join(figures, 'sound'));
  const { pill, cautions, program, said, rows } = await page.value(told);
  assert.deepEqual(pill, { text: 'Meets the request', state: 'pass' });
  assert.deepEqual([cautions, program], [null, null]);
  assert.deepEqual(said, []);
  assert.ok(rows.length > 5 && rows.every((row) => row.state !== 'fail' && row.state !== 'warn'), JSON.stringify(rows));
  await page.close();
});

test('each figure of the verdict alone turns the page red, with its reason in a row', async () => {
  assert.ok(names.length > 25 && names.includes('clearance') && names.includes('bend_radius'));
  const page = await open(join(figures, 'sound'));
  for (const name of names) {
    const { pill, said, rows } = await tell(page, join(figures, `no-${name}`));
    assert.equal(pill.state, 'fail', name);
    assert.match(pill.text, /NOT|incomplete/, name);
    const failing = rows.filter((row) => row.state === 'fail');
    assert.deepEqual(failing.map((row) => row.figure), [name]);
    assert.match(failing[0].mark, /fail/, name);
    assert.ok(failing[0].more.includes(`reason of ${name}`), `${name}: ${failing[0].more}`);
    assert.deepEqual(said.filter(({ state }) => state === 'fail').map(({ text }) => text), [`NO reason of ${name}`]);
  }
  await page.close();
});

test('each caution stands in amber beside a green verdict, and in a row', async () => {
  const page = await open(join(figures, 'mind-one'));
  for (const [folder, about] of [['mind-one', names.slice(0, 1)], ['mind-all', names]]) {
    const { pill, cautions, said, rows } = await tell(page, join(figures, folder));
    assert.deepEqual(pill, { text: 'Meets the request', state: 'pass' }, folder);
    assert.deepEqual(cautions, { text: about.length === 1 ? '1 caution' : `${about.length} cautions`, state: 'warn' });
    assert.deepEqual(said, about.map((name) => ({ text: `CAUTION caution about ${name}`, state: 'warn' })));
    const amber = rows.filter((row) => row.state === 'warn');
    assert.deepEqual(amber.map((row) => row.figure).sort(), [...about].sort());
    for (const row of amber) assert.ok(row.more.includes(`caution about ${row.figure}`), row.figure);
    assert.ok(rows.every((row) => row.state !== 'fail'));
  }
  await page.close();
});

/** The sound result with files changed by hand: without a manifest, so that it can be packed. */
function spoilt(name, change) {
  const folder = without(join(figures, 'sound'), name);
  const files = { verify: json(folder, 'verify.json'), summary: json(folder, 'summary.json') };
  change(files, folder);
  for (const [file, content] of Object.entries(files)) content ? writeFileSync(join(folder, `${file}.json`), JSON.stringify(content)) : rmSync(join(folder, `${file}.json`));
  must('report', folder, '--quiet');
  return folder;
}

test('what is not known is not green', async () => {
  const page = await open(join(figures, 'sound'));
  const cases = {
    untied: [() => {}, 'warn', /The files may not belong together/],
    interrupted: [({ summary }) => { summary.complete = false; }, 'fail', /incomplete/],
    'a-no-with-a-yes': [({ verify }) => { verify.reasons = [{ figure: 'overcut_mm', text: 'deep' }]; }, 'fail', /NOT/],
    'a-no-without-reasons': [({ verify }) => { verify.pass = false; }, 'fail', /NOT/],
    'not-judged': [({ verify }) => { delete verify.pass; }, 'warn', /Not checked/],
    'no-verdict': [(files) => { files.verify = null; }, 'warn', /Not checked/],
  };
  for (const [name, [change, state, words]] of Object.entries(cases)) {
    const { pill, said } = await tell(page, spoilt(name, change));
    assert.equal(pill.state, state, name);
    assert.match(pill.text, words, name);
    assert.ok(said.some(({ text, state: tone }) => /The folder has no manifest\.json, so these files may be edited/.test(text) && tone === 'warn'), name);
  }
  await page.close();
});

test('a verdict in a folder without a manifest is not believed, and one that was edited beside its manifest is refused', () => {
  const folder = join(figures, 'no-clearance');
  const kept = json(folder, 'verify.json');
  writeFileSync(join(folder, 'verify.json'), JSON.stringify({ ...kept, pass: true, reasons: [] }));
  const { status, stderr } = flank('report', folder);
  assert.equal(status, 3);
  assert.match(stderr, /verify\.json/);
  const untied = without(folder, 'edited');
  const said = flank('report', untied);
  assert.equal(said.status, 0);
  assert.match(said.stderr, /no manifest\.json: the files may not belong together/);
});

test('a holder in the vice is red, in a row and in the picture', async () => {
  const folder = join(figures, 'vice');
  const figure = json(folder, 'verify.json').clearance.find((f) => f.body === 'holder' && f.against === 'fixture');
  assert.ok(figure.clearance_mm < -1);
  const page = await open(folder, { width: 1440, height: 900 });
  assert.deepEqual(page.complaints, []);
  const { pill, said } = await page.value(told);
  assert.equal(pill.state, 'fail');
  assert.ok(said.some(({ text, state }) => state === 'fail' && /holder/.test(text)), JSON.stringify(said));
  const row = await page.value(`(() => { const e = document.querySelector('[data-key="clearance.holder.fixture"]'); return { value: JSON.parse(e.dataset.value), state: e.parentElement.dataset.state }; })()`);
  assert.deepEqual(row, { value: figure.clearance_mm, state: 'fail' });
  // What enters and what is entered are drawn, where the tool stands when it happens.
  const drawn = await page.value(`(() => { const { view, path, player } = window.flankReport; return {
    fixtures: view.fixtures.meshes.map((m) => m.userData.body.face), inside: view.fixtures.meshes.some((m) => m.userData.body.gap.some((x) => x < 0)),
    outside: view.fixtures.meshes.some((m) => m.userData.body.gap.some((x) => x > 1)),
    struck: [...view.tool.struck], holder: view.tool.materials.holder.color.getHexString(), flank: view.tool.materials.flank.color.getHexString(),
    t: path.locate(player.share).t, pins: [...document.querySelectorAll('#pins .pin')].map((e) => e.textContent) }; })()`);
  assert.ok(drawn.fixtures.length > 0 && drawn.fixtures.every((name) => name.startsWith('vice.stl F')), JSON.stringify(drawn.fixtures));
  assert.ok(drawn.inside && drawn.outside);
  assert.ok(drawn.struck.includes('holder'));
  assert.ok(!drawn.struck.includes('flank'));
  assert.notEqual(drawn.holder, drawn.flank);
  assert.ok(Math.abs(drawn.t - figure.t) < 1.5, `${drawn.t} is not ${figure.t}`);
  assert.equal(drawn.pins[0], '!');
  // In the picture itself: red where the block was not entered would be another colour.
  const red = `(() => { const c = document.querySelector('#canvas'), d = document.createElement('canvas'); d.width = c.width; d.height = c.height;
    const x = d.getContext('2d'); x.drawImage(c, 0, 0); const p = x.getImageData(0, 0, d.width, d.height).data; let n = 0;
    for (let k = 0; k < p.length; k += 4) if (p[k] > 1.8 * p[k + 1] && p[k] > 1.8 * p[k + 2] && p[k + 3] > 200) ++n; return n; })()`;
  const before = await page.value(red);
  assert.ok(before > 200, `${before} red points`);
  const picture = 'document.querySelector("#canvas").toDataURL()', shown = await page.value(picture);
  await page.value(`[...document.querySelectorAll('#layers label')].find((e) => e.textContent === 'Fixtures').querySelector('input').click()`);
  await page.frames();
  assert.notEqual(await page.value(picture), shown);
  await page.close();
});

/** The largest area, px², by which two sections cover each other at any scroll position. */
const overlap = `(() => {
  // Where sections stand does not depend on the picture, which takes long to be drawn at each.
  document.querySelector('#canvas').style.display = 'none';
  const sections = [...document.querySelectorAll('main section')];
  let most = 0, which = '';
  for (let y = 0; y < document.documentElement.scrollHeight; y += 300) {
    scrollTo(0, y);
    const boxes = sections.map((e) => ({ id: e.id, box: e.getBoundingClientRect() }));
    for (const [k, a] of boxes.entries())
      for (const b of boxes.slice(k + 1)) {
        const wide = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left), high = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
        if (wide > 0 && high > 0 && wide * high > most) { most = wide * high; which = a.id + ' and ' + b.id + ' at ' + y; }
      }
  }
  scrollTo(0, 0);
  return { most, which, sections: sections.length };
})()`;

test('no section covers another, at any scroll position', async () => {
  const folder = join(figures, 'vice');
  for (const [width, height] of [[1280, 720], [1440, 900], [1920, 1080]]) {
    const page = await open(folder, { width, height });
    const { most, which, sections } = await page.value(overlap);
    assert.ok(sections >= 6);
    assert.ok(most < 2, `${width} x ${height}: ${which}: ${most} px²`);
    // And it stays in sight along the figures: else nothing was tested.
    assert.equal(await page.value(`(() => { scrollTo(0, 200); const { top, bottom } = document.querySelector('#stage').getBoundingClientRect(); scrollTo(0, 0); return top >= 0 && bottom > 300; })()`), true);
    if (width === 1440) {
      await page.value(`document.querySelector('.column').style.display = 'contents'`);
      assert.ok((await page.value(overlap)).most > 1000, 'the look itself would find it');
    }
    await page.close();
  }
});

test('the tool is drawn as it is ground, with its length, stiffness, shank and holder', async () => {
  const folder = join(figures, 'vice');
  const page = await open(folder);
  // The end of the flank in tool.dxf: the largest x of its vertices.
  const words = readFileSync(join(folder, 'tool.dxf'), 'latin1').split(/\r?\n/).map((word) => word.trim());
  let layer = '', end = -Infinity;
  for (let k = 0; k + 1 < words.length; k += 2) {
    if (words[k] === '8') layer = words[k + 1];
    if (words[k] === '10' && layer === 'FLANK') end = Math.max(end, Number(words[k + 1]));
  }
  const drawn = await page.value(`(() => { const p = window.flankReport.view.tool.root.children[0].geometry.attributes.position.array; let top = -1e9; for (let k = 1; k < p.length; k += 3) top = Math.max(top, p[k]); return top; })()`);
  assert.ok(Math.abs(drawn - end) < 0.01, `drawn to ${drawn}, ground to ${end}`);
  const facts = await page.value(`document.querySelector('#tool-facts').textContent`);
  const summary = json(folder, 'summary.json');
  for (const key of ['slenderness', 'tip_deflection_um_per_100N'])
    assert.equal(await page.value(`JSON.parse(document.querySelector('[data-key="${key}"]').dataset.value)`), summary[key], key);
  assert.match(facts, /Shank20\.00\smm long.*Holder40\.00\smm long/);
  assert.match(await page.value(`document.querySelector('#profile').textContent`), /length [\d.]+\smm with its shank, tip R/);
  await page.close();
});
