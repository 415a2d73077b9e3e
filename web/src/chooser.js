// A part to point at: its faces in 3D, the table of them, and what they are chosen for. Both are linked each way.
import { Plane, Vector3 } from 'three';
import { readBody } from './data.js';
import { html, svg } from './dom.js';
import { faceList, facesIn } from './facelist.js';
import { FaceModel } from './facemodel.js';
import { FaceTable, kindButtons, paintKinds, radiusOf, sizeOf } from './facetable.js';
import * as format from './format.js';
import { drawScale, drawTriad } from './legend.js';
import { kindColour, kindOf, ROLES } from './kinds.js';
import { Measure } from './measure.js';
import { Stage } from './scene.js';
import { palette } from './theme.js';

/** Pixels that a pointer may move between press and release of a click. */
const STILL = 4;
/** Corners that the camera fits into the picture, at most. */
const CORNERS = 3000;
const ROOM = { left: 24, right: 24, top: 54, bottom: 34 };
const VIEWS = { iso: ['Overview', [0.62, -0.72, 0.5]], front: ['Front', [0, -1, 0]], right: ['Right', [1, 0, 0]], top: ['Top', [0, 0, 1]] };

/** From which of four corners most is seen of what bends: flat faces are seldom what is looked for. */
function bestCorner(rows) {
  const score = ([x, y, z]) => rows.reduce((sum, { normal, area, type }) => sum + (normal ? (type === 'plane' ? 0.2 : 1) * Math.sqrt(area) * Math.max(0, normal[0] * x + normal[1] * y + normal[2] * z) : 0), 0);
  const [x, y, z] = VIEWS.iso[1], corners = [[x, y, z], [-x, y, z], [x, -y, z], [-x, -y, z]];
  return corners.reduce((best, corner) => (score(corner) > 1.02 * score(best) ? corner : best));
}

/** [face, what it is, its role] of a wheel.json: ["F9", "blade 2 ahead", "blade side"]. */
function wheelParts({ hub, shroud, blades, rest }) {
  const all = [['hub', 'hub', hub], ['shroud', 'shroud', shroud], ['rest', 'no role', rest]];
  blades.forEach((blade, k) => {
    const side = blade.kind === 'splitter' ? 'splitter side' : 'blade side';
    const names = { ahead: ['ahead', side], behind: ['behind', side], edges: ['edge', 'edge'], tips: ['tip', 'tip'], fillets: ['fillet', 'fillet'], buried: ['buried', 'no role'] };
    for (const [key, [name, role]] of Object.entries(names)) all.push([`${blade.kind} ${k + 1} ${name}`, role, blade[key]]);
  });
  return all.flatMap(([words, role, faces]) => faces.map((face) => [face.face ?? face, words, role]));
}

/** Rows of faces.json with the pieces below their face. */
const flat = (faces) => faces.flatMap((row) => [row, ...(row.pieces ?? []).map((piece) => ({ ...piece, piece: true, parent: row.id }))]);

export class Chooser {
  /** `data`: faces.json. `changed()` is called when other faces are chosen. Where somebody knows them, `smooth(id)` gives the
   * names of a face and of all that is joined to it smoothly, and `wheel()` what the faces of a wheel are. */
  constructor(data, changed = () => {}, { smooth = null, wheel = null } = {}) {
    Object.assign(this, { data, changed, smooth, wheel });
    this.rows = flat(data.faces);
    this.rowOf = new Map(this.rows.map((row) => [row.id, row]));
    // A page of a wheel is coloured by what its faces are.
    for (const [id, words, role] of data.wheel ? wheelParts(data.wheel) : []) Object.assign(this.rowOf.get(id) ?? {}, { of: words, role });
    this.marks = new Map();
    this.role = 'machine';
    this.glowing = null;
    this.model = new FaceModel(data.bodies.map(readBody));
    this.makeView();
    this.makeList();
    this.paint();
  }

  makeView() {
    this.canvas = html('canvas', { class: 'canvas', tabindex: '0', role: 'img', 'aria-label': `${this.data.file}: its faces, coloured by kind. Arrow keys turn, plus and minus zoom, Home resets; the table beside it lists the faces.` });
    this.probe = html('div', { class: 'probe', role: 'status' });
    this.pins = html('div', { class: 'overlay' });
    this.triad = svg('svg', { class: 'triad', width: 84, height: 84, viewBox: '-42 -42 84 84', 'aria-hidden': 'true' });
    this.scale = html('div', { class: 'scalebar', 'aria-hidden': 'true' }, html('span'), html('i'));
    this.picture = html('div', { class: 'picture' }, this.canvas, this.pins, this.buttons = html('div', { class: 'cameras' }, this.cameras(), this.section()), this.probe, this.triad, this.scale);
    this.kinds = html('div', { class: 'kinds', role: 'group', 'aria-label': 'Types of faces' }, ...kindButtons(this.rows, (kind) => this.table.filter({ kind })));
    this.view = html('div', { class: 'facesview' }, this.picture, this.kinds);
  }

  cameras() {
    return html('div', { class: 'group', role: 'group', 'aria-label': 'Camera' }, ...Object.entries(VIEWS).map(([name, [text]]) => {
      const button = html('button', { type: 'button', 'data-view': name }, text);
      button.addEventListener('click', () => this.stage.look(name));
      return button;
    }));
  }

  /** A plane that cuts the part open. */
  section() {
    const axis = html('select', { 'aria-label': 'Section' }, ...[['', 'No section'], ['0', 'Section in X'], ['1', 'Section in Y'], ['2', 'Section in Z']].map(([value, text]) => html('option', { value }, text)));
    const place = html('input', { type: 'range', min: '0', max: '1000', value: '500', 'aria-label': 'Position of the section', hidden: '' });
    const cut = () => {
      place.hidden = axis.value === '';
      const k = Number(axis.value), box = this.model.box(), normal = new Vector3().setComponent(k, -1);
      this.model.cut(place.hidden ? null : new Plane(normal, box[k] + (box[k + 3] - box[k]) * (Number(place.value) / 1000)));
      this.stage.draw();
    };
    axis.addEventListener('change', cut);
    place.addEventListener('input', cut);
    return html('div', { class: 'group' }, axis, place);
  }

  makeList() {
    this.search = html('input', { type: 'search', placeholder: 'Filter: F12, cone, concave', 'aria-label': 'Filter the faces' });
    this.search.addEventListener('input', () => this.table.filter({ words: this.search.value }));
    this.all = html('button', { type: 'button', title: 'Choose all faces that the table lists' }, 'Choose listed');
    this.all.addEventListener('click', () => this.choose(this.table.shown.map((row) => row.id)));
    this.hide = html('button', { type: 'button', title: 'Hide the chosen faces (H)' }, 'Hide');
    this.hide.addEventListener('click', () => this.hideChosen());
    this.showAll = html('button', { type: 'button', hidden: '' }, 'Show all');
    this.showAll.addEventListener('click', () => this.hideFaces([]));
    const holder = html('div', { class: 'tableholder' });
    this.tangent = html('button', { type: 'button', title: 'Also choose all faces tangent to the chosen ones', ...(this.smooth ? {} : { hidden: '' }) }, 'Tangent');
    this.tangent.addEventListener('click', () => this.chooseSmooth());
    this.parts = html('button', { type: 'button', title: 'Name the faces of a wheel: hub, blades, sides, edges, tips; the filter then finds these names, too', ...(this.wheel ? {} : { hidden: '' }) }, 'Wheel');
    this.parts.addEventListener('click', () => this.nameWheel().catch((error) => { this.probe.textContent = error.message; }));
    this.list = html('div', { class: 'faceslist' }, html('div', { class: 'tools' }, this.search, this.all, this.tangent, this.parts, this.hide, this.showAll), holder);
    this.table = new FaceTable(holder, this.rows, { hover: (id) => this.hover(id, true), click: (id, more) => this.click(id, more) }, (id) => this.marks.get(id));
  }

  /** Draws, once its view is in the page. */
  start() {
    this.stage = new Stage(this.canvas, ROOM, true);
    this.stage.renderer.localClippingEnabled = true;
    this.stage.scene.add(this.model.root);
    this.frame();
    this.stage.onDraw((stage) => {
      drawTriad(this.triad, stage.camera);
      drawScale(this.scale, stage.pixel);
    });
    this.measure = new Measure(this.stage, this.model, this.pins, (text) => { this.probe.textContent = text; });
    this.buttons.append(html('div', { class: 'group' }, this.measure.button));
    this.listen();
    this.paint();
    return this;
  }

  frame() {
    const p = this.model.positions, stride = 3 * Math.max(1, Math.floor(p.length / 3 / CORNERS)), points = [];
    for (let k = 0; k + 2 < p.length; k += stride) points.push(new Vector3(p[k], p[k + 1], p[k + 2]));
    const box = this.model.box(), low = new Vector3(...box.slice(0, 3)), high = new Vector3(...box.slice(3));
    if (!points.length) [points[0], low.x, high.x] = [new Vector3(), -1, 1];
    const home = { centre: low.clone().add(high).multiplyScalar(0.5), radius: Math.max(1e-6, 0.5 * low.distanceTo(high)) };
    const views = Object.fromEntries(Object.entries(VIEWS).map(([name, [, towards]]) => {
      const direction = new Vector3(...(name === 'iso' ? bestCorner(this.data.faces) : towards)).normalize();
      return [name, { direction, up: Math.abs(direction.z) > 0.9 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1), points }];
    }));
    this.stage.hang(home, { ...views, overview: views.iso });
    this.stage.look('iso');
  }

  listen() {
    let pressed = null;
    this.canvas.addEventListener('pointerdown', (event) => { pressed = [event.clientX, event.clientY]; });
    this.canvas.addEventListener('pointerup', (event) => {
      const still = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < STILL;
      pressed = null;
      if (still && event.button === 0) this.clickAt(event);
    });
    this.canvas.addEventListener('pointermove', (event) => { if (!event.buttons) this.hoverAt(event); });
    this.canvas.addEventListener('pointerleave', () => this.hover(null));
    const turn = 0.12;
    const keys = { ArrowLeft: [-turn, 0], ArrowRight: [turn, 0], ArrowUp: [0, turn], ArrowDown: [0, -turn], '+': [0, 0, 0.88], '=': [0, 0, 0.88], '-': [0, 0, 1 / 0.88] };
    this.canvas.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey) return;
      if (event.key === 'Home') this.stage.look('iso');
      else if (event.key === 'h') this.hideChosen();
      else if (event.key === 'm') this.measure.turn(!this.measure.on);
      else if (keys[event.key]) this.stage.orbit(...keys[event.key]);
      else return;
      event.preventDefault();
    });
  }

  at(event) {
    const box = this.canvas.getBoundingClientRect();
    return this.model.pick(this.stage, event.clientX - box.left, event.clientY - box.top);
  }

  hoverAt(event) {
    if (this.looking) return;
    this.looking = true;
    requestAnimationFrame(() => {
      this.looking = false;
      this.hover(this.at(event)?.id ?? null);
    });
  }

  clickAt(event) {
    if (this.measure.on) {
      const box = this.canvas.getBoundingClientRect();
      return this.measure.click(event.clientX - box.left, event.clientY - box.top);
    }
    const found = this.at(event);
    if (found) this.click(found.id, event.shiftKey || event.ctrlKey || event.metaKey);
    else if (!event.shiftKey) this.choose([]);
    if (found) this.table.show(found.id);
  }

  hover(id, fromTable = false) {
    if (id === this.glowing) return;
    this.glowing = id;
    if (!this.measure?.on || id) this.probe.textContent = id ? this.describe(id) : '';
    this.canvas.style.cursor = id ? 'pointer' : '';
    if (!fromTable) this.table.glow(id);
    this.colour();
  }

  describe(id) {
    const row = this.rowOf.get(id);
    if (!row || row.why) return `${id}  ${row?.why ?? ''}`;
    const concave = radiusOf(row);
    return [id, ...(row.of ? [row.of] : []), row.type, `${sizeOf(row)} mm`, `${format.plain(row.area, 4)} mm²`, concave === '–' ? row.bend : `${row.bend}, concave R ${concave} mm`].join('  ·  ');
  }

  click(id, more) {
    const mine = this.chosen();
    if (more) mine.includes(id) ? this.marks.delete(id) : this.marks.set(id, this.role);
    else {
      for (const other of mine) this.marks.delete(other);
      if (!(mine.length === 1 && mine[0] === id)) this.marks.set(id, this.role);
    }
    this.tell();
  }

  /** These faces, and no others, in the present role. */
  choose(ids) {
    for (const id of this.chosen()) this.marks.delete(id);
    for (const id of ids) this.marks.set(id, this.role);
    this.tell();
  }

  /** All that is joined smoothly to what is chosen. */
  async chooseSmooth() {
    this.tangent.disabled = true;
    const ids = new Set(this.chosen());
    for (const id of [...ids])
      try {
        for (const one of facesIn(await this.smooth(id))) if (this.rowOf.has(one)) ids.add(one);
      } catch (error) {
        this.probe.textContent = error.message;
      }
    this.tangent.disabled = false;
    this.choose([...ids]);
  }

  /** Names and colours each face by what it is of a wheel; the wheel. Throws in the command's words if the part is none. */
  async nameWheel() {
    this.parts.disabled = true;
    try {
      const told = await this.wheel();
      for (const [id, of, role] of wheelParts(told)) Object.assign(this.rowOf.get(id) ?? {}, { of, role });
      this.kinds.replaceChildren(...kindButtons(this.rows, (kind) => this.table.filter({ kind })));
      this.table.filter({ kind: '' });
      this.paint();
      return told;
    } finally {
      this.parts.disabled = false;
    }
  }

  chosen(role = this.role) {
    return [...this.marks].filter(([, mark]) => mark === role).map(([id]) => id);
  }

  /** "F1,F3-F5" of what is chosen for a role. */
  names(role = this.role) {
    return faceList(this.chosen(role));
  }

  tell() {
    this.table.draw();
    this.colour();
    this.changed();
  }

  hideChosen() {
    const ids = this.chosen().map((id) => this.rowOf.get(id)?.parent ?? id);
    if (ids.length) this.hideFaces([...this.model.hidden, ...ids]);
  }

  hideFaces(ids) {
    this.model.hide(ids);
    this.showAll.hidden = !ids.length;
    this.stage.draw();
  }

  colour() {
    const marked = new Map();
    for (const [id, role] of this.marks) marked.set(this.rowOf.get(id)?.parent ?? id, role);
    const glowing = this.rowOf.get(this.glowing)?.parent ?? this.glowing;
    this.model.paint((id) => (marked.has(id) ? ROLES[marked.get(id)].colour : kindColour(kindOf(this.rowOf.get(id) ?? {}))), glowing);
    this.stage?.draw();
  }

  paint() {
    this.model.edges.material.color.set(palette().edge);
    paintKinds(this.kinds);
    this.table.draw();
    this.colour();
  }

  /** The browser keeps few pictures at a time: one that is gone gives its own back. */
  dispose() {
    this.stage?.dispose();
  }
}
