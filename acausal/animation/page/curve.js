// Beams: a tube along the deformed axis, cubic between the nodes, coloured by a value at the nodes.

class Curve {
  constructor(context, shape) {
    this.columns = context.columns;
    this.poses = context.poses;
    this.stage = context.stage;
    this.shape = shape;
    this.nodes = shape.points.length;
    // About a hundred rings for each beam, whatever the number of its elements.
    this.parts = clamp(Math.ceil(96 / (this.nodes - 1)), 4, 32);
    this.tube = new Tube((this.nodes - 1) * this.parts + 1, PROFILES[shape.profile], context.material(shape, { vertexColors: true }));
    this.object = this.tube.object;
    this.plain = linear(context.colour(shape)).toArray();
    context.group.add(this.object);
  }

  /**
   * Positions and tangents of the nodes with scaled deformation; the parameter grows by 1 along each element. The directions
   * `up` turn with the tangents.
   */
  centreline() {
    const points = this.shape.points.map((ks) => this.columns.vector(ks));
    const tangents = this.shape.tangents?.map((ks) => this.columns.vector(ks)) ?? slopes(points);
    const up = this.shape.up?.map((ks) => this.columns.vector(ks));
    const scale = this.stage.deformation;
    if (scale === 1 || !this.shape.rest) return { points, tangents, up };
    const rest = this.rest(points);
    const drawn = points.map((p, i) => lerp(rest[i], p, scale));
    const straight = slopes(rest);
    const turned = tangents.map((tangent, i) => lerp(straight[i], tangent, scale));
    return { points: drawn, tangents: turned, up: up?.map((v, i) => carry(v, tangents[i], turned[i])) };
  }

  /** Undeformed positions of the nodes: on the chord, or fixed to the frame of the beam. */
  rest(points) {
    const { chord, fractions, pose, points: local } = this.shape.rest;
    if (chord) return fractions.map((f) => lerp(points[0], points[this.nodes - 1], f));
    return local.map((p) => this.poses[pose].point(p));
  }

  update() {
    const { points, tangents, up } = this.centreline();
    const rings = [];
    const { origin, minRadius } = this.stage;
    const halves = this.shape.section.map((pair) => pair.map((half) => Math.max(half, minRadius)));
    for (let e = 0; e + 1 < this.nodes; e++) {
      const ends = [minus(points[e], origin), tangents[e], minus(points[e + 1], origin), tangents[e + 1]];
      const steps = e + 2 === this.nodes ? this.parts + 1 : this.parts;
      for (let k = 0; k < steps; k++) {
        const s = k / this.parts;
        const slope = 6 * s * (s - 1);
        rings.push({
          point: hermite(ends, [1 + s * s * (2 * s - 3), s * (1 - s) ** 2, s * s * (3 - 2 * s), s * s * (s - 1)]),
          direction: hermite(ends, [slope, (1 - s) * (1 - 3 * s), -slope, s * (3 * s - 2)]),
          half: between(halves, e, s),
          up: up && (up.length > 1 || !rings.length) ? between(up, e, s) : undefined,
        });
      }
    }
    this.tube.place(rings);
    this.paint();
  }

  paint() {
    const scale = this.stage.colours;
    const value = scale.active && this.shape.values.find((v) => v.name === scale.name);
    if (!value && this.paintedPlain) return;
    const { count } = this.tube;
    const at = value && value.columns.map((k) => this.columns.at(k));
    for (let i = 0; i < count; i++) {
      if (!value) {
        this.tube.paint(i, this.plain, 0);
        continue;
      }
      const e = Math.min(Math.floor(i / this.parts), this.nodes - 2);
      const s = i / this.parts - e;
      this.tube.paint(i, scale.table, scale.place(at[e] + s * (at[e + 1] - at[e])));
    }
    this.paintedPlain = !value;
    this.tube.painted();
  }

  positions() {
    return Array.from({ length: this.nodes }, (_, i) => plus(this.tube.middle(i * this.parts), this.stage.origin));
  }

  anchor(touched) {
    let node = this.nodes - 1;
    if (touched) {
      const distances = this.positions().map((p) => length(minus(p, touched)));
      node = distances.indexOf(Math.min(...distances));
    }
    return () => this.centreline().points[node];
  }
}

/** Tangents at points by central differences, one-sided at the ends. */
function slopes(points) {
  const last = points.length - 1;
  return points.map((_, i) => {
    const [low, high] = [Math.max(i - 1, 0), Math.min(i + 1, last)];
    return times(1 / (high - low), minus(points[high], points[low]));
  });
}

function hermite(ends, weights) {
  const sum = [0, 0, 0];
  for (let k = 0; k < 4; k++) for (let j = 0; j < 3; j++) sum[j] += weights[k] * ends[k][j];
  return sum;
}
