// Collisions under an angle: what becomes of the tangential motion, over the angle of incidence.

import { Chart } from "./chart.js";
import { element, number, quantity } from "./format.js";

const DEGREES = 180 / Math.PI;

/** How far the plot after Maw reaches, in values of μ: the contact slides throughout from about 7 μ on. */
const REACH = 14;

export class ObliqueCharts {
  constructor(lab) {
    this.lab = lab;
    const angle = { label: "angle of incidence θ", unit: "°", range: [0, 90], tight: true, ticks: [0, 15, 30, 45, 60, 75, 90] };
    const pick = (value) => this.lab.pickAngle(value);
    this.restitution = new Chart({ title: "Restitution over angle", x: angle, y: { label: "after over before", unit: "1", range: [-1.05, 1.05] }, pick });
    this.maw = new Chart({ title: "Contact point, after over before", x: { label: "before: v_t/v_n", unit: "1" }, y: { label: "after: v_t′/v_n", unit: "1", include: [0] } });
    this.impulse = new Chart({ title: "Impulse ratio over angle", x: angle, y: { label: "impulse ratio P_t/P_n", unit: "1", include: [0] }, pick });
    this.forces = new Chart({ title: "Forces of the collision", x: { label: "time t", unit: "s", tight: true }, y: { label: "force", unit: "N", include: [0] } });
    this.charts = [this.restitution, this.maw, this.impulse, this.forces];
  }

  show(answer) {
    const { lab } = this;
    const contacts = answer.contacts.map((contact, place) => ({ ...contact, place, colour: lab.colours(place), degrees: contact.angle.map((value) => value * DEGREES) }));
    this.drawRestitution(contacts);
    this.drawMaw(contacts);
    this.drawImpulse(contacts);
    this.drawForces(contacts);
  }

  drawRestitution(contacts) {
    const { lab } = this;
    const kinds = [["restitution", "normal e", "--energy-kinetic"], ["tangential", "tangential e_t", "--energy-elastic"], ["contact", "contact point β", "--energy-lost"]];
    this.restitution.show({
      series: contacts.flatMap((contact) => kinds.map(([key, name, colour]) => ({ name: lab.name(contact.place, name), x: contact.degrees, y: contact[key], colour: lab.colour(colour), dashed: contact.place > 0 }))),
      markers: [{ x: lab.state.oblique.angle }],
    });
  }

  /** The friction coefficients of the contacts that have one. */
  frictions() {
    return this.lab.shown().map((contact) => contact.laws.sliding?.values.mu).map((mu) => (typeof mu === "number" && mu > 0 ? mu : null));
  }

  drawMaw(contacts) {
    const { lab } = this;
    const most = Math.max(0, ...this.frictions());
    const reach = most > 0 ? Math.min(Math.max(REACH * most, 1), 12) : 12;
    const near = contacts.map((contact) => {
      const shown = contact.before.map((value, place) => place).filter((place) => Math.abs(contact.before[place]) <= reach);
      return { ...contact, x: shown.map((place) => contact.before[place]), y: shown.map((place) => contact.after[place]) };
    });
    const ends = [Math.min(0, ...near.flatMap(({ x }) => x)), Math.max(0, ...near.flatMap(({ x }) => x))];
    this.maw.show({
      series: [
        { name: "without friction", x: ends, y: ends, colour: lab.colour("--faint"), dashed: true },
        ...near.map(({ x, y, colour, place }) => ({ name: lab.name(place, "v_t′ over v_t"), x, y, colour })),
        ...near.map(({ x, y, colour }) => ({ x, y, colour, points: true })),
      ],
    });
  }

  drawImpulse(contacts) {
    const { lab } = this;
    const frictions = this.frictions();
    const limit = (contact) => ({ name: lab.name(contact.place, "μ: slides throughout"), x: [0, 90], y: [frictions[contact.place], frictions[contact.place]], colour: lab.colour("--faint"), dashed: true });
    this.impulse.show({
      series: [
        ...contacts.filter((contact) => frictions[contact.place] !== null).map(limit),
        ...contacts.map((contact) => ({ name: lab.name(contact.place, "impulse ratio"), x: contact.degrees, y: contact.impulse_ratio, colour: contact.colour })),
      ],
      markers: [{ x: lab.state.oblique.angle }],
    });
  }

  drawForces(contacts) {
    const { lab } = this;
    const kinds = [["force", "normal", "--energy-kinetic"], ["tangential_force", "tangential", "--energy-lost"]];
    const courses = contacts.filter((contact) => contact.course && !contact.course.failure);
    this.forces.show({
      title: `Forces at ${number(lab.state.oblique.angle, 4)}°, ${quantity(lab.state.velocity, "m/s")}`,
      series: courses.flatMap(({ course, place }) => kinds.map(([key, name, colour]) => ({ name: lab.name(place, name), x: course.time, y: course[key], colour: lab.colour(colour), dashed: place > 0 }))),
    });
  }

  /** The numbers of the collision of one contact. */
  results({ course, failure }) {
    const cell = (label, value, title) => element("div", { title }, element("dt", {}, label), element("dd", {}, value));
    if (!course || course.failure) return [cell("collision", course?.failure ?? "–")];
    const angle = course.rebound_angle === null ? "–" : `${number(course.rebound_angle * DEGREES, 4)}°`;
    const spins = course.spins?.slice(0, this.lab.state.bodies === "wall" ? 1 : 2).map((spin) => number(spin, 4)).join(", ") ?? "–";
    return [
      cell("normal restitution", number(course.restitution, 5), "normal velocity after over before"),
      cell("tangential", number(course.tangential, 5), "tangential velocity of the centres after over before"),
      cell("contact point β", number(course.contact, 5), "−1: no friction, 0: rolls off, 1: reversed"),
      cell("impulse ratio", number(course.impulse_ratio, 5), "tangential over normal impulse; μ where the contact slides throughout"),
      cell("rebound angle", angle),
      cell("spins after", `${spins} rad/s`),
      cell("outcome", course.regime === "stick" ? "sticks" : "rebounds"),
      cell("largest overlap", quantity(course.overlap_max, "m")),
      cell("dissipated", quantity(course.energy_dissipated, "J")),
      ...(failure ? [cell("note", failure)] : []),
    ];
  }
}
