// Letters at the axes of the world, in every panel.

class AxisNames {
  constructor(stage, element) {
    Object.assign(this, { stage, element });
  }

  update() {
    const { stage, element } = this;
    const panels = stage.renderer && stage.show.axes ? stage.panels() : [];
    if (element.childElementCount !== 3 * panels.length) {
      element.replaceChildren(...panels.flatMap(() => ["x", "y", "z"].map((textContent) => make("span", { textContent }))));
    }
    const { clientWidth, clientHeight } = stage.element;
    const place = new THREE.Vector3();
    [...element.children].forEach((letter, k) => {
      const panel = panels[Math.floor(k / 3)];
      // Just beyond the tip of the arrow.
      place.set(0, 0, 0).setComponent(k % 3, 0.096 * stage.extent);
      place.add(stage.axes.position).project(stage.camera);
      const [x, y] = [(place.x + 1) / 2, (1 - place.y) / 2];
      const within = x > 0 && x < 1 && y > 0 && y < 1 && place.z < 1;
      letter.hidden = !within;
      letter.style.transform = `translate(${(panel.x + x * panel.width) * clientWidth}px, ${(panel.y + y * panel.height) * clientHeight}px)`;
    });
  }
}
