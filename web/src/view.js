// Puts the 3D view together: part, axis surface, tool, pins, layers, probe, keys.
import { Vector3 } from 'three';
import { FixtureModel, OTHERS, PartModel } from './bodies.js';
import { SPANS } from './colours.js';
import { readBody } from './data.js';
import { byId, html } from './dom.js';
import * as format from './format.js';
import { drawScale, drawTriad, legend } from './legend.js';
import { Pins } from './pins.js';
import { Stage } from './scene.js';
import { palette } from './theme.js';
import { AxisModel, ToolModel } from './tool.js';
import { collisions, places } from './worst.js';

/** Of more strips the surfaces of the axis are shown only if asked for. */
const MOST_AXIS_SURFACES = 12;

/** Sizes of the errors, without what was not machined at all. */
function* swept(f, tolerance) {
  for (const value of f) if (value < SPANS[0] * tolerance) yield Math.abs(value);
}

/** A labelled choice among [value, name], in the row of layers. */
function select(name, entries) {
  const choice = html('select', {}, ...entries.map(([value, text]) => html('option', { value }, text)));
  byId('layers').append(html('label', {}, name, choice));
  return choice;
}

export class View {
  constructor({ view, verify }, path, go) {
    this.tolerance = view.tolerance_mm;
    if (!path) throw new Error('there is no path');
    this.stage = new Stage(byId('canvas'));
    const struck = collisions(verify);
    this.part = new PartModel(view.bodies.map(readBody), view.tolerance_mm, struck);
    this.fixtures = new FixtureModel((view.fixtures ?? []).map(readBody), Math.max(0, ...struck.map((one) => one.required)));
    this.tool = new ToolModel(view.tool, struck.map((one) => one.body));
    this.axis = new AxisModel(path, view.tool.axis_length_mm);
    this.stage.scene.add(this.part.root, this.fixtures.root, this.tool.root, this.axis.root);
    this.pins = new Pins(byId('pins'), places(verify, view.tolerance_mm), go);
    this.paint();
    this.addLayers();
    this.addScales(view);
    this.addControls();
    this.stage.onDraw((stage) => {
      drawTriad(byId('triad'), stage.camera);
      drawScale(byId('scalebar'), stage.pixel);
      this.pins.draw(stage, () => [...this.part.targets, ...this.part.others, ...this.fixtures.meshes].filter((mesh) => mesh.visible && mesh.parent.visible && !mesh.material.transparent));
    });
  }

  /** Chooses the camera, and returns which of some shares of the path shows most of the target. `struck`: all must be seen. */
  open(path, shares, struck) {
    const targets = this.part.targets.length ? this.part.targets : this.part.others;
    const middle = path.locate(0.5);
    const axis = middle?.axis ?? new Vector3(0, 0, 1);
    const put = (share) => {
      const place = path.locate(share);
      if (place) this.tool.place(place);
      return place ? this.tool.extremes() : [];
    };
    const towards = middle ? [0.2, 0.5, 0.8].map(path.locate, path).map(({ tip, axis: u }) => tip.clone().addScaledVector(u, 0.5 * this.tool.length)) : [];
    const whole = (share) => [...put(share), ...this.tool.upperExtremes(), ...this.fixtures.corners(), ...this.part.corners()];
    const others = [...this.part.others, ...this.fixtures.meshes];
    const found = this.stage.frame({ targets, others, axis, towards, shares, put, whole, toolPoints: () => this.tool.surface() });
    if (found.hidden) {
      this.others.value = 'see-through';
      this.showOthers();
    }
    this.stage.look(struck ? 'all' : 'overview');
    return found.share;
  }

  paint() {
    const theme = palette();
    for (const model of [this.part, this.fixtures, this.tool, this.axis]) model.paint(theme);
    this.stage.draw();
  }

  move(place) {
    this.tool.place(place);
    this.stage.draw();
  }

  addLayers() {
    const layers = [
      ['Tool', true, (on) => { this.tool.root.visible = on; }],
      // Of many strips, as of a cavity's, they would hide the part.
      ['Swept tool axis', this.axis.groups.length <= MOST_AXIS_SURFACES, (on) => { this.axis.root.visible = on; }],
      ['Worst places', true, (on) => this.pins.show(on)],
      ...(this.fixtures.meshes.length ? [['Fixtures', true, (on) => { this.fixtures.root.visible = on; }]] : []),
    ];
    for (const [name, on, show] of layers) {
      const box = html('input', { type: 'checkbox' });
      box.checked = on;
      show(on);
      box.addEventListener('change', () => { show(box.checked); this.stage.draw(); });
      byId('layers').append(html('label', {}, box, name));
    }
  }

  /** Choices with more than two answers. `spans`: the ends of the colour scale in tolerances, 0 for no colours. */
  addScales(view) {
    const largest = Math.max(...this.part.targets.flatMap(({ userData }) => [...swept(userData.body.f, view.tolerance_mm)]), 1e-9) / view.tolerance_mm;
    const spans = [[SPANS[0], `± ${SPANS[0]} tolerances`], [SPANS[1], '± tolerance'], [Math.min(1, largest), '± largest error'], [0, 'no colours']];
    const range = select('Colours', spans.filter(([span], k) => k !== 2 || span < 1));
    // A face that is good everywhere would be white all over.
    const first = largest < 1 ? largest : SPANS[0];
    range.value = String(first);
    range.addEventListener('change', () => this.showScale(Number(range.value)));
    if (this.part.bends) {
      const tool = select('Error of', [['stiff', 'a stiff tool'], ['bent', 'the tool as it bends']]);
      tool.addEventListener('change', () => { this.part.showBent(tool.value === 'bent'); this.stage.draw(); });
    }
    this.others = select('Other faces', OTHERS.map((look) => [look, look]));
    this.others.addEventListener('change', () => { this.showOthers(); this.stage.draw(); });
    if (!this.part.others.length && !this.fixtures.meshes.length) this.others.parentElement.hidden = true;
    this.showScale(first);
  }

  showOthers() {
    this.part.showOthers(this.others.value);
    this.fixtures.show(this.others.value);
  }

  showScale(span) {
    byId('legend').replaceChildren(...(span > 0 ? [legend(this.tolerance, span)] : []));
    byId('legend').hidden = !(span > 0);
    this.part.showError(span > 0, span || SPANS[0]);
    this.stage.draw();
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
      const meshes = [...this.part.targets, ...this.part.entered, ...this.part.struck, ...this.fixtures.meshes, this.tool.root.children[0]].filter((m) => m.visible && m.parent.visible);
      const hit = this.stage.pick(event.clientX - box.left, event.clientY - box.top, meshes);
      byId('probe').textContent = hit ? this.describe(hit) : '';
    });
  }

  describe({ object, face, point }) {
    const body = object.userData.body;
    if (!body) return '';
    if (!body.f) return body.face;
    const nearest = [face.a, face.b, face.c].reduce((best, k) => {
      const d = Math.hypot(body.positions[3 * k] - point.x, body.positions[3 * k + 1] - point.y, body.positions[3 * k + 2] - point.z);
      return d < best.d ? { k, d } : best;
    }, { k: face.a, d: Infinity }).k;
    const at = [point.x, point.y, point.z].map((v) => format.plain(v, 4)).join(', ');
    const error = (object.userData.shown ?? body.f)[nearest];
    if (!body.target && error >= 0) return `${body.face}  at (${at}): not gouged`;
    return `${body.face}  ${format.error(error)}  at (${at})`;
  }
}
