// The state of the laboratory as scenario files: what `pulvis collide` and `pulvis probe` read.

/** Roles that are tables with a law, in the order of a file. */
export const ROLES = ["normal", "noncontact", "viscosity", "sliding", "rolling", "torsion", "bond"];

/** Tables of parameters without a law. */
const CHOICES = ["conventions", "expected"];

/** Points of a restitution curve. */
const SPEEDS = 32;

/** Angles of incidence, from nearly head on to nearly grazing [°], and how many: two degrees apart. */
const ANGLES = [1, 89];
const ANGLE_POINTS = 45;

/** Motions of a path by their place in a pose, with the role that resists them. */
export const MOTIONS = [
  { key: "overlap", role: "normal", place: 0 },
  { key: "shear", role: "sliding", place: 1 },
  { key: "roll", role: "rolling", place: 2 },
  { key: "twist", role: "torsion", place: 3 },
];

/** A quantity in TOML. */
function toml(value, unit) {
  if (Array.isArray(value)) return `[${value.map((one) => toml(one, unit)).join(", ")}]`;
  if (typeof value === "string" && value !== "inf") return JSON.stringify(value);
  const plain = value === "inf" ? "inf" : String(value);
  return unit === "1" || unit === undefined ? plain : JSON.stringify(`${plain} ${unit}`);
}

function list(values, unit) {
  return values.length === 1 ? toml(values[0], unit) : `[${values.map((value) => toml(value, unit)).join(", ")}]`;
}

/** `forced`: the name of a parameter that is written even if it has its default. */
function table(head, role, own, laws, forced) {
  const entry = laws.find((law) => law.role === role && (CHOICES.includes(role) || law.name === own.law));
  const lines = [`[${head}.${role}]`];
  if (!CHOICES.includes(role)) lines.push(`law = "${own.law}"`);
  for (const parameter of entry?.parameters ?? []) {
    const value = own.values[parameter.name];
    if (value === null || value === undefined || (value === parameter.default && parameter.name !== forced)) continue;
    lines.push(`${parameter.name} = ${toml(value, parameter.options ? undefined : parameter.unit)}`);
  }
  return lines.length > 1 || !CHOICES.includes(role) ? `${lines.join("\n")}\n` : "";
}

/** The contacts: `[contact]`, and `[[compare]]` where two are compared. */
function contacts(state, laws) {
  const shown = state.compare ? state.contacts.slice(0, 2) : state.contacts.slice(0, 1);
  return shown.map((contact, number) => {
    const head = number === 0 ? "contact" : "compare";
    const lines = [];
    if (number > 0) lines.push(`[[compare]]\nlabel = "B"\n`);
    else if (state.compare) lines.push(`[contact]\nlabel = "A"\n`);
    for (const role of [...ROLES, ...CHOICES]) {
      const own = contact.laws[role];
      if (own) lines.push(table(head, role, own, laws, state.forced?.role === role ? state.forced.name : undefined));
      // What is left out would be that of the first contact.
      else if (number > 0 && ROLES.includes(role) && shown[0].laws[role]) lines.push(`[compare.${role}]\nlaw = "none"\n`);
    }
    return lines.filter(Boolean).join("\n");
  });
}

/** Title, temperature, and the bodies below `head`. */
function head(state, name) {
  const lines = [];
  if (state.title) lines.push(`title = ${JSON.stringify(state.title)}`);
  if (state.temperature !== null && state.temperature !== undefined) lines.push(`temperature = "${state.temperature} K"`);
  lines.push("", `[${name}]`, `bodies = "${state.bodies}"`);
  const count = state.bodies === "wall" ? 1 : 2;
  lines.push(`radius = ${list(state.radius.slice(0, count), "m")}`);
  lines.push(`density = ${list(state.density.slice(0, count), "kg/m^3")}`);
  for (const quantity of quantities(state, state.laws)) {
    const values = state.quantities?.[quantity.name] ?? [0, 0];
    lines.push(`${quantity.name} = ${list(values.slice(0, count), quantity.unit)}`);
  }
  return lines;
}

/** What the laws that are shown read of each particle. */
export function quantities(state, laws) {
  const found = new Map();
  for (const contact of state.compare ? state.contacts.slice(0, 2) : state.contacts.slice(0, 1)) {
    for (const [role, own] of Object.entries(contact.laws)) {
      const entry = laws.find((law) => law.role === role && law.name === own.law);
      for (const quantity of entry?.quantities ?? []) {
        if (quantity.required || state.quantities?.[quantity.name]) found.set(quantity.name, quantity);
      }
    }
  }
  return [...found.values()];
}

/** The file for `pulvis collide`: collisions over the range of velocities. */
export function collideText(state, laws) {
  const lines = head({ ...state, laws }, "collision");
  if (state.method === "engine") lines.push(`method = "engine"`);
  const [from, to] = state.speeds;
  lines.push("", "[collision.sweep]", `variable = "velocity"`, `from = ${toml(from, "m/s")}`, `to = ${toml(to, "m/s")}`, `points = ${state.method === "engine" ? 24 : SPEEDS}`, `spacing = "log"`, "");
  return [...lines, ...contacts(state, laws)].join("\n").trimStart();
}

/** The file for `pulvis collide` with the one collision whose course is drawn. */
export function courseText(state, laws) {
  const lines = head({ ...state, laws }, "collision");
  if (state.method === "engine") lines.push(`method = "engine"`);
  lines.push(`velocity = ${toml(state.velocity, "m/s")}`, "");
  return [...lines, ...contacts(state, laws)].join("\n").trimStart();
}

/** Collision, velocity, angle and spins of an oblique impact. */
function oblique(state, laws) {
  const { angle, spins } = state.oblique;
  const lines = head({ ...state, laws }, "collision");
  lines.push(`velocity = ${toml(state.velocity, "m/s")}`, `angle = "${angle} deg"`);
  const keys = state.bodies === "wall" ? ["spin_i"] : ["spin_i", "spin_j"];
  keys.forEach((key, place) => spins[place] !== 0 && lines.push(`${key} = ${toml(spins[place], "rad/s")}`));
  return lines;
}

/** The file for `pulvis collide`: collisions over the angle of incidence. */
export function obliqueText(state, laws) {
  const [from, to] = ANGLES;
  const sweep = ["", "[collision.sweep]", `variable = "collision.angle"`, `from = "${from} deg"`, `to = "${to} deg"`, `points = ${ANGLE_POINTS}`, ""];
  return [...oblique(state, laws), ...sweep, ...contacts(state, laws)].join("\n").trimStart();
}

/** The file for `pulvis collide` with the one oblique collision whose forces are drawn. */
export function obliqueCourseText(state, laws) {
  return [...oblique(state, laws), "", ...contacts(state, laws)].join("\n").trimStart();
}

/** The file for `pulvis collide` with the collisions of a row of the map, of one contact; with `values`, of all its rows. */
export function mapText(state, laws, number, axis, points, values) {
  const contact = structuredClone(state.contacts[number]);
  // The same text wherever the slider of this parameter stands.
  contact.laws[axis.role].values[axis.name] = axis.from;
  const own = { ...state, laws, compare: false, contacts: [contact], forced: axis };
  const lines = head(own, "collision");
  if (state.method === "engine") lines.push(`method = "engine"`);
  const [from, to] = state.speeds;
  lines.push("", "[collision.sweep]", `variable = "velocity"`, `from = ${toml(from, "m/s")}`, `to = ${toml(to, "m/s")}`, `points = ${points}`, `spacing = "${axis.velocityLog ? "log" : "linear"}"`, "");
  if (values) lines.push("[collision.family]", `variable = "contact.${axis.key}"`, `values = [${values.join(", ")}]`, "");
  return [...lines, ...contacts(own, laws)].join("\n").trimStart();
}

/** The file for `pulvis probe`: the path. */
export function probeText(state, laws) {
  const lines = head({ ...state, laws }, "probe");
  const { poses, durations, points } = state.probe;
  for (const { key, place } of MOTIONS) {
    const turns = poses.map((pose) => pose[place]);
    if (place === 0 || turns.some((turn) => turn !== 0)) lines.push(`${key} = [${turns.map((turn) => toml(turn, "m")).join(", ")}]`);
  }
  lines.push(`points = ${points}`);
  if (durations) lines.push(`durations = [${durations.map((time) => toml(time, "s")).join(", ")}]`);
  return [...lines, "", ...contacts(state, laws)].join("\n").trimStart();
}

/** A path that shows a motion: to and fro along the normal, or along the surface of a pressed contact. */
export function pathOf(motion, depth, other, reach) {
  const place = MOTIONS.find((one) => one.key === motion).place;
  if (place === 0) return [-reach, depth, 0.6 * depth, 1.3 * depth, -reach].map((overlap) => [overlap, 0, 0, 0]);
  return [0, depth, depth, depth, depth].map((overlap, turn) => {
    const pose = [overlap, 0, 0, 0];
    pose[place] = [0, 0, other, -other, other][turn];
    return pose;
  });
}
