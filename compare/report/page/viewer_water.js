"use strict";
// The report's viewer. Its parts hang on one object, so that they share a page with nothing else.
const surgeViewer = {};

// From base64 to what is drawn: viewer_encoding.hpp describes the planes.
(function (viewer) {
  function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  function reader(track) {
    const bytes = bytesOf(track.data);
    const total = track.counts.reduce((sum, n) => sum + n, 0);
    let at = 0;
    return {
      words(interval) {
        const scale = (interval[1] - interval[0]) / 65535;
        const plane = new Float32Array(total);
        for (let i = 0; i < total; ++i, at += 2) {
          plane[i] = interval[0] + scale * (bytes[at] | (bytes[at + 1] << 8));
        }
        return plane;
      },
      bytes() {
        at += total;
        return bytes.subarray(at - total, at);
      },
    };
  }

  // Where each time begins in the planes; one entry more than there are times.
  function startsOf(counts) {
    const starts = [0];
    for (const n of counts) starts.push(starts[starts.length - 1] + n);
    return starts;
  }

  viewer.decodeWater = function (track) {
    const read = reader(track);
    const water = {mesh: track.mesh, half: track.half, starts: startsOf(track.counts)};
    water.x = read.words(track.x);
    water.y = read.words(track.y);
    water.pressure = read.bytes();
    water.speed = read.bytes();
    if (track.mesh) water.fraction = read.bytes();
    return water;
  };

  viewer.decodeSurface = function (track) {
    const read = reader(track);
    return {
      starts: startsOf(track.counts),
      x0: read.words(track.x),
      y0: read.words(track.y),
      x1: read.words(track.x),
      y1: read.words(track.y),
    };
  };

  viewer.decodePalette = function (base64) {
    const bytes = bytesOf(base64);
    const colours = [];
    for (let i = 0; i < bytes.length; i += 3) {
      colours.push("rgb(" + bytes[i] + "," + bytes[i + 1] + "," + bytes[i + 2] + ")");
    }
    return colours;
  };

  // A canvas as large as its place on the screen, and lengths over L to its pixels.
  function prepare(canvas, view) {
    const width = Math.max(1, canvas.clientWidth);
    const ratio = window.devicePixelRatio || 1;
    canvas.style.aspectRatio = view.width + " / " + view.height;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round((canvas.width * view.height) / view.width);
    const context = canvas.getContext("2d");
    const scale = canvas.width / view.width;
    const top = canvas.height;
    return {context, scale, ratio, x: (x) => x * scale, y: (y) => top - y * scale};
  }

  function drawCells(place, water, field, palette, from, to) {
    const {context} = place;
    for (let i = from; i < to; ++i) {
      // Edges on whole pixels: no seams between neighbours.
      const left = Math.round(place.x(water.x[i] - water.half));
      const right = Math.round(place.x(water.x[i] + water.half));
      const upper = Math.round(place.y(water.y[i] + water.half));
      const lower = Math.round(place.y(water.y[i] - water.half));
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

  function markAbove(place, water, view, from, to) {
    const {context, ratio} = place;
    const half = 4 * ratio;
    context.fillStyle = "#606060";
    for (let i = from; i < to; ++i) {
      if (!(water.y[i] > view.height)) continue;
      const x = place.x(water.x[i]);
      context.beginPath();
      context.moveTo(x, 0);
      context.lineTo(x + half, 1.5 * half);
      context.lineTo(x - half, 1.5 * half);
      context.fill();
    }
  }

  function drawSurface(place, surface, frame) {
    const {context, ratio} = place;
    context.beginPath();
    for (let i = surface.starts[frame]; i < surface.starts[frame + 1]; ++i) {
      context.moveTo(place.x(surface.x0[i]), place.y(surface.y0[i]));
      context.lineTo(place.x(surface.x1[i]), place.y(surface.y1[i]));
    }
    context.lineCap = "round";
    for (const [width, colour] of [[3.2, "#fff"], [1.6, "#d55e00"]]) {
      context.lineWidth = width * ratio;
      context.strokeStyle = colour;
      context.stroke();
    }
  }

  // surface: null where none is to be drawn.
  viewer.drawWater = function (canvas, view, water, fieldName, palette, frame, surface) {
    const place = prepare(canvas, view);
    const from = water.starts[frame];
    const to = water.starts[frame + 1];
    const draw = water.mesh ? drawCells : drawDiscs;
    draw(place, water, water[fieldName], palette, from, to);
    if (surface) drawSurface(place, surface, frame);
    markAbove(place, water, view, from, to);
    if (from === to) {
      place.context.fillStyle = "#606060";
      place.context.font = 14 * place.ratio + "px sans-serif";
      place.context.textAlign = "center";
      place.context.fillText("no frame at this time", canvas.width / 2, canvas.height / 2);
    }
  };
})(surgeViewer);

