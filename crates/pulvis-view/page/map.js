// The sticking map of the laboratory: restitution over velocity and one parameter of the contact.

import { HeatChart } from "./heat.js";
import { ROLES, mapText } from "./scenario.js";

/** Velocities and values of the coarse map, and of the fine one where a closed form gives it. */
const COARSE = [49, 33];
const FINE = [97, 65];

/** Of contacts without closed form, every so-manieth collision at first, and then of those between. */
const STRIDES = [16, 8, 4, 2, 1];

/** Collisions of one question while the map is refined: a slider that moves does not wait for more. */
const AT_ONCE = 100;

/** Powers of ten to either side of a parameter. */
const DECADES = 1;

/** Parameters that decide over sticking, in the order in which they are looked for. */
const DECISIVE = ["kc", "f_a", "work_of_adhesion", "surface_energy", "kp"];

export class StickingMap {
  constructor(lab) {
    this.lab = lab;
    this.chart = new HeatChart({
      title: "Sticking map",
      x: { label: "impact velocity v", unit: "m/s", log: true },
      y: { label: "", unit: "1" },
      note: "this contact has no parameter for a map",
      pick: (velocity, value) => this.lab.pickPoint(velocity, value),
    });
    this.chart.root.classList.add("wide");
    this.asked = null;
  }

  /** All parameters that can be varied: those of laws that act head on. */
  parameters() {
    const { state, laws, panel } = this.lab;
    const own = state.contacts[panel.edited].laws;
    const found = [];
    for (const role of ROLES.slice(0, 3)) {
      const entry = own[role] && laws.find((law) => law.role === role && law.name === own[role].law);
      for (const parameter of entry?.parameters ?? []) {
        const value = own[role].values[parameter.name] ?? parameter.default;
        if (parameter.options || parameter.list || typeof value !== "number") continue;
        found.push({ ...parameter, role, key: `${role}.${parameter.name}`, value });
      }
    }
    return found;
  }

  /** The parameter that is varied, with its range; `null` where there is none. */
  axis() {
    const { state } = this.lab;
    const all = this.parameters();
    const rank = ({ name }) => (DECISIVE.includes(name) ? DECISIVE.indexOf(name) : DECISIVE.length);
    const chosen = all.find(({ key }) => key === state.map?.key) ?? all.filter((one) => one.value > 0).sort((a, b) => rank(a) - rank(b))[0] ?? all[0];
    if (!chosen) return null;
    const { key, value } = chosen;
    const { map } = state;
    const inside = map?.key === key && map.from < map.to && (!map.log || map.from > 0) && value >= map.from && value <= map.to;
    if (!inside) {
      state.map = { ...this.around(chosen, map?.log ?? true), key, velocityLog: map?.velocityLog ?? true };
      this.lab.panel.showMapEnds(state.map);
    }
    return { ...chosen, ...state.map };
  }

  /** A range around the value of a parameter, within what it may be. */
  around({ value, range }, log) {
    const bounded = range?.low !== null && range?.high !== null && range !== undefined;
    if (log && value > 0 && !bounded) return { log, from: value / 10 ** DECADES, to: value * 10 ** DECADES };
    if (bounded) {
      // An open end is no value.
      const inward = range.closed ? 0 : 0.005 * (range.high - range.low);
      return { log: false, from: range.low + inward, to: range.high };
    }
    const size = Math.abs(value) || 1;
    const low = range?.low ?? -4 * size;
    return { log: false, from: range?.closed || range?.low === null ? low : low + 0.02 * size, to: 4 * size };
  }

  values({ log, from, to }, count) {
    return Array.from({ length: count }, (_, place) => {
      const share = place / (count - 1);
      return Number((log ? from * (to / from) ** share : from + share * (to - from)).toPrecision(10));
    });
  }

  /** The file with the map, for `pulvis collide` too. */
  text(axis, count) {
    const { state, laws, panel } = this.lab;
    return mapText(state, laws, panel.edited, axis, count);
  }

  /** The file as it is handed out, with the values of the parameter as a family of curves. */
  file() {
    const axis = this.axis();
    return axis && mapText(this.lab.state, this.lab.laws, this.lab.panel.edited, axis, COARSE[0], this.values(axis, COARSE[1]));
  }

  /** The coarse map, with each move of a slider. */
  async redraw() {
    const axis = this.axis();
    if (!axis) {
      this.asked = null;
      this.chart.show({ series: [], cells: null, title: "Sticking map" });
      return;
    }
    const text = this.text(axis, COARSE[0]);
    const values = this.values(axis, COARSE[1]);
    const asked = JSON.stringify([text, axis.key, values]);
    if (asked !== this.asked) {
      this.asked = asked;
      try {
        const answer = await this.lab.source.map(text, { parameter: `contact.${axis.key}`, values, stride: STRIDES[0], row_stride: STRIDES[0] });
        this.take(axis, answer);
        this.stage = answer.from === "closed form" ? "closed" : 1;
      } catch (error) {
        this.asked = null;
        throw error;
      }
    }
    this.show();
  }

  take(axis, answer) {
    this.shown = { axis, cells: { x: answer.velocity, y: answer.value, rows: answer.restitution, allowed: answer.allowed, refused: answer.refused }, limits: answer.limits, from: answer.from };
  }

  /** The rest, while nothing moves. */
  async refine() {
    const { asked } = this;
    const axis = this.axis();
    if (!axis || !asked || this.refining === asked) return;
    this.refining = asked;
    const current = () => this.asked === asked && !this.lab.pending.dirty;
    try {
      if (this.stage === "closed") {
        const answer = await this.lab.source.map(this.text(axis, FINE[0]), { parameter: `contact.${axis.key}`, values: this.values(axis, FINE[1]) });
        if (!current()) return;
        this.take(axis, answer);
        this.stage = null;
        this.show();
        return;
      }
      while (this.stage !== null && this.stage < STRIDES.length) {
        if (!(await this.refineTo(axis, STRIDES[this.stage], STRIDES[this.stage - 1], current))) return;
        this.stage += 1;
      }
      this.stage = null;
    } catch {
      // The coarse map has told why.
    } finally {
      if (this.refining === asked) this.refining = null;
    }
  }

  /** Collisions between those that are known; `false`: something has moved meanwhile. */
  async refineTo(axis, stride, known, current) {
    const { cells } = this.shown;
    const text = this.text(axis, COARSE[0]);
    const rows = cells.y.map((_, row) => row).filter((row) => row % stride === 0);
    const [old, between] = [rows.filter((row) => row % known === 0), rows.filter((row) => row % known !== 0)];
    for (const [some, already] of [[old, known], [between, 0]]) {
      const size = Math.max(1, Math.floor((AT_ONCE * stride) / cells.x.length));
      for (let first = 0; first < some.length; first += size) {
        const chunk = some.slice(first, first + size);
        const answer = await this.lab.source.map(text, { parameter: `contact.${axis.key}`, values: chunk.map((row) => cells.y[row]), stride, known: already });
        if (!current()) return false;
        chunk.forEach((row, place) => this.merge(row, answer, place));
        this.show();
      }
    }
    return true;
  }

  merge(row, answer, place) {
    const { cells } = this.shown;
    cells.allowed[row] = answer.allowed[place];
    cells.refused ??= answer.refused;
    const found = answer.restitution[place];
    if (!found) return;
    cells.rows[row] = found.map((value, column) => value ?? cells.rows[row]?.[column] ?? null);
  }

  show() {
    const { state, panel } = this.lab;
    const { axis, cells, limits, from } = this.shown;
    const own = state.contacts[panel.edited].laws[axis.role]?.values[axis.name] ?? axis.value;
    const letter = state.compare ? ` of contact ${"AB"[panel.edited]}` : "";
    this.chart.show({
      title: `Sticking map${letter}, from ${from === "closed form" ? "the closed form" : "collisions"}`,
      series: [],
      x: { label: "impact velocity v", unit: "m/s", log: axis.velocityLog },
      y: { label: axis.symbol || axis.name, unit: axis.unit, log: axis.log },
      cells,
      limits: limits.map((limit) => ({ ...limit, x: limit.velocity, y: limit.value })),
      point: [state.velocity, own],
    });
  }
}
