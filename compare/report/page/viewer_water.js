"use strict";
// Water in the plane of the picture: canvas, squares and discs, what stands in it.
(function (viewer) {
  // A canvas as large as its place on the screen, and lengths over L to its pixels. region: the part of the
  // flow that is shown, {x0, y0, width, height}.
  function prepare(canvas, region) {
    const width = Math.max(1, canvas.clientWidth);
    const ratio = window.devicePixelRatio || 1;
    canvas.style.aspectRatio = region.width + " / " + region.height;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round((canvas.width * region.height) / region.width);
    const context = canvas.getContext("2d");
    const scale = canvas.width / region.width;
    const bottom = canvas.height + region.y0 * scale;
    context.fillStyle = "#fff";
    context.fillRect(0, 0, canvas.width, canvas.height);
    return {context, scale, ratio, x: (x) => (x - region.x0) * scale, y: (y) => bottom - y * scale};
  }

  function fillBox(place, box, colour) {
    const {context, ratio} = place;
    const [x0, y0, x1, y1] = [place.x(box[0]), place.y(box[3]), place.x(box[2]), place.y(box[1])];
    context.fillStyle = colour;
    context.fillRect(x0, y0, x1 - x0, y1 - y0);
    context.lineWidth = ratio;
    context.strokeStyle = "#303030";
    context.strokeRect(x0, y0, x1 - x0, y1 - y0);
  }

  // Walls of the tank; open sides dotted; sides that are not known are not drawn.
  function drawTank(place, solids, region) {
    if (!solids.tank) return;
    const {context, ratio} = place;
    const [x0, y0, x1, y1] = solids.tank;
    const known = (value, other) => (value === null ? other : value);
    const left = known(x0, region.x0), right = known(x1, region.x0 + region.width);
    const low = known(y0, region.y0), high = known(y1, region.y0 + region.height);
    const sides = [["x-", x0, [left, low, left, high]], ["x+", x1, [right, low, right, high]],
      [solids.up + "-", y0, [left, low, right, low]], [solids.up + "+", y1, [left, high, right, high]]];
    for (const [name, place_, line] of sides) {
      if (place_ === null) continue;
      const open = solids.open.includes(name);
      context.setLineDash(open ? [2 * ratio, 4 * ratio] : []);
      context.lineWidth = (open ? 1.5 : 4) * ratio;
      context.strokeStyle = "#303030";
      context.beginPath();
      context.moveTo(place.x(line[0]), place.y(line[1]));
      context.lineTo(place.x(line[2]), place.y(line[3]));
      context.stroke();
    }
    context.setLineDash([]);
  }

  // A body with a surface, where the plane cuts it.
  function fillOutline(place, outline, colour) {
    const {context} = place;
    context.beginPath();
    outline.forEach(([x, y], i) => (i ? context.lineTo(place.x(x), place.y(y)) : context.moveTo(place.x(x), place.y(y))));
    context.closePath();
    context.fillStyle = colour;
    context.fill();
  }

  function drawSolids(place, solids, region, frame) {
    for (const box of solids.obstacles) fillBox(place, box, "#8a8a8a");
    for (const outline of solids.outlines) fillOutline(place, outline, "#8a8a8a");
    for (const boxes of solids.walls) fillBox(place, boxes[frame], "#e69f00");
    drawTank(place, solids, region);
  }

  function drawCells(place, water, field, palette, from, to) {
    const {context} = place;
    for (let i = from; i < to; ++i) {
      // Edges on whole pixels: no seams between neighbours. Places are kept to 1/128 of a cell, so that
      // an edge may come out once below and once above half a pixel; a little more covers that.
      const left = Math.round(place.x(water.x[i] - water.half));
      const right = Math.round(place.x(water.x[i] + 1.02 * water.half));
      const upper = Math.round(place.y(water.y[i] + water.half));
      const lower = Math.round(place.y(water.y[i] - 1.02 * water.half));
      context.globalAlpha = water.fraction[i] / 255;
      context.fillStyle = palette[field[i]];
      context.fillRect(left, upper, right - left, lower - upper);
    }
    context.globalAlpha = 1;
  }

  function drawDiscs(place, water, field, palette, from, to) {
    const {context} = place;
    const radius = Math.max(water.half * place.scale, 0.6 * place.ratio);
    for (let i = from; i < to; ++i) {
      context.fillStyle = palette[field[i]];
      context.beginPath();
      context.arc(place.x(water.x[i]), place.y(water.y[i]), radius, 0, 2 * Math.PI);
      context.fill();
    }
  }

  // Where water is above the whole picture.
  function markAbove(place, water, view, from, to) {
    const {context, ratio} = place;
    const half = 4 * ratio;
    context.fillStyle = "#606060";
    for (let i = from; i < to; ++i) {
      if (!(water.y[i] > view.y0 + view.height)) continue;
      const x = place.x(water.x[i]);
      context.beginPath();
      context.moveTo(x, 0);
      context.lineTo(x + half, 1.5 * half);
      context.lineTo(x - half, 1.5 * half);
      context.fill();
    }
  }

  // The line of a free surface at a time, on a white ground.
  viewer.drawSurface = function (place, surface, frame, colour, width) {
    const {context, ratio} = place;
    context.beginPath();
    for (let i = surface.starts[frame]; i < surface.starts[frame + 1]; ++i) {
      context.moveTo(place.x(surface.x0[i]), place.y(surface.y0[i]));
      context.lineTo(place.x(surface.x1[i]), place.y(surface.y1[i]));
    }
    context.lineCap = "round";
    for (const [extra, ink] of [[1.6, "#fff"], [0, colour]]) {
      context.lineWidth = (width + extra) * ratio;
      context.strokeStyle = ink;
      context.stroke();
    }
  };

  // What is shown: {view, region, solids, palette, field, frame, start}; lines: {surface, colour, width} of
  // the free surfaces to draw.
  viewer.drawWater = function (canvas, shown, water, lines) {
    const place = prepare(canvas, shown.region);
    const from = water.starts[shown.frame];
    const to = water.starts[shown.frame + 1];
    const draw = water.mesh ? drawCells : drawDiscs;
    // What the files do not hold has one colour.
    const known = water.known[shown.field] && (shown.field !== "pressure" || shown.frame > 0 || water.known.start);
    const colours = known ? shown.palette : shown.palette.map(() => "#9a9a9a");
    draw(place, water, water[shown.field], colours, from, to);
    drawSolids(place, shown.solids, shown.region, shown.frame);
    for (const line of lines)
      viewer.drawSurface(place, line.surface, shown.frame, line.colour, line.width);
    if (shown.region.height === shown.view.height) markAbove(place, water, shown.view, from, to);
    if (from === to) {
      place.context.fillStyle = "#606060";
      place.context.font = 14 * place.ratio + "px sans-serif";
      place.context.textAlign = "center";
      place.context.fillText("no frame at this time", canvas.width / 2, canvas.height / 2);
    }
  };
})(surgeViewer);
