// Controls: one frame number, which everything follows.
(function (viewer) {
  const root = document.getElementById("viewer-root");
  const find = (name) => root.querySelector(".viewer-" + name);
  const data = JSON.parse(document.getElementById("viewer-data").textContent);
  const palette = viewer.decodePalette(data.palette);
  const surface = data.surface && viewer.decodeSurface(data.surface);
  const last = data.metrics.times_s.length - 1;
  const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
  const quantities = {pressure: "p/(ρgH)", speed: "|u|/√(2gH)"};
  const controls = {play: find("play"), slider: find("slider"), field: find("field"), surface: find("surface")};
  let frame = 0;
  let playing = null;

  // Shows a number of metrics.json and nothing else; the attribute says which.
  function number(parts, decimals) {
    const value = parts.reduce((at, part) => at[part], data.metrics);
    const node = document.createElement("data");
    node.setAttribute("data-key", "/viewer/" + parts.join("/"));
    node.setAttribute("value", String(value));
    node.textContent = value === null ? "–" : value.toFixed(decimals);
    return node;
  }

  function make(name, parent, text) {
    const node = document.createElement(name);
    if (text !== undefined) node.textContent = text;
    parent.appendChild(node);
    return node;
  }

  function makePanel(run) {
    const panel = make("div", find("panels"));
    panel.className = "viewer-panel";
    const head = make("div", panel);
    head.className = "viewer-head";
    const title = make("strong", head);
    const swatch = viewer.svgElement("svg", {class: "viewer-swatch", viewBox: "0 0 26 8", "aria-hidden": "true"}, title);
    viewer.svgElement("path", {d: "M0 4h26", stroke: run.colour, "stroke-width": 2.5,
      "stroke-dasharray": run.dash.join(" ")}, swatch);
    title.append(" " + run.label);
    const edge = make("span", head);
    if (run.note) {
      const note = make("data", head, run.note);
      note.className = "viewer-note";
      note.setAttribute("data-key", "/runs/" + run.name + "/note");
      note.setAttribute("value", run.note);
    }
    const canvas = make("canvas", panel);
    canvas.setAttribute("role", "img");
    return {run, edge, canvas, water: viewer.decodeWater(run)};
  }

  function drawPanel(panel) {
    const field = controls.field.value;
    const over = panel.water.mesh || controls.surface.checked ? surface : null;
    viewer.drawWater(panel.canvas, data.view, panel.water, field, palette, frame, over);
    panel.canvas.setAttribute("aria-label", panel.run.label + ", coloured by " + field);
    panel.edge.replaceChildren("Z/L = ", number(["Z_over_L", panel.run.name, frame], 2));
  }

  function draw() {
    panels.forEach(drawPanel);
    plot.move(frame);
    const time = find("time");
    time.replaceChildren("t = ", number(["times_s", frame], 3), " s, T = ", number(["T", frame], 2));
    controls.slider.value = String(frame);
    controls.slider.setAttribute("aria-valuetext", time.textContent);
  }

  function show(next) {
    frame = Math.min(last, Math.max(0, next));
    draw();
  }

  function pause() {
    if (playing !== null) cancelAnimationFrame(playing);
    playing = null;
    controls.play.textContent = "Play";
  }

  function play() {
    // Twenty pictures a second, or, where less motion is asked for, every tenth part of them once a second.
    const interval = calm.matches ? 1000 : 50;
    const stride = calm.matches ? Math.max(1, Math.round(last / 10)) : 1;
    const first = frame === last ? 0 : frame;
    let begin = null;
    show(first);
    const step = (now) => {
      begin = begin === null ? now : begin;
      const next = first + stride * Math.floor((now - begin) / interval);
      if (next !== frame) show(next);
      if (frame === last) pause();
      else playing = requestAnimationFrame(step);
    };
    playing = requestAnimationFrame(step);
    controls.play.textContent = "Pause";
  }

  const toggle = () => (playing === null ? play() : pause());

  function seek(next) {
    pause();
    show(next);
  }

  function showScale() {
    find("lower").replaceChildren(number(["colour_range", 0], 0));
    find("upper").replaceChildren(number(["colour_range", 1], 0));
    find("quantity").textContent = quantities[controls.field.value];
    find("bar").style.background = "linear-gradient(to right," + palette.filter((_, i) => i % 15 === 0).join(",") + ")";
  }

  function onKey(event) {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const steps = {ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1, PageDown: -10, PageUp: 10,
      Home: -last, End: last};
    const ownsSpace = event.target === controls.play || event.target === controls.surface;
    if (event.target === controls.field) return;
    if (event.key === " " && !ownsSpace) toggle();
    else if (event.key in steps) seek(frame + steps[event.key]);
    else return;
    event.preventDefault();
  }

  root.hidden = false;
  document.querySelector(".viewer-still").hidden = true;
  const panels = data.runs.map(makePanel);
  const plot = viewer.makePlot(find("plot"), data, seek);
  controls.slider.max = String(last);
  find("overlay").hidden = !surface;
  find("reduced").hidden = !calm.matches;
  controls.play.addEventListener("click", toggle);
  controls.slider.addEventListener("input", () => seek(Number(controls.slider.value)));
  controls.field.addEventListener("change", () => {
    showScale();
    draw();
  });
  controls.surface.addEventListener("change", draw);
  root.addEventListener("keydown", onKey);
  calm.addEventListener("change", () => {
    find("reduced").hidden = !calm.matches;
    pause();
  });
  window.addEventListener("resize", () => {
    plot.draw();
    draw();
  });
  showScale();
  draw();
})(surgeViewer);
