// Drawing without WebGL2: triangles with colours at their corners, and of those behind each other the nearest. Where
// WebGL2 itself is software, this takes a seventh of its time: it shades corners and not pixels, has one sample in a
// pixel, and draws on the thread that has moved them.
"use strict";

const lights = [[[-0.7, 0.9, 1], [0.8, 0.8, 0.76]], [[0.5, -0.25, 1], [0.485, 0.5, 0.5]], [[0.2, 1, -0.8], [0.25, 0.25, 0.25]]]
  .map(([[x, y, z], tint]) => ({x: x / Math.hypot(x, y, z), y: y / Math.hypot(x, y, z), z: z / Math.hypot(x, y, z), tint}));

class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d", {alpha: false, willReadFrequently: true});
    this.corners = new Map();
  }
  /// Arrays for a picture of the camera's size, and for the points of a surface.
  prepare(surface, camera) {
    const {width, height} = camera, count = surface.positions.length / 3;
    sizeCanvas(this.canvas, camera);
    if (!this.image || this.image.width !== width || this.image.height !== height) {
      this.image = this.context.createImageData(width, height);
      this.pixels = new Uint32Array(this.image.data.buffer);
      this.depths = new Float32Array(width * height);
    }
    if (this.triangles === surface.triangles) return;
    this.triangles = surface.triangles;
    this.corners.clear();
    for (const name of ["x", "y", "near", "red", "green", "blue"]) this[name] = new Float32Array(count);
    this.seen = new Float32Array(3 * count);
  }
  /// The points that triangles `from` ... have.
  cornersOf({from, to}) {
    const key = from + "-" + to;
    if (!this.corners.has(key)) this.corners.set(key, Uint32Array.from(new Set(this.triangles.subarray(from, to))));
    return this.corners.get(key);
  }
  draw(surface, camera, background, parts) {
    this.prepare(surface, camera);
    const [red, green, blue] = background.map(part => Math.round(255 * part));
    this.pixels.fill((255 << 24 | blue << 16 | green << 8 | red) >>> 0);
    this.depths.fill(0);
    this.project(surface.positions, camera);
    for (const part of parts) {
      this.shade(part, camera);
      this.fill(part, camera);
    }
    this.context.putImageData(this.image, 0, 0);
  }
  /// Places on the picture, 1 / distance, and places as the camera sees them.
  project(positions, {axes: {right, up, back}, middle: [mx, my, mz], distance, width, height, f, aspect}) {
    const {x, y, near, seen} = this, wide = 0.5 * width * f / aspect, high = 0.5 * height * f;
    for (let p = 0, at = 0; p < x.length; ++p, at += 3) {
      const dx = positions[at] - mx, dy = positions[at + 1] - my, dz = positions[at + 2] - mz;
      const aside = dx * right[0] + dy * right[1] + dz * right[2], upward = dx * up[0] + dy * up[1] + dz * up[2];
      const ahead = distance - (dx * back[0] + dy * back[1] + dz * back[2]);
      seen[at] = aside, seen[at + 1] = upward, seen[at + 2] = -ahead;
      near[p] = 1 / ahead;
      x[p] = 0.5 * width + wide * aside / ahead;
      y[p] = 0.5 * height - high * upward / ahead;
    }
  }
  /// Colours of the corners of a part, as fragmentShader has them.
  shade(part, {axes: {right, up, back}}) {
    const {normals, values, table, look: [ambient, diffuse, specular, power], plain} = part, {seen, red, green, blue} = this;
    const [least, greatest] = part.range, scale = 255 / Math.max(greatest - least, 1e-30);
    const glosses = Float64Array.from({length: 1025}, (_, n) => (n / 1024) ** power);
    const flat = plain ? plain.map(c => 255 * c) : null;
    for (const p of this.cornersOf(part)) {
      const at = 3 * p, nx = normals[at], ny = normals[at + 1], nz = normals[at + 2];
      let x = nx * right[0] + ny * right[1] + nz * right[2], y = nx * up[0] + ny * up[1] + nz * up[2],
          z = nx * back[0] + ny * back[1] + nz * back[2];
      const ex = -seen[at], ey = -seen[at + 1], ez = -seen[at + 2], toEye = 1 / Math.sqrt(ex * ex + ey * ey + ez * ez);
      const unit = (x * ex + y * ey + z * ez < 0 ? -1 : 1) / Math.max(Math.sqrt(x * x + y * y + z * z), 1e-30);
      x *= unit, y *= unit, z *= unit;
      let r = 0, g = 0, b = 0, gr = 0, gg = 0, gb = 0;
      for (const light of lights) {
        const cosine = x * light.x + y * light.y + z * light.z;
        if (cosine <= 0) continue;
        const [tr, tg, tb] = light.tint;
        r += tr * cosine, g += tg * cosine, b += tb * cosine;
        const mirrored = ((2 * cosine * x - light.x) * ex + (2 * cosine * y - light.y) * ey + (2 * cosine * z - light.z) * ez) * toEye;
        if (mirrored <= 0) continue;
        const gloss = glosses[Math.min(1024, Math.round(1024 * mirrored))];
        gr += tr * gloss, gg += tg * gloss, gb += tb * gloss;
      }
      const color = 4 * Math.round(clamp((values[p] - least) * scale, 0, 255)), shine = 255 * specular;
      red[p] = Math.min(255, (flat ? flat[0] : table[color]) * (ambient + diffuse * r) + shine * gr);
      green[p] = Math.min(255, (flat ? flat[1] : table[color + 1]) * (ambient + diffuse * g) + shine * gg);
      blue[p] = Math.min(255, (flat ? flat[2] : table[color + 2]) * (ambient + diffuse * b) + shine * gb);
    }
  }
  /// The pixels whose middles lie in triangles, where nothing nearer is.
  fill({from, to}, {width, height}) {
    const {triangles, x, y, near, red, green, blue, pixels, depths} = this, rim = -1e-5;
    for (let n = from; n < to; n += 3) {
      const a = triangles[n], b = triangles[n + 1], c = triangles[n + 2];
      const ax = x[a], ay = y[a], bx = x[b], by = y[b], cx = x[c], cy = y[c];
      const top = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5)), bottom = Math.min(height - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
      if (top > bottom) continue;
      const first = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5)), last = Math.min(width - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
      const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      if (first > last || area === 0) continue;
      // The shares of b and c in a pixel, and their change from one pixel to the next
      const bByX = (cy - ay) / area, bByY = (ax - cx) / area, cByX = (ay - by) / area, cByY = (bx - ax) / area;
      let rowB = (first + 0.5 - ax) * bByX + (top + 0.5 - ay) * bByY, rowC = (first + 0.5 - ax) * cByX + (top + 0.5 - ay) * cByY;
      const na = near[a], nb = near[b] - na, nc = near[c] - na, ra = red[a] + 0.5, rb = red[b] - red[a], rc = red[c] - red[a];
      const ga = green[a] + 0.5, gb = green[b] - green[a], gc = green[c] - green[a];
      const ba = blue[a] + 0.5, bb = blue[b] - blue[a], bc = blue[c] - blue[a];
      for (let row = top; row <= bottom; ++row, rowB += bByY, rowC += cByY) {
        let ofB = rowB, ofC = rowC, at = row * width + first;
        for (const end = row * width + last; at <= end; ++at, ofB += bByX, ofC += cByX) {
          if (ofB < rim || ofC < rim || ofB + ofC > 1 - rim) continue;
          const depth = na + ofB * nb + ofC * nc;
          if (depth <= depths[at]) continue;
          depths[at] = depth;
          pixels[at] = -16777216 | (ba + ofB * bb + ofC * bc) << 16 | (ga + ofB * gb + ofC * gc) << 8 | (ra + ofB * rb + ofC * rc);
        }
      }
    }
  }
}
