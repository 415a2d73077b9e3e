// The FreeCAD workbench in a window, on a screen that nobody sees: it is found, a chosen face is machined, and verdict and error are seen. Run
// by ctest (label clients); exit 77 means skipped. FLANK_PICTURES names a folder for its pictures, which docs/images has.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, mkdirSync, readFileSync, symlinkSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { BINARY, must, root } from './folder.mjs';

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
  const part = join(root, 'blade.step'), modules = join(root, '.local/share/FreeCAD/Mod');
  must('example', 'twisted-blade', '-o', part, '--quiet');
  // As a user installs it.
  mkdirSync(modules, { recursive: true });
  symlinkSync(join(here, '../../freecad/OpenFlank'), join(modules, 'OpenFlank'));
  const { stdout, stderr } = spawnSync('xvfb-run', ['-a', '-s', '-screen 0 1280x900x24', freecad, join(here, 'freecad_window_check.py')], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], timeout: 850000,
    env: { ...process.env, FLANK_PART: part, FLANK_RESULT: result, HOME: root, QTWEBENGINE_DISABLE_SANDBOX: '1' } });
  try {
    found = JSON.parse(readFileSync(result));
  } catch (error) {
    throw new Error(`${error.message}\n${stdout}${stderr}`);
  }
  assert.equal(found.error, undefined, found.error);
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  for (const name of ['workbench-chosen', 'workbench-result']) copyFileSync(join(root, `${name}.png`), join(pictures, `${name}.png`));
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
  assert.equal(found.icon[0], '#c98500');
  assert.equal(found.tree, found.icon[0]);
});

test('the error is seen in colours, and the pictures show more than an empty window', () => {
  assert.equal(found.coloured, true);
  assert.ok(found.chosen_picture > 40000 && found.result_picture > 40000, JSON.stringify(found));
});
