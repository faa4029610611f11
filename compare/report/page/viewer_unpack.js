"use strict";
// The report's viewer. Its parts hang on one object, so that they share a page with nothing else.
const surgeViewer = {};

// From packed text to what is drawn: viewer_pack.hpp and viewer_encoding.hpp describe the streams.
(function (viewer) {
  function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  // Whether this browser can read packed data at all.
  viewer.canUnpack = typeof DecompressionStream === "function";

  // The streams of a track, one array of bytes each.
  async function streamsOf(track) {
    const packed = new Blob([bytesOf(track.data)]).stream();
    const all = await new Response(packed.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
    let at = 0;
    return track.sizes.map((size) => new Uint8Array(all, (at += size) - size, size));
  }

  // Reads the numbers of a stream one after the other.
  function numbers(bytes) {
    let at = 0;
    const next = () => {
      let value = 0, shift = 0, byte;
      do {
        byte = bytes[at++];
        value |= (byte & 127) << shift;
        shift += 7;
      } while (byte > 127);
      return value >>> 0;
    };
    const signed = () => {
      const value = next();
      return (value >>> 1) ^ -(value & 1);
    };
    return {next, signed};
  }

  // Where each time begins; one entry more than there are times.
  function startsOf(counts) {
    const starts = [0];
    for (const n of counts) starts.push(starts[starts.length - 1] + n);
    return starts;
  }

  // For each particle of a time its number in the time before, -1 where it is new.
  function origins(before, count, gone) {
    const from = new Int32Array(count).fill(-1);
    let lost = gone.next(), next = lost ? gone.next() : -1, at = 0;
    for (let i = 0; i < before; ++i) {
      if (i === next) next = --lost ? next + gone.next() : -1;
      else from[at++] = i;
    }
    return from;
  }

  // One coordinate of all particles at all times.
  function places(bytes, starts, from, step) {
    const read = numbers(bytes);
    const out = new Float32Array(starts[starts.length - 1]);
    let at = new Int32Array(0), moved = at;
    for (let t = 0; t + 1 < starts.length; ++t) {
      const count = starts[t + 1] - starts[t];
      const now = new Int32Array(count), went = new Int32Array(count);
      for (let i = 0; i < count; ++i) {
        const j = from[t][i];
        now[i] = read.signed() + (j >= 0 ? at[j] + moved[j] : i > 0 ? now[i - 1] : 0);
        if (j >= 0) went[i] = now[i] - at[j];
        out[starts[t] + i] = now[i] * step;
      }
      [at, moved] = [now, went];
    }
    return out;
  }

  // One value of all particles at all times, in place.
  function values(bytes, starts, from) {
    for (let t = 1; t + 1 < starts.length; ++t)
      for (let i = starts[t]; i < starts[t + 1]; ++i) {
        const j = from[t][i - starts[t]];
        if (j >= 0) bytes[i] += bytes[starts[t - 1] + j];
      }
    return bytes;
  }

  function particles(track, streams) {
    const starts = startsOf(track.counts);
    const gone = numbers(streams[0]);
    const from = track.counts.map((count, t) => origins(t > 0 ? track.counts[t - 1] : 0, count, gone));
    const water = {mesh: false, half: track.half, known: track.known, starts};
    water.x = places(streams[1], starts, from, track.step);
    water.y = places(streams[2], starts, from, track.step);
    if (track.dimension === 3) water.z = places(streams[3], starts, from, track.step);
    const after = track.dimension + 1;
    water.pressure = values(streams[after], starts, from);
    water.speed = values(streams[after + 1], starts, from);
    return water;
  }

  // The squares of a mesh that hold water, as patches; its whole grid stays at hand.
  function squares(track, [fraction, pressure, speed]) {
    const {size, first, half} = track;
    const all = size[0] * size[1] * size[2];
    for (const plane of [fraction, pressure, speed])
      for (let i = all; i < plane.length; ++i) plane[i] += plane[i - all];
    const counts = [];
    for (let t = 0; t < track.times; ++t) {
      let count = 0;
      for (let i = t * all; i < (t + 1) * all; ++i) if (fraction[i]) ++count;
      counts.push(count);
    }
    const starts = startsOf(counts), total = starts[track.times];
    const water = {mesh: true, half, known: track.known, starts, grid: {size, first, all, fraction, pressure, speed},
      x: new Float32Array(total), y: new Float32Array(total), fraction: new Uint8Array(total),
      pressure: new Uint8Array(total), speed: new Uint8Array(total)};
    if (track.dimension === 3) water.z = new Float32Array(total);
    const middle = (axis, k) => (2 * (first[axis] + k) + 1) * half;
    for (let i = 0, n = 0; i < fraction.length; ++i) {
      if (!fraction[i]) continue;
      const cell = i % all;
      water.x[n] = middle(0, cell % size[0]);
      water.y[n] = middle(1, Math.floor(cell / size[0]) % size[1]);
      if (water.z) water.z[n] = middle(2, Math.floor(cell / (size[0] * size[1])));
      water.fraction[n] = fraction[i];
      water.pressure[n] = pressure[i];
      water.speed[n++] = speed[i];
    }
    return water;
  }

  viewer.unpackWater = async function (track) {
    const streams = await streamsOf(track);
    return track.mesh ? squares(track, streams) : particles(track, streams);
  };

  // What of water in space lies in the slice: centres within half a patch of its plane. Of two layers of cubes
  // that meet there it is one; particles on both sides count.
  viewer.sliced = function (water, middle) {
    const slack = 0.02 * water.half, before = water.mesh ? -water.half + slack : -water.half - slack;
    const inside = (i) => water.z[i] - middle >= before && water.z[i] - middle <= water.half + slack;
    const counts = [], chosen = [];
    for (let t = 0; t + 1 < water.starts.length; ++t) {
      const before = chosen.length;
      for (let i = water.starts[t]; i < water.starts[t + 1]; ++i) if (inside(i)) chosen.push(i);
      counts.push(chosen.length - before);
    }
    const slice = Object.assign({}, water, {starts: startsOf(counts), z: undefined, grid: undefined});
    for (const name of ["x", "y", "pressure", "speed", "fraction"])
      if (water[name]) slice[name] = water[name].constructor.from(chosen, (i) => water[name][i]);
    return slice;
  };

  viewer.unpackSurface = async function (track) {
    const [countBytes, xBytes, yBytes] = await streamsOf(track);
    const counts = numbers(countBytes), xs = numbers(xBytes), ys = numbers(yBytes);
    const points = {x0: [], y0: [], x1: [], y1: []}, starts = [0];
    let x = 0, y = 0;
    for (let t = 0; t < track.times; ++t) {
      for (let lines = counts.next(); lines > 0; --lines) {
        const count = counts.next();
        for (let i = 0; i < count; ++i) {
          const from = [x * track.step, y * track.step];
          x += xs.signed();
          y += ys.signed();
          if (i === 0) continue;
          points.x0.push(from[0]);
          points.y0.push(from[1]);
          points.x1.push(x * track.step);
          points.y1.push(y * track.step);
        }
      }
      starts.push(points.x0.length);
    }
    return Object.assign(points, {starts});
  };

  viewer.decodePalette = function (base64) {
    const bytes = bytesOf(base64);
    const colours = [];
    for (let i = 0; i < bytes.length; i += 3) {
      colours.push("rgb(" + bytes[i] + "," + bytes[i + 1] + "," + bytes[i + 2] + ")");
    }
    return colours;
  };
})(surgeViewer);
