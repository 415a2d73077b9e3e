// The table of faces: sorted, filtered, and only as many rows in the page as are seen.
import { byId, html } from './dom.js';
import { byName } from './facelist.js';
import * as format from './format.js';
import { kindColour, kindOf } from './kinds.js';

/** Pixels of a row, as in faces.css; rows drawn beyond what is seen. */
const HEIGHT = 30, BEYOND = 8;

const radius = (row) => row.smallest_concave_radius ?? Infinity;
const vector = (v, digits) => (v ? v.map((x) => (Math.abs(x) < 0.5 * 10 ** -digits ? 0 : x).toFixed(digits).replace('-', '\u2212')).join(', ') : '–');
const COLUMNS = [
  { key: 'id', name: 'Face', order: (a, b) => byName(a.id, b.id) },
  { key: 'type', name: 'Kind', order: (a, b) => (a.type < b.type ? -1 : a.type > b.type ? 1 : 0) },
  { key: 'area', name: 'Area mm²', number: true, order: (a, b) => (b.area ?? 0) - (a.area ?? 0) },
  { key: 'size', name: 'Size mm', order: (a, b) => (b.area ?? 0) - (a.area ?? 0) },
  { key: 'bend', name: 'Bend', order: (a, b) => ((a.bend ?? '') < (b.bend ?? '') ? -1 : 1) },
  { key: 'radius', name: 'Concave R', number: true, order: (a, b) => radius(a) - radius(b) },
  { key: 'centre', name: 'Centre mm', order: (a, b) => (a.centre?.[2] ?? 0) - (b.centre?.[2] ?? 0) },
  { key: 'normal', name: 'Normal', order: (a, b) => (b.normal?.[2] ?? -2) - (a.normal?.[2] ?? -2) },
];

/** "40 × 30": along both directions, or of the box. */
export function sizeOf(row) {
  const size = row.length ?? row.box?.high.map((h, k) => h - row.box.low[k]);
  return size ? size.map((v) => format.plain(v, 3)).join(' × ') : '';
}
export const radiusOf = (row) => (Number.isFinite(radius(row)) ? format.plain(radius(row), 3) : '–');

const cell = { area: (row) => (row.area === undefined ? '' : format.plain(row.area, 4)), size: sizeOf, bend: (row) => row.bend ?? row.why ?? '', radius: radiusOf,
  centre: (row) => vector(row.centre, 1), normal: (row) => vector(row.normal, 2) };

export class FaceTable {
  /** `told`: { hover(id), click(id, more) }; `isChosen(id)` is the role of a face, or nothing. */
  constructor(holder, rows, told, isChosen) {
    Object.assign(this, { holder, rows, told, isChosen, sort: COLUMNS[0], turned: false, kind: '', words: '', glowing: null });
    this.body = html('tbody');
    this.head = html('tr', {}, ...COLUMNS.map((column) => this.header(column)));
    this.scroller = html('div', { class: 'rows', tabindex: '-1' }, html('table', { class: 'faces', 'aria-label': 'Faces of the part' }, html('thead', {}, this.head), this.body));
    holder.replaceChildren(this.scroller);
    this.scroller.addEventListener('scroll', () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.scroller);
    this.body.addEventListener('pointerleave', () => told.hover(null));
    this.body.addEventListener('keydown', (event) => this.key(event));
    this.arrange();
  }

  header(column) {
    const button = html('button', { type: 'button', class: 'sort' }, column.name);
    button.addEventListener('click', () => {
      this.turned = this.sort === column && !this.turned;
      this.sort = column;
      this.arrange();
    });
    return html('th', { scope: 'col', class: `c-${column.key}${column.number ? ' number' : ''}` }, button);
  }

  /** `kind`: only these; `words`: all of them stand in the row. */
  filter({ kind = this.kind, words = this.words }) {
    Object.assign(this, { kind, words });
    this.arrange();
  }

  arrange() {
    const words = this.words.toLowerCase().split(/\s+/).filter(Boolean);
    const text = (row) => `${row.id} ${row.of ?? ''} ${row.type} ${row.bend ?? ''}`.toLowerCase();
    this.shown = this.rows.filter((row) => (!this.kind || kindOf(row) === this.kind) && words.every((word) => text(row).includes(word)));
    this.shown.sort(this.sort.order);
    if (this.turned) this.shown.reverse();
    COLUMNS.forEach((column, k) => this.head.children[k].setAttribute('aria-sort', column !== this.sort ? 'none' : this.turned ? 'descending' : 'ascending'));
    this.scroller.scrollTop = 0;
    this.draw();
  }

  draw() {
    const { scrollTop, clientHeight } = this.scroller;
    const from = Math.max(0, Math.floor(scrollTop / HEIGHT) - BEYOND), to = Math.min(this.shown.length, Math.ceil((scrollTop + clientHeight) / HEIGHT) + BEYOND);
    const held = this.body.contains(document.activeElement) ? document.activeElement.dataset.id : null;
    const space = (rows) => html('tr', { class: 'space', 'aria-hidden': 'true', style: `height:${rows * HEIGHT}px` });
    this.body.replaceChildren(...(from ? [space(from)] : []), ...this.shown.slice(from, to).map((row) => this.row(row)), ...(to < this.shown.length ? [space(this.shown.length - to)] : []));
    if (held) this.body.querySelector(`button[data-id="${held}"]`)?.focus({ preventScroll: true });
    if (!this.shown.length) this.body.replaceChildren(html('tr', {}, html('td', { colspan: COLUMNS.length }, 'No such face.')));
  }

  row(row) {
    const chosen = this.isChosen(row.id);
    const button = html('button', { type: 'button', class: 'face', 'data-id': row.id, 'aria-pressed': String(Boolean(chosen)) }, row.id);
    const line = html('tr', { 'data-face': row.id, class: [chosen ? `chosen ${chosen}` : '', row.piece ? 'piece' : '', row.id === this.glowing ? 'glowing' : ''].join(' ') },
      html('th', { scope: 'row', class: 'c-id' }, button),
      html('td', { class: 'c-type' }, html('i', { class: 'swatch', style: `background:${kindColour(kindOf(row))}` }), row.of ? `${row.of}, ${row.type}` : row.type),
      ...COLUMNS.slice(2).map(({ key, number }) => html('td', { class: `c-${key}${number ? ' number' : ''}` }, cell[key](row))));
    line.addEventListener('pointerenter', () => this.told.hover(row.id));
    line.addEventListener('click', (event) => this.told.click(row.id, event.shiftKey || event.ctrlKey || event.metaKey));
    button.addEventListener('focus', () => this.told.hover(row.id));
    return line;
  }

  key(event) {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const at = this.shown.findIndex((row) => row.id === event.target.dataset.id);
    if (!step || at < 0 || !this.shown[at + step]) return;
    event.preventDefault();
    this.show(this.shown[at + step].id);
    this.body.querySelector(`button[data-id="${this.shown[at + step].id}"]`)?.focus({ preventScroll: true });
  }

  glow(id) {
    this.glowing = id;
    for (const line of this.body.children) line.classList.toggle('glowing', line.dataset.face === id);
  }

  /** Scrolls a face into sight. */
  show(id) {
    const at = this.shown.findIndex((row) => row.id === id), head = this.head.clientHeight;
    if (at < 0) return;
    const { scrollTop, clientHeight } = this.scroller;
    if (at * HEIGHT < scrollTop || (at + 1) * HEIGHT + head > scrollTop + clientHeight) this.scroller.scrollTop = at * HEIGHT - 0.4 * clientHeight;
    this.draw();
  }
}

/** A button for each kind of surface, which is the legend as well; `choose(kind)`, empty for all. */
export function kindButtons(rows, choose) {
  const counts = new Map();
  for (const row of rows) if (!row.piece) counts.set(kindOf(row), (counts.get(kindOf(row)) ?? 0) + 1);
  const buttons = [...counts].sort((a, b) => b[1] - a[1]).map(([kind, count]) => {
    const button = html('button', { type: 'button', class: 'kind', 'data-kind': kind, 'aria-pressed': 'false' }, html('i', { class: 'swatch' }), `${kind} ${count}`);
    button.addEventListener('click', () => {
      const on = button.getAttribute('aria-pressed') === 'true';
      for (const other of buttons) other.setAttribute('aria-pressed', String(other === button && !on));
      choose(on ? '' : kind);
    });
    return button;
  });
  return buttons;
}

export const paintKinds = (root = document) => {
  for (const button of root.querySelectorAll('.kind')) button.querySelector('.swatch').style.background = kindColour(button.dataset.kind);
};
export { byId };
