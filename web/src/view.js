// Puts the 3D view together: part, axis surface, tool, pins, layers, probe, keys.
import { PartModel } from './bodies.js';
import { readBody } from './data.js';
import { byId, html } from './dom.js';
import * as format from './format.js';
import { drawScale, drawTriad, legend } from './legend.js';
import { Pins } from './pins.js';
import { Stage } from './scene.js';
import { palette } from './theme.js';
import { AxisModel, ToolModel } from './tool.js';

export class View {
  constructor({ view, verify }, path, go) {
    this.tolerance = view.tolerance_mm;
    this.stage = new Stage(byId('canvas'));
    this.part = new PartModel(view.bodies.map(readBody), view.tolerance_mm);
    this.tool = new ToolModel(view.tool);
    this.axis = new AxisModel(path, view.tool.axis_length_mm);
    this.stage.scene.add(this.part.root, this.tool.root, this.axis.root);
    this.pins = new Pins(byId('pins'), verify?.worst_places ?? [], view.tolerance_mm, go);
    byId('legend').replaceChildren(legend(view.tolerance_mm));
    this.paint();
    this.addLayers();
    this.addControls();
    this.stage.onDraw((stage) => {
      drawTriad(byId('triad'), stage.camera);
      drawScale(byId('scalebar'), stage.pixel);
      this.pins.draw(stage);
    });
  }

  /** Chooses the camera; the tool must stand where it is to be shown. */
  open(path) {
    const middle = path.locate(0.5);
    const targets = this.part.targets;
    this.stage.frame(targets.length ? targets : this.part.others, middle ? middle.axis : new this.tool.root.position.constructor(0, 0, 1));
  }

  paint() {
    const theme = palette();
    for (const model of [this.part, this.tool, this.axis]) model.paint(theme);
    this.stage.draw();
  }

  move(place) {
    this.tool.place(place);
    this.stage.draw();
  }

  addLayers() {
    const layers = [
      ['Error colours', true, (on) => this.part.showError(on)],
      ['Other faces', true, (on) => this.part.showOthers(on)],
      ['Tool', true, (on) => { this.tool.root.visible = on; }],
      ['Axis surface', true, (on) => { this.axis.root.visible = on; }],
      ['Worst places', true, (on) => this.pins.show(on)],
    ];
    for (const [name, on, show] of layers) {
      const box = html('input', { type: 'checkbox' });
      box.checked = on;
      box.addEventListener('change', () => { show(box.checked); this.stage.draw(); });
      byId('layers').append(html('label', {}, box, name));
    }
  }

  addControls() {
    const canvas = byId('canvas');
    for (const button of document.querySelectorAll('[data-camera]'))
      button.addEventListener('click', () => this.stage.look(button.dataset.camera));
    const turn = 0.12;
    const keys = { ArrowLeft: [-turn, 0], ArrowRight: [turn, 0], ArrowUp: [0, turn], ArrowDown: [0, -turn],
      '+': [0, 0, 0.88], '=': [0, 0, 0.88], '-': [0, 0, 1 / 0.88] };
    canvas.addEventListener('keydown', (event) => {
      if (event.key === 'Home') this.stage.look('overview');
      else if (keys[event.key] && !event.ctrlKey && !event.metaKey) this.stage.orbit(...keys[event.key]);
      else return;
      event.preventDefault();
    });
    canvas.addEventListener('pointermove', (event) => { if (!event.buttons) this.probe(event); });
    canvas.addEventListener('pointerleave', () => { byId('probe').textContent = ''; });
  }

  /** The error under the pointer, not oftener than the page can draw. */
  probe(event) {
    if (this.probing) return;
    this.probing = true;
    requestAnimationFrame(() => {
      this.probing = false;
      const box = byId('canvas').getBoundingClientRect();
      const meshes = [...this.part.targets, ...this.part.enteredMeshes, this.tool.root.children[0]].filter((m) => m.visible && m.parent.visible);
      const hit = this.stage.pick(event.clientX - box.left, event.clientY - box.top, meshes);
      byId('probe').textContent = hit ? this.describe(hit) : '';
    });
  }

  describe({ object, face, point }) {
    const body = object.userData.body;
    if (!body) return '';
    const nearest = [face.a, face.b, face.c].reduce((best, k) => {
      const d = Math.hypot(body.positions[3 * k] - point.x, body.positions[3 * k + 1] - point.y, body.positions[3 * k + 2] - point.z);
      return d < best.d ? { k, d } : best;
    }, { k: face.a, d: Infinity }).k;
    const at = [point.x, point.y, point.z].map((v) => format.plain(v, 4)).join(', ');
    if (!body.target && body.f[nearest] >= 0) return `${body.face}  at (${at}): not entered`;
    return `${body.face}  ${format.error(body.f[nearest])}  at (${at})`;
  }
}
