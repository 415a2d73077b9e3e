// From a result to the machine: the program, its judge, and everything to take along.
import { get, place, post } from './api.js';
import { html } from './dom.js';
import { Form } from './form.js';

/** Files that people ask for, and what they are. */
const FILES = { 'tool.dxf': 'Tool drawing', 'tool.step': 'Tool, solid', 'path.cls': 'Path, CL file', 'strips.step': 'Cut surfaces', 'verify.json': 'Verdict', 'tool.json': 'Tool, as data', 'path.json': 'Path, as data', 'plan.json': 'Plan of the wheel', 'blank.stl': 'Blank', 'rest.stl': 'What is left' };

const link = (path, text, title) => html('a', { href: place(path), download: '', class: 'download', title: title ?? '' }, text);

export class Machining {
  constructor(id, job, changed) {
    Object.assign(this, { id, changed });
    this.outcome = html('div', { class: 'outcome', 'aria-live': 'polite' });
    this.form = html('div', {}, 'Loading the list of machines…');
    this.downloads = html('div', { class: 'downloads' });
    this.root = html('section', { class: 'card machining', 'aria-label': 'To the machine' }, html('h2', {}, 'To the machine'), this.form, this.outcome, html('h2', {}, 'Files to download'), this.downloads);
    this.list(job);
    this.begin().catch((error) => this.form.replaceChildren(html('p', { class: 'notice' }, error.message)));
  }

  list(job) {
    const files = Object.entries(FILES).filter(([name]) => job.files.includes(name)).map(([name, text]) => link(`jobs/${this.id}/files/${name}`, text, name));
    this.downloads.replaceChildren(...job.programs.map((name) => link(`jobs/${this.id}/programs/${name}`, name, 'Program')), ...files, link(`jobs/${this.id}/zip`, 'All as ZIP'));
  }

  async begin() {
    const [{ machines }, { fields }] = await Promise.all([get('machines'), get('fields/post')]);
    const machine = html('select', { id: 'machine-name' }, ...machines.map(({ name, description }) => html('option', { value: name, title: description }, name)));
    const about = html('p', { class: 'soft' });
    const tell = () => { about.textContent = machines.find(({ name }) => name === machine.value)?.description ?? ''; };
    machine.addEventListener('change', tell);
    tell();
    this.machine = machine;
    this.fields = new Form(fields, ['folder', 'part', 'machine'], () => {});
    this.fields.set({ spindle: '8000', feed_mm_min: '1000' });
    const button = html('button', { type: 'button', class: 'primary', id: 'post' }, 'Write the program');
    button.addEventListener('click', () => this.act(button, () => this.post()));
    this.form.replaceChildren(html('div', { class: 'fields' }, html('div', { class: 'field' }, html('label', { for: 'machine-name' }, 'Machine'), html('span', { class: 'entry' }, machine))), about, this.fields.root, button);
  }

  async act(button, work) {
    button.disabled = true;
    try {
      await work();
    } catch (error) {
      this.outcome.replaceChildren(html('p', { class: 'notice', role: 'alert' }, error.message));
    }
    button.disabled = false;
  }

  say({ exit, said, complaint }, name, ...more) {
    const state = exit === 0 ? 'pass' : 'fail';
    this.outcome.replaceChildren(html('p', {}, html('span', { class: `pill ${state}`, 'data-exit': exit }, exit === 0 ? `${name}: meets the request` : exit === 1 ? `${name}: does not meet the request` : `${name}: refused`)),
      ...(complaint ? [html('p', { class: 'notice' }, complaint)] : []), html('pre', { tabindex: '0' }, said), ...more);
  }

  async post() {
    const machine = this.machine.value;
    const told = await post(`jobs/${this.id}/post`, { fields: { ...this.fields.values(), machine } });
    const judge = html('button', { type: 'button', id: 'judge' }, 'Check the program');
    judge.addEventListener('click', () => this.act(judge, async () => this.say(await post(`jobs/${this.id}/judge`, { program: told.program, machine }), 'Program')));
    const sheet = html('button', { type: 'button', id: 'sheet' }, 'Set-up sheet');
    sheet.addEventListener('click', () => this.act(sheet, () => this.sheet(told.program, machine)));
    this.say(told, 'Post', html('p', {}, html('code', {}, told.line)), ...(told.program ? [html('p', { class: 'row' }, link(`jobs/${this.id}/programs/${told.program}`, `Download ${told.program}`), judge, sheet)] : []));
    this.changed();
  }

  /** The sheet for the operator, a page for paper. */
  async sheet(program, machine) {
    const told = await post(`jobs/${this.id}/sheet`, { program, machine });
    this.say(told, 'Set-up sheet', ...(told.sheet ? [html('p', { class: 'row' }, link(`jobs/${this.id}/programs/${told.sheet}`, `Download ${told.sheet}`))] : []));
    this.changed();
  }
}
