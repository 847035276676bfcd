// Surface of an elastic body: vertices in its frame, displaced by modes.

class Skin {
  static async of(context, shape) {
    const skin = new Skin();
    skin.stage = context.stage;
    skin.columns = context.columns;
    skin.pose = context.poses[shape.pose];
    skin.shape = shape;
    skin.rest = new Float32Array(await unpack(shape.vertices));
    skin.modes = shape.modes ? new Float32Array(await unpack(shape.modes)) : new Float32Array(0);
    skin.count = skin.rest.length / 3;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(skin.rest.slice(), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(skin.rest.length).fill(1), 3));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(await unpack(shape.triangles)), 1));
    const material = context.material(shape, { vertexColors: true, flatShading: true, side: THREE.DoubleSide });
    skin.object = new THREE.Mesh(geometry, material);
    skin.object.frustumCulled = false;
    skin.plain = linear(context.colour(shape)).toArray();
    skin.pose.group.add(skin.object);
    return skin;
  }

  /** Displacements of all vertices, resolved in the body's frame, not scaled. */
  displacements() {
    const moved = new Float32Array(this.rest.length);
    (this.shape.q ?? []).forEach((k, m) => {
      const q = this.columns.at(k);
      const from = m * this.rest.length;
      if (q !== 0) for (let i = 0; i < moved.length; i++) moved[i] += q * this.modes[from + i];
    });
    return moved;
  }

  update() {
    const { position, color } = this.object.geometry.attributes;
    const moved = this.displacements();
    const scale = this.stage.deformation;
    for (let i = 0; i < moved.length; i++) position.array[i] = this.rest[i] + scale * moved[i];
    position.needsUpdate = true;
    this.object.geometry.boundingSphere = null;
    const colours = this.stage.colours;
    const active = colours.active && colours.name === "deflection" && this.modes.length > 0;
    if (!active && this.paintedPlain) return;
    for (let i = 0; i < this.count; i++) {
      const size = Math.hypot(moved[3 * i], moved[3 * i + 1], moved[3 * i + 2]);
      const from = active ? colours.place(size) : 0;
      for (let j = 0; j < 3; j++) color.array[3 * i + j] = active ? colours.table[from + j] : this.plain[j];
    }
    this.paintedPlain = !active;
    color.needsUpdate = true;
  }

  /** Largest displacement over about a hundred frames. */
  largest() {
    const { columns } = this;
    const step = Math.max(1, Math.floor(columns.frames / 100));
    let most = 0;
    for (let i = 0; i < columns.frames; i += step) {
      columns.seek(columns.time[i]);
      const moved = this.displacements();
      for (let k = 0; k < moved.length; k += 3) most = Math.max(most, Math.hypot(moved[k], moved[k + 1], moved[k + 2]));
    }
    return most;
  }

  positions() {
    const { array } = this.object.geometry.attributes.position;
    const few = Math.min(8, this.count);
    return Array.from({ length: few }, (_, i) => this.stage.toWorld(this.object, array.subarray(3 * i, 3 * i + 3)));
  }

  anchor(touched) {
    if (!touched) {
      return () => this.pose.point([0, 0, 0]);
    }
    const { array } = this.object.geometry.attributes.position;
    const local = this.stage.toLocal(this.pose.group, touched);
    let [nearest, least] = [0, Infinity];
    for (let i = 0; i < this.count; i++) {
      const distance = length(minus(array.subarray(3 * i, 3 * i + 3), local));
      if (distance < least) [nearest, least] = [i, distance];
    }
    return () => {
      const moved = [0, 1, 2].map((j) => {
        const place = 3 * nearest + j;
        const sum = (this.shape.q ?? []).reduce((s, k, m) => s + this.columns.at(k) * this.modes[m * this.rest.length + place], 0);
        return this.rest[place] + this.stage.deformation * sum;
      });
      return this.pose.point(moved);
    };
  }
}
