// Variables of the explorer: quantised numbers, unpacked once into columns.

class Series extends Columns {
  static async of({ time, series }) {
    const columns = new Series();
    const numbers = async (text) => new Float64Array(await unpack(text));
    columns.time = await numbers(time);
    columns.first = columns.time[0];
    columns.last = columns.time.at(-1);
    columns.offsets = new Map();
    columns.frames = columns.time.length;
    columns.varying = series.varying;
    const [low, step, constants] = await Promise.all([series.low, series.step, series.constants].map(numbers));
    columns.data = new Float64Array(columns.varying * columns.frames + constants.length);
    columns.data.set(constants, columns.varying * columns.frames);
    columns.fill(new Uint8Array(await unpack(series.codes)), low, step);
    columns.seek(columns.first);
    return columns;
  }

  /** Sum the differences of the codes three times; the low bytes of all come first, then the high bytes. */
  fill(bytes, low, step) {
    const count = this.varying * this.frames;
    for (let row = 0; row < this.varying; row++) {
      let [second, first, code] = [0, 0, 0];
      for (let i = row * this.frames; i < (row + 1) * this.frames; i++) {
        const small = bytes[i] + 256 * bytes[count + i];
        second += (small >> 1) ^ -(small & 1);
        first += second;
        code = (code + first) & 0xffff;
        this.data[i] = code === 0xffff ? NaN : low[row] + step[row] * code;
      }
    }
  }

  /** Linear, as the plots are drawn: cubics would overshoot where a variable jumps. */
  between(i, s) {
    return [0, 1 - s, s, 0];
  }

  /** Number of a variable among the columns; constants are numbered by complements. */
  column(number) {
    return number >= 0 ? number : this.varying + ~number;
  }
}
