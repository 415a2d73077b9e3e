// The FreeCAD workbench in a window, on a screen that nobody sees: it is found, a chosen face is machined, and verdict and error are seen. Run
// by ctest (label clients); exit 77 means skipped. FLANK_PICTURES names a folder for its pictures, which docs/images has.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, mkdirSync, readFileSync, symlinkSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { BINARY, flank, must, root } from './folder.mjs';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
const missing = (name) => spawnSync('sh', ['-c', `command -v ${name}`]).status !== 0;
const freecad = ['freecad', 'FreeCAD', 'freecad-python3'].find((name) => !missing(name));
if (!BINARY) skip('FLANK_BINARY does not name the command');
if (!freecad || missing('xvfb-run')) skip('no FreeCAD or no xvfb-run here; `make test-clients` installs them');

const here = dirname(fileURLToPath(import.meta.url)), result = join(root, 'window.json'), pictures = process.env.FLANK_PICTURES;
let found;

before(() => {
  const part = join(root, 'blade.step'), wheel = join(root, 'impeller.step'), modules = join(root, '.local/share/FreeCAD/Mod');
  must('example', 'twisted-blade', '-o', part, '--quiet');
  must('example', 'impeller', '-o', wheel, '--quiet');
  // As a user installs it.
  mkdirSync(modules, { recursive: true });
  symlinkSync(join(here, '../../freecad/OpenFlank'), join(modules, 'OpenFlank'));
  const { stdout, stderr } = spawnSync('xvfb-run', ['-a', '-s', '-screen 0 1280x900x24', freecad, join(here, 'freecad_window_check.py')], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], timeout: 850000,
    env: { ...process.env, FLANK_PART: part, FLANK_WHEEL: wheel, FLANK_RESULT: result, HOME: root, QTWEBENGINE_DISABLE_SANDBOX: '1' } });
  try {
    found = JSON.parse(readFileSync(result));
  } catch (error) {
    throw new Error(`${error.message}\n${stdout}${stderr}`);
  }
  assert.equal(found.error, undefined, found.error);
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  for (const name of ['chosen', 'result', 'panel', 'job', 'progress'].map((one) => `workbench-${one}`)) copyFileSync(join(root, `${name}.png`), join(pictures, `${name}.png`));
});

test('its command is there when a face is chosen', () => {
  assert.equal(found.active_without_choice, false);
  assert.equal(found.active, true);
});

test('the chosen face is machined, and what belongs to it stands below it', () => {
  assert.equal(found.exit, 0, String(found.reasons));
  assert.equal(found.verdict, 'meets the request');
  assert.equal(found.children.length, 3);
});

test('the verdict is seen in the tree: amber, for it has cautions', () => {
  assert.equal(found.icon, '#c98500');
  assert.equal(found.tree, found.icon);
});

test('the error is seen in colours, and the pictures show more than an empty window', () => {
  assert.equal(found.coloured, true);
  for (const size of [found.chosen_picture, found.result_picture, found.panel.panel_picture, found.panel.job_picture]) assert.ok(size > 40000, JSON.stringify(found));
});

test('the panel moves the tool along its path, and writes the program', () => {
  assert.ok(found.panel.moved > 1, `${found.panel.moved} mm`);
  for (const name of ['Run again', 'Write program…', 'To CAM job', 'Report']) assert.ok(found.panel.buttons.includes(name), found.panel.buttons.join());
  assert.match(found.panel.written, /written\.ngc: meets the request/);
  assert.equal(flank('verify', found.folder, '--nc', join(root, 'written.ngc'), '--machine', 'linuxcnc-xyzac-trt', '--quiet').status, 0);
});

test('the CAM job is posted by FreeCAD itself, and its program does the same as ours', () => {
  assert.ok(found.panel.job_objects > 0 && found.panel.operations.length === 1 && found.panel.operations[0][1] > 50, JSON.stringify(found.panel));
  assert.equal(found.panel.programs, 1);
  // FreeCAD's program does not say where the part sits on the table; ours does.
  const [, setup] = /\(SETUP ([^)]*)\)/.exec(readFileSync(join(root, 'written.ngc'), 'utf8'));
  assert.doesNotMatch(readFileSync(join(root, 'freecad.ngc'), 'utf8'), /G53 *\n/, 'the machine coordinates belong to a move');
  const judged = flank('verify', found.folder, '--nc', join(root, 'freecad.ngc'), '--machine', 'linuxcnc-xyzac-trt', `--setup=${setup}`);
  assert.equal(judged.status, 0, judged.stdout + judged.stderr);
});

test('undo takes the job away again', () => assert.equal(found.panel.undone_job, 0));

test('neither the player nor the job plans the operation anew', () => assert.equal(found.panel.planned_again, false));

test('Stop keeps the best, and says so', () => {
  const { verdict, exit, label, shares, icon } = found.stopped;
  assert.equal(exit, 1);
  assert.equal(verdict, 'stopped, does NOT meet the request');
  assert.match(label, /best/);
  assert.equal(icon, '#b3241f');
  shares.forEach((share, k) => assert.ok(k === 0 || share >= shares[k - 1], `the progress fell: ${shares}`));
  console.log(`stopped ${found.stopped.seconds.toFixed(1)} s after its begin`);
});

test('an edit of the part is followed, undone, saved and loaded', () => {
  const { first, longer, undone, loaded, recomputed } = found.edited;
  assert.equal(first.exit, 0, first.verdict);
  assert.equal(longer.exit, 0, longer.verdict);
  assert.ok(longer.length > 1.3 * first.length, `${longer.length} is not longer than ${first.length}`);
  assert.equal(undone.x2, 40);
  assert.ok(Math.abs(undone.length - first.length) < 1e-6, `${undone.length} is not ${first.length}`);
  assert.equal(loaded.verdict, undone.verdict);
  assert.equal(loaded.tree, loaded.icon);
  assert.ok(loaded.facets > 50 && loaded.children === 3);
  assert.equal(recomputed.exit, 0);
  assert.ok(recomputed.length > 1.1 * first.length && recomputed.length < longer.length);
});

test('a wheel is an operation, too: its Stop is heard, its operations are listed, its verdict is the exit code', () => {
  const { active_without_choice: idle, active, stopped, first, tree, place } = found.wheel;
  assert.deepEqual([idle, active], [false, true]);
  assert.deepEqual([stopped.verdict, stopped.exit], ['stopped, does NOT meet the request', 1]);
  const plan = JSON.parse(readFileSync(join(found.wheel.folder, 'plan.json')));
  assert.deepEqual(first.operations.map((words) => words.split(' ')[0]), plan.operations.map(({ id }) => id));
  assert.ok(first.operations.filter((words) => /: done/.test(words)).length > 1, first.operations.join());
  assert.equal(first.exit === 0, plan.pass);
  assert.equal(first.verdict, plan.pass ? 'meets the request' : 'does NOT meet the request');
  assert.equal(first.reasons.length > 0, !plan.pass);
  assert.ok(first.facets > 100 && first.length > 10 && first.children === 3, JSON.stringify(first));
  assert.equal(tree, first.icon);
  assert.match(place, /^pass \d+, point \d+$/);
});

test('a wheel that is loaded says what it said', () => {
  const { first, loaded } = found.wheel;
  assert.deepEqual([loaded.proxy, loaded.verdict, loaded.operations], ['WheelOperation', first.verdict, first.operations]);
});

test('what cannot be done with a piece of a wheel is said', () => {
  assert.match(found.wheel.posted, /expected a whole wheel/);
  assert.match(found.wheel.job, /expected a whole wheel/);
});
