// Names of faces as people choose them: "F9" sorts after "F2", runs are written short.

const NAME = /^F(\d+)([a-z]*)$/;

/** For sorting: the number, then the piece. */
export function byName(a, b) {
  const [, x, p] = NAME.exec(a) ?? [0, Infinity, a], [, y, q] = NAME.exec(b) ?? [0, Infinity, b];
  return Number(x) - Number(y) || (p < q ? -1 : p > q ? 1 : 0);
}

/** "F1,F3-F5,F7a" of ids in any order; two that follow each other stay a pair. */
export function faceList(ids) {
  const out = [];
  for (const id of [...ids].sort(byName)) {
    const [, number, piece] = NAME.exec(id) ?? [0, NaN, 'x'];
    const run = out.at(-1);
    if (!piece && run && Number(number) === run.last + 1) Object.assign(run, { last: Number(number), end: id, count: run.count + 1 });
    else out.push({ begin: id, end: id, last: piece ? NaN : Number(number), count: 1 });
  }
  return out.map(({ begin, end, count }) => (count === 1 ? begin : count === 2 ? `${begin},${end}` : `${begin}-${end}`)).join(',');
}

/** The names in "F1,F3-F5,F7a". */
export const facesIn = (text) => text.split(',').flatMap((part) => {
  const [begin, end] = part.trim().split('-').map((name) => Number(NAME.exec(name)?.[1]));
  return end ? Array.from({ length: end - begin + 1 }, (_, k) => `F${begin + k}`) : [part.trim()];
});
