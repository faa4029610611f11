// Curves of a figure in a plot with values under the pointer and zoom. The drawing stays where this cannot run.
(function () {
  if (typeof uPlot === "undefined") return;

  // A curve at the abscissae of all: straight between its own points, nothing outside of them and in gaps.
  // Markers have values at their own points alone.
  function sampled(curve, all) {
    let i = 0;
    return all.map((x) => {
      while (i + 1 < curve.x.length && curve.x[i + 1] <= x) ++i;
      if (curve.x[i] === x) return curve.y[i];
      const a = curve.y[i], b = curve.y[i + 1];
      if (curve.points || x < curve.x[i] || b === undefined || a === null || b === null) return null;
      return a + ((b - a) * (x - curve.x[i])) / (curve.x[i + 1] - curve.x[i]);
    });
  }

  const shown = (value) => (value === null || value === undefined ? "–" : Number(value).toPrecision(4));

  function draw(holder, data) {
    const all = [...new Set(data.curves.flatMap((curve) => curve.x))].sort((a, b) => a - b);
    const series = [{label: data.x, value: (_, value) => shown(value)}];
    for (const curve of data.curves)
      series.push({label: curve.label, stroke: curve.colour, width: curve.points ? 0 : 1.6, spanGaps: false,
        points: {show: curve.points, size: 6, fill: curve.colour}, value: (_, value) => shown(value)});
    const axis = {stroke: "#1c1c1c", grid: {stroke: "#e4e4e4", width: 1}};
    const size = () => ({width: Math.max(240, Math.min(720, holder.parentElement.clientWidth - 16)), height: 340});
    const chart = new uPlot(Object.assign({series, scales: {x: {time: false}}, axes: [Object.assign({label: data.x}, axis),
      Object.assign({label: data.y, size: 64}, axis)]}, size()), [all, ...data.curves.map((curve) => sampled(curve, all))], holder);
    window.addEventListener("resize", () => holder.hidden || chart.setSize(size()));
  }

  for (const closer of document.querySelectorAll(".closer")) {
    const button = closer.querySelector("button"), chart = closer.querySelector(".chart");
    const still = closer.parentElement.querySelector(".still");
    closer.hidden = false;
    button.addEventListener("click", () => {
      chart.hidden = !chart.hidden;
      still.hidden = !chart.hidden;
      button.setAttribute("aria-expanded", String(!chart.hidden));
      button.textContent = chart.hidden ? "Values and zoom" : "Back to the drawing";
      if (!chart.hidden && !chart.firstChild) draw(chart, JSON.parse(closer.querySelector("script").textContent));
    });
  }
})();
