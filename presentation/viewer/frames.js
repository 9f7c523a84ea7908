// The rods of every frame, as the renderer takes them.

import { unpacked } from "viewer/packed_columns.js";

/** 16-bit numbers of one rod in the renderer's buffer: x, y, z, axis (2), length, diameter, nothing. */
export const STRIDE = 8;

export class Frames {
  /** told: the entry "rods" or "contacts" of the page's description. Columns that are not there are constant. */
  static async read(told) {
    const columns = {};
    await Promise.all(Object.entries(told.columns).map(async ([name, column]) => {
      columns[name] = await unpacked(column);
    }));
    return new Frames(told, columns);
  }

  constructor(told, columns) {
    this.times = told.times;
    this.counts = told.counts;
    this.columns = columns;
    this.first = [0]; // row at which each frame begins
    for (const count of told.counts) this.first.push(this.first[this.first.length - 1] + count);
  }

  get length() {
    return this.counts.length;
  }

  /** Rows of a column in a frame, or undefined if there is no such column. */
  rows(name, frame) {
    const column = this.columns[name];
    return column && column.subarray(this.first[frame], this.first[frame + 1]);
  }

  /** STRIDE numbers a rod. */
  instances(frame) {
    const names = ["x", "y", "z", "axis_a", "axis_b", "length", "diameter"];
    const buffer = new Uint16Array(this.counts[frame] * STRIDE);
    names.forEach((name, place) => {
      const values = this.rows(name, frame);
      if (values) for (let k = 0; k < values.length; k++) buffer[k * STRIDE + place] = values[k];
    });
    return buffer;
  }
}
