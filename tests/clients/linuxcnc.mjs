// LinuxCNC without a display: its interpreter, its kinematics, and a whole simulated run whose joints come back.
import { spawnSync } from 'node:child_process';
import { chmodSync, copyFileSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { userInfo } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { must } from './folder.mjs';

const MODULES = '/usr/lib/linuxcnc/modules';
const KINEMATICS = process.env.FLANK_LINUXCNC_KINEMATICS;
const HERE = dirname(fileURLToPath(import.meta.url));
const SWITCHES = { M428: 1, M429: 0 };  // words of its sample configurations, and the type of kinematics that each switches to

/** Why LinuxCNC cannot be asked here; empty if it can. */
export function whyNot() {
  for (const command of ['linuxcnc', 'rs274', 'halsampler'])
    if (spawnSync('sh', ['-c', `command -v ${command}`]).status !== 0) return `no ${command} here; \`make test-clients\` installs it`;
  if (!KINEMATICS) return 'FLANK_LINUXCNC_KINEMATICS does not name the program beside this test';
  return '';
}

/** A folder with the words that switch the kinematics, as LinuxCNC's sample configurations have them. */
function writeSwitches(folder) {
  mkdirSync(join(folder, 'words'), { recursive: true });
  for (const [word, type] of Object.entries(SWITCHES)) {
    const name = `${word.toLowerCase()}`;
    writeFileSync(join(folder, 'words', `${name}.ngc`), `o<${name}>sub\nM68 E3 Q${type}\nM66 E0 L0\no<${name}>endsub\n`);
  }
  return { SUBROUTINE_PATH: './words', HAL_PIN_VARS: 1, PARAMETER_FILE: 'sim.var',
    REMAP: Object.keys(SWITCHES).map((word) => `${word} modalgroup=10 ngc=${word.toLowerCase()}`) };
}

/** A table of tools { number, length }. */
const tableOf = (tools) => tools.map(({ number, length }) => `T${number} P${number} D10 Z${length}\n`).join('');

/** What the interpreter makes of a program, with one tool or a list of them: exit status, moves [kind, x, y, z, a, b, c], message. */
export function interpret(folder, text, tool) {
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, 'sim.ini'), section('RS274NGC', writeSwitches(folder)) +
    section('TRAJ', { COORDINATES: 'XYZABC', LINEAR_UNITS: 'mm', ANGULAR_UNITS: 'degree' }) + section('EMCIO', { TOOL_TABLE: 'sim.tbl' }));
  writeFileSync(join(folder, 'sim.tbl'), tableOf([tool].flat()));
  writeFileSync(join(folder, 'program.ngc'), text);
  const { status, stdout, stderr } = spawnSync('rs274', ['-i', 'sim.ini', '-g', 'program.ngc'], { encoding: 'utf8', maxBuffer: 2 ** 30, cwd: folder });
  const moves = [...stdout.matchAll(/STRAIGHT_(FEED|TRAVERSE)\(([^)]*)\)/g)].map((m) => [m[1], ...m[2].split(',').map(Number)]);
  return { status, moves, message: stderr + stdout };
}

/** The moves that the words of a program state, read in the simplest way: modal G0 or G1, modal axes; null where none was stated yet. */
export function stated(text, letters = 'XYZABC') {
  const at = Object.fromEntries([...letters].map((l) => [l, null])), moves = [];
  let kind = 'TRAVERSE';
  for (const line of text.split('\n')) {
    const code = line.replace(/\([^)]*\)/g, '');
    let axes = false;
    for (const [, letter, number] of code.matchAll(/([A-Z])(-?[0-9.]+)/g)) {
      if (letter === 'G' && (number === '0' || number === '1')) kind = number === '0' ? 'TRAVERSE' : 'FEED';
      if (!letters.includes(letter)) continue;
      at[letter] = Number(number);
      axes = true;
    }
    if (axes) moves.push([kind, ...[...letters].map((l) => at[l])]);
    // Coordinates of the machine: where that is in the program's depends on the offsets that hold by then.
    if (/\bG53\b/.test(code)) for (const [, letter] of code.matchAll(/([A-Z])(-?[0-9.]+)/g)) if (letters.includes(letter)) at[letter] = null;
  }
  return moves;
}

/** Rows through LinuxCNC's kinematics: 'forward' (joints to X Y Z A B C) or 'inverse'. */
export function kinematics(module, coordinates, direction, pins, rows) {
  const { status, stdout, stderr } = spawnSync(KINEMATICS, [join(MODULES, `${module}.so`), coordinates, '-', direction, ...pins],
    { input: rows.map((r) => r.join(' ')).join('\n'), encoding: 'utf8', maxBuffer: 2 ** 30 });
  if (status !== 0) throw new Error(`${module}: ${stderr}`);
  return stdout.trim().split('\n').map((l) => l.split(' ').map(Number));
}

const section = (name, entries) =>
  `[${name}]\n${Object.entries(entries).flatMap(([k, v]) => [v].flat().map((one) => `${k} = ${one}\n`)).join('')}`;

/** The configuration of a machine: what `simulate` is given, as LinuxCNC reads it. */
function configuration(folder, { kinematics: kins, joints, always = false }) {
  const letters = joints.map((j) => j.name).join(''), fastest = Math.max(...joints.map((j) => j.speed)), hardest = Math.max(...joints.map((j) => j.acceleration));
  let ini = section('EMC', { VERSION: '1.1', MACHINE: 'headless' }) + section('DISPLAY', { DISPLAY: './linuxcnc_ui.py' }) +
    section('TASK', { TASK: 'milltask', CYCLE_TIME: 0.001 }) + section('RS274NGC', writeSwitches(folder)) +
    section('EMCMOT', { EMCMOT: 'motmod', COMM_TIMEOUT: '4.0', SERVO_PERIOD: 1000000 }) +
    section('EMCIO', { EMCIO: 'io', CYCLE_TIME: 0.01, TOOL_TABLE: 'sim.tbl' }) + section('HAL', { HALFILE: 'sim.hal' }) +
    section('TRAJ', { NO_FORCE_HOMING: 1, COORDINATES: letters, LINEAR_UNITS: 'mm', ANGULAR_UNITS: 'degree', DEFAULT_LINEAR_VELOCITY: 100,
      MAX_LINEAR_VELOCITY: fastest, DEFAULT_LINEAR_ACCELERATION: hardest, MAX_LINEAR_ACCELERATION: hardest }) +
    section('KINS', { KINEMATICS: kins === 'trivkins' ? `trivkins coordinates=${letters}` : `${kins} coordinates=${letters}${always ? '' : ' sparm=identityfirst'}`, JOINTS: letters.length });
  joints.forEach((j, i) => {
    const [low, high] = j.travel ?? [-1e6, 1e6];
    const axis = { TYPE: j.kind === 'rotary' ? 'ANGULAR' : 'LINEAR', HOME: 0, MAX_VELOCITY: j.speed, MAX_ACCELERATION: j.acceleration, MIN_LIMIT: low, MAX_LIMIT: high };
    ini += section(`JOINT_${i}`, { ...axis, FERROR: 5, MIN_FERROR: 1, HOME_SEARCH_VEL: 0, HOME_LATCH_VEL: 0, HOME_SEQUENCE: 0 });
    // Limits of the world's axes say nothing of joints where the two differ.
    const same = j.kind === 'rotary' || kins === 'trivkins';
    ini += section(`AXIS_${j.name}`, { ...axis, MIN_LIMIT: same ? low : -1e6, MAX_LIMIT: same ? high : 1e6 });
  });
  return ini;
}

/** What is loaded and joined: joints to themselves and to the log, the tool's length to the kinematics, the switch of the kinematics. */
function hal({ kinematics: kins, joints, pins }) {
  return ['loadrt [KINS]KINEMATICS', 'loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS',
    `loadrt sampler depth=100000 cfg=${'f'.repeat(joints.length)}s`,
    'addf motion-command-handler servo-thread', 'addf motion-controller servo-thread', 'addf sampler.0 servo-thread',
    ...joints.map((_, i) => `net j${i} joint.${i}.motor-pos-cmd => joint.${i}.motor-pos-fb sampler.0.pin.${i}`),
    `net number iocontrol.0.tool-number => sampler.0.pin.${joints.length}`,
    ...(kins === 'trivkins' ? [] : [`net length motion.tooloffset.z => ${kins}.tool-offset`, 'net kinstype motion.analog-out-03 => motion.switchkins-type']),
    ...pins.map((p) => `setp ${kins}.${p.replace('=', ' ')}`),
    'net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in', 'net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared',
    'net change iocontrol.0.tool-change => iocontrol.0.tool-changed', ''].join('\n');
}

/** A library that lets the simulated time of machines pass faster, made in a folder; undefined where it cannot be made or loaded: the clock's time then. */
export function fastTime(folder, times) {
  const library = join(folder, 'linuxcnc_fast.so');
  const probe = 'mount --bind /bin/true /usr/bin/rtapi_app';
  const can = userInfo().uid === 0 && spawnSync('unshare', ['-m', 'sh', '-c', probe]).status === 0 &&
    spawnSync('gcc', ['-O2', '-shared', '-fPIC', '-o', library, join(HERE, 'linuxcnc_fast.c')]).status === 0;
  return can ? { times, library } : undefined;
}

/** Words before a command in which LinuxCNC's realtime program has a library loaded: a copy of it, as one with a set user id takes none. */
function faster(folder, { times, library }, environment) {
  const app = '/usr/bin/rtapi_app', copy = resolve(folder, 'rtapi_app');
  copyFileSync(app, copy);
  chmodSync(copy, 0o755);
  Object.assign(environment, { LD_PRELOAD: resolve(library), FLANK_TIMES: `${times}` });
  return ['unshare', '-m', 'sh', '-c', `mount --bind ${copy} ${app} && exec "$@"`, 'sh'];
}

/**
 * Runs a program to its end in a simulated machine: { outcome, messages, line, joints, tools (the tool's number at each row) }. It takes as long as the machine would.
 * machine: { kinematics, pins, joints: [{ name, kind, travel, speed, acceleration }], tool: { number, length } or a list of them, always: it moves by its
 * kinematics without a word }; offset: where G54 is.
 * LinuxCNC does not run as root; then it runs as nobody. fast: { times, library }: its servo periods pass so many times as fast as the clock,
 * by a library of linuxcnc_fast.c; for that it must be started as root.
 */
export function simulate(folder, text, machine, offset = [0, 0, 0], limit = 250, fast = undefined) {
  mkdirSync(folder);
  const file = (name) => join(folder, name);
  writeFileSync(file('sim.ini'), configuration(folder, machine));
  writeFileSync(file('sim.hal'), hal(machine));
  writeFileSync(file('sim.tbl'), tableOf([machine.tool].flat()));
  writeFileSync(file('program.ngc'), text);
  copyFileSync(join(HERE, 'linuxcnc_ui.py'), file('linuxcnc_ui.py'));
  chmodSync(file('linuxcnc_ui.py'), 0o755);
  const root = userInfo().uid === 0;
  if (root) spawnSync('chown', ['-R', 'nobody', folder]);
  const environment = { ...process.env, NGC: file('program.ngc'), RESULT: file('result.json'), JOINT_LOG: file('joints.log'),
    LIMIT_S: `${limit}`, OFFSET: `G10 L2 P1 ${offset.map((v, i) => `${'XYZ'[i]}${v}`).join(' ')}` };
  const words = ['env', `HOME=${folder}`, 'linuxcnc', '-r', 'sim.ini'];
  const command = [...(fast ? faster(folder, fast, environment) : []), ...(root ? ['runuser', '-u', 'nobody', '--'] : []), ...words];
  const run = spawnSync(command[0], command.slice(1),
    { cwd: folder, env: environment, encoding: 'utf8', timeout: 1000 * (limit + 30), maxBuffer: 2 ** 28 });
  if (!existsSync(environment.RESULT)) throw new Error(`LinuxCNC did not start:\n${run.stdout}${run.stderr}`);
  return logged(folder, machine);
}

const PIECE = 2 ** 26;  // bytes: a log of some hours is longer than a string may be

/** What lies in the folder of a run that has ended, as simulate() returns it. */
export function logged(folder, machine) {
  const log = readFileSync(join(folder, 'joints.log')), count = machine.joints.length, joints = [], tools = [];
  for (let from = 0; from < log.length;) {
    const end = log.lastIndexOf('\n', Math.min(from + PIECE, log.length)), to = end > from ? end : log.length;
    for (const line of log.toString('utf8', from, to).split('\n')) {
      if (!line.trim()) continue;
      const row = line.trim().split(/\s+/).map(Number);
      joints.push(row.slice(0, count)), tools.push(row[count]);
    }
    from = to + 1;
  }
  return { ...JSON.parse(readFileSync(join(folder, 'result.json'), 'utf8')), joints, tools };
}

const LOGGED = 1e-3;  // mm and degrees: digits of the log
const apart = (a, b) => Math.max(...a.map((v, i) => Math.abs(v - b[i])));

/** How long a run takes from the end of the last rapid before its last feed to the end of that, s. `rows`: every millisecond what the words of the program
 * state. */
export function feedSeconds(rows, text, letters) {
  const moves = stated(text, letters), to = moves.findLastIndex((m) => m[0] === 'FEED'), from = moves.slice(0, to).findLastIndex((m) => m[0] !== 'FEED');
  const at = (move) => (row) => row.every((v, k) => move[k + 1] === null || Math.abs(v - move[k + 1]) < LOGGED);
  let begin = rows.findIndex(at(moves[from])), end = rows.findLastIndex(at(moves[to]));
  while (begin >= 0 && at(moves[from])(rows[begin + 1])) ++begin;
  while (end > 0 && at(moves[to])(rows[end - 1])) --end;
  return begin >= 0 && end > begin ? 1e-3 * (end - begin) : NaN;
}

/** The farthest that a joint goes in a millisecond, as a share of what its speed allows: { share, joint, row }. */
export function fastest(rows, joints) {
  let worst = { share: 0 };
  for (let row = 1; row < rows.length; ++row)
    joints.forEach(({ name, speed }, k) => {
      const share = Math.abs(rows[row][k] - rows[row - 1][k]) / (speed * 1e-3);
      if (share > worst.share) worst = { share, joint: name, row };
    });
  return worst;
}

/** Samples without those at which the machine stood still. */
export const moving = (rows) => rows.filter((r, i) => i === 0 || apart(r, rows[i - 1]) > 0);

/**
 * Joints to poses of the tool in the frame of the work: the controlled point, and the unit vector towards the holder, found by moving
 * the spindle's joint Z and asking the kinematics again. `forward` maps rows of joints to rows of X Y Z.
 */
export function poses(joints, forward) {
  const low = forward(joints), high = forward(joints.map((j) => j.map((v, i) => (i === 2 ? v + 1 : v))));
  return low.map((p, i) => {
    const axis = [0, 1, 2].map((k) => high[i][k] - p[k]), length = Math.hypot(...axis);
    return [...p.slice(0, 3), ...axis.map((v) => v / length)];
  });
}

/** The forward kinematics of a machine of LinuxCNC's own modules; a tool's length lies in the world's Z. */
export const forwardOf = ({ kinematics: module, pins, joints, tool }) => (rows) =>
  kinematics(module, joints.map((j) => j.name).join(''), 'forward', [...pins, `tool-offset=${tool.length}`], rows)
    .map(([x, y, z]) => [x, y, z - tool.length]);

/** A machine of ours as LinuxCNC has it: its kinematics with their pins, its joints with their travel and limits. */
export function machineOf(name, kinematics, pins, tool) {
  const { joints } = JSON.parse(must('machine', name, '--json'));
  const at = (letter) => joints.find((j) => j.name === letter);
  return { kinematics, pins, tool, joints: [...'XYZ', ...joints.filter((j) => j.kind === 'rotary').map((j) => j.name).sort()].map(at) };
}
/** What the header of a program says: [x, y, z, a, b, c] of the set-up, length of the tool, distance from the controlled point to s = 0. */
export function header(text) {
  const [, , length, offset] = /TOOL DIAMETER (\S+) LENGTH (\S+) TIP OFFSET ([^\s)]+)/.exec(text).map(Number);
  return { setup: /\(SETUP ([^)]*)\)/.exec(text)[1].split(',').map(Number), number: Number(/\(TOOL (\d+)/.exec(text)[1]), length, offset };
}

/** From the frame of the work to that of the part, of x_work = Rz(c) Ry(b) Rx(a) x_part + (x, y, z), and from the controlled point to s = 0. */
export function toPart([x, y, z, ...angles], offset, pose) {
  const [a, b, c] = angles.map((v) => (v * Math.PI) / 180);
  const back = (v) => {
    const turn = ([p, q], angle) => [p * Math.cos(angle) + q * Math.sin(angle), q * Math.cos(angle) - p * Math.sin(angle)];
    let [vx, vy, vz] = v;
    [vx, vy] = turn([vx, vy], c);
    [vz, vx] = turn([vz, vx], b);
    [vy, vz] = turn([vy, vz], a);
    return [vx, vy, vz];
  };
  const tip = back([pose[0] - x, pose[1] - y, pose[2] - z]), axis = back(pose.slice(3));
  return [...tip.map((v, k) => v + offset * axis[k]), ...axis];
}
