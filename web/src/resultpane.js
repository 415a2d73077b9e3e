// The right pane: the jobs of the folder, the chosen one as it runs, then its report, and its way to the machine.
import { byId, html } from './dom.js';
import { seconds } from './format.js';
import { Live, reportOf, verdictOf } from './live.js';
import { Machining } from './machining.js';
import { isDark } from './theme.js';

const facesOf = ({ fields }) => fields.faces ?? [fields.left, fields.right].filter(Boolean).join(' | ');
const titleOf = (job) => (job.command === 'wheel' ? `wheel ${job.part}` : `${facesOf(job)} of ${job.part}`);
/** Whether there is something to report. */
const hasReport = (job) => job.state === 'done' && job.files.includes('view.json');

export class ResultPane {
  constructor() {
    Object.assign(this, { chosen: null, operation: '', live: null, jobs: [], shown: new Map() });
    byId('wide').addEventListener('click', () => {
      const on = document.body.classList.toggle('wide');
      byId('wide').setAttribute('aria-pressed', String(on));
      byId('wide').textContent = on ? 'Back' : 'Enlarge';
    });
    byId('compare').addEventListener('change', () => this.reports());
  }

  /** All jobs, as the server tells them. */
  list(jobs) {
    const key = JSON.stringify(jobs.map(({ id, state, exit, stopping, summary }) => [id, state, exit, stopping, summary?.pass, id === this.chosen]));
    this.jobs = jobs;
    byId('empty').hidden = jobs.length > 0;
    if (key === this.key) return;
    this.key = key;
    byId('jobs').replaceChildren(...jobs.map((job) => {
      const [state, words] = verdictOf(job);
      const button = html('button', { type: 'button', class: 'jobrow', 'data-job': job.id, 'aria-pressed': String(job.id === this.chosen), title: job.line }, html('span', { class: `mark ${state}` }, words), html('strong', {}, `${Number(job.id)}`), html('span', { class: 'jobtitle' }, titleOf(job)), html('span', { class: 'soft' }, job.state === 'done' && job.seconds > 0 ? seconds(job.seconds) : ''));
      button.addEventListener('click', () => this.choose(job.id));
      return button;
    }));
    const others = jobs.filter((job) => hasReport(job) && job.id !== this.chosen);
    const before = byId('compare').value;
    byId('compare').replaceChildren(html('option', { value: '' }, 'Compare with…'), ...others.map((job) => html('option', { value: job.id }, `Job ${Number(job.id)}, ${titleOf(job)}`)));
    byId('compare').value = others.some((job) => job.id === before) ? before : '';
    byId('compare').hidden = !others.length;
    if (!this.chosen && jobs.length) this.choose(jobs[0].id);
  }

  choose(id) {
    if (this.chosen === id) return;
    this.live?.end();
    this.chosen = id;
    this.made = null;
    byId('machining').replaceChildren();
    this.machining = null;
    this.operation = '';
    this.live = new Live(id, (job) => this.looked(job), (operation) => this.show(operation));
    byId('live').replaceChildren(this.live.root, this.live.status);
    byId('reports').replaceChildren();
    this.list(this.jobs);
  }

  looked(job) {
    const key = `${job.id} ${job.state} ${job.seconds > 0 && job.state === 'done' ? job.seconds : ''}`;
    if (key === this.made) return;
    this.made = key;
    this.job = job;
    // Once the whole of a wheel is there, it is what is wanted.
    if (hasReport(job)) this.operation = this.live.showWhole();
    this.reports();
    byId('wide').hidden = !hasReport(job);
    if (hasReport(job) && !this.machining) {
      this.machining = new Machining(job.id, job, () => this.posted());
      byId('machining').replaceChildren(this.machining.root);
    } else if (!hasReport(job)) {
      this.machining = null;
      byId('machining').replaceChildren();
    }
  }

  /** A program was written: the report has its motion, and there is one more file. */
  posted() {
    this.reports();
    this.live.over = false;
    this.live.told = (job) => { this.machining?.list(job); this.live.told = (other) => this.looked(other); };
    this.live.again(0);
  }

  /** Shows the report of an operation of a wheel, or of the whole if it is empty. */
  show(operation) {
    this.operation = operation;
    this.reports();
  }

  reports() {
    const other = byId('compare').value;
    const frame = (id) => html('iframe', { class: 'report', title: `Report of job ${Number(id)}`, src: reportOf(id, id === this.job.id ? this.operation : '', isDark() ? 'dark' : 'light') });
    const ids = this.job && (this.operation || hasReport(this.job)) ? [this.job.id, ...(other && other !== this.job.id ? [other] : [])] : [];
    byId('reports').replaceChildren(...ids.map(frame));
    byId('reports').classList.toggle('two', ids.length === 2);
  }

  paint() {
    for (const frame of byId('reports').children) frame.contentDocument?.documentElement.setAttribute('data-theme', isDark() ? 'dark' : 'light');
    if (this.job) this.reports();
  }
}
