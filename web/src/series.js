// Values over the time of a program, on a canvas (uPlot, which is made for long series): all of them share their time.
// Drag to look closer, double click for the whole again.
import uPlot from 'uplot';
import { html } from './dom.js';
import { plain, tick } from './format.js';

const SIZE = { width: 420, height: 160 };
const FONT = '11px system-ui, sans-serif';

/** Of the page as it looks now: light and dark have their own. */
const colour = (name) => () => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const axis = (label, size, space) => ({
  label, size, space, labelSize: 16, labelGap: 0, gap: 4, font: FONT, labelFont: FONT,
  stroke: colour('--soft'), grid: { stroke: colour('--grid'), width: 1 }, ticks: { show: false },
  values: (_, splits) => splits.map((value) => (value === null ? '' : tick(value))),
});

/** Limits as dashed lines, where they lie on the scale. */
function drawLimits({ ctx, bbox, scales, valToPos }, limits) {
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = colour('--ink')();
  ctx.globalAlpha = 0.75;
  ctx.font = FONT;
  ctx.textAlign = 'right';
  for (const { value, name } of limits) {
    if (value <= scales.y.min || value >= scales.y.max) continue;
    const y = Math.round(valToPos(value, 'y', true));
    ctx.setLineDash([4, 3]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.fillText(name, bbox.left + bbox.width - 2, y - 3);
  }
  ctx.restore();
}

export class SeriesPlot {
  /**
   * `range`: lowest and highest value; `limits`: [{ value, name }]; `title` says in words what is seen; `pointed`: called with
   * the index of the time that is pointed at.
   */
  constructor({ time, values, name, range, limits = [], title, pointed }) {
    this.root = html('div', { class: 'series', role: 'img', 'aria-label': title, title });
    this.plot = new uPlot({
      ...SIZE,
      legend: { show: false },
      scales: { x: { time: false }, y: { range: () => range } },
      axes: [axis('time, s', 22, 44), axis(name, 54, 26)],
      series: [{}, { stroke: colour('--accent'), width: 1.4, points: { show: false }, spanGaps: false }],
      cursor: { sync: { key: 'program', scales: ['x', null] }, y: false, drag: { x: true, y: false } },
      hooks: {
        draw: [(plot) => drawLimits({ ctx: plot.ctx, bbox: plot.bbox, scales: plot.scales, valToPos: plot.valToPos.bind(plot) }, limits)],
        setCursor: [(plot) => {
          const at = plot.cursor.idx;
          this.root.dataset.value = at === null || at === undefined || values[at] === null ? '' : plain(values[at], 4);
          if (plot.cursor.event && at !== null && at !== undefined) pointed?.(at);
        }],
      },
    }, [time, values], this.root);
    new ResizeObserver(([{ contentRect }]) => {
      const width = Math.floor(contentRect.width);
      if (width > 0 && width !== this.plot.width) this.plot.setSize({ ...SIZE, width });
    }).observe(this.root);
  }

  /** Once more in the colours of the page. */
  paint() {
    this.plot.redraw(false, true);
  }
}
