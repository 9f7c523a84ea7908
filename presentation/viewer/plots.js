// Plots that zoom and tell their values, drawn by dygraphs, with a line at the time of the frame.

const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** All plots of the page, in the place of their pictures; chosen(time) is called when one clicks into a plot. */
export class Plots {
  constructor(told, chosen) {
    this.graphs = [];
    if (typeof Dygraph === "undefined") return;
    for (const curve of told.curves) {
      const section = document.querySelector(`.plot[data-curve="${curve.name}"]`);
      this.graphs.push(this.graph(section, curve, told.time, chosen));
    }
    document.querySelectorAll("details.aside").forEach((one) =>
      one.addEventListener("toggle", () => this.graphs.forEach((graph) => graph.resize())));
  }

  graph(section, curve, time, chosen) {
    const still = section.querySelector("img");
    still.hidden = true;
    still.insertAdjacentHTML("afterend", '<div class="graph"></div><div class="values"></div>');
    const [place, values] = [section.querySelector(".graph"), section.querySelector(".values")];
    const unit = (name) => (name ? ` ${name}` : "");
    const mean = meanOf(curve);
    values.innerHTML = mean;
    const graph = new Dygraph(place, curve.rows.map(([t, y]) => [t, y]), {
      labels: [time.label, curve.title],
      customBars: curve.ranged,
      colors: [style("--blue")],
      axisLineColor: style("--line"),
      gridLineColor: style("--faint"),
      strokeWidth: 1.2,
      fillAlpha: 0.25,
      logscale: curve.logarithmic,
      includeZero: curve.from_zero,
      valueRange: curve.range ?? null,
      xlabel: time.unit ? `${time.label} (${time.unit})` : time.label,
      ylabel: curve.label,
      xLabelHeight: 16,
      yLabelWidth: 16,
      axes: { y: { axisLabelWidth: 56, valueFormatter: short, axisLabelFormatter: (value) => short(value) },
              x: { valueFormatter: short } },
      labelsDiv: document.createElement("div"),
      underlayCallback: (canvas, area, one) => underlay(canvas, area, one, curve, this.time),
      highlightCallback: (event, x, points) => {
        values.innerHTML = `${time.label} ${short(x)}${unit(time.unit)}: <b>${told(curve, points[0])}${unit(curve.unit)}</b>`;
      },
      unhighlightCallback: () => (values.innerHTML = mean),
      clickCallback: (event, x) => chosen(x),
    });
    return graph;
  }

  /** Moves the line to a time. */
  mark(time) {
    this.time = time;
    for (const graph of this.graphs) graph.renderGraph_();
  }
}

function told(curve, point) {
  const value = short(point.yval);
  const row = curve.ranged && curve.rows[point.idx];
  return row ? `${value} (${short(row[1][0])} to ${short(row[1][2])})` : value;
}

function meanOf({ mean, error, unit }) {
  if (mean === undefined) return "&nbsp;";
  const end = unit ? ` ${unit}` : "";
  return `mean ${short(mean)}${error ? ` ± ${Number(error.toPrecision(2))}` : ""}${end}`;
}

const short = (value) => (value === null ? "" : String(Number(value.toPrecision(5))));

/** What was left out of the mean, the mean with its error, the time of the frame. */
function underlay(canvas, area, graph, curve, time) {
  const band = (from, to, colour) => {
    canvas.fillStyle = colour;
    canvas.fillRect(from[0], from[1], to[0] - from[0], to[1] - from[1]);
  };
  if (curve.window) {
    const [begin, end] = curve.window.map((value) => graph.toDomXCoord(value));
    const top = area.y;
    if (curve.window[0] > curve.rows[0][0]) band([area.x, top], [begin, top + area.h], style("--faint"));
    const middle = graph.toDomYCoord(curve.mean);
    if (curve.error) {
      const [high, low] = [1, -1].map((sign) => graph.toDomYCoord(curve.mean + sign * curve.error));
      canvas.globalAlpha = 0.35;
      band([begin, high], [end, low], style("--orange"));
      canvas.globalAlpha = 1;
    }
    band([begin, middle - 1.25], [end, middle + 1.25], style("--orange"));
  }
  if (time !== undefined) {
    const x = graph.toDomXCoord(time);
    band([x - 0.75, area.y], [x + 0.75, area.y + area.h], style("--text"));
  }
}
