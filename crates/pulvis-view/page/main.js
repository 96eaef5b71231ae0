// The page: which view is shown, and in which light.

import { element, unpacked } from "./format.js";
import { Laboratory } from "./laboratory.js";
import { RunView } from "./run.js";
import { Embedded, Server } from "./source.js";

const main = document.getElementById("main");
const views = document.getElementById("views");
const subtitle = document.getElementById("subtitle");
const themeButton = document.getElementById("theme");
const THEMES = ["auto", "light", "dark"];
const night = matchMedia("(prefers-color-scheme: dark)");

const shown = { view: null, all: {} };

function stored(name) {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

function theme(wanted) {
  const dark = wanted === "dark" || (wanted === "auto" && night.matches);
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  themeButton.textContent = { auto: "auto", light: "light", dark: "dark" }[wanted];
  themeButton.setAttribute("aria-label", `light or dark: ${wanted}`);
  themeButton.dataset.wanted = wanted;
  try {
    localStorage.setItem("pulvis-theme", wanted);
  } catch {
    // Pages from disk may not be allowed to.
  }
  shown.view?.repaint();
}

function show(name) {
  const { view, title } = shown.all[name];
  shown.view = view;
  main.replaceChildren(view.root);
  subtitle.textContent = title ?? "";
  for (const button of views.children) {
    if (button.dataset.view === name) button.setAttribute("aria-current", "page");
    else button.removeAttribute("aria-current");
  }
  view.repaint();
}

function add(name, label, view, title) {
  shown.all[name] = { view, title };
  views.append(element("button", { type: "button", "data-view": name, onclick: () => show(name) }, label));
}

async function begin() {
  themeButton.addEventListener("click", () => theme(THEMES[(THEMES.indexOf(themeButton.dataset.wanted) + 1) % 3]));
  night.addEventListener("change", () => theme(themeButton.dataset.wanted));
  theme(THEMES.includes(stored("pulvis-theme")) ? stored("pulvis-theme") : "auto");
  const embedded = document.getElementById("embedded");
  const source = embedded ? new Embedded(JSON.parse(embedded.textContent)) : new Server();
  const hash = new URLSearchParams(location.hash.slice(1));
  const run = await source.run();
  if (run) {
    const view = new RunView(source, run);
    add("run", "Run", view, run.title ?? run.folder);
    await view.open(hash.has("lab") ? new URLSearchParams() : hash);
  }
  if (!embedded) {
    const view = new Laboratory(source);
    add("lab", "Laboratory", view, "contact laws under your hands");
    const start = () => view.open(hash.has("lab") ? unpacked(hash.get("lab")) : null);
    if (run && !hash.has("lab")) {
      // The laboratory opens when it is asked for.
      const { root } = view;
      let opened = false;
      view.repaint = () => {
        if (!opened) start();
        else Laboratory.prototype.repaint.call(view);
        opened = true;
      };
      view.root = root;
    } else {
      await start();
    }
  }
  show(run && !hash.has("lab") ? "run" : "lab");
  document.documentElement.dataset.ready = "true";
}

begin().catch((error) => {
  main.replaceChildren(element("p", { class: "message", role: "alert" }, String(error.message ?? error)));
});
