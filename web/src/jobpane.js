// The middle pane: what is wanted of the chosen faces.
import { get, post } from './api.js';
import { copy } from './copy.js';
import { byId, html } from './dom.js';
import { faceList } from './facelist.js';
import { Form, isMesh, quoted } from './form.js';
import { Sides } from './sides.js';

/** Milliseconds after the last change before the defaults are asked for. */
const REST = 500;

/** What can be wanted: the roles of faces and the fields that they fill. `wheel`: the part must be one. */
const COMMANDS = {
  fit: { name: 'Find a tool', help: 'The shape of the tool and its motion are found together, for this face.', roles: { machine: 'faces', protect: 'check_faces', ignore: 'ignore_faces' }, needed: ['machine'], skip: ['skin'] },
  cover: { name: 'Given tool', help: 'The passes with which a given tool finishes the face. The tool “catalogue” takes the best tool of the catalogue.', roles: { machine: 'faces', protect: 'check_faces', ignore: 'ignore_faces' }, needed: ['machine'], skip: ['skin'] },
  trochoid: { name: 'Cavity', help: 'One tool roughs and finishes the cavity between two sides.', roles: { left: 'left', right: 'right', floor: 'floor', protect: 'check_faces', ignore: 'ignore_faces' }, needed: ['left', 'right'], skip: ['faces', 'skin', 'side'] },
  wheel: { name: 'Wheel', help: 'All operations of a compressor or turbine wheel, and one verdict: sides, floor, fillets, edges, rest and roughing. One sector is planned and copied.', roles: { hub: 'hub' }, needed: [], skip: [], wheel: true },
};
/** "2 main blades, 4 splitters, hub F3, 2 sectors". */
function wheelWords({ blades, hub, shroud, sectors, whole }) {
  const splitters = blades.filter(({ kind }) => kind === 'splitter').length, count = (number, one) => `${number} ${one}${number === 1 ? '' : 's'}`;
  return [count(blades.length - splitters, 'main blade'), ...(splitters ? [count(splitters, 'splitter')] : []), `hub ${faceList(hub)}`, ...(shroud.length ? [`shroud ${faceList(shroud)}`] : []), `${count(sectors, 'sector')}${whole ? '' : ', of which the part is a piece'}`].join(', ');
}

const SHORT = { faces: '--face', check_faces: '--check-faces', ignore_faces: '--ignore-faces', left: '--left', right: '--right', floor: '--floor', hub: '--hub' };

export class JobPane {
  /** `run(id)` is called with a job that was begun. */
  constructor(parts, run) {
    Object.assign(this, { parts, run, forms: new Map() });
    byId('commands').replaceChildren(...Object.entries(COMMANDS).map(([command, { name }]) => {
      const button = html('button', { type: 'button', 'data-command': command, 'aria-pressed': 'false' }, name);
      button.addEventListener('click', () => this.choose(command));
      return button;
    }));
    byId('run').addEventListener('click', () => this.begin());
    for (const what of ['line', 'python']) byId(`copy-${what}`).addEventListener('click', async () => { byId(`copy-${what}`).textContent = (await copy(byId(what).textContent)) ? 'Copied' : 'Copy'; });
  }

  async choose(command) {
    this.command = command;
    for (const button of byId('commands').children) button.setAttribute('aria-pressed', String(button.dataset.command === command));
    const { roles, skip, help } = COMMANDS[command];
    byId('wanted').textContent = help;
    if (!this.forms.has(command)) {
      const { fields } = await get(`fields/${command}`);
      this.forms.set(command, new Form(fields, ['part', 'unit', ...skip, ...Object.values(roles)], () => this.changed()));
    }
    if (this.command !== command) return;
    this.form = this.forms.get(command);
    byId('form').replaceChildren(this.form.root);
    this.parts.roles(Object.keys(roles));
    this.recognise();
    this.changed();
  }

  /** There is another part: its sides are its own. */
  part() {
    this.sides = new Sides(this.parts.chooser, (sign) => {
      const entry = this.form.inputs.get('side');
      if (entry) entry.input.value = sign;
      this.changed();
    });
    if (this.form) this.parts.roles(Object.keys(COMMANDS[this.command].roles));
    this.recognise();
    this.changed();
  }

  /** What the faces of a wheel are, where one is wanted: their roles become their colours. */
  async recognise() {
    this.roles = null;
    const { chooser } = this.parts;
    if (!chooser || !COMMANDS[this.command]?.wheel) return;
    const told = await chooser.nameWheel().catch((error) => ({ complaint: error.message }));
    if (chooser !== this.parts.chooser) return;
    this.roles = told;
    this.changed();
  }

  /** What is chosen, in words. */
  wanted(faces) {
    if (Object.keys(faces).length) return Object.entries(faces).map(([field, names]) => `${SHORT[field]} ${names}`).join('  ');
    if (!this.parts.chooser) return 'Drop a part first.';
    if (!COMMANDS[this.command].wheel) return 'No face is chosen yet: click one in the part.';
    if (this.roles?.complaint) return this.roles.complaint;
    return this.roles ? wheelWords(this.roles) : 'Looking for hub and blades…';
  }

  /** Names of the faces by the field that they fill. */
  faces() {
    const filled = {};
    for (const [role, field] of Object.entries(COMMANDS[this.command].roles)) {
      const names = this.parts.chooser?.names(role);
      if (names) filled[field] = names;
    }
    return filled;
  }

  ready() {
    return Boolean(this.parts.chooser) && !this.form.missing() && COMMANDS[this.command].needed.every((role) => this.parts.chooser.names(role));
  }

  /** A mesh has no unit of its own; a CAD file may have been read in another than it states. */
  unit() {
    const { data, name } = this.parts;
    return data && (isMesh(name) || data.unit !== 'mm') ? { unit: data.unit } : {};
  }

  values() {
    return { ...this.unit(), ...this.faces(), ...this.form.values() };
  }

  changed() {
    if (!this.form) return;
    const faces = this.faces(), ready = this.ready();
    byId('run').disabled = !ready;
    byId('chosen').textContent = this.wanted(faces);
    byId('chosen').classList.toggle('ready', ready);
    byId('run-note').textContent = this.form.missing();
    const words = [...Object.values(this.unit()).map((unit) => `--unit ${unit}`), ...Object.entries(faces).map(([field, names]) => `${SHORT[field]} ${names}`)];
    byId('line').textContent = ['flank', this.command, quoted(this.parts.name || 'PART'), ...words, ...this.form.words(), '-o out'].join(' ');
    byId('python').textContent = this.python();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.ask(), REST);
  }

  /** The same for Python. */
  python() {
    const written = (name, value) => {
      if (this.command === 'wheel' && this.form.inputs.get(name)?.field.kind === 'switch') return value === 'on' ? 'True' : 'False';
      return Array.isArray(value) || !/^-?[\d.]+(e-?\d+)?$/.test(value) ? JSON.stringify(value) : value;
    };
    const keywords = Object.entries(this.values()).map(([name, value]) => `${name}=${written(name, value)}`), part = JSON.stringify(this.parts.name || 'PART');
    if (this.command === 'wheel') return `import openflank\nplan = openflank.wheel(${[part, '"out"', ...keywords].join(', ')})`;
    return `import openflank\nresult = openflank.${this.command}(${[part, ...keywords].join(', ')})\nresult.write("out")`;
  }

  /** What would be taken for what is not filled in. */
  async ask() {
    if (this.command !== 'fit' || !this.ready()) {
      byId('defaults').replaceChildren();
      return this.sides?.show([]);
    }
    const asked = { part: this.parts.name, fields: this.values() }, key = JSON.stringify(asked);
    if (key === this.asked) return;
    this.asked = key;
    const told = await post('defaults', asked).catch((error) => ({ complaint: error.message }));
    if (key !== this.asked) return;
    const { defaults, complaint } = told;
    byId('defaults').replaceChildren(...(complaint ? [html('p', { class: 'notice' }, complaint)] : []));
    this.sides?.show(defaults?.sides ?? []);
    if (!defaults) return;
    const number = (value, unit = '') => (value === null ? null : `${Number(value.toPrecision(4))}${unit}`);
    this.form.suggest({ tolerance_mm: number(defaults.tolerance), radius_min_mm: number(defaults.radius_min), radius_max_mm: number(defaults.radius_max), reach_radius_mm: number(defaults.reach_radius) });
    const side = defaults.sides[0];
    byId('defaults').append(html('p', {}, [`Tolerance ±${number(defaults.tolerance)} mm`, `tool radius ${number(defaults.radius_min)} to ${number(defaults.radius_max)} mm`,
      side ? `side ${side.side === '+' ? '+' : '−'}: ${side.reason ?? ''}` : 'away from the material', defaults.reach_radius === null ? '' : `accessible to a ball of R ${number(defaults.reach_radius)} mm`].filter(Boolean).join(' · ')));
  }

  async begin() {
    byId('run').disabled = true;
    try {
      const { id } = await post('jobs', { command: this.command, part: this.parts.name, fields: this.values() });
      byId('run-note').textContent = '';
      this.run(id);
    } catch (error) {
      byId('run-note').textContent = error.message;
    }
    byId('run').disabled = !this.ready();
  }
}
