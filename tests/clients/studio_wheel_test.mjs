// A whole wheel in the studio: its faces get their roles, its operations are listed as they are done, a stop keeps them, the whole is
// judged, and its program is written and judged. Run by ctest (label clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { copyFileSync, existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Browser } from './browser.mjs';
import { flank, must, root } from './folder.mjs';
import { CHOOSER, drop, fill, keep, report, StudioProcess, skipIfMissing } from './studio.mjs';

skipIfMissing();
/** Seconds: a wheel is many fits, and the machine may do much else. */
const LONG = 1500;
/** A wheel with all of its blades; the example is a piece of one, of which there is no program. */
const WHOLE = join(process.env.FLANK_DATA ?? '', 'wheels/inducer.step'), whole = existsSync(WHOLE);
let browser, studio, wheel, page;
before(async () => {
  wheel = join(root, 'wheel.step');
  if (whole) copyFileSync(WHOLE, wheel);
  else must('example', 'impeller', '-o', wheel, '--quiet');
  browser = new Browser();
  studio = await StudioProcess.begin(join(root, 'studio'));
  page = await browser.open(studio.url, { width: 1440, height: 900 });
});
after(async () => {
  await browser.close();
  await studio.end();
});

const live = (what) => `document.querySelector('.live')?.dataset.${what}`;
const settled = `${live('state')} === 'done'`;
const listed = () => page.value('[...document.querySelectorAll(".plan tbody tr")].map((row) => [row.querySelector("button").dataset.operation, row.querySelector(".mark").textContent])');

test('the faces of a wheel get their roles, and the job says what it found', async () => {
  await drop(page, wheel);
  await page.click('[data-command="wheel"]');
  await page.until('/main blade/.test(document.querySelector("#chosen").textContent)', LONG);
  const roles = JSON.parse(must('inspect', wheel, '--wheel', '--json'));
  const rows = JSON.parse(await page.value(`JSON.stringify(${CHOOSER}.rows.map(({ id, role }) => [id, role]))`));
  for (const id of roles.hub) assert.equal(rows.find(([face]) => face === id)[1], 'hub');
  assert.match(await page.value('document.querySelector("#chosen").textContent'), new RegExp(`${roles.blades.filter(({ kind }) => kind !== 'splitter').length} main blades.*hub ${roles.hub[0]}`));
  const kinds = await page.value('[...document.querySelectorAll(".kind")].map((button) => button.dataset.kind)');
  const splitters = roles.blades.some(({ kind }) => kind === 'splitter');
  for (const kind of ['hub', 'blade side', ...(splitters ? ['splitter side'] : []), 'edge']) assert.ok(kinds.includes(kind), kinds.join());
  assert.equal(await page.value('document.querySelector("#run").disabled'), false);
  await keep(page, 'studio-wheel');
});

// Roughing and edges take most of the time of a wheel; the check by samples alone is quick, and its verdict is no.
test('operations are listed as they are done; Stop keeps them, and Resume goes on with the others', async () => {
  for (const [name, value] of Object.entries({ rough: 'off', edges: 'off', sample_mm: '0.5' })) await fill(page, name, value);
  const line = await page.value('document.querySelector("#line").textContent');
  assert.match(line, /^flank wheel wheel\.step .*--rough off --edges off --sample 0\.5 -o out$/);
  assert.match(await page.value('document.querySelector("#python").textContent'), /openflank\.wheel\("wheel\.step", "out", .*rough=False/);
  await page.click('#run');
  await page.until('document.querySelector(".plan tbody tr")', LONG);
  await page.click('.live .stop');
  await page.until(settled, LONG);
  const [id] = (await studio.get('state')).jobs.map((job) => job.id), stopped = await studio.get(`jobs/${id}`);
  assert.equal(stopped.resumable, true);
  assert.equal(stopped.exit, 1);
  assert.equal(stopped.plan.pass, undefined);
  const before = stopped.plan.operations.find((one) => one.id === '20');
  assert.equal(before.done, true);
  // What is done is a result that can be looked at.
  await page.click('[data-operation="20"]');
  await page.until(report('d.querySelector("#verdict").textContent'), LONG);
  await page.click('.live .resume');
  await page.until(`${live('state')} === 'running'`, LONG);
  const shares = [];
  while (!(await page.value(settled))) {
    shares.push(Number(await page.value(live('share'))));
    await new Promise((done) => setTimeout(done, 500));
  }
  shares.forEach((share, k) => assert.ok(k === 0 || share >= shares[k - 1], `the progress fell: ${shares}`));
  const whole = await studio.get(`jobs/${id}`);
  const after = whole.plan.operations.find((one) => one.id === '20');
  assert.equal(after.seconds, before.seconds, 'the sides were not done again');
  assert.equal(whole.exit === 0, whole.plan.pass);
  assert.equal(whole.resumable, false);
  assert.deepEqual(await listed(), whole.plan.operations.map((one) => [one.id, one.done ? (one.pass ? 'done' : 'below') : 'not done']));
});

test('the verdict is the exit code, and the report shows the whole', async () => {
  const [job] = (await studio.get('state')).jobs, state = job.exit === 0 ? 'pass' : 'fail';
  assert.equal(await page.value('document.querySelector(".livehead .pill").dataset.exit'), String(job.exit));
  assert.ok(await page.value(`document.querySelector(".livehead .pill").classList.contains("${state}")`));
  assert.equal(await page.value('document.querySelector("[data-operation=whole]").getAttribute("aria-pressed")'), 'true');
  await page.until(report(`d.querySelector("#verdict").classList.contains("${state}")`), LONG);
  const passes = JSON.parse(await (await fetch(`${studio.url}api/jobs/${job.id}/files/path.json`)).text()).strips.length;
  assert.match(await page.value(report('d.querySelector("#subtitle").textContent')), new RegExp(`\\b${passes} passes`));
  await keep(page, 'studio-wheel-result');
});

test('every operation has the shank that was chosen for all of them, and the whole is judged with it', async () => {
  const [{ id, plan }] = (await studio.get('state')).jobs, folder = join(studio.folder, 'jobs', id, 'result');
  const text = (...names) => readFileSync(join(folder, ...names), 'utf8');
  const operations = (plan ?? (await studio.get(`jobs/${id}`)).plan).operations.filter(({ done }) => done);
  const tools = JSON.parse(text('plan.json')).operations;
  assert.ok(JSON.parse(text('tools', 'T1.json')).shank.profile.length >= 2);
  for (const { id: number } of operations) {
    const { folder: own, tool } = tools.find((one) => one.id === number);
    assert.equal(text(own, 'tool.json'), text('tools', `${tool}.json`), number);
  }
  assert.equal(text('tool.json'), text('tools', 'T1.json'));
  assert.ok(JSON.parse(text('verify.json')).clearance.some(({ body }) => body === 'shank'));
});

const MACHINE = 'linuxcnc-xyzac-trt';
const outcome = () => page.value('document.querySelector(".outcome .pill").dataset.exit');
/** Chooses machine, spindle and feed, and has the program written, although a check by samples alone proves nothing. */
async function post() {
  await page.until('document.querySelector("#post")', LONG);
  await page.value(`(() => { const m = document.querySelector("#machine-name"); m.value = "${MACHINE}"; m.dispatchEvent(new Event("change")); })()`);
  for (const [name, value] of Object.entries({ spindle: '12000', feed_mm_min: '800', force: 'on' })) await fill(page, name, value);
  await page.click('#post');
  await page.until('document.querySelector(".outcome .pill")', LONG);
}

test('the program of the whole wheel is written and judged, and its bytes are the command’s', { skip: whole ? false : 'FLANK_DATA has no wheels/inducer.step' }, async () => {
  const [{ id }] = (await studio.get('state')).jobs, folder = join(studio.folder, 'jobs', id, 'result'), file = join(root, 'by-hand.ngc');
  await post();
  const { status } = flank('post', folder, '--machine', MACHINE, '--spindle', '12000', '--feed', '800', '--force', '-o', file, '--quiet');
  assert.equal(await outcome(), String(status));
  const [job] = (await studio.get('state')).jobs, link = await page.value('document.querySelector(".outcome a.download").href');
  assert.deepEqual(job.programs, [`${id}-${MACHINE}.nc`]);
  const text = await (await fetch(link)).text();
  assert.equal(text, readFileSync(file, 'utf8'));
  // Every copy of every operation that is done is one of the program.
  const copies = job.plan?.operations ?? (await studio.get(`jobs/${id}`)).plan.operations;
  const count = copies.filter(({ done }) => done).reduce((sum, one) => sum + one.copies, 0);
  assert.equal(text.match(/^\(OPERATION \d+ OF/gm).length, count);
  await page.click('#judge');
  await page.until('document.querySelector(".outcome .pill").textContent.startsWith("Program")', LONG);
  assert.equal(await outcome(), String(flank('verify', folder, '--nc', file, '--machine', MACHINE, '--quiet').status));
  await keep(page, 'studio-wheel-machine');
});

test('a piece of a wheel has no program of the whole, which is said', { skip: whole ? 'the wheel is whole' : false }, async () => {
  await post();
  assert.equal(await outcome(), '3');
  assert.match(await page.value('document.querySelector(".outcome .notice").textContent'), /expected a whole wheel/);
});

test('the archive has every operation', async () => {
  const [job] = (await studio.get('state')).jobs;
  const zip = Buffer.from(await (await fetch(`${studio.url}api/jobs/${job.id}/zip`)).arrayBuffer());
  for (const name of ['plan.json', 'ops/20-side/path.json', 'tools/T1.json']) assert.ok(zip.includes(name), name);
  assert.deepEqual(page.complaints, []);
});
