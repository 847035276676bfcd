// Solids of revolution: layers of a style, given by half of their sections.

const SHARP = Math.cos(0.7); // edges of a section that turn by more than 0.7 rad are sharp
const FEW = 8; // sides of what is not round

/** The layers of a style as an object of unit size; `ratio` is diameter / length. */
function turnedObject(context, shape, ratio) {
  const group = new THREE.Group();
  for (const [k, layer] of context.looks[shape.style].entries()) {
    const key = `${shape.style}/${k}/${layer.rows.some((row) => row[1]) ? ratio.toPrecision(4) : ""}`;
    geometries[key] ??= turnedGeometry(layer, ratio);
    const colour = layer.color ? { ...shape, color: layer.color } : shape;
    group.add(new THREE.Mesh(geometries[key], context.material(colour, { flatShading: layer.sides < FEW || layer.notch > 0 })));
  }
  return group;
}

/** Half of a section, as points (radius, place along the axis) of a solid of length and diameter 1. */
function section(layer, ratio) {
  return layer.rows.map(([place, beyond, radius]) => [radius, place - 0.5 + beyond * ratio]);
}

/** Corners around the axis: angle, and radius relative to that of a row. The flats of few sides touch the circle. */
function cornersAround({ sides, notch }) {
  const flat = sides < FEW ? 1 / Math.cos(Math.PI / sides) : 1;
  return Array.from({ length: sides + 1 }, (_, k) => [(2 * Math.PI * (k + 0.5)) / sides, flat * (k % sides % 4 < 2 ? 1 : 1 - notch)]);
}

/** Geometry along y, a band with normals of its own between two rows; neighbours share normals unless their edge is sharp. */
function turnedGeometry(layer, ratio) {
  const rows = section(layer, ratio);
  const around = cornersAround(layer);
  const [position, normal, index] = [[], [], []];
  // Normals in the section, of a solid with its true length: (dy, -dr), with y in diameters.
  const outwards = rows.slice(1).map(([r, y], i) => unit([(y - rows[i][1]) / (ratio || 1), rows[i][0] - r, 0], [0, 0, 0]));
  const smooth = (i, other) => {
    const near = outwards[other];
    return near && dot(near, outwards[i]) > SHARP ? unit(plus(near, outwards[i])) : outwards[i];
  };
  outwards.forEach((_, i) => {
    const first = position.length / 3;
    [[rows[i], smooth(i, i - 1)], [rows[i + 1], smooth(i, i + 1)]].forEach(([[r, y], n]) => {
      for (const [angle, scale] of around) {
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        position.push(scale * r * c, y, -scale * r * s);
        // The matrix of the object stretches by its diameter and length; normals by the inverse.
        normal.push(n[0] * c * ratio, n[1], -n[0] * s * ratio);
      }
    });
    const count = around.length;
    for (let k = 0; k + 1 < count; k++) {
      const [a, b] = [first + k, first + k + 1];
      index.push(a, b, b + count, a, b + count, a + count);
    }
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(position), 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(normal), 3));
  geometry.setIndex(index);
  return geometry;
}
