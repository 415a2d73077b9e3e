// The FreeCAD workbench without a window: its operation runs the command, follows the part, is saved, loaded and undone. Run by ctest (label
// clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { BINARY, must, root } from './folder.mjs';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
const NAMES = process.env.FLANK_FREECAD ? [process.env.FLANK_FREECAD] : ['freecadcmd', 'FreeCADCmd', 'freecadcmd-python3'];
const freecad = NAMES.find((name) => !spawnSync(name, ['--version'], { stdio: 'ignore' }).error);
if (!BINARY) skip('FLANK_BINARY does not name the command');
if (!freecad) skip('no FreeCAD here; `make test-clients` installs it');

const here = dirname(fileURLToPath(import.meta.url)), result = join(root, 'workbench.json');
let found;

before(() => {
  const parts = ['envelope-cone-1', 'twisted-blade', 'cavity-barrel', 'rotor37-blisk'].map((example) => {
    const file = join(root, `${example}.step`);
    must('example', example, '-o', file, '--quiet');
    return file;
  });
  const { status, stdout, stderr } = spawnSync(freecad, [join(here, 'freecad_workbench_check.py')], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], timeout: 850000,
    env: { ...process.env, FLANK_PARTS: parts.join(':'), FLANK_RESULT: result, FLANK_WORKBENCH: join(here, '../../freecad/OpenFlank'), HOME: root, QT_QPA_PLATFORM: 'offscreen' } });
  assert.equal(status, 0, stdout + stderr);
  found = JSON.parse(readFileSync(result));
  for (const part of Object.values(found)) assert.equal(part.error, undefined, part.error);
});

const near = (a, b, within, words) => assert.ok(Math.abs(a - b) <= within, `${words}: ${a} is not ${b}`);

test('Face9 of FreeCAD is F9 of the command', () => {
  for (const [name, { freecad: theirs, flank: ours }] of Object.entries(found.operation.mapping)) {
    assert.equal(ours.length, theirs.length, name);
    ours.forEach((area, k) => near(area, theirs[k], 1e-4 * theirs[k], `${name} F${k + 1}`));
  }
});

test('a recompute makes tool, path and map, and its verdict is the exit code', () => {
  const { first, pass } = found.operation;
  assert.equal(first.exit, 0);
  assert.equal(first.verdict, 'meets the request');
  assert.equal(pass, true);
  assert.ok(first.tool > 0 && first.path > 0 && first.facets > 100);
  assert.equal(first.colours, first.facets);
});

test('the tool is moved to the end of the path', () => {
  found.operation.end.forEach((value, k) => near(value, found.operation.poses[k], 1e-6, 'tip'));
});

test('what is moved is computed anew, where it is', () => {
  const { first, moved } = found.operation;
  assert.equal(moved.exit, 0);
  near(moved.place[0] - first.place[0], 100, 0.5, 'x of the path');
});

test('a no and a refusal are said', () => {
  const { failing, refused } = found.operation;
  assert.equal(failing.exit, 1);
  assert.equal(failing.verdict, 'does NOT meet the request');
  assert.ok(failing.reasons.length > 0 && failing.reasons.every((reason) => reason.length > 5), String(failing.reasons));
  assert.match(refused.verdict, /^refused: .*no such tool/);
});

test('it is saved, loaded, computed again and undone', () => {
  const { loaded, recomputed, undone } = found.operation;
  assert.equal(loaded.proxy, 'FlankOperation');
  near(loaded.tolerance, 0.05, 1e-12, 'tolerance');
  assert.ok(loaded.facets > 100);
  assert.equal(recomputed.exit, 0);
  assert.ok(undone >= 1);
});

test('the colours tell both signs apart without green', () => {
  const [over, right, under, unreached] = found.colours;
  assert.ok(over[0] > 0.6 && over[2] < 0.3 && under[2] > 0.6 && under[0] < 0.3 && Math.min(...right) > 0.9);
  near(unreached[0], unreached[2], 0.06, 'grey');
});
