// The scale of the error's colours, the cross of axes, and the scale bar.
import { colourAt, css, SPAN, UNREACHED } from './colours.js';
import { axesOnScreen } from './camera.js';
import { svg } from './dom.js';
import * as format from './format.js';

const HEIGHT = 216, TOP = 30, BAR = 14, X = 8;

export function legend(tolerance) {
  const y = (x) => TOP + ((SPAN - x) / (2 * SPAN)) * HEIGHT;
  const root = svg('svg', { viewBox: '0 0 118 300', width: 118, height: 300, role: 'img',
    'aria-label': `Colours of the signed error: pale within the tolerance of ${format.error(tolerance)}, blue where material is left, red where too much is taken, grey where nothing reached` });
  const steps = 192;
  for (let k = 0; k < steps; ++k) {
    const x = SPAN - ((k + 0.5) / steps) * 2 * SPAN;
    root.append(svg('rect', { x: X, width: BAR, y: TOP + (k * HEIGHT) / steps, height: HEIGHT / steps + 0.6, fill: css(colourAt(x)) }));
  }
  root.append(svg('rect', { x: X, y: TOP, width: BAR, height: HEIGHT, class: 'frame' }));
  root.append(svg('path', { d: `M${X + BAR + 3} ${y(1)}h5V${y(-1)}h-5`, class: 'bracket' }));
  for (const x of [4, 2, 1, 0, -1, -2, -4]) {
    const label = x === 0 ? '0' : `${x > 0 ? '+' : ''}${format.error(x * tolerance)}`;
    root.append(svg('text', { x: X + BAR + 12, y: y(x) + 4, class: Math.abs(x) === 1 ? 'strong' : '' }, label));
  }
  root.append(svg('text', { x: X, y: 11 }, 'signed error'), svg('text', { x: X, y: 23, class: 'soft' }, 'material left'),
    svg('text', { x: X, y: TOP + HEIGHT + 15, class: 'soft' }, 'cut too deep'),
    svg('rect', { x: X, y: TOP + HEIGHT + 26, width: BAR, height: 12, fill: UNREACHED }),
    svg('text', { x: X + BAR + 12, y: TOP + HEIGHT + 36 }, 'not reached'));
  return root;
}

export function drawTriad(holder, camera) {
  const axes = axesOnScreen(camera).map((v, k) => ({ v, name: 'XYZ'[k] })).sort((a, b) => a.v.z - b.v.z);
  holder.replaceChildren(...axes.flatMap(({ v, name }) => [
    svg('line', { x1: 0, y1: 0, x2: 26 * v.x, y2: -26 * v.y, class: `axis ${name}` }),
    svg('text', { x: 34 * v.x, y: -34 * v.y + 4, 'text-anchor': 'middle', class: `axis ${name}` }, name),
  ]));
}

/** A round length of 60 to 150 pixels. */
export function drawScale(holder, pixel) {
  const most = 150 * pixel;
  const power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map((k) => k * power).find((l) => l <= most);
  holder.querySelector('span').textContent = length >= 1 ? `${length} mm` : format.error(length, 1);
  holder.querySelector('i').style.width = `${length / pixel}px`;
}
