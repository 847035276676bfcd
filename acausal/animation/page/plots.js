// Plots of the outputs: panels by unit and range, with a time cursor; clicks and drags set the time.

const LINES = ["#3b82f6", "#e8853b", "#22a06b", "#c060d0", "#e2596b", "#18a5bd", "#a68b21", "#8d7bf0"];
const DASHES = [[], [7, 4], [2, 3], [9, 3, 2, 3]];
const EDGE = { left: 58, right: 12, top: 8, bottom: 22 };

class Plots {
  constructor(element, runs, clock) {
    Object.assign(this, { element, runs, clock });
    this.fill();
    new ResizeObserver(() => this.draw()).observe(element);
  }

  /** Lay out the panels. */
  fill() {
    this.panels = this.groups().map(({ of, outputs }) => this.panel(of, outputs));
    this.element.replaceChildren(...this.panels.map((panel) => panel.figure));
    this.element.hidden = !this.panels.length;
  }

  /** Group outputs of one unit, unless one varies by less than a twentieth of the common range and would look constant. */
  groups() {
    const outputs = new Map();
    for (const run of this.runs) {
      for (const { name, unit: of, column } of run.run.plots) {
        const key = JSON.stringify([name, of]);
        if (!outputs.has(key)) outputs.set(key, { name, of, list: [] });
        outputs.get(key).list.push({ run, column, shown: true });
      }
    }
    const groups = [];
    for (const { name, of, list } of outputs.values()) {
      const [low, high] = this.extrema(list);
      const least = isConstant(low, high) ? Infinity : high - low;
      const merged = (one) => ({ low: Math.min(low, one.low), high: Math.max(high, one.high), least: Math.min(least, one.least) });
      const fits = ({ low, high, least }) => high - low < 20 * least;
      let group = groups.find((one) => one.of === of && fits(merged(one)));
      if (!group) groups.push((group = { of, low, high, least, outputs: new Map() }));
      Object.assign(group, merged(group)).outputs.set(name, list);
    }
    return groups;
  }

  panel(of, outputs) {
    const curves = [];
    const legend = make("div", { className: "legend" });
    [...outputs].forEach(([name, list], k) =>
      list.forEach(({ run, column }) => {
        const colour = LINES[(outputs.size > 1 ? k : run.number) % LINES.length];
        const said = this.runs.length > 1 ? `${name} (${run.name})` : name;
        const value = make("output", {});
        const swatch = make("i", {});
        swatch.style.borderTopColor = colour;
        swatch.style.borderTopStyle = run.number % DASHES.length ? "dashed" : "solid";
        const button = make("button", { type: "button", title: "Show or hide this curve" }, [swatch, `${said} `, value]);
        const curve = { run, column, colour, value, shown: true, dash: DASHES[run.number % DASHES.length] };
        button.setAttribute("aria-pressed", "true");
        button.onclick = () => {
          curve.shown = !curve.shown;
          button.setAttribute("aria-pressed", String(curve.shown));
          this.draw();
        };
        curves.push(curve);
        legend.append(button);
      }),
    );
    const canvas = make("canvas", {});
    const names = [...outputs.keys()].join(", ");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${names} over time${of ? `, in ${of}` : ""}`);
    const cursor = make("div", { className: "cursor" });
    const area = make("div", { className: "area" }, [canvas, cursor]);
    const seek = (event) => {
      const box = area.getBoundingClientRect();
      const part = (event.clientX - box.left - EDGE.left) / (box.width - EDGE.left - EDGE.right);
      this.clock.pause();
      this.clock.seek(this.clock.first + (this.clock.last - this.clock.first) * clamp(part, 0, 1));
    };
    area.onpointerdown = (event) => {
      area.setPointerCapture(event.pointerId);
      seek(event);
    };
    area.onpointermove = (event) => event.buttons && seek(event);
    return { of, curves, canvas, cursor, area, figure: make("figure", {}, [legend, area]) };
  }

  draw() {
    const style = getComputedStyle(document.documentElement);
    const colours = { text: style.getPropertyValue("--dim").trim(), grid: style.getPropertyValue("--line").trim() };
    for (const panel of this.panels) this.paint(panel, colours);
    this.update();
  }

  paint(panel, colours) {
    const { canvas } = panel;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!width || !height) return;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const ink = canvas.getContext("2d");
    ink.scale(ratio, ratio);
    const [low, high] = this.range(panel);
    const across = (t) => EDGE.left + ((t - this.clock.first) / (this.clock.last - this.clock.first || 1)) * (width - EDGE.left - EDGE.right);
    const down = (v) => EDGE.top + ((high - v) / (high - low)) * (height - EDGE.top - EDGE.bottom);
    ink.font = "11px system-ui, sans-serif";
    ink.fillStyle = colours.text;
    ink.strokeStyle = colours.grid;
    ink.lineWidth = 1;
    ink.textAlign = "right";
    ink.textBaseline = "middle";
    const floor = height - EDGE.bottom;
    const values = ticks(low, high, height / 24);
    for (const v of values) {
      stroke(ink, [[EDGE.left, Math.round(down(v)) + 0.5], [width - EDGE.right, Math.round(down(v)) + 0.5]]);
      ink.fillText(tickLabel(v, values), EDGE.left - 5, down(v));
    }
    ink.textAlign = "center";
    ink.textBaseline = "top";
    const moments = ticks(this.clock.first, this.clock.last, width / 70);
    for (const t of moments) {
      stroke(ink, [[Math.round(across(t)) + 0.5, EDGE.top], [Math.round(across(t)) + 0.5, floor]]);
      ink.fillText(tickLabel(t, moments), clamp(across(t), 12, width - 22), floor + 5);
    }
    ink.textAlign = "left";
    ink.fillText("s", width - 9, floor + 5);
    this.unit(ink, panel.of, floor);
    this.lines(ink, panel, across, down);
  }

  /** Draw the unit along the axis. */
  unit(ink, of, floor) {
    ink.save();
    ink.translate(10, (EDGE.top + floor) / 2);
    ink.rotate(-Math.PI / 2);
    ink.textAlign = "center";
    ink.textBaseline = "middle";
    ink.fillText(of === "1" ? "" : of, 0, 0);
    ink.restore();
  }

  lines(ink, panel, across, down) {
    ink.lineWidth = 1.6;
    ink.lineJoin = "round";
    for (const { run, column, colour, dash, shown } of panel.curves) {
      if (!shown) continue;
      const series = run.columns.series(column);
      const { time } = run.columns;
      ink.strokeStyle = colour;
      ink.setLineDash(dash);
      stroke(ink, Array.from(time, (t, i) => [across(t), down(series[Math.min(i, series.length - 1)])]));
    }
    ink.setLineDash([]);
  }

  /** Smallest and largest value of the visible curves. */
  extrema(curves) {
    let [low, high] = [Infinity, -Infinity];
    for (const { run, column, shown } of curves) {
      if (!shown) continue;
      for (const v of run.columns.series(column)) {
        if (v < low) low = v;
        if (v > high) high = v;
      }
    }
    return [low, high];
  }

  /** Range of the axis: that of the curves and a margin. */
  range(panel) {
    const [low, high] = this.extrema(panel.curves);
    if (!(low <= high)) return [0, 1];
    const span = isConstant(low, high) ? Math.abs(high) || 1 : high - low;
    return [low - 0.06 * span, high + 0.06 * span];
  }

  /** Update the cursors and values to the current time. */
  update() {
    const { first, last, t } = this.clock;
    const part = (t - first) / (last - first || 1);
    for (const { curves, cursor, area } of this.panels) {
      cursor.style.transform = `translateX(${EDGE.left + part * (area.clientWidth - EDGE.left - EDGE.right)}px)`;
      for (const { run, column, value } of curves) value.textContent = formatNumber(run.columns.at(column));
    }
  }
}

/** Whether the variation is at the level of the round-off of float32, whose steps would be visible. */
function isConstant(low, high) {
  return high - low <= 1e-5 * Math.max(Math.abs(low), Math.abs(high));
}

/** Draw a line through points, with a gap where values are not finite. */
function stroke(ink, points) {
  ink.beginPath();
  points.forEach(([x, y], i) => {
    if (!Number.isFinite(y)) return;
    if (i && Number.isFinite(points[i - 1][1])) ink.lineTo(x, y);
    else ink.moveTo(x, y);
  });
  ink.stroke();
}

/** Round numbers in a range, about `count` of them. */
function ticks(low, high, count) {
  if (!(high > low)) return [low];
  const rough = (high - low) / Math.max(count, 2);
  const step = [1, 2, 5, 10].map((k) => k * 10 ** Math.floor(Math.log10(rough))).find((s) => s >= rough * (1 - 1e-9));
  const first = Math.ceil(low / step - 1e-9);
  const list = Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, k) => first + k);
  return list.map((k) => Number((k * step).toPrecision(12)));
}

/** Label of a tick, with enough digits to distinguish it from its neighbours. */
function tickLabel(value, all) {
  const most = Math.max(...all.map(Math.abs));
  const step = all.length > 1 ? all[1] - all[0] : most || 1;
  return formatNumber(value, clamp(Math.round(Math.log10(Math.abs(value) / step)) + 2, 1, 12));
}
