// A field: bases, parametrisation and control points, and their evaluation (docs/formats.md, "Field").
"use strict";

const clamp = (x, low, high) => x < low ? low : x > high ? high : x;
/// Math.hypot is ten times slower.
const lengthOf = (x, y, z) => Math.sqrt(x * x + y * y + z * z);

/// The functions of a B-spline basis that do not vanish at x, from number `first` on, into values[at ...], and
/// their derivatives into slopes, if given. `left`: the limit from the left at a knot. Piegl and Tiller, The
/// NURBS Book, A2.2.
function evaluateBasis(basis, x, left, values, at, slopes) {
  const {degree, knots} = basis, size = knots.length - degree - 1;
  x = clamp(x, knots[degree], knots[size]);
  let span = degree;
  while (span < size - 1 && (left ? knots[span + 1] < x : knots[span + 1] <= x)) ++span;
  const n = [1, 0, 0, 0], lower = [0, 0, 0, 0];
  for (let j = 1; j <= degree; ++j) {
    if (j === degree) for (let r = 0; r < degree; ++r) lower[r] = n[r];
    let saved = 0;
    for (let r = 0; r < j; ++r) {
      const right = knots[span + r + 1] - x, before = x - knots[span + 1 - j + r];
      const term = n[r] / (right + before);
      n[r] = saved + right * term;
      saved = before * term;
    }
    n[j] = saved;
  }
  for (let r = 0; r < 4; ++r) values[at + r] = r <= degree ? n[r] : 0;
  if (slopes)
    for (let r = 0; r < 4; ++r) {
      const i = span - degree + r;
      const rise = r > 0 && r <= degree ? lower[r - 1] / (knots[i + degree] - knots[i]) : 0;
      const fall = r < degree ? lower[r] / (knots[i + degree + 1] - knots[i + 1]) : 0;
      slopes[at + r] = degree * (rise - fall);
    }
  return span - degree;
}

// How a distance r is measured where knots keep their density over a distance a, and its derivative
const evenMeasure = (r, a) => [r * a / (r + a), a * a / ((r + a) * (r + a))];
const measures = {
  tip: {measured: evenMeasure, beside: r => [r, 1]},
  front: {
    measured(r, a) {
      const b = 0.3 * a, from = 0.02 * a, s = r + from;
      const root = Math.sqrt(s * (s + b)), part = a / (root - Math.sqrt(from * (from + b)) + a);
      return [(root - Math.sqrt(from * (from + b))) * part, part * part * (s + 0.5 * b) / root];
    },
    beside(r, a) {
      const part = 3 * a / (r + 3 * a);
      return [r * part, part * part];
    },
  },
};

function tipAt(tip, t) {
  const {times, positions} = tip, last = times.length - 1;
  if (t <= times[0]) return positions[0];
  if (t >= times[last]) return positions[last];
  let i = 1;
  while (times[i] <= t) ++i;
  return positions[i - 1] + (t - times[i - 1]) * (positions[i] - positions[i - 1]) / (times[i] - times[i - 1]);
}

/// The parameters of the four bases, each as [value, derivative].
class Parametrization {
  constructor(name, geometry) {
    if (name !== "fixed" && !Object.hasOwn(measures, name)) throw new Damaged("an unknown parametrisation");
    this.measure = name === "fixed" ? null : measures[name];
    this.domain = [geometry.domain.u, geometry.domain.v, geometry.domain.w, geometry.domain.t];
    this.cut = geometry.cut;
    this.tip = geometry.tip;
    this.scale = this.cut.depth > 0 ? 3 * this.cut.depth : this.cut.length;
  }
  inside(x, axis) { return clamp(x, this.domain[axis][0], this.domain[axis][1]); }
  along(u, t) {
    if (!this.measure) return [u, 1];
    const [front, back] = this.domain[0], start = this.cut.start, tip = tipAt(this.tip, t), a = this.scale;
    if (u <= start) {
      const l = start - front;
      if (l <= 0) return [1, 0];
      const part = evenMeasure(start - u, a), whole = evenMeasure(l, a)[0];
      return [1 - part[0] / whole, part[1] / whole];
    }
    const {measured} = this.measure;
    if (u < tip) {
      const whole = measured(tip - start, a)[0], fromStart = measured(u - start, a), fromTip = measured(tip - u, a);
      return [1.5 + (fromStart[0] - fromTip[0]) / (2 * whole), (fromStart[1] + fromTip[1]) / (2 * whole)];
    }
    const l = back - tip;
    if (l <= 0) return [2, 0];
    const part = evenMeasure(u - tip, a), whole = evenMeasure(l, a)[0];
    return [2 + part[0] / whole, part[1] / whole];
  }
  across(v) {
    if (!this.measure) return [v, 1];
    const width = v < 0 ? -this.domain[1][0] : this.domain[1][1];
    const part = this.measure.beside(Math.abs(v), this.scale), whole = this.measure.beside(width, this.scale)[0];
    return [(v < 0 ? -1 : 1) * part[0] / whole, part[1] / whole];
  }
  height(w) {
    if (!this.measure) return [w, 1];
    const bottom = this.domain[2][0], depth = this.cut.depth;
    if (depth >= -bottom) return [w / -bottom, 1 / -bottom];
    if (depth > 0 && w > -depth) return [w / depth, 1 / depth];
    const below = -bottom - depth;
    return [-1 + (w + depth) / below, 1 / below];
  }
  time(t) { return this.measure ? t / this.domain[3][1] : t; }
}

const basisSize = basis => basis.knots.length - basis.degree - 1;

function checkedBasis(basis) {
  const {degree, knots} = basis;
  const sound = Number.isInteger(degree) && degree >= 1 && degree <= 3 && Array.isArray(knots) &&
                knots.length >= 2 * degree + 2 && knots.length < 10000 && knots.every(Number.isFinite) &&
                knots.every((knot, i) => i === 0 || knots[i - 1] <= knot);
  if (!sound) throw new Damaged("a basis is no B-spline's");
  return basis;
}

/// For each control point of a row (i, all j, all k) along the cut its unknowns and weights: as ControlTies.
function controlTies(name, bases) {
  const [along, across, height] = bases, U = basisSize(along), V = basisSize(across), W = basisSize(height);
  const interpolating = (basis, knot) => {
    for (let i = 0; i < basisSize(basis); ++i) {
      let all = true;
      for (let k = 1; k <= basis.degree; ++k) all = all && basis.knots[i + k] === knot;
      if (all) return i;
    }
    return -1;
  };
  let openFirst = 0, openLast = U - 1, openFrom = 0;
  if (name !== "fixed") {
    const knots = along.knots;
    openFirst = knots[0] === 1 ? 0 : interpolating(along, 1) + 1;
    openLast = knots[knots.length - 1] === 2 ? U - 1 : interpolating(along, 2) - 1;
    openFrom = height.knots[0] === -1 ? 0 : interpolating(height, -1) + 1;
  }
  const p = across.degree, scratch = [0, 0, 0, 0];
  let right = evaluateBasis(across, 0, false, scratch, 0);
  if (evaluateBasis(across, 0, true, scratch, 0) + p >= right) right = -1;
  let ofLeft = 0, ofRight = 0;
  if (right > 0) {
    const before = across.knots[right] - across.knots[right - 1];
    const after = across.knots[right + p + 1] - across.knots[right + p];
    ofLeft = after / (before + after);
    ofRight = before / (before + after);
  }
  const pattern = closed => {
    const kind = k => right < 0 ? "open" : closed || k < openFrom - 1 ? "closed" : k < openFrom ? "bottom" : "open";
    const numbers = new Int32Array(V * W).fill(-1), controls = [];
    let size = 0;
    for (let j = 0; j < V; ++j)
      for (let k = 0; k < W; ++k)
        if ((j !== right && j !== right - 1) || kind(k) === "open" || (kind(k) === "bottom" && j === right - 1))
          numbers[j * W + k] = size++;
    for (let j = 0; j < V; ++j)
      for (let k = 0; k < W; ++k) {
        const itself = numbers[j * W + k] >= 0 ? numbers[j * W + k] : numbers[(right - 1) * W + k];
        controls.push(itself >= 0 ? [itself, 1]
                                  : [numbers[(right - 2) * W + k], ofLeft, numbers[(right + 1) * W + k], ofRight]);
      }
    return {controls, size};
  };
  const patterns = [pattern(false), pattern(true)], rows = [];
  let first = 0;
  for (let i = 0; i < U; ++i) {
    const one = patterns[i >= openFirst && i <= openLast ? 0 : 1];
    rows.push({first, controls: one.controls});
    first += one.size;
  }
  const unknown = [], placed = new Uint8Array(first);
  for (const row of rows)
    for (const control of row.controls) {
      const number = row.first + control[0], own = control.length === 2 && !placed[number];
      unknown.push(own ? number : -1);
      if (own) placed[number] = 1;
    }
  return {rows, grid: {along: U, across: V, height: W, unknown: Int32Array.from(unknown), unknowns: first}};
}

/// Control points [(((i V + j) W + k) T + l) 3 + c], mm, of the bytes of a case.
function controlPoints(header, bytes) {
  if (header.quantum) return new CodedPoints(header, bytes).controlPoints(header.quantum);
  const numbers = 3 * pointsOf(basesOf(header));
  if (bytes.length !== 4 * numbers) throw new Damaged("the coefficients do not fit to the bases");
  const plain = new Uint8Array(bytes.length);
  for (let n = 0; n < numbers; ++n)
    for (let byte = 0; byte < 4; ++byte) plain[4 * n + byte] = bytes[byte * numbers + n];
  const view = new DataView(plain.buffer);
  return Float64Array.from({length: numbers}, (_, n) => view.getFloat32(4 * n, true));
}

const basesOf = header => ["along", "across", "height", "time"].map(axis => checkedBasis(header.bases[axis]));
function pointsOf(bases) {
  const count = bases.reduce((product, basis) => product * basisSize(basis), 1);
  if (!(count < 5e6)) throw new Damaged("more control points than a field may have");
  return count;
}

/// The unknowns of control points, as multiples of a step.
class CodedPoints {
  constructor(header, bytes, values) {
    this.bases = basesOf(header);
    this.slices = header.slices;
    this.count = pointsOf(this.bases);
    const T = basisSize(this.bases[3]), {slices} = this;
    if (slices !== T && slices !== T - 1) throw new Damaged("the slices do not fit to the basis in time");
    Object.assign(this, controlTies(header.parametrization, this.bases));
    this.values = values || decodeCoefficients(this.grid, slices, bytes);
    if (this.values.length !== 3 * slices * this.grid.unknowns) throw new Damaged("the modes do not fit to a case");
  }
  controlPoints(quantum) {
    const {rows, grid, slices, values, bases} = this, T = basisSize(bases[3]), N = grid.unknowns, skipped = T - slices;
    const points = new Float64Array(3 * this.count);
    let at = 0;
    for (const row of rows)
      for (const control of row.controls) {
        for (let term = 0; term < control.length; term += 2) {
          const number = row.first + control[term], weight = control[term + 1] * quantum;
          for (let c = 0; c < 3; ++c)
            for (let l = 0; l < slices; ++l) points[at + 3 * (l + skipped) + c] += weight * values[(c * slices + l) * N + number];
        }
        at += 3 * T;
      }
    return points;
  }
}

/// Control points of a case that is a sum of modes; the unknowns of these, mm, over the largest displacement.
function sumOfModes(header, modes) {
  const {weights} = header.modes, largest = header.report.largest_displacement;
  if (!Array.isArray(weights) || weights.length !== modes.length) throw new Damaged("a case has not as many weights as there are modes");
  const sum = new Float64Array(modes.length ? modes[0].length : 0);
  modes.forEach((mode, k) => {
    for (let n = 0; n < sum.length; ++n) sum[n] += weights[k] * largest * mode[n];
  });
  return new CodedPoints(header, null, sum).controlPoints(1);
}

class Field {
  constructor(header, points) {
    this.bases = basesOf(header);
    this.sizes = this.bases.map(basisSize);
    this.parametrization = new Parametrization(header.parametrization, header);
    this.cut = header.cut;
    this.domain = this.parametrization.domain;
    this.duration = this.domain[3][1];
    this.points = points;
    this.breaks = this.cut.length > 0;
    this.time = NaN;
  }
  profiles(t) { return this.breaks ? [openingProfile(this, t)] : []; }
  /// Sums over the basis in time.
  collapse(t) {
    if (t === this.time) return;
    this.time = t;
    const [U, V, W, T] = this.sizes, rows = U * V * W, weights = [0, 0, 0, 0];
    const first = evaluateBasis(this.bases[3], this.parametrization.time(this.parametrization.inside(t, 3)), false,
                                weights, 0);
    // Rows of four functions are read in full: there are as many zeros behind the last.
    this.grid = this.grid || new Float64Array(3 * (rows + 4 * (V * W + W + 1)));
    const {grid, points} = this, terms = this.bases[3].degree + 1;
    for (let row = 0; row < rows; ++row) {
      let x = 0, y = 0, z = 0;
      for (let l = 0, from = 3 * (row * T + first); l < terms; ++l, from += 3) {
        const weight = weights[l];
        x += weight * points[from];
        y += weight * points[from + 1];
        z += weight * points[from + 2];
      }
      grid[3 * row] = x, grid[3 * row + 1] = y, grid[3 * row + 2] = z;
    }
  }
  /// Displacement at a place, mm; side -1 left, 1 right, 0 by the sign of v (on v = 0 the mean of both).
  displacement(u, v, w, side, t) {
    const lines = new PlaceLines(this, [u], [v], [w]);
    const out = new Float64Array(3);
    this.displacements(lines, [0], [0], [0], [side], t, out);
    return out;
  }
  /// Displacements of places that lie on lines of a grid: numbers of u, v and w among those of `lines`.
  /// `some`: only of these. Gradients, where they are given, get the derivatives, row by row.
  displacements(lines, us, vs, ws, sides, t, out, gradients, some) {
    this.collapse(t);
    lines.at(t, Boolean(gradients));
    const [U, V] = this.sizes, {along, across, height} = lines;
    const one = (n, iv, share, by, target) => {
      const iu = us[n];
      const a = (by === 0 ? along.slope : along.value), b = (by === 1 ? across.slope : across.value),
            plane = (by === 2 ? height.slopePlanes : height.planes);
      const b0 = b[4 * iv], b1 = b[4 * iv + 1], b2 = b[4 * iv + 2], b3 = b[4 * iv + 3];
      let x = 0, y = 0, z = 0;
      for (let i = 0, at = 3 * ((ws[n] * U + along.first[iu]) * V + across.first[iv]); i < 4; ++i, at += 3 * V) {
        const wi = share * a[4 * iu + i];
        if (wi === 0) continue;
        x += wi * (b0 * plane[at] + b1 * plane[at + 3] + b2 * plane[at + 6] + b3 * plane[at + 9]);
        y += wi * (b0 * plane[at + 1] + b1 * plane[at + 4] + b2 * plane[at + 7] + b3 * plane[at + 10]);
        z += wi * (b0 * plane[at + 2] + b1 * plane[at + 5] + b2 * plane[at + 8] + b3 * plane[at + 11]);
      }
      target[0] += x, target[1] += y, target[2] += z;
    };
    const sum = [0, 0, 0];
    const count = some ? some.length : us.length;
    for (let number = 0; number < count; ++number)
      for (let n = some ? some[number] : number, by = -1; by < (gradients ? 3 : 0); ++by) {
        sum[0] = sum[1] = sum[2] = 0;
        const v = 3 * vs[n];  // limits from the left, from the right
        if (!lines.broken[vs[n]]) one(n, v, 1, by, sum);
        else if (sides[n] < 0) one(n, v + 1, 1, by, sum);
        else if (sides[n] > 0) one(n, v, 1, by, sum);
        else one(n, v + 1, 0.5, by, sum), one(n, v, 0.5, by, sum);
        if (by < 0) out[3 * n] = sum[0], out[3 * n + 1] = sum[1], out[3 * n + 2] = sum[2];
        else for (let c = 0; c < 3; ++c) gradients[9 * n + 3 * c + by] = sum[c];
      }
  }
}

/// The values of a field's bases at lists of u, v and w, and for each w the control points summed over the basis along
/// it, so that a place needs 16 terms.
class PlaceLines {
  constructor(field, us, vs, ws) {
    this.field = field;
    this.us = us;
    this.time = NaN;
    const table = n => ({first: new Int32Array(n), value: new Float64Array(4 * n), slope: new Float64Array(4 * n)});
    this.along = table(us.length);
    this.across = table(3 * vs.length);
    this.height = table(ws.length);
    this.broken = vs.map(v => field.breaks && v === 0);
    const {parametrization, bases} = field;
    this.fill = (to, n, basis, [x, slope], left) => {
      to.first[n] = evaluateBasis(basis, x, left, to.value, 4 * n, to.slope);
      for (let i = 0; i < 4; ++i) to.slope[4 * n + i] *= slope;
    };
    vs.forEach((v, n) => {
      const place = parametrization.across(parametrization.inside(v, 1));
      this.fill(this.across, 3 * n, bases[1], place, false);
      if (this.broken[n]) {
        const left = parametrization.across(-1e-300);
        this.fill(this.across, 3 * n + 1, bases[1], [0, left[1]], true);
      }
    });
    ws.forEach((w, n) => this.fill(this.height, n, bases[2], parametrization.height(parametrization.inside(w, 2)), false));
  }
  at(t, slopes) {
    if (t === this.time && (!slopes || this.sloping)) return;
    this.time = t, this.sloping = slopes;
    this.height.planes = this.planesOf(this.height.value, this.height.planes);
    if (slopes) this.height.slopePlanes = this.planesOf(this.height.slope, this.height.slopePlanes);
    const {parametrization, bases} = this.field, time = parametrization.inside(t, 3);
    this.us.forEach((u, n) =>
      this.fill(this.along, n, bases[0], parametrization.along(parametrization.inside(u, 0), time), false));
  }
  planesOf(weights, planes) {
    const {first} = this.height, {grid, sizes: [U, V, W]} = this.field, rows = U * V;
    // Rows of four functions are read in full: there are as many zeros behind the last.
    planes = planes || new Float64Array(3 * (first.length * rows + 4 * (V + 1)));
    for (let n = 0, to = 0; n < first.length; ++n) {
      const c0 = weights[4 * n], c1 = weights[4 * n + 1], c2 = weights[4 * n + 2], c3 = weights[4 * n + 3];
      for (let row = 0; row < rows; ++row, to += 3) {
        const at = 3 * (row * W + first[n]);
        for (let c = 0; c < 3; ++c)
          planes[to + c] = c0 * grid[at + c] + c1 * grid[at + 3 + c] + c2 * grid[at + 6 + c] + c3 * grid[at + 9 + c];
      }
    }
    return planes;
  }
}
