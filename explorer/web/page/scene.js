// The surface of a case: skin and the walls of its cut, as the explorer's (explorer/scene/patch_scene.cpp).
"use strict";

function graded(from, to, first, growth) {
  const length = Math.abs(to - from);
  if (length === 0) return [from];
  const x = [0];
  for (let step = first; x[x.length - 1] < length; step *= growth) x.push(x[x.length - 1] + step);
  const last = x[x.length - 1];
  return x.map(value => from + (to - from) * value / last);
}

class PatchScene {
  constructor(field) {
    const {cut, domain} = field, end = cut.start + cut.length, step = cut.length > 0 ? cut.length / 120
        : (domain[0][1] - domain[0][0]) / 120;
    this.shape = PatchScene.shapeOf(field);
    const us = graded(cut.start, domain[0][0], step, 1.15).reverse();
    for (let i = 1; i <= 120 && cut.length > 0; ++i) us.push(i === 120 ? end : cut.start + i * step);
    us.push(...graded(end, domain[0][1], step, 1.15).slice(1));
    const vs = graded(0, domain[1][0], step, 1.08).reverse();
    vs.push(...graded(0, domain[1][1], step, 1.08).slice(1));
    const wallRows = 12, ws = [0];
    for (let k = 1; k <= wallRows && cut.depth > 0; ++k) ws.push(-cut.depth * k / wallRows);
    this.us = us, this.vs = vs, this.ws = ws;
    this.u = [], this.v = [], this.w = [], this.sides = [];
    const zero = vs.indexOf(0), inside = i => us[i] > cut.start && us[i] < end;
    const add = (i, j, k, side) => {
      this.u.push(i), this.v.push(j), this.w.push(k), this.sides.push(side);
      return this.u.length - 1;
    };
    const skin = [], walls = [];
    this.wallEnds = [];  // of each column: u, and how many numbers of corners there are up to it
    const quad = (to, a, b, c, d) => {
      for (const t of [[a, b, c], [a, c, d]])
        if (t[0] !== t[1] && t[1] !== t[2] && t[2] !== t[0]) to.push(...t);
    };
    let below = null, left = null, right = null;
    vs.forEach((v, j) => {
      const row = us.map((u, i) => add(i, j, 0, Math.sign(v)));
      let upper = row;
      if (j === zero) {
        left = row, right = row.slice();
        us.forEach((u, i) => {
          if (!inside(i)) return;
          this.sides[left[i]] = -1;
          right[i] = add(i, j, 0, 1);
        });
        upper = right;
      }
      if (below) for (let i = 0; i + 1 < us.length; ++i) quad(skin, below[i], below[i + 1], row[i + 1], row[i]);
      below = upper;
    });
    this.skinPoints = this.u.length;
    if (cut.depth > 0 && zero >= 0) {
      let before = null;
      us.forEach((u, i) => {
        if (u < cut.start || u > end) return;
        const l = [left[i]], r = [right[i]];
        for (let k = 1; k <= wallRows; ++k) {
          const open = inside(i) && k < wallRows;
          l.push(add(i, zero, k, open ? -1 : 0));
          r.push(open ? add(i, zero, k, 1) : l[k]);
        }
        for (let k = 0; k < wallRows && before; ++k) {
          quad(walls, before[0][k], l[k], l[k + 1], before[0][k + 1]);
          quad(walls, before[1][k + 1], r[k + 1], r[k], before[1][k]);
        }
        before = [l, r];
        this.wallEnds.push([u, walls.length]);
      });
    }
    const n = this.u.length;
    this.count = n;
    this.skin = Uint32Array.from(skin), this.walls = Uint32Array.from(walls);
    this.rest = new Float64Array(3 * n);
    this.depth = new Float32Array(n);
    for (let p = 0; p < n; ++p) {
      this.rest.set([us[this.u[p]], vs[this.v[p]], ws[this.w[p]]], 3 * p);
      this.depth[p] = cut.depth > 0 ? -ws[this.w[p]] / cut.depth : 0;
    }
    this.middle = [cut.start + cut.length / 2, 0, 0];
    this.displacement = new Float64Array(3 * n);
    this.now = new Int8Array(n);
    // The mirror image of each point across the cut
    const number = new Map();
    const key = (i, j, k, side) => ((i * vs.length + j) * ws.length + k) * 3 + side + 1;
    for (let p = 0; p < n; ++p) number.set(key(this.u[p], this.v[p], this.w[p], this.sides[p]), p);
    this.symmetric = zero >= 0 && vs.every((v, j) => vs[2 * zero - j] !== undefined && Math.abs(vs[2 * zero - j] + v) < 1e-9);
    this.mirror = Int32Array.from(this.u, (i, p) =>
      number.get(key(i, 2 * zero - this.v[p], this.w[p], -this.sides[p])) ?? p);
    for (const name of ["u", "v", "w", "sides"]) this[name] = Int32Array.from(this[name]);
    // Every fourth line along and across: the largest values there are nearly those of all points
    this.few = Int32Array.from(this.u.keys()).filter(p => this.u[p] % 4 === 0 && (this.v[p] - zero) % 4 === 0);
    this.take(field);
  }
  /// What the points depend on; fields that agree in it can be taken by the same scene.
  static shapeOf(field) { return field instanceof MovingMesh ? "mesh" : JSON.stringify([field.domain.slice(0, 3), field.cut]); }
  take(field) {
    this.field = field;
    this.lines = new PlaceLines(field, this.us, this.vs, this.ws);
  }
  /// Displacements of all points, or of some, when t is cut; uncut tissue is closed, whatever the fit is.
  at(t, some) {
    const {field, us, vs} = this, tip = field.cut.start + t;
    // Closed walls are hidden; only their edges would shine through the skin.
    this.openWalls = 0;
    for (const [n, [, count]] of this.wallEnds.entries()) if (n > 0 && this.wallEnds[n - 1][0] < tip) this.openWalls = count;
    for (let n = 0, count = some ? some.length : this.count; n < count; ++n) {
      const p = some ? some[n] : n;
      this.now[p] = us[this.u[p]] >= tip ? Math.sign(vs[this.v[p]]) : this.sides[p];
    }
    field.displacements(this.lines, this.u, this.v, this.w, this.now, t, this.displacement, null, some);
    return this.displacement;
  }
  /// Values to colour by, of the displacements that at() left; of all points, or of some.
  values(coloring, t, out, some) {
    const d = this.displacement, count = some ? some.length : this.count;
    if (coloring === "strain") {
      this.gradients = this.gradients || new Float64Array(9 * this.count);
      this.field.displacements(this.lines, this.u, this.v, this.w, this.now, t, d, this.gradients, some);
    }
    for (let n = 0; n < count; ++n) {
      const p = some ? some[n] : n, m = this.mirror[p];
      if (coloring === "displacement") out[p] = lengthOf(d[3 * p], d[3 * p + 1], d[3 * p + 2]);
      else if (coloring === "strain") out[p] = largestStrain(this.gradients, 9 * p);
      else if (coloring !== "gape" || (this.now[p] === 0 && this.vs[this.v[p]] === 0)) out[p] = 0;
      else out[p] = lengthOf(d[3 * p] - d[3 * m], d[3 * p + 1] - d[3 * m + 1], d[3 * p + 2] - d[3 * m + 2]);
    }
    return out;
  }
  /// Over all times, as the explorer's colours reach; strain has no bound at the ends of the cut, and 1 % of it
  /// is left out.
  largestValue(coloring, out) {
    const {few} = this, {duration} = this.field;
    let largest = 0;
    for (let i = 1; i <= 8; ++i) {
      this.at(duration * i / 8, few);
      this.values(coloring, duration * i / 8, out, few);
      if (coloring === "strain") {
        const found = Float64Array.from(few, p => out[p]).sort();
        largest = Math.max(largest, found[Math.floor(0.99 * (found.length - 1))]);
      } else {
        for (const p of few) if (out[p] > largest) largest = out[p];
      }
    }
    return largest > 0 ? largest : 1;
  }
}

/// Largest eigenvalue of Green's strain (F^T F - I) / 2; gradients of displacement, row by row.
function largestStrain(g, at) {
  const F = [1 + g[at], g[at + 1], g[at + 2], g[at + 3], 1 + g[at + 4], g[at + 5], g[at + 6], g[at + 7], 1 + g[at + 8]];
  const dot = (i, j) => F[i] * F[j] + F[3 + i] * F[3 + j] + F[6 + i] * F[6 + j];
  const a = (dot(0, 0) - 1) / 2, b = (dot(1, 1) - 1) / 2, c = (dot(2, 2) - 1) / 2, d = dot(0, 1) / 2,
        e = dot(1, 2) / 2, f = dot(0, 2) / 2;
  const q = (a + b + c) / 3, p2 = (a - q) ** 2 + (b - q) ** 2 + (c - q) ** 2 + 2 * (d * d + e * e + f * f);
  if (p2 === 0) return q;
  const p = Math.sqrt(p2 / 6), A = (a - q) / p, B = (b - q) / p, C = (c - q) / p, D = d / p, E = e / p, G = f / p;
  const r = (A * (B * C - E * E) - D * (D * C - E * G) + G * (D * E - B * G)) / 2;
  return q + 2 * p * Math.cos(Math.acos(clamp(r, -1, 1)) / 3);
}

/// Opening of the lips at places along the cut, mm: pairs of u and opening.
function openingProfile(field, t, pieces = 150) {
  const {cut} = field, us = [];
  for (let i = 0; i <= pieces; ++i) us.push(cut.start + cut.length * i / pieces);
  const lines = new PlaceLines(field, us, [0], [0]), n = us.length, numbers = us.map((u, i) => i);
  const zeros = new Int32Array(n), left = new Float64Array(3 * n), right = new Float64Array(3 * n);
  field.displacements(lines, numbers, zeros, zeros, zeros.map(() => -1), t, left);
  field.displacements(lines, numbers, zeros, zeros, zeros.map(() => 1), t, right);
  return us.map((u, i) => {
    const open = u > cut.start && u < cut.start + Math.min(t, cut.length);
    return [u, open ? Math.hypot(right[3 * i] - left[3 * i], right[3 * i + 1] - left[3 * i + 1],
                                 right[3 * i + 2] - left[3 * i + 2]) : 0];
  });
}

const widestGape = (shown, t) => Math.max(0, ...shown.profiles(t).flat().map(([, gape]) => gape));
