// What a fit writes for other programs, opened in FreeCAD without a window: solids, strips, drawing and tool bit are those
// of tool.json and path.json. Run by ctest (label clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { BINARY, json, must, root } from './folder.mjs';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
const NAMES = process.env.FLANK_FREECAD ? [process.env.FLANK_FREECAD] : ['freecadcmd', 'FreeCADCmd', 'freecadcmd-python3'];
const freecad = NAMES.find((name) => !spawnSync(name, ['--version'], { stdio: 'ignore' }).error);
if (!BINARY) skip('FLANK_BINARY does not name the command');
if (!freecad) skip('no FreeCAD here; `make test-clients` installs it');

const SHANK = { radius: 5, length: 30 }, HOLDER = [[30, 12], [70, 15]];
const folder = join(root, 'fit'), result = join(root, 'freecad.json');
let tool, found, body;

/** The flank as the spheres of tool.json envelope it: radius at a height, and where it ends. */
function bodyOf({ samples, axis_length: length }) {
  const fine = [];
  for (let k = 0; k + 1 < samples.length; ++k)
    for (let i = 0; i < 8; ++i)
      fine.push([0, 1].map((c) => samples[k][c] + ((samples[k + 1][c] - samples[k][c]) * i) / 8));
  fine.push(samples.at(-1));
  const radius = (z) => Math.sqrt(Math.max(0, ...fine.map(([s, r]) => r * r - (z - s) ** 2)));
  // One-sided difference of the fourth order: steep ends bend between the samples.
  const last = samples.slice(-5), slope =
    (25 * last[4][1] - 48 * last[3][1] + 36 * last[2][1] - 16 * last[1][1] + 3 * last[0][1]) / (3 * (last[4][0] - last[0][0]));
  const low = -samples[0][1], high = length - last[4][1] * slope;
  const widest = Math.max(...Array.from({ length: 2001 }, (_, k) => radius(low + ((high - low) * k) / 2000)));
  return { low, high, radius, widest };
}

/** Heights of the flank at which its drawing is measured. */
const heights = () => Array.from({ length: 20 }, (_, k) => body.low + ((body.high - body.low) * (k + 0.5)) / 20);

before(() => {
  const part = join(root, 'blade.step');
  must('example', 'twisted-blade', '-o', part, '--quiet');
  must('fit', part, '--face', 'F1', '--tolerance', '0.1', '--side', '+', '--shank-radius', `${SHANK.radius}`, '--shank-length', `${SHANK.length}`,
    '--holder', HOLDER.map((p) => p.join(':')).join(','), '-o', folder, '--quiet');
  tool = json(folder, 'tool.json');
  body = bodyOf(tool);
  const script = join(dirname(fileURLToPath(import.meta.url)), 'freecad_check.py');
  const { status, stdout, stderr } = spawnSync(freecad, [script], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], timeout: 120000,
    env: { ...process.env, FLANK_FOLDER: folder, FLANK_RESULT: result, FLANK_HEIGHTS: JSON.stringify(heights()), HOME: root, QT_QPA_PLATFORM: 'offscreen' } });
  assert.equal(status, 0, stdout + stderr);
  found = JSON.parse(readFileSync(result));
});

const near = (value, expected, within, words) => assert.ok(Math.abs(value - expected) <= within, `${words}: ${value} is not ${expected}`);

test('tool.step: flank, shank and holder are closed solids of the right size', () => {
  assert.deepEqual(found.tool.map?.((o) => o.label), ['flank', 'shank', 'holder'], JSON.stringify(found.tool));
  for (const o of found.tool) assert.ok(o.valid && o.closed && o.solids === 1, JSON.stringify(o));
  const [flank, shank, holder] = found.tool;
  const { widest } = body;
  let volume = 0;
  for (let k = 0; k < 2000; ++k) {
    const rho = body.radius(body.low + ((body.high - body.low) * (k + 0.5)) / 2000);
    volume += (Math.PI * rho * rho * (body.high - body.low)) / 2000;
  }
  near(flank.volume, volume, 1e-3 * volume, 'volume of the flank');
  [-widest, -widest, body.low, widest, widest, body.high].forEach((x, k) => near(flank.box[k], x, 1e-3, `box of the flank, ${k}`));
  near(shank.volume, Math.PI * SHANK.radius ** 2 * SHANK.length, 1e-6 * shank.volume, 'volume of the shank');
  const [[z0, r0], [z1, r1]] = HOLDER;
  near(holder.volume, (Math.PI / 3) * (z1 - z0) * (r0 * r0 + r0 * r1 + r1 * r1), 1e-6 * holder.volume, 'volume of the holder');
  near(holder.box[5], body.high + z1, 1e-3, 'top of the holder');
});

test('strips.step: one B-spline face a strip, through the contact points of the path', () => {
  const { strips } = json(folder, 'path.json');
  const names = strips.map(({ id }) => `strip ${id}`);
  assert.deepEqual(found.strips.labels, [...names, ...names.map((name) => `${name} axis`)], JSON.stringify(found.strips).slice(0, 500));
  assert.ok(found.strips.valid);
  for (const count of found.strips.faces) assert.equal(count, 1);
  assert.equal(found.strips.kinds[0], 'Part::GeomBSplineSurface');
  assert.equal(found.strips.distances.length, 28 * strips.length);
  // 1e-3 mm of the surface, and the poses are joined to 2e-3 mm.
  for (const [strip, s, distance] of found.strips.distances) near(distance, 0, 3e-3, `contact point of strip ${strip} at s ${s}`);
});

test('tool.dxf: the profile in its size, with its dimensions', () => {
  const { drawing } = found;
  assert.equal(drawing.radii?.length, 20, JSON.stringify(drawing));
  heights().forEach((height, k) => near(drawing.radii[k], body.radius(height), 1e-3, `radius drawn at ${height}`));
  near(drawing.box[4], HOLDER[1][1], 1e-3, 'largest radius drawn');
  const top = body.high + SHANK.length;  // of what is ground: the holder is drawn beside it, and dimensioned by itself
  const { axis_length: length } = tool;
  for (const wanted of [length, top - body.low, 2 * SHANK.radius, SHANK.length, 2 * HOLDER[1][1], HOLDER[1][0] - HOLDER[0][0], body.widest])
    assert.ok(drawing.dimensions.some((d) => Math.abs(d - wanted) < 1e-3), `${wanted} is not among ${drawing.dimensions}`);
});

test('tool.fctb: a bit that holds the tool', () => {
  const written = json(folder, 'tool.fctb');
  assert.equal(found.bit.label, written.name, JSON.stringify(found.bit));
  assert.equal(found.bit.shape, written.shape);
  assert.ok(found.bit.valid);
  near(found.bit.diameter, Number.parseFloat(written.parameter.Diameter), 1e-5, 'diameter');
  near(found.bit.box[5] - found.bit.box[2], Number.parseFloat(written.parameter.Length), 1e-3, 'length');
  assert.ok(found.bit.box[3] >= body.widest - 1e-3);
});
