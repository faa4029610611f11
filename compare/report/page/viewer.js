// Controls: one frame number, one part of the flow and one choice of runs, which everything follows.
(async function (viewer) {
  if (!viewer.canUnpack) {
    document.querySelector(".viewer-still").prepend("This browser cannot read the packed frames (it has no DecompressionStream). ");
    return;
  }
  const root = document.getElementById("viewer-root");
  const find = (name) => root.querySelector(".viewer-" + name);
  const data = JSON.parse(document.getElementById("viewer-data").textContent);
  const palette = viewer.decodePalette(data.palette);
  const times = data.metrics.times_s;
  const last = times.length - 1;
  const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
  const quantities = {pressure: "p/(ρgH)", speed: "|u|/√(2gH)"};
  const controls = {};
  for (const name of ["play", "slider", "field", "surface", "speed", "mode", "first", "second", "closer", "wider",
    "whole", "save", "dimension"]) controls[name] = find(name);
  const view = data.view;
  const most_zoom = 16;
  let region = Object.assign({}, view);
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

  // Of a run in space `water` is its slice, and `whole` all of it.
  const runs = await Promise.all(data.runs.map(async (run) => {
    const [whole, surface] = await Promise.all([viewer.unpackWater(run.water), viewer.unpackSurface(run.surface)]);
    delete run.water.data;
    return {run, whole, water: data.space ? viewer.sliced(whole, data.space.middle) : whole, surface};
  }));
  const reference = runs.find((one) => one.run.reference) || runs[0];

  function swatch(parent, run) {
    const svg = viewer.svgElement("svg", {class: "viewer-swatch", viewBox: "0 0 26 8", "aria-hidden": "true"}, parent);
    viewer.svgElement("path", {d: "M0 4h26", stroke: run.colour, "stroke-width": 2.5,
      "stroke-dasharray": run.dash.join(" ")}, svg);
  }

  // A panel of a run's water; over: a run whose free surface lies on it, or null.
  function makePanel(one, over) {
    const {run} = one;
    const panel = make("div", find("panels"));
    panel.className = "viewer-panel";
    const head = make("div", panel);
    head.className = "viewer-head";
    const title = make("strong", head);
    swatch(title, run);
    title.append(" " + run.label);
    if (over) {
      title.append(" under the surface of ");
      swatch(title, over.run);
      title.append(" " + over.run.label);
    }
    const edge = make("span", head);
    if (run.note) {
      const note = make("data", head, run.note);
      note.className = "viewer-note";
      note.setAttribute("data-key", "/runs/" + run.name + "/note");
      note.setAttribute("value", run.note);
    }
    const canvas = make("canvas", panel);
    canvas.setAttribute("role", "img");
    return {one, over, edge, canvas, label: title.textContent.trim()};
  }

  let panels = [];

  function arrange() {
    const mode = controls.mode.value;
    find("choice").hidden = mode === "all";
    find("panels").replaceChildren();
    find("panels").className = "viewer-panels" + (mode === "over" ? " viewer-large" : mode === "two" ? " viewer-pair" : "");
    const first = runs[controls.first.value], second = runs[controls.second.value];
    if (mode === "all") panels = runs.map((one) => makePanel(one, null));
    else if (mode === "two") panels = [makePanel(first, null), makePanel(second, null)];
    else panels = [makePanel(first, second)];
    draw();
  }

  // The surfaces that a panel shows: of a mesh its own, that of the reference on demand.
  function linesOf(panel) {
    const line = (one, width) => ({surface: one.surface, colour: one.run.colour, width});
    if (panel.over) return [line(panel.one, 1.6), line(panel.over, 2.6)];
    const lines = [];
    if (panel.one.water.mesh && panel.one !== reference) lines.push(line(panel.one, 1.6));
    if (controls.surface.checked || (panel.one === reference && panel.one.water.mesh)) lines.push(line(reference, 1.6));
    return lines;
  }

  // What is seen through the water of a panel in space: of two runs the other, else the reference's surface.
  function othersOf(panel) {
    const other = panel.over || (controls.surface.checked && panel.one !== reference && reference.whole.mesh ? reference : null);
    return other ? [{water: other.whole, colour: other.run.colour}] : [];
  }

  const inSpace = () => space !== null && controls.dimension.value === "space";

  function drawPanel(panel) {
    const field = controls.field.value;
    if (inSpace()) space(panel.canvas, {eye, field, frame}, panel.one.whole, othersOf(panel));
    else viewer.drawWater(panel.canvas, {view, region, solids: data.solids, palette, field, frame}, panel.one.water, linesOf(panel));
    const fronts = data.metrics.Z_over_L[panel.one.run.name];
    const has = fronts.some((z) => z !== null);
    if (has) panel.edge.replaceChildren("Z/L = ", number(["Z_over_L", panel.one.run.name, frame], 2));
    panel.canvas.setAttribute("aria-label", panel.label + (inSpace() ? " in space" : "") + " at " + times[frame].toFixed(3) + " s, coloured by " + field +
      (has && fronts[frame] !== null ? "; leading edge Z/L = " + fronts[frame].toFixed(2) : ""));
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

  // The frame that is due `seconds` after the frame `first`, at the speed that is chosen; where less motion is
  // asked for, every tenth part of all frames once a second.
  function due(first, seconds) {
    if (calm.matches) return first + Math.max(1, Math.round(last / 10)) * Math.floor(seconds);
    const until = times[first] + seconds * Number(controls.speed.value);
    let at = first;
    while (at < last && times[at + 1] <= until + 1e-9) ++at;
    return at;
  }

  function play() {
    let first = frame === last ? 0 : frame;
    let begin = null;
    let speed = controls.speed.value;
    show(first);
    const step = (now) => {
      if (begin === null || speed !== controls.speed.value) [begin, first, speed] = [now, frame, controls.speed.value];
      const next = due(first, (now - begin) / 1000);
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

  // factor > 1: closer, about a point given in lengths over L.
  function zoom(factor, x, y) {
    const width = Math.min(view.width, Math.max(view.width / most_zoom, region.width / factor));
    const scale = width / region.width;
    move(x - (x - region.x0) * scale, y - (y - region.y0) * scale, width);
  }

  function move(x0, y0, width) {
    const height = (width * view.height) / view.width;
    region = {width, height, x0: Math.min(Math.max(x0, view.x0), view.x0 + view.width - width),
      y0: Math.min(Math.max(y0, view.y0), view.y0 + view.height - height)};
    controls.wider.disabled = controls.whole.disabled = width >= view.width;
    controls.closer.disabled = width <= view.width / most_zoom;
    draw();
  }

  // Closer in space, and the view turned by degrees to the right and up.
  function approach(factor) {
    eye.zoom = Math.min(most_zoom, Math.max(1, eye.zoom * factor));
    controls.wider.disabled = eye.zoom <= 1;
    controls.closer.disabled = eye.zoom >= most_zoom;
    draw();
  }
  function turn(right, up) {
    eye.yaw -= (right * Math.PI) / 180;
    eye.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, eye.pitch + (up * Math.PI) / 180));
    draw();
  }

  function zoomMiddle(factor) {
    if (inSpace()) approach(factor);
    else zoom(factor, region.x0 + region.width / 2, region.y0 + region.height / 2);
  }
  function zoomOut() {
    if (!inSpace()) return move(view.x0, view.y0, view.width);
    Object.assign(eye, straight);
    approach(1);
    controls.whole.disabled = false;
  }

  // What pointers and keys do, viewer_input.js says when.
  const acts = {
    zoomAt(factor, [right, up]) {
      if (inSpace()) approach(factor);
      else zoom(factor, region.x0 + right * region.width, region.y0 + up * region.height);
    },
    // By parts of the panel's width and height, and by pixels.
    drag([right, up], [pixelsRight, pixelsDown]) {
      if (inSpace()) turn(-0.5 * pixelsRight, 0.5 * pixelsDown);
      else if (region.width < view.width)
        move(region.x0 - right * region.width, region.y0 - up * region.height, region.width);
    },
    step: (frames) => seek(frame + frames), last, zoomMiddle, zoomOut, inSpace, turn, toggle};

  function showScale() {
    find("lower").replaceChildren(number(["colour_range", 0], 0));
    find("upper").replaceChildren(number(["colour_range", 1], 0));
    find("quantity").textContent = quantities[controls.field.value];
    find("bar").style.background = "linear-gradient(to right," + palette.filter((_, i) => i % 15 === 0).join(",") + ")";
  }

  // So that the whole lasts at least eight seconds.
  function offerSpeeds() {
    const span = times[last] - times[0];
    const speeds = [[1, "real time"], [0.5, "1/2 of real time"], [0.2, "1/5 of real time"], [0.1, "1/10 of real time"],
      [0.05, "1/20 of real time"], [0.02, "1/50 of real time"], [0.01, "1/100 of real time"]];
    for (const [speed, name] of speeds) make("option", controls.speed, name).value = speed;
    const fitting = speeds.find(([speed]) => span / speed >= 8) || speeds[speeds.length - 1];
    controls.speed.value = fitting[0];
  }

  function offerRuns() {
    for (const select of [controls.first, controls.second])
      runs.forEach((one, i) => (make("option", select, one.run.label).value = i));
    const others = runs.map((_, i) => i).filter((i) => runs[i] !== reference);
    controls.first.value = others.length ? others[0] : 0;
    controls.second.value = runs.indexOf(reference);
    if (runs.length < 2) find("arrangement").hidden = true;
  }

  function save() {
    const time = "t = " + times[frame].toFixed(3) + " s, T = " + data.metrics.T[frame].toFixed(2);
    const picture = viewer.composePicture(panels, {title: data.title, time, quantity: quantities[controls.field.value]}, palette);
    viewer.savePicture(picture, "frame_" + String(frame).padStart(4, "0") + ".png");
  }

  function changeView() {
    find("turn").hidden = !inSpace();
    if (inSpace()) approach(1);
    else move(region.x0, region.y0, region.width);
    controls.whole.disabled = !inSpace() && region.width >= view.width;
    controls.field.dispatchEvent(new Event("change"));
  }

  // The choice between slice and space; where there is no WebGL it says so.
  function offerSpace() {
    if (!data.space) return;
    find("space").hidden = false;
    if (space === null) {
      controls.dimension.value = "slice";
      controls.dimension.disabled = true;
      find("flat").hidden = false;
    }
    for (const button of find("turn").querySelectorAll("button"))
      button.addEventListener("click", () => turn(Number(button.dataset.right), Number(button.dataset.up)));
    controls.dimension.addEventListener("change", changeView);
  }

  function makeScene() {
    if (!data.space) return null;
    const box = [view.x0, view.y0, 0, view.x0 + view.width, view.y0 + view.height, 2 * data.space.middle];
    return viewer.makeSpace({box, space: data.space}, palette);
  }

  const straight = {yaw: -0.5, pitch: 0.35, zoom: 1};
  const eye = Object.assign({}, straight);
  const space = makeScene();
  // On the surface, which is what is seen in space, there is no pressure.
  if (space !== null && runs.every((one) => one.run.water.known.speed)) controls.field.value = "speed";
  root.hidden = false;
  document.querySelector(".viewer-still").hidden = true;
  const plot = viewer.makePlot(find("plot"), data, seek);
  viewer.runs = runs;
  viewer.picture = () => viewer.composePicture(panels, {title: data.title, time: "", quantity: ""}, palette);
  controls.slider.max = String(last);
  find("reduced").hidden = !calm.matches;
  find("of").textContent = reference.run.label;
  offerSpeeds();
  offerRuns();
  controls.play.addEventListener("click", toggle);
  controls.slider.addEventListener("input", () => seek(Number(controls.slider.value)));
  controls.field.addEventListener("change", () => {
    showScale();
    draw();
  });
  controls.surface.addEventListener("change", draw);
  for (const name of ["mode", "first", "second"]) controls[name].addEventListener("change", arrange);
  controls.closer.addEventListener("click", () => zoomMiddle(1.5));
  controls.wider.addEventListener("click", () => zoomMiddle(1 / 1.5));
  controls.whole.addEventListener("click", zoomOut);
  controls.save.addEventListener("click", save);
  viewer.listen(root, find("panels"), acts);
  calm.addEventListener("change", () => {
    find("reduced").hidden = !calm.matches;
    pause();
  });
  window.addEventListener("resize", () => {
    if (plot.draw) plot.draw();
    draw();
  });
  offerSpace();
  showScale();
  arrange();
  zoomOut();
  changeView();
  root.dataset.ready = "yes";
})(surgeViewer);
