// Viewer: state of the page, changed by controls, keys and address, and drawn once after each change.

class Viewer {
  constructor(document_, stage, runs) {
    Object.assign(this, { document: document_, stage, runs });
    this.clock = new Clock(runs, () => this.requestDraw());
    this.views = new Views(stage, () => this.requestDraw());
    this.traces = new Traces(stage);
    this.recorder = new Recorder(this.clock, stage, document_.title || "animation", () => this.requestDraw());
    this.plots = new Plots($("plots"), runs, this.clock);
    this.axisNames = new AxisNames(stage, $("axis-names"));
    this.hover = new Hover(stage, $("tip"), (found) => this.pick(found));
    this.values = ColourScale.offered(runs);
    this.chosen = null;
    this.scaleArrows();
    this.fillLists();
    connectControls(this);
    this.dark(matchMedia("(prefers-color-scheme: dark)").matches);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => this.dark(event.matches));
    new ResizeObserver(() => this.resize()).observe(stage.element);
    this.resize();
    this.view(this.views.defaultView());
  }

  /** Draw once at the next animation frame. */
  requestDraw() {
    if (this.waiting || !this.plots) return;
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      this.clock.tick(now);
      this.draw();
    });
  }

  draw() {
    this.update();
    this.stage.render();
    this.axisNames.update();
    this.plots.update();
    this.explorer?.update();
    showState(this);
  }

  /** Update all objects to the current time, without drawing. */
  update() {
    for (const run of this.runs) run.update(this.clock.t);
    this.traces.update();
    this.views.followPart();
    this.stage.scene.updateMatrixWorld();
    this.labelRuns();
  }

  resize() {
    this.stage.resize();
    if (this.views.name) this.views.show(this.views.name);
    this.requestDraw();
  }

  /** Scale forces and torques so that the longest over time is a quarter of the extent. */
  scaleArrows() {
    for (const quantity of ["force", "torque"]) {
      const arrows = this.runs.flatMap((run) => run.items).filter((item) => item.quantity === quantity);
      const longest = Math.max(0, ...arrows.map((arrow) => arrow.longest()));
      this.stage.arrowScale[quantity] = longest > 0 ? (0.25 * this.stage.extent) / longest : 0;
      const label = $(`show-${quantity}`).parentElement;
      label.hidden = !arrows.length;
      if (longest > 0) label.append(` up to ${formatNumber(longest, 3)} ${arrows[0].shape.unit}`);
    }
  }

  /** Fill the lists of values and parts, and hide controls that the document has no use for. */
  fillLists() {
    const options = [["none", "none"], ...this.values.map((v) => [v.name, v.unit ? `${v.name} (${v.unit})` : v.name])];
    $("colour").replaceChildren(...options.map(([value, text]) => make("option", { value, textContent: text })));
    $("colour").parentElement.hidden = !this.values.length;
    const items = this.runs.flatMap((run) => run.items);
    const deforms = items.some((item) => (item instanceof Curve && item.shape.rest) || (item instanceof Skin && item.modes.length));
    $("deformation").parentElement.hidden = !deforms;
    $("show-grid").parentElement.hidden = !this.stage.grounded;
    $("show-frames").parentElement.hidden = !this.runs.some((run) => run.poses.length);
    $("show-plots").parentElement.hidden = !this.plots.panels.length;
    $("ghosts").parentElement.hidden = this.runs.length < 2;
    const parts = new Map();
    this.runs.forEach((run) =>
      run.run.shapes.forEach((shape, k) => {
        const part = run.parts[shape.part];
        if (part && run.items[k].anchor) parts.set(`${run.number}/${shape.part}`, (this.runs.length > 1 ? `${run.name}: ` : "") + (part.path || part.type));
      }),
    );
    const list = [["", "no part"], ...parts];
    $("part").replaceChildren(...list.map(([value, textContent]) => make("option", { value, textContent })));
    $("part").parentElement.hidden = !parts.size;
    $("record").hidden = !this.recorder.possible();
    this.showStopped();
  }

  /** Show which runs ended early and why. */
  showStopped() {
    const said = this.runs.filter((run) => run.stopped).map((run) => {
      const name = this.runs.length > 1 ? `${run.name}: ` : "";
      return make("p", { textContent: `${name}stopped at ${formatNumber(run.columns.last, 6)} s: ${run.stopped}` });
    });
    $("stopped").replaceChildren(...said);
    $("stopped").hidden = !said.length;
  }

  /** Label the runs in their panels, or in the colours of their ghosts. */
  labelRuns() {
    const { stage } = this;
    const key = `${stage.ghosts}/${stage.element.clientWidth}/${stage.element.clientHeight}`;
    if (this.runs.length < 2 || this.labelled === key) return;
    this.labelled = key;
    const labels = stage.panels().map(({ x, y, width, height, runs }) => {
      const names = runs.map((run, k) => {
        const name = make("div", { className: "run-name", textContent: run.name });
        Object.assign(name.style, { left: "10px", top: `${8 + 25 * k}px` });
        if (stage.ghosts && k) name.style.color = GHOST[run.number % GHOST.length];
        return name;
      });
      const frame = make("div", { className: "panel" }, names);
      Object.assign(frame.style, { left: `${100 * x}%`, top: `${100 * y}%`, width: `${100 * width}%`, height: `${100 * height}%` });
      Object.assign(frame.style, { borderLeftWidth: x ? "1px" : 0, borderTopWidth: y ? "1px" : 0 });
      return frame;
    });
    $("labels").replaceChildren(...labels);
  }

  view(name) {
    this.views.show(name);
    this.requestDraw();
  }

  fit() {
    this.views.fit();
    this.requestDraw();
  }

  toggle(name, wanted) {
    if (name === "plots") {
      $("plots").hidden = !(wanted ?? $("plots").hidden) || !this.plots.panels.length;
    } else {
      const { show } = this.stage;
      show[name] = wanted ?? !show[name];
      if (name === "frames") for (const run of this.runs) for (const pose of run.poses) pose.showAxes(show.frames);
    }
    this.requestDraw();
  }

  deform(scale) {
    this.stage.deformation = clamp(Number(scale.toPrecision(3)), 1, 1000);
    this.traces.refill();
    this.requestDraw();
  }

  /** Colour by a value of the document; any other name means none. */
  colour(name) {
    const entry = this.values.find((value) => value.name === name);
    this.stage.colours.choose(entry);
    $("colour").value = entry ? entry.name : "none";
    this.stage.colours.draw($("bar"));
    this.showGhosts();
    this.requestDraw();
  }

  nextColour() {
    const names = ["none", ...this.values.map((value) => value.name)];
    this.colour(names[(names.indexOf(this.stage.colours.name) + 1) % names.length]);
  }

  ghosts(wanted) {
    this.stage.ghosts = wanted && this.runs.length > 1;
    this.showGhosts();
    this.resize();
  }

  showGhosts() {
    for (const run of this.runs) run.showGhosts(this.stage.ghosts);
  }

  loop(wanted) {
    this.clock.loop = wanted;
    this.requestDraw();
  }

  isDark() {
    return document.documentElement.dataset.theme === "dark";
  }

  dark(wanted) {
    document.documentElement.dataset.theme = wanted ? "dark" : "light";
    this.stage.applyTheme();
    this.plots.draw();
    this.requestDraw();
  }

  help() {
    if ($("help-list").open) $("help-list").close();
    else $("help-list").showModal();
  }
}
