// Traces of points: the whole path pale, the past part in full colour.

class Traces {
  constructor(stage) {
    this.stage = stage;
    this.list = [];
  }

  /** Trace a point of a part of one run, or stop tracing it. */
  toggle(run, part, point) {
    const old = this.list.findIndex((one) => one.run === run && one.part === part);
    if (old >= 0) {
      this.remove(old);
      return false;
    }
    const lines = pathLines(run.columns.frames, GHOST[(this.list.length + 1) % GHOST.length]);
    run.group.add(...lines);
    this.list.push({ run, part, point, lines });
    this.fill(this.list.at(-1));
    return true;
  }

  traced(run, part) {
    return this.list.some((one) => one.run === run && one.part === part);
  }

  remove(index) {
    const [{ run, lines }] = this.list.splice(index, 1);
    for (const line of lines) {
      run.group.remove(line);
      line.geometry.dispose();
      line.material.dispose();
    }
  }

  /** Compute the positions of the point at all frames. */
  fill({ run, point, lines }) {
    fillPath(lines, run.columns, () => minus(point(), this.stage.origin));
  }

  /** Recompute all traces, after a change of the scale of deformations. */
  refill() {
    this.list.forEach((one) => this.fill(one));
  }

  update() {
    for (const { run, lines } of this.list) lines[1].geometry.setDrawRange(0, run.columns.frame + 1);
  }
}

/** Path of a point as a shape of the document. */
class Trail {
  constructor(context, shape) {
    Object.assign(this, { columns: context.columns, stage: context.stage, shape });
    this.object = new THREE.Group();
    this.lines = pathLines(context.columns.frames, context.colour(shape));
    this.object.add(...this.lines);
    this.anchor = null;
    fillPath(this.lines, this.columns, () => this.point());
    context.group.add(this.object);
  }

  point() {
    return minus(this.columns.vector(this.shape.at), this.stage.origin);
  }

  update() {
    this.lines[1].geometry.setDrawRange(0, this.columns.frame + 1);
  }

  positions() {
    return [plus(this.point(), this.stage.origin)];
  }
}

/** Two lines with the same points: the whole path, and its past part. */
function pathLines(frames, colour) {
  const position = new THREE.BufferAttribute(new Float32Array(3 * frames), 3);
  return [0.3, 1].map((opacity) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", position);
    const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: linear(colour), transparent: true, opacity }));
    line.frustumCulled = false;
    line.raycast = () => {}; // the pointer finds parts
    return line;
  });
}

/** Compute the points of a path at all frames. */
function fillPath(lines, columns, point) {
  const { position } = lines[0].geometry.attributes;
  for (let i = 0; i < columns.frames; i++) {
    columns.frame = i;
    columns.weights = [0, 1, 0, 0];
    position.array.set(point(), 3 * i);
  }
  position.needsUpdate = true;
}
