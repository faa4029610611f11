"use strict";
// Water in space, to be turned: particles as balls, the surface of a mesh, the tank's edges, what stands in it. One
// WebGL context draws all panels, each into its own canvas; the projection is parallel, so that lengths compare.
(function (viewer) {
  const vertexSource = `
    attribute vec3 place; attribute vec3 normal; attribute float value;
    uniform mat4 view; uniform float size;
    varying float shade; varying vec3 face;
    void main() {
      gl_Position = view * vec4(place, 1.0);
      gl_PointSize = size;
      shade = value;
      face = (view * vec4(normal, 0.0)).xyz;
    }`;
  // kind 0: balls; 1: faces with light; 2: lines. One colour where ink.a is not zero, else the palette's.
  const fragmentSource = `
    precision mediump float;
    uniform int kind; uniform vec4 ink; uniform float opacity; uniform sampler2D palette;
    varying float shade; varying vec3 face;
    void main() {
      vec3 colour = ink.a > 0.0 ? ink.rgb : texture2D(palette, vec2((shade * 255.0 + 0.5) / 256.0, 0.5)).rgb;
      float light = 1.0;
      if (kind == 0) {
        vec2 from = 2.0 * gl_PointCoord - 1.0;
        float r = dot(from, from);
        if (r > 1.0) discard;
        light = 0.55 + 0.45 * sqrt(1.0 - r);
      } else if (kind == 1) {
        light = 0.6 + 0.4 * abs(normalize(face).z);
      }
      gl_FragColor = vec4(colour * light * opacity, opacity);
    }`;

  function compiled(gl) {
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertexSource], [gl.FRAGMENT_SHADER, fragmentSource]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return null;
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
  }

  const numbersOf = (colour) => colour.startsWith("rgb") ? colour.match(/\d+/g).map(Number)
    : [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));

  // The twelve edges, or the faces with their normals, of a box [x0, y0, z0, x1, y1, z1].
  const cornerOf = (box, c) => [box[c & 1 ? 3 : 0], box[c & 2 ? 4 : 1], box[c & 4 ? 5 : 2]];
  function edgesOf(box) {
    const list = [];
    for (let c = 0; c < 8; ++c)
      for (const step of [1, 2, 4]) if (!(c & step)) list.push(...cornerOf(box, c), ...cornerOf(box, c | step));
    return list;
  }
  function facesOf(box) {
    const place = [], normal = [];
    for (let axis = 0; axis < 3; ++axis)
      for (const side of [0, 1]) {
        const [u, v] = [1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3)], base = side << axis;
        for (const c of [base, base | u, base | u | v, base, base | u | v, base | v]) {
          place.push(...cornerOf(box, c));
          normal.push(...[0, 1, 2].map((a) => (a === axis ? 2 * side - 1 : 0)));
        }
      }
    return {place, normal};
  }

  // Corners of triangles, x, up and depth in turn, with the normal of each.
  function trianglesOf(corners) {
    const normal = [];
    for (let i = 0; i < corners.length; i += 9) {
      const u = [0, 1, 2].map((a) => corners[i + 3 + a] - corners[i + a]);
      const v = [0, 1, 2].map((a) => corners[i + 6 + a] - corners[i + a]);
      const n = [0, 1, 2].map((a) => u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3]);
      const length = Math.hypot(...n) || 1;
      for (let k = 0; k < 3; ++k) normal.push(...n.map((value) => value / length));
    }
    return {place: corners, normal};
  }

  // scene: {box: [x0, y0, z0, x1, y1, z1], space: what data.space holds}. Null where there is no WebGL.
  viewer.makeSpace = function (scene, palette) {
    const screen = document.createElement("canvas");
    const gl = screen.getContext("webgl", {antialias: true, preserveDrawingBuffer: true, premultipliedAlpha: true});
    const program = gl && compiled(gl);
    if (!program) return null;
    gl.getExtension("OES_element_index_uint");
    gl.useProgram(program);
    const uniform = (name) => gl.getUniformLocation(program, name);
    const u = {view: uniform("view"), size: uniform("size"), kind: uniform("kind"), ink: uniform("ink"),
      opacity: uniform("opacity")};
    const attributes = ["place", "normal", "value"].map((name) => ({at: gl.getAttribLocation(program, name),
      buffer: gl.createBuffer(), width: name === "value" ? 1 : 3, type: name === "value" ? gl.UNSIGNED_BYTE : gl.FLOAT}));
    const indices = gl.createBuffer();
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, palette.length, 1, 0, gl.RGB, gl.UNSIGNED_BYTE,
      new Uint8Array(palette.flatMap(numbersOf)));
    for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.NEAREST], [gl.TEXTURE_MAG_FILTER, gl.NEAREST],
      [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);

    const [x0, y0, z0, x1, y1, z1] = scene.box;
    const middle = [(x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2];
    const radius = Math.hypot(x1 - x0, y1 - y0, z1 - z0) / 2;

    // Turned by `yaw` about the vertical, then tipped by `pitch` towards the eye; columns first, as WebGL has it.
    function viewOf(eye, width, height) {
      const [c, s, d, e] = [Math.cos(eye.yaw), Math.sin(eye.yaw), Math.cos(eye.pitch), Math.sin(eye.pitch)];
      const f = scene.space.towards;  // whether the depth grows towards the eye, 1, or away from it, -1
      const rows = [[c, 0, s * f], [s * e, d, -c * e * f], [-s * d, e, c * d * f]];
      // As much as fits at any turn about the vertical.
      const wide = Math.hypot(x1 - x0, z1 - z0), high = (y1 - y0) * Math.abs(d) + wide * Math.abs(e);
      const pixels = Math.min(width / wide, height / high) * 0.96 * eye.zoom;
      const scale = [2 * pixels / width, 2 * pixels / height, -1 / (1.1 * radius * Math.max(1, eye.zoom))];
      const out = new Float32Array(16);
      for (let row = 0; row < 3; ++row) {
        let shift = 0;
        for (let column = 0; column < 3; ++column) {
          out[4 * column + row] = scale[row] * rows[row][column];
          shift -= scale[row] * rows[row][column] * middle[column];
        }
        out[12 + row] = shift;
      }
      out[15] = 1;
      return {matrix: out, pixels};
    }

    function draw(mode, part, kind, ink, opacity) {
      const data = [part.place, part.normal, part.value];
      attributes.forEach(({at, buffer, width, type}, i) => {
        if (at < 0) return;
        if (!data[i]) {
          gl.disableVertexAttribArray(at);
          gl.vertexAttrib3f(at, 0, 0, 1);
          return;
        }
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, ArrayBuffer.isView(data[i]) ? data[i] : new Float32Array(data[i]), gl.DYNAMIC_DRAW);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, width, type, type === gl.UNSIGNED_BYTE, 0, 0);
      });
      gl.uniform1i(u.kind, kind);
      gl.uniform4f(u.ink, ...(ink ? numbersOf(ink).map((c) => c / 255) : [0, 0, 0]), ink ? 1 : 0);
      gl.uniform1f(u.opacity, opacity);
      if (opacity < 1) gl.enable(gl.BLEND);
      else gl.disable(gl.BLEND);
      gl.depthMask(opacity === 1);
      if (part.triangles) {
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, part.triangles, gl.DYNAMIC_DRAW);
        gl.drawElements(mode, part.triangles.length, gl.UNSIGNED_INT, 0);
      } else {
        gl.drawArrays(mode, 0, part.place.length / 3);
      }
    }

    function pointsOf(water, frame, field) {
      const from = water.starts[frame], count = water.starts[frame + 1] - from;
      const place = new Float32Array(3 * count);
      for (let i = 0; i < count; ++i) place.set([water.x[from + i], water.y[from + i], water.z[from + i]], 3 * i);
      return {place, value: water[field].subarray(from, from + count)};
    }

    // The water of a run: in the colours of the field; in one colour, see-through, where `ink` is given.
    function drawWater(water, shown, pixels, ink) {
      const known = water.known[shown.field] && (shown.field !== "pressure" || shown.frame > 0 || water.known.start);
      const colour = ink || (known ? null : "#9a9a9a");
      if (water.mesh) draw(gl.TRIANGLES, viewer.surfaceNets(water.grid, shown.frame, water.half, shown.field), 1, colour, ink ? 0.2 : 1);
      else {
        gl.uniform1f(u.size, Math.max(1.5, 2 * water.half * pixels * (ink ? 0.5 : 1.15)));
        draw(gl.POINTS, pointsOf(water, shown.frame, shown.field), 0, colour, 1);
      }
    }

    // Height over width of a panel: as the scene needs it, seen from a little above.
    const wide = Math.hypot(x1 - x0, z1 - z0);
    const shape = Math.min(1, Math.max(0.4, ((y1 - y0) * Math.cos(0.35) + wide * Math.sin(0.35)) / wide));

    // shown: {eye: {yaw, pitch, zoom}, field, frame}; over: [{water, colour}], see-through, on top.
    return function (canvas, shown, water, over) {
      const ratio = window.devicePixelRatio || 1;
      canvas.style.aspectRatio = "1 / " + shape;
      canvas.width = screen.width = Math.round(Math.max(1, canvas.clientWidth) * ratio);
      canvas.height = screen.height = Math.round(canvas.width * shape);
      gl.viewport(0, 0, screen.width, screen.height);
      gl.depthMask(true);
      gl.clearColor(1, 1, 1, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      const {matrix, pixels} = viewOf(shown.eye, screen.width, screen.height);
      gl.uniformMatrix4fv(u.view, false, matrix);
      draw(gl.LINES, {place: edgesOf(scene.box)}, 2, "#303030", 1);
      const whole = (box) => box.map((value, i) => (value === null ? scene.box[i] : value));
      for (const box of scene.space.obstacles) draw(gl.TRIANGLES, facesOf(whole(box)), 1, "#8a8a8a", 1);
      for (const corners of scene.space.surfaces) draw(gl.TRIANGLES, trianglesOf(corners), 1, "#8a8a8a", 1);
      for (const boxes of scene.space.walls) draw(gl.TRIANGLES, facesOf(whole(boxes[shown.frame])), 1, "#e69f00", 1);
      drawWater(water, shown, pixels, null);
      for (const one of over) drawWater(one.water, shown, pixels, one.colour);
      const context = canvas.getContext("2d");
      context.drawImage(screen, 0, 0);
      if (water.starts[shown.frame] === water.starts[shown.frame + 1]) {
        context.fillStyle = "#606060";
        context.font = 14 * ratio + "px sans-serif";
        context.textAlign = "center";
        context.fillText("no frame at this time", canvas.width / 2, canvas.height / 2);
      }
    };
  };
})(surgeViewer);
