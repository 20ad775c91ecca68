// The picture: a surface in WebGL2, with the explorer's colours and lights.
"use strict";

const tissueStops = [[0, 0.86, 0.52, 0.46], [0.12, 0.80, 0.40, 0.36], [0.20, 0.93, 0.74, 0.46],
                     [0.50, 0.90, 0.66, 0.36], [0.64, 0.66, 0.17, 0.13], [1, 0.34, 0.04, 0.05]];
const valueStops = [[0, 0.93, 0.83, 0.75], [0.25, 0.90, 0.66, 0.50], [0.5, 0.78, 0.44, 0.44],
                    [0.75, 0.54, 0.26, 0.45], [1, 0.24, 0.12, 0.38]];

/// 256 colours between stops, straight in CIE L*a*b*.
function colorTable(stops) {
  const toLab = ([, ...rgb]) => {
    const [r, g, b] = rgb.map(c => c > 0.04045 ? ((c + 0.055) / 1.055) ** 2.4 : c / 12.92);
    const [x, y, z] = [0.4124 * r + 0.3576 * g + 0.1805 * b, 0.2126 * r + 0.7152 * g + 0.0722 * b,
                       0.0193 * r + 0.1192 * g + 0.9505 * b].map((c, i) => c / [0.9505, 1, 1.089][i])
      .map(c => c > 0.008856 ? Math.cbrt(c) : 7.787 * c + 16 / 116);
    return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
  };
  const toRgb = ([L, a, b]) => {
    const y = (L + 16) / 116;
    const [X, Y, Z] = [a / 500 + y, y, y - b / 200].map(c => c ** 3 > 0.008856 ? c ** 3 : (c - 16 / 116) / 7.787)
      .map((c, i) => c * [0.9505, 1, 1.089][i]);
    return [3.2406 * X - 1.5372 * Y - 0.4986 * Z, -0.9689 * X + 1.8758 * Y + 0.0415 * Z,
            0.0557 * X - 0.204 * Y + 1.057 * Z].map(c => c > 0.0031308 ? 1.055 * c ** (1 / 2.4) - 0.055 : 12.92 * c);
  };
  const labs = stops.map(toLab), bytes = new Uint8Array(4 * 256);
  for (let n = 0; n < 256; ++n) {
    const x = n / 255;
    let i = 1;
    while (i < stops.length - 1 && stops[i][0] < x) ++i;
    const part = (x - stops[i - 1][0]) / (stops[i][0] - stops[i - 1][0]);
    const rgb = toRgb(labs[i].map((to, c) => labs[i - 1][c] + part * (to - labs[i - 1][c])));
    bytes.set([...rgb.map(c => Math.round(255 * clamp(c, 0, 1))), 255], 4 * n);
  }
  return bytes;
}
const tissueTable = colorTable(tissueStops), valueTable = colorTable(valueStops);

const vertexShader = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;
uniform mat4 projection, camera;
uniform vec2 range;
out vec3 seen, facing;
out float part;
void main() {
  vec4 place = camera * vec4(position, 1.0);
  seen = place.xyz;
  facing = mat3(camera) * normal;
  part = (value - range.x) / max(range.y - range.x, 1e-30);
  gl_Position = projection * place;
}`;
const fragmentShader = `#version 300 es
precision highp float;
in vec3 seen, facing;
in float part;
uniform sampler2D colors;
uniform vec4 plain;   // a colour, where its fourth number is 1
uniform vec4 look;    // ambient, diffuse, specular, its power
out vec4 shown;
void main() {
  vec3 n = normalize(facing);
  if (dot(n, -normalize(seen)) < 0.0) n = -n;
  vec3 color = plain.a > 0.5 ? plain.rgb : texture(colors, vec2(clamp(part, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb;
  vec3 lights[3] = vec3[3](vec3(-0.7, 0.9, 1.0), vec3(0.5, -0.25, 1.0), vec3(0.2, 1.0, -0.8));
  vec3 tints[3] = vec3[3](0.80 * vec3(1.0, 1.0, 0.95), 0.50 * vec3(0.97, 1.0, 1.0), 0.25 * vec3(1.0));
  vec3 sum = look.x * color;
  for (int i = 0; i < 3; ++i) {
    vec3 l = normalize(lights[i]);
    float cosine = max(0.0, dot(n, l));
    vec3 mirrored = reflect(-l, n);
    float gloss = cosine > 0.0 ? pow(max(0.0, dot(mirrored, -normalize(seen))), look.w) : 0.0;
    sum += tints[i] * (look.y * cosine * color + look.z * gloss);
  }
  shown = vec4(sum, 1.0);
}`;

class View {
  constructor(canvas) {
    this.canvas = canvas;
    const gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!gl) throw new Error("This browser cannot draw: it has no WebGL2.");
    this.gl = gl;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);
    this.places = {};
    for (const name of ["projection", "camera", "range", "colors", "plain", "look"])
      this.places[name] = gl.getUniformLocation(program, name);
    const texture = bytes => {
      const made = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, made);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
      for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
                                   [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
        gl.texParameteri(gl.TEXTURE_2D, name, value);
      return made;
    };
    this.tissue = texture(tissueTable);
    this.scale = texture(valueTable);
    this.buffers = [gl.createBuffer(), gl.createBuffer(), gl.createBuffer()];
    this.buffers.forEach((buffer, n) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(n);
      gl.vertexAttribPointer(n, n < 2 ? 3 : 1, gl.FLOAT, false, 0, 0);
    });
    this.indices = gl.createBuffer();
    gl.enable(gl.DEPTH_TEST);
    this.azimuth = 0, this.elevation = 0, this.zoom = 1, this.coarse = 1;
  }
  /// Another surface: triangles of skin, then of walls, points at rest, and the part of the depth of each.
  take(scene) {
    const {gl} = this;
    this.scene = scene;
    this.positions = new Float32Array(3 * scene.count);
    this.normals = new Float32Array(3 * scene.count);
    this.triangles = new Uint32Array(scene.skin.length + scene.walls.length);
    this.triangles.set(scene.skin), this.triangles.set(scene.walls, scene.skin.length);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, this.triangles, gl.STATIC_DRAW);
  }
  /// Points as they are displaced, and normals.
  move(displacement) {
    const {scene, positions, normals, triangles} = this, {rest} = scene;
    for (let n = 0; n < positions.length; ++n) positions[n] = rest[n] + displacement[n];
    this.smooth(normals, positions, triangles, 0, scene.skin.length);
    const {gl} = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[0]);
    gl.bufferData(gl.ARRAY_BUFFER, positions, gl.DYNAMIC_DRAW);
    // Skin and walls meet in an edge: each has normals of its own.
    this.skinNormals = normals;
    this.wallNormals = this.wallNormals && this.wallNormals.length === normals.length ? this.wallNormals
                                                                                     : new Float32Array(normals.length);
    this.smooth(this.wallNormals, positions, triangles, scene.skin.length, triangles.length);
  }
  smooth(normals, x, triangles, from, to) {
    normals.fill(0);
    for (let n = from; n < to; n += 3) {
      const a = 3 * triangles[n], b = 3 * triangles[n + 1], c = 3 * triangles[n + 2];
      const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2];
      const vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      normals[a] += nx, normals[a + 1] += ny, normals[a + 2] += nz;
      normals[b] += nx, normals[b + 1] += ny, normals[b + 2] += nz;
      normals[c] += nx, normals[c + 1] += ny, normals[c + 2] += nz;
    }
  }
  /// The camera's axes: right, up, and from the middle to the eye.
  axes() {
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    const back = [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)];
    const right = [Math.cos(a), 0, -Math.sin(a)];
    const up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
                back[0] * right[1] - back[1] * right[0]];
    return {right, up, back};
  }
  /// How many pixels a moving picture may have: fewer where software draws.
  measure() {
    if (!this.drawn) return;
    const pixel = new Uint8Array(4), {gl} = this, begin = performance.now();
    this.draw(...this.drawn);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    this.coarse = clamp(Math.sqrt((performance.now() - begin) / 15), 1, 3);
  }
  /// Draws again with all pixels.
  refine() {
    if (this.rough) this.draw(...this.drawn);
  }
  draw(values, range, dark, moving = false) {
    const {gl, canvas, scene} = this;
    this.drawn = [values, range, dark], this.rough = moving && this.coarse > 1;
    const ratio = Math.min(2, window.devicePixelRatio || 1) / (this.rough ? this.coarse : 1);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) canvas.width = width, canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.clearColor(...(dark ? [0.15, 0.165, 0.19] : [0.88, 0.905, 0.93]), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (!scene) return;
    const {right, up, back} = this.axes(), middle = scene.middle, angle = 24 * Math.PI / 180, aspect = width / height;
    const high = Math.tan(angle / 2), wide = aspect * high, dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let distance = 0, nearest = Infinity, farthest = -Infinity;
    for (let p = 0, {rest} = scene; p < 3 * scene.count; p += 3) {
      const x = rest[p] - middle[0], y = rest[p + 1] - middle[1], z = rest[p + 2] - middle[2];
      const upward = x * up[0] + y * up[1] + z * up[2], aside = x * right[0] + y * right[1] + z * right[2];
      const needed = Math.max(Math.abs(upward) / high, Math.abs(aside) / wide), depth = x * back[0] + y * back[1] + z * back[2];
      distance = Math.max(distance, 1.35 * needed + depth);
      nearest = Math.min(nearest, depth), farthest = Math.max(farthest, depth);
    }
    const margin = 0.1 * (farthest - nearest) + 0.2 * distance;
    const near = Math.max(0.01 * distance, distance - farthest - margin), far = distance - nearest + margin;
    const f = 1 / Math.tan(angle / 2 / this.zoom);
    gl.uniformMatrix4fv(this.places.projection, false,
      [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]);
    gl.uniformMatrix4fv(this.places.camera, false,
      [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
       -dot(right, middle), -dot(up, middle), -dot(back, middle) - distance, 1]);
    const part = (from, count, normals, numbers, texture, limits, look, plain) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[1]);
      gl.bufferData(gl.ARRAY_BUFFER, normals, gl.DYNAMIC_DRAW);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[2]);
      gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform2fv(this.places.range, limits);
      gl.uniform4fv(this.places.look, look);
      gl.uniform4fv(this.places.plain, plain);
      gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 4 * from);
    };
    const skin = scene.skin.length, walls = scene.openWalls;
    if (values) part(0, skin, this.skinNormals, values, this.scale, range, [0.35, 0.62, 0.12, 18], [0, 0, 0, 0]);
    else part(0, skin, this.skinNormals, scene.depth, this.tissue, [0, 1], [0.12, 0.9, 0.12, 18], [0.91, 0.70, 0.60, 1]);
    if (walls) part(skin, walls, this.wallNormals, scene.depth, this.tissue, [0, 1], [0.12, 0.9, 0.3, 40], [0, 0, 0, 0]);
  }
}
