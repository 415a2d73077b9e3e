// One kind of material for every surface: a browser without a graphics card needs a third of a second for each kind.
import { DataTexture, DoubleSide, MeshPhongMaterial, RGBAFormat, SRGBColorSpace } from 'three';

/** The texture of what has one colour. */
export const PLAIN = new DataTexture(new Uint8Array([255, 255, 255, 255]), 1, 1, RGBAFormat);
PLAIN.colorSpace = SRGBColorSpace;
PLAIN.needsUpdate = true;

export const surface = (options) => new MeshPhongMaterial({ map: PLAIN, specular: 0x000000, shininess: 40, side: DoubleSide, ...options });

/** The same behind its own edges, which would flicker through it otherwise. */
export const wall = (options) => surface({ polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, ...options });
