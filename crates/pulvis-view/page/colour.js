// Colour maps that readers with any colour vision can tell apart.

/** Seventeen colours at equal steps, red, green and blue in two digits each. */
const MAPS = {
  // S. van der Walt and N. Smith 2015, public domain.
  viridis: "44015448186a472d7b4240863b528b33638d2c728e26828e21918c1fa08828ae803fbc735ec96284d44baddc30d8e219fde725",
  // J. R. Nuñez, C. R. Anderton and R. S. Renslow, PLoS ONE 13, e0199239 (2018).
  cividis: "00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838",
  // As in pictures of `pulvis render`: blue over light grey to red.
  "blue-red": "053a7a19528f2e6ba44283ba569bd07cb0d8a2c5dfc8d9e7eeeeeeead1caeab4a5e19781de7a5cc95f4eb44341a02733 8a0c25".replace(" ", ""),
};

export const MAP_NAMES = Object.keys(MAPS);

/** What NaN looks like. */
const MISSING = [0xb0, 0xb0, 0xb0];

function stops(name) {
  const text = MAPS[name] ?? MAPS.viridis;
  return Array.from({ length: text.length / 6 }, (_, place) => [0, 2, 4].map((digit) => parseInt(text.slice(6 * place + digit, 6 * place + digit + 2), 16)));
}

/** The colour at a share from 0 to 1. */
export function at(name, share) {
  if (!Number.isFinite(share)) return MISSING;
  const all = stops(name);
  const place = Math.min(Math.max(share, 0), 1) * (all.length - 1);
  const first = Math.min(Math.floor(place), all.length - 2);
  return all[first].map((one, part) => Math.round(one + (place - first) * (all[first + 1][part] - one)));
}

/** 256 colours for a texture, the last one for NaN. */
export function table(name) {
  const bytes = new Uint8Array(4 * 257);
  for (let place = 0; place < 257; place += 1) bytes.set([...at(name, place === 256 ? NaN : place / 255), 255], 4 * place);
  return bytes;
}

/** Draws the map from left to right. */
export function paint(canvas, name) {
  canvas.width = 256;
  canvas.height = 1;
  const context = canvas.getContext("2d");
  const image = context.createImageData(256, 1);
  image.data.set(table(name).subarray(0, 1024));
  context.putImageData(image, 0, 0);
}
