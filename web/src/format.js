// Numbers as people read them.

const minus = (text) => text.replace(/^-/, '\u2212');

function digits(value, significant) {
  if (value === 0) return '0';
  const places = Math.max(0, Math.min(6, significant - 1 - Math.floor(Math.log10(Math.abs(value)))));
  return minus(value.toFixed(places));
}

/** An error: micrometres below 1 mm. Null stands for "not machined at all". */
export function error(mm, significant = 3) {
  if (mm === null || mm === undefined) return 'none';
  if (Math.abs(mm) >= 1) return `${digits(mm, significant)}\u00a0mm`;
  if (Math.abs(mm) < 5e-7) return '0\u00a0µm';
  return `${digits(1000 * mm, significant)}\u00a0µm`;
}

/** A length that somebody chose: without zeros that say nothing. */
export const tolerance = (mm) => (mm < 1 ? `${tick(1000 * mm)}\u00a0µm` : `${tick(mm)}\u00a0mm`);

export const length = (mm, significant = 4) => `${digits(mm, significant)}\u00a0mm`;
export const plain = (value, significant = 3) => digits(value, significant);
/** A time as one says it. */
export const seconds = (s) => (s < 90 ? `${s.toFixed(s < 10 ? 1 : 0)} s` : s < 5400 ? `${(s / 60).toFixed(1)} min` : `${(s / 3600).toFixed(1)} h`);
export const percent = (share) => `${minus((100 * share).toFixed(2))}\u00a0%`;

/** About `count` round numbers that span [low, high]. */
export function ticks(low, high, count) {
  const raw = (high - low) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= raw * 0.999);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k) out.push(k * step);
  return out.map((t) => Number(t.toPrecision(10)));
}

/** A tick of a chart without useless zeros. */
export const tick = (value) => minus(String(Number(value.toPrecision(6))));
