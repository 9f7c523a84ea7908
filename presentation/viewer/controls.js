// What one can set beside the picture: time, colour, slab, box, forces. Everything has a key, or can be reached by Tab.

const FRAMES_A_SECOND = 12;

const element = (html) => {
  const template = document.createElement("template");
  template.innerHTML = html.trim();
  return template.content.firstChild;
};

/** The bar of time below the picture; changed(frame) is called when it is moved. */
export class TimeBar {
  constructor(times, unit, changed) {
    this.times = times;
    this.unit = unit;
    this.changed = changed;
    this.element = element(`<div class="time-bar">
      <button type="button" class="play" aria-label="play" title="play (space)"></button>
      <input type="range" class="slider" min="0" max="${times.length - 1}" step="1" aria-label="time">
      <output></output></div>`);
    [this.button, this.slider, this.output] = this.element.children;
    this.element.hidden = times.length < 2;
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.button.addEventListener("click", () => this.play(!this.playing));
    addEventListener("keydown", (event) => this.key(event));
    this.play(false);
  }

  get frame() {
    return Number(this.slider.value);
  }

  go(frame) {
    this.slider.value = Math.min(Math.max(frame, 0), this.times.length - 1);
    const time = this.times[this.frame];
    this.output.textContent = `${Number(time.toPrecision(4))} ${this.unit}`;
    this.slider.setAttribute("aria-valuetext", this.output.textContent);
    this.changed(this.frame);
  }

  step(by) {
    const { length } = this.times;
    this.go((this.frame + by + length) % length);
  }

  play(on) {
    this.playing = on;
    this.button.textContent = on ? "❚❚" : "▶";
    this.button.setAttribute("aria-label", on ? "pause" : "play");
    clearInterval(this.clock);
    if (on) this.clock = setInterval(() => this.step(1), 1000 / FRAMES_A_SECOND);
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(SELECT|TEXTAREA|SUMMARY)$/.test(event.target.tagName)) return;
    if (event.key === " " && event.target.tagName !== "BUTTON") this.play(!this.playing);
    else if (event.key === ",") this.step(-1);
    else if (event.key === ".") this.step(1);
    else return;
    event.preventDefault();
  }
}

/** Colour, slab, box and forces of a RodsView. */
export function lookBar(view, colouring) {
  const ways = colouring.told.map(({ key, label }) => `<option value="${key}">${label}</option>`).join("");
  const bar = element(`<div class="look-bar">
    <label>colour <select class="colour">${ways}</select></label><span class="legend"></span>
    <label>slab <select class="slab-axis"><option value="">whole</option><option value="0">across x</option>
      <option value="1">across y</option><option value="2">across z</option></select></label>
    <span class="slab" hidden><input type="range" class="slab-place" min="0" max="1" step="0.005" value="0.5" aria-label="place of the slab">
      <input type="range" class="slab-thickness" min="0.02" max="1" step="0.01" value="0.25" aria-label="thickness of the slab"></span>
    <label class="forces"><input type="checkbox"> contact forces</label>
    <label class="box"><input type="checkbox" checked> box</label></div>`);
  const at = (name) => bar.querySelector(name);

  const recolour = () => {
    colouring.key = at(".colour").value;
    at(".legend").innerHTML = colouring.legend();
    view.recolour();
  };
  at(".colour").addEventListener("change", recolour);
  at(".legend").innerHTML = colouring.legend();

  const slab = () => {
    const axis = at(".slab-axis").value;
    at(".slab").hidden = axis === "";
    view.slab = axis === "" ? null : slabOf(view.camera.extent, Number(axis), at(".slab-place").value, at(".slab-thickness").value);
    view.moved();
  };
  for (const name of [".slab-axis", ".slab-place", ".slab-thickness"]) at(name).addEventListener("input", slab);

  at(".forces").hidden = !view.contacts;
  at(".forces input").addEventListener("change", (event) => {
    view.forces = event.target.checked;
    view.show(view.frame);
  });
  at(".box").hidden = !view.told.boxes.length && !view.walls;
  at(".box input").addEventListener("change", (event) => {
    view.box = event.target.checked;
    view.moved();
  });
  return bar;
}

/** Two buttons in the corner of the picture. */
export function cornerButtons(view) {
  const corner = element(`<div class="corner">
    <button type="button" title="look as in the beginning (Home)" aria-label="look as in the beginning">⟲</button>
    <button type="button" title="the whole screen" aria-label="the whole screen">⤢</button></div>`);
  const [home, full] = corner.children;
  home.addEventListener("click", () => {
    view.camera.lookHome();
    view.moved();
  });
  full.hidden = !document.fullscreenEnabled;
  full.addEventListener("click", () =>
    document.fullscreenElement ? document.exitFullscreen() : view.canvas.closest("figure").requestFullscreen());
  return corner;
}

function slabOf([low, high], axis, place, thickness) {
  const size = high[axis] - low[axis];
  return { axis, middle: low[axis] + place * size, half: 0.5 * thickness * size };
}
