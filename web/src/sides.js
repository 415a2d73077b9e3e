// The two sides of a sheet as arrows at its face: the one that is machined is filled, and the other can be clicked.
import { html } from './dom.js';

/** Length of an arrow, of the part's radius. */
const LENGTH = 0.28;

export class Sides {
  /** `choose(sign)`: "+" or "-" was clicked. */
  constructor(chooser, choose) {
    this.chooser = chooser;
    this.sheets = [];
    this.buttons = ['+', '-'].map((sign) => {
      const button = html('button', { type: 'button', class: 'side', hidden: '', 'data-side': sign, 'aria-pressed': 'false', 'aria-label': `Machine this sheet from side ${sign === '+' ? 'plus, where its normal points' : 'minus, against its normal'}` }, sign === '+' ? '+' : '−');
      button.addEventListener('click', () => choose(sign));
      chooser.pins.append(button);
      return button;
    });
    this.line = html('i', { class: 'sideline', hidden: '' });
    chooser.pins.append(this.line);
    chooser.stage.onDraw(() => this.draw());
  }

  /** `sides`: as the dry run tells them: place, towards, side. */
  show(sides) {
    this.sheets = sides;
    const first = sides[0];
    for (const button of this.buttons) {
      button.hidden = !first;
      button.setAttribute('aria-pressed', String(first && first.side === button.dataset.side));
    }
    this.line.hidden = !first;
    this.chooser.stage.draw();
  }

  draw() {
    const sheet = this.sheets[0], { stage } = this.chooser;
    if (!sheet) return;
    const centre = stage.home.centre.clone().set(...sheet.place), towards = centre.clone().set(...sheet.towards).multiplyScalar(LENGTH * stage.home.radius * (sheet.side === '+' ? 1 : -1));
    const ends = this.buttons.map((button) => stage.toScreen(centre.clone().addScaledVector(towards, button.dataset.side === '+' ? 1 : -1)));
    this.buttons.forEach((button, k) => { button.style.transform = `translate(${ends[k][0].toFixed(1)}px, ${ends[k][1].toFixed(1)}px)`; });
    const [[ax, ay], [bx, by]] = ends;
    this.line.style.cssText = `width:${Math.hypot(bx - ax, by - ay).toFixed(1)}px; transform: translate(${ax.toFixed(1)}px, ${ay.toFixed(1)}px) rotate(${Math.atan2(by - ay, bx - ax)}rad)`;
  }
}
