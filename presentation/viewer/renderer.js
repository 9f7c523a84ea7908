// Draws batches of rods (the rods themselves, the box, lines of force) by WebGL 2: first what is seen where, then the light.

import * as light from "viewer/light_shader.js";
import * as rod from "viewer/rod_shader.js";
import { STRIDE } from "viewer/frames.js";

const COLUMNS = 1024;                    // rods in a row of the textures that hold them
const SAMPLES = { moving: 8, still: 24 }; // of the neighbourhood of a pixel, for the light that they take away

export class Renderer {
  /** Throws if the browser has no WebGL 2. */
  constructor(canvas) {
    this.gl = canvas.getContext("webgl2", { antialias: false, alpha: false, depth: false,
                                            powerPreference: "high-performance" });
    if (!this.gl) throw new Error("This browser has no WebGL 2");
    this.canvas = canvas;
    this.rods = new Program(this.gl, rod);
    this.light = new Program(this.gl, light);
    this.target = { width: 0, height: 0 };
  }

  batch() {
    return new Batch(this.gl);
  }

  /** look: {batches, background (3), heads, slab, shade, lengths per batch}. */
  draw(camera, look, width, height, moving) {
    const gl = this.gl;
    this.resize(width, height);
    const projection = camera.projection();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target.framebuffer);
    gl.viewport(0, 0, width, height);
    gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 0]);
    gl.clearBufferfv(gl.COLOR, 1, [0, 0, 0, 0]);
    gl.clearBufferfi(gl.DEPTH_STENCIL, 0, 1, 0);
    gl.enable(gl.DEPTH_TEST);
    this.rods.use({ u_view: camera.view(), u_projection: projection.matrix, u_near: projection.near });
    for (const batch of look.batches) {
      this.rods.set({ ...slab(camera, batch.cut ? look.slab : null), u_head: [...look.head, batch.heads ? 1 : 0] });
      batch.draw(this.rods);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.disable(gl.DEPTH_TEST);
    const { across, high } = camera.tangents();
    this.light.use({ u_background: look.background, u_tangents: [across, high], u_range: [projection.near, projection.far],
                     u_fade: look.fade(camera), u_radius: look.shade, u_samples: moving ? SAMPLES.moving : SAMPLES.still,
                     u_colour: 0, u_normal: 1, u_depth: 2 });
    bind(gl, this.target.textures);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  resize(width, height) {
    if (width === this.target.width && height === this.target.height) return;
    const gl = this.gl;
    this.canvas.width = width;
    this.canvas.height = height;
    for (const old of this.target.textures ?? []) gl.deleteTexture(old);
    const framebuffer = this.target.framebuffer ?? gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    const textures = [gl.RGBA8, gl.RGBA8, gl.DEPTH_COMPONENT24].map((format) => {
      const made = texture(gl);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
      return made;
    });
    const places = [gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1, gl.DEPTH_ATTACHMENT];
    textures.forEach((made, k) => gl.framebufferTexture2D(gl.FRAMEBUFFER, places[k], gl.TEXTURE_2D, made, 0));
    gl.drawBuffers(places.slice(0, 2));
    this.target = { width, height, framebuffer, textures };
  }
}

/** Spherocylinders that share what their 16-bit numbers mean. */
class Batch {
  constructor(gl) {
    this.gl = gl;
    this.count = 0;
    this.instances = texture(gl);
    this.colours = texture(gl);
  }

  /** scale: {low, span (3), length, diameter: [least, greatest less least]}. */
  set(instances, scale) {
    const { gl } = this;
    this.count = instances.length / STRIDE;
    this.scale = { u_low: scale.low, u_span: scale.span, u_length: scale.length, u_diameter: scale.diameter };
    const rows = Math.ceil(this.count / COLUMNS);
    const whole = new Uint16Array(rows * COLUMNS * STRIDE);
    whole.set(instances);
    gl.bindTexture(gl.TEXTURE_2D, this.instances);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16UI, 2 * COLUMNS, rows, 0, gl.RGBA_INTEGER, gl.UNSIGNED_SHORT, whole);
  }

  /** colours: 4 bytes a rod. */
  setColours(colours) {
    const { gl } = this;
    const rows = Math.ceil(this.count / COLUMNS);
    const whole = new Uint8Array(rows * COLUMNS * 4);
    whole.set(colours);
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, COLUMNS, rows, 0, gl.RGBA, gl.UNSIGNED_BYTE, whole);
  }

  draw(program) {
    if (this.count === 0) return;
    const { gl } = this;
    program.set({ ...this.scale, u_rods: 0, u_colours: 1 });
    bind(gl, [this.instances, this.colours]);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * this.count);
  }
}

/** A texture that is read texel by texel. */
function texture(gl) {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  return made;
}

function bind(gl, textures) {
  textures.forEach((one, k) => {
    gl.activeTexture(gl.TEXTURE0 + k);
    gl.bindTexture(gl.TEXTURE_2D, one);
  });
  gl.activeTexture(gl.TEXTURE0);
}

class Program {
  constructor(gl, { vertex, fragment }) {
    this.gl = gl;
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(this.program));
    this.uniforms = {};
    for (let k = 0; k < gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS); k++) {
      const { name, type } = gl.getActiveUniform(this.program, k);
      this.uniforms[name] = { place: gl.getUniformLocation(this.program, name), type };
    }
  }

  use(values) {
    this.gl.useProgram(this.program);
    this.set(values);
  }

  set(values) {
    const gl = this.gl;
    for (const [name, value] of Object.entries(values)) {
      const { place, type } = this.uniforms[name];
      if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(place, false, value);
      else if (type === gl.FLOAT_VEC4) gl.uniform4fv(place, value);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, value);
      else if (type === gl.FLOAT_VEC2) gl.uniform2fv(place, value);
      else if (type === gl.FLOAT) gl.uniform1f(place, value);
      else gl.uniform1i(place, value);
    }
  }
}

/** The slab {axis, middle, half} in the camera's coordinates. */
function slab(camera, told) {
  if (!told) return { u_slab: [0, 0, 1, 0], u_slab_half: -1 };
  const normal = [camera.right, camera.up, camera.back].map((vector) => vector[told.axis]);
  return { u_slab: [...normal, camera.eye[told.axis] - told.middle], u_slab_half: told.half };
}
