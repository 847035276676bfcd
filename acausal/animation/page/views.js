// Camera: orbit, standard views, fit to the scene, following a part.

const VIEWS = ["front", "top", "right", "iso"];

class Views {
  constructor(stage, changed) {
    this.stage = stage;
    this.followed = null;
    const glass = $("glass");
    // Registered before OrbitControls, whose own handler zooms to the middle of the view.
    glass.addEventListener("wheel", (event) => this.zoom(event), { passive: false });
    this.controls = new THREE.OrbitControls(stage.camera, glass);
    this.moved = () => {
      stage.target = this.controls.target.toArray();
      this.name = null;
      changed();
    };
    this.controls.addEventListener("change", this.moved);
  }

  /** Direction from the scene to the camera in a standard view. */
  direction(name) {
    const { along, front } = this.stage.directions();
    const up = this.stage.up;
    const iso = unit(plus(plus(times(0.75, along), times(0.55, up)), front));
    // Exactly from above, the upward direction of the view would be undefined.
    return { front, right: along, top: unit(plus(up, times(1e-4, front))), iso }[name] ?? iso;
  }

  /** Name of the default view: face on for a flat scene, otherwise from a corner. */
  defaultView() {
    const sizes = minus(this.stage.high, this.stage.low);
    const thin = sizes.map((s) => s < 0.12 * this.stage.extent);
    const { along, front } = this.stage.directions();
    const flat = (axis) => axis.every((v, k) => Math.abs(v) < 1e-6 || thin[k]);
    if (flat(front)) return "front";
    if (flat(this.stage.up)) return "iso";
    return flat(along) ? "right" : "iso";
  }

  show(name) {
    this.placeCamera(this.direction(name));
    this.name = name;
  }

  /** Fit the whole scene into the view, without changing the direction. */
  fit() {
    this.placeCamera(unit(minus(this.stage.camera.position.toArray(), this.controls.target.toArray()), [0, 0, 1]));
  }

  /** Zoom with the wheel about the point under the pointer. */
  zoom(event) {
    event.preventDefault();
    event.stopImmediatePropagation();
    const { camera } = this.stage;
    const { target } = this.controls;
    const spot = this.stage.panelAt(event);
    if (!spot) return;
    // 5 % for 100 pixels. Wheels may report lines or pages, and pinches on a touch pad a tenth of the pixels (as ctrl + wheel).
    const pixels = event.deltaY * [1, 16, 100][event.deltaMode] * (event.ctrlKey ? 10 : 1);
    const scale = 0.95 ** (-pixels / 100);
    camera.updateMatrixWorld(); // several events may precede the next drawing
    const distance = camera.position.distanceTo(target);
    const ray = new THREE.Vector3(spot.x, spot.y, 0).unproject(camera).sub(camera.position).normalize();
    camera.position.addScaledVector(ray, distance * (1 - scale));
    camera.getWorldDirection(target).multiplyScalar(distance * scale).add(camera.position);
    this.controls.update();
    this.moved();
  }

  placeCamera(direction) {
    const { camera, up, extent } = this.stage;
    const { low, high } = this.stage.framedBox();
    const right = unit(cross(up, direction), [1, 0, 0]);
    const above = cross(direction, right);
    const tall = Math.tan((camera.fov * Math.PI) / 360) * 0.92;
    const wide = tall * camera.aspect;
    let distance = 0;
    const margin = 0.03 * extent;
    for (let k = 0; k < 8; k++) {
      const corner = [0, 1, 2].map((j) => ((k >> j) & 1 ? high[j] + margin : low[j] - margin));
      const depth = dot(corner, direction);
      distance = Math.max(distance, Math.abs(dot(corner, right)) / wide + depth, Math.abs(dot(corner, above)) / tall + depth);
    }
    const target = this.followed ? this.last : [0, 0, 0];
    this.controls.target.set(...target);
    camera.position.set(...plus(target, times(distance, direction)));
    this.controls.update();
    this.stage.target = target;
  }

  /** Follow a moving point with the camera; null stops. */
  follow(point) {
    this.followed = point;
    this.last = point && minus(point(), this.stage.origin);
  }

  followPart() {
    if (!this.followed) return;
    const now = minus(this.followed(), this.stage.origin);
    const step = new THREE.Vector3(...minus(now, this.last));
    this.last = now;
    if (step.lengthSq() === 0) return;
    this.controls.target.add(step);
    this.stage.camera.position.add(step);
    this.stage.target = this.controls.target.toArray();
    this.stage.camera.updateMatrixWorld();
  }
}
