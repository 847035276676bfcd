// Coils, rods and other spans between two moving points, and arrows.

const TURNS = 9;
const PER_TURN = 16;
const SLENDER = 0.1; // diameter / length for the bevels of spans
const LEAD = 0.12; // straight fraction of the length at each end of a coil

class Span {
  constructor(context, shape) {
    this.columns = context.columns;
    this.stage = context.stage;
    this.shape = shape;
    if (shape.style === "coil") {
      this.tube = new Tube(TURNS * PER_TURN + 1 + 8, circle(8), context.material(shape));
      this.object = this.tube.object;
    } else {
      this.object = turnedObject(context, shape, SLENDER);
      this.object.matrixAutoUpdate = false;
    }
    context.group.add(this.object);
  }

  ends() {
    return [this.columns.vector(this.shape.a), this.columns.vector(this.shape.b)];
  }

  update() {
    const [a, b] = this.ends().map((p) => minus(p, this.stage.origin));
    const diameter = Math.max(this.shape.diameter, 2 * this.stage.minRadius);
    if (this.tube) this.coil(a, b, diameter);
    else this.object.matrix.copy(cylinderMatrix(a, b, diameter));
    this.object.visible = length(minus(b, a)) > 0;
  }

  coil(a, b, diameter) {
    const axis = unit(minus(b, a));
    const first = perpendicular(axis);
    const second = cross(axis, first);
    const wire = Math.max(0.07 * diameter, this.stage.minRadius);
    const winding = Math.max(diameter / 2 - wire, wire);
    const count = this.tube.count;
    const points = Array.from({ length: count }, (_, i) => {
      const s = this.fraction(i, count);
      const wound = clamp((s - LEAD) / (1 - 2 * LEAD), 0, 1);
      const angle = 2 * Math.PI * TURNS * wound;
      // The radius grows from the axis, and returns to it, within half a turn.
      const radius = winding * Math.min(1, 2 * TURNS * Math.min(wound, 1 - wound));
      const out = plus(times(radius * Math.cos(angle), first), times(radius * Math.sin(angle), second));
      return plus(lerp(a, b, s), out);
    });
    const rings = points.map((point, i) => {
      const direction = minus(points[Math.min(i + 1, count - 1)], points[Math.max(i - 1, 0)]);
      return { point, direction, half: [wire, wire] };
    });
    this.tube.place(rings);
  }

  /** Position of ring i along the coil: four rings for each straight end, the others for the winding. */
  fraction(i, count) {
    if (i < 4) return (LEAD * i) / 4;
    if (i >= count - 4) return 1 - (LEAD * (count - 1 - i)) / 4;
    return LEAD + ((1 - 2 * LEAD) * (i - 4)) / (count - 9);
  }

  positions() {
    if (!this.tube) return [[0, -0.5, 0], [0, 0.5, 0]].map((mark) => this.stage.toWorld(this.object, mark));
    return [this.tube.middle(0), this.tube.middle(this.tube.count - 1)].map((p) => plus(p, this.stage.origin));
  }

  anchor(touched) {
    const ends = this.ends();
    const near = touched && length(minus(ends[0], touched)) < length(minus(ends[1], touched)) ? 0 : 1;
    return () => this.ends()[near];
  }
}

class Arrow {
  constructor(context, shape) {
    this.columns = context.columns;
    this.stage = context.stage;
    this.shape = shape;
    this.quantity = shape.quantity;
    const material = context.material(shape);
    this.object = new THREE.Group();
    this.shaft = new THREE.Mesh(unitGeometry("cylinder"), material);
    this.heads = (shape.quantity === "torque" ? [0, 1] : [0]).map(() => new THREE.Mesh(unitGeometry("cone"), material));
    for (const mesh of [this.shaft, ...this.heads]) {
      mesh.matrixAutoUpdate = false;
      this.object.add(mesh);
    }
    context.group.add(this.object);
  }

  /** Largest length of the vector over time. */
  longest() {
    const series = this.shape.vector.map((k) => this.columns.series(k));
    let most = 0;
    for (let i = 0; i < Math.max(...series.map((s) => s.length)); i++) {
      most = Math.max(most, Math.hypot(...series.map((s) => s[Math.min(i, s.length - 1)])));
    }
    return most;
  }

  update() {
    const at = minus(this.columns.vector(this.shape.at), this.stage.origin);
    const vector = times(this.stage.arrowScale[this.quantity] ?? 0, this.columns.vector(this.shape.vector));
    const size = length(vector);
    const thick = 0.007 * this.stage.extent;
    const head = Math.min(5 * thick, 0.6 * size);
    const wide = 0.6 * head;
    const axis = unit(vector);
    const tip = plus(at, vector);
    this.shaft.matrix.copy(cylinderMatrix(at, minus(tip, times(head, axis)), Math.min(thick, 0.4 * wide)));
    this.heads.forEach((mesh, k) => {
      const end = minus(tip, times(0.7 * k * head, axis));
      mesh.matrix.copy(cylinderMatrix(minus(end, times(head, axis)), end, wide));
    });
    // Arrows shorter than a thousandth of the scene are hidden.
    this.object.visible = this.stage.show[this.quantity] && size > 1e-3 * this.stage.extent;
  }

  positions() {
    return [this.stage.toWorld(this.shaft, [0, -0.5, 0]), this.stage.toWorld(this.heads[0], [0, 0.5, 0])];
  }

  anchor() {
    return () => this.columns.vector(this.shape.at);
  }
}

/** Three arrows along the axes of a frame: x red, y green, z blue. */
function tripod(size) {
  const group = new THREE.Group();
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const colours = ["#e5484d", "#46a758", "#3b82f6"];
  axes.forEach((axis, k) => {
    const material = new THREE.MeshBasicMaterial({ color: linear(colours[k]) });
    const add = (geometry, from, to, diameter) => {
      const mesh = new THREE.Mesh(unitGeometry(geometry), material);
      mesh.matrixAutoUpdate = false;
      mesh.matrix.copy(cylinderMatrix(times(from * size, axis), times(to * size, axis), diameter * size));
      group.add(mesh);
    };
    add("cylinder", 0, 0.8, 0.035);
    add("cone", 0.78, 1, 0.13);
  });
  return group;
}
