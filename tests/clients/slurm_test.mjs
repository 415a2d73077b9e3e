// A sweep on a real Slurm: the same bytes as here, also when a task is killed, the controller dies, or the sweep itself.
// Run by ctest (label clients); exit 77 means skipped.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { after, before, test } from 'node:test';
import { BINARY, flank, must, root } from './folder.mjs';
import { Slurm, until, whyNot, within } from './slurm.mjs';

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
if (!BINARY) skip('FLANK_BINARY does not name the command');
if (whyNot()) skip(whyNot());

const plan = join(root, 'plan.toml'), out = join(root, 'out');
const slurm = new Slurm(join(root, 'slurm'));
let here, last;

/** Every file of a folder, by its name. */
function files(folder) {
  const all = new Map();
  const look = (name) => {
    for (const entry of readdirSync(name, { withFileTypes: true })) {
      const path = join(name, entry.name);
      if (entry.isDirectory()) look(path);
      else all.set(relative(folder, path), readFileSync(path));
    }
  };
  look(folder);
  return all;
}

function assertSame(found, expected) {
  assert.deepEqual([...found.keys()].sort(), [...expected.keys()].sort());
  for (const [name, bytes] of expected) assert.ok(bytes.equals(found.get(name)), `${name} has other bytes`);
}

/** The sweep as a process: its end as a promise. */
function sweep(...words) {
  const child = (last = spawn(BINARY, ['sweep', plan, '-o', out, '--engine', 'slurm', '--quiet', ...words], { env: slurm.env, stdio: ['ignore', 'ignore', 'pipe'] }));
  let told = '';
  child.stderr.on('data', (text) => (told += text));
  const end = new Promise((done) => child.on('close', (status) => done({ status, told })));
  return { child, end };
}
const records = () => (existsSync(out) ? readdirSync(out).filter((name) => name.endsWith('.task.json')) : []);

before(async () => {
  must('example', 'twisted-blade', '-o', join(root, 'blade.step'), '--quiet');
  const tools = [3, 4, 5, 6, 7, 8].map((radius) => `"cylinder:radius=${radius}"`).join(', ');
  writeFileSync(plan, `schema = "openflank/sweep-plan/1"\ncommand = "cover"\npart = "blade.step"\nfaces = ["F1"]\ntools = [${tools}]\nretries = 2\n` +
    '[options]\ntolerance_mm = 0.5\naxis_length_mm = 20\nstrips = 1\nsample_mm = 2.0\n');
  const { status } = flank('sweep', plan, '-o', out, '--quiet');
  assert.ok(status === 0 || status === 1);
  here = { status, files: files(out) };
  rmSync(out, { recursive: true });
  await slurm.start(2);
});
after(() => {
  last?.kill('SIGKILL');  // one that hangs must not outlive its test
  slurm.stop();
});

test('a killed task and a controller that dies change nothing', async () => {
  const { end } = sweep();
  const victim = (await until('a running task', () => slurm.running()[0] && slurm.running())).at(0);
  slurm.run('scancel', victim);
  await until('a task that is done', () => records().length > 0);
  slurm.kill('slurmctld', 'SIGKILL');
  await new Promise((done) => setTimeout(done, 3000));
  slurm.startController();
  slurm.tendUntil(end);
  const { status, told } = await within('the end of the sweep', end);
  assert.equal(status, here.status, told);
  assertSame(files(out), here.files);
});

test('a sweep that was killed goes on where it was', async () => {
  rmSync(out, { recursive: true, force: true });
  const first = sweep('--processes', '1');
  await until('two tasks that are done', () => records().length > 1);
  first.child.kill('SIGKILL');
  await first.end;
  const done = records().map((name) => join(out, name.replace('.task.json', ''), 'tool.json'));
  const times = done.map((file) => statSync(file).mtimeMs);
  const { status, told } = await within('the end of the sweep', sweep('--resume').end);
  assert.equal(status, here.status, told);
  assert.deepEqual(done.map((file) => statSync(file).mtimeMs), times);
  assertSame(files(out), here.files);
});

test('without a controller it says why', async () => {
  const { status, stderr } = flank('sweep', plan, '-o', join(root, 'none'), '--engine', 'slurm', '--quiet');
  assert.equal(status, 4);
  assert.match(stderr, /sbatch/);
});
