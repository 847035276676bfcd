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
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * run.columns.frames), 3));
    const past = new THREE.BufferGeometry();
    past.setAttribute("position", geometry.attributes.position);
    const colour = GHOST[(this.list.length + 1) % GHOST.length];
    const lines = [[geometry, 0.3], [past, 1]].map(([one, opacity]) => {
      const material = new THREE.LineBasicMaterial({ color: linear(colour), transparent: true, opacity });
      const line = new THREE.Line(one, material);
      line.frustumCulled = false;
      run.group.add(line);
      return line;
    });
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
    const { columns } = run;
    const position = lines[0].geometry.attributes.position;
    for (let i = 0; i < columns.frames; i++) {
      columns.frame = i;
      columns.weights = [0, 1, 0, 0];
      position.array.set(minus(point(), this.stage.origin), 3 * i);
    }
    position.needsUpdate = true;
  }

  /** Recompute all traces, after a change of the scale of deformations. */
  refill() {
    this.list.forEach((one) => this.fill(one));
  }

  update() {
    for (const { run, lines } of this.list) lines[1].geometry.setDrawRange(0, run.columns.frame + 1);
  }
}
