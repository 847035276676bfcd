// Settings in the fragment of the address: file.html#t=1.2&x=10&view=front

/** Apply the settings of a fragment; unknown ones are ignored. */
function applyAddress(viewer, hash) {
  const said = new URLSearchParams(hash.replace(/^#/, ""));
  const number = (name) => (said.has(name) && said.get(name) !== "" ? Number(said.get(name)) : NaN);
  const flag = (name) => said.has(name) && !["0", "false", "no"].includes(said.get(name));
  const { clock } = viewer;
  if (number("x") > 0) viewer.deform(number("x"));
  if (number("speed") > 0) clock.setSpeed(number("speed"));
  if (said.has("ghost")) viewer.ghosts(flag("ghost"));
  if (said.has("colour")) viewer.colour(said.get("colour"));
  if (VIEWS.includes(said.get("view"))) viewer.views.show(said.get("view"));
  if (said.has("loop")) clock.loop = flag("loop");
  for (const name of ["force", "torque", "frames", "grid", "axes", "plots"]) {
    if (said.has(name)) viewer.toggle(name, flag(name));
  }
  if (said.has("follow")) viewer.followPath(said.get("follow"));
  if (Number.isFinite(number("t"))) {
    clock.pause();
    clock.seek(number("t"));
  }
  if (said.has("play")) flag("play") ? clock.play() : clock.pause();
}
