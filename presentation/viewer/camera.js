// A camera that looks at a point and goes round it. Matrices are column by column, as WebGL takes them.

import { add, cross, dot, minus, scaled, turned, unit } from "viewer/vectors.js";

const HALF_FIELD = (12 * Math.PI) / 180; // of the shorter side; narrow: rods far away look as long as those near by
const STEEPEST = 0.999;                  // cosine between what is seen from above and the pole

export class Camera {
  /** told: {back, pole}: from the box to the viewer, and what stays upright. points: all that is to be seen. */
  constructor({ back, pole }, points, reach) {
    this.home = { back: unit(back), pole: unit(pole) };
    this.points = points;
    this.reach = reach;
    this.extent = [Math.min, Math.max].map((outermost) => [0, 1, 2].map((k) => outermost(...points.map((one) => one[k]))));
    this.aspect = 1;
    this.lookHome();
  }

  lookHome() {
    this.pole = this.home.pole;
    this.lookFrom(this.home.back);
  }

  /** From that side onto everything. */
  lookFrom(back) {
    this.back = unit(back);
    const upright = Math.abs(dot(this.back, this.pole)) > STEEPEST ? [0, 1, 0] : this.pole;
    this.right = unit(cross(upright, this.back));
    this.up = cross(this.back, this.right);
    this.fit();
  }

  setAspect(aspect) {
    if (aspect === this.aspect) return;
    this.aspect = aspect;
    if (!this.moved) this.fit();
  }

  /** As near as shows all points, with what is seen in the middle. */
  fit() {
    const middle = scaled(add(...this.extent), 0.5);
    const seen = this.points.map((point) => {
      const from = minus(point, middle);
      return [dot(from, this.right), dot(from, this.up), dot(from, this.back)];
    });
    const [x, y] = [0, 1].map((k) => {
      const values = seen.map((point) => point[k]);
      return 0.5 * (Math.min(...values) + Math.max(...values));
    });
    const { across, high } = this.tangents();
    this.target = add(middle, add(scaled(this.right, x), scaled(this.up, y)));
    this.distance = 1.04 * Math.max(...seen.map(([px, py, pz]) =>
      pz + Math.max((Math.abs(px - x) + this.reach) / across, (Math.abs(py - y) + this.reach) / high)));
    this.fitted = this.distance;
    this.moved = false;
  }

  /** Half the width and half the height of what is seen at distance 1. */
  tangents() {
    const shorter = Math.tan(HALF_FIELD);
    return this.aspect >= 1 ? { across: shorter * this.aspect, high: shorter }
                            : { across: shorter, high: shorter / this.aspect };
  }

  /** Angles in radians: about the pole, and up or down. */
  turn(round, over) {
    const turnAll = (axis, angle) => {
      for (const name of ["right", "up", "back"]) this[name] = turned(this[name], axis, angle);
    };
    turnAll(this.pole, round);
    const next = turned(this.up, this.right, over);
    if (dot(next, this.pole) > 0.02) turnAll(this.right, over);
    this.right = unit(minus(this.right, scaled(this.pole, dot(this.right, this.pole))));
    this.up = unit(cross(this.back, this.right));
    this.back = cross(this.right, this.up);
    this.moved = true;
  }

  zoom(factor) {
    this.distance = Math.min(Math.max(this.distance * factor, 0.02 * this.fitted), 4 * this.fitted);
    this.moved = true;
  }

  /** Shifts the point that is looked at, in heights of the picture. */
  shift(x, y) {
    const height = 2 * this.tangents().high * this.distance;
    this.target = add(this.target, add(scaled(this.right, -x * height), scaled(this.up, y * height)));
    this.moved = true;
  }

  get eye() {
    return add(this.target, scaled(this.back, this.distance));
  }

  view() {
    const { right: r, up: u, back: b, eye } = this;
    return [r[0], u[0], b[0], 0, r[1], u[1], b[1], 0, r[2], u[2], b[2], 0, -dot(r, eye), -dot(u, eye), -dot(b, eye), 1];
  }

  /** {matrix, near, far}: the planes lie close around all points. */
  projection() {
    const depths = this.points.map((point) => dot(minus(this.eye, point), this.back));
    const far = Math.max(...depths) + 4 * this.reach;
    const near = Math.max(Math.min(...depths) - 4 * this.reach, 0.002 * far);
    const { across, high } = this.tangents();
    const span = far - near;
    return { near, far, matrix: [1 / across, 0, 0, 0, 0, 1 / high, 0, 0, 0, 0, -(far + near) / span, -1,
                                 0, 0, (-2 * far * near) / span, 0] };
  }
}
