// A film of the frames of a run. The browser encodes each frame and is waited for, so that none is lost on a slow machine.

import { button, choice } from "./controls.js";
import { download, element, quantity } from "./format.js";
import { compose } from "./picture.js";
import { webm } from "./webm.js";

/** What browsers encode, best first: their name for it, and that of the file. */
const CODECS = [["vp09.00.51.08", "V_VP9"], ["vp8", "V_VP8"]];

const RATES = [6, 12, 24, 30];
const SIZES = { shown: "as shown", "1280x720": "1280 × 720", "1920x1080": "1920 × 1080" };

/** Bits for each pixel of each frame: edges of spheres stay sharp. */
const BITS = 0.3;

/** Frames that wait for the encoder. */
const WAITING = 2;

/** Seconds between frames from which players can begin. */
const BETWEEN_KEYS = 2;

const CANNOT = "This browser cannot encode videos here: that takes WebCodecs (Chromium 94, Firefox 130, Safari 16.4 or newer) and a page of this machine, through a tunnel if need be. `pulvis render RUN --frame all --output film.apng` makes a film without a browser.";

export class Video {
  constructor(view) {
    this.view = view;
    this.rate = 12;
    this.size = "shown";
    this.recording = false;
    this.able = "VideoEncoder" in globalThis;
    this.said = element("p", { class: "summary", role: "status" }, this.able ? "" : CANNOT);
    this.root = element("section", { class: "law", "aria-label": "Video" });
  }

  build() {
    const rates = RATES.map((rate) => [String(rate), `${rate} per second`]);
    this.start = button("video", () => (this.recording ? this.stop() : this.record()), { disabled: !this.able, title: "Encode all frames as they are looked at, with legend and time, and download the film" });
    this.label();
    this.root.replaceChildren(
      choice("Frames", rates, String(this.rate), (rate) => (this.rate = Number(rate))),
      choice("Size of video", Object.entries(SIZES), this.size, (size) => (this.size = size)),
      this.start,
      this.said,
    );
    return this.root;
  }

  label() {
    this.start.textContent = this.recording ? "stop recording" : "record video.webm";
  }

  /** Ends a recording with the frame that is drawn now; what there is is kept. */
  stop() {
    this.stopped = true;
  }

  /** Width and height, which encoders want even, and pixels to the pixel of the legend. */
  extent() {
    const { canvas } = this.view;
    if (this.size !== "shown") {
      const [width, height] = this.size.split("x").map(Number);
      return { width, height, dense: height / 720 };
    }
    const dense = Math.min(window.devicePixelRatio || 1, 2);
    const even = (pixels) => 2 * Math.max(1, Math.round((pixels * dense) / 2));
    return { width: even(canvas.clientWidth), height: even(canvas.clientHeight), dense };
  }

  async record() {
    const { view } = this;
    Object.assign(this, { recording: true, stopped: false });
    this.label();
    view.pause();
    const before = view.look.number;
    try {
      const { frames, width, height, film } = await this.film();
      download("video.webm", film);
      this.said.textContent = `video.webm: ${frames} frames, ${quantity(frames / this.rate, "s", 3)}, ${width} × ${height}, ${(film.size / 1e6).toPrecision(2)} MB`;
    } catch (error) {
      this.said.textContent = `The video could not be encoded: ${error.message}. A smaller size may help.`;
    } finally {
      this.recording = false;
      this.label();
      await view.go(before);
    }
  }

  /** The best of the codecs that this browser has, with all that an encoder is told. */
  async codec({ width, height }) {
    const bitrate = Math.max(1e6, BITS * width * height * this.rate);
    for (const [codec, name] of CODECS) {
      const config = { codec, width, height, bitrate, framerate: this.rate, latencyMode: "quality" };
      const { supported } = await VideoEncoder.isConfigSupported(config);
      if (supported) return { config, name };
    }
    throw new Error(`this browser encodes neither VP9 nor VP8 of ${width} × ${height} pixels`);
  }

  async film() {
    const extent = this.extent();
    const { config, name } = await this.codec(extent);
    const encoded = [];
    let failure = null;
    const encoder = new VideoEncoder({
      output: (chunk) => {
        const data = new Uint8Array(chunk.byteLength);
        chunk.copyTo(data);
        encoded.push({ data, key: chunk.type === "key", time: Math.round(chunk.timestamp / 1000) });
      },
      error: (error) => (failure = error),
    });
    try {
      encoder.configure(config);
      const frames = await this.encode(encoder, extent, () => failure);
      await encoder.flush();
      if (failure) throw failure;
      const { width, height } = extent;
      return { frames, width, height, film: webm({ frames: encoded, codec: name, width, height, duration: (1000 * frames) / this.rate }) };
    } finally {
      if (encoder.state !== "closed") encoder.close();
    }
  }

  /** Draws and encodes frame by frame; answers with how many. */
  async encode(encoder, { width, height, dense }, failed) {
    const { view, rate } = this;
    const canvas = element("canvas", { width, height });
    const context = canvas.getContext("2d", { alpha: false });
    const count = view.run.times.length;
    let number = 0;
    while (number < count && !(this.stopped && number > 0) && !failed()) {
      this.said.textContent = `frame ${number + 1} of ${count}`;
      await view.frameOf(number);
      compose(view, context, width, height, dense);
      const frame = new VideoFrame(canvas, { timestamp: Math.round((1e6 * number) / rate), duration: Math.round(1e6 / rate) });
      encoder.encode(frame, { keyFrame: number % (BETWEEN_KEYS * rate) === 0 });
      frame.close();
      // Encoders that are fed faster than they work fill the memory.
      do await new Promise((resolve) => setTimeout(resolve, 0));
      while (encoder.encodeQueueSize > WAITING && !failed());
      number += 1;
    }
    return number;
  }
}
