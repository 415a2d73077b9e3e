// The signed error as colour: pale where it is small, red where too much is taken, blue where material is left. The
// tolerance is where the colour jumps.
import { ClampToEdgeWrapping, DataTexture, NearestFilter, RGBAFormat, SRGBColorSpace } from 'three';

/** Ends of the scale, in tolerances; what is left beyond the widest one counts as not reached. */
export const SPANS = [4, 1];
const WIDTH = 1024;
/** The texture goes on beyond the scale by this factor, for what lies beyond it. */
const MARGIN = 1.1;

/** From 0 to the tolerance, and from there to the end of the scale. */
const RAMPS = {
  over: { within: ['#f7f6f1', '#f6c9b3'], beyond: ['#e2735a', '#b2182b', '#5f001c'] },
  under: { within: ['#f7f6f1', '#b9d6e8'], beyond: ['#6aa7d0', '#2f74ad', '#0f3f6e'] },
};
export const UNREACHED = '#7b8088';

export const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

function along(ramp, share) {
  const at = Math.max(0, Math.min(1, share)) * (ramp.length - 1);
  const k = Math.min(ramp.length - 2, Math.floor(at));
  const a = channels(ramp[k]), b = channels(ramp[k + 1]);
  return a.map((v, i) => Math.round(v + (at - k) * (b[i] - v)));
}

/** The colour at x tolerances on a scale that ends at `span` tolerances, [r, g, b] of 0 to 255. */
export function colourAt(x, span) {
  const { within, beyond } = x < 0 ? RAMPS.over : RAMPS.under;
  const size = Math.abs(x);
  // A scale that ends at the tolerance or before it has all its colours inside.
  if (span <= 1) return x > 1 && x > span * MARGIN ? along(beyond, 1) : along([within[0], ...beyond], size / span);
  if (x > span) return channels(UNREACHED);
  return size <= 1 ? along(within, size) : along(beyond, (size - 1) / (span - 1));
}

export const css = (rgb) => `rgb(${rgb.join(' ')})`;

/** Colours over x tolerances as texture coordinate; `rest` (a colour): everything but overcut looks like that. */
export class ErrorTexture {
  constructor() {
    this.data = new Uint8Array(4 * WIDTH).fill(255);
    this.texture = new DataTexture(this.data, WIDTH, 1, RGBAFormat);
    Object.assign(this.texture, { colorSpace: SRGBColorSpace, magFilter: NearestFilter, minFilter: NearestFilter,
      wrapS: ClampToEdgeWrapping, generateMipmaps: false });
    this.texture.offset.set(0.5, 0);
  }

  paint(span, rest) {
    this.texture.repeat.set(1 / (2 * MARGIN * span), 1);
    for (let i = 0; i < WIDTH; ++i) {
      const x = (((i + 0.5) / WIDTH) * 2 - 1) * MARGIN * span;
      this.data.set(rest && x > -Math.min(1, span) ? channels(rest) : colourAt(x, span), 4 * i);
    }
    this.texture.needsUpdate = true;
  }
}
