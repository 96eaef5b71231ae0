// Sliders for quantities over many powers of ten, with a field beside them.

import { element, number, unitText } from "./format.js";

/** Positions of a slider. */
const STEPS = 1000;

/** Powers of ten to either side of the first value. */
const DECADES = 2;

/** Where a parameter has no size of its own to begin with, by unit. */
const TYPICAL = { "N/m": 100, "kg/s": 1e-3, Pa: 1e8, "1": 0.3, m: 1e-6, s: 1e-4, N: 1e-6, "J/m^2": 0.1, "m/s": 0.1, K: 300, "1/s": 100, "rad/s": 100, C: 1e-12 };

let serial = 0;

/** A quantity: label, slider, field, unit. `options`: `name`, `meaning`, `unit`, `range` (`low`, `high`, `closed`), `change`. */
export class Quantity {
  constructor(options, value) {
    this.options = options;
    this.id = `quantity-${(serial += 1)}`;
    const { name, meaning, unit } = options;
    this.slider = element("input", { type: "range", min: 0, max: STEPS, id: `${this.id}-slider`, "aria-label": `${name}: ${meaning}`, oninput: () => this.slid() });
    this.field = element("input", { type: "text", inputmode: "decimal", id: this.id, title: meaning, autocomplete: "off", onchange: () => this.typed() });
    this.root = element(
      "div",
      { class: "quantity", title: meaning },
      element("label", { for: this.id }, options.shown ?? name),
      this.slider,
      this.field,
      element("span", { class: "unit" }, unitText(unit) || " "),
    );
    this.set(value);
  }

  /** Ends of the slider: those of the range where it has two, else powers of ten around the value. */
  limits(value) {
    const { range, unit } = this.options;
    const bounded = range && range.low !== null && range.high !== null;
    if (bounded) return { log: false, low: range.low, high: range.high };
    if (range && range.low === null) {
      const size = Math.abs(value) || TYPICAL[unit] || 1;
      return { log: false, low: -4 * size, high: 4 * size };
    }
    const base = value > 0 && Number.isFinite(value) ? value : (TYPICAL[unit] ?? 1);
    return { log: true, low: base / 10 ** DECADES, high: base * 10 ** DECADES };
  }

  set(value) {
    this.value = value;
    const plain = value === "inf" ? Infinity : value;
    const { log, low, high } = this.scale ?? {};
    const outside = !this.scale || (Number.isFinite(plain) && plain !== 0 && (plain < low || plain > high));
    if (outside) this.scale = this.limits(plain);
    this.show(plain);
    return { log };
  }

  show(value) {
    const { log, low, high } = this.scale;
    const share = log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    // Over powers of ten, the lowest notch is zero where zero is allowed.
    this.slider.value = log && value === 0 ? 0 : Math.round(Math.min(Math.max(share, 0), 1) * STEPS);
    this.field.value = value === Infinity ? "inf" : number(value, 5);
    this.slider.setAttribute("aria-valuetext", `${this.field.value} ${this.options.unit}`);
  }

  slid() {
    const position = Number(this.slider.value);
    const { log, low, high } = this.scale;
    const { range } = this.options;
    const share = position / STEPS;
    let value = log ? low * (high / low) ** share : low + share * (high - low);
    if (position === 0 && log && range?.closed && range.low === 0) value = 0;
    // An open end is no value.
    if (!log && range && !range.closed && value === range.low) value += 0.001 * (high - low);
    this.value = Number(value.toPrecision(4));
    this.show(this.value);
    this.options.change(this.value);
  }

  typed() {
    const text = this.field.value.trim().replace(",", ".");
    const value = text === "inf" || text === "∞" ? "inf" : Number(text);
    const bad = text === "" || Number.isNaN(value);
    this.field.setAttribute("aria-invalid", bad);
    if (bad) return;
    this.set(value);
    this.options.change(value);
  }
}

/** A choice of names. `groups` is a list of `[value, text, title]`. */
export function choice(label, entries, value, change) {
  const id = `choice-${(serial += 1)}`;
  const options = entries.map(([key, text, title]) => element("option", { value: key, title, selected: key === value }, text));
  const select = element("select", { id, onchange: () => change(select.value) }, ...options);
  return element("div", { class: "choice" }, element("label", { for: id }, label), select);
}

/** A box to be ticked. */
export function tick(label, value, change, title) {
  const box = element("input", { type: "checkbox", checked: value, onchange: () => change(box.checked) });
  return element("label", { class: "tick", title }, box, label);
}

export function button(label, press, attributes = {}) {
  return element("button", { type: "button", onclick: press, ...attributes }, label);
}
