// What we write for LinuxCNC, in LinuxCNC: its interpreter accepts every program with the same moves, a simulated machine without a
// display runs it to its end, and what its joints did, sampled at 1 kHz, is judged as the planned path was. Broken programs and
// paths past a soft limit are reported. Run by ctest (label clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { chmodSync, existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { BINARY, flank, json, must, root, without } from './folder.mjs';
import { fastTime, fastest, feedSeconds, forwardOf, header, interpret, machineOf, moving, poses, simulate, stated, toPart, whyNot } from './linuxcnc.mjs';

const why = BINARY ? whyNot() : 'FLANK_BINARY does not name the command';
if (why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}

const EXTRA_OVERCUT = 0.002;  // mm beyond the planned path's
const MOST_OF_SPEED = 1.05;   // in a millisecond: the log's own ticks are not quite even
const MOST_OFF_TIME = 0.02;   // of the time that was told
const SAME = 1e-4;            // mm and degrees: the interpreter prints four decimals
const GOLDEN = join(dirname(fileURLToPath(import.meta.url)), '../machine/nc/golden');
const TOOL = { number: 3, length: 62.5 };  // of the golden programs
const golden = (name) => readFileSync(join(GOLDEN, `${name}.txt`), 'utf8');
const FAST = fastTime(root, 8);  // else the machines move in real time
let count = 0;
const fresh = () => join(root, `linuxcnc-${++count}`);

const XYZAC = ['xyzac-trt-kins', ['y-offset=20', 'z-offset=10']], XYZBC = ['xyzbc-trt-kins', ['x-offset=20', 'z-offset=10']];

function expectSameMoves(text, tool) {
  const { status, moves, message } = interpret(fresh(), text, tool);
  assert.equal(status, 0, message);
  const want = stated(text);
  assert.equal(moves.length, want.length);
  moves.forEach((move, i) => {
    assert.equal(move[0], want[i][0], `move ${i}`);
    want[i].slice(1).forEach((v, k) => assert.ok(v === null || Math.abs(v - move[k + 1]) <= SAME, `move ${i}: ${move} is not ${want[i]}`));
  });
}

before(() => chmodSync(root, 0o755));  // the simulated machine runs as another user

for (const file of readdirSync(GOLDEN).filter((f) => f.startsWith('linuxcnc')))
  test(`${file} is accepted with the same moves`, () => expectSameMoves(golden(file.replace('.txt', '')), TOOL));

const BROKEN = {
  'a number with an exponent': (t) => t.replace('F12.5', 'F1.25e1'),
  'a block in inverse time without a feed': (t) => t.replace(/^(X14.*) F[0-9.]+$/m, '$1'),
  'a word twice': (t) => t.replace('Z12.5', 'Z12.5 Z13.0'),
  'a number that is none': (t) => t.replace('Z12.5', 'Znan'),
  'no end': (t) => t.replaceAll('%\n', '').replace('M2', ''),
  'a word of another control': (t) => t.replace('G43 H3', 'G43.4 H3'),
};
for (const [name, breakIt] of Object.entries(BROKEN))
  test(`${name} is reported`, () => {
    const text = golden('linuxcnc_switched'), broken = breakIt(text);
    assert.notEqual(broken, text);
    const { status } = interpret(fresh(), broken, TOOL);
    assert.notEqual(status, 0);
  });

test('a path past a soft limit is reported with its joint', () => {
  const machine = machineOf('linuxcnc-xyzac-trt', ...XYZAC, TOOL);
  machine.joints[0].travel = [-5, 5];
  const { outcome, messages } = simulate(fresh(), golden('linuxcnc_switched'), machine, undefined, undefined, FAST);
  assert.equal(outcome, 'error');
  assert.match(messages.join('\n'), /joint 0|X/);
});

test('a golden program runs to its end through every point that it states', () => {
  const machine = machineOf('linuxcnc-xyzac-trt', ...XYZAC, TOOL);
  const { outcome, messages, joints } = simulate(fresh(), golden('linuxcnc_switched').replace(/^G64.*$/m, 'G61'), machine, undefined, undefined, FAST);
  assert.equal(outcome, 'end', messages.join('\n'));
  const done = poses(moving(joints), forwardOf(machine));
  for (const [kind, x, y, z] of stated(golden('linuxcnc_switched')).filter((m) => m[0] === 'FEED'))
    assert.ok(Math.min(...done.map((p) => Math.hypot(p[0] - x, p[1] - y, p[2] - z))) < 0.05, `${kind} ${x} ${y} ${z}`);
});

/** The samples from the first to the last point that the program reaches at feed; `rows` are what its words state. */
function cutting(rows, text, letters) {
  const feeds = stated(text, letters).filter((m) => m[0] === 'FEED' && !m.includes(null)).map((m) => m.slice(1));
  const near = (target) => (row) => Math.max(...row.map((v, k) => Math.abs(v - target[k]))) < 0.02;
  const first = rows.findIndex(near(feeds[0])), last = rows.findLastIndex(near(feeds.at(-1)));
  assert.ok(first >= 0 && last > first, `the machine was not seen at the first and the last point: ${first}, ${last}`);
  return [first, last];
}

/** What the machine did, in the place of the planned path, judged: [planned, done] of verify.json. */
function judged(folder, name, rows) {
  const copy = without(folder, name, 'verify.json'), path = json(copy, 'path.json');
  path.strips = [{ ...path.strips[0], poses: rows }];
  writeFileSync(join(copy, 'path.json'), JSON.stringify(path));
  flank('verify', copy, '--quiet');  // its verdict is compared below
  return [json(folder, 'verify.json'), json(copy, 'verify.json')];
}

/** Posts the folder's path for a machine, lets LinuxCNC run it, and compares what it cut with what was planned. */
function expectAsPlanned(folder, name, [kinematics, pins], options = [], always = false) {
  const file = join(root, `program-${++count}.ngc`);
  const told = JSON.parse(must('post', folder, '--machine', name, '--spindle', '8000', ...(options.includes('--feed') ? [] : ['--feed', '1000']), '-o', file, '--json', ...options));
  const text = readFileSync(file, 'utf8'), { setup, number, length, offset } = header(text);
  const tool = { number, length }, joints = name === 'joint-ac', machine = { ...machineOf(name, kinematics, pins, tool), always };
  expectSameMoves(text, tool);
  const run = simulate(fresh(), text, joints ? { ...machine, kinematics: 'trivkins', pins: [] } : machine, joints ? [0, 0, 0] : setup.slice(0, 3), undefined, FAST);
  assert.equal(run.outcome, 'end', `${run.line}: ${run.messages.join('\n')}`);
  // From the first sample to the last: nothing jumps where kinematics or the tool's length are switched.
  const jump = fastest(run.joints, machine.joints);
  assert.ok(jump.share <= MOST_OF_SPEED, `joint ${jump.joint} goes ${jump.share.toFixed(2)} times as far in a millisecond as it can, sample ${jump.row}`);
  const rows = moving(run.joints), letters = machine.joints.map((j) => j.name).join('');
  // joint-ac counts its rotary axes the other way round.
  const posesOf = (some) => poses(joints ? some.map(([x, y, z, a, c]) => [x, y, z, -a, -c]) : some, forwardOf(machine));
  const wordsOf = (some, where) => joints ? some : where.map((p, i) => [...p.slice(0, 3).map((v, k) => v - setup[k]), ...some[i].slice(3)]);
  const done = posesOf(rows), words = wordsOf(rows, done);
  const seconds = feedSeconds(wordsOf(run.joints, posesOf(run.joints)), text, letters), off = (60 * told.minutes) / seconds - 1;
  console.log(`# ${name}: ${(60 * told.minutes).toFixed(2)} s told, ${seconds.toFixed(2)} s run, ${(100 * off).toFixed(2)} %`);
  assert.ok(Math.abs(off) <= MOST_OFF_TIME, `told ${60 * told.minutes} s, run ${seconds} s`);
  const [first, last] = cutting(words, text, letters);
  const [planned, real] = judged(folder, `done-${count}`, done.slice(first, last + 1).map((p) => toPart(setup, offset, p)));
  const extra = real.overcut_mm - planned.overcut_mm, bound = real.overcut_bound_mm - planned.overcut_bound_mm;
  console.log(`# ${name}: ${rows.length} samples; overcut ${(1000 * planned.overcut_mm).toFixed(3)} um planned, ${(1000 * extra).toFixed(3)} um more done ` +
    `(bounds ${(1000 * planned.overcut_bound_mm).toFixed(3)}, ${(1000 * bound).toFixed(3)}), coverage ${planned.coverage} and ${real.coverage}`);
  assert.ok(extra <= EXTRA_OVERCUT && bound <= EXTRA_OVERCUT, `overcut ${extra} mm, bound ${bound} mm beyond the planned path's`);
  assert.ok(real.coverage >= planned.coverage - 0.001, `coverage ${real.coverage}, planned ${planned.coverage}`);
}

const blade = join(root, 'blade');
test('a blade is planned', () => {
  must('example', 'twisted-blade', '-o', `${blade}.step`, '--quiet');
  must('fit', `${blade}.step`, '--face', 'F1', '--tolerance', '0.1', '-o', blade, '--quiet');
});
test('the blade on a trunnion of A and C', () => expectAsPlanned(blade, 'linuxcnc-xyzac-trt', XYZAC));
test('the blade on a trunnion of B and C', () => expectAsPlanned(blade, 'linuxcnc-xyzbc-trt', XYZBC));
test('the blade where the kinematics are never switched', () => {
  const { folder: machines } = JSON.parse(must('machine', '--list', '--json')), file = join(root, 'always.toml');
  writeFileSync(file, readFileSync(join(machines, 'linuxcnc-xyzac-trt.toml'), 'utf8').replace(/^tcp_o.*\n/gm, ''));
  expectAsPlanned(blade, file, XYZAC, [], true);
});
test('the blade in joint coordinates', () => expectAsPlanned(blade, 'joint-ac', ['xyzac-trt-kins', []]));

const data = process.env.FLANK_DATA ?? join(dirname(fileURLToPath(import.meta.url)), '../../../shared/data');
/** A real part, fitted and run. */
function real(name, file, ...options) {
  const part = join(data, file);
  test(name, { skip: existsSync(part) ? false : `no ${part}` }, () => {
    const folder = join(root, file.replace(/\W/g, '-'));
    must('fit', part, ...options, '-o', folder, '--quiet');
    expectAsPlanned(folder, 'linuxcnc-xyzac-trt', XYZAC);
  });
}
real('the blade of a compressor', 'r37_blade.step', '--face', 'F1', '--tolerance', '0.1');
real('a blade of an impeller among its neighbours', 'kj66_impeller.step', '--face', 'F1', '--tolerance', '0.01');

/** What a program says of each of its operations, with the text that begins it. */
function operations(text) {
  const begins = [...text.matchAll(/\(OPERATION (\d+) OF (\d+)(?: COPY (\d+) OF (\d+))?/g)];
  return begins.map(({ index, ...m }, k) => {
    const own = text.slice(index, begins[k + 1]?.index);
    return { text: own, ...header(own), copy: Number(m[3] ?? 1), copies: Number(m[4] ?? 1) };
  });
}

/** The stretches of a run between two places where the tool is out of the way, the last `count` of them. */
function stretches(rows, count) {
  const top = rows.reduce((most, r) => Math.max(most, r[2]), -Infinity), found = [];
  rows.forEach((row, i) => {
    if (row[2] > top - 1e-6) return;
    if (i === 0 || rows[i - 1][2] > top - 1e-6) found.push([]);
    found.at(-1).push(row);
  });
  return found.slice(-count);
}

/** A pose of the part turned by an angle about a line along Z through (x, y). */
function turned([px, py, pz, ax, ay, az], [x, y], angle) {
  const c = Math.cos(angle), s = Math.sin(angle), turn = (u, v) => [c * u - s * v, s * u + c * v];
  const [qx, qy] = turn(px - x, py - y), [bx, by] = turn(ax, ay);
  return [qx + x, qy + y, pz, bx, by, az];
}

const pocket = join(data, 'peer/draft_pocket_r6.step'), MIDDLE = [40, 30];
test('two tools in one program, each at both turned halves of a pocket', { skip: existsSync(pocket) ? false : `no ${pocket}` }, () => {
  const folders = [5, 4].map((radius) => join(root, `half-${radius}`)), file = join(root, 'two-tools.ngc'), name = 'linuxcnc-xyzac-trt';
  for (const [k, radius] of [5, 4].entries())
    must('fit', pocket, '--face', 'F7,F8,F9,F10', '--tool', `cylinder:radius=${radius}`, '--tolerance', '0.005', '-o', folders[k], '--quiet');
  must('post', ...folders, '--copies', '2', `--copy-axis=${MIDDLE},0,0,0,1`, '--machine', name, '--spindle', '8000', '--feed', '6000',
    '--operation', '1:name=first', '--operation', '2:name=second,length=85', '-o', file, '--quiet');
  must('verify', ...folders, '--nc', file, '--machine', name, '--quiet');
  const text = readFileSync(file, 'utf8'), each = operations(text), [kinematics, pins] = XYZAC;
  assert.deepEqual(each.map((o) => [o.number, o.copy, o.copies]), [[1, 1, 2], [1, 2, 2], [2, 1, 2], [2, 2, 2]]);
  const tool = [each[0], each[2]].map(({ number, length }) => ({ number, length })), machine = machineOf(name, kinematics, pins, tool);
  expectSameMoves(text, tool);
  const run = simulate(fresh(), text, machine, each[0].setup.slice(0, 3), undefined, FAST);
  assert.equal(run.outcome, 'end', `${run.line}: ${run.messages.join('\n')}`);
  const jump = fastest(run.joints, machine.joints);
  assert.ok(jump.share <= MOST_OF_SPEED, `joint ${jump.joint} goes ${jump.share.toFixed(2)} times as far in a millisecond as it can, sample ${jump.row}`);
  stretches(moving(run.joints), each.length).forEach((rows, k) => {
    const { text: own, setup, number, length, offset, copy, copies } = each[k];
    const done = poses(rows, forwardOf({ ...machine, tool: { number, length } }));
    const words = done.map((p, i) => [...p.slice(0, 3).map((v, axis) => v - setup[axis]), ...rows[i].slice(3)]);
    const [first, last] = cutting(words, own, machine.joints.map((j) => j.name).join(''));
    // Turned back to where the folder has its path.
    const back = (p) => turned(toPart(setup, offset, p), MIDDLE, (-2 * Math.PI * (copy - 1)) / copies);
    const [planned, real] = judged(folders[k >> 1], `operation-${k}`, done.slice(first, last + 1).map(back));
    const extra = real.overcut_mm - planned.overcut_mm;
    console.log(`# operation ${k + 1}, tool ${number}, copy ${copy}: ${rows.length} samples, ${(1000 * extra).toFixed(3)} um more than planned, coverage ${planned.coverage} and ${real.coverage}`);
    assert.ok(extra <= EXTRA_OVERCUT, `operation ${k + 1}: ${extra} mm deeper than planned`);
    assert.ok(real.coverage >= planned.coverage - 0.001, `operation ${k + 1}: coverage ${real.coverage}, planned ${planned.coverage}`);
  });
});

// Four minutes of cutting, in real time.
test('the cycles of a cavity', { skip: process.env.FLANK_LONG ? false : 'set FLANK_LONG=1 for it' }, () => {
  const part = join(root, 'cavity'), folder = join(root, 'cycles');
  must('example', 'cavity-barrel', '-o', `${part}.step`, '--quiet');
  must('trochoid', `${part}.step`, '--left', 'F1', '--right', 'F2', '--tool', `${part}.tool.json`, '--tolerance', '0.02', '--layers', '1', '-o', folder, '--quiet');
  expectAsPlanned(folder, 'linuxcnc-xyzac-trt', XYZAC, ['--feed', '6000']);
});
