// Tube along a moving line: elliptic rings normal to the line, closed at both ends.

class Tube {
  /** A tube of `count` rings with `around` corners each. */
  constructor(count, around, material) {
    this.count = count;
    this.around = around;
    const vertices = (count + 2) * around + 2; // the flat ends repeat the first and last ring and add a centre each
    this.geometry = new THREE.BufferGeometry();
    for (const name of ["position", "normal", "color"]) {
      const attribute = new THREE.BufferAttribute(new Float32Array(3 * vertices).fill(1), 3);
      this.geometry.setAttribute(name, attribute);
      this[name] = attribute.array;
    }
    this.geometry.setIndex(this.triangles());
    this.circle = Array.from({ length: around }, (_, k) => {
      const angle = (2 * Math.PI * k) / around;
      return [Math.cos(angle), Math.sin(angle)];
    });
    this.object = new THREE.Mesh(this.geometry, material);
    this.object.frustumCulled = false;
  }

  triangles() {
    const { count, around } = this;
    const list = [];
    for (let i = 0; i + 1 < count; i++) {
      for (let k = 0; k < around; k++) {
        const [a, b] = [i * around + k, i * around + ((k + 1) % around)];
        list.push(a, b, a + around, b, b + around, a + around);
      }
    }
    const start = count * around;
    const end = start + around;
    const centres = end + around;
    for (let k = 0; k < around; k++) {
      const next = (k + 1) % around;
      list.push(centres, start + next, start + k, centres + 1, end + k, end + next);
    }
    return list;
  }

  /**
   * Place the rings at points (relative to the origin of the scene), normal to the directions.
   *
   * `a` and `b` are the half-axes; b points along `up` at the first ring and continues without twist.
   */
  place(points, directions, up, a, b) {
    const { count, around, position, normal } = this;
    let second = null;
    for (let i = 0; i < count; i++) {
      const along = unit(directions[i], second ? cross(second, [0, 0, 1]) : [1, 0, 0]);
      second = perpendicular(along, second ?? up);
      const first = cross(second, along);
      for (let k = 0; k < around; k++) {
        const [c, s] = this.circle[k];
        const place = 3 * (i * around + k);
        const size = Math.hypot(c * b, s * a) || 1;
        for (let j = 0; j < 3; j++) {
          position[place + j] = points[i][j] + a * c * first[j] + b * s * second[j];
          normal[place + j] = (b * c * first[j] + a * s * second[j]) / size;
        }
      }
      if (i === 0 || i === count - 1) this.close(i, points[i], i === 0 ? times(-1, along) : along);
    }
    this.geometry.attributes.position.needsUpdate = true;
    this.geometry.attributes.normal.needsUpdate = true;
    this.geometry.boundingSphere = null;
  }

  close(i, point, outwards) {
    const { count, around, position, normal } = this;
    const ring = 3 * i * around;
    const place = 3 * (count + (i === 0 ? 0 : 1)) * around;
    position.copyWithin(place, ring, ring + 3 * around);
    const centre = 3 * ((count + 2) * around + (i === 0 ? 0 : 1));
    for (let j = 0; j < 3; j++) {
      position[centre + j] = point[j];
      normal[centre + j] = outwards[j];
      for (let k = 0; k < around; k++) normal[place + 3 * k + j] = outwards[j];
    }
  }

  /** Give ring i a colour (linear RGB at index `from` of a table). */
  paint(i, table, from) {
    const { count, around, color } = this;
    const set = (vertex) => {
      for (let j = 0; j < 3; j++) color[3 * vertex + j] = table[from + j];
    };
    for (let k = 0; k < around; k++) set(i * around + k);
    if (i !== 0 && i !== count - 1) return;
    const end = i === 0 ? 0 : 1;
    for (let k = 0; k < around; k++) set((count + end) * around + k);
    set((count + 2) * around + end);
  }

  painted() {
    this.geometry.attributes.color.needsUpdate = true;
  }

  /** Centre of ring i, from the vertex buffer. */
  middle(i) {
    const sum = [0, 0, 0];
    for (let k = 0; k < this.around; k++) {
      for (let j = 0; j < 3; j++) sum[j] += this.position[3 * (i * this.around + k) + j];
    }
    return times(1 / this.around, sum);
  }
}
