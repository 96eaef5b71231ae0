// Pictures of a run with their legend: one to download, or the frames of a film.

import { download, element, quantity } from "./format.js";

/** Draws the scene as it is looked at, `width` times `height` pixels, with legend, title and time; `dense`: pixels to the pixel of the letters. */
export function compose(view, context, width, height, dense) {
  view.scene.draw({ ...view.appearance(), quality: 1, size: [width, height] });
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.drawImage(view.canvas, 0, 0, width, height);
  context.scale(dense, dense);
  const right = width / dense;
  const { bar } = view;
  context.drawImage(bar.querySelector("canvas"), right - 235, 34, 220, 12);
  context.fillStyle = getComputedStyle(view.root).color;
  context.font = "13px system-ui, sans-serif";
  context.textAlign = "left";
  context.fillText(bar.querySelector("span").textContent, right - 235, 26);
  const ends = [...bar.querySelectorAll(".ends span")].map((span) => span.textContent);
  context.fillText(ends[0], right - 235, 62);
  context.textAlign = "right";
  context.fillText(ends[2], right - 15, 62);
  context.textAlign = "left";
  context.fillText(`${view.run.title ?? ""}  t = ${quantity(view.frame.time, "s", 5)}`, 16, 26);
}

/** Downloads the picture that is shown. */
export function savePicture(view) {
  const dense = Math.min(window.devicePixelRatio || 1, 2);
  const [width, height] = [view.canvas.clientWidth, view.canvas.clientHeight].map((length) => Math.max(1, Math.round(length * dense)));
  const whole = element("canvas", { width, height });
  compose(view, whole.getContext("2d"), width, height, dense);
  whole.toBlob((blob) => download(`frame_${String(view.look.number).padStart(4, "0")}.png`, blob), "image/png");
}
