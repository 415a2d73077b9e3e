// Where to look from: the target must show, obliquely enough to look like a body.
import { Matrix4, Quaternion, Vector3 } from 'three';
import { surfacePoints, Visibility } from './visible.js';

export const FIELD_OF_VIEW = 26;

/** Every so many vertices are looked at when the camera is moved back far enough. */
const THINNING = 400;

/** From the nearest of some points to a place. */
function offset(place, points) {
  const nearest = points.reduce((best, p) => (p.distanceToSquared(place) < best.distanceToSquared(place) ? p : best));
  return place.clone().sub(nearest);
}

/** Mean normal of the targets on the side of the places `towards`, their middle and radius, and some of their points. */
export function frameOf(meshes, towards) {
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
  const points = [];
  for (const { geometry } of meshes) {
    const p = geometry.attributes.position;
    const stride = Math.max(1, Math.floor(p.count / THINNING));
    for (let k = 0; k < p.count; k += stride) points.push(new Vector3().fromBufferAttribute(p, k));
  }
  const centre = low.clone().add(high).multiplyScalar(0.5);
  if (normal.lengthSq() > 0) normal.normalize();
  else normal.set(0, 0, 1);
  // A sheet may be machined from its back: the axis lies on the side that counts.
  const side = towards.reduce((sum, place) => sum + offset(place, points).dot(normal), 0);
  if (side < 0) normal.negate();
  return { normal, centre, points, radius: Math.max(1e-6, 0.5 * low.distanceTo(high)) };
}

/** The direction `front` turned about `up` and then lifted, degrees. */
function turned(front, up, azimuth, elevation) {
  const side = new Vector3().crossVectors(up, front).normalize();
  const level = new Vector3().crossVectors(side, up).normalize();
  const direction = level.applyQuaternion(new Quaternion().setFromAxisAngle(up, (azimuth * Math.PI) / 180));
  const e = (elevation * Math.PI) / 180;
  return direction.multiplyScalar(Math.cos(e)).addScaledVector(up, Math.sin(e)).normalize();
}

/** Directions to try, degrees off the target's normal: oblique ones first, for a body looks flat from its front. */
const AZIMUTHS = [-35, 35, -55, 55, -15, 15, -75, 75];
const ELEVATIONS = [12, 35, -15, 55];
/** Where less of the target shows than this share of what would show alone, the other faces are in the way. */
const HIDDEN = 0.72;
const TOOL_WEIGHT = 0.4;

/** The view that shows most: { direction, share of the path, hidden }. */
function search({ normal, centre, radius }, up, { targets, others, shares, put, toolPoints }) {
  const h = radius / 30;
  const seen = new Visibility(surfacePoints(targets, h, centre, 4 * radius), centre, radius);
  const clouds = [surfacePoints(others, h, centre, 4 * radius)];
  let best = { score: -1 };
  for (const share of shares) {
    const axis = put(share);
    clouds[1] = toolPoints();
    for (const azimuth of AZIMUTHS)
      for (const elevation of ELEVATIONS) {
        const direction = turned(normal, up, azimuth, elevation);
        const { target, tool } = seen.count(direction, up, clouds);
        // The tool counts a little. A body looks flat from its front.
        const score = (target + TOOL_WEIGHT * tool) * (Math.abs(azimuth) < 20 ? 0.85 : 1);
        if (score > 1.02 * best.score) best = { score, target, direction, share, axis, tool: clouds[1] };
      }
  }
  best.hidden = best.target < HIDDEN * seen.count(best.direction, up, [new Float32Array(0), best.tool]).target;
  return best;
}

/**
 * Camera places by name, { direction, up, points that must be seen }, and the share of the path at which the tool hides
 * least. `wish` is { targets, others, axis, shares, put, whole, toolPoints }; put(share) places the tool and returns what must
 * be seen of it, whole(share) what shows all that there is, toolPoints() is its surface where it stands.
 */
export function presets(frame, wish) {
  const { normal } = frame;
  const up = wish.axis.clone().addScaledVector(normal, -wish.axis.dot(normal));
  if (up.lengthSq() < 1e-4) up.copy(new Vector3(0, 0, 1).cross(normal));
  up.normalize();
  const best = search(frame, up, wish);
  const points = [...frame.points, ...best.axis], all = [...points, ...wish.whole(best.share)];
  return { overview: { direction: best.direction, up, points }, face: { direction: normal, up, points },
    axis: { direction: wish.axis.clone().normalize(), up: normal, points: frame.points },
    all: { direction: best.direction, up, points: all },
    share: best.share, hidden: best.hidden };
}

/**
 * Where the camera sees all points, { position, target }. `room` says which part of the picture's half width and half
 * height is free on each side.
 */
export function fitted({ direction, up, points }, aspect, room) {
  const side = new Vector3().crossVectors(up, direction).normalize();
  const top = new Vector3().crossVectors(direction, side).normalize();
  const tall = Math.tan((0.5 * FIELD_OF_VIEW * Math.PI) / 180), wide = tall * aspect;
  // The planes of the view's pyramid, pushed out until they hold every point: opposite ones fix the distance.
  const fit = (axis, plus, minus) => {
    const high = Math.max(...points.map((p) => p.dot(axis) + plus * p.dot(direction)));
    const low = Math.max(...points.map((p) => minus * p.dot(direction) - p.dot(axis)));
    return { away: (high + low) / (plus + minus), at: (away) => (high - plus * away - low + minus * away) / 2 };
  };
  const across = fit(side, wide * room.right, wide * room.left), along = fit(top, tall * room.top, tall * room.bottom);
  const away = Math.max(across.away, along.away);
  const foot = side.clone().multiplyScalar(across.at(away)).addScaledVector(top, along.at(away));
  const middle = points.reduce((sum, p) => sum + p.dot(direction), 0) / points.length;
  return { position: foot.clone().addScaledVector(direction, away), target: foot.clone().addScaledVector(direction, middle) };
}

/** Screen directions of x, y and z, for the little cross of axes. */
export function axesOnScreen(camera) {
  const turn = new Matrix4().extractRotation(camera.matrixWorldInverse);
  return [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map((v) => v.applyMatrix4(turn));
}
