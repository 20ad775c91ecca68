// The picture: a surface with the explorer's colours and lights, its camera, and which of two ways draws it.
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

/// The pixels of a canvas, as the camera has them.
function sizeCanvas(canvas, {width, height}) {
  if (canvas.width !== width || canvas.height !== height) canvas.width = width, canvas.height = height;
}

class View {
  /// Drawing by WebGL2 starts when it is measured; until then, where there is none, and while the picture moves where
  /// WebGL2 is slower (because software draws, too), the painter draws on a canvas above.
  constructor(canvas, painted) {
    this.canvas = canvas, this.painted = painted;
    this.painter = new Painter(painted);
    this.webgl = null, this.slow = false;
    this.azimuth = 0, this.elevation = 0, this.zoom = 1;
  }
  /// Another surface: triangles of skin, then of walls, points at rest, and the part of the depth of each.
  take(scene) {
    this.scene = scene;
    this.positions = new Float32Array(3 * scene.count);
    this.skinNormals = new Float32Array(3 * scene.count);
    this.wallNormals = new Float32Array(3 * scene.count);
    this.triangles = new Uint32Array(scene.skin.length + scene.walls.length);
    this.triangles.set(scene.skin), this.triangles.set(scene.walls, scene.skin.length);
  }
  /// Points as they are displaced, and normals. Skin and walls meet in an edge: each has normals of its own.
  move(displacement) {
    const {scene, positions, triangles} = this, {rest} = scene;
    for (let n = 0; n < positions.length; ++n) positions[n] = rest[n] + displacement[n];
    this.smooth(this.skinNormals, positions, triangles, 0, scene.skin.length);
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
  /// The camera of a picture with so many pixels for each of the screen's: all of the surface at rest is in it.
  cameraAt(ratio) {
    const {canvas, scene, azimuth, elevation, zoom} = this;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    const seen = [azimuth, elevation, zoom, width, height];
    if (this.cameraOf === scene && seen.every((number, n) => number === this.cameraSeen[n])) return this.camera;
    this.cameraOf = scene, this.cameraSeen = seen;
    const axes = this.axes(), {right, up, back} = axes, {middle} = scene, angle = 24 * Math.PI / 180;
    const aspect = width / height, high = Math.tan(angle / 2), wide = aspect * high;
    let distance = 0, nearest = Infinity, farthest = -Infinity;
    for (let p = 0, {rest} = scene; p < 3 * scene.count; p += 3) {
      const x = rest[p] - middle[0], y = rest[p + 1] - middle[1], z = rest[p + 2] - middle[2];
      const upward = x * up[0] + y * up[1] + z * up[2], aside = x * right[0] + y * right[1] + z * right[2];
      const needed = Math.max(Math.abs(upward) / high, Math.abs(aside) / wide), depth = x * back[0] + y * back[1] + z * back[2];
      distance = Math.max(distance, 1.35 * needed + depth);
      nearest = Math.min(nearest, depth), farthest = Math.max(farthest, depth);
    }
    const margin = 0.1 * (farthest - nearest) + 0.2 * distance;
    this.camera = {axes, middle, distance, width, height, aspect, f: 1 / Math.tan(angle / 2 / zoom),
                   near: Math.max(0.01 * distance, distance - farthest - margin), far: distance - nearest + margin};
    return this.camera;
  }
  /// Skin and walls: which numbers of corners, their normals, values with their range and colours or one colour, and
  /// how they shine (ambient, diffuse, specular, its power).
  parts(values, range) {
    const {scene} = this, skin = {from: 0, to: scene.skin.length, normals: this.skinNormals};
    const walls = {from: skin.to, to: skin.to + scene.openWalls, normals: this.wallNormals, values: scene.depth, range: [0, 1],
                   table: tissueTable, look: [0.12, 0.9, 0.3, 40]};
    if (values) Object.assign(skin, {values, range, table: valueTable, look: [0.35, 0.62, 0.12, 18]});
    else Object.assign(skin, {values: scene.depth, range: [0, 1], table: tissueTable, look: [0.12, 0.9, 0.12, 18], plain: [0.91, 0.70, 0.60]});
    return scene.openWalls ? [skin, walls] : [skin];
  }
  /// Starts WebGL2, and decides which way is faster while the picture moves.
  measure() {
    if (!this.drawn) return;
    try {
      this.webgl ??= new WebglDrawing(this.canvas);
    } catch (error) {
      return this.draw(...this.drawn);  // the painter goes on
    }
    const time = rough => {
      const begin = performance.now();
      this.draw(...this.drawn, rough);
      if (!rough) this.webgl.finish();
      return performance.now() - begin;
    };
    this.slow = true;  // so that rough pictures are the painter's
    time(false);  // compiles
    const painter = time(true), webgl = time(false);
    this.slow = webgl > 10 && webgl > painter;
  }
  /// Draws again as well as it can.
  refine() {
    if (this.rough) this.draw(...this.drawn);
  }
  draw(values, range, dark, moving = false) {
    const painting = !this.webgl || (moving && this.slow), ratio = Math.min(2, window.devicePixelRatio || 1);
    this.drawn = [values, range, dark], this.rough = moving && painting;
    this.painted.hidden = !painting;
    if (!this.scene) return;
    const background = dark ? [0.15, 0.165, 0.19] : [0.88, 0.905, 0.93], parts = this.parts(values, range);
    if (painting) this.painter.draw(this, this.cameraAt(moving ? 1 : 2), background, parts);
    else this.webgl.draw(this, this.cameraAt(ratio), background, parts);
  }
}
