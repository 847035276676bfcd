// Numbers of the document: decompressed once, interpolated by cubics between the frames.

/** Decode base64 and decompress zlib. */
async function unpack(text) {
  if (typeof DecompressionStream !== "function") throw new Error("the browser is too old to unpack its numbers.");
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/**
 * All columns of one run.
 *
 * A value between two frames is the cubic through both with the slopes of the parabolas through three frames. It is linear
 * in the values of four frames, so that one set of four weights serves every column. No weight reaches across equal times:
 * these are the two sides of a jump.
 */
class Columns {
  static async of(run) {
    const columns = new Columns();
    columns.time = new Float64Array(await unpack(run.time));
    columns.data = new Float32Array(await unpack(run.data));
    columns.offsets = new Map(Object.entries(run.offsets ?? {}).map(([k, offset]) => [Number(k), offset]));
    columns.frames = run.frames;
    columns.varying = run.varying;
    columns.first = columns.time[0];
    columns.last = columns.time[run.frames - 1];
    columns.seek(columns.first);
    return columns;
  }

  /** Index of the last frame at or before a time. */
  frameAt(t) {
    let [low, high] = [0, this.frames];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.time[middle] <= t) low = middle;
      else high = middle;
    }
    return low;
  }

  seek(t) {
    const i = this.frameAt(t);
    this.frame = i;
    const span = i + 1 < this.frames ? this.time[i + 1] - this.time[i] : 0;
    const s = span > 0 ? Math.max((t - this.time[i]) / span, 0) : 0;
    this.weights = s > 0 ? this.between(i, s, span) : [0, 1, 0, 0];
  }

  /** Weights of the frames i - 1 ... i + 2 at the fraction s of the interval from i to i + 1. */
  between(i, s, span) {
    const before = i > 0 ? this.time[i] - this.time[i - 1] : 0;
    const after = i + 2 < this.frames ? this.time[i + 2] - this.time[i + 1] : 0;
    // Slopes times the length of the interval, as weights of the four frames.
    let begin = before > 0 && slopeWeights(before, span).map((w) => w * span);
    let end = after > 0 && slopeWeights(span, after).map((w) => w * span);
    begin = begin && [...begin, 0];
    end = end && [0, ...end];
    const chord = [0, -1, 1, 0];
    // With a neighbouring interval on one side only the interpolation is the parabola, with none it is linear.
    begin ||= end ? chord.map((c, k) => 2 * c - end[k]) : chord;
    end ||= chord.map((c, k) => 2 * c - begin[k]);
    const [h10, h01, h11] = [s * (1 - s) ** 2, s * s * (3 - 2 * s), s * s * (s - 1)];
    return [0, 1 - h01, h01, 0].map((w, k) => w + h10 * begin[k] + h11 * end[k]);
  }

  at(k) {
    return this.stored(k) + (this.offsets.get(k) ?? 0); // the weights of the frames add up to 1
  }

  /** Interpolated value of a column without its offset. */
  stored(k) {
    if (k >= this.varying) return this.data[this.varying * this.frames + (k - this.varying)];
    const place = k * this.frames + this.frame;
    const w = this.weights;
    let value = w[1] * this.data[place];
    if (w[0] !== 0) value += w[0] * this.data[place - 1];
    if (w[2] !== 0) value += w[2] * this.data[place + 1];
    if (w[3] !== 0) value += w[3] * this.data[place + 2];
    return value;
  }

  vector(ks) {
    return [this.at(ks[0]), this.at(ks[1]), this.at(ks[2])];
  }

  /** Unit quaternion; its columns are continuous in sign and therefore interpolated separately. */
  quaternion(ks) {
    const q = ks.map((k) => this.at(k));
    const size = Math.hypot(...q);
    return size > 0 ? q.map((v) => v / size) : [1, 0, 0, 0];
  }

  /** All values of a column: one for each frame, or a single one if it is constant. */
  series(k) {
    const varies = k < this.varying;
    const first = varies ? k * this.frames : this.varying * this.frames + (k - this.varying);
    const kept = this.data.subarray(first, first + (varies ? this.frames : 1));
    const offset = this.offsets.get(k);
    return offset === undefined ? kept : Float64Array.from(kept, (v) => v + offset);
  }
}

/** Weights of three values for the slope of their parabola at the middle one; step sizes are positive. */
function slopeWeights(before, after) {
  const whole = before + after;
  return [-after / (before * whole), (after - before) / (before * after), before / (after * whole)];
}
