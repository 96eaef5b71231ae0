// A map: colours over two axes, cells that stick hatched, limits as lines, and the point where one is.

import { table } from "./colour.js";
import { Chart, MARGIN, svg, symbolText } from "./chart.js";
import { element, number } from "./format.js";

/** Colours of restitution from 0 to 1, four bytes each. */
const COLOURS = table("viridis");

function colour(share) {
  const place = 4 * Math.round(255 * Math.min(Math.max(share, 0), 1));
  return COLOURS.subarray(place, place + 4);
}

let serial = 0;

export class HeatChart extends Chart {
  constructor(options) {
    super(options);
    this.id = `map-${(serial += 1)}`;
    this.plot.classList.add("heat");
  }

  /** `cells`: `{x, y, rows, allowed}`, of each row a list of values, `null` where there is none yet; `limits`: lines `{symbol, meaning, x, y}`; `point`: `[x, y]`. */
  axes(width, height) {
    const { x, y, cells } = { ...this.options, ...this.content };
    if (!cells) return null;
    const ends = (list) => [list[0], list.at(-1)];
    return super.axes(width, height, { x: { ...x, range: ends(cells.x), tight: true }, y: { ...y, range: ends(cells.y) } });
  }

  description() {
    const { x, y, limits } = { ...this.options, ...this.content };
    const names = [...new Set((limits ?? []).map(({ symbol }) => symbol))].join(", ");
    return `${this.title.textContent}: coefficient of restitution over ${x.label} and ${y.label}${names ? `; limits ${names}` : ""}`;
  }

  placeLabels() {
    return { placed: [], rows: 0 };
  }

  drawBands(picture, height) {
    const { x, y } = this.drawn;
    const clip = svg("clipPath", { id: `${this.id}-clip` });
    clip.append(svg("rect", { x: x.pixels[0], width: x.pixels[1] - x.pixels[0], y: y.pixels[1], height: height - MARGIN.bottom - y.pixels[1] }));
    const hatch = svg("pattern", { id: `${this.id}-hatch`, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" });
    hatch.append(svg("rect", { width: 6, height: 6, class: "hatchground" }), svg("line", { x1: 3, x2: 3, y1: 0, y2: 6, class: "hatchline" }));
    this.inside = svg("g", { "clip-path": `url(#${this.id}-clip)` });
    picture.append(clip, hatch, this.inside);
    this.drawCells();
  }

  /** Cells reach half-way to the next ones; those not known yet look as the nearest coarser one. */
  drawCells() {
    const { cells } = this.content;
    const { x, y } = this.drawn;
    const edges = (axis, list) => list.concat(null).map((value, place) => {
      const [here, before] = [place, place - 1].map((one) => (list[one] === undefined ? null : axis.place(list[one])));
      const step = axis.place(list[1]) - axis.place(list[0]);
      if (before === null) return here - step / 2;
      return here === null ? before + step / 2 : (here + before) / 2;
    });
    const [across, up] = [edges(x, cells.x), edges(y, cells.y)];
    const canvas = element("canvas", {});
    [canvas.width, canvas.height] = [cells.x.length, cells.y.length];
    const context = canvas.getContext("2d");
    const image = context.createImageData(cells.x.length, cells.y.length);
    const stuck = [];
    cells.y.forEach((_, row) => {
      let from = null;
      for (let column = 0; column <= cells.x.length; column += 1) {
        const value = column < cells.x.length ? this.known(row, column) : undefined;
        if (value === 0) from ??= column;
        else if (from !== null) {
          stuck.push({ row, from, to: column });
          from = null;
        }
        if (value === null || value === undefined) continue;
        image.data.set(colour(value), 4 * ((cells.y.length - 1 - row) * cells.x.length + column));
      }
    });
    context.putImageData(image, 0, 0);
    const top = up.at(-1);
    const drawn = svg("image", { x: across[0], y: top, width: across.at(-1) - across[0], height: up[0] - top, preserveAspectRatio: "none", href: canvas.toDataURL() });
    this.inside.append(drawn);
    for (const { row, from, to } of stuck) {
      // A little more, so that no light comes through between the rows.
      this.inside.append(svg("rect", { x: across[from], width: across[to] - across[from], y: up[row + 1] - 0.25, height: up[row] - up[row + 1] + 0.5, fill: `url(#${this.id}-hatch)` }));
    }
  }

  /** The value of a cell, or that of the coarser cell that covers it. */
  known(row, column) {
    const { rows } = this.content.cells;
    for (let stride = 1; stride <= 64; stride *= 2) {
      const round = (place, most) => Math.min(Math.round(place / stride) * stride, most - (most % stride));
      const value = rows[round(row, rows.length - 1)]?.[round(column, this.content.cells.x.length - 1)];
      if (value !== null && value !== undefined) return value;
      // What the law does not allow is no coarser cell's business.
      if (this.content.cells.allowed[row] === false) return null;
    }
    return null;
  }

  drawSeries() {
    const { x, y } = this.drawn;
    this.names = [];
    for (const limit of this.content.limits ?? []) {
      const places = limit.x.map((value, place) => [x.place(value), y.place(limit.y[place])]);
      const path = places.map(([across, up], place) => `${place === 0 ? "M" : "L"}${across.toFixed(2)} ${up.toFixed(2)}`).join("");
      const group = svg("g", { class: "boundary" });
      group.append(svg("title", {}, `${limit.symbol}: ${limit.meaning}`), svg("path", { d: path, class: "halo" }), svg("path", { d: path, class: "core" }));
      this.inside.append(group);
      this.nameLine(limit, places);
    }
  }

  /** The name stands at the upper end of a line, or farther down where another name stands there. */
  nameLine(limit, places) {
    const { x, y } = this.drawn;
    const [wide, high] = [40, 16];
    const free = ([across, up]) =>
      across > x.pixels[0] + 4 && across < x.pixels[1] - wide && up > y.pixels[1] + high && up < y.pixels[0] - high / 2 &&
      this.names.every(([otherAcross, otherUp]) => Math.abs(across - otherAcross) > wide || Math.abs(up - otherUp) > high);
    const spot = places.findLast(free);
    if (!spot) return;
    this.names.push(spot);
    this.inside.append(symbolText(limit.symbol, { x: spot[0] + 6, y: spot[1] + 4, class: "boundarylabel" }));
  }

  drawMarkers(picture) {
    const { point } = this.content;
    const { x, y } = this.drawn;
    if (!point || !(point[0] >= x.low && point[0] <= x.high && point[1] >= y.low && point[1] <= y.high)) return;
    const [cx, cy] = [x.place(point[0]), y.place(point[1])];
    picture.append(svg("circle", { cx, cy, r: 6, class: "here halo" }), svg("circle", { cx, cy, r: 6, class: "here" }));
  }

  drawLegend() {
    const strip = svg("svg", { width: 96, height: 10, "aria-hidden": "true" });
    for (let place = 0; place < 24; place += 1) strip.append(svg("rect", { x: 4 * place, width: 4.5, height: 10, fill: `rgb(${colour(place / 23).subarray(0, 3).join(",")})` }));
    const mark = svg("svg", { width: 22, height: 10, "aria-hidden": "true" });
    if (this.drawn) mark.append(svg("rect", { width: 22, height: 10, fill: `url(#${this.id}-hatch)` }));
    const entries = [element("span", {}, "e = 0", strip, "1"), element("span", {}, mark, "sticks")];
    if (this.content.cells?.allowed.includes(false)) entries.push(element("span", { title: this.content.refused }, "blank: not allowed"));
    this.legend.replaceChildren(...entries);
  }

  /** The cell below the pointer. */
  hover(event) {
    if (!this.drawn) return;
    const box = this.plot.getBoundingClientRect();
    const { x, y } = this.drawn;
    const { cells } = this.content;
    const nearest = (axis, list, pixel) => list.reduce((best, value, place) => (Math.abs(axis.place(value) - pixel) < Math.abs(axis.place(list[best]) - pixel) ? place : best), 0);
    const column = nearest(x, cells.x, event.clientX - box.left);
    const row = nearest(y, cells.y, event.clientY - box.top);
    const value = cells.rows[row]?.[column];
    const said = value === 0 ? "sticks" : value === null || value === undefined ? (cells.allowed[row] === false ? "not allowed" : "…") : `e = ${number(value, 4)}`;
    const text = (axis, number_) => `${number(number_ / axis.scaled.factor, 4)} ${axis.scaled.unit}`.trim();
    this.cursor.replaceChildren(svg("circle", { cx: x.place(cells.x[column]), cy: y.place(cells.y[row]), r: 3.5, class: "here" }));
    this.readout.textContent = `${text(x, cells.x[column])}, ${text(y, cells.y[row])}: ${said}`;
  }
}
