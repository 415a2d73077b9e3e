// The report page in a real browser: it draws, it moves, its figures are the judge's, and it stays readable with half of
// its files. Run by ctest (label clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { cpSync, mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Browser, findBrowser } from './browser.mjs';
import { BINARY, flank, json, makeBlade, makeLarge, must, root, without } from './folder.mjs';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
if (!BINARY) skip('FLANK_BINARY does not name the command');
if (!findBrowser()) skip('no Chromium here; `make test-clients` installs it');
if (/without the report page/.test(flank('report', '/').stderr)) skip('built without the report page');

let browser, folder;
before(() => {
  folder = makeBlade();
  browser = new Browser();
});
after(() => browser.close());

const open = (where, options) => browser.open(join(where, 'report.html'), options);

/** How many colours the canvas shows, thinned. */
const colours = `(() => { const c = document.querySelector('#canvas'), d = document.createElement('canvas');
  d.width = c.width; d.height = c.height; const x = d.getContext('2d'); x.drawImage(c, 0, 0);
  const p = x.getImageData(0, 0, d.width, d.height).data, seen = new Set();
  for (let k = 0; k < p.length; k += 4 * 37) if (p[k + 3]) seen.add(p[k] << 16 | p[k + 1] << 8 | p[k + 2]);
  return seen.size; })()`;
const tool = 'window.flankReport.view.tool.root.position.toArray()';
const text = (selector) => `document.querySelector(${JSON.stringify(selector)}).textContent`;

test('opens without a complaint and asks the network for nothing', async () => {
  const page = await open(folder);
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests.filter((url) => !/^(file|data|blob):/.test(url)), []);
  assert.equal(await page.value(text('h1')), 'F1 of blade.step');
  assert.match(await page.value(text('#verdict')), /^Meets the request$/);
  await page.close();
});

test('the canvas is not blank', async () => {
  const page = await open(folder);
  assert.ok(await page.value(colours) > 100);
  await page.close();
});

test('the slider moves the tool, by keys too', async () => {
  const page = await open(folder);
  const start = await page.value(tool), words = await page.value(text('#where'));
  await page.value('document.querySelector("#time").focus()');
  await page.key('Home');
  const first = await page.value(tool);
  assert.notDeepEqual(first, start);
  await page.key('End');
  const last = await page.value(tool);
  const poses = json(folder, 'path.json').strips[0].poses;
  for (const [shown, pose] of [[first, poses[0]], [last, poses.at(-1)]])
    shown.forEach((v, k) => assert.ok(Math.abs(v - pose[k]) < 1e-4, `${shown} is not ${pose}`));
  assert.notEqual(await page.value(text('#where')), words);
  assert.match(await page.value('document.querySelector("#time").getAttribute("aria-valuetext")'), /^pass 1, CL point /);
  await page.close();
});

test('play moves the tool, pause stops it', async () => {
  const page = await open(folder);
  const start = await page.value(tool);
  await page.click('#play');
  await page.until(`String(${tool}) !== ${JSON.stringify(String(start))}`);
  assert.equal(await page.value('document.querySelector("#play").getAttribute("aria-label")'), 'Pause');
  await page.click('#play');
  assert.equal(await page.value('window.flankReport.player.playing'), false);
  await page.close();
});

test('a worst place sends the tool there', async () => {
  // A fit may be so good that it has none.
  const spoilt = without(folder, 'spoilt');
  const verify = json(spoilt, 'verify.json');
  const worst = { face: 'F1', point: json(spoilt, 'path.json').strips[0].poses[9].slice(0, 3), f_mm: -0.02, strip: 1, t: 9.4, s_mm: 1 };
  writeFileSync(join(spoilt, 'verify.json'), JSON.stringify({ ...verify, worst_places: [worst] }));
  must('report', spoilt);
  const page = await open(spoilt);
  // What stands in the way of a shank comes before it.
  await page.value('[...document.querySelectorAll(".place")].find((place) => place.querySelector("b").textContent === "1").click()');
  const { t } = await page.value('window.flankReport.path.locate(window.flankReport.player.share)');
  assert.ok(Math.abs(t - worst.t) < 1, `pose ${t} is not ${worst.t}`);
  await page.close();
});

test('the figures are those of verify.json', async () => {
  const page = await open(folder);
  const verify = json(folder, 'verify.json');
  const shown = await page.value('[...document.querySelectorAll("[data-key]")].map((e) => [e.dataset.key, JSON.parse(e.dataset.value)])');
  const keys = shown.map(([key]) => key);
  for (const key of ['coverage', 'coverage_reachable', 'overcut_mm', 'undercut_mm', 'undercut_covered_mm', 'rms_mm', 'gouge_mm', 'overcut_bound_mm', 'gouge_bound_mm'])
    assert.ok(keys.includes(key), key);
  for (const [key, value] of shown) if (key in verify) assert.equal(value, verify[key], key);
  await page.close();
});

test('what a machine does is shown once there is a program', async () => {
  const copy = join(root, 'posted');
  cpSync(folder, copy, { recursive: true });
  must('report', copy, '--quiet');
  let page = await open(copy);
  assert.equal(await page.value(`document.querySelector('#machine') === null`), true);
  await page.close();
  must('post', copy, '--machine', 'linuxcnc-xyzac-trt', '--dry', '-o', join(root, 'posted.ngc'), '--quiet');
  must('report', copy, '--quiet');
  page = await open(copy);
  const { joints, time_s: times, cutting } = json(copy, 'motion.json');
  assert.equal(await page.value(`document.querySelectorAll('#machine .series canvas').length`), joints.length + 3);
  assert.equal(await page.value(`[...document.querySelectorAll('#machine canvas')].every((c) => c.width > 300 && c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some((x) => x > 0))`), true);
  assert.match(await page.value(`document.querySelector('#machine').textContent`), /On linuxcnc-xyzac-trt: .* cutting/);
  // What post has found against its program stands beside the verdict, and with the program.
  const spoilt = without(copy, 'posted-badly'), motion = json(copy, 'motion.json');
  assert.equal(motion.pass, true);
  assert.equal(await page.value('document.querySelector("#program").hidden || document.querySelector("#program").classList.contains("warn")'), true);
  writeFileSync(join(spoilt, 'motion.json'), JSON.stringify({ ...motion, pass: false, reasons: [{ figure: 'gouge_mm', text: 'link 4 cuts F3' }], cautions: [{ figure: 'spindle', text: 'the spindle stands' }] }));
  must('report', spoilt, '--quiet');
  const bad = await open(spoilt);
  assert.equal(await bad.value(text('#program')), 'Program: does NOT pass');
  assert.match(await bad.value(text('#said')), /PROGRAM link 4 cuts F3.*CAUTION, PROGRAM the spindle stands/);
  assert.match(await bad.value(text('#program-words')), /link 4 cuts F3.*the spindle stands/);
  await bad.close();
  // The picture of the axes follows its slider: the solids stand where the joints of that time put them.
  const set = async (time) => {
    await page.value(`(() => { const s = document.querySelector('#machine-time'); s.value = ${time}; s.dispatchEvent(new Event('input')); return 0; })()`);
    const where = await page.value(`document.querySelector('#machine-where').textContent`);
    assert.equal(where.includes('cutting'), cutting[time] === 1);
    for (const joint of joints) assert.ok(where.includes(`${joint.name} ${joint.values[time].toFixed(joint.unit === 'mm' ? 1 : 2)} ${joint.unit}`), where);
    return page.value(`JSON.stringify([...document.querySelectorAll('#machine .solid')].map((e) => [e.dataset.name, e.getAttribute('points')]))`);
  };
  const half = cutting.lastIndexOf(1);
  const first = JSON.parse(await set(0)), later = JSON.parse(await set(half));
  assert.ok(first.some(([name]) => name === 'part') && first.some(([name]) => name === 'tool') && first.some(([name]) => name === 'spindle'));
  assert.ok(times.length > half);
  for (const [k, [name, points]] of later.entries()) {
    assert.match(points, /^[-\d., ]+$/, name);
    assert.ok(points.split(/[ ,]/).every((x) => Number(x) >= 0 && Number(x) <= 420), `${name} is within the picture: ${points}`);
    if (name === 'tool' || name === 'part') assert.notEqual(points, first[k][1], `${name} moves`);
  }
  // Who points at a plot sees the axes at that time, and all plots the same time.
  await set(0);
  const pointed = await page.value(`(() => {
    const over = document.querySelectorAll('#machine .u-over')[3], { left, top, width, height } = over.getBoundingClientRect();
    const at = { clientX: left + width / 2, clientY: top + height / 2, bubbles: true };
    over.dispatchEvent(new MouseEvent('mouseenter', at));
    over.dispatchEvent(new MouseEvent('mousemove', at));
    return new Promise((done) => setTimeout(() => done(JSON.stringify([Number(document.querySelector('#machine-time').value),
      ...[...document.querySelectorAll('#machine .series')].slice(3).map((e) => e.dataset.value)])), 300));
  })()`);
  const [time, ...values] = JSON.parse(pointed);
  assert.ok(Math.abs(time - times.length / 2) < 0.05 * times.length, `the middle: ${time}`);
  for (const [k, joint] of joints.entries()) assert.ok(Math.abs(Number(values[k].replace('\u2212', '-')) - joint.values[time]) <= 1e-3 * Math.abs(joint.values[time]) + 1e-6, `${joint.name}: ${values[k]}`);
  await page.close();
});

test('cycles of a cavity are shown as planned and as replayed', async () => {
  const copy = without(folder, 'cavity');
  const layer = { status: 'done', cycles: 2, fronts: 40, backs: 30, sides: 20, links: 5, volume: 900, side_volume: 1, front_engagement: 59.5,
    back_engagement: 31, side_engagement: 4, entered: 0, cycle_engagement: [12, 59.5], cycle_volume: [100, 800], cycle_way: [30, 40] };
  const stuck = { ...layer, status: 'stuck', cycles: 1, cycle_engagement: [20], cycle_volume: [10], cycle_way: [0] };
  const summary = json(copy, 'summary.json'), verify = json(copy, 'verify.json');
  summary.cavity = { narrowest: 20, engagement: 59.5, most_engagement: 60, way: 130, minutes: 0.2, layers: [layer, stuck] };
  verify.stock = { resolution_deg: 2.7, uncut_mm: 0.2, uncut_point: [1, 2, 3], entered_mm: 0.001, before_mm3: 5000, left_mm3: 4100, engagement_deg: 60.25, strip_engagement_deg: [0, 60.25, 30], strip_volume_mm3: [0, 850, 50], strip_way_mm: [10, 60, 60] };
  writeFileSync(join(copy, 'summary.json'), JSON.stringify(summary));
  writeFileSync(join(copy, 'verify.json'), JSON.stringify(verify));
  must('report', copy, '--quiet');
  const page = await open(copy);
  assert.deepEqual(page.complaints, []);
  assert.equal(await page.value(`document.querySelectorAll('#cavity svg').length`), 4);
  assert.equal(await page.value(`document.querySelectorAll('#cavity tbody tr').length`), 2);
  const words = await page.value(text('#cavity'));
  assert.match(words, /2stuck/);
  assert.match(words, /at most 60\.25 degrees/);
  assert.match(words, /at most 20\.0 mm³/);
  assert.equal(await page.value(`document.querySelectorAll('#cavity rect.bar').length`), 3);
  const figures = await page.value(text('#table'));
  for (const said of [/Engagement, planned59\.50°≤ 60\.0°/, /Layers1 of 2/, /Engagement, simulated60\.25°≤ 60\.0° \+ 2\.7°/, /Material left between the sides0\.200\smm/, /Stock left4\.100\scm³/])
    assert.match(figures, said);
  await page.close();
  const plain = await open(folder);
  assert.equal(await plain.value(`document.querySelector('#cavity') === null`), true);
  await plain.close();
});

test('what stiffness costs is drawn for the tools that were tried', async () => {
  const copy = without(folder, 'stiffness');
  const summary = json(copy, 'summary.json');
  const step = { slenderness: 2, axis_length: 60, largest_radius: 15, strips: 1, coverage: 0.91, overcut: 0.004, other_faces_overcut: 0, rms: 0.002, judged: true, chosen: false };
  summary.stiffness = [step, { ...step, slenderness: 4.2, coverage: 0.999, chosen: true }, { ...step, slenderness: 8, coverage: 0.95, judged: false }];
  writeFileSync(join(copy, 'summary.json'), JSON.stringify(summary));
  must('report', copy, '--quiet');
  const page = await open(copy);
  assert.deepEqual(page.complaints, []);
  assert.equal(await page.value(`document.querySelectorAll('#stiffness svg').length`), 2);
  assert.equal(await page.value(`document.querySelectorAll('#stiffness circle.ring').length`), 3);
  assert.equal(await page.value(`document.querySelectorAll('#stiffness circle.estimate').length`), 3);
  assert.match(await page.value(text('#stiffness')), /3 tools were tried; the ring is the one that was chosen \(L:D 4\.20\)/);
  await page.close();
  summary.stiffness.length = 2;
  writeFileSync(join(copy, 'summary.json'), JSON.stringify(summary));
  must('report', copy, '--quiet');
  const plain = await open(copy);
  assert.equal(await plain.value(`document.querySelector('#stiffness') === null`), true);
  await plain.close();
});

test('layers, colours and cameras change the picture', async () => {
  const page = await open(folder);
  const seen = [await page.value('document.querySelector("#canvas").toDataURL()')];
  const change = async (script) => {
    await page.value(script);
    await page.frames();
    seen.push(await page.value('document.querySelector("#canvas").toDataURL()'));
  };
  for (const box of [0, 1]) await change(`document.querySelectorAll("#layers input")[${box}].click()`);
  await change('(() => { const s = document.querySelector("#layers select"); s.value = "1"; s.dispatchEvent(new Event("change")); })()');
  for (const camera of ['face', 'axis']) await change(`document.querySelector("[data-camera=${camera}]").click()`);
  await page.value('document.querySelector("#canvas").focus()');
  await page.key('ArrowLeft');
  await page.frames();
  seen.push(await page.value('document.querySelector("#canvas").toDataURL()'));
  assert.equal(new Set(seen).size, seen.length);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test('what a tool leaves as it bends is a map of its own', async () => {
  const copy = join(root, 'bending');
  cpSync(folder, copy, { recursive: true });
  must('verify', copy, '--bending', '--material', 'titanium', '--flutes', '3', '--finish-stock', '0.3', '--quiet');
  const { bending } = json(copy, 'verify.json'), [target] = json(copy, 'view.json').bodies.filter((body) => body.target);
  assert.ok(bending.samples > 100 && bending.most_added_mm > 0, JSON.stringify(bending));
  assert.equal(target.bent_mm.length, target.f_mm.length);
  must('report', copy, '--quiet');
  const page = await open(copy);
  const chosen = (value) => page.value(`(() => { const s = [...document.querySelectorAll('#layers select')].find((one) => one.querySelector('[value=bent]')); s.value = '${value}'; s.dispatchEvent(new Event('change')); })()`);
  const seen = [];
  for (const value of ['stiff', 'bent', 'stiff']) {
    await chosen(value);
    await page.frames();
    seen.push(await page.value('document.querySelector("#canvas").toDataURL()'));
  }
  assert.notEqual(seen[0], seen[1]);
  assert.equal(seen[0], seen[2]);
  assert.deepEqual(page.complaints, []);
  await page.close();
  const plain = await open(folder);
  assert.equal(await plain.value(`document.querySelector('#layers [value=bent]')`), null, 'nothing to choose where nobody asked');
  await plain.close();
});

test('everything that can be worked has a name', async () => {
  const page = await open(folder);
  const { nodes } = await page.send('Accessibility.getFullAXTree');
  const roles = ['button', 'slider', 'checkbox', 'combobox', 'image', 'img'];
  const working = nodes.filter((n) => !n.ignored && roles.includes(n.role?.value));
  assert.ok(working.length > 15);
  for (const node of working) assert.ok(node.name?.value, `a ${node.role.value} without a name`);
  await page.close();
});

test('light and dark, by the system and by the button', async () => {
  const ground = 'getComputedStyle(document.body).backgroundColor';
  const media = (value) => [{ name: 'prefers-color-scheme', value }];
  const dark = await open(folder, { media: media('dark') }), light = await open(folder, { media: media('light') });
  const there = await dark.value(ground), here = await light.value(ground);
  assert.notEqual(there, here);
  await light.click('#theme');
  assert.equal(await light.value(ground), there);
  assert.deepEqual([...dark.complaints, ...light.complaints], []);
  await dark.close();
  await light.close();
});

test('nothing sticks out of a narrow window, and it prints', async () => {
  const page = await open(folder, { width: 375, height: 800 });
  assert.equal(await page.value('document.documentElement.scrollWidth'), 375);
  const { data } = await page.send('Page.printToPDF', { printBackground: true });
  assert.ok(Buffer.from(data, 'base64').length > 20000);
  await page.close();
});

test('a folder with half of its files gives a readable page', async () => {
  const cases = [['view.json', /no view\.json.*flank verify/, false], ['verify.json', /no verify\.json/, true], ['summary.json', /no summary\.json/, true]];
  for (const [file, words, canvas] of cases) {
    const half = without(folder, `without-${file}`, file);
    must('report', half);
    const page = await open(half);
    assert.deepEqual(page.complaints, [], file);
    assert.match(await page.value(text('#notices')), words);
    assert.equal(await page.value('document.querySelector("#canvas") !== null'), canvas, file);
    assert.ok((await page.value('document.body.innerText')).length > 300, file);
    await page.close();
  }
});

test('a file without what belongs into it costs only what it would have shown', async () => {
  const hollow = without(folder, 'hollow');
  const tops = { 'view.json': 'view', 'verify.json': 'verify' };
  for (const [file, name] of Object.entries(tops)) {
    const kept = readFileSync(join(hollow, file));
    writeFileSync(join(hollow, file), JSON.stringify({ schema: `openflank/${name}/1` }));
    must('report', hollow);
    const page = await open(hollow);
    assert.deepEqual(page.complaints, [], file);
    assert.match(await page.value(text('#notices')), /cannot be shown/);
    assert.match(await page.value(text('#made')), /OpenFlank/);
    await page.close();
    writeFileSync(join(hollow, file), kept);
  }
  const view = json(hollow, 'view.json');
  writeFileSync(join(hollow, 'view.json'), JSON.stringify({ ...view, strips: [] }));
  must('report', hollow);
  const page = await open(hollow);
  assert.deepEqual(page.complaints, [], 'no strips');
  assert.ok(await page.value(colours) > 20);
  await page.close();
});

test('a wrong folder gives one line and exit 3', () => {
  const wrong = join(root, 'wrong');
  mkdirSync(wrong);
  for (const content of [null, '', '{', '{"schema":"openflank/view/9"}']) {
    if (content !== null) writeFileSync(join(wrong, 'view.json'), content);
    const { status, stdout, stderr } = flank('report', wrong);
    assert.equal(status, 3);
    assert.equal(stdout, '');
    assert.equal(stderr.trim().split('\n').length, 1);
  }
});

test('without WebGL the figures are still there', async () => {
  const plain = new Browser(['--disable-3d-apis']);
  try {
    const page = await plain.open(join(folder, 'report.html'));
    assert.match(await page.value(text('#notices')), /cannot be shown: this browser offers no WebGL 2/);
    assert.deepEqual(page.complaints, []);
    assert.ok(await page.value('document.querySelectorAll("[data-key]").length') >= 7);
    await page.close();
  } finally {
    await plain.close();
  }
});

test('400,000 triangles: under 10 MB, and open soon', async (t) => {
  const large = makeLarge(folder);
  must('report', large);
  const megabytes = statSync(join(large, 'report.html')).size / 1e6;
  const page = await open(large);
  const seconds = (await page.value('Number(document.documentElement.dataset.ready)')) / 1000;
  t.diagnostic(`${megabytes.toFixed(1)} MB, ready after ${seconds.toFixed(1)} s, drawn in software`);
  assert.ok(megabytes < 10);
  // 2 s are promised where there is a graphics card; here two busy cores draw.
  assert.ok(seconds < 8);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test('--png makes a picture of the size that was asked for', () => {
  const png = join(root, 'page.png');
  must('report', folder, '--png', png, '--png-size', '900x700', '--theme', 'dark');
  const bytes = readFileSync(png);
  assert.equal(bytes.toString('latin1', 1, 4), 'PNG');
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [900, 700]);
  assert.ok(bytes.length > 20000);
});
