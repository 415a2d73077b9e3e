// Numbered pins on the worst places, over the 3D view.
import { Vector3 } from 'three';
import { html } from './dom.js';
import * as format from './format.js';

export class Pins {
  constructor(holder, places, tolerance, go) {
    this.holder = holder;
    this.pins = places.map((place, k) => ({ place, k })).filter(({ place }) => place.f_mm !== null).map(({ place, k }) => {
      const deep = place.f_mm < -tolerance;
      const button = html('button', { type: 'button', class: deep ? 'pin deep' : 'pin', tabindex: '-1',
        'aria-label': `Worst place ${k + 1}: ${place.face}, ${format.error(place.f_mm)}`, title: `${place.face}: ${format.error(place.f_mm)}` }, String(k + 1));
      button.addEventListener('click', () => go(place, k));
      holder.append(button);
      return { button, point: new Vector3(...place.point) };
    });
  }

  draw(stage) {
    for (const { button, point } of this.pins) {
      const [x, y, depth] = stage.toScreen(point);
      button.hidden = depth > 1;
      button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
  }

  show(visible) {
    this.holder.hidden = !visible;
  }
}
