// Buttons, sliders and keys.

const $ = (id) => document.getElementById(id);

const KEYS = [
  ["space", "play or pause"],
  ["\u2190 \u2192", "one frame back or on (with Shift: ten)"],
  ["Home End", "to the start, to the end"],
  ["+ \u2212", "faster, slower"],
  ["1 2 3 4", "view from the front, top, right, from a corner"],
  ["0", "the whole scene"],
  ["x X", "deformation shown larger, smaller"],
  ["c", "next colouring"],
  ["v", "forces and torques"],
  ["f", "frames of the bodies"],
  ["g", "ground"],
  ["a", "axes of the world"],
  ["h", "runs side by side or as ghosts"],
  ["p", "plots"],
  ["l", "loop"],
  ["r", "record a film"],
  ["d", "dark or light"],
  ["?", "this list"],
  ["click", "a part: choose it, to follow or to trace it"],
  ["drag", "turn; right button or two fingers: move; wheel: nearer"],
];

/** Actions of the viewer by key, as named by keyboard events. */
function keyActions(viewer) {
  const { clock } = viewer;
  const deform = (sign) => viewer.deform(10 ** (Math.log10(viewer.stage.deformation) + sign * 0.25));
  return {
    " ": () => (clock.playing ? clock.pause() : clock.play()),
    ArrowLeft: (event) => clock.step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => clock.step(event.shiftKey ? 10 : 1),
    Home: () => clock.seek(clock.first),
    End: () => clock.seek(clock.last),
    "+": () => clock.faster(1),
    "=": () => clock.faster(1),
    "-": () => clock.faster(-1),
    0: () => viewer.fit(),
    1: () => viewer.view("front"),
    2: () => viewer.view("top"),
    3: () => viewer.view("right"),
    4: () => viewer.view("iso"),
    x: () => deform(1),
    X: () => deform(-1),
    c: () => viewer.nextColour(),
    v: () => {
      const wanted = !(viewer.stage.show.force || viewer.stage.show.torque);
      viewer.toggle("force", wanted);
      viewer.toggle("torque", wanted);
    },
    f: () => viewer.toggle("frames"),
    g: () => viewer.toggle("grid"),
    a: () => viewer.toggle("axes"),
    h: () => viewer.ghosts(!viewer.stage.ghosts),
    p: () => viewer.toggle("plots"),
    l: () => viewer.loop(!clock.loop),
    r: () => viewer.recorder.toggle(),
    d: () => viewer.dark(!viewer.isDark()),
    "?": () => viewer.help(),
  };
}

function listenToKeys(viewer) {
  const actions = keyActions(viewer);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const { tagName, id } = event.target;
    // Buttons use the space bar themselves, lists letters, and sliders other than that of time the arrow keys.
    if (tagName === "SELECT" || (tagName === "DIALOG" && event.key !== "?")) return;
    if (["BUTTON", "SUMMARY"].includes(tagName) && event.key === " ") return;
    if (tagName === "INPUT" && id !== "time" && !/^[a-z?]$/i.test(event.key)) return;
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}

/** Connect the controls of the page to the viewer. */
function connectControls(viewer) {
  const { clock } = viewer;
  const press = (id, action) => $(id).addEventListener("click", () => action());
  press("play", () => (clock.playing ? clock.pause() : clock.play()));
  press("slower", () => clock.faster(-1));
  press("faster", () => clock.faster(1));
  press("speed", () => clock.setSpeed(clock.defaultSpeed));
  press("loop", () => viewer.loop(!clock.loop));
  press("record", () => viewer.recorder.toggle());
  press("dark", () => viewer.dark(!viewer.isDark()));
  press("help", () => viewer.help());
  press("fit", () => viewer.fit());
  for (const name of VIEWS) press(name, () => viewer.view(name));
  for (const name of ["grid", "axes", "frames", "force", "torque", "plots"]) {
    $(`show-${name}`).addEventListener("change", (event) => viewer.toggle(name, event.target.checked));
  }
  $("ghosts").addEventListener("change", (event) => viewer.ghosts(event.target.checked));
  $("time").addEventListener("input", (event) => {
    clock.pause();
    clock.seek(clock.first + (clock.last - clock.first) * Number(event.target.value));
  });
  $("deformation").addEventListener("input", (event) => viewer.deform(10 ** Number(event.target.value)));
  $("colour").addEventListener("change", (event) => viewer.colour(event.target.value));
  $("part").addEventListener("change", (event) => viewer.choose(event.target.value));
  press("follow", () => viewer.followChosen());
  press("trace", () => viewer.traceChosen());
  $("keys").replaceChildren(...KEYS.map(([key, said]) => make("tr", {}, [make("th", { textContent: key, scope: "row" }), make("td", { textContent: said })])));
  press("close-help", () => $("help-list").close());
  listenToKeys(viewer);
  releaseFocus();
}

/** Return the keyboard focus to the animation after a control was used with the pointer. */
function releaseFocus() {
  let pointed = false;
  addEventListener("pointerdown", () => (pointed = true), true);
  addEventListener("keydown", () => (pointed = false), true);
  document.addEventListener("change", (event) => pointed && event.target.blur());
  document.addEventListener("click", () => {
    if (pointed && document.activeElement.tagName !== "SELECT") document.activeElement.blur();
  });
}

/** Show the state of the viewer in the page. */
function showState(viewer) {
  const { clock, stage } = viewer;
  const pressed = (id, on) => $(id).setAttribute("aria-pressed", String(on));
  $("play").textContent = clock.playing ? "\u275a\u275a" : "\u25b6";
  $("play").setAttribute("aria-label", clock.playing ? "Pause" : "Play");
  $("time").value = (clock.t - clock.first) / (clock.last - clock.first || 1);
  const digits = Math.max(0, 3 - Math.floor(Math.log10(clock.last - clock.first || 1)));
  const now = clock.t.toFixed(Math.min(digits, 9));
  $("time").setAttribute("aria-valuetext", `${now} seconds`);
  $("now").textContent = `${now} s`;
  $("speed").textContent = `\u00d7${formatNumber(clock.speed, 3)}`;
  pressed("loop", clock.loop);
  pressed("record", Boolean(viewer.recorder.media));
  pressed("follow", Boolean(viewer.views.followed));
  pressed("trace", viewer.chosenTraced());
  for (const name of VIEWS) pressed(name, viewer.views.name === name);
  for (const name of ["grid", "axes", "frames", "force", "torque"]) $(`show-${name}`).checked = stage.show[name];
  $("show-plots").checked = !$("plots").hidden;
  $("ghosts").checked = stage.ghosts;
  $("deformation").value = Math.log10(stage.deformation);
  $("deformation-value").textContent = `\u00d7${formatNumber(stage.deformation, 3)}`;
}
