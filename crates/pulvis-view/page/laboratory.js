// The laboratory: sliders on one side, what the contact does on the other. All numbers come from `source`, which computes them
// as `pulvis collide` and `pulvis probe` do.

import { element, packed } from "./format.js";
import { HeadOnCharts } from "./headon.js";
import { StickingMap } from "./map.js";
import { ObliqueCharts } from "./oblique.js";
import { LETTERS, Panel } from "./panel.js";
import { collideText, MOTIONS, obliqueText, pathOf, probeText } from "./scenario.js";

/** An impact under an angle, as the laboratory begins with it. */
const OBLIQUE = { on: false, angle: 30, spins: [0, 0] };

/** How long hands must rest before limits of sticking are searched [ms]. */
const REST = 150;

export class Laboratory {
  constructor(source) {
    this.source = source;
    this.panel = new Panel(this);
    this.results = element("div", { class: "results", role: "status" });
    this.message = element("div", { class: "message", role: "alert", hidden: true });
    this.headOn = new HeadOnCharts(this);
    this.map = new StickingMap(this);
    this.oblique = new ObliqueCharts(this);
    this.stage = element("div", { class: "charts" });
    this.root = element("section", { class: "laboratory", id: "laboratory" }, this.panel.root, element("div", { class: "stage", tabindex: 0, role: "region", "aria-label": "Numbers and charts" }, this.results, this.message, this.stage));
    this.pending = { dirty: false, busy: false };
  }

  async open(saved) {
    [this.laws, this.presets] = await Promise.all([this.source.laws(), this.source.presets()]);
    if (saved) {
      this.state = { oblique: structuredClone(OBLIQUE), ...saved };
      this.arrange();
      this.panel.build();
      this.changed();
      return;
    }
    await this.preset(this.presets.findIndex((preset) => preset.title.includes("Fig. 6")));
  }

  // What is shown

  /** The charts of head-on collisions, or of those under an angle. */
  arrange() {
    const headOn = [...this.headOn.all, this.map.chart];
    const shown = this.state.oblique.on ? this.oblique.charts : headOn;
    this.stage.replaceChildren(...shown.map((chart) => chart.root));
  }

  /** The contacts that are shown. */
  shown() {
    return this.state.contacts.slice(0, this.state.compare ? 2 : 1);
  }

  setOblique(on) {
    this.state.oblique.on = on;
    this.arrange();
    this.panel.build();
    this.changed();
  }

  pickAngle(value) {
    this.state.oblique.angle = Number(Math.min(Math.max(value, 0), 89).toPrecision(3));
    this.panel.angle.set(this.state.oblique.angle);
    this.changed();
  }

  async preset(index) {
    const preset = this.presets[index];
    if (!preset) return;
    await this.take(() => this.source.read(preset.text), preset.title);
  }

  async file(event) {
    const [file] = event.target.files;
    if (file) await this.take(async () => this.source.read(await file.text()), file.name);
  }

  /** Takes over a state that the server has read out of a file. */
  async take(reading, title) {
    try {
      const state = await reading();
      const scale = state.typical_speed;
      const speeds = state.speeds && state.speeds[1] > state.speeds[0] * 1.5 ? state.speeds : [0.01 * scale, 10 * scale];
      const motion = state.probe ? MOTIONS.findLast(({ place }) => state.probe.poses.some((pose) => pose[place] !== 0)).key : "overlap";
      const contacts = state.contacts.slice(0, 2);
      this.state = { ...state, contacts, speeds, motion, title, compare: contacts.length > 1, method: "exact" };
      this.state.velocity = state.oblique?.velocity ?? Math.min(Math.max(0.34 * scale, speeds[0]), speeds[1]);
      this.state.oblique = state.oblique ? { on: true, angle: state.oblique.angle, spins: state.oblique.spins } : structuredClone(OBLIQUE);
      this.arrange();
      this.panel.edited = 0;
      this.panel.build();
      this.changed();
    } catch (error) {
      this.complain(error);
    }
  }

  async chooseLaw(number, role, name) {
    const contact = this.state.contacts[number];
    if (name === "none") {
      delete contact.laws[role];
    } else {
      const entry = this.laws.find((law) => law.role === role && law.name === name);
      const values = { ...(entry.example ?? {}) };
      // A collision has no stages at whose start a bond could form.
      if (role === "bond") values.form = "first-touch";
      contact.laws[role] = { law: name, values };
      for (const one of entry.quantities) if (one.required) this.state.quantities[one.name] ??= one.range?.low === null ? [1e-12, -1e-12] : [1e-6, 1e-6];
    }
    this.state.method = "exact";
    if (role === "normal" && number === 0) await this.adopt(role, name);
    const motion = MOTIONS.find((one) => one.role === role && role !== "normal");
    if (motion && name !== "none") this.setMotion(motion.key);
    this.panel.build();
    this.changed();
  }

  /** Scales of path and velocity that show most of a law. */
  async adopt(role, name) {
    try {
      const start = await this.source.start(role, name);
      const { radius, density, bodies, temperature, probe, typical_speed: scale } = start;
      Object.assign(this.state, { radius, density, bodies, probe, motion: "overlap" });
      if (temperature !== null) this.state.temperature = temperature;
      Object.assign(this.state.quantities, start.quantities);
      this.state.speeds = [0.01 * scale, 10 * scale];
      this.state.velocity = 0.34 * scale;
      this.state.title = name;
    } catch (error) {
      this.complain(error);
    }
  }

  setMotion(motion) {
    const depth = Math.max(...(this.state.probe?.poses ?? [[1e-5]]).map((pose) => pose[0]));
    this.state.motion = motion;
    const poses = pathOf(motion, motion === "overlap" ? depth / 1.3 : depth, 0.2 * depth, 0.4 * depth);
    const time = this.state.probe?.durations?.[0];
    this.state.probe = { poses, durations: time ? poses.slice(1).map(() => time) : null, points: 150 };
  }

  compare(wanted) {
    this.state.compare = wanted;
    if (wanted && this.state.contacts.length < 2) this.state.contacts.push(structuredClone(this.state.contacts[0]));
    this.panel.edited = wanted ? 1 : 0;
    this.panel.build();
    this.changed();
  }

  pickVelocity(value) {
    this.state.velocity = Number(value.toPrecision(4));
    this.panel.velocity.set(this.state.velocity);
    this.changed();
  }

  /** A place of the map: velocity, and value of the parameter that is varied. */
  pickPoint(velocity, value) {
    const axis = this.map.axis();
    this.state.contacts[this.panel.edited].laws[axis.role].values[axis.name] = Number(value.toPrecision(4));
    this.state.velocity = Number(velocity.toPrecision(4));
    this.panel.build();
    this.changed();
  }

  // Computation: one question of a kind at a time, and always the latest state

  changed() {
    this.since ??= performance.now();
    this.pending.dirty = true;
    if (!this.pending.busy) this.compute();
  }

  async compute() {
    this.pending.busy = true;
    this.root.dataset.busy = "true";
    while (this.pending.dirty) {
      this.pending.dirty = false;
      const began = this.since;
      this.since = null;
      await this.redraw(began);
      if (!this.pending.dirty) await this.complete(began);
    }
    this.pending.busy = false;
    this.root.dataset.busy = "false";
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.rest(), REST);
    history.replaceState(null, "", `#lab=${packed(this.state)}`);
  }

  async redraw(began) {
    const failures = this.state.oblique.on ? await this.redrawOblique(true) : await this.redrawHeadOn();
    // Asked otherwise at once.
    if (failures === null) return;
    this.complain(failures.length ? new Error([...new Set(failures)].join("\n")) : null);
    if (began !== null) this.took = performance.now() - began;
    this.root.dataset.took = this.took?.toFixed(1);
    this.drawResults();
  }

  /** Draws collisions under an angle; answers with what went wrong. */
  async redrawOblique(quick) {
    const { state, laws } = this;
    try {
      const answer = await this.source.oblique(obliqueText(state, laws), state.oblique.angle, quick);
      this.slanted = answer;
      this.oblique.show(answer);
      return [];
    } catch (error) {
      return [error.message];
    }
  }

  async redrawHeadOn() {
    const { state, laws } = this;
    const asked = [this.source.collide(collideText(state, laws), state.velocity, true), state.probe ? this.source.probe(probeText(state, laws)) : null];
    const [collision, path, map] = await Promise.allSettled([...asked, this.map.redraw()]);
    const failures = [];
    if (collision.status === "fulfilled") this.headOn.draw(collision.value);
    else if (this.retryByEngine(collision.reason)) return null;
    else failures.push(collision.reason.message);
    if (path.status === "fulfilled" && path.value) this.headOn.drawPath(path.value);
    else if (path.status === "rejected") {
      if (this.retryInTime(path.reason)) return null;
      failures.push(path.reason.message);
    }
    if (map.status === "rejected") failures.push(map.reason.message);
    return failures;
  }

  /** The collisions of the curve, once the hands have let it happen. */
  async complete(began) {
    try {
      if (this.state.oblique.on) {
        await this.redrawOblique(false);
        this.completed(began);
        return;
      }
      const answer = await this.source.collide(collideText(this.state, this.laws), this.state.velocity, false);
      if (this.pending.dirty) return;
      this.headOn.draw(answer);
      this.completed(began);
    } catch {
      // The quick answer has told why.
    }
  }

  completed(began) {
    if (began !== null) this.all = performance.now() - began;
    this.root.dataset.all = this.all?.toFixed(1);
    this.drawResults();
  }

  /** Laws that relax with time are followed in steps. */
  retryByEngine(error) {
    if (this.state.method === "engine" || !error.message.includes(`method = "engine"`)) return false;
    this.state.method = "engine";
    this.pending.dirty = true;
    return true;
  }

  /** Forces that depend on the rate need a path with times. */
  retryInTime(error) {
    const { probe } = this.state;
    if (probe.durations || !error.message.includes("depend on the rate or on time")) return false;
    const duration = this.headOn.collision?.contacts[0].course?.contact_duration;
    const time = Number((duration > 0 ? duration / 2 : 1e-4).toPrecision(3));
    probe.durations = probe.poses.slice(1).map(() => time);
    this.panel.build();
    this.pending.dirty = true;
    return true;
  }

  colours(number) {
    const style = getComputedStyle(document.documentElement);
    return style.getPropertyValue(`--series-${LETTERS[number]}`).trim();
  }

  colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  }

  name(number, text) {
    return this.state.compare ? `${LETTERS[number]} ${text}`.trim() : text;
  }

  async rest() {
    if (this.state.oblique.on) return;
    await this.searchSticking();
    await this.map.refine();
  }

  async searchSticking() {
    const asked = JSON.stringify(this.state);
    try {
      const answer = await this.source.sticking(collideText(this.state, this.laws));
      if (asked !== JSON.stringify(this.state)) return;
      this.headOn.mark(answer.contacts);
    } catch {
      this.headOn.mark(null);
    }
    this.drawResults();
  }

  drawResults() {
    const head = (number) => (this.state.compare ? [element("div", { class: `swatch-${LETTERS[number]} letter` }, element("dt", {}, "contact"), element("dd", {}, LETTERS[number]))] : []);
    const { on } = this.state.oblique;
    const answer = on ? this.slanted : this.headOn.collision;
    const numbers = (contact, number) => (on ? this.oblique.results(contact) : this.headOn.results(contact, number));
    const rows = (answer?.contacts ?? []).map((contact, number) => element("dl", {}, ...head(number), ...numbers(contact, number)));
    const took = this.took ? element("span", { class: "took" }, `redrawn in ${this.took.toFixed(0)} ms${this.all ? `, all collisions in ${this.all.toFixed(0)} ms` : ""}`) : "";
    this.results.replaceChildren(...rows, took);
  }

  complain(error) {
    this.message.hidden = !error;
    this.message.textContent = error?.message ?? "";
  }

  /** Colours have changed. */
  repaint() {
    if (!this.state) return;
    this.changed();
  }
}
