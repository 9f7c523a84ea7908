// The picture of the rods: what is drawn, and when. While something moves it is drawn as coarsely as keeps it fluent; once
// it rests, again with four points a pixel.

import { Camera } from "viewer/camera.js";
import { Renderer } from "viewer/renderer.js";
import { STRIDE } from "viewer/frames.js";
import { alongAxis } from "viewer/octahedron.js";
import { moveByHand } from "viewer/gestures.js";
import { minus } from "viewer/vectors.js";

const HEAD = [0.84, 0.3, 0.08];
const EDGE = [118, 126, 136, 255];
const FORCE = [196, 38, 46, 255];
const WALL = [58, 68, 82, 255];
const FIXED = [128, 130, 134, 255];
const THIN = 0.3;               // of their diameter, that rods are drawn with while forces are shown
const PALE = 150;               // of 255, that is added to their colours then
const REST = 160;               // milliseconds without movement after which the picture is drawn finely
const FLUENT = [18, 45];        // milliseconds a picture: below, finer; above, coarser
const COARSEST = 0.3;           // pixels drawn for a pixel of the screen, along a line
const MOST_PIXELS = 9e6;
const PATIENCE = 700;           // milliseconds that the fine picture may take

export class RodsView {
  /** contacts, walls, fixed: lines and rods beside those that move, or undefined. */
  constructor(canvas, told, frames, colouring, { contacts, walls, fixed }) {
    Object.assign(this, { canvas, told, frames, colouring, contacts, walls });
    this.renderer = new Renderer(canvas);
    this.rods = Object.assign(this.renderer.batch(), { cut: true, heads: told.swim });
    this.lines = Object.assign(this.renderer.batch(), { cut: true });
    this.edges = this.renderer.batch();
    this.outlines = this.renderer.batch();
    this.obstacles = Object.assign(this.renderer.batch(), { cut: true });
    if (fixed) place(this.obstacles, fixed, 0, this.told.fixed, FIXED);
    this.camera = new Camera(told.camera, told.seen, reach(told));
    this.slab = null;
    this.box = true;
    this.forces = false;
    this.fineness = 1;
    this.cost = 0;                // milliseconds for a million pixels
    moveByHand(canvas, this.camera, () => this.moved());
    new ResizeObserver(() => this.moved()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.moved());
  }

  /** Shows a frame. */
  show(frame) {
    this.frame = frame;
    const { rods } = this.told;
    this.drawEdges();
    if (this.walls) this.drawWalls();
    const thin = this.forces ? THIN : 1;
    const scale = { low: rods.low, span: rods.span, length: rods.length, diameter: rods.diameter.map((d) => d * thin) };
    this.rods.set(this.frames.instances(frame), scale);
    if (this.contacts && this.forces) place(this.lines, this.contacts, frame, this.told.contacts, FORCE);
    this.recolour();
  }

  recolour() {
    const colours = this.colouring.colours(this.frame);
    this.rods.setColours(this.forces ? colours.map((value) => PALE + (1 - PALE / 255) * value) : colours);
    this.moved();
  }

  /** The box of the frame; one stands for all where it does not change. */
  drawEdges() {
    const { boxes } = this.told;
    const box = boxes[Math.min(this.frame, boxes.length - 1)];
    if (!box || box === this.drawnBox) return;
    this.drawnBox = box;
    const { low: origin, span } = this.told.rods;
    const [low, high] = box;
    const size = minus(high, low);
    const longest = Math.max(...size);
    const instances = [];
    for (let axis = 0; axis < 3; axis++)
      for (const [p, q] of [[0, 0], [0, 1], [1, 0], [1, 1]]) {
        const corner = [p, q];
        corner.splice(axis, 0, 0.5);
        const place = corner.map((share, k) => (65535 * (low[k] + share * size[k] - origin[k])) / span[k]);
        instances.push(...place, ...alongAxis(axis), (65535 * size[axis]) / longest, 65535, 0);
      }
    const thickness = 0.003 * Math.hypot(...size);
    this.edges.set(new Uint16Array(instances.map(Math.round)),
                   { low: origin, span, length: [0, longest], diameter: [0, thickness] });
    this.edges.setColours(repeated(EDGE, instances.length / STRIDE));
  }

  /** Of the frame; one set stands for all where the box does not change. */
  drawWalls() {
    const frame = Math.min(this.frame, this.walls.length - 1);
    if (frame === this.drawnWalls) return;
    this.drawnWalls = frame;
    place(this.outlines, this.walls, frame, this.told.walls, WALL);
  }

  look() {
    const background = backgroundOf(this.canvas);
    const half = 0.5 * Math.hypot(...minus(...[...this.camera.extent].reverse()));
    return {
      batches: [this.rods, this.obstacles, ...(this.box ? [this.edges, this.outlines] : []), ...(this.forces ? [this.lines] : [])],
      background,
      head: HEAD,
      slab: this.slab,
      shade: 1.1 * this.thickness(),
      fade: (camera) => [camera.distance - 0.6 * half, camera.distance + 1.4 * half],
    };
  }

  thickness() {
    const [least, range] = this.told.rods.diameter;
    return least + range;
  }

  /** To be called when anything changed: draws with the next picture of the screen. */
  moved() {
    this.dirty = true;
    clearTimeout(this.resting);
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((time) => {
      this.waiting = false;
      const taken = this.keepFluent(time);
      this.draw(true);
      this.resting = setTimeout(() => this.rest(), REST + 2 * taken);
    });
  }

  /** Draws finer or coarser by the milliseconds that the last picture took, which are returned; 0 for the first after a rest. */
  keepFluent(time) {
    const taken = this.before === undefined ? 0 : time - this.before;
    this.before = time;
    if (taken === 0) return 0;
    const pixels = (this.canvas.width * this.canvas.height) / 1e6;
    this.cost = this.cost ? 0.8 * this.cost + (0.2 * taken) / pixels : taken / pixels;
    if (taken > FLUENT[1]) this.fineness = Math.max(COARSEST, 0.85 * this.fineness);
    else if (taken < FLUENT[0]) this.fineness = Math.min(1, 1.1 * this.fineness);
    return taken;
  }

  rest() {
    this.draw(false);
    this.before = undefined;
  }

  draw(moving) {
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth || !clientHeight || this.frame === undefined) return;
    const ratio = window.devicePixelRatio || 1;
    const area = clientWidth * clientHeight * ratio * ratio;
    const affordable = this.cost ? (PATIENCE / this.cost) * 1e6 : MOST_PIXELS;
    const finest = Math.min(2, Math.sqrt(Math.min(MOST_PIXELS, affordable) / area));
    const scale = ratio * (moving ? this.fineness : Math.max(finest, this.fineness));
    this.camera.setAspect(clientWidth / clientHeight);
    this.renderer.draw(this.camera, this.look(), Math.round(clientWidth * scale), Math.round(clientHeight * scale), moving);
    this.canvas.dataset.drawn = moving ? "moving" : "still";
    this.onDraw?.();
  }
}

/** How far rods stick out of what is to be seen, about: of a periodic box that holds their centres. */
function reach({ rods, boxes }) {
  const [longest, thickest] = [rods.length, rods.diameter].map(([least, range]) => least + range);
  return boxes.length ? 0.3 * longest + 0.5 * thickest : 0.5 * thickest;
}

/** Fills a batch with what a frame of these lines, or rods, has. */
function place(batch, frames, frame, { low, span, length, diameter }, colour) {
  batch.set(frames.instances(frame), { low, span, length, diameter });
  batch.setColours(repeated(colour, frames.counts[frame]));
}

function repeated(colour, count) {
  const bytes = new Uint8Array(4 * count);
  for (let k = 0; k < count; k++) bytes.set(colour, 4 * k);
  return bytes;
}

function backgroundOf(element) {
  const numbers = getComputedStyle(element).backgroundColor.match(/[\d.]+/g);
  return numbers.slice(0, 3).map((value) => value / 255);
}
