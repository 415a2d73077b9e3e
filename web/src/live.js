// One job as it runs: its stage, its share, the best so far, and what can be done with it.
import { get, place, post } from './api.js';
import { html, svg } from './dom.js';

/** Milliseconds between two looks at a job that runs. */
const LOOK = 300;

const SIZE = { width: 300, height: 64 };
export const seconds = (s) => (s < 90 ? `${s.toFixed(s < 10 ? 1 : 0)} s` : s < 5400 ? `${(s / 60).toFixed(1)} min` : `${(s / 3600).toFixed(1)} h`);

/** [state, words] of a job, from the exit code of its command. */
export function verdictOf(job) {
  if (job.state === 'waiting') return ['warn', 'waits'];
  if (job.state === 'running') return ['busy', job.stopping ? 'stopping' : 'runs'];
  if (job.crash) return ['fail', 'crashed'];
  if (job.exit === null) return ['warn', 'not begun'];
  if (job.exit > 1) return ['fail', 'refused'];
  if (job.summary?.complete === false || (job.resumable && !job.summary)) return ['warn', 'stopped'];
  return job.exit === 0 ? ['pass', 'meets'] : ['fail', 'falls short'];
}

/** The best over the share that is done. */
function curve(points) {
  const shown = points.filter(({ best }) => best), x = ({ share }) => SIZE.width * share, y = ({ best }) => SIZE.height - 4 - (SIZE.height - 8) * Math.max(0, best.coverage);
  const line = shown.map((p) => `${x(p).toFixed(1)},${y(p).toFixed(1)}`).join(' ');
  return svg('svg', { viewBox: `0 0 ${SIZE.width} ${SIZE.height}`, class: 'curve-best', role: 'img', 'aria-label': 'Best finished share over the progress', preserveAspectRatio: 'none' },
    svg('line', { x1: 0, x2: SIZE.width, y1: 4, y2: 4, class: 'grid' }), svg('polyline', { points: line, class: 'curve main' }));
}

export class Live {
  /** `told(job)` is called after every look. */
  constructor(id, told) {
    Object.assign(this, { id, told, from: 0, points: [], message: '', over: false });
    this.root = html('section', { class: 'live', 'aria-label': `Job ${id}` });
    this.status = html('p', { class: 'sr', role: 'status' });
    this.look();
  }

  async look() {
    if (this.over) return;
    try {
      const job = await get(`jobs/${this.id}?from=${this.from}`);
      this.from = job.next;
      // A resumed run begins at nothing again: what is shown never falls.
      for (const point of job.progress) this.points.push({ ...point, share: Math.max(point.share, this.points.at(-1)?.share ?? 0) });
      this.message = job.message || this.message;
      this.job = job;
      this.draw();
      this.told(job);
      if (job.state !== 'done') this.again();
    } catch (error) {
      this.root.replaceChildren(html('p', { class: 'notice' }, error.message));
      this.again(4 * LOOK);
    }
  }

  again(pause = LOOK) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.look(), pause);
  }

  draw() {
    const { job } = this, [state, words] = verdictOf(job), last = this.points.at(-1), running = job.state === 'running';
    const done = job.state === 'done' && job.exit !== null && job.exit <= 1 && job.summary?.complete !== false;
    const share = done ? 1 : last?.share ?? 0;
    const facts = [running && last ? last.stage : '', seconds(job.seconds), running && last?.eta_s ? `about ${seconds(last.eta_s)} left` : '',
      last?.best ? `best ${(100 * last.best.coverage).toFixed(1)} %${last.best.clean ? '' : `, cuts ${Number(last.best.deepest_mm).toPrecision(2)} mm too deep`}` : ''].filter(Boolean);
    const bar = html('div', { class: 'bar-outer', role: 'progressbar', 'aria-label': 'Progress', 'aria-valuemin': '0', 'aria-valuemax': '100', 'aria-valuenow': String(Math.round(100 * share)) }, html('div', { class: `bar-inner ${state}`, style: `width:${(100 * share).toFixed(1)}%` }));
    this.root.dataset.state = job.state;
    this.root.dataset.share = String(share);
    this.root.replaceChildren(html('div', { class: 'livehead' }, html('span', { class: `pill ${state}`, 'data-exit': job.exit ?? '' }, words), html('strong', {}, `Job ${Number(job.id)}`), html('span', { class: 'soft facts' }, facts.join(' · ')), ...this.buttons()), bar,
      ...(running && this.points.some((p) => p.best) ? [curve(this.points)] : []), ...this.said());
    this.status.textContent = running ? '' : `Job ${Number(job.id)}: ${words}`;
  }

  said() {
    const { job } = this, bad = job.crash || (job.exit > 1 ? this.message.replace(/^flank: /, '') : '');
    const stopped = job.state === 'done' && job.resumable;
    return [...(bad ? [html('p', { class: 'notice', role: 'alert' }, bad)] : []),
      ...(stopped ? [html('p', { class: 'soft' }, job.summary ? 'Stopped: what is shown is the best so far. Resume goes on from there.' : 'Stopped before anything was found; Resume goes on from there.')] : [])];
  }

  buttons() {
    const button = (text, act, disabled) => {
      const made = html('button', { type: 'button', class: text.toLowerCase(), ...(disabled ? { disabled: '' } : {}) }, text);
      made.addEventListener('click', async () => {
        made.disabled = true;
        await post(`jobs/${this.id}/${act}`);
        this.again(0);
      });
      return made;
    };
    if (this.job.state !== 'done') return [button('Stop', 'stop', this.job.stopping)];
    return this.job.resumable || (this.job.exit === null && !this.job.summary) ? [button('Resume', 'resume')] : [];
  }

  end() {
    this.over = true;
    clearTimeout(this.timer);
  }
}

/** Where the report of a job is. */
export const reportOf = (id, theme) => `${place(`jobs/${id}/report`)}#theme=${theme}`;
