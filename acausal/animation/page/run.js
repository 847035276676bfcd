// One run: its columns, its poses, and one item for each shape.

class Run {
  static async of(stage, run, number, looks = {}) {
    const created = new Run();
    Object.assign(created, { stage, run, number, looks, name: run.name, stopped: run.stopped, parts: run.parts });
    created.columns = await Columns.of(run);
    created.group = new THREE.Group();
    created.poses = run.poses.map((pose) => new Pose(stage, created.columns, pose));
    for (const pose of created.poses) created.group.add(pose.group);
    created.materials = [];
    created.items = [];
    for (const shape of run.shapes) created.items.push(await created.item(shape));
    created.items.forEach((item, index) => {
      item?.object.traverse((object) => (object.userData = { run: created, index }));
    });
    created.grounded = run.shapes.some((shape) => shape.kind === "ground");
    stage.scene.add(created.group);
    return created;
  }

  item(shape) {
    const kinds = { curve: Curve, span: Span, trail: Trail, arrow: Arrow, box: Solid, cylinder: Solid, sphere: Solid, axle: Solid };
    if (shape.kind === "ground") return { update() {}, positions: () => [], object: new THREE.Group(), anchor: null };
    if (shape.kind === "mesh") return Skin.of(this, shape);
    return new kinds[shape.kind](this, shape);
  }

  colour(shape) {
    return shape.color ?? "#888888";
  }

  /** Material of a shape; tubes and surfaces have vertex colours. */
  material(shape, more = {}) {
    const plain = more.vertexColors ? "#ffffff" : this.colour(shape);
    const material = new THREE.MeshPhongMaterial({ color: linear(plain), specular: linear("#1c1c1c"), shininess: 25, ...more });
    this.materials.push({ material, plain, painted: Boolean(more.vertexColors) });
    return material;
  }

  /** Draw all runs except the first as ghosts: transparent, each in one colour. */
  showGhosts(ghosts) {
    const ghost = ghosts && this.number > 0;
    for (const { material, plain, painted } of this.materials) {
      const coloured = painted && this.stage.colours.active;
      material.vertexColors = painted && (!ghost || coloured);
      material.color.copy(linear(ghost && !coloured ? GHOST[this.number % GHOST.length] : plain));
      material.transparent = ghost;
      material.opacity = ghost ? 0.42 : 1;
      material.depthWrite = !ghost;
      material.needsUpdate = true;
    }
  }

  update(t) {
    this.columns.seek(t);
    for (const pose of this.poses) pose.update();
    for (const item of this.items) item.update();
  }

  /** A function that returns the position of a part's anchor at the current time of the columns, or null. */
  anchorOf(part, touched = null, index = -1) {
    const item = index >= 0 ? this.items[index] : this.items.find((one, k) => one.anchor && this.run.shapes[k].part === part);
    return item?.anchor ? item.anchor(touched) : null;
  }
}
