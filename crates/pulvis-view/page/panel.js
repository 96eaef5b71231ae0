// The controls of the laboratory: laws, parameters, bodies and motion of the contacts.

import { button, choice, Quantity, tick } from "./controls.js";
import { download, element } from "./format.js";
import { collideText, courseText, MOTIONS, obliqueCourseText, obliqueText, probeText, quantities, ROLES } from "./scenario.js";

export const LETTERS = ["A", "B"];

const TITLES = {
  normal: "Normal force",
  noncontact: "Attraction at a distance",
  viscosity: "Dashpot",
  sliding: "Sliding",
  rolling: "Rolling",
  torsion: "Torsion",
  bond: "Bond",
};

/** Roles that are shown at once; the others are folded away. */
const FIRST = ["normal", "noncontact", "viscosity"];

export const MOTION_LABELS = { overlap: "along the normal", shear: "shear", roll: "roll", twist: "twist" };

export class Panel {
  constructor(lab) {
    this.lab = lab;
    /** The contact whose laws are shown. */
    this.edited = 0;
    this.root = element("div", { class: "side", role: "group", "aria-label": "Contact" });
  }

  build() {
    const { state } = this.lab;
    const presets = [["", "choose …"], ...this.lab.presets.map((preset, index) => [String(index), preset.title])];
    const shown = this.lab.presets.findIndex((preset) => preset.title === state.title);
    const file = element("input", { type: "file", accept: ".toml", hidden: true, onchange: (event) => this.lab.file(event) });
    this.root.replaceChildren(
      choice("Figures of papers", presets, String(shown), (index) => index && this.lab.preset(Number(index))),
      this.contactTabs(),
      ...this.contact(this.edited),
      this.bodies(),
      this.motionControls(),
      ...(state.oblique.on ? [] : [this.mapControls()]),
      element(
        "div",
        { class: "buttons" },
        element("h3", {}, "Scenario files"),
        button("collide.toml", () => download("collide.toml", (state.oblique.on ? obliqueText : collideText)(state, this.lab.laws)), { title: "Download the scenario of the restitution curve for `pulvis collide`" }),
        button("one-collision.toml", () => download("one-collision.toml", (state.oblique.on ? obliqueCourseText : courseText)(state, this.lab.laws)), { title: "Download the scenario of the collision that is drawn for `pulvis collide`" }),
        button("probe.toml", () => download("probe.toml", probeText(state, this.lab.laws)), { title: "Download the scenario of the path for `pulvis probe`", disabled: !state.probe }),
        button("map.toml", () => download("map.toml", this.lab.map.file()), { title: "Download the scenario of the sticking map for `pulvis collide`", disabled: !this.lab.map.axis() }),
        button("open a file …", () => file.click(), { title: "Open a scenario for `pulvis collide` or `pulvis probe`" }),
        file,
      ),
    );
  }

  contactTabs() {
    const tab = (number) =>
      button(`Contact ${LETTERS[number]}`, () => {
        this.edited = number;
        this.build();
        this.lab.changed();
      }, { class: `tab swatch-${LETTERS[number]}`, "aria-pressed": this.edited === number });
    const tabs = this.lab.state.compare ? [tab(0), tab(1)] : [];
    return element("div", { class: "tabs" }, ...tabs, tick("compare two contacts", this.lab.state.compare, (wanted) => this.lab.compare(wanted)));
  }

  contact(number) {
    const laws = this.lab.state.contacts[number].laws;
    const section = (role) => this.role(number, role, laws[role]);
    const folded = ROLES.filter((role) => !FIRST.includes(role));
    const more = element("details", { open: folded.some((role) => laws[role]) }, element("summary", {}, "Sliding, rolling, torsion, bond"), ...folded.map(section));
    return [...FIRST.map(section), more];
  }

  role(number, role, own) {
    const entries = this.lab.laws.filter((law) => law.role === role);
    const names = entries.map((law) => [law.name, law.name, law.summary]);
    const root = element("section", { class: "law" }, choice(TITLES[role], names, own?.law ?? "none", (name) => this.lab.chooseLaw(number, role, name)));
    const entry = own && entries.find((law) => law.name === own.law);
    if (!entry) return root;
    root.append(element("p", { class: "summary" }, entry.summary));
    const given = [];
    const others = [];
    for (const parameter of entry.parameters) {
      const isGiven = parameter.required || (own.values[parameter.name] !== undefined && own.values[parameter.name] !== parameter.default);
      (isGiven ? given : others).push(this.parameter(number, role, own, parameter));
    }
    root.append(...given);
    if (others.length) root.append(element("details", {}, element("summary", {}, `more parameters (${others.length})`), ...others));
    const about = element("details", { class: "about" }, element("summary", {}, "equations and source"), element("pre", {}, entry.equations), element("p", {}, entry.source), element("p", {}, `Verified against: ${entry.verified}`));
    root.append(about);
    return root;
  }

  parameter(number, role, own, parameter) {
    const value = own.values[parameter.name];
    const change = (changed) => {
      own.values[parameter.name] = changed;
      this.lab.changed();
    };
    if (parameter.options) {
      const names = parameter.options.map((option) => [option.name, option.name, option.meaning]);
      return choice(parameter.name, names, value ?? parameter.default, change);
    }
    if (parameter.list) {
      const shown = value ? `${value.length} values up to ${Math.max(...value)} ${parameter.unit}, changed in the scenario file` : "not given";
      return element("p", { class: "summary", title: parameter.meaning }, `${parameter.name}: ${shown}`);
    }
    const slider = new Quantity({ ...parameter, shown: parameter.symbol || parameter.name, change }, value ?? parameter.default ?? 0);
    if (value === undefined || value === null) {
      slider.root.classList.add("unset");
      slider.field.placeholder = "not given";
      slider.field.value = "";
    }
    return slider.root;
  }

  bodies() {
    const { state } = this.lab;
    const one = (name, unit, values, meaning) =>
      new Quantity({ name, unit, meaning, range: { low: 0, high: null }, change: (value) => {
        values.fill(value);
        this.lab.changed();
      } }, values[0]).root;
    const kinds = [["pair", "two spheres"], ["wall", "a sphere and a plane"]];
    const own = quantities(state, this.lab.laws).map((entry) =>
      new Quantity({ ...entry, change: (value) => {
        // Charges of opposite signs attract.
        const before = state.quantities[entry.name] ?? [1, 1];
        state.quantities[entry.name] = [value, before[1] * before[0] < 0 ? -value : value];
        this.lab.changed();
      } }, state.quantities[entry.name]?.[0] ?? 0).root);
    const warm = state.temperature === null || state.temperature === undefined ? [] : [
      new Quantity({ name: "temperature", unit: "K", meaning: "temperature that laws read", range: { low: 0, high: null }, change: (value) => {
        state.temperature = value;
        this.lab.changed();
      } }, state.temperature).root,
    ];
    return element(
      "section",
      { class: "law" },
      choice("Bodies", kinds, state.bodies, (kind) => {
        state.bodies = kind;
        if (kind === "pair" && state.radius.length < 2) [state.radius, state.density] = [[state.radius[0], state.radius[0]], [state.density[0], state.density[0]]];
        if (state.oblique.on) this.build();
        this.lab.changed();
      }),
      one("radius", "m", state.radius, "radius of the bodies"),
      one("density", "kg/m^3", state.density, "density of the bodies"),
      ...own,
      ...warm,
    );
  }

  obliqueControls() {
    const { oblique, bodies } = this.lab.state;
    this.angle = new Quantity({ name: "angle", unit: "°", meaning: "angle between the velocity and the line of centres", range: { low: 0, high: 89, closed: true }, change: (value) => {
      oblique.angle = Math.min(Math.max(value, 0), 89);
      this.lab.changed();
    } }, oblique.angle);
    const spin = (place, name) =>
      new Quantity({ name, unit: "rad/s", meaning: `angular velocity of body ${name.at(-1)} before, about the axis across the plane of motion`, range: { low: null, high: null }, change: (value) => {
        oblique.spins[place] = value;
        this.lab.changed();
      } }, oblique.spins[place]).root;
    return [this.angle.root, spin(0, "spin i"), ...(bodies === "pair" ? [spin(1, "spin j")] : [])];
  }

  /** Which parameter the sticking map varies, and how far. */
  mapControls() {
    const { lab } = this;
    const section = element("section", { class: "law" }, element("h3", {}, "Sticking map"));
    const axis = lab.map.axis();
    if (!axis) return section;
    const parameters = lab.map.parameters();
    const several = new Set(parameters.map(({ role }) => role)).size > 1;
    const change = (values) => {
      Object.assign(lab.state.map, values);
      lab.changed();
    };
    const names = parameters.map(({ key, name, role, meaning }) => [key, several ? `${name} (${role})` : name, meaning]);
    const end = (name, meaning) => new Quantity({ name, unit: axis.unit, meaning, range: axis.range, change: (value) => change({ [name]: value }) }, axis[name]);
    this.mapEnds = [end("from", "lower end of the parameter in the map"), end("to", "upper end of the parameter in the map")];
    section.append(
      choice("Parameter", names, axis.key, (key) => {
        lab.state.map.key = key;
        lab.state.map.from = Infinity;
        this.build();
        lab.changed();
      }),
      ...this.mapEnds.map((one) => one.root),
      element("div", { class: "tabs" },
        tick("log parameter", axis.log, (log) => {
          lab.state.map = { ...lab.state.map, ...lab.map.around(axis, log) };
          this.build();
          lab.changed();
        }, "equal ratios of the parameter, not equal differences"),
        tick("log velocity", axis.velocityLog, (velocityLog) => change({ velocityLog }), "equal ratios of the velocity, not equal differences")),
    );
    return section;
  }

  /** The map has chosen another range, since the value has left the old one. */
  showMapEnds({ from, to }) {
    this.mapEnds?.[0].set(from);
    this.mapEnds?.[1].set(to);
  }

  motionControls() {
    const { state } = this.lab;
    this.velocity = new Quantity({ name: "velocity", unit: "m/s", meaning: "impact velocity of the collision that is drawn", range: { low: 0, high: null }, change: (value) => {
      state.velocity = value;
      this.lab.changed();
    } }, state.velocity);
    const impacts = [["head-on", "head on"], ["oblique", "under an angle"]];
    const impact = choice("Impact", impacts, state.oblique.on ? "oblique" : "head-on", (name) => this.lab.setOblique(name === "oblique"));
    const section = element("section", { class: "law" }, element("h3", {}, "Motion"), impact, this.velocity.root);
    if (state.oblique.on) {
      section.append(...this.obliqueControls());
      return section;
    }
    section.append(button("range of velocities around this one", () => {
      state.speeds = [state.velocity / 50, state.velocity * 20];
      this.lab.changed();
    }));
    if (!state.probe) return section;
    const motions = MOTIONS.map(({ key }) => [key, MOTION_LABELS[key]]);
    section.append(choice("Path", motions, state.motion, (motion) => {
      this.lab.setMotion(motion);
      this.build();
      this.lab.changed();
    }));
    const scaled = (name, meaning, place) => {
      const most = Math.max(...state.probe.poses.map((pose) => Math.abs(pose[place])));
      return new Quantity({ name, unit: "m", meaning, range: { low: 0, high: null }, change: (value) => {
        const now = Math.max(...state.probe.poses.map((pose) => Math.abs(pose[place])));
        for (const pose of state.probe.poses) pose[place] *= value / now;
        this.lab.changed();
      } }, most).root;
    };
    section.append(scaled("depth", "largest overlap of the path; the other turning points scale along", 0));
    const other = MOTIONS.find((one) => one.key === state.motion);
    if (other.place > 0) section.append(scaled(MOTION_LABELS[other.key], "amplitude of the motion along the surface", other.place));
    if (state.probe.durations) {
      section.append(new Quantity({ name: "leg", unit: "s", meaning: "time from one turning point to the next", range: { low: 0, high: null }, change: (value) => {
        state.probe.durations = state.probe.durations.map(() => value);
        this.lab.changed();
      } }, state.probe.durations[0]).root);
    }
    return section;
  }
}
