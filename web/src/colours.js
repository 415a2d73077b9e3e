// The signed error as colour: pale within the tolerance, red where too much is taken, blue where material is left.
import { DataTexture, NearestFilter, RGBAFormat, SRGBColorSpace } from 'three';

/** The scale ends at this many tolerances; what is left beyond it counts as not reached. */
export const SPAN = 4;
const WIDTH = 1024;

const STOPS = [
  [-4, '#67001f'], [-2.2, '#b2182b'], [-1.02, '#ee8a6a'],
  [-1, '#fbe0d2'], [0, '#f7f6f1'], [1, '#d6e5ee'],
  [1.02, '#86b8d9'], [2.2, '#3d80b5'], [4, '#124a80'],
];
export const UNREACHED = '#7b8088';

const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

/** The colour at x tolerances, [r, g, b] of 0 to 255. */
export function colourAt(x) {
  if (x > SPAN) return channels(UNREACHED);
  if (x <= -SPAN) return channels(STOPS[0][1]);
  const k = STOPS.findIndex(([at]) => at >= x);
  const [x0, low] = STOPS[Math.max(0, k - 1)], [x1, high] = STOPS[k];
  const share = x1 > x0 ? (x - x0) / (x1 - x0) : 0;
  const a = channels(low), b = channels(high);
  return a.map((v, i) => Math.round(v + share * (b[i] - v)));
}

export const css = (rgb) => `rgb(${rgb.join(' ')})`;

/** x tolerances to the place in the texture; its outer margins are what lies beyond the scale. */
export const texturePlace = (x) => (Math.max(-1.1, Math.min(1.1, x / SPAN)) / 1.1 + 1) / 2;

/** Colours of the error over a texture; `rest` (a colour): everything but overcut looks like that. */
export function errorTexture(rest) {
  const data = new Uint8Array(4 * WIDTH);
  for (let i = 0; i < WIDTH; ++i) {
    const x = ((i + 0.5) / WIDTH * 2 - 1) * 1.1 * SPAN;
    data.set(rest && x > -1 ? channels(rest) : colourAt(x), 4 * i);
    data[4 * i + 3] = 255;
  }
  const texture = new DataTexture(data, WIDTH, 1, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = NearestFilter;
  texture.minFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}
