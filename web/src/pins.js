// Pins on the places to look at, over the 3D view; those behind something are pale.
import { Vector3 } from 'three';
import { html } from './dom.js';

/** After the camera has rested for so many milliseconds it is worth asking what hides a pin. */
const REST = 150;

export class Pins {
  /** `list`: as places() of worst.js gives it. */
  constructor(holder, list, go) {
    this.holder = holder;
    this.pins = list.map((place) => {
      const words = `${place.name}: ${place.what}`;
      const button = html('button', { type: 'button', class: place.deep ? 'pin deep' : 'pin', tabindex: '-1', 'aria-label': `Place ${place.label}: ${words}`, title: words }, place.label);
      button.addEventListener('click', () => go(place));
      holder.append(button);
      // A collision lies inside of something: it would always be pale.
      return { button, point: new Vector3(...place.point), always: place.label === '!' };
    });
  }

  /** `walls`: gives the meshes that may hide a pin. */
  draw(stage, walls) {
    for (const { button, point } of this.pins) {
      const [x, y, depth] = stage.toScreen(point);
      button.hidden = depth > 1;
      button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
    clearTimeout(this.resting);
    if (this.pins.length) this.resting = setTimeout(() => this.fade(stage, walls()), REST);
  }

  fade(stage, walls) {
    for (const { button, point, always } of this.pins) button.classList.toggle('behind', !always && stage.hides(point, walls));
  }

  show(visible) {
    this.holder.hidden = !visible;
  }
}
