// A distance between two places of a part: two clicks, each on a face; near a corner of its border the corner is meant.
import { Vector3 } from 'three';
import { html } from './dom.js';
import * as format from './format.js';

/** Pixels within which a click means a corner of a border. */
const NEAR = 9;

export class Measure {
  /** `stage` has the picture, `model` its faces; what is drawn goes into `overlay`. `told(text)` says the distance. */
  constructor(stage, model, overlay, told) {
    Object.assign(this, { stage, model, told, places: [], on: false });
    this.line = html('i', { class: 'measure-line', hidden: '' });
    this.marks = [0, 1].map(() => html('i', { class: 'measure-mark', hidden: '' }));
    this.label = html('span', { class: 'measure-label', hidden: '' });
    this.button = html('button', { type: 'button', 'aria-pressed': 'false', title: 'Distance between two places of the part (M)' }, 'Measure');
    this.button.addEventListener('click', () => this.turn(!this.on));
    overlay.append(this.line, ...this.marks, this.label);
    stage.onDraw(() => this.draw());
  }

  turn(on) {
    this.on = on;
    this.places = [];
    this.button.setAttribute('aria-pressed', String(on));
    this.told(on ? 'Click two places' : '');
    this.stage.draw();
  }

  /** A click at a place of the picture; the third one begins again. */
  click(x, y) {
    const found = this.model.pick(this.stage, x, y);
    if (!found) return;
    if (this.places.length === 2) this.places = [];
    this.places.push(this.corner(found, x, y));
    this.told(this.places.length === 2 ? `${this.words()}` : 'Click the second place');
    this.stage.draw();
  }

  corner({ id, point }, x, y) {
    const { borders } = this.model.bodies.find((body) => body.face === id);
    let best = NEAR, corner = point;
    for (let k = 0; k + 2 < borders.length; k += 3) {
      const place = new Vector3(borders[k], borders[k + 1], borders[k + 2]), [sx, sy] = this.stage.toScreen(place), away = Math.hypot(sx - x, sy - y);
      if (away < best) [best, corner] = [away, place];
    }
    return corner;
  }

  /** [length, along x, y and z], mm. */
  distance() {
    const [a, b] = this.places, way = b.clone().sub(a);
    return [way.length(), ...way.toArray().map(Math.abs)];
  }

  words() {
    const [all, ...along] = this.distance().map((v) => format.plain(v, 5));
    return `${all} mm  ·  ${along.map((v, k) => `${'XYZ'[k]} ${v}`).join('  ')}`;
  }

  draw() {
    const ends = this.places.map((place) => this.stage.toScreen(place)), whole = ends.length === 2;
    this.marks.forEach((mark, k) => {
      mark.hidden = !ends[k];
      if (ends[k]) mark.style.transform = `translate(${ends[k][0].toFixed(1)}px, ${ends[k][1].toFixed(1)}px)`;
    });
    this.line.hidden = this.label.hidden = !whole;
    if (!whole) return;
    const [[ax, ay], [bx, by]] = ends;
    this.line.style.cssText = `width:${Math.hypot(bx - ax, by - ay).toFixed(1)}px; transform: translate(${ax.toFixed(1)}px, ${ay.toFixed(1)}px) rotate(${Math.atan2(by - ay, bx - ax)}rad)`;
    this.label.textContent = `${format.plain(this.distance()[0], 5)} mm`;
    this.label.style.transform = `translate(${((ax + bx) / 2).toFixed(1)}px, ${((ay + by) / 2).toFixed(1)}px)`;
  }
}
