// The left pane: a part is dropped, opened or chosen, and its faces get their roles.
import { get, post, send } from './api.js';
import { Chooser } from './chooser.js';
import { byId, html } from './dom.js';
import { isMesh, UNITS } from './form.js';
import { ROLES } from './kinds.js';

export class PartPane {
  /** `told.part()` when there is another part, `told.faces()` when other faces are chosen. */
  constructor(told) {
    Object.assign(this, { told, name: '', chooser: null });
    byId('open').addEventListener('click', () => byId('file').click());
    byId('drop').addEventListener('click', () => byId('file').click());
    byId('file').addEventListener('change', () => { if (byId('file').files.length) this.take(byId('file').files[0]); });
    byId('parts').addEventListener('change', () => this.show(byId('parts').value));
    for (const kind of ['dragenter', 'dragover']) document.addEventListener(kind, (event) => { event.preventDefault(); document.body.classList.add('dragging'); });
    for (const kind of ['dragleave', 'drop']) document.addEventListener(kind, (event) => { if (kind === 'drop' || !event.relatedTarget) document.body.classList.remove('dragging'); });
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      // What is dropped on a field is for that field.
      if (event.dataTransfer.files.length && !event.target.closest?.('[data-field]')) this.take(event.dataTransfer.files[0]);
    });
  }

  say(...content) {
    byId('drop').hidden = false;
    byId('drop').replaceChildren(...content);
  }

  async take(file, unit = '') {
    this.say(html('p', {}, html('strong', {}, `Reading ${file.name}…`)));
    try {
      const { name } = await send('parts', file, unit);
      await this.show(name);
    } catch (error) {
      // A mesh has no unit of its own.
      const asks = /\bunit\b/.test(error.message) && !unit;
      this.say(html('p', { class: 'notice', role: 'alert' }, error.message), ...(asks ? [html('p', { class: 'row' }, 'Its unit is', ...UNITS.map((one) => this.unit(file, one)))] : []), html('p', { class: 'soft' }, 'Drop another file.'));
    }
    byId('file').value = '';
  }

  unit(file, unit) {
    const button = html('button', { type: 'button', 'data-unit': unit }, unit);
    button.addEventListener('click', (event) => { event.stopPropagation(); this.take(file, unit); });
    return button;
  }

  async show(name) {
    this.say(html('p', {}, `Drawing ${name}…`));
    const data = await get(`parts/${encodeURIComponent(name)}`);
    this.chooser?.dispose();
    this.name = name;
    this.data = data;
    this.chooser = new Chooser(data, () => this.told.faces(), { smooth: (id) => this.smooth(id), wheel: () => get(`parts/${encodeURIComponent(this.name)}/wheel`) });
    byId('drop').hidden = true;
    byId('chooser').hidden = byId('roles').hidden = false;
    byId('chooser').replaceChildren(this.chooser.view, this.chooser.list);
    this.chooser.start();
    this.told.part();
  }

  /** What the command would machine of the skin of a face. */
  async smooth(id) {
    const unit = isMesh(this.name) ? { unit: this.data.unit } : {};
    const { defaults, complaint } = await post('defaults', { part: this.name, fields: { ...unit, skin: id } });
    if (!defaults) throw new Error(complaint);
    return defaults.faces;
  }

  /** The list of parts there are. */
  list(names) {
    if (names.join('\n') === this.listed && byId('parts').value === this.name) return;
    this.listed = names.join('\n');
    byId('parts').hidden = names.length < 2 && (names.length === 0 || this.name !== '');
    byId('parts').replaceChildren(...(this.name ? [] : [html('option', { value: '' }, 'Parts of this studio…')]), ...names.map((name) => html('option', { value: name }, name)));
    byId('parts').value = this.name;
  }

  /** Which roles a click may give. */
  roles(names) {
    const buttons = names.map((role) => {
      const button = html('button', { type: 'button', 'data-role': role, 'aria-pressed': 'false' }, html('i', { class: 'swatch', style: `background:${ROLES[role].colour}` }), ROLES[role].name);
      button.addEventListener('click', () => this.choose(role));
      return button;
    });
    byId('roles').replaceChildren(html('span', { class: 'soft' }, 'A click marks:'), ...buttons);
    this.names = names;
    for (const [id, role] of this.chooser?.marks ?? []) if (!names.includes(role)) this.chooser.marks.delete(id);
    this.choose(names[0]);
  }

  choose(role) {
    for (const button of byId('roles').querySelectorAll('button')) button.setAttribute('aria-pressed', String(button.dataset.role === role));
    if (this.chooser) this.chooser.role = role;
    this.role = role;
  }

  paint() {
    this.chooser?.paint();
  }
}
