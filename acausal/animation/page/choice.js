// Selection of a part, to be followed by the camera or traced by a line.

Object.assign(Viewer.prototype, {
  /** Select the part under a click; the clicked point is followed or traced. */
  pick(found) {
    this.choose(found?.part >= 0 ? `${found.run.number}/${found.part}` : "", found);
    if (found?.part >= 0) this.explorer?.reveal(found.run.parts[found.part].path);
  },

  choose(key, found = null) {
    const [number, part] = key.split("/").map(Number);
    const run = key === "" ? null : this.runs[number];
    const point = run && run.anchorOf(part, found?.point, found ? found.index : -1);
    this.chosen = point ? { run, part, point } : null;
    $("part").value = point ? key : "";
    for (const id of ["follow", "trace"]) $(id).disabled = !point && !(id === "follow" && this.views.followed);
    this.requestDraw();
  },

  followPath(path) {
    for (const run of this.runs) {
      const part = run.parts.findIndex((one) => one.path === path);
      if (part < 0) continue;
      this.choose(`${run.number}/${part}`);
      if (this.chosen) this.views.follow(this.chosen.point);
      return;
    }
  },

  followChosen() {
    this.views.follow(this.views.followed ? null : (this.chosen?.point ?? null));
    this.requestDraw();
  },

  traceChosen() {
    if (this.chosen) this.traces.toggle(this.chosen.run, this.chosen.part, this.chosen.point);
    this.requestDraw();
  },

  chosenTraced() {
    return Boolean(this.chosen && this.traces.traced(this.chosen.run, this.chosen.part));
  },
});
