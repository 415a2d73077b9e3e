// The poses of the path, and where on it a position of the slider is.
import { Vector3 } from 'three';
import { floats } from './data.js';

class Strip {
  constructor(strip, axisLength) {
    this.id = strip.id;
    this.face = strip.face;
    this.poseCount = strip.pose_count;
    this.index = strip.index;
    this.places = strip.places;
    const raw = floats(strip.poses);
    this.tips = [];
    this.axes = [];
    for (let k = 0; k < raw.length; k += 6) {
      this.tips.push(new Vector3(raw[k], raw[k + 1], raw[k + 2]));
      this.axes.push(new Vector3(raw[k + 3], raw[k + 4], raw[k + 5]));
    }
    this.travel = [0];
    const middle = (k) => this.tips[k].clone().addScaledVector(this.axes[k], 0.5 * axisLength);
    for (let k = 1; k < this.tips.length; ++k) this.travel.push(this.travel[k - 1] + middle(k).distanceTo(middle(k - 1)));
  }

  get length() {
    return this.travel[this.travel.length - 1];
  }

  /** Between which poses shown the travel d lies: the first one and the share of the step. */
  at(d) {
    let low = 0, high = this.travel.length - 1;
    if (high === 0) return [0, 0];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.travel[middle] <= d) low = middle;
      else high = middle;
    }
    const step = this.travel[high] - this.travel[low];
    return [low, step > 0 ? Math.max(0, Math.min(1, (d - this.travel[low]) / step)) : 0];
  }

  /** The pose at travel d, joined as a controller joins poses: tip and axis each on a straight line. */
  pose(d) {
    const [k, share] = this.at(d);
    const next = Math.min(k + 1, this.tips.length - 1);
    return {
      tip: this.tips[k].clone().lerp(this.tips[next], share),
      axis: this.axes[k].clone().lerp(this.axes[next], share).normalize(),
      t: this.index[k] + share * (this.index[next] - this.index[k]),
    };
  }

  /** Travel of the place t (pose index of the path, and fraction). */
  travelOf(t) {
    let k = 0;
    while (k + 2 < this.index.length && this.index[k + 1] <= t) ++k;
    const next = Math.min(k + 1, this.index.length - 1);
    const step = this.index[next] - this.index[k];
    const share = step > 0 ? Math.max(0, Math.min(1, (t - this.index[k]) / step)) : 0;
    return this.travel[k] + share * (this.travel[next] - this.travel[k]);
  }
}

/** Strips one after the other; what lies between them takes no time. */
export class PathModel {
  constructor(view) {
    this.strips = view.strips.map((strip) => new Strip(strip, view.tool.axis_length_mm)).filter((s) => s.tips.length);
    this.chosen = null;
  }

  shown() {
    return this.chosen === null ? this.strips : [this.strips[this.chosen]];
  }

  total() {
    return this.shown().reduce((sum, strip) => sum + strip.length, 0);
  }

  /** The strip, its travel and its pose at a share of what is shown. */
  locate(share) {
    let left = share * this.total();
    const strips = this.shown();
    for (const strip of strips) {
      if (left <= strip.length || strip === strips[strips.length - 1])
        return { strip, travel: Math.min(left, strip.length), ...strip.pose(Math.min(left, strip.length)) };
      left -= strip.length;
    }
    return null;
  }

  /** The share of what is shown at place t of a strip. */
  shareOf(strip, t) {
    let before = 0;
    for (const other of this.shown()) {
      if (other === strip) return this.total() > 0 ? (before + strip.travelOf(t)) / this.total() : 0;
      before += other.length;
    }
    return 0;
  }
}
