// From a rod to its colour, by one of its properties. A way to colour tells its legend, too.

import { UNKNOWN } from "viewer/packed_columns.js";
import { direction } from "viewer/octahedron.js";
import { dot } from "viewer/vectors.js";

const GREY = [150, 155, 162];
const ALONG = [[40, 98, 176], [38, 150, 120], [240, 190, 70]]; // of rods along x, y, z; between them by cos^2

export class Colouring {
  /** told: the list "colourings" of the page's description, each {key, label, kind, ...}; map: 256 colours. */
  constructor(told, map, frames) {
    this.told = told;
    this.map = map;
    this.frames = frames;
    this.key = told[0].key;
  }

  get chosen() {
    return this.told.find((one) => one.key === this.key);
  }

  /** 4 bytes a rod. */
  colours(frame) {
    const count = this.frames.counts[frame];
    const bytes = new Uint8Array(4 * count).fill(255);
    const colour = this.colourOf(this.chosen, frame);
    for (let k = 0; k < count; k++) bytes.set(colour(k), 4 * k);
    return bytes;
  }

  /** A function of a rod's row in the frame. */
  colourOf(told, frame) {
    if (told.kind === "plain") return () => told.colour;
    if (told.kind === "direction") return this.byDirection(frame);
    const value = this.valueOf(told, frame);
    if (told.kind === "group") return (k) => groupColour(value(k));
    return (k) => this.onScale((value(k) - told.low) / (told.high - told.low));
  }

  /** A function from a rod's row to its value, NaN where it has none. */
  valueOf(told, frame) {
    if (told.kind === "angle") return this.angle(frame, told.directors[frame]);
    const rows = this.frames.rows(told.column, frame);
    if (told.kind === "group") return (k) => (rows ? rows[k] : k);
    return (k) => (rows[k] === UNKNOWN ? NaN : told.least + ((told.greatest - told.least) * rows[k]) / (UNKNOWN - 1));
  }

  axis(frame) {
    const [a, b] = ["axis_a", "axis_b"].map((name) => this.frames.rows(name, frame));
    return (k) => direction(a[k], b[k]);
  }

  byDirection(frame) {
    const axis = this.axis(frame);
    return (k) => {
      const [x, y, z] = axis(k).map((value) => value * value);
      return [0, 1, 2].map((c) => x * ALONG[0][c] + y * ALONG[1][c] + z * ALONG[2][c]);
    };
  }

  angle(frame, director) {
    const axis = this.axis(frame);
    return (k) => (Math.acos(Math.min(Math.abs(dot(axis(k), director)), 1)) * 180) / Math.PI;
  }

  onScale(share) {
    return Number.isNaN(share) ? GREY : this.map[Math.min(Math.max(Math.floor(share * 256), 0), 255)];
  }

  /** What explains the colours, as HTML. */
  legend() {
    const told = this.chosen;
    if (told.kind === "direction") return ["x", "y", "z"].map((name, k) => swatch(ALONG[k], `along ${name}`)).join("");
    if (told.kind === "plain" || told.kind === "group") return "";
    const stops = this.map.filter((_, k) => k % 15 === 0).map(css).join(",");
    const [low, high] = [told.low, told.high].map((value) => Number(value.toPrecision(3)));
    const unit = told.unit === "°" ? "°" : told.unit ? ` ${told.unit}` : "";
    return `<span class="scale" title="${told.note ?? ""}">${low}<i class="bar" style="background:linear-gradient(90deg,${stops})"></i>` +
           `${high}${unit}</span>`;
  }
}

/** Groups that follow each other have colours far apart: hues by the golden angle. */
function groupColour(group) {
  if (Number.isNaN(group)) return GREY;
  const hue = (group * 137.508 + 210) % 360;
  const [strength, lightness] = [[0.62, 0.5], [0.5, 0.62], [0.7, 0.42]][Math.floor(group / 5) % 3];
  const channel = (shift) => {
    const place = (shift + hue / 30) % 12;
    return 255 * (lightness - strength * Math.min(lightness, 1 - lightness) * Math.max(-1, Math.min(place - 3, 9 - place, 1)));
  };
  return [channel(0), channel(8), channel(4)];
}

const css = (colour) => `rgb(${colour.map(Math.round).join(",")})`;
const swatch = (colour, text) => `<span><i class="dot" style="background:${css(colour)}"></i>${text}</span>`;
