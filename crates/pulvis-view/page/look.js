// The controls of a run: colours, sizes, cuts and series.

import { button, choice, tick } from "./controls.js";
import { VIEWS } from "./camera.js";
import { MAP_NAMES, paint } from "./colour.js";
import { element, number, unitText } from "./format.js";
import { savePicture } from "./picture.js";

/** Words for the columns that every frame has. */
export const NAMES = { v: "speed", omega: "angular velocity", f: "total force", torque: "total torque", type: "material", id: "number" };

const KEYS = [["space", "play"], ["← →", "frame"], ["x y z i", "view"], ["+ −", "zoom"], ["r", "whole"]];

export class LookPanel {
  constructor(view) {
    this.view = view;
    this.root = element("div", { class: "side", role: "group", "aria-label": "Look" });
    this.bar = element("div", { class: "colourbar" });
  }

  build() {
    const { look } = this.view;
    const columns = (this.view.frame?.columns ?? []).map(({ name }) => [name, NAMES[name] ? `${NAMES[name]} (${name})` : name.replaceAll("_", " ")]);
    const contactsBox = tick("contacts by force", look.contacts, async (on) => {
      look.contacts = on;
      look.scale = on ? 0.35 : 1;
      if (on) this.view.scene.setContacts(await this.view.source.contacts(look.number));
      this.build();
      this.view.render();
    }, "tubes as thick as the root of the normal force; blue pushes, orange pulls");
    const slide = (label, value, low, high, change) => {
      const slider = element("input", { type: "range", min: low, max: high, value, "aria-label": label, oninput: () => change(Number(slider.value)) });
      return element("div", { class: "choice" }, element("span", {}, label), slider);
    };
    const clips = [["none", "none"], ["x<", "keep low x"], ["x>", "keep high x"], ["y<", "keep low y"], ["y>", "keep high y"], ["z<", "keep low z"], ["z>", "keep high z"]];
    const series = (this.view.names ?? []).filter((name) => name !== "time").map((name) => [name, name.replaceAll("_", " ")]);
    this.root.replaceChildren(
      choice("Colour by", columns, look.column, (name) => {
        look.column = name;
        look.range = null;
        this.view.go(look.number).then(() => this.build());
      }),
      choice("Colour map", MAP_NAMES.map((name) => [name, name]), look.map, (name) => {
        look.map = name;
        this.view.scene.setMap(name);
        this.view.ends();
        this.view.render();
      }),
      this.rangeFields(),
      element("section", { class: "law" },
        slide("Size of spheres", Math.round(100 * look.scale), 5, 100, (value) => {
          look.scale = value / 100;
          this.view.render();
        }),
        element("div", {}, contactsBox),
        this.view.frame?.triangles.length ? element("div", {}, tick("surfaces of walls", look.walls, (on) => {
          look.walls = on;
          this.view.render();
        }, "half transparent; their edges are always there")) : null),
      element("section", { class: "law" },
        choice("Cut", clips, look.clip, (name) => {
          look.clip = name;
          this.view.render();
        }),
        slide("at [%]", look.cut, 0, 100, (value) => {
          look.cut = value;
          this.view.render();
        })),
      element("section", { class: "law" },
        choice("Time series", series, this.view.quantityName, (name) => this.view.loadSeries(name)),
        this.view.source.live ? tick("follow the run", this.view.follow ?? false, (on) => {
          this.view.follow = on;
          if (on) this.view.go(this.view.run.times.length - 1);
        }) : element("p", { class: "summary" }, this.embeddedNote())),
      element("div", { class: "buttons" },
        ...Object.keys(VIEWS).map((name) => button(name === "i" ? "askew" : `along ${name}`, () => this.view.turnTo(name))),
        button("whole", () => this.view.whole()),
        button("picture.png", () => savePicture(this.view), { title: "Download the picture with its legend" })),
      this.view.video.build(),
      element("p", { class: "keys" }, ...KEYS.flatMap(([keys, what]) => [element("kbd", {}, keys), ` ${what}  `])),
    );
  }

  embeddedNote() {
    const { times, frames_of_run: all, one_of: share } = this.view.run;
    const thinned = share > 1 ? `, one particle of ${share}` : "";
    return `${times.length} of ${all} frames${thinned}`;
  }

  rangeFields() {
    const field = (place, label) => {
      const input = element("input", { type: "text", inputmode: "decimal", "aria-label": label, placeholder: label, value: this.view.look.range ? number(this.view.look.range[place], 5) : "" });
      input.addEventListener("change", () => {
        const text = input.value.trim();
        const range = [...(this.view.look.range ?? this.view.own)];
        range[place] = Number(text.replace(",", "."));
        this.view.look.range = text === "" || !Number.isFinite(range[place]) ? null : range;
        this.view.ends();
        this.view.render();
      });
      return input;
    };
    const now = button("keep this range", () => {
      this.view.look.range = this.view.look.range ? null : [...this.view.own];
      this.view.ends();
      this.build();
      this.view.render();
    }, { "aria-pressed": this.view.look.range !== null, title: "The same colours for all frames, not the range of each" });
    return element("div", {}, element("div", { class: "pair" }, field(0, "colours from"), field(1, "to")), now);
  }

  legend() {
    const { look } = this.view;
    const { unit } = this.view.describe("particles_*.vtp", look.column);
    const label = `${NAMES[look.column] ?? look.column.replaceAll("_", " ")}${unit === "1" ? "" : ` [${unitText(unit)}]`}`;
    const strip = element("canvas", { role: "img", "aria-label": `colours of ${label}` });
    paint(strip, look.map);
    const [low, high] = this.view.range;
    this.bar.replaceChildren(element("span", {}, label), strip, element("div", { class: "ends" }, element("span", {}, number(low, 4)), element("span", {}, number((low + high) / 2, 4)), element("span", {}, number(high, 4))));
  }
}
