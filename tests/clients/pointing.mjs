// Pointing at faces as a user does, by what flank inspect says of them alone.

/** Looks at a face from in front of it; then where its centre is in the window, or null if it has no front. */
export const inFrontOf = (page, chooser, row) => page.value(`(() => {
  const { stage } = ${chooser}, row = ${JSON.stringify({ centre: row.centre, normal: row.normal })};
  if (!row.normal) return null;
  const centre = stage.home.centre.clone().set(...row.centre), n = centre.clone().set(...row.normal);
  stage.camera.up.set(Math.abs(n.z) > 0.9 ? 1 : 0, 0, Math.abs(n.z) > 0.9 ? 0 : 1);
  // So near that nothing stands between.
  stage.camera.position.copy(centre).addScaledVector(n, 0.2 * stage.home.radius);
  stage.camera.near = 0.01 * stage.home.radius;
  stage.camera.updateProjectionMatrix();
  stage.hold(centre);
  stage.camera.updateMatrixWorld();
  stage.draw();
  const box = stage.canvas.getBoundingClientRect(), [x, y] = stage.toScreen(centre);
  return [box.x + x, box.y + y];
})()`);

/** The id under the pointer at a place of the window, as the page says it; '' if none. */
export async function hovered(page, [x, y]) {
  await page.move(x + 40, y + 40);
  await page.frames();
  await page.move(x, y);
  await page.frames();
  await page.frames();
  return (await page.value('document.querySelector(".probe").textContent')).split('  ·  ')[0];
}
