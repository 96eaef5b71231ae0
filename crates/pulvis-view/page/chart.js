// Charts in SVG: lines and points over linear or logarithmic axes, with a crosshair that reads values.

import { element, logLabel, logTicks, number, scale, ticks, unitText } from "./format.js";

const SVG = "http://www.w3.org/2000/svg";
export const MARGIN = { left: 62, right: 14, top: 10, bottom: 44 };
const GAP = 0.06;

/** Height of a row of labels above the plot, and how far apart two of them must be in one row. */
const LABEL = { height: 14, gap: 6, letter: 7 };

export function svg(name, attributes = {}, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** A symbol like `v_c^(b)` as text with parts that stand lower and higher. */
export function symbolText(symbol, attributes) {
  const made = svg("text", attributes);
  let height = 0;
  for (const part of symbol.split(/(?=[_^])/)) {
    const wanted = { _: 3, "^": -5 }[part[0]] ?? 0;
    const size = wanted === 0 ? {} : { "font-size": "80%" };
    made.append(svg("tspan", { dy: wanted - height, ...size }, part.replace(/^[_^]/, "")));
    height = wanted;
  }
  return made;
}

/** Ends of all numbers, or `null`. */
function extent(lists) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) {
    for (const value of list) {
      if (value !== null && Number.isFinite(value)) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
  }
  return low <= high ? [low, high] : null;
}

class Axis {
  constructor(range, pixels, log, unit, padded, given) {
    Object.assign(this, { log, given });
    let [low, high] = range;
    if (log) {
      low = Math.max(low, 1e-300);
      high = Math.max(high, low * 1.0001);
    } else {
      if (!(high > low)) {
        const size = Math.abs(low) || 1;
        [low, high] = [low - 0.5 * size, high + 0.5 * size];
      }
      if (padded) [low, high] = [low - GAP * (high - low), high + GAP * (high - low)];
    }
    Object.assign(this, { low, high, pixels, unit });
    this.scaled = log ? { factor: 1, unit: scale(unit, 1).unit } : scale(unit, Math.max(Math.abs(low), Math.abs(high)));
  }

  place(value) {
    const share = this.log
      ? Math.log(value / this.low) / Math.log(this.high / this.low)
      : (value - this.low) / (this.high - this.low);
    return this.pixels[0] + share * (this.pixels[1] - this.pixels[0]);
  }

  value(pixel) {
    const share = (pixel - this.pixels[0]) / (this.pixels[1] - this.pixels[0]);
    return this.log ? this.low * (this.high / this.low) ** share : this.low + share * (this.high - this.low);
  }

  ticks(wanted) {
    if (this.log) return logTicks(this.low, this.high).map((value) => [value, logLabel(value)]);
    const { factor } = this.scaled;
    if (this.given) return this.given.map((value) => [value, number(value)]);
    return ticks(this.low / factor, this.high / factor, wanted).map((value) => [value * factor, number(value, 6)]);
  }
}

/** A chart that fills its element and is drawn anew by `show`. */
export class Chart {
  /** `title`, `x` and `y` with `label` and `unit`, `x.log`, and `pick(value)` for clicks. */
  constructor(options) {
    this.options = options;
    this.legend = element("div", { class: "legend" });
    this.plot = element("div", { class: "plot" });
    this.readout = element("output", { class: "readout" });
    this.title = element("h3", {}, options.title);
    this.root = element("figure", { class: "chart" }, element("figcaption", {}, this.title, this.legend), this.plot, this.readout);
    this.content = { series: [] };
    this.observer = new ResizeObserver(() => this.draw());
    this.observer.observe(this.plot);
    this.plot.addEventListener("pointermove", (event) => this.hover(event));
    this.plot.addEventListener("pointerleave", () => this.leave());
    if (options.pick) {
      this.plot.classList.add("pickable");
      this.plot.addEventListener("click", (event) => this.click(event));
    }
  }

  /** `series`: `{name, x, y, colour, dashed, points}`; `markers`: `{x}`; `bands`: `{low, high}`; `limits`: `{x, symbol, meaning, colour}`; `note`. */
  show(content) {
    this.content = content;
    if (content.title) this.title.textContent = content.title;
    this.draw();
  }

  axes(width, height, own = {}) {
    const { series, x, y } = { ...this.options, ...this.content, ...own };
    const positive = (list) => list.map((value) => (value > 0 ? value : null));
    const xs = x.range ?? extent(series.map((one) => (x.log ? positive(one.x) : one.x)));
    const ys = y.range ?? extent([...series.map((one) => one.y), ...(y.include ? [y.include] : [])]);
    if (!xs || !ys) return null;
    return {
      x: new Axis(xs, [MARGIN.left, width - MARGIN.right], x.log ?? false, x.unit, !x.log && !x.tight, x.ticks),
      y: new Axis(ys, [height - MARGIN.bottom, this.top], y.log ?? false, y.unit, !y.range && !y.log),
    };
  }

  draw() {
    const width = this.plot.clientWidth;
    const height = this.plot.clientHeight;
    if (width < 80 || height < 80) return;
    const picture = svg("svg", { width, height, role: "img", "aria-label": this.description() });
    this.top = MARGIN.top;
    this.drawn = this.axes(width, height);
    if (this.drawn) {
      const labels = this.placeLabels(width);
      if (labels.rows > 0) {
        this.top = MARGIN.top + 2 + LABEL.height * labels.rows;
        this.drawn = this.axes(width, height);
      }
      this.drawBands(picture, height);
      this.drawAxes(picture, width, height);
      this.drawLimits(picture, height, labels.placed);
      this.drawSeries(picture);
      this.drawMarkers(picture, height);
    } else {
      picture.append(svg("text", { x: width / 2, y: height / 2, class: "empty" }, this.content.note ?? "nothing to draw"));
    }
    this.cursor = svg("g", { class: "cursor" });
    picture.append(this.cursor);
    this.plot.replaceChildren(picture);
    this.drawLegend();
  }

  description() {
    const names = this.content.series.map((one) => one.name).filter(Boolean).join(", ");
    const { x, y } = { ...this.options, ...this.content };
    const limits = (this.content.limits ?? []).map((one) => `${one.symbol} = ${number(one.x, 4)} ${x.unit}`).join(", ");
    return `${this.title.textContent}: ${y.label} over ${x.label}${names ? `; ${names}` : ""}${limits ? `; ${limits}` : ""}`;
  }

  label(axis) {
    const { label } = { ...this.options, ...this.content }[axis];
    return `${label} [${this.drawn[axis].scaled.unit || "1"}]`;
  }

  drawAxes(picture, width, height) {
    const { x, y } = this.drawn;
    const grid = svg("g", { class: "grid" });
    for (const [value, text] of x.ticks(Math.max(3, Math.floor(width / 90)))) {
      const at = x.place(value);
      grid.append(svg("line", { x1: at, x2: at, y1: this.top, y2: height - MARGIN.bottom }));
      grid.append(svg("text", { x: at, y: height - MARGIN.bottom + 16, "text-anchor": "middle" }, text));
    }
    for (const [value, text] of y.ticks(Math.max(3, Math.floor(height / 50)))) {
      const at = y.place(value);
      const zero = value === 0 ? { class: "zero" } : {};
      grid.append(svg("line", { x1: MARGIN.left, x2: width - MARGIN.right, y1: at, y2: at, ...zero }));
      grid.append(svg("text", { x: MARGIN.left - 7, y: at + 4, "text-anchor": "end" }, text));
    }
    const middle = (MARGIN.left + width - MARGIN.right) / 2;
    const centre = (this.top + height - MARGIN.bottom) / 2;
    grid.append(svg("text", { x: middle, y: height - 8, class: "axis", "text-anchor": "middle" }, this.label("x")));
    grid.append(
      svg("text", { x: 14, y: centre, class: "axis", "text-anchor": "middle", transform: `rotate(-90 14 ${centre})` }, this.label("y")),
    );
    picture.append(grid);
  }

  drawBands(picture, height) {
    const { x } = this.drawn;
    const inside = (value) => Math.min(Math.max(value, x.low), x.high);
    for (const band of this.content.bands ?? []) {
      const from = x.place(inside(band.low ?? x.low));
      const to = x.place(inside(band.high ?? x.high));
      if (to - from < 0.5) continue;
      const rectangle = svg("rect", { x: from, width: to - from, y: this.top, height: height - this.top - MARGIN.bottom, fill: band.colour, class: "band" });
      rectangle.append(svg("title", {}, band.label));
      picture.append(rectangle);
      if (to - from > 46) {
        picture.append(svg("text", { x: (from + to) / 2, y: this.top + 30 + 14 * (band.row ?? 0), class: "bandlabel", "text-anchor": "middle" }, band.label));
      }
    }
  }

  /** Limits that are in sight, each with the row of its label: labels that would touch stand in rows. */
  placeLabels(width) {
    const { x } = this.drawn;
    const ends = [];
    const inSight = (this.content.limits ?? []).filter((one) => one.x >= x.low && one.x <= x.high).sort((a, b) => a.x - b.x);
    const placed = inSight.map((limit) => {
      const wide = LABEL.letter * limit.symbol.replace(/[_^]/g, "").length;
      const at = Math.min(Math.max(x.place(limit.x), MARGIN.left + wide / 2), width - MARGIN.right - wide / 2);
      let row = ends.findIndex((end) => at - wide / 2 > end + LABEL.gap);
      if (row < 0) row = ends.length;
      ends[row] = at + wide / 2;
      return { limit, at, row };
    });
    return { placed, rows: ends.length };
  }

  drawLimits(picture, height, placed) {
    const { x } = this.drawn;
    for (const { limit, at, row } of placed) {
      const across = x.place(limit.x);
      const foot = this.top - 4 - LABEL.height * row;
      const group = svg("g", { class: "limit" });
      group.append(svg("title", {}, `${limit.symbol} = ${number(limit.x, 5)} ${unitText(x.unit)}: ${limit.meaning}`));
      group.append(svg("line", { x1: across, x2: across, y1: foot + 1, y2: height - MARGIN.bottom, stroke: limit.colour }));
      // A wider one that the pointer finds.
      group.append(svg("line", { x1: across, x2: across, y1: foot, y2: height - MARGIN.bottom, class: "handle" }));
      group.append(symbolText(limit.symbol, { x: at, y: foot - 2, "text-anchor": "middle", fill: limit.colour }));
      picture.append(group);
    }
  }

  drawSeries(picture) {
    const { x, y } = this.drawn;
    for (const one of this.content.series) {
      let path = "";
      let pen = false;
      const dots = svg("g", { fill: "none", stroke: one.colour, class: "dots" });
      one.x.forEach((value, place) => {
        const height = one.y[place];
        if (value === null || height === null || !Number.isFinite(value) || !Number.isFinite(height) || (x.log && value <= 0)) {
          pen = false;
          return;
        }
        const [across, up] = [x.place(value).toFixed(2), y.place(height).toFixed(2)];
        if (one.points) dots.append(svg("circle", { cx: across, cy: up, r: 2.6 }));
        else path += `${pen ? "L" : "M"}${across} ${up}`;
        pen = true;
      });
      if (one.points) picture.append(dots);
      else picture.append(svg("path", { d: path, stroke: one.colour, class: one.dashed ? "line dashed" : "line" }));
    }
  }

  drawMarkers(picture, height) {
    const { x } = this.drawn;
    for (const marker of this.content.markers ?? []) {
      if (!(marker.x >= x.low && marker.x <= x.high)) continue;
      const at = x.place(marker.x);
      picture.append(svg("line", { x1: at, x2: at, y1: this.top, y2: height - MARGIN.bottom, class: "marker" }));
    }
  }

  drawLegend() {
    const entry = (one) => {
      const mark = svg("svg", { width: 22, height: 10, "aria-hidden": "true" });
      if (one.points) mark.append(svg("circle", { cx: 11, cy: 5, r: 3, fill: "none", stroke: one.colour, "stroke-width": 1.4 }));
      else mark.append(svg("path", { d: "M1 5L21 5", stroke: one.colour, class: one.dashed ? "line dashed" : "line" }));
      return element("span", {}, mark, one.name);
    };
    this.legend.replaceChildren(...this.content.series.filter((one) => one.name).map(entry));
  }

  /** The point of any series that is nearest to the pointer. */
  nearest(event) {
    if (!this.drawn) return null;
    const box = this.plot.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    let best = null;
    for (const one of this.content.series) {
      one.x.forEach((value, place) => {
        const height = one.y[place];
        if (value === null || height === null || (this.drawn.x.log && value <= 0)) return;
        const [across, up] = [this.drawn.x.place(value), this.drawn.y.place(height)];
        const far = (across - px) ** 2 + 0.3 * (up - py) ** 2;
        if (!best || far < best.far) best = { far, across, up, value, height, one, place };
      });
    }
    return best;
  }

  hover(event) {
    const found = this.nearest(event);
    if (!found) return;
    const { x, y } = this.drawn;
    this.cursor.replaceChildren(svg("circle", { cx: found.across, cy: found.up, r: 4.5, stroke: found.one.colour }));
    const text = (axis, value) => `${number(value / axis.scaled.factor, 5)} ${axis.scaled.unit}`.trim();
    const more = found.one.notes ? `, ${found.one.notes[found.place]}` : "";
    this.readout.textContent = `${found.one.name ? `${found.one.name}: ` : ""}${text(x, found.value)}, ${text(y, found.height)}${more}`;
  }

  leave() {
    this.cursor?.replaceChildren();
    this.readout.textContent = "";
  }

  click(event) {
    if (!this.drawn) return;
    const box = this.plot.getBoundingClientRect();
    const { x, y } = this.drawn;
    const inside = (axis, pixel) => Math.min(Math.max(axis.value(pixel), axis.low), axis.high);
    this.options.pick(inside(x, event.clientX - box.left), inside(y, event.clientY - box.top));
  }
}
