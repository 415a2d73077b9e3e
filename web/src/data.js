// Reads the files that flank report packed into the page (docs/schema/view.md, verify.md).

/** The file's JSON, or null where the folder had none. */
export function packed(name) {
  const element = document.querySelector(`script[data-file="${name}"]`);
  return element ? JSON.parse(element.textContent) : null;
}

function bytes(base64) {
  const text = atob(base64);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out;
}

export function floats(base64) {
  const view = new DataView(bytes(base64).buffer);
  const out = new Float32Array(view.byteLength / 4);
  for (let i = 0; i < out.length; ++i) out[i] = view.getFloat32(4 * i, true);
  return out;
}

/** 16-bit steps of a box to millimetres. */
export function points(base64, [low, high]) {
  const raw = bytes(base64);
  const out = new Float32Array(raw.length / 2);
  for (let i = 0; i < out.length; ++i) {
    const k = i % 3;
    out[i] = low[k] + ((raw[2 * i] | (raw[2 * i + 1] << 8)) / 65535) * (high[k] - low[k]);
  }
  return out;
}

/** Zigzag differences of 7 bits a byte to indices. */
export function indices(base64, count) {
  const raw = bytes(base64);
  const out = new Uint32Array(count);
  let before = 0;
  for (let i = 0, at = 0; i < count; ++i) {
    let value = 0;
    for (let shift = 0, more = true; more; shift += 7) {
      more = raw[at] > 127;
      value += (raw[at++] & 127) * 2 ** shift;
    }
    before += value % 2 ? -(value + 1) / 2 : value / 2;
    out[i] = before;
  }
  return out;
}

export function readBody(body) {
  return {
    face: body.face,
    target: body.target,
    positions: points(body.positions, body.box),
    indices: indices(body.indices, 3 * body.triangles),
    f: body.f_mm ? floats(body.f_mm) : null,
    bent: body.bent_mm ? floats(body.bent_mm) : null,
    gap: body.gap_mm ? floats(body.gap_mm) : null,
    borders: points(body.borders, body.box),
    borderCounts: body.border_counts,
  };
}
