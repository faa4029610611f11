// The leading edge of all panels over T, with the cursor.
(function (viewer) {
  const margin = {left: 44, right: 12, top: 10, bottom: 40};
  const height = 250;

  function element(name, attributes, parent, text) {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key of Object.keys(attributes)) node.setAttribute(key, attributes[key]);
    if (text !== undefined) node.textContent = text;
    parent.appendChild(node);
    return node;
  }
  viewer.svgElement = element;

  // Whole numbers, not more than about eight of them.
  function ticks(end) {
    const step = Math.max(1, Math.ceil(end / 8));
    const list = [];
    for (let value = 0; !(value > end); value += step) list.push(value);
    return list;
  }

  function drawAxes(svg, axes, width) {
    for (const value of ticks(axes.tEnd)) {
      const x = axes.x(value);
      element("line", {x1: x, x2: x, y1: axes.y(0), y2: axes.y(0) + 5, stroke: "#303030"}, svg);
      element("text", {x: x, y: axes.y(0) + 18, "text-anchor": "middle"}, svg, String(value));
    }
    for (const value of ticks(axes.zEnd)) {
      const y = axes.y(value);
      element("line", {x1: axes.x(0), x2: width - margin.right, y1: y, y2: y, class: "viewer-tick"}, svg);
      element("text", {x: margin.left - 8, y: y + 4, "text-anchor": "end"}, svg, String(value));
    }
    const frame = "M" + axes.x(0) + " " + axes.y(axes.zEnd) + "V" + axes.y(0) + "H" + axes.x(axes.tEnd);
    element("path", {d: frame, fill: "none", stroke: "#303030"}, svg);
    element("text", {x: axes.x(axes.tEnd / 2), y: height - 6, "text-anchor": "middle"}, svg, "T = t √(2g/L)");
    const middle = axes.y(axes.zEnd / 2);
    element("text", {x: 12, y: middle, "text-anchor": "middle", transform: "rotate(-90 12 " + middle + ")"},
      svg, "Z/L");
  }

  function drawCurve(svg, axes, times, run, front) {
    let path = "";
    let pen = "M";
    front.forEach((z, i) => {
      if (z === null) {
        pen = "M";
        return;
      }
      path += pen + axes.x(times[i]).toFixed(2) + " " + axes.y(z).toFixed(2);
      pen = "L";
    });
    element("path", {d: path, fill: "none", stroke: run.colour, "stroke-width": 1.8,
      "stroke-dasharray": run.dash.join(" ")}, svg);
  }

  // Returns the function that moves the cursor to a frame. seek(frame) is called for a drag.
  viewer.makePlot = function (holder, data, seek) {
    const times = data.metrics.T;
    const fronts = data.runs.map((run) => data.metrics.Z_over_L[run.name]);
    if (!fronts.some((front) => front.some((z) => z !== null))) {  // a flow without a leading edge
      holder.hidden = true;
      return {move() {}};
    }
    const axes = {tEnd: times[times.length - 1], zEnd: data.view.width};
    for (const front of fronts) for (const z of front) axes.zEnd = Math.max(axes.zEnd, z || 0);
    const svg = element("svg", {role: "img", "aria-label": "Leading edge over time, with the time shown"}, holder);
    let cursor = null;
    let dots = [];
    let shown = 0;

    function move(frame) {
      shown = frame;
      const x = axes.x(times[frame]);
      cursor.setAttribute("x1", x);
      cursor.setAttribute("x2", x);
      dots.forEach((dot, i) => {
        const z = fronts[i][frame];
        dot.setAttribute("visibility", z === null ? "hidden" : "visible");
        dot.setAttribute("cx", x);
        dot.setAttribute("cy", axes.y(z || 0));
      });
    }

    function draw() {
      const width = Math.max(240, holder.clientWidth);
      svg.replaceChildren();
      svg.setAttribute("viewBox", "0 0 " + width + " " + height);
      axes.x = (t) => margin.left + (t / axes.tEnd) * (width - margin.left - margin.right);
      axes.y = (z) => height - margin.bottom - (z / axes.zEnd) * (height - margin.top - margin.bottom);
      drawAxes(svg, axes, width);
      if (data.window_end !== null) {
        const x = axes.x(data.window_end);
        element("line", {x1: x, x2: x, y1: axes.y(0), y2: axes.y(axes.zEnd), class: "viewer-window"}, svg);
        element("text", {x: x + 6, y: axes.y(0) - 8, fill: "#606060"}, svg, "end of comparison");
      }
      data.runs.forEach((run, i) => drawCurve(svg, axes, times, run, fronts[i]));
      cursor = element("line", {y1: axes.y(0), y2: margin.top, class: "viewer-cursor"}, svg);
      dots = data.runs.map((run) => element("circle", {r: 3.5, fill: run.colour, stroke: "#fff"}, svg));
      move(shown);
    }

    function seekPointer(event) {
      const box = svg.getBoundingClientRect();
      const part = (event.clientX - box.left - margin.left) / (box.width - margin.left - margin.right);
      const t = part * axes.tEnd;
      let nearest = 0;
      times.forEach((time, i) => {
        if (Math.abs(times[nearest] - t) > Math.abs(time - t)) nearest = i;
      });
      seek(nearest);
    }
    svg.addEventListener("pointerdown", (event) => {
      svg.setPointerCapture(event.pointerId);
      seekPointer(event);
    });
    svg.addEventListener("pointermove", (event) => {
      if (event.buttons) seekPointer(event);
    });
    draw();
    return {move, draw};
  };
})(surgeViewer);

