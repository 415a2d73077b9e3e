// The places to look at: collisions first, then where the target or another face is cut deepest.
import { html } from './dom.js';
import * as format from './format.js';

/** The judge's figures of clearance, and of whether anything could hold the tool at all. */
const heldApart = (verify) => {
  const { axis, as_thick: assumed } = verify?.hold ?? {};
  return [...(verify?.clearance ?? []), ...(axis ? [axis] : []), ...(assumed ? [{ ...assumed, assumed: true }] : [])];
};

/** What shank, holder, flank or axis come too near to, the deepest first: { label, name, what, point, strip, t }. */
export function collisions(verify) {
  return heldApart(verify).filter((f) => !f.kept).sort((a, b) => a.clearance_mm - a.required_mm - b.clearance_mm + b.required_mm).map((f) => ({
    label: '!', deep: !f.assumed, body: f.assumed ? 'assumed' : f.body, required: f.required_mm, name: `${f.assumed ? 'a shank as thick as the flank' : f.body}, ${f.obstacle}`, point: f.point, strip: f.strip, t: f.t, against: f.against, obstacle: f.obstacle,
    what: f.clearance_mm < 0 ? `collides by ${format.length(-f.clearance_mm)}` : `${format.length(f.clearance_mm)} away, ${format.length(f.required_mm, 3)} required` }));
}

/** The judge's worst places in the same form. */
function cuts(verify, tolerance) {
  return (verify?.worst_places ?? []).map((place, k) => ({ label: String(k + 1), deep: place.f_mm < -tolerance, name: place.face, f: place.f_mm,
    what: place.f_mm === null ? '' : format.error(place.f_mm), point: place.point, strip: place.strip, t: place.t })).filter((place) => place.f !== null);
}

export const places = (verify, tolerance) => [...collisions(verify), ...cuts(verify, tolerance)];

/** All of them as a list; `go` is called with the place that was chosen. */
export function worstList(list, tolerance, go) {
  if (!list.length) return html('p', { class: 'soft' }, 'No face is gouged anywhere.');
  const item = (place) => {
    const [x, y, z] = place.point.map((v) => format.plain(v, 4));
    const button = html('button', { type: 'button', class: 'place' },
      html('b', { class: place.deep ? 'pin deep' : 'pin' }, place.label),
      html('span', {}, html('strong', {}, `${place.name}, ${place.what}`),
        html('small', {}, `at (${x}, ${y}, ${z})${place.strip ? `, pass ${place.strip}` : ''}`)));
    button.addEventListener('click', () => go(place));
    return html('li', {}, button);
  };
  return html('div', {}, html('p', { class: 'soft' }, `Deepest first; minus is a gouge. The tolerance is ±${format.tolerance(tolerance)}.`),
    html('ol', { class: 'places' }, ...list.map(item)));
}
