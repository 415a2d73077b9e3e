// The studio in a real browser: a file is dropped, a face is clicked, a tool is found, stopped, gone on with, judged and posted. Run by
// ctest (label clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Browser, processorSeconds, sleep } from './browser.mjs';
import { flank, must, root } from './folder.mjs';
import { hovered, inFrontOf } from './pointing.mjs';
import { CHOOSER, drop, fill, keep, PATIENCE, report, StudioProcess, skipIfMissing } from './studio.mjs';

skipIfMissing();
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
/** Clicks the middle of a face in the picture. */
async function clickFace(page, row) {
  const place = await inFrontOf(page, CHOOSER, row);
  assert.equal(await hovered(page, place), row.id);
  await page.press(...place);
  await page.value(`${CHOOSER}.stage.look('iso')`);
}

const pill = (page) => page.value('(() => { const p = document.querySelector(".livehead .pill"); return [p.className.replace("pill ", ""), p.dataset.exit]; })()');

/** Drops a mesh on the field of the fixtures: nothing runs before its unit is said. */
async function dropFixture(page, file) {
  await page.value('document.querySelector(".more-fields").open = true');
  const [x, y] = await page.value('(() => { const e = document.querySelector("#field-fixtures"); e.scrollIntoView({ block: "center" }); const b = e.getBoundingClientRect(); return [b.x + 5, b.y + 5]; })()');
  await page.drop(x, y, file);
  await page.until(`document.querySelector('#field-fixtures').value.startsWith('vice')`, PATIENCE);
  assert.equal(await page.value('document.querySelector("#run").disabled'), true);
  assert.match(await page.value('document.querySelector("#run-note").textContent'), /vice.*no unit/);
  await fill(page, 'fixture_unit', 'mm');
  assert.equal(await page.value('document.querySelector("#run").disabled'), false);
}

/** Fills the form, runs, waits for the end; the job as the server tells it. */
async function run(page, fields, fixture) {
  await page.value('window.flankStudio.job.form.set({})');
  for (const [name, value] of Object.entries(fields)) await fill(page, name, value);
  if (fixture) await dropFixture(page, fixture);
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
  const spent = () => processorSeconds(browser.process.pid) + processorSeconds(studio.process.pid), begin = Date.now(), before = spent();
  await drop(page, blade);
  const drawn = spent();
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
  const seconds = (Date.now() - begin) / 1000, judged = spent();
  shares.forEach((share, k) => assert.ok(k === 0 || share >= shares[k - 1], `the progress fell: ${shares}`));
  assert.ok(Math.max(...shares) > 0);
  assert.deepEqual(await pill(page), ['pass', '0']);
  await page.until(report('d.querySelector("#verdict").textContent'), PATIENCE);
  assert.equal(await page.value(report('d.querySelector("#verdict").className')), 'pill pass');
  const cost = judged - before;
  console.log(`from the dropped file to the verdict: ${seconds.toFixed(1)} s here, ${cost.toFixed(1)} s of processor time, ${(drawn - before).toFixed(1)} of them to the drawn part; to its report ${(spent() - before).toFixed(1)}`);
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
  await page.value('document.querySelector("#post").click()');
  await page.until('document.querySelector("#sheet")', PATIENCE);
  await page.value('document.querySelector("#sheet").click()');
  await page.until('document.querySelector(".outcome .pill").textContent.startsWith("Set-up")', PATIENCE);
  const sheet = await fetch(`${studio.url}api/jobs/${job.id}/programs/${job.id}-linuxcnc-xyzac-trt.html`);
  assert.match(await sheet.text(), /linuxcnc-xyzac-trt/);
  assert.match(sheet.headers.get('content-disposition'), /^attachment/, 'a page from a folder is no page of the studio');
  const zip = Buffer.from(await (await fetch(`${studio.url}api/jobs/${job.id}/zip`)).arrayBuffer());
  assert.equal(zip.readUInt32LE(0), 0x04034b50);
  await page.close();
});

/** Fields of a job that takes most of a minute of processor time: nothing is that exact. */
const LONG = { tolerance_mm: '0.0001', effort: 'thorough' };
const hasBest = 'document.querySelector(".live .facts")?.textContent.includes("best")';
const markOf = (id) => `document.querySelector('[data-job="${id}"] .mark')?.textContent`;

/** Holds the child of a job still while pages look at it: however slow they are, it cannot come to its end meanwhile. */
async function still(folder, id, look) {
  const { process: child } = JSON.parse(readFileSync(join(folder, 'jobs', id, 'studio.json'), 'utf8'));
  process.kill(child, 'SIGSTOP');
  try {
    await look();
  } finally {
    process.kill(child, 'SIGCONT');
  }
}

/** Clicks Stop, and waits until that is known. */
async function stop(page, of, id) {
  await page.click('.live .stop');
  while (!(await of.get(`jobs/${id}`)).stopping) await sleep(50);
}

/** Begins the long job on a page; it has a best so far. */
async function runLong(page) {
  await page.until(`${CHOOSER}?.stage && document.querySelector('#drop').hidden`, PATIENCE);
  await page.value(`${CHOOSER}.choose(['F1'])`);
  for (const [name, value] of Object.entries(LONG)) await fill(page, name, value);
  await page.until('!document.querySelector("#run").disabled', PATIENCE);
  await page.click('#run');
  await page.until(`${live('state')} === 'running' && ${hasBest}`, PATIENCE);
}

test('stop keeps the best, resume goes on, and two pages see the same', async () => {
  const page = await open(), other = await open();
  if ((await studio.get('state')).parts.includes('twisted-blade.step')) await page.value(`window.flankStudio.parts.show('twisted-blade.step')`);
  else await drop(page, blade);
  const id = String((await studio.get('state')).jobs.length + 1).padStart(4, '0');
  await runLong(page);
  await still(studio.folder, id, () => other.until(`${markOf(id)} === 'runs'`, PATIENCE));
  // A button is the same one for as long as it can be clicked, however often the page looks at the job.
  await page.value('document.querySelector(".live .stop").dataset.kept = "yes"');
  const share = Number(await page.value(live('share')));
  await sleep(1500);
  assert.equal(await page.value('document.querySelector(".live .stop").dataset.kept'), 'yes');
  assert.ok(Number(await page.value(live('share'))) >= share);
  await page.click('.live .stop');
  await page.until(settled, PATIENCE);
  assert.deepEqual(await pill(page), ['warn', '1']);
  const stopped = await studio.get(`jobs/${id}`);
  assert.equal(stopped.resumable, true);
  assert.equal(stopped.summary.complete, false);
  await page.until(report('d.querySelector("#verdict").classList.contains("fail")'), PATIENCE);
  await other.until(`${markOf(id)} === 'stopped'`, PATIENCE);
  // The other page goes on with it, and the first one sees that.
  await other.click(`[data-job="${id}"]`);
  await other.until('document.querySelector(".live .resume")?.hidden === false', PATIENCE);
  await other.click('.live .resume');
  await other.until(`${live('state')} === 'running'`, PATIENCE);
  await still(studio.folder, id, async () => {
    await page.until(`${markOf(id)} === 'runs'`, PATIENCE);
    assert.ok(Number(await other.value(live('share'))) > 0);
    await stop(other, studio, id);
  });
  await page.until(`${markOf(id)} === 'stopped'`, PATIENCE);
  assert.deepEqual([...page.complaints, ...other.complaints], []);
  await Promise.all([page.close(), other.close()]);
});

test('a studio that is killed during a job loses nothing, and one that ends stops it', async () => {
  const folder = join(root, 'killed'), first = await StudioProcess.begin(folder, blade), old = await browser.open(first.url, { width: 1440, height: 900 });
  await runLong(old);
  const { seconds } = await first.get('jobs/0001');
  let second, page;
  await still(folder, '0001', async () => {
    await first.end('SIGKILL');
    await old.until('document.querySelector("#notices .notice")?.textContent.includes("does not answer")', PATIENCE);
    second = await StudioProcess.begin(folder);
    page = await browser.open(second.url, { width: 1440, height: 900 });
    await page.until(`${live('state')} === 'running' && ${hasBest}`, PATIENCE);
    assert.ok((await second.get('jobs/0001')).seconds > seconds, 'the same run goes on');
    await stop(page, second, '0001');
  });
  await page.until(settled, PATIENCE);
  assert.deepEqual(await pill(page), ['warn', '1']);
  await page.click('.live .resume');
  await page.until(`${live('state')} === 'running'`, PATIENCE);
  const begin = Date.now();
  assert.equal(await second.end(), 0);
  console.log(`a studio with a job ended in ${((Date.now() - begin) / 1000).toFixed(1)} s`);
  const third = await StudioProcess.begin(folder), job = await third.get('jobs/0001');
  assert.deepEqual([job.state, job.resumable, job.summary.complete], ['done', true, false]);
  await third.end();
  await Promise.all([old.close(), page.close()]);
});

test('the verdict is the exit code: passes, fails, collides, is not proved', async () => {
  const page = await open({ width: 1200 });
  const cone = join(root, 'cone.step'), vice = join(root, 'vice.stl');
  must('example', 'envelope-cone-1', '-o', cone, '--quiet');
  await drop(page, cone);
  const [row] = JSON.parse(must('inspect', cone, '--json')).faces;
  writeFileSync(vice, cube(row.centre, row.normal));
  await page.value(`${CHOOSER}.choose(['F1'])`);
  const quick = { tolerance_mm: '0.05', effort: 'quick' };
  const cases = { passes: [quick, 0], fails: [{ ...quick, coverage: '1', radius_max_mm: '0.3', radius_min_mm: '0.2' }, 1], 'is not proved': [{ ...quick, tolerance_mm: '0.01', sample_mm: '3.6' }, 1], collides: [{ ...quick, avoid: 'off' }, 1, vice] };
  for (const [name, [fields, exit, fixture]] of Object.entries(cases)) {
    const job = await run(page, fields, fixture);
    assert.equal(job.exit, exit, `${name}: ${job.line} ${job.message}`);
    assert.deepEqual(await pill(page), [exit === 0 ? 'pass' : 'fail', String(exit)], name);
    assert.equal(job.summary.pass, exit === 0, name);
    await page.until(report('d.querySelector("#verdict").textContent'), PATIENCE);
    assert.equal(await page.value(report('d.querySelector("#verdict").classList.contains("fail")')), exit !== 0, name);
    if (name === 'collides') assert.match(JSON.stringify(job.summary.reasons), /vice\.stl/);
    if (name === 'is not proved') assert.match(JSON.stringify(job.summary.reasons), /not proved/);
  }
  await page.close();
});

test('what is refused is said in the command’s words, and the faces of a wheel have names', async () => {
  const page = await open(), wheel = join(root, 'wheel.step');
  must('example', 'impeller', '-o', wheel, '--quiet');
  await drop(page, wheel);
  await page.value(`${CHOOSER}.parts.click()`);
  await page.until(`!${CHOOSER}.parts.disabled`, PATIENCE);
  const { hub, blades } = JSON.parse(must('inspect', wheel, '--wheel', '--json')), named = (words) => page.value(`${CHOOSER}.rows.filter(({ of }) => of?.includes(${JSON.stringify(words)})).map(({ id }) => id)`);
  assert.deepEqual(await named('hub'), hub);
  assert.deepEqual(await named(`${blades[0].kind} 1 ahead`), blades[0].ahead);
  const broken = join(root, 'broken.step');
  writeFileSync(broken, 'no part');
  await page.drop(300, 400, broken);
  await page.until('document.querySelector("#drop .notice")', PATIENCE);
  assert.match(await page.value('document.querySelector("#drop .notice").textContent'), /broken\.step/);
  const job = await (async () => {
    await page.value(`window.flankStudio.parts.show('wheel.step')`);
    await page.until('document.querySelector("#drop").hidden', PATIENCE);
    await page.value(`${CHOOSER}.choose(['F1'])`);
    return run(page, { tolerance_mm: '-1' });
  })();
  assert.equal(job.exit, 2);
  assert.match(await page.value('document.querySelector(".live .notice").textContent'), /tolerance/);
  await page.close();
});

/** A cube of 20 mm in front of a face, as triangles in text. */
function cube(centre, normal) {
  const at = centre.map((c, k) => c + 20 * normal[k]), corner = (n) => [0, 1, 2].map((k) => at[k] + (n >> k & 1 ? 10 : -10)).join(' ');
  const quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  const facet = (a, b, c) => `facet normal 0 0 0\nouter loop\n${[a, b, c].map((n) => `vertex ${corner(n)}`).join('\n')}\nendloop\nendfacet\n`;
  return `solid vice\n${quads.map(([a, b, c, d]) => facet(a, b, c) + facet(a, c, d)).join('')}endsolid vice\n`;
}
