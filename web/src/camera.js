// Where to look from: the target must show, obliquely enough to look like a body.
import { Color, Matrix4, MeshBasicMaterial, PerspectiveCamera, Quaternion, Vector3, WebGLRenderTarget } from 'three';

const PROBE = 72;
export const FIELD_OF_VIEW = 26;

/** Mean outward normal of the targets, their middle and radius. */
export function frameOf(meshes) {
  const normal = new Vector3(), low = new Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
  const a = new Vector3(), b = new Vector3(), c = new Vector3();
  for (const { geometry } of meshes) {
    const p = geometry.attributes.position, index = geometry.index;
    for (let k = 0; k < index.count; k += 3) {
      a.fromBufferAttribute(p, index.getX(k));
      b.fromBufferAttribute(p, index.getX(k + 1)).sub(a);
      c.fromBufferAttribute(p, index.getX(k + 2)).sub(a);
      normal.add(b.cross(c));
    }
    for (let k = 0; k < p.count; ++k) {
      a.fromBufferAttribute(p, k);
      low.min(a);
      high.max(a);
    }
  }
  const centre = low.clone().add(high).multiplyScalar(0.5);
  return { normal: normal.lengthSq() > 0 ? normal.normalize() : new Vector3(0, 0, 1), centre,
    radius: Math.max(1e-6, 0.5 * low.distanceTo(high)) };
}

/** The direction `front` turned about `up` and then lifted, degrees. */
function turned(front, up, azimuth, elevation) {
  const side = new Vector3().crossVectors(up, front).normalize();
  const level = new Vector3().crossVectors(side, up).normalize();
  const direction = level.applyQuaternion(new Quaternion().setFromAxisAngle(up, (azimuth * Math.PI) / 180));
  const e = (elevation * Math.PI) / 180;
  return direction.multiplyScalar(Math.cos(e)).addScaledVector(up, Math.sin(e)).normalize();
}

/** How much of the target shows from each of some directions: it is drawn red, all else black, and counted. */
function visibility(renderer, scene, targets, camera) {
  const target = new WebGLRenderTarget(PROBE, PROBE);
  const pixels = new Uint8Array(4 * PROBE * PROBE);
  const saved = new Map();
  const red = new MeshBasicMaterial({ color: new Color(1, 0, 0), side: 2 }), black = new MeshBasicMaterial({ color: 0, side: 2 });
  scene.traverse((object) => {
    if (!object.isMesh) return;
    saved.set(object, object.material);
    object.material = object.material.transparent ? object.material : targets.includes(object) ? red : black;
  });
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(scene, camera);
  renderer.readRenderTargetPixels(target, 0, 0, PROBE, PROBE, pixels);
  renderer.setRenderTarget(null);
  saved.forEach((material, object) => { object.material = material; });
  target.dispose();
  let count = 0;
  for (let k = 0; k < pixels.length; k += 4) if (pixels[k] > 128) ++count;
  return count;
}

/** Camera places by name: { position, up }, all looking at frame.centre. */
export function presets(renderer, scene, targets, frame, toolAxis) {
  const up = toolAxis.clone().addScaledVector(frame.normal, -toolAxis.dot(frame.normal));
  if (up.lengthSq() < 1e-4) up.copy(new Vector3(0, 0, 1).cross(frame.normal));
  up.normalize();
  const distance = frame.radius / Math.sin((0.5 * FIELD_OF_VIEW * Math.PI) / 180);
  const camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.02 * distance, 20 * distance);
  const look = (direction, top) => {
    camera.position.copy(frame.centre).addScaledVector(direction, distance);
    camera.up.copy(top);
    camera.lookAt(frame.centre);
  };
  let best = null;
  for (const azimuth of [-35, 35, -55, 55, -15, 15])
    for (const elevation of [12, 35, -15]) {
      const direction = turned(frame.normal, up, azimuth, elevation);
      look(direction, up);
      const score = visibility(renderer, scene, targets, camera) * (Math.abs(azimuth) < 20 ? 0.85 : 1);
      if (!best || score > 1.02 * best.score) best = { score, direction };
    }
  const place = (direction, top) => ({ position: frame.centre.clone().addScaledVector(direction, 1.12 * distance), up: top.clone() });
  return { overview: place(best.direction, up), face: place(frame.normal, up),
    axis: place(toolAxis.clone().normalize(), frame.normal), distance };
}

/** Screen directions of x, y and z, for the little cross of axes. */
export function axesOnScreen(camera) {
  const turn = new Matrix4().extractRotation(camera.matrixWorldInverse);
  return [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map((v) => v.applyMatrix4(turn));
}
