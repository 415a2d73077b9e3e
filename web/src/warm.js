// A browser without a graphics card takes seconds to begin: it makes its contexts and shaders ready while nobody waits for them.
import { FaceModel } from './facemodel.js';
import { html } from './dom.js';
import { Stage } from './scene.js';

/** Corners and triangles of a tetrahedron, and of its last side alone: closed and open skins have shaders of their own. */
const CORNERS = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], CLOSED = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3], OPEN = CLOSED.slice(9);

function draw(stage, indices) {
  const body = { face: 'F1', positions: new Float32Array(CORNERS), indices: new Uint32Array(indices), borders: new Float32Array(CORNERS), borderCounts: [4] };
  const model = new FaceModel([body]);
  stage.scene.add(model.root);
  stage.render();
  stage.scene.remove(model.root);
  for (const { geometry, material } of [model.mesh, model.edges]) geometry.dispose(), material.dispose();
  model.texture.dispose();
}

/** Draws a small part where nobody sees it. */
export function warm() {
  const canvas = html('canvas', { class: 'sr', 'aria-hidden': 'true' });
  document.body.append(html('div', { class: 'sr', 'aria-hidden': 'true' }, canvas));
  try {
    const stage = new Stage(canvas, undefined, true);
    stage.renderer.localClippingEnabled = true;
    for (const indices of [CLOSED, OPEN]) draw(stage, indices);
    stage.dispose();
  } catch {
    // The part says what is missing when it is shown.
  }
  canvas.parentElement.remove();
}
