// A camera that turns around a point, z up, and the hands that move it.

const VIEW_ANGLE = (34 * Math.PI) / 180;
const TURN = 0.007;
const LEAST_ELEVATION = -Math.PI / 2 + 1e-3;

const add = (a, b, times = 1) => a.map((one, axis) => one + times * b[axis]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Azimuth and elevation of named views: from the right, the front, above, and askew. */
export const VIEWS = { x: [0, 0], y: [-Math.PI / 2, 0], z: [-Math.PI / 2, Math.PI / 2 - 1e-3], i: [-0.9, 0.42] };

export class Camera {
  azimuth = VIEWS.i[0];
  elevation = VIEWS.i[1];
  target = [0, 0, 0];
  distance = 1;
  size = 1;

  /** Looks at a box from far enough. */
  fit(low, high) {
    this.target = low.map((one, axis) => (one + high[axis]) / 2);
    this.size = Math.max(Math.hypot(...high.map((one, axis) => one - low[axis])), 1e-12);
    this.distance = (0.5 * this.size) / Math.sin(VIEW_ANGLE / 2);
  }

  /** Unit vectors to the right, up and towards the eye. */
  axes() {
    const [ca, sa, ce, se] = [Math.cos(this.azimuth), Math.sin(this.azimuth), Math.cos(this.elevation), Math.sin(this.elevation)];
    const back = [ce * ca, ce * sa, se];
    const right = [-sa, ca, 0];
    return { right, up: cross(back, right), back };
  }

  eye() {
    return add(this.target, this.axes().back, this.distance);
  }

  /** World to eye, and eye to screen, both by columns. */
  matrices(aspect) {
    const { right, up, back } = this.axes();
    const eye = this.eye();
    const view = [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0, -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
    // A screen that is higher than wide sees as much across as a wide one sees upwards.
    const f = (1 / Math.tan(VIEW_ANGLE / 2)) * Math.min(1, aspect);
    const near = Math.max(this.distance - 2 * this.size, 0.01 * this.distance);
    const far = this.distance + 2 * this.size;
    const projection = [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
    return { view: new Float32Array(view), projection: new Float32Array(projection) };
  }

  turn(across, up) {
    this.azimuth -= across * TURN;
    this.elevation = Math.min(Math.max(this.elevation + up * TURN, LEAST_ELEVATION), -LEAST_ELEVATION);
  }

  move(across, up, height) {
    const { right, up: top } = this.axes();
    const perPixel = (2 * this.distance * Math.tan(VIEW_ANGLE / 2)) / height;
    this.target = add(add(this.target, right, -across * perPixel), top, up * perPixel);
  }

  zoom(times) {
    this.distance = Math.min(Math.max(this.distance * times, 0.02 * this.size), 20 * this.size);
  }

  /** As text in an address, and back. */
  text() {
    return [this.azimuth, this.elevation, this.distance, ...this.target].map((one) => Number(one.toPrecision(5))).join(",");
  }

  read(text) {
    const numbers = text.split(",").map(Number);
    if (numbers.length !== 6 || numbers.some((one) => !Number.isFinite(one)) || !(numbers[2] > 0)) return;
    [this.azimuth, this.elevation, this.distance] = numbers;
    this.target = numbers.slice(3);
  }

  /** Mouse, fingers and wheel on an element; `changed` after each motion, `clicked(x, y)` where nothing moved. */
  listen(canvas, changed, clicked) {
    const fingers = new Map();
    let moved = 0;
    const spread = () => {
      const [one, other] = [...fingers.values()];
      return Math.hypot(one.x - other.x, one.y - other.y);
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      moved = 0;
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const [across, up] = [event.clientX - before.x, event.clientY - before.y];
      const wide = fingers.size === 2 ? spread() : 0;
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      moved += Math.abs(across) + Math.abs(up);
      if (fingers.size === 2) {
        this.zoom(wide / Math.max(spread(), 1));
        this.move(across / 2, up / 2, canvas.clientHeight);
      } else if (event.shiftKey || event.buttons & 6) this.move(across, up, canvas.clientHeight);
      else this.turn(across, up);
      changed();
    });
    const lift = (event) => {
      const was = fingers.delete(event.pointerId);
      if (was && event.type === "pointerup" && moved < 4) {
        const box = canvas.getBoundingClientRect();
        clicked(event.clientX - box.left, event.clientY - box.top);
      }
    };
    canvas.addEventListener("pointerup", lift);
    canvas.addEventListener("pointercancel", lift);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(0.0012 * event.deltaY));
      changed();
    }, { passive: false });
  }
}
