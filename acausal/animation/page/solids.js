// Rigid shapes: boxes, cylinders, spheres and parts of joints, fixed to the pose of a body.

const UNIT = {
  box: () => new THREE.BoxGeometry(1, 1, 1),
  cylinder: () => new THREE.CylinderGeometry(0.5, 0.5, 1, 24),
  sphere: () => new THREE.SphereGeometry(0.5, 40, 24),
  cone: () => new THREE.CylinderGeometry(0, 0.5, 1, 24),
};
const geometries = {};

/** Shared geometry of unit size; the axis of cylinders and cones is y. */
function unitGeometry(kind) {
  return (geometries[kind] ??= UNIT[kind]());
}

/** Matrix that maps the unit cylinder to a cylinder between two points. */
function cylinderMatrix(from, to, diameter) {
  const axis = unit(minus(to, from), [0, 1, 0]);
  const side = perpendicular(axis);
  const third = cross(side, axis);
  return frameMatrix(lerp(from, to, 0.5), [side, axis, third], [diameter, length(minus(to, from)), diameter]);
}

function frameMatrix(center, axes, sizes) {
  const columns = axes.map((axis, k) => times(sizes[k], axis));
  const [a, b, c] = columns;
  // prettier-ignore
  return new THREE.Matrix4().set(
    a[0], b[0], c[0], center[0],
    a[1], b[1], c[1], center[1],
    a[2], b[2], c[2], center[2],
    0, 0, 0, 1,
  );
}

/** Frame of a body, as a group of the objects that are fixed to it. */
class Pose {
  constructor(stage, columns, pose) {
    this.columns = columns;
    this.pose = pose;
    this.stage = stage;
    this.group = new THREE.Group();
    this.axes = null;
  }

  update() {
    const r = minus(this.columns.vector(this.pose.r), this.stage.origin);
    const q = this.columns.quaternion(this.pose.q);
    this.group.position.set(r[0], r[1], r[2]);
    this.group.quaternion.set(q[1], q[2], q[3], q[0]);
  }

  /** Position in the world of a point that is fixed to the body, in double precision. */
  point(local) {
    return plus(this.columns.vector(this.pose.r), rotate(this.columns.quaternion(this.pose.q), local));
  }

  /** Show or hide the axes of the frame, which are created on first use. */
  showAxes(wanted) {
    if (wanted && !this.axes) {
      this.axes = tripod(0.07 * this.stage.extent);
      this.group.add(this.axes);
    }
    if (this.axes) this.axes.visible = wanted;
  }
}

class Solid {
  constructor(context, shape) {
    this.pose = context.poses[shape.pose];
    this.stage = context.stage;
    const { matrix, marks, middle, ratio } = Solid[shape.kind](shape);
    const { style } = shape;
    this.object = style ? turnedObject(context, shape, ratio) : new THREE.Mesh(unitGeometry(shape.kind), context.material(shape));
    this.object.matrixAutoUpdate = false;
    this.object.matrix.copy(matrix);
    this.marks = marks;
    this.middle = middle;
    this.pose.group.add(this.object);
  }

  static box(shape) {
    const matrix = frameMatrix(shape.center, shape.axes, shape.size);
    return { matrix, middle: shape.center, marks: [[0, 0, 0], [-0.5, 0, 0], [0.5, 0, 0]] };
  }

  static cylinder(shape) {
    const middle = lerp(shape.from, shape.to, 0.5);
    const matrix = cylinderMatrix(shape.from, shape.to, shape.diameter);
    const size = length(minus(shape.to, shape.from));
    const ratio = size > 0 ? shape.diameter / size : 0;
    return { matrix, middle, marks: [[0, 0, 0], [0, -0.5, 0], [0, 0.5, 0]], ratio };
  }

  static sphere(shape) {
    const size = shape.diameter;
    const matrix = frameMatrix(shape.center, [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [size, size, size]);
    return { matrix, middle: shape.center, marks: [[0, 0, 0]] };
  }

  static axle(shape) {
    const half = times(shape.length / 2, unit(shape.axis, [0, 0, 1]));
    return Solid.cylinder({
      from: minus(shape.center, half), to: plus(shape.center, half), diameter: shape.diameter,
    });
  }

  update() {}

  positions() {
    return this.marks.map((mark) => this.stage.toWorld(this.object, mark));
  }

  /** A function that returns the position of a point of the shape: the given point of the world, or its center. */
  anchor(touched) {
    const local = touched ? this.stage.toLocal(this.pose.group, touched) : this.middle;
    return () => this.pose.point(local);
  }
}
