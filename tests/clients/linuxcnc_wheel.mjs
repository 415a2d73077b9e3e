// Runs the whole program of a wheel in LinuxCNC to its end, and judges what its joints did as the planned path was judged.
//
// usage: linuxcnc_wheel.mjs FOLDER PROGRAM RUN [TIMES LIBRARY]
//
// FOLDER is what `flank wheel` wrote, PROGRAM what `flank post FOLDER --machine linuxcnc-xyzac-trt` did. RUN is a new folder: of the run, and
// of its results done-1, done-2, ..., by the numbers of the tools. A run that lies there already is judged again. With TIMES the simulated time passes so many times as fast as the clock, by the library that
// `gcc -O2 -shared -fPIC -o LIBRARY linuxcnc_fast.c` makes. FLANK_BINARY and FLANK_LINUXCNC_KINEMATICS name the command and the program that
// asks LinuxCNC's kinematics, as in the tests.
import { cpSync, existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { flank, json } from './folder.mjs';
import { fastest, forwardOf, header, logged, machineOf, poses, simulate, stated, toPart } from './linuxcnc.mjs';

const [folder, program, runs, times, library] = process.argv.slice(2);
const text = readFileSync(program, 'utf8'), plan = json(folder, 'plan.json');
const ALIKE = 1e-4;  // mm and degrees: rows so near to the line between those beside them are left out
const MOST_ROWS = 50;  // between two that are kept
const PIECE = 200;     // poses of a strip: the judge groups strips that are near to each other, and one of the whole run has none

/** Each tool once, with the header of its first operation. */
const tools = new Map();
for (const part of text.split(/(?=\(OPERATION \d+ OF)/).slice(1)) {
  const told = { ...header(part), rough: /^\(OPERATION[^)]*-rough/.test(part) };
  if (!tools.has(told.number)) tools.set(told.number, told);
}
const machine = machineOf('linuxcnc-xyzac-trt', 'xyzac-trt-kins', ['y-offset=20', 'z-offset=10'],
  [...tools.values()].map(({ number, length }) => ({ number, length })));
const [first] = tools.values();
console.log(`tools ${[...tools.keys()]}, ${stated(text).length} moves`);
const begun = Date.now();
const run = existsSync(join(runs, 'result.json')) ? logged(runs, machine) : simulate(runs, text, machine, first.setup.slice(0, 3), 4000, times ? { times: Number(times), library } : undefined);
console.log(`${run.outcome} after ${((Date.now() - begun) / 1000).toFixed(0)} s, line ${run.line}, ${run.joints.length} periods of a millisecond` +
  `${run.messages.length ? `, messages: ${run.messages.join('; ')}` : ''}`);
const jump = fastest(run.joints, machine.joints);
console.log(`fastest joint ${jump.joint}: ${jump.share.toFixed(3)} of its speed, row ${jump.row}`);
if (run.outcome !== 'end') process.exit(1);

/** Rows without those that lie on the line between the ones beside them. */
function bends(rows) {
  const out = [rows[0]];
  const on = (from, to, row) => {
    // By the joint that goes farthest: time says nothing here.
    let most = 0;
    to.forEach((v, k) => { if (Math.abs(v - from[k]) > Math.abs(to[most] - from[most])) most = k; });
    const share = to[most] === from[most] ? 0 : (row[most] - from[most]) / (to[most] - from[most]);
    return share >= -1e-9 && share <= 1 + 1e-9 && row.every((v, k) => Math.abs(from[k] + share * (to[k] - from[k]) - v) <= ALIKE);
  };
  let from = 0;
  for (let to = 2; to < rows.length; ++to) {
    let all = to - from <= MOST_ROWS;
    for (let k = from + 1; all && k < to; ++k) all = on(rows[from], rows[to], rows[k]);
    if (all) continue;
    from = to - 1;
    out.push(rows[from]);
  }
  out.push(rows.at(-1));
  return out;
}

let bad = 0;
for (const { number, length, offset, setup, rough: roughs } of tools.values()) {
  const rows = run.joints.filter((row, k) => run.tools[k] === number), top = rows.reduce((most, r) => Math.max(most, r[2]), -Infinity);
  // Away from the part, where the tool comes and goes, nothing is cut.
  const work = rows.slice(rows.findIndex((r) => r[2] < top - 1e-6), rows.findLastIndex((r) => r[2] < top - 1e-6) + 1), kept = bends(work);
  const done = poses(kept, forwardOf({ ...machine, tool: { number, length } })).map((p) => toPart(setup, offset, p));
  // The operations that rough are judged together, in the folder of the first one.
  const steps = roughs ? plan.operations.filter((o) => o.kind === 'rough' && o.done).map((o) => join(folder, o.folder)) : [];
  const sources = steps.length > 0 ? steps : [folder], [source] = sources, copy = join(runs, `done-${number}`);
  cpSync(source, copy, { recursive: true, filter: (name) => !/(manifest\.json|report\.html|verify\.json|plan\.json|\/ops|\/fits)$/.test(name) });
  const path = json(source, 'path.json'), [like] = path.strips;
  path.strips = [];
  // Each begins where the one before it ends, so nothing of the motion is left out.
  for (let k = 0; k + 1 < done.length; k += PIECE)
    path.strips.push({ ...like, id: path.strips.length + 1, poses: done.slice(k, k + PIECE + 1) });
  writeFileSync(join(copy, 'path.json'), JSON.stringify(path));
  const begin = Date.now(), { status, stderr } = flank('verify', copy, '--quiet');
  const real = json(copy, 'verify.json'), planned = json(source, 'verify.json');
  const worst = (v, key) => Math.max(0, ...v.faces.map((f) => f[key]));
  // What was done has no plan that says which faces stand for their copies.
  const copies = new Map(planned.faces.map((f) => [f.face, f.copies ?? 1])), targets = (v) => v.faces.filter((f) => f.target);
  const sum = (v, of) => targets(v).reduce((all, f) => all + of(f) * f.area_mm2 * copies.get(f.face), 0);
  const coverage = (v) => sum(v, (f) => f.coverage) / sum(v, () => 1);
  const asPlanned = (key) => Math.max(...sources.map((one) => worst(json(one, 'verify.json'), key)));
  const extra = worst(real, 'overcut_mm') - asPlanned('overcut_mm'), bound = worst(real, 'overcut_bound_mm') - asPlanned('overcut_bound_mm');
  console.log(`tool ${number}: ${work.length} rows, ${kept.length} kept; deepest cut of any face ${(1000 * asPlanned('overcut_mm')).toFixed(3)} um planned, ` +
    `${(1000 * extra).toFixed(3)} um more done (proved ${(1000 * bound).toFixed(3)}); coverage ${coverage(planned)} and ${coverage(real)}; exit ${status} ${stderr} ${((Date.now() - begin) / 1000).toFixed(0)} s`);
  if (extra > 0.002) ++bad;
}
process.exit(bad ? 1 : 0);
