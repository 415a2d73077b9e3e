// Folders of results for the tests: a real one, and one as large as they come.
import { spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export const BINARY = process.env.FLANK_BINARY;
export const root = mkdtempSync(join(tmpdir(), 'flank-report-'));
process.on('exit', () => rmSync(root, { recursive: true, force: true, maxRetries: 10, retryDelay: 200 }));

export function flank(...words) {
  const { status, stdout, stderr, error } = spawnSync(BINARY, words, { encoding: 'utf8' });
  if (error) throw error;
  return { status, stdout, stderr };
}

/** Runs the command and expects success. */
export function must(...words) {
  const outcome = flank(...words);
  if (outcome.status !== 0) throw new Error(`flank ${words.join(' ')}: exit ${outcome.status}\n${outcome.stderr}`);
  return outcome.stdout;
}

/** The twisted blade, fitted and judged. */
export function makeBlade() {
  const part = join(root, 'blade.step'), folder = join(root, 'blade');
  must('example', 'twisted-blade', '-o', part, '--quiet');
  must('fit', part, '--face', 'F1', '--tolerance', '0.1', '-o', folder, '--quiet');
  must('report', folder);
  return folder;
}

/** A copy of a folder without some of its files, to be changed by hand: without the manifest that would tell of it. */
export function without(folder, name, ...files) {
  const copy = join(root, name);
  cpSync(folder, copy, { recursive: true });
  for (const file of ['report.html', 'manifest.json', ...files]) rmSync(join(copy, file), { force: true });
  return copy;
}

export const json = (folder, name) => JSON.parse(readFileSync(join(folder, name), 'utf8'));

/** Base64 of zigzag differences, 7 bits a byte. */
function deltas(indices) {
  const out = [];
  let before = 0;
  for (const index of indices) {
    let value = index >= before ? 2 * (index - before) : 2 * (before - index) - 1;
    before = index;
    for (; value > 127; value >>>= 7) out.push((value & 127) | 128);
    out.push(value);
  }
  return Buffer.from(out).toString('base64');
}

/** A wavy square of n x n cells, two triangles each, with an error at every corner. */
function wavyBody(n, tolerance) {
  const steps = new Uint16Array(3 * (n + 1) ** 2), f = new Float32Array((n + 1) ** 2), indices = [];
  for (let j = 0, k = 0; j <= n; ++j)
    for (let i = 0; i <= n; ++i, ++k) {
      const z = 0.5 + 0.5 * Math.sin((6 * i) / n) * Math.cos((5 * j) / n);
      steps.set([(65535 * i) / n, (65535 * j) / n, 65535 * z], 3 * k);
      f[k] = 2 * tolerance * (z - 0.5);
    }
  for (let j = 0; j < n; ++j)
    for (let i = 0; i < n; ++i) {
      const a = j * (n + 1) + i;
      indices.push(a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
    }
  return { face: 'F1', target: true, box: [[-20, -30, 0], [20, 30, 4]], vertices: f.length, triangles: indices.length / 3,
    positions: Buffer.from(steps.buffer).toString('base64'), indices: deltas(indices), border_counts: [], borders: '',
    f_mm: Buffer.from(f.buffer).toString('base64') };
}

/** The blade's folder with a face of 400,000 triangles in it. */
export function makeLarge(folder) {
  const copy = without(folder, 'large');
  const view = json(copy, 'view.json');
  view.bodies = [wavyBody(448, view.tolerance_mm)];
  writeFileSync(join(copy, 'view.json'), JSON.stringify(view));
  return copy;
}
