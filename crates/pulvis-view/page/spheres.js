// Spheres, contacts and lines in WebGL 2. A sphere is a square that faces the eye; the fragment shader finds where the line of sight
// meets the sphere, so that it is round at any distance and cuts others where it should.

import { table } from "./colour.js";

const SPHERE_VERTICES = `#version 300 es
in vec2 corner;
in vec3 centre;
in float radius;
in float value;
uniform mat4 view, projection;
uniform float scale;
uniform vec4 clip;
uniform vec2 range;
flat out vec3 middle;
flat out float size;
flat out float share;
flat out int row;
out vec3 ray;
void main() {
  middle = (view * vec4(centre, 1.0)).xyz;
  size = radius * scale;
  share = isnan(value) ? -1.0 : clamp((value - range.x) / max(range.y - range.x, 1e-38), 0.0, 1.0);
  row = gl_InstanceID;
  // Seen from the eye, the outline of a sphere is wider than its radius.
  float far = length(middle);
  vec3 towards = middle / far;
  vec3 across = normalize(cross(towards, vec3(0.0, 1.0, 0.0)));
  vec3 up = cross(across, towards);
  float wide = size * far / sqrt(max(far * far - size * size, 1e-30));
  ray = middle + (corner.x * across + corner.y * up) * wide;
  gl_Position = projection * vec4(ray, 1.0);
  if (dot(clip.xyz, centre) > clip.w || size <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const SPHERE_FRAGMENTS = `#version 300 es
precision highp float;
flat in vec3 middle;
flat in float size;
flat in float share;
flat in int row;
in vec3 ray;
uniform mat4 projection;
uniform sampler2D map;
uniform bool picking;
uniform int chosen;
uniform vec3 mark;
out vec4 colour;
void main() {
  vec3 towards = normalize(ray);
  float along = dot(towards, middle);
  float inside = along * along - dot(middle, middle) + size * size;
  // The edge fades over a pixel; where there is one sample to a pixel it is hard.
  float edge = picking ? step(0.0, inside) : clamp(inside / max(fwidth(inside), 1e-38), 0.0, 1.0);
  if (edge <= 0.0) discard;
  vec3 point = towards * (along - sqrt(max(inside, 0.0)));
  vec4 place = projection * vec4(point, 1.0);
  gl_FragDepth = 0.5 * place.z / place.w + 0.5;
  if (picking) {
    int number = row + 1;
    colour = vec4(float(number & 255), float((number >> 8) & 255), float((number >> 16) & 255), 255.0) / 255.0;
    return;
  }
  vec3 normal = (point - middle) / size;
  vec3 base = share < 0.0 ? vec3(0.69) : texture(map, vec2((share * 255.0 + 0.5) / 257.0, 0.5)).rgb;
  float facing = max(dot(normal, -towards), 0.0);
  float light = max(dot(normal, normalize(vec3(-0.45, 0.65, 0.8))), 0.0);
  float shine = pow(max(dot(normal, normalize(vec3(-0.3, 0.45, 1.0))), 0.0), 40.0);
  vec3 shaded = base * (0.34 + 0.72 * light) * (0.55 + 0.45 * smoothstep(0.0, 0.55, facing)) + 0.12 * shine;
  if (row == chosen) shaded = mix(mark, shaded, smoothstep(0.25, 0.6, facing));
  colour = vec4(shaded, edge);
}`;

const TUBE_VERTICES = `#version 300 es
in vec2 corner;
in vec3 from;
in vec3 to;
in float force;
uniform mat4 view, projection;
uniform float width, most;
uniform vec4 clip;
out float across;
flat out float sign_;
void main() {
  vec3 a = (view * vec4(from, 1.0)).xyz, b = (view * vec4(to, 1.0)).xyz;
  vec3 place = corner.y < 0.0 ? a : b;
  vec3 side = normalize(cross(b - a, place));
  float thick = width * sqrt(clamp(abs(force) / most, 0.0, 1.0));
  across = corner.x;
  sign_ = sign(force);
  gl_Position = projection * vec4(place + side * thick * corner.x, 1.0);
  if (dot(clip.xyz, 0.5 * (from + to)) > clip.w || thick <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const TUBE_FRAGMENTS = `#version 300 es
precision highp float;
in float across;
flat in float sign_;
uniform vec3 push, pull;
out vec4 colour;
void main() {
  colour = vec4((sign_ < 0.0 ? pull : push) * (0.5 + 0.5 * sqrt(1.0 - across * across)), 1.0);
}`;

const LINE_VERTICES = `#version 300 es
in vec3 centre;
uniform mat4 view, projection;
void main() { gl_Position = projection * view * vec4(centre, 1.0); }`;

const LINE_FRAGMENTS = `#version 300 es
precision highp float;
uniform vec3 ink;
out vec4 colour;
void main() { colour = vec4(ink, 1.0); }`;

const SURFACE_VERTICES = `#version 300 es
in vec3 centre;
uniform mat4 view, projection;
out vec3 place, seen;
void main() {
  place = centre;
  seen = (view * vec4(centre, 1.0)).xyz;
  gl_Position = projection * vec4(seen, 1.0);
}`;

const SURFACE_FRAGMENTS = `#version 300 es
precision highp float;
in vec3 place, seen;
uniform vec4 clip;
uniform vec3 ink;
out vec4 colour;
void main() {
  if (dot(clip.xyz, place) > clip.w) discard;
  // Both sides of a wall are seen: what faces the eye is lighter and shows more of what is behind.
  vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
  float facing = abs(dot(normal, normalize(seen)));
  colour = vec4(ink, 0.3 - 0.2 * facing);
}`;

/** Sides of a circle. */
const SIDES = 64;

function program(gl, vertices, fragments) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertices], [gl.FRAGMENT_SHADER, fragments]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  const uniforms = {};
  for (let place = 0; place < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); place += 1) {
    const { name } = gl.getActiveUniform(made, place);
    uniforms[name] = gl.getUniformLocation(made, name);
  }
  return { made, uniforms };
}

/** Lines of walls: edges as they are, a cylinder as circles at its ends and lines between them. */
export function outlines(walls, radii) {
  const lines = [];
  for (let number = 0; number < radii.length; number += 1) {
    const ends = [...walls.subarray(6 * number, 6 * number + 6)];
    const radius = radii[number];
    if (!(radius > 0)) {
      lines.push(...ends);
      continue;
    }
    const [from, to] = [ends.slice(0, 3), ends.slice(3)];
    const axis = to.map((one, place) => one - from[place]);
    const length = Math.hypot(...axis) || 1;
    const along = axis.map((one) => one / length);
    const other = Math.abs(along[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0];
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const first = cross(along, other);
    const size = Math.hypot(...first);
    const u = first.map((one) => one / size);
    const v = cross(along, u);
    const rim = (middle, angle) => middle.map((one, place) => one + radius * (Math.cos(angle) * u[place] + Math.sin(angle) * v[place]));
    for (let side = 0; side < SIDES; side += 1) {
      const [a, b] = [side, side + 1].map((one) => (2 * Math.PI * one) / SIDES);
      lines.push(...rim(from, a), ...rim(from, b), ...rim(to, a), ...rim(to, b));
      if (side % (SIDES / 8) === 0) lines.push(...rim(from, a), ...rim(to, a));
    }
  }
  return new Float32Array(lines);
}

export class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false });
    if (!gl) throw new Error("this browser has no WebGL 2, which draws the particles");
    this.gl = gl;
    this.spheres = program(gl, SPHERE_VERTICES, SPHERE_FRAGMENTS);
    this.tubes = program(gl, TUBE_VERTICES, TUBE_FRAGMENTS);
    this.lines = program(gl, LINE_VERTICES, LINE_FRAGMENTS);
    this.surfaces = program(gl, SURFACE_VERTICES, SURFACE_FRAGMENTS);
    this.corner = this.buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    const [centre, radius, value, ends, force, wall, triangle] = Array.from({ length: 7 }, () => gl.createBuffer());
    this.buffers = { centre, radius, value, ends, force, wall, triangle };
    this.sphereArrays = this.arrays(this.spheres.made, [["corner", this.corner, 2, 0, 0, 0], ["centre", centre, 3, 1, 0, 0], ["radius", radius, 1, 1, 0, 0], ["value", value, 1, 1, 0, 0]]);
    this.tubeArrays = this.arrays(this.tubes.made, [["corner", this.corner, 2, 0, 0, 0], ["from", ends, 3, 1, 24, 0], ["to", ends, 3, 1, 24, 12], ["force", force, 1, 1, 0, 0]]);
    this.lineArrays = this.arrays(this.lines.made, [["centre", wall, 3, 0, 0, 0]]);
    this.surfaceArrays = this.arrays(this.surfaces.made, [["centre", triangle, 3, 0, 0, 0]]);
    this.texture = gl.createTexture();
    this.count = { spheres: 0, tubes: 0, lines: 0, corners: 0 };
    this.setMap("viridis");
  }

  buffer(numbers) {
    const { gl } = this;
    const made = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, made);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
    return made;
  }

  arrays(made, attributes) {
    const { gl } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    for (const [name, buffer, size, divisor, stride, offset] of attributes) {
      const place = gl.getAttribLocation(made, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, offset);
      gl.vertexAttribDivisor(place, divisor);
    }
    return array;
  }

  fill(name, numbers) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
  }

  setFrame({ positions, radii, values, walls, wallRadii, triangles }) {
    this.fill("centre", positions);
    this.fill("radius", radii);
    this.fill("value", values);
    const lines = outlines(walls, wallRadii);
    this.fill("wall", lines);
    this.count.spheres = radii.length;
    this.count.lines = lines.length / 3;
    this.fill("triangle", triangles);
    this.count.corners = triangles.length / 3;
  }

  setContacts({ ends, forces }) {
    this.fill("ends", ends);
    this.fill("force", forces);
    this.count.tubes = forces.length;
    this.most = forces.reduce((most, force) => Math.max(most, Math.abs(force)), 0) || 1;
  }

  setMap(name) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 257, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, table(name));
    for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.NEAREST], [gl.TEXTURE_MAG_FILTER, gl.NEAREST], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
  }

  /** `look`: `camera`, `quality` (pixels to the pixel), `size` (in pixels, in place of what is shown), `range`, `scale`, `clip` (normal and offset), `chosen`, `contacts` (width), `walls` (whether their surfaces are shown), `ink`, `ground`. */
  draw(look) {
    const { gl, canvas } = this;
    const dense = Math.min(window.devicePixelRatio || 1, 2) * look.quality;
    const [width, height] = look.size ?? [Math.max(1, Math.round(canvas.clientWidth * dense)), Math.max(1, Math.round(canvas.clientHeight * dense))];
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.clearColor(...look.ground, 1);
    this.matrices = look.camera.matrices(width / height);
    this.paint(look, false);
  }

  paint(look, picking) {
    const { gl, count } = this;
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const begin = ({ made, uniforms }, array) => {
      gl.useProgram(made);
      gl.bindVertexArray(array);
      gl.uniformMatrix4fv(uniforms.view, false, this.matrices.view);
      gl.uniformMatrix4fv(uniforms.projection, false, this.matrices.projection);
      if (uniforms.clip) gl.uniform4fv(uniforms.clip, look.clip);
      return uniforms;
    };
    const sphere = begin(this.spheres, this.sphereArrays);
    gl.uniform1f(sphere.scale, look.scale);
    gl.uniform2fv(sphere.range, look.range);
    gl.uniform1i(sphere.picking, picking ? 1 : 0);
    gl.uniform1i(sphere.chosen, look.chosen ?? -1);
    gl.uniform3fv(sphere.mark, look.mark);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    if (!picking) gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count.spheres);
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    if (picking) return;
    if (look.contacts > 0 && count.tubes > 0) {
      const tube = begin(this.tubes, this.tubeArrays);
      gl.uniform1f(tube.width, look.contacts);
      gl.uniform1f(tube.most, this.most);
      gl.uniform3fv(tube.push, look.push);
      gl.uniform3fv(tube.pull, look.pull);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count.tubes);
    }
    const line = begin(this.lines, this.lineArrays);
    gl.uniform3fv(line.ink, look.ink);
    gl.drawArrays(gl.LINES, 0, count.lines);
    if (!look.walls || count.corners === 0) return;
    // What is half transparent comes last, and hides nothing.
    const surface = begin(this.surfaces, this.surfaceArrays);
    gl.uniform3fv(surface.ink, look.ink);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    gl.drawArrays(gl.TRIANGLES, 0, count.corners);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  /** The row of the particle at a point of the canvas in CSS pixels, or -1. */
  pick(look, x, y) {
    const { gl, canvas } = this;
    const dense = canvas.width / canvas.clientWidth;
    const [across, up] = [Math.floor(x * dense), canvas.height - 1 - Math.floor(y * dense)];
    const frame = gl.createFramebuffer();
    const [colour, depth] = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    for (const [buffer, format, place] of [[colour, gl.RGBA8, gl.COLOR_ATTACHMENT0], [depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, canvas.width, canvas.height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
    }
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(across, up, 1, 1);
    gl.clearColor(0, 0, 0, 0);
    this.paint(look, true);
    const pixel = new Uint8Array(4);
    gl.readPixels(across, up, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteFramebuffer(frame);
    gl.deleteRenderbuffer(colour);
    gl.deleteRenderbuffer(depth);
    return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
  }
}
