// Tree of the parts: variables, entries of arrays, parameters and events, with a filter.

const MOST_ROWS = 500;

/** A row of the tree: a part, a variable, an entry, a text or an event. */
class TreeNode {
  constructor(parent, name, more = {}) {
    Object.assign(this, { parent, name, about: "", unit: "", children: [], open: false, ...more });
    this.level = parent ? parent.level + 1 : 0;
    this.path = more.path ?? (parent?.path ? `${parent.path}.${name}` : name);
    this.words = `${this.path} ${this.about} ${this.type ?? ""}`.toLowerCase();
  }

  /** TreeNode of a part with everything in it. */
  static part(part, parent = null) {
    const node = new TreeNode(parent, part.name, { type: part.type, about: part.about ?? "", ...(parent ? {} : { path: "" }) });
    for (const one of part.variables ?? []) node.children.push(TreeNode.variable(one, node));
    for (const one of part.parts ?? []) node.children.push(TreeNode.part(one, node));
    for (const one of part.parameters ?? []) node.children.push(TreeNode.variable(one, node, true));
    return node;
  }

  static variable({ name, about, unit = "", shape = [], columns, value }, parent, parameter = false) {
    const units = Array.isArray(unit) ? unit : null;
    const node = new TreeNode(parent, name, { about, value, parameter, unit: units ? "" : unit });
    if (columns && !shape.length) node.column = columns[0];
    if (shape.length) {
      node.shape = shape;
      node.children = columns.map((column, k) => {
        const index = shape.length === 1 ? [k] : [Math.floor(k / shape[1]), k % shape[1]];
        const label = `[${index.join(",")}]`;
        return new TreeNode(node, label, { path: node.path + label, about, unit: units ? units[k] : unit, column, parameter });
      });
    }
    return node;
  }

  /** This node and all below it. */
  *all() {
    yield this;
    for (const child of this.children) yield* child.all();
  }

  leaf() {
    return !this.children.length;
  }
}

class Tree {
  constructor(element, root, columns, act) {
    Object.assign(this, { element, root, columns, act });
    root.open = true;
    this.colours = new Map();
    this.found = null;
    this.current = root.children[0];
    this.filter = $("filter");
    this.filter.addEventListener("input", () => this.search());
    this.filter.addEventListener("keydown", (event) => event.key === "ArrowDown" && this.move(event, 0));
    element.addEventListener("click", (event) => this.press(this.nodeOf(event)));
    element.addEventListener("keydown", (event) => this.key(event));
    // Keys and clicks here are not those of the animation.
    for (const kind of ["keydown", "click"]) $("explorer").addEventListener(kind, (event) => event.stopPropagation());
    this.draw();
  }

  nodeOf(event) {
    return this.rows[Number(event.target.closest("[role=treeitem]")?.dataset.row ?? -1)]?.node;
  }

  /** Visible nodes in their order: open ones or, with a filter, those that lead to a match. */
  visible() {
    const list = [];
    const add = (node) => {
      for (const child of node.children) {
        if (this.found && !this.found.has(child)) continue;
        list.push(child);
        if (this.isOpen(child)) add(child);
      }
    };
    add(this.root);
    return list;
  }

  isOpen(node) {
    return this.found?.get(node) ?? node.open;
  }

  /** Show what contains all words of the filter, and the parts that it is in. */
  search() {
    const words = this.filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    const matchers = words.map((word) => new RegExp(word.replace(/[.+^${}()|[\]\\]/g, "\\$&").replace(/\*/g, ".*").replace(/\?/g, ".")));
    const named = (node) => matchers.every((one) => one.test(node.words));
    this.found = words.length ? new Map() : null;
    let count = 0;
    const visit = (node) => {
      const entries = Boolean(node.shape);
      const hits = entries && named(node) ? [] : node.children.filter(visit);
      const hit = named(node);
      if (hit && !hits.length) count += node.leaf() || entries ? 1 : 0;
      if (hit && !hits.length) for (const inner of node.all()) this.found.set(inner, false);
      if (hits.length) this.found.set(node, true);
      return hit || hits.length > 0;
    };
    if (this.found) visit(this.root);
    $("found").textContent = this.found ? `${count} found` : "";
    this.draw();
  }

  draw() {
    const nodes = this.visible();
    const shown = nodes.slice(0, MOST_ROWS);
    if (!shown.includes(this.current)) this.current = shown[0];
    this.rows = shown.map((node, k) => this.row(node, k));
    const more = nodes.length - shown.length;
    this.element.replaceChildren(
      ...this.rows.map((row) => row.element),
      ...(more ? [make("p", { className: "hint", textContent: `${more} more: use the filter.` })] : []),
    );
    this.update();
  }

  row(node, k) {
    const open = this.isOpen(node);
    const mark = make("span", { className: node.leaf() ? "mark" : "twist" });
    const name = make("span", { className: "name", textContent: node.name });
    const value = make("span", { className: "value", textContent: node.value ?? node.count ?? node.type ?? "" });
    const element = make("div", { title: this.tip(node), tabIndex: node === this.current ? 0 : -1 }, [mark, name, value]);
    element.setAttribute("role", "treeitem");
    element.setAttribute("aria-level", node.level);
    if (!node.leaf()) element.setAttribute("aria-expanded", String(open));
    else if (node.column !== undefined) element.setAttribute("aria-selected", String(this.colours.has(node.path)));
    element.dataset.row = k;
    element.dataset.path = node.path;
    element.classList.toggle("parameter", Boolean(node.parameter));
    element.classList.toggle("event", node.time !== undefined);
    element.style.setProperty("--level", node.level - 1);
    const colour = this.colours.get(node.path);
    if (colour) mark.style.background = colour;
    return { node, element, value };
  }

  tip(node) {
    const unit = node.unit && node.unit !== "1" ? ` [${node.unit}]` : "";
    const lines = node.time === undefined ? [node.path + unit, node.about] : [node.name, node.value];
    return lines.filter(Boolean).join("\n");
  }

  /** Show the values at the current time. */
  update() {
    for (const { node, value } of this.rows) {
      const text = this.reading(node);
      if (text !== null && value.textContent !== text) value.textContent = text;
    }
  }

  /** Value of a scalar or a short vector at the current time, size of another array; null for other rows. */
  reading(node) {
    const number = (one, digits) => formatNumber(this.columns.at(this.columns.column(one.column)), digits);
    if (node.column !== undefined) return number(node, 4) + unitText(node.unit);
    if (!node.shape) return null;
    if (node.children.length > 3) return node.shape.join(" \u00d7 ");
    return `[${node.children.map((one) => number(one, 3)).join(", ")}]${unitText(node.unit)}`;
  }

  press(node) {
    if (!node) return;
    this.current = node;
    if (!node.leaf()) this.open(node, !this.isOpen(node));
    else this.act(node);
    this.focus();
  }

  open(node, wanted) {
    if (this.found) this.found.set(node, wanted);
    else node.open = wanted;
    this.draw();
  }

  /** Mark what is plotted, with the colours of the curves. */
  mark(colours) {
    this.colours = colours;
    this.draw();
  }

  /** Open the tree at a part. */
  reveal(path) {
    const node = [...this.root.all()].find((one) => one.path === path && one.type);
    if (!node) return;
    this.filter.value = "";
    this.found = null;
    for (let one = node; one; one = one.parent) one.open = true;
    this.current = node;
    this.draw();
    this.rows.find((row) => row.node === node)?.element.scrollIntoView({ block: "nearest" });
  }

  focus() {
    this.rows.find((row) => row.node === this.current)?.element.focus();
  }

  /** Go to a row by number. */
  move(event, k) {
    event.preventDefault();
    this.current = this.rows[clamp(k, 0, this.rows.length - 1)]?.node;
    for (const { node, element } of this.rows) element.tabIndex = node === this.current ? 0 : -1;
    this.focus();
  }

  key(event) {
    const node = this.nodeOf(event);
    if (!node || event.ctrlKey || event.metaKey || event.altKey) return;
    const k = this.rows.findIndex((row) => row.node === node);
    const open = !node.leaf() && this.isOpen(node);
    const actions = {
      ArrowDown: () => this.move(event, k + 1),
      ArrowUp: () => (k ? this.move(event, k - 1) : this.filter.focus()),
      Home: () => this.move(event, 0),
      End: () => this.move(event, this.rows.length - 1),
      ArrowRight: () => (open || node.leaf() ? this.move(event, k + 1) : this.press(node)),
      ArrowLeft: () => (open ? this.press(node) : this.move(event, this.rows.findIndex((row) => row.node === node.parent))),
      Enter: () => this.press(node),
      " ": () => this.press(node),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }
}

const unitText = (unit) => (unit && unit !== "1" ? ` ${unit}` : "");
