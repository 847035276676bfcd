// Vectors are arrays of three numbers in double precision, quaternions (w, x, y, z).

const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (s, a) => [s * a[0], s * a[1], s * a[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(a[0], a[1], a[2]);
const lerp = (a, b, s) => [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])];
/** Entry of a list at s between e and e + 1; the only one of a list of one. */
const between = (list, e, s) => (list.length === 1 ? list[0] : list[e].map((x, j) => x + s * (list[e + 1][j] - x)));
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

function unit(a, otherwise = [1, 0, 0]) {
  const size = length(a);
  return size > 0 ? times(1 / size, a) : otherwise;
}

/** Unit vector normal to a unit vector, as near as possible to `wanted`. */
function perpendicular(axis, wanted) {
  if (wanted) {
    const rest = minus(wanted, times(dot(wanted, axis), axis));
    if (length(rest) > 1e-3 * length(wanted)) return unit(rest);
  }
  const least = axis.map(Math.abs).indexOf(Math.min(...axis.map(Math.abs)));
  const other = [0, 1, 2].map((k) => (k === least ? 1 : 0));
  return unit(minus(other, times(dot(other, axis), axis)));
}

/** Turn a vector as the shortest rotation from one direction to another does. */
function carry(v, from, to) {
  const [a, b] = [unit(from), unit(to)];
  const axis = cross(a, b);
  const turned = cross(axis, v);
  return plus(plus(v, turned), times(1 / Math.max(1 + dot(a, b), 1e-9), cross(axis, turned)));
}

/** Rotate a vector by a quaternion (w, u): v + 2 u x (u x v + w v). */
function rotate(q, v) {
  const u = [q[1], q[2], q[3]];
  return plus(v, times(2, cross(u, plus(cross(u, v), times(q[0], v)))));
}

/** Largest of 1, 2 and 5 times a power of ten that does not exceed a positive value. */
function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const digits = value / power;
  return power * (digits >= 5 - 1e-9 ? 5 : digits >= 2 - 1e-9 ? 2 : 1);
}

/** Format a number with the given number of significant digits. */
function formatNumber(value, digits = 4) {
  if (!Number.isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) {
    return value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e").replace(/-/g, "\u2212");
  }
  return String(Number(value.toPrecision(digits))).replace("-", "\u2212");
}
