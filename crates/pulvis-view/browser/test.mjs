// Tests of the page in a real browser: node test.mjs PULVIS CHROMIUM SCRATCH. `cargo xtask browser` calls it.

import { execFileSync, spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [pulvis, executablePath, scratch] = process.argv.slice(2);
const here = path.dirname(fileURLToPath(import.meta.url));
const axe = fs.readFileSync(fileURLToPath(import.meta.resolve("axe-core/axe.min.js")), "utf8");
const children = [];
let failures = 0;

/** Says whether something holds; NaN never does. */
function check(what, holds, found = "") {
  if (holds === true) console.log(`  ok    ${what}`);
  else {
    failures += 1;
    console.log(`  FAILED ${what} ${found}`);
  }
}

function begin(...words) {
  const child = spawn(pulvis, words, { stdio: ["ignore", "pipe", "inherit"] });
  children.push(child);
  return child;
}

/** Starts the server; answers with its address. */
function serve(...words) {
  const child = begin("view", "--no-open", ...words);
  return new Promise((resolve, reject) => {
    child.stdout.once("data", (text) => resolve(String(text).split("\n")[0]));
    child.once("exit", (code) => reject(new Error(`pulvis view ended with ${code}`)));
  });
}

const browser = await chromium.launch({
  executablePath,
  // Drawn by the processor, so that it works on machines without a graphics card.
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});

/** Opens a page; `before` runs in it before its own scripts. */
async function open(url, options = {}, before = null) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });
  if (before) await context.addInitScript(before);
  const page = await context.newPage();
  page.errors = [];
  page.on("console", (message) => message.type() === "error" && page.errors.push(message.text()));
  page.on("pageerror", (error) => page.errors.push(String(error)));
  await page.goto(url);
  await page.waitForSelector("html[data-ready]", { timeout: 60000 });
  await settled(page);
  return page;
}

/** Until nothing is asked or drawn any more. */
async function settled(page) {
  await page.waitForTimeout(300);
  await page.waitForFunction(() => !document.querySelector('[data-busy="true"]'), null, { timeout: 30000 });
  await page.waitForTimeout(400);
}

/** Axe's serious and critical faults. */
async function faults(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  return violations.filter(({ impact }) => ["serious", "critical"].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes[0].html}`);
}

async function picture(page, name) {
  await page.screenshot({ path: path.join(scratch, `${name}.png`) });
}

async function close(page, what) {
  check(`${what}: no errors in the console`, page.errors.length === 0, page.errors.join(" | "));
  await page.context().close();
}

/** The circles of a chart as data, by its axes: what is drawn, not what was sent. */
const drawn = (page) => page.evaluate(() => [...document.querySelectorAll(".pickable .dots circle")].map((dot) => Number(dot.getAttribute("cy"))));
const line = (page, chart) => page.evaluate((at) => document.querySelectorAll(".chart")[at].querySelector(".plot path.line").getAttribute("d"), chart);

async function saved(page, label, name = label) {
  const [file] = await Promise.all([page.waitForEvent("download", { timeout: 120000 }), page.getByRole("button", { name: label, exact: true }).click()]);
  const place = path.join(scratch, name);
  await file.saveAs(place);
  return place;
}

function csv(text) {
  const [head, ...rows] = text.trim().split("\n").map((row) => row.split(","));
  return (name) => rows.map((row) => row[head.indexOf(name)]);
}

async function laboratory() {
  console.log("laboratory");
  const url = await serve();
  const page = await open(url);
  check("the restitution curve has its collisions", (await drawn(page)).length === 32, (await drawn(page)).length);
  // Each circle against `pulvis collide` of the file that the page hands out.
  const table = csv(execFileSync(pulvis, ["collide", await saved(page, "collide.toml"), "--format", "csv"], { encoding: "utf8" }));
  const expected = table("restitution").map(Number);
  const places = await drawn(page);
  // e = −0.03 at the lower end of the axis, 1.05 at the upper one: two collisions give the scale, all others must fit.
  const [first, last] = [places.indexOf(Math.max(...places)), places.indexOf(Math.min(...places))];
  const scale = (places[last] - places[first]) / (expected[last] - expected[first]);
  const off = Math.max(...places.map((place, at) => Math.abs(place - places[first] - scale * (expected[at] - expected[first]))));
  check("what is drawn is what `pulvis collide` computes, to a hundredth of a pixel", off <= 0.0101 && Math.abs(scale) > 100, off);
  const probe = csv(execFileSync(pulvis, ["probe", await saved(page, "probe.toml"), "--format", "csv"], { encoding: "utf8" }));
  check("`pulvis probe` takes the file of the path", probe("force").length > 400, probe("force").length);
  execFileSync(pulvis, ["collide", await saved(page, "one-collision.toml")]);
  await limits(page);
  await map(page);
  const before = [await line(page, 0), await drawn(page)];
  await page.locator("section.law input[type=range]").first().press("ArrowRight");
  for (let times = 0; times < 40; times += 1) await page.locator("section.law input[type=range]").first().press("ArrowRight");
  await settled(page);
  const after = [await line(page, 0), await drawn(page)];
  check("a slider changes the loop and the curve", before[0] !== after[0] && String(before[1]) !== String(after[1]));
  const times = [];
  for (let time = 0; time < 20; time += 1) {
    await page.locator("section.law input[type=range]").first().press("ArrowLeft");
    await settled(page);
    times.push(Number(await page.locator("#laboratory").getAttribute("data-took")));
  }
  times.sort((a, b) => a - b);
  const all = await page.locator("#laboratory").getAttribute("data-all");
  console.log(`  a redraw takes ${times[10]} ms (median of 20; slowest ${times[19]} ms), with all 32 collisions ${all} ms`);
  check("a redraw takes a time", times[10] > 0 && times[19] < 5000, times.join(" "));
  await page.getByLabel("compare two contacts").check();
  await settled(page);
  await page.getByLabel("Normal force").selectOption("jkr");
  await settled(page);
  check("two contacts are compared", (await page.locator(".results dl").count()) === 2);
  execFileSync(pulvis, ["collide", await saved(page, "collide.toml")]);
  const found = await faults(page);
  check("accessibility, light", found.length === 0, found.join(" | "));
  await picture(page, "laboratory-light");
  // The state is in the address.
  const again = await open(page.url());
  check("the address brings the same laboratory back", (await line(again, 0)) === (await line(page, 0)));
  await close(again, "from an address");
  await close(page, "laboratory");
  await everyLaw(url);
  await oblique(url);
  const dark = await open(url, { colorScheme: "dark" });
  check("accessibility, dark", (await faults(dark)).length === 0, (await faults(dark)).join(" | "));
  await picture(dark, "laboratory-dark");
  await close(dark, "dark");
  const narrow = await open(url, { viewport: { width: 390, height: 800 } });
  const wide = await narrow.evaluate(() => document.documentElement.scrollWidth);
  check("nothing is wider than a small screen", wide <= 390, wide);
  await picture(narrow, "laboratory-narrow");
  await close(narrow, "narrow");
}

/** Collisions under an angle: what is drawn against `pulvis collide` of the file that the page hands out. */
async function oblique(url) {
  const page = await open(url);
  await page.getByLabel("Figures of papers").selectOption({ label: "Chung and Ooi, test 4: aluminium alloy, angle of incidence" });
  await settled(page);
  const table = csv(execFileSync(pulvis, ["collide", await saved(page, "collide.toml"), "--format", "csv"], { encoding: "utf8" }));
  // The lines of a chart as lists of places.
  const lines = (chart) => page.evaluate((at) => [...document.querySelectorAll(".chart")[at].querySelectorAll(".plot path.line")].map((path) => path.getAttribute("d").slice(1).split("L").map((point) => point.split(" ").map(Number))), chart);
  // The axis is known: e from −1.05 to 1.05, so that lines give the scale of each other.
  const drawnLines = await lines(0);
  const height = await page.evaluate(() => document.querySelector(".chart .plot svg").getBoundingClientRect().height);
  const up = (value) => height - 44 - ((value + 1.05) / 2.1) * (height - 54);
  ["restitution", "restitution_tangential", "restitution_contact"].forEach((name, place) => {
    const off = Math.max(...table(name).map((value, at) => Math.abs((drawnLines[place][at]?.[1] ?? NaN) - up(Number(value)))));
    check(`${name} over the angle is drawn as \`pulvis collide\` computes it, to a hundredth of a pixel`, off <= 0.0101, off);
  });
  const before = await line(page, 3);
  await page.getByRole("slider", { name: /^angle:/ }).press("ArrowRight");
  await settled(page);
  check("the angle changes the forces", (await line(page, 3)) !== before);
  const spin = page.getByRole("textbox", { name: "spin i" });
  await spin.fill("200");
  await spin.press("Enter");
  await settled(page);
  check("a spin changes the curves", String(await lines(0)) !== String(drawnLines));
  const one = csv(execFileSync(pulvis, ["collide", await saved(page, "one-collision.toml"), "--format", "csv"], { encoding: "utf8" }));
  const told = (await page.locator(".results").textContent()) ?? "";
  check("the numbers are those of `pulvis collide`", told.includes(String(Number(Number(one("restitution_contact")[0]).toPrecision(5)))), told);
  const found = await faults(page);
  check("accessibility of oblique collisions", found.length === 0, found.join(" | "));
  await picture(page, "laboratory-oblique");
  const again = await open(page.url());
  check("the address brings an oblique collision back", (await line(again, 3)) === (await line(page, 3)));
  await close(again, "from an oblique address");
  await page.getByLabel("Impact", { exact: true }).selectOption("head-on");
  await settled(page);
  check("head on there are the other charts", (await page.locator(".heat").count()) === 1);
  // A path without times is refused once for contacts with a dashpot, and asked for with times: no error of the page.
  page.errors = page.errors.filter((text) => !text.includes("422"));
  await close(page, "oblique");
}

/** Lines at the limits of the paper, with η = 4, β = 1 and v_p in the file that the page hands out: S1 (34), (37). */
async function limits(page) {
  const told = await page.evaluate(() => [...document.querySelectorAll(".limit title")].map((title) => title.textContent));
  const velocity = (symbol) => Number(told.find((text) => text.startsWith(`${symbol} = `))?.split(" ")[2]);
  const [onset, end, plastic] = ["v_c^(b)", "v_c^(c)", "v_p"].map(velocity);
  check("limits are drawn at χ = 1/2, 2/√3 and 1", Math.abs(onset / plastic - 0.5) < 1e-4 && Math.abs(end / plastic - 2 / Math.sqrt(3)) < 1e-4, told.join(" | "));
}

/** What the pointer reads off the map against `pulvis collide` of the file that the page hands out, and a click. */
async function map(page) {
  const table = csv(execFileSync(pulvis, ["collide", await saved(page, "map.toml"), "--format", "csv"], { encoding: "utf8" }));
  const expected = table("restitution_theory").map(Number);
  const [columns, rows] = [49, 33];
  check("the file of the map has all its collisions", expected.length === columns * rows, expected.length);
  await page.locator(".heat").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelector(".wide h3").textContent.includes("closed form"));
  await settled(page);
  const box = await page.locator(".heat").boundingBox();
  // The margins of a chart: 62 and 14 pixels across, 10 and 44 up.
  const spot = (column, row) => [box.x + 62 + ((box.width - 76) * column) / (columns - 1), box.y + box.height - 44 - ((box.height - 54) * row) / (rows - 1)];
  const wrong = [];
  for (const [column, row] of [[3, 2], [20, 10], [30, 16], [34, 20], [35, 24], [36, 30], [38, 28], [40, 12], [44, 25], [47, 8]]) {
    await page.mouse.move(...spot(column, row));
    const read = (await page.locator(".wide .readout").textContent()).split(": ")[1];
    const value = expected[row * columns + column];
    const same = value === 0 ? read === "sticks" : Math.abs(Number(read.replace("e = ", "")) - value) <= 0.5e-4;
    if (!same) wrong.push(`${column},${row}: ${read}, not ${value}`);
  }
  check("the map reads as `pulvis collide` computes", wrong.length === 0, wrong.join(" | "));
  check("where the pair sticks the map is hatched", (await page.locator(".heat rect[fill*=hatch]").count()) > 10);
  const velocity = () => page.getByLabel("velocity", { exact: true }).inputValue();
  const before = await velocity();
  await page.mouse.click(...spot(20, 10));
  await settled(page);
  check("a click in the map chooses velocity and parameter", (await velocity()) !== before && Number(await page.getByLabel("k_c", { exact: true }).inputValue()) < 50);
  await page.mouse.click(...spot(30, 16));
  await settled(page);
}

/** Every normal law, and every preset, without a complaint. */
async function everyLaw(url) {
  const page = await open(url);
  const complaint = async (what) => {
    await page.waitForTimeout(1200);
    const message = page.locator("#laboratory > .stage > .message");
    check(what, await message.isHidden(), (await message.textContent()) ?? "");
  };
  const select = page.getByLabel("Figures of papers");
  for (const [value, name] of await select.locator("option").evaluateAll((all) => all.map((one) => [one.value, one.textContent]))) {
    if (value === "") continue;
    await select.selectOption(value);
    await complaint(name);
  }
  const laws = await page.getByLabel("Normal force").locator("option").evaluateAll((all) => all.map((one) => one.value));
  for (const law of laws) {
    await page.getByLabel("Normal force").selectOption(law);
    await complaint(law);
  }
  // Laws that relax with time are refused once before they are asked for in steps: that refusal is no error of the page.
  page.errors = page.errors.filter((text) => !text.includes("422"));
  await close(page, "all laws");
}

async function run() {
  console.log("a run that goes on");
  const folder = path.join(scratch, "growing");
  const running = begin("run", path.join(here, "growing.toml"), "--output", folder, "--quiet", "--force");
  while (!fs.existsSync(path.join(folder, "series.pvd"))) await new Promise((resolve) => setTimeout(resolve, 100));
  const url = await serve(folder);
  const page = await open(url);
  const frames = async () => Number(await page.locator(".player input").getAttribute("max"));
  const before = await frames();
  await page.waitForFunction((old) => Number(document.querySelector(".player input").max) > old, before, { timeout: 30000 }).catch(() => {});
  check("the run grows while it is watched", (await frames()) > before, `${before} ${await frames()}`);
  check("it is called live", await page.locator(".live").isVisible());
  running.kill("SIGINT");
  await page.getByLabel("follow the run").uncheck();
  await settled(page);
  const shot = () => page.locator(".viewport > canvas").screenshot();
  const last = await shot();
  await page.locator(".player input").fill("0");
  await settled(page);
  const first = await shot();
  check("the slider changes the picture", !first.equals(last));
  await page.getByLabel("Colour by").selectOption("radius");
  await settled(page);
  const coloured = await shot();
  check("the colour changes the picture", !coloured.equals(first));
  check("the legend has its unit", (await page.locator(".colourbar").textContent()).includes("[m]"), await page.locator(".colourbar").textContent());
  await page.getByLabel("Colour map").selectOption("cividis");
  await settled(page);
  check("the colour map changes the picture", !(await shot()).equals(coloured));
  const box = await page.locator(".viewport > canvas").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await settled(page);
  const told = (await page.locator(".picked").textContent()) ?? "";
  check("a click tells the values of a particle", /particle \d+/.test(told) && told.includes("radius"), told);
  await page.mouse.click(box.x + 5, box.y + box.height - 5);
  await settled(page);
  check("a click beside them tells nothing", await page.locator(".picked").isHidden());
  await page.getByLabel("Cut").selectOption("x<");
  await settled(page);
  const cut = await shot();
  await page.getByLabel("contacts by force").check();
  await settled(page);
  const network = await shot();
  check("contacts change the picture", !network.equals(cut));
  await page.getByLabel("surfaces of walls").uncheck();
  await settled(page);
  check("walls are shown and can be hidden", !(await shot()).equals(network));
  check("hidden walls are in the address", page.url().includes("walls=0"), page.url());
  await page.locator(".viewport > canvas").press("z");
  await settled(page);
  check("the camera is in the address", page.url().includes("camera="), page.url());
  check("accessibility of the run", (await faults(page)).length === 0, (await faults(page)).join(" | "));
  await picture(page, "run-light");
  await close(page, "run");
  const dark = await open(url, { colorScheme: "dark" });
  check("accessibility of the run, dark", (await faults(dark)).length === 0, (await faults(dark)).join(" | "));
  await picture(dark, "run-dark");
  await close(dark, "run, dark");
  await exported(folder);
}

async function exported(folder) {
  console.log("an exported run");
  const file = path.join(scratch, "exported.html");
  execFileSync(pulvis, ["export", folder, "--html", file, "--force"]);
  const page = await open(pathToFileURL(file).href);
  const shot = () => page.locator(".viewport > canvas").screenshot();
  const last = await shot();
  await page.locator(".player input").fill("0");
  await settled(page);
  check("it opens from disk, and its slider changes the picture", !(await shot()).equals(last));
  await page.getByLabel("Colour by").selectOption("coordination");
  const box = await page.locator(".viewport > canvas").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await settled(page);
  check("a click tells the values of a particle", /particle \d+/.test((await page.locator(".picked").textContent()) ?? ""));
  await page.locator(".player input").fill(await page.locator(".player input").getAttribute("max"));
  await settled(page);
  // Those at the top may be flying.
  let contacts = "";
  for (let place = 0; place < 40 && !contacts.includes("normal force"); place += 1) {
    await page.mouse.click(box.x + box.width * (0.3 + 0.05 * (place % 8)), box.y + box.height * (0.5 + 0.06 * Math.floor(place / 8)));
    await settled(page);
    // What was told last stays in a box that is hidden.
    contacts = (await page.locator(".picked").isVisible()) ? ((await page.locator(".picked").textContent()) ?? "") : "";
  }
  check("and its contacts", /normal force/.test(contacts) && / N/.test(contacts), contacts);
  await page.locator(".picked button.link").nth(1).click();
  await settled(page);
  const other = (await page.locator(".picked").textContent()) ?? "";
  check("from which one goes on to the other particle", other !== contacts && /particle \d+/.test(other), other);
  await video(page);
  await picture(page, "exported");
  await close(page, "exported");
  const old = await open(pathToFileURL(file).href, {}, () => delete globalThis.VideoEncoder);
  const told = await old.getByRole("region", { name: "Video" }).textContent();
  check("a browser that cannot encode videos is told what to do", (await old.getByRole("button", { name: "record video.webm" }).isDisabled()) && told.includes("pulvis render RUN"), told);
  await close(old, "without an encoder");
}

/** A film of all frames, and one that is stopped: length, size and number of different pictures, as a player sees them. */
async function video(page) {
  const count = Number(await page.locator(".player input").getAttribute("max")) + 1;
  await page.getByLabel("Frames").selectOption("24");
  await page.getByLabel("Size of video").selectOption("1280x720");
  const whole = fs.readFileSync(await saved(page, "record video.webm", "video.webm"));
  const film = await played(whole, 24);
  check("a film has a picture for each frame", film.pictures === count, `${film.pictures} ${count}`);
  check("it is as long as its frames", Math.abs(film.duration - count / 24) < 0.002, `${film.duration} ${count}/24`);
  check("it is as large as asked for", film.width === 1280 && film.height === 720, `${film.width} x ${film.height}`);
  const [part] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "record video.webm" }).press("Enter").then(() => page.getByRole("button", { name: "stop recording" }).press("Escape"))]);
  const place = path.join(scratch, "part.webm");
  await part.saveAs(place);
  const short = await played(fs.readFileSync(place), 24);
  check("escape ends it, and what there is is kept", short.pictures >= 1 && short.pictures < count, `${short.pictures} ${count}`);
  await settled(page);
}

/** What a player makes of a film. */
async function played(film, rate) {
  const context = await browser.newContext();
  const page = await context.newPage();
  const seen = await page.evaluate(async ([letters, each]) => {
    const player = document.createElement("video");
    player.muted = true;
    player.src = `data:video/webm;base64,${letters}`;
    const happens = (name) => new Promise((resolve, reject) => {
      player.addEventListener(name, resolve, { once: true });
      player.addEventListener("error", () => reject(new Error(player.error?.message)), { once: true });
    });
    await happens("loadedmetadata");
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [player.videoWidth, player.videoHeight];
    const context2d = canvas.getContext("2d", { willReadFrequently: true });
    const pictures = new Set();
    for (let time = 0.5 / each; time < player.duration; time += 1 / each) {
      const there = happens("seeked");
      player.currentTime = time;
      await there;
      context2d.drawImage(player, 0, 0);
      const { data } = context2d.getImageData(0, 0, canvas.width, canvas.height);
      let sum = 0;
      for (let at = 0; at < data.length; at += 1) sum = (31 * sum + data[at]) % 2147483647;
      pictures.add(sum);
    }
    return { duration: player.duration, width: player.videoWidth, height: player.videoHeight, pictures: pictures.size };
  }, [film.toString("base64"), rate]);
  await context.close();
  return seen;
}

async function large() {
  console.log("a hundred thousand spheres");
  const folder = path.join(scratch, "large");
  if (!fs.existsSync(folder)) execFileSync(pulvis, ["run", path.join(here, "large.toml"), "--output", folder, "--quiet"]);
  const page = await open(await serve(folder));
  await page.waitForFunction(() => document.querySelector(".corner").textContent.includes("100000"), null, { timeout: 60000 });
  // Turns the bed for three seconds; a picture that is read back is drawn.
  const rate = await page.evaluate(async () => {
    const canvas = document.querySelector(".viewport > canvas");
    const gl = canvas.getContext("webgl2");
    const began = performance.now();
    let frames = 0;
    while (performance.now() - began < 3000) {
      canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", shiftKey: true, bubbles: true }));
      await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      frames += 1;
    }
    return (1000 * frames) / (performance.now() - began);
  });
  console.log(`  ${rate.toFixed(1)} pictures per second of 1440 x 900, drawn by the processor (SwiftShader), without a graphics card, moving pictures coarser where they are slow`);
  check("a hundred thousand spheres can be turned", rate > 0.05, rate);
  await picture(page, "large");
  await close(page, "large");
}

try {
  await laboratory();
  await run();
  await large();
} catch (error) {
  failures += 1;
  console.log(`  FAILED ${error.stack}`);
} finally {
  await browser.close();
  for (const child of children) child.kill();
}
console.log(failures === 0 ? "all well" : `${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
