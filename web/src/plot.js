// Axes, grid and scales of a small chart.
import { picture, svg } from './dom.js';
import { tick, ticks } from './format.js';

export class Plot {
  constructor({ width = 420, height = 190, x, y, xName, yName, title, left = 50, bottom = 36, top = 14, right = 12, xCount = 6, yCount = 4 }) {
    Object.assign(this, { width, height, x, y, left, top, right: width - right, bottom: height - bottom });
    this.root = picture(width, height, title);
    this.grid(xCount, yCount);
    this.name(xName, (this.left + this.right) / 2, height - 4, 'middle');
    this.root.append(svg('text', { class: 'name', 'text-anchor': 'middle', transform: `translate(11 ${(this.top + this.bottom) / 2}) rotate(-90)` }, yName));
  }

  px(value) {
    return this.left + ((value - this.x[0]) / (this.x[1] - this.x[0])) * (this.right - this.left);
  }

  py(value) {
    const clamped = Math.max(this.y[0], Math.min(this.y[1], value));
    return this.bottom - ((clamped - this.y[0]) / (this.y[1] - this.y[0])) * (this.bottom - this.top);
  }

  name(text, x, y, anchor) {
    this.root.append(svg('text', { class: 'name', x, y, 'text-anchor': anchor }, text));
  }

  grid(xCount, yCount) {
    for (const value of ticks(this.x[0], this.x[1], xCount)) {
      const x = this.px(value);
      this.root.append(svg('line', { class: 'grid', x1: x, x2: x, y1: this.top, y2: this.bottom }),
        svg('text', { class: 'tick', x, y: this.bottom + 13, 'text-anchor': 'middle' }, tick(value)));
    }
    for (const value of ticks(this.y[0], this.y[1], yCount)) {
      const y = this.py(value);
      this.root.append(svg('line', { class: value === 0 ? 'grid zero' : 'grid', x1: this.left, x2: this.right, y1: y, y2: y }),
        svg('text', { class: 'tick', x: this.left - 5, y: y + 3.5, 'text-anchor': 'end' }, tick(value)));
    }
  }

  /** A horizontal limit with its name above it, or `below` it by so many pixels. */
  limit(value, text, below = -3) {
    const y = this.py(value);
    this.root.append(svg('line', { class: 'limit', x1: this.left, x2: this.right, y1: y, y2: y }));
    if (text) this.root.append(svg('text', { class: 'limit', x: this.right - 2, y: y + below, 'text-anchor': 'end' }, text));
  }

  bar(x0, x1, height, colour) {
    const a = this.px(x0), b = this.px(x1), y = this.py(height);
    this.root.append(svg('rect', { x: a + 0.4, width: Math.max(0.5, b - a - 0.8), y, height: Math.max(0, this.bottom - y), fill: colour, class: 'bar' }));
  }

  /** A curve through [x, y]; null y is a gap. */
  curve(points, className) {
    let path = '', pen = 'M';
    for (const [x, y] of points) {
      if (y === null || !Number.isFinite(y)) { pen = 'M'; continue; }
      path += `${pen}${this.px(x).toFixed(1)} ${this.py(y).toFixed(1)}`;
      pen = 'L';
    }
    this.root.append(svg('path', { d: path, class: className }));
  }

  /** The area between two curves; gaps where either has one. */
  band(points, className) {
    let run = [];
    const flush = () => {
      if (run.length) {
        const upper = run.map(([x, , high]) => `${this.px(x).toFixed(1)} ${this.py(high).toFixed(1)}`);
        const lower = run.map(([x, low]) => `${this.px(x).toFixed(1)} ${this.py(low).toFixed(1)}`).reverse();
        this.root.append(svg('path', { d: `M${upper.join('L')}L${lower.join('L')}Z`, class: className }));
      }
      run = [];
    };
    for (const point of points) point[1] === null || point[2] === null ? flush() : run.push(point);
    flush();
  }
}
