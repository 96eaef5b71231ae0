// Numbers and units as people read them.

const PREFIXES = [["G", 1e9], ["M", 1e6], ["k", 1e3], ["", 1], ["m", 1e-3], ["µ", 1e-6], ["n", 1e-9], ["p", 1e-12], ["f", 1e-15]];

/** Units whose first letter takes a prefix. */
const PREFIXED = new Set(["m", "s", "N", "J", "Pa", "N/m", "m/s", "Pa s", "N m", "J/m^2", "W", "V", "C"]);

/** A number with so many significant digits and no more zeros than it needs. */
export function number(value, digits = 4) {
  if (value === "inf" || value === Infinity) return "∞";
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(digits)));
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return `${Number(mantissa)}e${Number(exponent)}`;
}

/** A unit as it is printed. */
export function unitText(unit) {
  return unit === "1" || unit === undefined ? "" : unit.replaceAll("^2", "²").replaceAll("^3", "³").replaceAll("^4", "⁴").replaceAll("^-1", "⁻¹");
}

/** The factor and the unit in which numbers up to `most` are short. */
export function scale(unit, most) {
  if (!PREFIXED.has(unit) || !(most > 0) || !Number.isFinite(most)) return { factor: 1, unit: unitText(unit) };
  const found = PREFIXES.find(([, size]) => most >= size * 0.9999) ?? PREFIXES.at(-1);
  return { factor: found[1], unit: found[0] + unitText(unit) };
}

/** A quantity: `23.4 µm`. */
export function quantity(value, unit, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const scaled = scale(unit, Math.abs(value));
  return `${number(value / scaled.factor, digits)} ${scaled.unit}`.trim();
}

/** Steps of an axis: 1, 2 or 5 times a power of ten. */
export function ticks(low, high, wanted = 5) {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [low];
  const rough = span / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((times) => times * power >= rough * 0.999);
  const first = Math.ceil(low / step - 1e-9);
  const found = [];
  for (let place = first; place * step <= high + 1e-9 * span; place += 1) found.push(place === 0 ? 0 : place * step);
  return found;
}

/** Powers of ten, and where they are few, twice and five times them. */
export function logTicks(low, high) {
  const from = Math.floor(Math.log10(low) + 1e-9);
  const to = Math.ceil(Math.log10(high) - 1e-9);
  const times = to - from <= 2 ? [1, 2, 5] : [1];
  const step = Math.max(1, Math.ceil((to - from) / 7));
  const found = [];
  for (let power = from; power <= to; power += step) {
    for (const one of times) {
      const value = one * 10 ** power;
      if (value >= low * 0.9999 && value <= high * 1.0001) found.push(value);
    }
  }
  return found;
}

const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** A power of ten, or a plain number. */
export function logLabel(value) {
  const power = Math.round(Math.log10(value));
  if (Math.abs(value / 10 ** power - 1) > 1e-6) return number(value, 3);
  if (power >= -2 && power <= 3) return number(value, 3);
  return `10${power < 0 ? "⁻" : ""}${[...String(Math.abs(power))].map((digit) => RAISED[Number(digit)]).join("")}`;
}

/** An element with attributes and children. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (key === "class") made.className = value;
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** Hands a file to the browser. */
export function download(name, content) {
  const blob = content instanceof Blob ? content : new Blob([content], { type: "text/plain" });
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** An object as text that may stand in an address, and back. */
export function packed(value) {
  const bytes = new TextEncoder().encode(JSON.stringify(value));
  let letters = "";
  for (const byte of bytes) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

export function unpacked(text) {
  try {
    const letters = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    return JSON.parse(new TextDecoder().decode(Uint8Array.from(letters, (letter) => letter.charCodeAt(0))));
  } catch {
    return null;
  }
}
