// A Slurm of one node that lives in a folder of its own: munged, slurmctld and slurmd as root, on ports of their own.
import { execFileSync, spawnSync } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { hostname } from 'node:os';
import { join } from 'node:path';

const PROGRAMS = ['munged', 'slurmctld', 'slurmd', 'sbatch', 'squeue', 'scancel', 'sinfo', 'scontrol'];
const environment = { ...process.env, PATH: `${process.env.PATH}:/usr/sbin:/sbin` };

/** Why there can be no Slurm here; nothing if there can. */
export function whyNot() {
  if (process.getuid() !== 0) return 'Slurm is started as root only';
  const missing = PROGRAMS.filter((name) => spawnSync('sh', ['-c', `command -v ${name}`], { env: environment }).status !== 0);
  return missing.length > 0 ? `${missing.join(', ')} missing; \`make test-clients\` installs them` : '';
}

const wait = (ms) => new Promise((done) => setTimeout(done, ms));
/** The promise's value; an error if it takes longer. */
export function within(what, promise, seconds = 180) {
  let timer;
  const late = new Promise((_, fail) => {
    timer = setTimeout(() => fail(new Error(`not within ${seconds} s: ${what}`)), 1000 * seconds);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}
export async function until(what, condition, seconds = 120) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; await wait(100)) {
    const found = condition();
    if (found) return found;
  }
  throw new Error(`not within ${seconds} s: ${what}`);
}

const freePort = () => new Promise((done) => {
  const server = createServer().listen(0, '127.0.0.1', () => {
    const { port } = server.address();
    server.close(() => done(port));
  });
});

export class Slurm {
  constructor(folder) {
    this.folder = folder;
    this.host = hostname().split('.')[0];
    this.env = { ...environment, SLURM_CONF: join(folder, 'slurm.conf') };
  }

  async start(cpus) {
    const { folder, host } = this;
    for (const name of ['', 'state', 'spool']) mkdirSync(join(folder, name), { recursive: true, mode: 0o755 });
    writeFileSync(join(folder, 'key'), randomBytes(1024), { mode: 0o400 });
    const lines = ['ClusterName=flank', `SlurmctldHost=${host}(127.0.0.1)`, `SlurmctldPort=${await freePort()}`, `SlurmdPort=${await freePort()}`,
      'AuthType=auth/munge', `AuthInfo=socket=${folder}/munge.socket`, 'CredType=cred/munge', 'SlurmUser=root', 'SlurmdUser=root',
      `StateSaveLocation=${folder}/state`, `SlurmdSpoolDir=${folder}/spool`, `SlurmctldPidFile=${folder}/slurmctld.pid`,
      `SlurmdPidFile=${folder}/slurmd.pid`, `SlurmctldLogFile=${folder}/slurmctld.log`, `SlurmdLogFile=${folder}/slurmd.log`,
      'ProctrackType=proctrack/linuxproc', 'TaskPlugin=task/none', 'MpiDefault=none', 'JobAcctGatherType=jobacct_gather/none',
      'AccountingStorageType=accounting_storage/none', 'SelectType=select/cons_tres', 'SelectTypeParameters=CR_CPU', 'ReturnToService=2',
      'SlurmdParameters=config_overrides', 'SchedulerParameters=sched_min_interval=100000,batch_sched_delay=0', 'MailProg=/bin/true',
      `NodeName=${host} NodeAddr=127.0.0.1 CPUs=${cpus} State=UNKNOWN`, `PartitionName=all Nodes=${host} Default=YES State=UP MaxTime=INFINITE`];
    writeFileSync(join(folder, 'slurm.conf'), lines.join('\n') + '\n');
    this.run('munged', '--force', `--key-file=${folder}/key`, `--socket=${folder}/munge.socket`, `--pid-file=${folder}/munged.pid`,
      `--log-file=${folder}/munged.log`, `--seed-file=${folder}/munge.seed`, '--num-threads=2');
    this.startController();
    this.run('slurmd');
    await until('an idle node', () => this.ask('sinfo', '--noheader', '--format=%T') === 'idle');
  }

  run(program, ...words) {
    execFileSync(program, words, { env: this.env, stdio: ['ignore', 'ignore', 'pipe'] });
  }
  ask(program, ...words) {
    return (spawnSync(program, words, { env: this.env, encoding: 'utf8' }).stdout ?? '').trim();
  }
  startController() {
    this.run('slurmctld');
  }
  /**
   * What an administrator does when a controller has come back with a state from before its last jobs: it takes those for twice begun and
   * drains the node, and believes in others that have long ended. `reconfigure` has the node report what runs. Until `end` is there.
   */
  async tendUntil(end) {
    let over = false;
    const stop = () => (over = true);
    end.then(stop, stop);
    for (let look = 1; !over; ++look, await wait(500)) {
      if (this.ask('sinfo', '--noheader', '--format=%T').startsWith('drain'))
        spawnSync('scontrol', ['update', `NodeName=${this.host}`, 'State=RESUME'], { env: this.env });
      if (look % 20 === 0) spawnSync('scontrol', ['reconfigure'], { env: this.env });
    }
  }
  /** Ends a daemon by the number in its file. */
  kill(daemon, signal) {
    const file = join(this.folder, `${daemon}.pid`);
    if (!existsSync(file)) return;
    try {
      process.kill(Number(readFileSync(file, 'utf8')), signal);
    } catch (error) {
      if (error.code !== 'ESRCH') throw error;
    }
  }
  /** Names of what runs: "7_3". */
  running() {
    return this.ask('squeue', '--noheader', '--array', '--states=RUNNING', '--format=%i').split('\n').filter(Boolean);
  }
  stop() {
    spawnSync('scancel', ['--user=root'], { env: this.env, timeout: 10000 });
    const daemons = ['slurmd', 'slurmctld', 'munged'];
    for (const daemon of daemons) this.kill(daemon, 'SIGTERM');
    // The controller saves its state at its end, into a folder that is removed afterwards.
    const pause = new Int32Array(new SharedArrayBuffer(4));
    for (let look = 0; look < 100 && daemons.some((daemon) => this.runs(daemon)); ++look) Atomics.wait(pause, 0, 0, 100);
    for (const daemon of daemons) this.kill(daemon, 'SIGKILL');
  }
  /** Whether a daemon has not ended yet. */
  runs(daemon) {
    const file = join(this.folder, `${daemon}.pid`);
    return existsSync(file) && existsSync(`/proc/${readFileSync(file, 'utf8').trim()}`);
  }
}
