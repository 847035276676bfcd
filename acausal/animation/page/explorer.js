// Explorer: the tree of the parts, and plots of the variables that are chosen in it.

/** Plots of chosen variables, one for each unit, with the events. */
class Selection extends Plots {
  /** Choose the variables; each keeps its colour. */
  choose(chosen) {
    this.runs[0].run.plots = chosen;
    this.fill();
    this.draw();
  }

  /** One group for each unit; groups keep their order until their last curve is removed. */
  groups() {
    const [run] = this.runs;
    const units = [...(this.units ?? []), ...run.run.plots.map((one) => one.unit)];
    this.units = [...new Set(units)].filter((of) => run.run.plots.some((one) => one.unit === of));
    const groups = new Map(this.units.map((of) => [of, { of, outputs: new Map() }]));
    for (const { name, unit, column } of run.run.plots) groups.get(unit).outputs.set(name, [{ run, column }]);
    return [...groups.values()];
  }

  panel(of, outputs) {
    const panel = super.panel(of, outputs);
    const names = [...outputs.keys()];
    panel.curves.forEach((curve, k) => {
      const chosen = this.runs[0].run.plots.find((one) => one.name === names[k]);
      Object.assign(curve, { colour: chosen.colour, dash: chosen.dash });
      const button = panel.figure.querySelectorAll(".legend button")[k];
      button.title = `Remove ${names[k]}`;
      button.onclick = () => this.removed(names[k]);
      button.firstChild.style.borderTopColor = chosen.colour;
      button.firstChild.style.borderTopStyle = chosen.dash.length ? "dashed" : "solid";
    });
    panel.happened = make("div", { className: "happened", hidden: true });
    panel.area.append(panel.happened);
    panel.area.addEventListener("pointermove", (event) => this.showEvent(panel, event));
    panel.area.addEventListener("pointerleave", () => (panel.happened.hidden = true));
    return panel;
  }

  /** Horizontal place of a time in a panel, in pixels. */
  across(panel, t) {
    const { first, last } = this.clock;
    return EDGE.left + ((t - first) / (last - first || 1)) * (panel.area.clientWidth - EDGE.left - EDGE.right);
  }

  /** Show what changed at the event under the pointer. */
  showEvent(panel, event) {
    const x = event.clientX - panel.area.getBoundingClientRect().left;
    const near = (one) => Math.abs(this.across(panel, one.t) - x);
    const found = this.events.reduce((best, one) => (!best || near(one) < near(best) ? one : best), null);
    panel.happened.hidden = !found || near(found) > 6;
    if (panel.happened.hidden) return;
    panel.happened.textContent = eventText(found);
    const { clientWidth } = panel.area;
    panel.happened.style.left = `${clamp(this.across(panel, found.t) + 6, 0, Math.max(clientWidth - panel.happened.offsetWidth - 6, 0))}px`;
  }

  /** Draw the events below the curves: lines, or short ones if they are too many. */
  lines(ink, panel, across, down) {
    const [top, floor] = [EDGE.top, panel.canvas.clientHeight - EDGE.bottom];
    const crowded = this.events.length > panel.canvas.clientWidth / 6;
    ink.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue("--event").trim();
    ink.lineWidth = 1;
    ink.setLineDash(crowded ? [] : [3, 3]);
    for (const { t } of this.events) stroke(ink, [[across(t), crowded ? floor - 7 : top], [across(t), floor]]);
    ink.setLineDash([]);
    super.lines(ink, panel, across, down);
  }

  update() {
    this.runs[0].columns.seek(this.clock.t);
    super.update();
  }

  fill() {
    super.fill();
    if (!this.panels.length) this.element.replaceChildren(make("p", { className: "hint", textContent: "Choose a variable in the tree to plot it over time." }));
    this.element.hidden = false;
  }
}

const eventText = ({ t, what }) => `${formatNumber(t, 6)} s${what ? `: ${what}` : ""}`;

const TREE_KEYS = [
  ["\u2191 \u2193 \u2190 \u2192", "in the tree: move, open and close"],
  ["Enter", "in the tree: open a part, plot a variable or remove it"],
  ["* ?", "in the filter: any text, any character"],
];

// Keys that serve a page without a picture.
const PLAIN_KEYS = ["space", "\u2190 \u2192", "Home End", "+ \u2212", "p", "l", "d", "?"];

class Explorer {
  static async of(viewer, packed) {
    const columns = await Series.of(packed);
    const content = JSON.parse(new TextDecoder().decode(await unpack(packed.model)));
    return new Explorer(viewer, columns, content);
  }

  constructor(viewer, columns, content) {
    Object.assign(this, { viewer, columns, chosen: [] });
    const run = { run: { plots: [] }, columns, number: 0, name: "" };
    this.plots = viewer.plots = new Selection($("plots"), [run], viewer.clock);
    this.plots.events = content.events;
    this.plots.removed = (name) => this.toggle(this.nodes.get(name));
    this.root = TreeNode.part(content.root);
    this.addEvents(content.events);
    this.nodes = new Map([...this.root.all()].filter((node) => node.column !== undefined).map((node) => [node.path, node]));
    this.tree = new Tree($("tree"), this.root, columns, (node) => this.act(node));
    $("note").textContent = content.note;
    if ($("picture").hidden) for (const row of [...$("keys").rows]) row.hidden = !PLAIN_KEYS.includes(row.cells[0].textContent);
    $("keys").append(...TREE_KEYS.map(([key, what]) => make("tr", {}, [make("th", { textContent: key, scope: "row" }), make("td", { textContent: what })])));
    $("explorer").hidden = false;
    this.layOut();
    for (const path of this.initial(content.plots)) if (this.nodes.has(path)) this.toggle(this.nodes.get(path), false);
    this.show();
  }

  /** Variables that are plotted at first: those of the address, else the outputs. */
  initial(outputs) {
    const requested = new URLSearchParams(location.hash.replace(/^#/, "")).getAll("plot");
    return requested.length ? requested : outputs;
  }

  addEvents(events) {
    if (!events.length) return;
    const group = new TreeNode(this.root, "events", { path: "events", count: String(events.length) });
    group.children = events.map((one) => new TreeNode(group, `${formatNumber(one.t, 6)} s`, { path: `events ${one.t}`, value: one.what, time: one.t }));
    this.root.children.push(group);
  }

  layOut() {
    const { classList } = document.body;
    classList.add("exploring");
    classList.toggle("no-picture", $("picture").hidden);
    const drawer = $("drawer");
    drawer.hidden = false;
    const open = (wanted) => {
      classList.toggle("drawn", wanted);
      drawer.setAttribute("aria-expanded", String(wanted));
    };
    open(innerWidth > 700);
    drawer.addEventListener("click", () => open(!classList.contains("drawn")));
    $("shade").addEventListener("click", () => open(false));
    $("explorer").addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      if (innerWidth > 700) document.activeElement.blur();
      else open(false);
    });
  }

  act(node) {
    if (node.time !== undefined) {
      this.viewer.clock.pause();
      this.viewer.clock.seek(node.time);
    } else if (node.column !== undefined) this.toggle(node);
  }

  /** Plot a variable, or remove it. */
  toggle(node, show = true) {
    const place = this.chosen.findIndex((one) => one.name === node.path);
    if (place >= 0) this.chosen.splice(place, 1);
    else this.chosen.push({ name: node.path, unit: node.unit, column: this.columns.column(node.column), ...this.style(node.unit) });
    if (show) this.show();
  }

  /** The first colour and dash that no other curve of the unit has. */
  style(unit) {
    const taken = new Set(this.chosen.filter((one) => one.unit === unit).map((one) => one.style));
    let style = 0;
    while (taken.has(style)) style += 1;
    return { style, colour: LINES[style % LINES.length], dash: DASHES[Math.floor(style / LINES.length) % DASHES.length] };
  }

  show() {
    this.plots.choose(this.chosen);
    this.tree.mark(new Map(this.chosen.map((one) => [one.name, one.colour])));
  }

  reveal(path) {
    this.tree.reveal(path);
  }

  update() {
    this.tree.update();
  }
}
