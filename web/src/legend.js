// The scale of the error's colours, the cross of axes, and the scale bar.
import { colourAt, css, UNREACHED } from './colours.js';
import { axesOnScreen } from './camera.js';
import { svg } from './dom.js';
import * as format from './format.js';

const HEIGHT = 208, TOP = 40, BAR = 14, X = 8;

/** Where the scale has numbers, in tolerances. */
const labels = (span) => (span > 1 ? [span, 0.5 * span, 1, 0, -1, -0.5 * span, -span] : [span, 0.5 * span, 0, -0.5 * span, -span]);

function bar(y, span) {
  const rects = [];
  for (let k = 0; k < HEIGHT; ++k) {
    const x = span - ((k + 0.5) / HEIGHT) * 2 * span;
    rects.push(svg('rect', { x: X, width: BAR, y: TOP + k, height: 1.6, fill: css(colourAt(x, span)), 'shape-rendering': 'crispEdges' }));
  }
  rects.push(svg('rect', { x: X, y: TOP, width: BAR, height: HEIGHT, class: 'frame' }));
  if (span > 1) rects.push(svg('path', { d: `M${X + BAR + 3} ${y(1)}h5V${y(-1)}h-5`, class: 'bracket' }));
  return rects;
}

/** The scale for a tolerance in mm, ending at `span` tolerances. */
export function legend(tolerance, span) {
  const y = (x) => TOP + ((span - x) / (2 * span)) * HEIGHT;
  const below = TOP + HEIGHT;
  const root = svg('svg', { viewBox: '0 0 122 304', width: 122, height: 304, role: 'img',
    'aria-label': `Colours of the signed error: pale near zero, a jump at the tolerance of ${format.tolerance(tolerance)}, blue where material is left, red where the face is gouged, grey where it is not machined` });
  root.append(...bar(y, span));
  for (const x of labels(span)) {
    const label = x === 0 ? '0' : `${x > 0 ? '+' : ''}${format.error(x * tolerance, 2)}`;
    const place = y(x) + (x === span ? 9 : x === -span ? 0 : 4);
    root.append(svg('text', { x: X + BAR + 12, y: place, class: Math.abs(x) === 1 ? 'strong' : '' }, label));
  }
  root.append(svg('text', { x: X, y: 14, class: 'strong' }, 'Signed error'), svg('text', { x: X, y: 31, class: 'soft' }, 'excess material'),
    svg('text', { x: X, y: below + 17, class: 'soft' }, 'gouge'));
  if (span > 1) root.append(svg('rect', { x: X, y: below + 29, width: BAR, height: 12, fill: UNREACHED }),
    svg('text', { x: X + BAR + 12, y: below + 39 }, 'not machined'));
  else root.append(svg('text', { x: X, y: below + 38, class: 'soft' }, `within ±${format.tolerance(tolerance)}`));
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
