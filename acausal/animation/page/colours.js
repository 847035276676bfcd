// Colours of runs and of values, with the colour bar.

const GHOST = ["#3d6fd0", "#e0218a", "#7a3ff2", "#0f9d9d"]; // of runs and traces, different from the colours of bodies

/** Linear RGB of a colour "#rrggbb", for materials, lights and vertices: three.js r130 does not convert colours itself. */
const linear = (colour) => new THREE.Color(colour).convertSRGBToLinear();

const SEQUENTIAL = ["#3b3fae", "#2f7fd0", "#26b3b0", "#7fce5c", "#f3d03e", "#f08a2c", "#d5303e"];
const DIVERGING = ["#1f5fd0", "#5f9cf0", "#a9c4ea", "#c9c9c9", "#f0b59a", "#ea7a55", "#c8263b"];

class ColourScale {
  constructor() {
    this.active = false;
    this.name = "none";
  }

  /** All values of the shapes: name, unit and range over all runs and times. */
  static offered(runs) {
    const found = new Map();
    const add = (name, unit, low, high) => {
      const entry = found.get(name) ?? { name, unit, low: Infinity, high: -Infinity };
      found.set(name, { ...entry, low: Math.min(entry.low, low), high: Math.max(entry.high, high) });
    };
    for (const run of runs) {
      for (const item of run.items) {
        for (const value of (item instanceof Curve && item.shape.values) || []) {
          for (const k of value.columns) {
            const series = run.columns.series(k);
            add(value.name, value.unit, series.reduce((a, b) => Math.min(a, b)), series.reduce((a, b) => Math.max(a, b)));
          }
        }
        if (item instanceof Skin && item.modes.length) add("deflection", "m", 0, item.largest());
      }
    }
    return [...found.values()];
  }

  choose(entry) {
    this.active = Boolean(entry);
    this.name = entry ? entry.name : "none";
    if (!entry) return;
    let { low, high } = entry;
    // Values of both signs have a scale symmetric about zero.
    const both = low < -1e-6 * high && high > -1e-6 * low;
    if (both) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
    else if (low >= 0) low = 0;
    else high = 0;
    if (!(high > low)) [low, high] = [0, 1];
    Object.assign(this, { low, high, unit: entry.unit, stops: both ? DIVERGING : SEQUENTIAL });
    this.table = new Float32Array(3 * 256);
    // Interpolated in sRGB, as in the bar of the page; stored as linear RGB.
    const colours = this.stops.map((c) => new THREE.Color(c));
    for (let i = 0; i < 256; i++) {
      const place = (i / 255) * (colours.length - 1);
      const k = Math.min(Math.floor(place), colours.length - 2);
      colours[k].clone().lerp(colours[k + 1], place - k).convertSRGBToLinear().toArray(this.table, 3 * i);
    }
  }

  /** Index of the colour of a value in the table. */
  place(value) {
    return 3 * Math.round(255 * clamp((value - this.low) / (this.high - this.low), 0, 1));
  }

  /** Draw the colour bar with numbers and unit into an element. */
  draw(element) {
    element.hidden = !this.active;
    if (!this.active) return;
    const middle = (this.low + this.high) / 2;
    element.replaceChildren(
      make("div", { className: "bar-name", textContent: `${this.name} (${this.unit || "1"})` }),
      make("div", { className: "bar-strip" }),
      make("div", { className: "bar-numbers" }, [this.low, middle, this.high].map((v) => make("span", { textContent: formatNumber(v, 3) }))),
    );
    element.children[1].style.background = `linear-gradient(to right, ${this.stops.join(", ")})`;
  }
}

/** Create an element with properties and children. */
function make(tag, properties = {}, children = []) {
  const element = document.createElement(tag);
  Object.assign(element, properties);
  element.append(...children);
  return element;
}
