// What the files say of themselves. The verdict is the judge's (verify.json, summary.json); this page adds nothing to it, and shows
// every reason and every caution, whatever it is about.

/** What a figure is called where no row of the table is about it, if not by its name in the files. */
const NAMES = {
  complete: 'Completeness', legitimate: 'Tool profile', verdict: 'Check', overcut_mm: 'Gouge',
  gouge_mm: 'Gouge of other faces', buried: 'Passes inside the material', overcut_bound_mm: 'Gouge, proved',
  gouge_bound_mm: 'Gouge of other faces, proved', coverage_reachable: 'Finished, accessible area',
  coverage_bound: 'Finished, proved', stock: 'Stock simulation', travel: 'Travel of the axes',
  axis_speed: 'Speed of the axes', machine_bodies: 'Table and head', unread_faces: 'Faces that were not read',
  coverage: 'Finished, whole face', hold: 'Room for shank and holder', turn: 'Kinks of the motion', sheet_side: 'Machined side',
  rounding_mm: 'Rounding of the program', rapid: 'Rapid moves',
};
export const capital = (words) => words.charAt(0).toUpperCase() + words.slice(1);
export const nameOf = (figure) => NAMES[figure] ?? capital(String(figure).replaceAll('_', ' '));

const list = (file, key) => (Array.isArray(file?.[key]) ? file[key] : []);
const same = (a) => (b) => a.figure === b.figure && a.text === b.text;

/** Why the result does not meet its request: [{ figure, text }]. */
export const reasons = ({ verify }) => list(verify, 'reasons');

/** What is amber beside a verdict that passes. */
export function cautions({ verify, summary }) {
  const said = list(verify, 'cautions');
  return [...said, ...list(summary, 'cautions').filter((one) => !said.some(same(one)))];
}

/** What was wrong when the result was made and is not for the later verdict: both cannot be green. */
export function earlier({ verify, summary }) {
  if (verify?.pass !== true || summary?.pass !== false) return [];
  const said = list(summary, 'reasons');
  return said.length ? said : [{ figure: 'verdict', text: 'summary.json says that the result does not meet the request' }];
}

/** { state, text } of the pill. */
export function verdict(files) {
  const { verify, summary, tied } = files;
  if (typeof verify?.pass !== 'boolean') return { state: 'warn', text: 'Not checked' };
  if (summary?.complete === false) return { state: 'fail', text: 'Interrupted: incomplete' };
  if (!verify.pass || reasons(files).length) return { state: 'fail', text: 'Does NOT meet the request' };
  if (!tied) return { state: 'warn', text: 'The files may not belong together' };
  if (summary && summary.complete !== true) return { state: 'warn', text: 'May be incomplete' };
  if (earlier(files).length) return { state: 'warn', text: 'Earlier run: does NOT meet the request' };
  return { state: 'pass', text: 'Meets the request' };
}

/** The same of the program that was written last (motion.json); null where there is none, or an older file says nothing. */
export function programVerdict({ motion }) {
  if (typeof motion?.pass !== 'boolean') return null;
  return { pass: motion.pass && !list(motion, 'reasons').length, reasons: list(motion, 'reasons'), cautions: list(motion, 'cautions') };
}
