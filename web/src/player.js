// The time slider: where the tool is.
import { byId, html } from './dom.js';
import * as format from './format.js';

/** A whole path takes this long, seconds; a short one less. */
const LONGEST = 12;
const SPEED_MM = 8;

export class Player {
  constructor(path, moved, chosen) {
    Object.assign(this, { path, moved, playing: false });
    this.slider = byId('time');
    this.slider.addEventListener('input', () => this.set(this.slider.value / 1000, true));
    byId('play').addEventListener('click', () => this.toggle());
    const select = byId('strip');
    if (path.strips.length > 1) {
      select.append(html('option', { value: 'all' }, 'all'), ...path.strips.map((s, k) => html('option', { value: k }, String(s.id))));
      select.addEventListener('change', () => {
        path.chosen = select.value === 'all' ? null : Number(select.value);
        chosen();
        this.set(0);
      });
    } else byId('strip-label').hidden = true;
  }

  /** share: 0 to 1 of what is shown. */
  set(share, byHand) {
    if (byHand) this.stop();
    this.share = Math.max(0, Math.min(1, share));
    this.slider.value = Math.round(1000 * this.share);
    const place = this.path.locate(this.share);
    if (!place) return;
    const words = `pass ${place.strip.id}, CL point ${(place.t + 1).toFixed(1)} of ${place.strip.poseCount}, ${format.length(place.travel, 3)} of ${format.length(place.strip.length, 3)}`;
    byId('where').textContent = words;
    this.slider.setAttribute('aria-valuetext', words);
    this.moved(place, this.share);
  }

  toggle() {
    this.playing ? this.stop() : this.start();
  }

  stop() {
    this.playing = false;
    this.label();
  }

  start() {
    this.playing = true;
    this.label();
    const seconds = Math.min(LONGEST, Math.max(3, this.path.total() / SPEED_MM));
    if (this.share >= 1) this.set(0);
    let before = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      this.set(this.share + Math.max(0, now - before) / (1000 * seconds));
      before = now;
      if (this.share >= 1) return this.stop();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  label() {
    const button = byId('play');
    button.setAttribute('aria-label', this.playing ? 'Pause' : 'Play');
    button.querySelector('path').setAttribute('d', this.playing ? 'M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z' : 'M4 2.5v11l9-5.5z');
  }
}
