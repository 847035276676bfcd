// Recorder of a film: one pass through the run at the current speed, as a WebM file.

class Recorder {
  constructor(clock, stage, name, changed) {
    Object.assign(this, { clock, stage, name, changed, media: null });
  }

  possible() {
    return Boolean(this.stage.renderer) && typeof MediaRecorder === "function" && MediaRecorder.isTypeSupported("video/webm");
  }

  toggle() {
    if (this.media) this.stop();
    else if (this.possible()) this.start();
  }

  start() {
    const { clock } = this;
    const canvas = this.stage.renderer.domElement;
    const pieces = [];
    this.media = new MediaRecorder(canvas.captureStream(30), { mimeType: "video/webm", videoBitsPerSecond: 8e6 });
    this.media.ondataavailable = (event) => pieces.push(event.data);
    this.media.onstop = () => this.save(new Blob(pieces, { type: "video/webm" }));
    this.looped = clock.loop;
    clock.loop = false;
    clock.ended = () => this.stop();
    clock.pause();
    clock.seek(clock.first);
    this.media.start();
    clock.play();
  }

  stop() {
    this.clock.loop = this.looped;
    this.clock.ended = null;
    this.clock.pause();
    // The recorder receives the last drawing with a delay.
    const { media } = this;
    setTimeout(() => media.state === "recording" && media.stop(), 150);
  }

  save(film) {
    this.media = null;
    this.film = film;
    const address = URL.createObjectURL(film);
    make("a", { href: address, download: `${this.name}.webm` }).click();
    setTimeout(() => URL.revokeObjectURL(address), 60000);
    this.changed();
  }
}
