// Pointer over the scene: shows the part under it and selects it by a click.

class Hover {
  constructor(stage, tip, chosen) {
    this.stage = stage;
    this.tip = tip;
    this.ray = new THREE.Raycaster();
    this.pressed = null;
    const element = $("glass");
    element.addEventListener("pointermove", (event) => {
      if (event.buttons) this.hide();
      else this.schedule(event);
    });
    element.addEventListener("pointerleave", () => this.hide());
    element.addEventListener("pointerdown", (event) => (this.pressed = [event.clientX, event.clientY]));
    element.addEventListener("pointerup", (event) => {
      if (!this.pressed) return;
      const moved = Math.hypot(event.clientX - this.pressed[0], event.clientY - this.pressed[1]);
      if (moved < 4) chosen(this.find(event));
    });
  }

  /** Search at most once for each drawing, with the latest event. */
  schedule(event) {
    const waiting = this.event;
    this.event = event;
    if (waiting) return;
    requestAnimationFrame(() => {
      const last = this.event;
      this.event = null;
      if (last) this.showTip(last);
    });
  }

  find(event) {
    const spot = this.stage.panelAt(event);
    if (!spot || !this.stage.renderer) return null;
    this.ray.setFromCamera(new THREE.Vector2(spot.x, spot.y), this.stage.camera);
    const objects = spot.panel.runs.flatMap((run) => run.items.map((item) => item.object)).filter((object) => object.visible);
    const hit = this.ray.intersectObjects(objects, true)[0];
    if (!hit) return null;
    const { run, index } = hit.object.userData;
    return { run, index, part: run.run.shapes[index].part, point: plus(hit.point.toArray(), this.stage.origin) };
  }

  showTip(event) {
    const found = this.find(event);
    const part = found && found.run.parts[found.part];
    if (!part) {
      this.hide();
      return;
    }
    const several = this.stage.runs.length > 1 ? `${found.run.name}: ` : "";
    this.tip.replaceChildren(make("b", { textContent: several + part.path }), make("span", { textContent: part.type }));
    this.tip.hidden = false;
    const box = this.stage.element.getBoundingClientRect();
    const right = clamp(event.clientX - box.left + 14, 0, Math.max(box.width - this.tip.offsetWidth - 6, 0));
    const down = clamp(event.clientY - box.top + 14, 0, Math.max(box.height - this.tip.offsetHeight - 6, 0));
    this.tip.style.transform = `translate(${right}px, ${down}px)`;
  }

  hide() {
    this.event = null;
    this.tip.hidden = true;
  }
}
