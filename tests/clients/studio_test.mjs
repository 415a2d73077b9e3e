// The studio in a real browser: a file is dropped, a face is clicked, a tool is found, judged and posted. Run by ctest
// (label clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Browser, findBrowser, sleep } from './browser.mjs';
import { BINARY, flank, must, root } from './folder.mjs';
import { hovered, inFrontOf } from './pointing.mjs';
import { StudioProcess } from './studio.mjs';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
if (!BINARY) skip('FLANK_BINARY does not name the command');
if (!findBrowser()) skip('no Chromium here; `make test-clients` installs it');
const missing = flank('studio', '/no/such/part', '-o', join(root, 'none'), '--no-browser').stderr;
if (/without/.test(missing)) skip(missing);

/** Seconds: a machine that does much else draws slowly without a graphics card. */
const PATIENCE = 240;
const PICTURES = process.env.FLANK_PICTURES;
const CHOOSER = 'window.flankStudio.parts.chooser';
let browser, studio, blade;
before(async () => {
  blade = join(root, 'twisted-blade.step');
  must('example', 'twisted-blade', '-o', blade, '--quiet');
  browser = new Browser();
  studio = await StudioProcess.begin(join(root, 'studio'));
});
after(async () => {
  await browser.close();
  await studio.end();
});

const open = (options) => browser.open(studio.url, { width: 1440, height: 900, ...options });
const live = (what) => `document.querySelector('.live')?.dataset.${what}`;
const settled = `${live('state')} === 'done'`;
async function keep(page, name) {
  if (!PICTURES) return;
  mkdirSync(PICTURES, { recursive: true });
  writeFileSync(join(PICTURES, `${name}.png`), await page.picture());
}

/** Drops a file on the page and waits until its faces are drawn. */
async function drop(page, file) {
  await page.drop(300, 400, file);
  await page.until(`${CHOOSER}?.data.file === ${JSON.stringify(file.split('/').pop())} && document.querySelector('#drop').hidden`, PATIENCE);
  await page.frames();
}

/** Clicks the middle of a face in the picture. */
async function clickFace(page, row) {
  const place = await inFrontOf(page, CHOOSER, row);
  assert.equal(await hovered(page, place), row.id);
  await page.press(...place);
  await page.value(`${CHOOSER}.stage.look('iso')`);
}

/** What the report in the right pane says. */
const report = (expression) => `(() => { const d = document.querySelector('iframe.report')?.contentDocument; return d?.documentElement?.dataset.ready !== undefined && (${expression}); })()`;
const pill = (page) => page.value('(() => { const p = document.querySelector(".livehead .pill"); return [p.className.replace("pill ", ""), p.dataset.exit]; })()');

const fill = (page, name, value) => page.value(`(() => { const e = document.querySelector('#field-${name}'); e.value = ${JSON.stringify(value)}; e.dispatchEvent(new Event('input', { bubbles: true })); })()`);

/** Fills the form, runs, waits for the end; the job as the server tells it. */
async function run(page, fields) {
  await page.value('window.flankStudio.job.form.set({})');
  for (const [name, value] of Object.entries(fields)) await fill(page, name, value);
  const before = (await studio.get('state')).jobs.length;
  await page.click('#run');
  await page.until(`window.flankStudio.result.chosen === ${JSON.stringify(String(before + 1).padStart(4, '0'))}`, PATIENCE);
  await page.until(settled, PATIENCE);
  return studio.get(`jobs/${String(before + 1).padStart(4, '0')}`);
}

test('from a dropped file to a first result of the demo blade in three clicks', async () => {
  const page = await open();
  assert.deepEqual(page.complaints, []);
  await keep(page, 'studio-empty');
  const begin = Date.now();
  await drop(page, blade);
  const [row] = JSON.parse(must('inspect', blade, '--json')).faces;
  await clickFace(page, row);
  assert.equal(await page.value('document.querySelector("#chosen").textContent'), '--face F1');
  await fill(page, 'tolerance_mm', '0.1');
  await page.until('document.querySelector("#defaults").textContent.includes("side")', PATIENCE);
  await keep(page, 'studio-chosen');
  await page.click('#run');
  const shares = [];
  while (!(await page.value(settled))) {
    shares.push(Number(await page.value(live('share')) ?? 0));
    if (shares.length === 12) await keep(page, 'studio-running');
    await sleep(100);
  }
  const seconds = (Date.now() - begin) / 1000;
  shares.forEach((share, k) => assert.ok(k === 0 || share >= shares[k - 1], `the progress fell: ${shares}`));
  assert.ok(Math.max(...shares) > 0);
  assert.deepEqual(await pill(page), ['pass', '0']);
  await page.until(report('d.querySelector("#verdict").textContent'), PATIENCE);
  assert.equal(await page.value(report('d.querySelector("#verdict").className')), 'pill pass');
  console.log(`from the dropped file to the verdict: ${seconds.toFixed(1)} s`);
  await keep(page, 'studio-result');
  await page.close();
});

test('the line that it shows gives the same bytes', async () => {
  const [job] = (await studio.get('state')).jobs.slice(-1), out = join(root, 'by-hand');
  const words = job.line.split(' ').slice(1).map((word) => (word === job.part ? blade : word === 'out' ? out : word));
  assert.equal(flank(...words, '--quiet').status, job.exit);
  for (const name of ['tool.json', 'path.json', 'tool.dxf'])
    assert.equal(await (await fetch(`${studio.url}api/jobs/${job.id}/files/${name}`)).text(), readFileSync(join(out, name), 'utf8'), name);
});

test('the program is posted and judged, and its bytes are the command’s', async () => {
  const page = await open();
  await page.until('document.querySelector("#post")', PATIENCE);
  await page.value('(() => { const m = document.querySelector("#machine-name"); m.value = "linuxcnc-xyzac-trt"; m.dispatchEvent(new Event("change")); })()');
  await page.click('#post');
  await page.until('document.querySelector(".outcome .pill")', PATIENCE);
  assert.equal(await page.value('document.querySelector(".outcome .pill").dataset.exit'), '0');
  const [job] = (await studio.get('state')).jobs.slice(-1), file = join(root, 'by-hand.ngc');
  assert.deepEqual(job.programs, [`${job.id}-linuxcnc-xyzac-trt.nc`]);
  must('post', join(studio.folder, 'jobs', job.id, 'result'), '--machine', 'linuxcnc-xyzac-trt', '--spindle', '8000', '--feed', '1000', '-o', file, '--quiet');
  assert.equal(await (await fetch(`${studio.url}api/jobs/${job.id}/programs/${job.programs[0]}`)).text(), readFileSync(file, 'utf8'));
  await page.click('#judge');
  await page.until('document.querySelector(".outcome .pill").textContent.startsWith("Program")', PATIENCE);
  assert.equal(await page.value('document.querySelector(".outcome .pill").dataset.exit'), '0');
  await keep(page, 'studio-machine');
  const zip = Buffer.from(await (await fetch(`${studio.url}api/jobs/${job.id}/zip`)).arrayBuffer());
  assert.equal(zip.readUInt32LE(0), 0x04034b50);
  await page.close();
});

test('what is refused is said in the command’s words', async () => {
  const page = await open();
  const broken = join(root, 'broken.step');
  writeFileSync(broken, 'no part');
  await page.drop(300, 400, broken);
  await page.until('document.querySelector("#drop .notice")', PATIENCE);
  assert.match(await page.value('document.querySelector("#drop .notice").textContent'), /broken\.step/);
  const job = await (async () => {
    await page.value(`window.flankStudio.parts.show('twisted-blade.step')`);
    await page.until('document.querySelector("#drop").hidden', PATIENCE);
    await page.value(`${CHOOSER}.choose(['F1'])`);
    return run(page, { tolerance_mm: '-1' });
  })();
  assert.equal(job.exit, 2);
  assert.match(await page.value('document.querySelector(".live .notice").textContent'), /tolerance/);
  await page.close();
});

test('nothing is wider than a phone, and nothing complains in the dark', async () => {
  for (const [width, height, media] of [[390, 844, []], [820, 1180, []], [1440, 900, [{ name: 'prefers-color-scheme', value: 'dark' }]]]) {
    const page = await open({ width, height, media });
    await page.until('document.querySelectorAll("[data-job]").length > 0', PATIENCE);
    assert.ok(await page.value('document.documentElement.scrollWidth <= innerWidth'), `${width} wide`);
    await keep(page, `studio-${width}`);
    assert.deepEqual(page.complaints, []);
    await page.close();
  }
});
