// Renderer, camera, lights, ground, axes, and the panels of the runs.

class Stage {
  constructor(element, view) {
    this.element = element;
    // Positions are relative to the middle of the scene; the difference is formed in double precision.
    this.origin = lerp(view.low, view.high, 0.5);
    this.low = minus(view.low, this.origin);
    this.high = minus(view.high, this.origin);
    this.extent = length(minus(view.high, view.low)) || view.size || 1;
    this.up = unit(view.up, [0, 1, 0]);
    this.minRadius = 0.0025 * this.extent; // a few pixels thick when the whole scene is in view
    this.deformation = 1;
    this.arrowScale = {};
    this.show = { force: false, torque: false, grid: true, axes: true, frames: false };
    this.colours = new ColourScale();
    this.ghosts = false;
    this.runs = [];
    this.renders = 0;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 1000);
    this.camera.up.set(...this.up);
    this.scene.add(this.camera);
    this.addLights();
    this.addGround();
    this.renderer = this.open();
  }

  /** Create the renderer; null without WebGL, and where there is nothing to draw. */
  open() {
    if (this.element.hidden) return null;
    try {
      const canvas = document.createElement("canvas");
      // Checked first: without WebGL the renderer reports an error on the console.
      if (!canvas.getContext("webgl2", { antialias: true, alpha: false })) return null;
      const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
      renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
      renderer.autoClear = false;
      renderer.outputEncoding = THREE.sRGBEncoding;
      renderer.physicallyCorrectLights = true; // irradiance as given, not multiplied by pi
      this.element.prepend(canvas);
      return renderer;
    } catch {
      return null;
    }
  }

  addLights() {
    this.scene.add(new THREE.HemisphereLight("#ffffff", linear("#aab2be"), 1.9));
    // Fixed to the camera, from above on the left, so that no visible side is dark.
    const sun = new THREE.DirectionalLight("#ffffff", 2.2);
    sun.position.set(-0.6, 1, 0.9);
    this.camera.add(sun, sun.target);
    sun.target.position.set(0, 0, -0.2);
  }

  /** Add the grid of the ground and the axes of the world. */
  addGround() {
    this.ground = new THREE.Group();
    this.scene.add(this.ground);
    const { along, front } = this.directions();
    const step = roundDown(this.extent / 8);
    const floor = this.groundLevel(step);
    // The grid covers the vertical projection of the scene and a margin, in whole spacings from the origin of the world.
    const world = times(-1, this.origin);
    const ranges = [along, front].map((axis) => {
      const half = Math.max(this.halfExtent(axis), 0.3 * this.extent) + 2 * step;
      const offset = dot(world, axis);
      return [Math.floor((-half - offset) / step), Math.ceil((half - offset) / step)];
    });
    const thin = [];
    const thick = [];
    const point = (i, j) => plus(plus(world, times(floor, this.up)), plus(times(i * step, along), times(j * step, front)));
    for (let i = ranges[0][0]; i <= ranges[0][1]; i++) {
      (i % 5 === 0 ? thick : thin).push(...point(i, ranges[1][0]), ...point(i, ranges[1][1]));
    }
    for (let j = ranges[1][0]; j <= ranges[1][1]; j++) {
      (j % 5 === 0 ? thick : thin).push(...point(ranges[0][0], j), ...point(ranges[0][1], j));
    }
    this.gridLines = [thin, thick].map((list, k) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(list), 3));
      const material = new THREE.LineBasicMaterial({ transparent: true, opacity: k ? 0.55 : 0.28 });
      const lines = new THREE.LineSegments(geometry, material);
      lines.frustumCulled = false;
      this.ground.add(lines);
      return lines;
    });
    this.corners = [[0, 0], [0, 1], [1, 0], [1, 1]].map(([a, b]) => point(ranges[0][a], ranges[1][b]));
    this.axes = tripod(0.08 * this.extent);
    this.axes.position.set(...world);
    this.scene.add(this.axes);
  }

  /** Box to fit into the view: the scene, and the axes of the world if these are visible and near it. */
  framedBox() {
    const world = times(-1, this.origin);
    const near = world.every((v, k) => v > this.low[k] - 0.05 * this.extent && v < this.high[k] + 0.05 * this.extent);
    if (!near || !this.show.axes) return this;
    return { low: this.low, high: this.high.map((v, k) => Math.max(v, world[k] + 0.08 * this.extent)) };
  }

  /** Half of the extent of the scene along an axis. */
  halfExtent(axis) {
    return [0, 1, 2].reduce((sum, k) => sum + Math.abs(axis[k]) * this.high[k], 0);
  }

  /** Height of the grid above the origin of the world: 0, or negative below a scene that extends further down. */
  groundLevel(step) {
    const lowest = dot(this.origin, this.up) - this.halfExtent(this.up);
    return lowest < -1e-3 * this.extent ? step * Math.floor(lowest / step + 1e-9) : 0;
  }

  /** Directions to the right and towards the viewer in the front view: x and z if y is up, x and -y if z is up. */
  directions() {
    const along = perpendicular(this.up, [1, 0, 0]);
    return { along, front: cross(along, this.up) };
  }

  /** World coordinates of a point of a drawn object. */
  toWorld(object, mark) {
    const p = new THREE.Vector3(mark[0], mark[1], mark[2]).applyMatrix4(object.matrixWorld);
    return plus([p.x, p.y, p.z], this.origin);
  }

  /** Coordinates of a point of the world in a group. */
  toLocal(group, point) {
    const p = new THREE.Vector3(...minus(point, this.origin)).applyMatrix4(group.matrixWorld.clone().invert());
    return [p.x, p.y, p.z];
  }

  /** Panels of the view: rectangles in fractions of the view, from the top left, and their runs. */
  panels() {
    const n = this.runs.length;
    if (this.ghosts || n < 2) return [{ x: 0, y: 0, width: 1, height: 1, runs: this.runs }];
    const { clientWidth, clientHeight } = this.element;
    // Number of columns for which the aspect ratio of a panel is nearest to that of the scene in the front view.
    const { along } = this.directions();
    const shape = clamp(this.halfExtent(along) / this.halfExtent(this.up) || 1, 0.5, 2);
    const rowsOf = (columns) => Math.ceil(n / columns);
    const unlike = (columns) => Math.abs(Math.log((clientWidth * rowsOf(columns)) / (columns * clientHeight * shape)));
    const columns = this.runs.map((_, k) => k + 1).reduce((best, next) => (unlike(next) < unlike(best) ? next : best));
    const rows = rowsOf(columns);
    return this.runs.map((run, k) => ({
      x: (k % columns) / columns, y: Math.floor(k / columns) / rows, width: 1 / columns, height: 1 / rows, runs: [run],
    }));
  }

  /** The panel under the pointer, and the pointer's normalised device coordinates in it, -1 ... 1. */
  panelAt(event) {
    const box = this.element.getBoundingClientRect();
    const [u, v] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    const panel = this.panels().find((p) => u >= p.x && u < p.x + p.width && v >= p.y && v < p.y + p.height);
    return panel && { panel, x: (2 * (u - panel.x)) / panel.width - 1, y: 1 - (2 * (v - panel.y)) / panel.height };
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    const [panel] = this.panels();
    this.camera.aspect = Math.max(width * panel.width, 1) / Math.max(height * panel.height, 1);
    this.renderer?.setSize(width, height, false);
  }

  applyTheme() {
    const style = getComputedStyle(document.documentElement);
    // three.js writes the background without conversion to sRGB.
    this.scene.background = new THREE.Color(style.getPropertyValue("--sky").trim());
    for (const lines of this.gridLines) lines.material.color.copy(linear(style.getPropertyValue("--grid").trim()));
  }

  /** Set the clipping planes around the scene, the near one as far away as possible, for the resolution of depth. */
  setClippingPlanes() {
    const { camera } = this;
    const ahead = camera.getWorldDirection(new THREE.Vector3()).toArray();
    const here = camera.position.toArray();
    const reach = this.extent * Math.max(1, Math.min(this.deformation, 30) / 10);
    const depths = this.corners.map((p) => dot(minus(p, here), ahead));
    const middle = dot(minus([0, 0, 0], here), ahead);
    camera.far = Math.max(...depths, middle + reach, 1e-3 * this.extent) * 1.05;
    const distance = length(minus(here, this.target ?? [0, 0, 0]));
    camera.near = clamp(Math.min(...depths, middle - reach) * 0.9, 0.02 * distance, 0.5 * camera.far);
    camera.updateProjectionMatrix();
  }

  render() {
    this.renders += 1;
    this.ground.visible = this.show.grid;
    this.axes.visible = this.show.axes;
    if (!this.renderer) return;
    this.setClippingPlanes();
    const { clientWidth: width, clientHeight: height } = this.element;
    this.renderer.setScissorTest(false);
    this.renderer.setClearColor(this.scene.background);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    for (const panel of this.panels()) {
      for (const run of this.runs) run.group.visible = panel.runs.includes(run);
      const place = [panel.x * width, (1 - panel.y - panel.height) * height, panel.width * width, panel.height * height];
      this.renderer.setViewport(...place);
      this.renderer.setScissor(...place);
      this.renderer.clear();
      this.renderer.render(this.scene, this.camera);
    }
    for (const run of this.runs) run.group.visible = true;
  }
}
