// A form made from the table of fields: eight basic ones, the rest under "more".
import { send } from './api.js';
import { html } from './dom.js';

/** What a field is called on the page, by its key: the table's names are those of files and scripts. */
const NAMES = { tool: 'Tool', side: 'Machined side', nc: 'Program', turn_max: 'Sharpest kink', dry: 'Dry run', rough: 'Roughing', edges: 'Edges', sample: 'Fast check at', most_tilt: 'Largest tilt', most_engagement: 'Largest engagement', balance: 'Blades free by', most_tools: 'Most tools' };
/** What stands between the values of a list; the faces of a blade have commas between them. */
const BETWEEN = { blades: ';', splitters: ';' };
const between = ({ key }) => BETWEEN[key] ?? ',';
/** Meshes have no unit of their own: it is asked for where one is dropped. */
export const UNITS = ['mm', 'cm', 'm', 'in'];
/** Whether a file is a mesh, which has no unit: every format that is none of CAD. */
export const isMesh = (name) => !/\.(step|stp|iges|igs|brep|brp)$/i.test(name);
const nameOf = ({ key }) => NAMES[key] ?? key[0].toUpperCase() + key.slice(1).replaceAll('_', ' ');

/** What stands for an empty field: what its help says of the default, in few words. */
const hint = ({ help }) => /default: ([^,;:.]{1,40})/i.exec(help)?.[1] ?? 'none';

function choice(options, value) {
  const select = html('select', {}, ...options.map(([key, text]) => html('option', { value: key }, text)));
  select.value = value;
  return select;
}

export class Form {
  /** `fields`: of flank fields; `skip`: names that are given elsewhere; `changed()` after every change. */
  constructor(fields, skip, changed) {
    this.fields = fields.filter((field) => !skip.includes(field.name));
    this.changed = changed;
    this.inputs = new Map();
    const basic = this.fields.filter((field) => field.basic).sort((a, b) => a.place - b.place);
    this.basic = html('div', { class: 'fields' }, ...basic.map((field) => this.line(field)));
    this.more = html('details', { class: 'more-fields' }, html('summary', {}, 'More'), ...this.groups());
    this.root = html('div', { class: 'form' }, this.basic, this.more);
  }

  groups() {
    const rest = this.fields.filter((field) => !field.basic), names = [...new Set(rest.map((field) => field.group))];
    return names.map((name) => html('fieldset', {}, html('legend', {}, name || 'Search'), html('div', { class: 'fields' }, ...rest.filter((field) => field.group === name).map((field) => this.line(field)))));
  }

  line(field) {
    const input = this.input(field), id = `field-${field.name}`;
    input.id = id;
    input.title = field.help;
    input.addEventListener('input', () => this.changed());
    this.inputs.set(field.name, { field, input });
    const unit = field.unit ? html('span', { class: 'unit' }, field.unit) : null;
    const file = field.file ? this.upload(field, input) : null;
    const line = html('div', { class: 'field', 'data-field': field.name }, html('label', { for: id, title: field.help }, nameOf(field)), html('span', { class: 'entry' }, input, unit, file));
    if (file) line.addEventListener('drop', (event) => { [...event.dataTransfer.files].forEach((one) => this.take(field, input, one)); });
    return line;
  }

  input(field) {
    const usual = field.default ?? '';
    if (field.key === 'fixture_unit') return choice([['', 'no fixture is a mesh'], ...UNITS.map((unit) => [unit, unit])], '');
    if (field.choices) return choice(field.choices.map((one) => [one === usual ? '' : one, one === usual ? `${one} (default)` : one]), '');
    if (field.kind === 'sign') return choice([['', 'automatic'], ['+', '+ (normal of the file)'], ['-', '− (against the normal of the file)']], '');
    if (field.kind === 'switch') return choice([['', usual || 'off'], ...['on', 'off'].filter((one) => one !== (usual || 'off')).map((one) => [one, one])], '');
    return html('input', { type: 'text', placeholder: usual || hint(field), autocomplete: 'off', spellcheck: 'false', inputmode: field.kind === 'number' ? 'decimal' : 'text' });
  }

  /** A file of the user's for a field: chosen, or dropped on it. */
  upload(field, input) {
    const chosen = html('input', { type: 'file', class: 'sr', tabindex: '-1', 'aria-label': `File for ${nameOf(field)}` });
    const button = html('button', { type: 'button', class: 'file', title: `A file for ${nameOf(field)}` }, 'File…');
    button.addEventListener('click', () => chosen.click());
    chosen.addEventListener('change', () => { if (chosen.files.length) this.take(field, input, chosen.files[0]); });
    return html('span', {}, button, chosen);
  }

  async take(field, input, file) {
    try {
      const { name } = await send('files', file);
      input.value = field.kind === 'texts' && input.value ? `${input.value}, ${name}` : name;
      this.wrong = '';
    } catch (error) {
      this.wrong = error.message;
    }
    this.changed();
  }

  /** What is still to be said before the job can run; empty: nothing. */
  missing() {
    const meshes = (this.values().fixtures ?? []).filter(isMesh), unit = this.inputs.get('fixture_unit')?.input;
    this.more.open ||= meshes.length > 0;
    return this.wrong || (meshes.length && unit && !unit.value ? `${meshes.join(', ')}: a mesh has no unit; choose the fixture unit.` : '');
  }

  /** What was filled in, by name. */
  values() {
    const values = {};
    for (const [name, { field, input }] of this.inputs) {
      const text = input.value.trim();
      if (text) values[name] = field.kind === 'texts' ? text.split(between(field)).map((one) => one.trim()).filter(Boolean) : text;
    }
    return values;
  }

  set(values) {
    for (const [name, { field, input }] of this.inputs) input.value = [values[name] ?? ''].flat().join(`${between(field)} `);
    this.changed();
  }

  /** What will be taken where nothing is filled in. */
  suggest(values) {
    for (const [name, text] of Object.entries(values)) {
      const entry = this.inputs.get(name);
      if (entry && text !== null && text !== undefined && entry.input.tagName === 'INPUT') entry.input.placeholder = text;
    }
  }

  /** Options as they are typed. */
  words() {
    return Object.entries(this.values()).flatMap(([name, value]) => {
      const { field } = this.inputs.get(name);
      if (field.flag) return value === 'on' ? [field.option] : [];
      return [value].flat().map((one) => (/^-/.test(one) ? `${field.option}=${one}` : `${field.option} ${quoted(one)}`));
    });
  }
}

export const quoted = (word) => (/^[\w\-=+.,:/%@]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);
