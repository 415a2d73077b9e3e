// What a sweep of 200 small tasks costs beyond the tasks themselves: each task as a command of its own, one after another,
// beside the same tasks by `flank sweep`, here and on a Slurm of one node (as root, where Slurm and munge are installed).
// One task at a time in all of them. The bytes must be the same.
// usage: FLANK_BINARY=.../flank node bench/sweep_overhead.mjs
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Slurm, whyNot } from '../tests/clients/slurm.mjs';

const BINARY = process.env.FLANK_BINARY;
if (!BINARY) throw new Error('FLANK_BINARY must name the command');
const root = mkdtempSync(join(tmpdir(), 'flank-sweep-'));
const TASKS = Number(process.env.TASKS ?? 200);
const OPTIONS = ['--axis-length', '50', '--strips', '1', '--sample', '2'];
const radii = Array.from({ length: TASKS }, (_, k) => (10 + 0.02 * k).toFixed(2));

function flank(words, env = process.env) {
  const { status, stderr } = spawnSync(BINARY, words, { env, encoding: 'utf8' });
  if (status !== 0 && status !== 1) throw new Error(`flank ${words.join(' ')}: ${status} ${stderr}`);
}

function seconds(work) {
  const begin = process.hrtime.bigint();
  work();
  return Number(process.hrtime.bigint() - begin) / 1e9;
}

const sweep = (out, engine, env) => flank(['sweep', join(root, 'plan.toml'), '-o', out, '--processes', '1', '--quiet', '--engine', engine], env);

function single(out) {
  for (const [k, radius] of radii.entries()) {
    flank(['cover', join(root, 'blade.step'), '--face', 'F1', '--tool', `cylinder:radius=${radius}`, '--tolerance', '0.5', ...OPTIONS,
      '--threads', '1', '--quiet', '-o', join(out, `${k}`)]);
    flank(['report', join(out, `${k}`), '--quiet']);
  }
}

function same(a, b) {
  for (const name of ['sweep.json', 'sweep.csv', 'F1-1/path.json', `F1-${TASKS}/verify.json`])
    if (!readFileSync(join(a, name)).equals(readFileSync(join(b, name)))) throw new Error(`${name} has other bytes`);
}

flank(['example', 'twisted-blade', '-o', join(root, 'blade.step'), '--quiet']);
writeFileSync(join(root, 'plan.toml'), `schema = "openflank/sweep-plan/1"\ncommand = "cover"\npart = "blade.step"\nfaces = ["F1"]\n` +
  `tools = [${radii.map((radius) => `"cylinder:radius=${radius}"`).join(', ')}]\n` +
  '[options]\ntolerance_mm = 0.5\naxis_length_mm = 50\nstrips = 1\nsample_mm = 2.0\n');
const slurm = whyNot() ? null : new Slurm(join(root, 'slurm'));
try {
  const alone = seconds(() => single(join(root, 'single')));
  const tell = (name, time) => console.log(`${name.padEnd(24)} ${time.toFixed(1)} s, ${((100 * time) / alone - 100).toFixed(1)} % beyond the tasks`);
  console.log(`${TASKS} tasks, one by one     ${alone.toFixed(1)} s`);
  tell('flank sweep', seconds(() => sweep(join(root, 'here'), 'local', process.env)));
  if (slurm) {
    await slurm.start(1);
    tell('flank sweep, Slurm', seconds(() => sweep(join(root, 'slurmed'), 'slurm', slurm.env)));
    same(join(root, 'here'), join(root, 'slurmed'));
  } else {
    console.log(`Slurm: ${whyNot()}`);
  }
} finally {
  slurm?.stop();
  rmSync(root, { recursive: true, force: true });
}
