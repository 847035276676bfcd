// Start of the page and its interface window.acausal.

const errors = [];
addEventListener("error", (event) => errors.push(String(event.message)));
addEventListener("unhandledrejection", (event) => errors.push(String(event.reason)));

/** Bounding box, size and upward direction of all runs. */
function sceneOf(runs) {
  const corners = (name, pick) => [0, 1, 2].map((j) => runs.reduce((best, run) => pick(best, run.extent[name][j]), runs[0].extent[name][j]));
  return { low: corners("low", Math.min), high: corners("high", Math.max), size: runs[0].size, up: runs[0].up };
}

async function start() {
  const content = JSON.parse($("document").textContent);
  $("picture").hidden = !content.runs.some((run) => run.shapes.length);
  const stage = new Stage($("picture"), sceneOf(content.runs));
  const runs = [];
  for (const [number, run] of content.runs.entries()) runs.push(await Run.of(stage, run, number, content.looks));
  stage.runs = runs;
  stage.grounded = runs.some((run) => run.grounded);
  stage.show.grid = stage.grounded;
  if (!stage.renderer) $("without").hidden = false;
  stage.renderer?.domElement.addEventListener("webglcontextlost", () => ($("without").hidden = false));
  stage.renderer?.domElement.addEventListener("webglcontextrestored", () => ($("without").hidden = true));
  const viewer = new Viewer(content, stage, runs);
  if (content.explorer) viewer.explorer = await Explorer.of(viewer, content.explorer);
  viewer.choose("");
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) viewer.clock.play();
  applyAddress(viewer, content.start || "");
  applyAddress(viewer, location.hash);
  addEventListener("hashchange", () => applyAddress(viewer, location.hash));
  Object.assign(window.acausal, {
    document: content,
    seek(t) {
      viewer.clock.pause();
      viewer.clock.seek(t);
      viewer.update();
    },
    time: () => viewer.clock.t,
    play: () => viewer.clock.play(),
    positions: (shape, run = 0) => runs[run].items[shape].positions(),
    poses(shape, run = 0) {
      const matrix = runs[run].items[shape].object.matrixWorld.toArray();
      stage.origin.forEach((v, j) => (matrix[12 + j] += v));
      return matrix;
    },
    renders: () => stage.renders,
    viewer,
  });
  viewer.draw();
}

window.acausal = { errors };
window.acausal.ready = start().catch((error) => {
  errors.push(String(error));
  $("without").textContent = `This animation cannot be shown: ${error.message}`;
  $("without").hidden = false;
  throw error;
});
