// Tube along a moving line: rings normal to the line, closed at both ends.

// A profile holds the corners of a ring with half-axes 1, each with the normal of the surface there.

function circle(count) {
  return Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return [c, s, c, s];
  });
}

const PROFILES = {
  ellipse: circle(20),
  // Each edge twice, once for either side.
  // prettier-ignore
  rectangle: [
    [1, -1, 1, 0], [1, 1, 1, 0], [1, 1, 0, 1], [-1, 1, 0, 1],
    [-1, 1, -1, 0], [-1, -1, -1, 0], [-1, -1, 0, -1], [1, -1, 0, -1],
  ],
};

class Tube {
  /** A tube of `count` rings. */
  constructor(count, profile, material) {
    this.count = count;
    this.profile = profile;
    const around = (this.around = profile.length);
    const vertices = (count + 2) * around + 2; // the flat ends repeat the first and last ring and add a centre each
    this.geometry = new THREE.BufferGeometry();
    for (const name of ["position", "normal", "color"]) {
      const attribute = new THREE.BufferAttribute(new Float32Array(3 * vertices).fill(1), 3);
      this.geometry.setAttribute(name, attribute);
      this[name] = attribute.array;
    }
    this.geometry.setIndex(this.triangles());
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
   * Place rings, each with its point (relative to the origin of the scene), the direction of the line, its half-axes, and
   * `up`, the direction of the second one: where it is undefined, the one of the ring before continues without twist.
   */
  place(rings) {
    const { count, around, position, normal } = this;
    let second = null;
    for (let i = 0; i < count; i++) {
      const { point, direction, up, half } = rings[i];
      const [a, b] = half;
      const along = unit(direction, second ? cross(second, [0, 0, 1]) : [1, 0, 0]);
      second = perpendicular(along, up ?? second);
      const first = cross(second, along);
      for (let k = 0; k < around; k++) {
        const [c, s, m, n] = this.profile[k];
        const place = 3 * (i * around + k);
        const size = Math.hypot(b * m, a * n) || 1;
        for (let j = 0; j < 3; j++) {
          position[place + j] = point[j] + a * c * first[j] + b * s * second[j];
          normal[place + j] = (b * m * first[j] + a * n * second[j]) / size;
        }
      }
      if (i === 0 || i === count - 1) this.close(i, point, i === 0 ? times(-1, along) : along);
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
