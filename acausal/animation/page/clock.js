// Animation time: play, speed, single frames.

class Clock {
  constructor(runs, changed) {
    this.first = Math.min(...runs.map((run) => run.columns.first));
    this.last = Math.max(...runs.map((run) => run.columns.last));
    this.frames = Float64Array.from(new Set(runs.flatMap((run) => [...run.columns.time]))).sort();
    this.changed = changed;
    this.t = this.first;
    this.playing = false;
    this.loop = true;
    this.defaultSpeed = this.chooseSpeed();
    this.speed = this.defaultSpeed;
  }

  /** Default speed: real time if the run then takes 4 to 12 s, otherwise a round factor with which it takes about 5 to 10 s. */
  chooseSpeed() {
    const duration = this.last - this.first;
    if (!(duration > 0) || (duration >= 4 && duration <= 12)) return 1;
    return roundDown(duration / 4.999);
  }

  /** Set the next round speed, from 1/1000 to 100 or to the default speed if that is outside. */
  faster(sign) {
    const low = Math.min(1e-3, this.defaultSpeed);
    const high = Math.max(100, this.defaultSpeed);
    const around = [1, 2, 5, 10].map((digit) => digit * 10 ** Math.floor(Math.log10(this.speed) + 1e-9));
    const steps = [around[2] / 10, ...around];
    const close = 1e-6 * this.speed;
    const next = sign > 0 ? steps.find((s) => s > this.speed + close) : steps.findLast((s) => s < this.speed - close);
    this.setSpeed(clamp(next, low, high));
  }

  setSpeed(speed) {
    if (speed > 0 && Number.isFinite(speed)) this.speed = speed;
    this.changed();
  }

  seek(t) {
    if (Number.isFinite(t)) this.t = clamp(t, this.first, this.last);
    this.changed();
  }

  /** Move by `count` frames, backwards if negative. */
  step(count) {
    this.pause();
    const { frames } = this;
    let index = frames.findLastIndex((t) => t <= this.t);
    if (count < 0 && frames[index] < this.t) index += 1;
    this.seek(frames[clamp(index + count, 0, frames.length - 1)]);
  }

  play() {
    if (this.playing || this.last <= this.first) return;
    if (this.t >= this.last) this.t = this.first;
    this.playing = true;
    this.before = null;
    this.changed();
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  /** Advance by the real time since the last drawing. */
  tick(now) {
    if (!this.playing) return;
    // Browsers do not draw hidden pages: limit the step, so that time continues where it stopped.
    const elapsed = this.before === null ? 0 : Math.min((now - this.before) / 1000, 0.25);
    this.before = now;
    this.t += elapsed * this.speed;
    if (this.t >= this.last) {
      const duration = this.last - this.first;
      if (this.loop) this.t = this.first + ((this.t - this.first) % duration);
      else {
        this.t = this.last;
        this.playing = false;
      }
      this.ended?.();
    }
    this.changed();
  }
}
