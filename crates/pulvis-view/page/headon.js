// Collisions head on: the loop of one of them, restitution over velocity, energies, and the path of an indenter.

import { Chart } from "./chart.js";
import { element, number, quantity } from "./format.js";
import { MOTION_LABELS } from "./panel.js";
import { MOTIONS, pathOf } from "./scenario.js";

export class HeadOnCharts {
  constructor(lab) {
    this.lab = lab;
    const restitution = new Chart({
      title: "Coefficient of restitution",
      x: { label: "impact velocity v", unit: "m/s", log: true },
      y: { label: "restitution e", unit: "1", range: [-0.03, 1.05] },
      pick: (velocity) => lab.pickVelocity(velocity),
    });
    const loop = new Chart({ title: "Force over overlap of the collision", x: { label: "overlap δ", unit: "m" }, y: { label: "force f", unit: "N", include: [0] } });
    const energies = new Chart({ title: "Energies of the collision", x: { label: "time t", unit: "s", tight: true }, y: { label: "energy", unit: "J", include: [0] } });
    const path = new Chart({ title: "Force over overlap on a path", x: { label: "overlap δ", unit: "m" }, y: { label: "force f", unit: "N", include: [0] } });
    this.charts = { loop, restitution, energies, path };
    this.all = Object.values(this.charts);
  }

  draw(answer) {
    const { lab } = this;
    this.collision = answer;
    const contacts = answer.contacts.map((contact, number) => ({ ...contact, colour: lab.colours(number), number }));
    const courses = contacts.filter((contact) => contact.course && !contact.course.failure);
    const first = courses[0]?.course;
    if (!lab.state.probe && first) {
      const poses = pathOf("overlap", first.overlap_max, 0, 0.4 * first.overlap_max);
      lab.state.probe = { poses, durations: null, points: 150 };
      lab.panel.build();
      lab.pending.dirty = true;
    }
    const restitution = contacts.flatMap(({ velocity, restitution, theory, colour, number }) => [
      ...(theory.velocity.length ? [{ name: lab.name(number, "closed form"), x: theory.velocity, y: theory.restitution, colour }] : []),
      { name: lab.name(number, "collisions"), x: velocity, y: restitution, colour: theory.velocity.length ? lab.colour("--ink") : colour, points: true },
    ]);
    const line = ({ velocity, restitution, colour }) => ({ x: velocity, y: restitution, colour, dashed: false });
    const bare = contacts.filter((contact) => !contact.theory.velocity.length).map(line);
    const limits = contacts.flatMap(({ limits, colour, number }) => limits.map((limit) => ({ ...limit, x: limit.velocity, symbol: lab.name(number, limit.symbol), colour })));
    this.restitution = { series: [...bare, ...restitution], markers: [{ x: lab.state.velocity }], limits };
    this.charts.restitution.show({ ...this.restitution, bands: this.bands });
    this.charts.loop.show({
      title: `Force over overlap at ${quantity(lab.state.velocity, "m/s")}`,
      series: courses.map(({ course, colour, number }) => ({ name: lab.name(number, lab.state.contacts[number].laws.normal.law), x: course.overlap, y: course.force, colour })),
    });
    this.drawEnergies(courses);
  }

  drawEnergies(courses) {
    const { lab } = this;
    const kinds = [["kinetic", "--energy-kinetic"], ["available", "--energy-elastic"], ["dissipated", "--energy-lost"], ["attraction", "--energy-attraction"]];
    const names = { kinetic: "kinetic", available: "elastic (available)", dissipated: "dissipated", attraction: "attraction" };
    const series = courses.flatMap(({ course, number }) =>
      kinds
        .filter(([kind]) => kind !== "attraction" || course.attraction.some((value) => value !== 0))
        .map(([kind, colour]) => ({ name: lab.name(number, names[kind]), x: course.time, y: course[kind], colour: lab.colour(colour), dashed: number > 0 })));
    this.charts.energies.show({ title: `Energies at ${quantity(lab.state.velocity, "m/s")}`, series });
  }

  drawPath(answer) {
    const { lab } = this;
    const motion = lab.state.motion;
    const axes = {
      overlap: ["overlap", "force", "overlap δ", "force f", "N"],
      shear: ["shear", "shear_force", "displacement along the surface", "force against it", "N"],
      roll: ["roll", "roll_torque", "rolling arc", "torque against rolling", "N m"],
      twist: ["twist", "twist_torque", "twisting arc", "torque against twisting", "N m"],
    };
    const [x, y, xLabel, yLabel, unit] = axes[motion];
    this.charts.path.show({
      title: motion === "overlap" ? "Force over overlap on a path" : `Path: ${MOTION_LABELS[motion]}`,
      x: { label: xLabel, unit: "m" },
      y: { label: yLabel, unit, include: [0] },
      series: answer.curves.map((curve, number) => ({
        name: lab.name(number, motion === "overlap" ? lab.state.contacts[number].laws.normal.law : (lab.state.contacts[number].laws[MOTIONS.find((one) => one.key === motion).role]?.law ?? "none")),
        x: curve[x],
        y: curve[y],
        colour: lab.colours(number),
        notes: motion === "overlap" ? curve.branch : undefined,
      })),
    });
  }

  /** The ranges of velocity in which the pairs stick; `null`: nobody knows. */
  mark(sticking) {
    const { lab } = this;
    this.sticking = sticking;
    this.bands = (sticking ?? []).flatMap((contact, number) =>
      contact.ranges.map(([low, high]) => ({ low, high, colour: lab.colours(number), label: lab.name(number, "sticks"), row: number })));
    if (this.restitution) this.charts.restitution.show({ ...this.restitution, bands: this.bands });
  }

  /** The numbers of the collision of one contact. */
  results(contact, place) {
    const cell = (label, value, title) => element("div", { title }, element("dt", {}, label), element("dd", {}, value));
    const { course } = contact;
    if (!course || course.failure) return [cell("collision", course?.failure ?? "–")];
    const ranges = this.sticking?.[place];
    const sticks = ranges?.ranges.map(([low, high]) => `${low === null ? "0" : quantity(low, "m/s", 3)} to ${high === null ? "∞" : quantity(high, "m/s", 3)}`).join(", ");
    const theory = course.theory === null ? "" : ` (closed form ${number(course.theory, 5)})`;
    return [
      cell("restitution", `${number(course.restitution, 5)}${theory}`),
      cell("outcome", course.regime === "stick" ? "sticks" : "rebounds"),
      cell("largest overlap", quantity(course.overlap_max, "m")),
      cell("duration", course.contact_duration === null ? "does not open" : quantity(course.contact_duration, "s")),
      cell("dissipated", quantity(course.energy_dissipated, "J")),
      cell("sticks between", !ranges || ranges.from === "none" ? "–" : sticks || "never", ranges ? `from: ${ranges.from}` : undefined),
      ...(contact.failure ? [cell("note", contact.failure)] : []),
    ];
  }
}
