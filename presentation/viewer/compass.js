// The axes of the box as they lie in the picture, and a bar that shows a length at the depth of what is looked at.

const ARM = 26;
const WANTED = 110; // pixels that the bar may be long

export class Compass {
  constructor(stage, unit) {
    this.unit = unit;
    stage.insertAdjacentHTML("beforeend", `<svg class="axes" viewBox="-40 -40 80 80" aria-hidden="true"></svg>
      <div class="length-bar" aria-hidden="true"><i></i><span></span></div>`);
    this.axes = stage.querySelector(".axes");
    [this.bar, this.words] = stage.querySelector(".length-bar").children;
  }

  show(camera, height) {
    const arms = ["x", "y", "z"].map((name, k) => ({ name, x: camera.right[k], y: -camera.up[k], depth: camera.back[k] }));
    arms.sort((a, b) => a.depth - b.depth);
    this.axes.innerHTML = arms.map(({ name, x, y }) =>
      `<line x2="${ARM * x}" y2="${ARM * y}"/><text x="${(ARM + 9) * x}" y="${(ARM + 9) * y + 4}">${name}</text>`).join("");
    const pixel = (2 * camera.tangents().high * camera.distance) / height; // its length
    const length = rounded(WANTED * pixel);
    this.bar.style.width = `${length / pixel}px`;
    this.words.textContent = `${length} ${this.unit}`;
  }
}

/** The largest 1, 2 or 5 times a power of ten up to the length. */
function rounded(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  const first = [5, 2, 1].find((digit) => digit * power <= length);
  return Number((first * power).toPrecision(1));
}
