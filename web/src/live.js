// One job as it runs: its stage, its share, the best so far, and what can be done with it.
import { get, place, post } from './api.js';
import { html, svg } from './dom.js';
import { seconds } from './format.js';
import { planTable } from './plantable.js';

/** Milliseconds between two looks at a job that runs. */
const LOOK = 300;

const SIZE = { width: 300, height: 64 };

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
  return svg('svg', { viewBox: `0 0 ${SIZE.width} ${SIZE.height}`, class: 'curve-best', role: 'img', 'aria-label': 'Best finished area so far, over the progress of the job', preserveAspectRatio: 'none' },
    svg('line', { x1: 0, x2: SIZE.width, y1: 4, y2: 4, class: 'grid' }), svg('polyline', { points: line, class: 'curve main' }));
}

export class Live {
  /** `told(job)` is called after every look, `open(operation)` to show that of a wheel, or the whole if it is empty. */
  constructor(id, told, open) {
    Object.assign(this, { id, told, open, shown: '', from: 0, points: [], message: '', over: false });
    this.root = html('section', { class: 'live', 'aria-label': `Job ${id}` });
    this.status = html('p', { class: 'sr', role: 'status' });
    this.make();
    this.look();
  }

  async look() {
    // One at a time: two would both count the same lines.
    if (this.over || this.looking) return;
    this.looking = true;
    let pause = null;
    try {
      const job = await get(`jobs/${this.id}?from=${this.from}`);
      this.from = job.next;
      // A resumed run begins at nothing again: what is shown never falls.
      for (const point of job.progress) this.points.push({ ...point, share: Math.max(point.share, this.points.at(-1)?.share ?? 0) });
      this.message = job.message || this.message;
      this.job = job;
      this.drawIfNew();
      this.told(job);
      if (job.state !== 'done') pause = LOOK;
    } catch (error) {
      this.complain(error);
      pause = 4 * LOOK;
    }
    this.looking = false;
    if (this.soon) pause = 0;
    this.soon = false;
    if (pause !== null) this.again(pause);
  }

  /** Looks again after a pause; right after a look that is under way if there is to be none. */
  again(pause = LOOK) {
    if (this.looking) this.soon = true;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.look(), pause);
  }

  /** What stays while it changes: a button that is made anew between press and release of a click is never clicked, and loses the keyboard. */
  make() {
    this.pill = html('span', { class: 'pill' });
    this.facts = html('span', { class: 'soft facts' });
    this.inner = html('div', { class: 'bar-inner' });
    this.bar = html('div', { class: 'bar-outer', role: 'progressbar', 'aria-label': `Progress of job ${Number(this.id)}`, 'aria-valuemin': '0', 'aria-valuemax': '100' }, this.inner);
    this.best = html('div');
    this.words = html('div');
    this.plan = html('div');
    this.stop = this.button('Stop', 'stop');
    this.resume = this.button('Resume', 'resume');
    this.root.append(html('div', { class: 'livehead' }, this.pill, html('strong', {}, `Job ${Number(this.id)}`), this.facts, this.stop, this.resume), this.bar, this.best, this.words, this.plan);
  }

  button(text, act) {
    const made = html('button', { type: 'button', class: act, hidden: '' }, text);
    made.addEventListener('click', async () => {
      made.disabled = true;
      this.drawn = '';
      await post(`jobs/${this.id}/${act}`).catch((error) => this.complain(error));
      this.again(0);
    });
    return made;
  }

  complain(error) {
    this.said = null;
    this.drawn = '';
    this.words.replaceChildren(html('p', { class: 'notice', role: 'alert' }, error.message));
  }

  /** What is the same is not drawn again: without a graphics card every change of the page costs the processor, which the job needs. */
  drawIfNew() {
    const key = JSON.stringify([{ ...this.job, progress: [], next: 0, seconds: seconds(this.job.seconds) }, this.points.length]);
    if (key === this.drawn) return;
    this.drawn = key;
    this.draw();
  }

  draw() {
    const { job } = this, [state, words] = verdictOf(job), last = this.points.at(-1), running = job.state === 'running';
    const done = job.state === 'done' && job.exit !== null && job.exit <= 1 && job.summary?.complete !== false;
    const share = done ? 1 : last?.share ?? 0;
    const facts = [running && last ? last.stage : '', seconds(job.seconds), running && last?.eta_s ? `about ${seconds(last.eta_s)} left` : '',
      last?.best ? `best ${(100 * last.best.coverage).toFixed(1)} %${last.best.clean ? '' : `, cuts ${Number(last.best.deepest_mm).toPrecision(2)} mm too deep`}` : ''].filter(Boolean);
    Object.assign(this.root.dataset, { state: job.state, share: String(share) });
    this.pill.className = `pill ${state}`;
    this.pill.dataset.exit = job.exit ?? '';
    this.pill.textContent = words;
    this.facts.textContent = facts.join(' \u00b7 ');
    this.bar.setAttribute('aria-valuenow', String(Math.round(100 * share)));
    this.inner.className = `bar-inner ${state}`;
    this.inner.style.width = `${(100 * share).toFixed(1)}%`;
    this.best.replaceChildren(...(running && this.points.some((p) => p.best) ? [curve(this.points)] : []));
    this.offer();
    this.list();
    this.tell();
    this.status.textContent = running ? '' : `Job ${Number(job.id)}: ${words}`;
  }

  /** The operations of a wheel; a table that is the same stays as it is, or its buttons would be lost under a click. */
  list() {
    const key = JSON.stringify([this.job.plan, this.shown]);
    if (!this.job.plan || key === this.listed) return;
    this.listed = key;
    this.plan.replaceChildren(planTable(this.job.plan, this.shown, (operation) => {
      this.shown = operation;
      this.list();
      this.open(operation);
    }));
  }

  /** Says in the table that the whole is shown: no operation. */
  showWhole() {
    this.shown = '';
    this.list();
    return this.shown;
  }

  /** Which of the buttons are there. */
  offer() {
    const { job } = this, over = job.state === 'done';
    this.stop.hidden = over;
    this.stop.disabled = job.stopping;
    this.resume.hidden = !over || !(job.resumable || (job.exit === null && !job.summary));
    this.resume.disabled = false;
  }

  tell() {
    const { job } = this, bad = job.crash || (job.exit > 1 ? this.message.replace(/^flank: /, '') : '');
    const stopped = job.state !== 'done' || !job.resumable ? '' : job.plan ? 'Stopped. The operations that are done are kept; Resume continues with the others.' : job.summary ? 'Stopped. Shown is the best result so far; Resume continues from there.' : 'Stopped before a result was found; Resume continues.';
    if (this.said === bad + stopped) return;
    this.said = bad + stopped;
    this.words.replaceChildren(...(bad ? [html('p', { class: 'notice', role: 'alert' }, bad)] : []), ...(stopped ? [html('p', { class: 'soft' }, stopped)] : []));
  }

  end() {
    this.over = true;
    clearTimeout(this.timer);
  }
}

/** Where the report of a job is, or of an operation of a wheel. */
export const reportOf = (id, operation, theme) => `${place(operation ? `jobs/${id}/ops/${operation}/report` : `jobs/${id}/report`)}#theme=${theme}`;
