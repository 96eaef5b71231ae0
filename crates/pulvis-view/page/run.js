// The frames of a run: particles in space, time below, series below that.

import { button } from "./controls.js";
import { Camera, VIEWS } from "./camera.js";
import { Chart } from "./chart.js";
import { element, number, quantity, unitText } from "./format.js";
import { LookPanel, NAMES } from "./look.js";
import { Scene } from "./spheres.js";
import { Video } from "./video.js";

/** How often a run is asked whether it has grown [ms]. */
const PATIENCE = 1500;

/** A run that has not grown for so long is not called live [ms]. */
const QUIET = 20000;

/** Frames per second of a film. */
const RATE = 12;

/** Walls that are so many times larger than the bed are not looked at as a whole. */
const LARGE_WALLS = 3;

/** A moving picture that takes longer is drawn more coarsely [ms]. */
const SLOW = 80;

/** The coarsest picture, in pixels to the pixel. */
const COARSEST = 0.3;

/** Radius of the thickest tube, in radii of a particle. */
const TUBE = 0.25;

/** Units of what every frame has, where the run does not say. */
const UNITS = { radius: "m", v: "m/s", omega: "rad/s", f: "N", torque: "N m", mass: "kg", stress: "Pa", stored_energy: "J", kinetic_translation: "J", kinetic_rotation: "J", coordination: "1", id: "1", type: "1" };

export class RunView {
  constructor(source, run) {
    Object.assign(this, { source, run });
    this.camera = new Camera();
    this.look = { number: 0, column: "v", map: "viridis", scale: 1, contacts: false, walls: true, clip: "none", cut: 50, range: null, chosen: -1 };
    this.grown = -Infinity;
    this.quality = 1;
    this.before = -Infinity;
    this.build();
  }

  build() {
    this.canvas = element("canvas", { tabindex: 0, "aria-label": "particles; drag to turn, shift and drag to move, wheel to zoom, click for values", role: "application" });
    this.corner = element("div", { class: "corner" });
    this.video = new Video(this);
    this.panel = new LookPanel(this);
    this.bar = this.panel.bar;
    this.picked = element("div", { class: "picked", hidden: true, role: "status" });
    this.message = element("div", { class: "message", role: "alert", hidden: true });
    this.viewport = element("div", { class: "viewport" }, this.canvas, this.corner, this.bar, this.picked);
    this.slider = element("input", { type: "range", min: 0, max: 0, value: 0, "aria-label": "frame", oninput: () => this.go(Number(this.slider.value)) });
    this.clock = element("output", {});
    this.playing = button("play", () => this.play(), { "aria-pressed": false });
    this.chart = new Chart({ title: "Time series", x: { label: "time t", unit: "s", tight: true }, y: { label: "", unit: "1" }, pick: (time) => this.goTo(time) });
    this.below = element("div", { class: "below" }, this.chart.root);
    const player = element("div", { class: "player" }, this.playing, this.slider, this.clock);
    this.root = element("section", { class: "run", id: "run" }, this.panel.root, element("div", { class: "stage" }, this.message, this.viewport, player, this.below));
    try {
      this.scene = new Scene(this.canvas);
    } catch (error) {
      this.complain(error);
      return;
    }
    this.camera.listen(this.canvas, () => this.render(true), (x, y) => this.pick(x, y));
    this.root.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.render()).observe(this.canvas);
  }

  async open(hash) {
    if (!this.scene) return;
    const { times } = this.run;
    for (const key of ["column", "map", "clip"]) if (hash.has(key)) this.look[key] = hash.get(key);
    this.scene.setMap(this.look.map);
    if (hash.get("walls") === "0") this.look.walls = false;
    if (hash.has("contacts")) Object.assign(this.look, { contacts: true, scale: 0.35 });
    const wanted = hash.has("frame") ? Number(hash.get("frame")) : times.length - 1;
    this.follow = !hash.has("frame");
    await this.loadSeries("kinetic");
    if (times.length === 0) this.wait();
    else {
      await this.go(Math.min(Math.max(wanted, 0), times.length - 1));
      this.fit();
      if (hash.has("camera")) this.camera.read(hash.get("camera"));
    }
    this.panel.build();
    this.render();
    if (this.source.live) this.poll();
  }

  /** A run that has not written anything yet. */
  wait() {
    this.corner.textContent = "no frames yet";
  }

  // Frames

  async go(index) {
    this.wanted = index;
    if (this.loading || this.video.recording) return;
    this.loading = true;
    try {
      while (this.wanted !== null) {
        const number = this.wanted;
        this.wanted = null;
        await this.load(number);
      }
      this.complain(null);
    } catch (error) {
      this.complain(error);
    } finally {
      this.loading = false;
    }
  }

  /** A frame for a film, after those that are on their way. */
  async frameOf(number) {
    while (this.loading) await new Promise((resolve) => setTimeout(resolve, 10));
    await this.load(number);
  }

  async load(number) {
    const { look } = this;
    const columns = this.frame?.columns;
    if (columns && !columns.some((one) => one.name === look.column)) look.column = columns.some((one) => one.name === "v") ? "v" : columns[0].name;
    let frame;
    try {
      frame = await this.source.frame(number, look.column);
    } catch {
      // The column of an old address may not be there.
      look.column = "radius";
      frame = await this.source.frame(number, look.column);
    }
    this.frame = frame;
    look.number = number;
    this.scene.setFrame(frame);
    if (look.contacts) this.scene.setContacts(await this.source.contacts(number));
    this.slider.max = this.run.times.length - 1;
    this.slider.value = number;
    this.ends();
    if (look.chosen >= frame.particles) this.unpick();
    else if (look.chosen >= 0) this.tell(look.chosen);
    this.render();
    this.mark();
  }

  /** The range of colours: as given, or that of the frame. */
  ends() {
    const { values } = this.frame;
    let [low, high] = [Infinity, -Infinity];
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    if (!(low <= high)) [low, high] = [0, 1];
    if (this.look.map === "blue-red") {
      const most = Math.max(Math.abs(low), Math.abs(high));
      [low, high] = [-most, most];
    }
    this.own = [low, high];
    this.range = this.look.range ?? this.own;
    this.panel.legend();
  }

  goTo(time) {
    let best = 0;
    this.run.times.forEach((one, index) => {
      if (Math.abs(one - time) < Math.abs(this.run.times[best] - time)) best = index;
    });
    this.follow = false;
    this.go(best);
  }

  pause() {
    if (this.playing.getAttribute("aria-pressed") === "true") this.play();
  }

  play() {
    const on = this.playing.getAttribute("aria-pressed") !== "true";
    this.playing.setAttribute("aria-pressed", on);
    this.playing.textContent = on ? "pause" : "play";
    clearInterval(this.ticking);
    if (!on) return;
    if (this.look.number >= this.run.times.length - 1) this.go(0);
    this.ticking = setInterval(() => {
      if (this.loading) return;
      const next = this.look.number + 1;
      if (next < this.run.times.length) this.go(next);
      else if (!this.isLive()) this.play();
    }, 1000 / RATE);
  }

  isLive() {
    return performance.now() - this.grown < QUIET;
  }

  // A run that goes on

  poll() {
    setTimeout(async () => {
      try {
        if (!document.hidden) await this.refresh();
      } catch (error) {
        this.complain(error);
      }
      this.poll();
    }, PATIENCE);
  }

  async refresh() {
    const run = await this.source.run();
    const before = this.run.times.length;
    const rows = this.rows;
    await this.loadSeries(this.quantityName);
    if (run.times.length > before || this.rows > rows) this.grown = performance.now();
    this.run = run;
    this.slider.max = Math.max(run.times.length - 1, 0);
    if (run.times.length > before) {
      if (before === 0) {
        await this.go(0);
        this.fit();
        this.panel.build();
      }
      if (this.follow || before === 0) await this.go(run.times.length - 1);
    }
    this.say();
  }

  // Series

  async loadSeries(name) {
    try {
      this.quantityName = name;
      const answer = await this.source.series(["time", name]);
      this.names = answer.names;
      this.rows = answer.rows;
      this.series = { time: answer.columns.time ?? [], values: answer.columns[name] ?? [] };
    } catch {
      this.series = { time: [], values: [] };
      this.names = [];
    }
    this.mark();
  }

  describe(file, name) {
    const found = this.run.fields?.find((one) => one.file === file && (one.field === name || one.columns === name || String(one.columns).split(/[ ,]+/).includes(name)));
    return { meaning: found?.meaning, unit: found?.unit ?? (file === "timeseries.csv" ? "1" : (UNITS[name] ?? "1")) };
  }

  mark() {
    if (!this.series) return;
    const { meaning, unit } = this.describe("timeseries.csv", this.quantityName);
    const words = this.quantityName.replaceAll("_", " ");
    const style = getComputedStyle(document.documentElement);
    this.chart.show({
      title: meaning ? `${words}: ${meaning}` : words,
      y: { label: words, unit },
      series: [{ x: this.series.time, y: this.series.values, colour: style.getPropertyValue("--series-A").trim() }],
      markers: this.frame ? [{ x: this.frame.time }] : [],
      note: "the run has no time series yet",
    });
  }

  say() {
    if (!this.frame) return;
    const { times } = this.run;
    this.clock.textContent = `frame ${this.look.number + 1} of ${times.length}, t = ${quantity(this.frame.time, "s", 5)}`;
    const live = this.source.live && this.isLive() ? [" · ", element("span", { class: "live" }, "live")] : [];
    this.corner.replaceChildren(`${this.frame.particles} particles, ${this.frame.contacts} contacts`, ...live, this.run.alarm ? " · stopped by an alarm" : "");
  }

  // Drawing

  box() {
    const { positions, radii, walls, wallRadii } = this.frame;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    const take = (place, axis, size) => {
      if (place - size < low[axis]) low[axis] = place - size;
      if (place + size > high[axis]) high[axis] = place + size;
    };
    for (let row = 0; row < radii.length; row += 1) for (let axis = 0; axis < 3; axis += 1) take(positions[3 * row + axis], axis, radii[row]);
    // Walls belong to the picture unless they are much larger than what they hold.
    const held = low[0] <= high[0] ? { low: [...low], high: [...high] } : null;
    const size = ({ low: from, high: to }) => Math.hypot(...from.map((one, axis) => to[axis] - one));
    for (let line = 0; line < wallRadii.length; line += 1) {
      const [from, to] = [walls.subarray(6 * line, 6 * line + 3), walls.subarray(6 * line + 3, 6 * line + 6)];
      const length = Math.hypot(...[0, 1, 2].map((axis) => to[axis] - from[axis])) || 1;
      for (let axis = 0; axis < 3; axis += 1) {
        // A cylinder is as wide as its radius across its own axis only.
        const wide = wallRadii[line] * Math.sqrt(Math.max(0, 1 - ((to[axis] - from[axis]) / length) ** 2));
        take(from[axis], axis, wide);
        take(to[axis], axis, wide);
      }
    }
    if (held && size({ low, high }) > LARGE_WALLS * size(held)) return held;
    return low[0] <= high[0] ? { low, high } : { low: [0, 0, 0], high: [1, 1, 1] };
  }

  fit() {
    const { low, high } = this.box();
    this.bounds = { low, high };
    this.camera.fit(low, high);
  }

  /** The whole of what the walls enclose, as far as it is not far away. */
  whole() {
    this.fit();
    this.render(true);
  }

  turnTo(name) {
    [this.camera.azimuth, this.camera.elevation] = VIEWS[name];
    this.render(true);
  }

  clip() {
    const { clip, cut } = this.look;
    if (clip === "none" || !this.bounds) return [0, 0, 0, 1];
    const axis = "xyz".indexOf(clip[0]);
    const at = this.bounds.low[axis] + (cut / 100) * (this.bounds.high[axis] - this.bounds.low[axis]);
    const sign = clip[1] === "<" ? 1 : -1;
    const plane = [0, 0, 0, sign * at];
    plane[axis] = sign;
    return plane;
  }

  /** All that the scene needs to know. */
  appearance() {
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => {
      const text = style.getPropertyValue(name).trim();
      return [1, 3, 5].map((digit) => parseInt(text.slice(digit, digit + 2), 16) / 255);
    };
    const { look, frame } = this;
    const mean = frame.radii.length ? frame.radii[frame.radii.length >> 1] : 1;
    return {
      camera: this.camera,
      quality: this.quality,
      range: this.range,
      scale: look.scale,
      clip: this.clip(),
      chosen: look.chosen,
      contacts: look.contacts ? TUBE * mean : 0,
      walls: look.walls,
      ink: colour("--faint"),
      ground: colour("--scene"),
      mark: colour("--series-B"),
      push: colour("--series-A"),
      pull: colour("--series-B"),
    };
  }

  render(moved) {
    // A film draws for itself.
    if (!this.frame || !this.range || this.due || this.video.recording) return;
    this.due = requestAnimationFrame((now) => {
      this.due = null;
      this.pace(now, moved);
      this.scene.draw(this.appearance());
      this.say();
      this.drawn = (this.drawn ?? 0) + 1;
      clearTimeout(this.resting);
      this.resting = setTimeout(() => this.rest(), 250);
    });
  }

  /** Where pictures come slowly, moving ones are coarser, and the one at rest is fine again. */
  pace(now, moved) {
    if (moved && now - this.before < 2000) {
      if (now - this.before > SLOW) this.quality = Math.max(0.6 * this.quality, COARSEST);
    } else this.quality = 1;
    this.before = moved ? now : -Infinity;
  }

  rest() {
    this.address();
    if (this.quality < 1) this.render();
  }

  address() {
    if (!this.root.isConnected) return;
    const { look } = this;
    const hash = new URLSearchParams({ column: look.column, map: look.map, camera: this.camera.text() });
    if (!this.follow) hash.set("frame", look.number);
    if (look.contacts) hash.set("contacts", 1);
    if (!look.walls) hash.set("walls", 0);
    if (look.clip !== "none") hash.set("clip", look.clip);
    history.replaceState(null, "", `#${hash}`);
  }

  repaint() {
    this.mark();
    this.render();
  }

  // Picking

  pick(x, y) {
    if (this.video.recording) return;
    this.canvas.focus({ preventScroll: true });
    const row = this.scene.pick(this.appearance(), x, y);
    if (row < 0 || row >= this.frame.particles) this.unpick();
    else this.tell(row);
    this.render();
  }

  unpick() {
    this.look.chosen = -1;
    this.picked.hidden = true;
    this.render();
  }

  async tell(row) {
    this.look.chosen = row;
    const particle = await this.source.particle(this.look.number, row);
    const text = (value) => (Array.isArray(value) ? value.map((one) => number(one, 4)).join(", ") : number(value, 5));
    const line = (name, value, unit) => element("tr", {}, element("th", {}, name), element("td", {}, `${value} ${unitText(unit)}`.trim()));
    const rows = [line("position", text(particle.position), "m")];
    for (const { name, value } of particle.columns) {
      if (name === "id") continue;
      const shown = name === "type" ? (this.run.materials[value] ?? value) : text(value);
      rows.push(line(NAMES[name] && name !== "v" ? NAMES[name] : name.replaceAll("_", " "), shown, name === "type" ? "1" : this.describe("particles_*.vtp", name).unit));
    }
    const contact = (one) => {
      const force = one.columns.find(({ name }) => name === "normal_force")?.value;
      const overlap = one.columns.find(({ name }) => name === "overlap")?.value;
      const other = one.wall !== null ? `wall ${this.run.walls[one.wall] ?? one.wall}` : `particle ${one.id}`;
      const link = one.row === null ? other : button(other, () => this.tell(one.row), { class: "link" });
      return element("tr", {}, element("td", {}, link), element("td", {}, quantity(force, "N")), element("td", {}, quantity(overlap, "m")));
    };
    const contacts = particle.contacts.length
      ? [element("table", {}, element("tr", {}, element("th", {}, "contact"), element("th", {}, "normal force"), element("th", {}, "overlap")), ...particle.contacts.map(contact))]
      : [];
    const close = button("×", () => this.unpick(), { "aria-label": "close", class: "link" });
    this.picked.replaceChildren(element("header", {}, element("strong", {}, `particle ${particle.id ?? row}`), close), element("table", {}, ...rows), ...contacts);
    this.picked.hidden = false;
    this.render();
  }

  // Keys, pictures, complaints

  key(event) {
    if (event.key === "Escape" && this.video.recording) {
      this.video.stop();
      return;
    }
    if (event.target.matches("select, input, button") && !(event.target === this.slider && event.key === " ")) return;
    const step = (by) => {
      this.follow = false;
      this.go(Math.min(Math.max(this.look.number + by, 0), this.run.times.length - 1));
    };
    const turn = (across, up) => {
      this.camera.turn(across, up);
      this.render(true);
    };
    const keys = {
      " ": () => this.play(),
      ArrowLeft: () => (event.shiftKey ? turn(-40, 0) : step(-1)),
      ArrowRight: () => (event.shiftKey ? turn(40, 0) : step(1)),
      ArrowUp: () => turn(0, 25),
      ArrowDown: () => turn(0, -25),
      "+": () => this.closer(0.85),
      "-": () => this.closer(1 / 0.85),
      r: () => this.whole(),
      Escape: () => this.unpick(),
    };
    for (const name of Object.keys(VIEWS)) keys[name] = () => this.turnTo(name);
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  }

  closer(times) {
    this.camera.zoom(times);
    this.render(true);
  }

  complain(error) {
    this.message.hidden = !error;
    this.message.textContent = error?.message ?? "";
  }
}
