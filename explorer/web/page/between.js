// Fields between the cases of a study: encoder/interpolate, whose models came as numbers (docs/formats.md).
"use strict";

const dotOf = (a, b) => {
  let sum = 0;
  for (let n = 0; n < a.length; ++n) sum += a[n] * b[n];
  return sum;
};

function addMultiple(sum, size, numbers) {
  for (let n = 0; n < sum.length; ++n) sum[n] += size * numbers[n];
}

/// Weights of the rows of a regression by kernels (Covariance and KernelRegression).
class Regression {
  constructor(data) {
    Object.assign(this, data);
    const none = this.features.length ? this.features[0].map(() => 0) : [];
    this.rows = this.features.map((x, i) => ({x, load: this.loads[i], slope: false, dx: none}));
    this.slopes.of.forEach((of, n) => this.rows.push({x: this.features[of], load: this.loads[of], slope: true,
                                                      dx: this.slopes.features[n], dload: this.slopes.loads[n]}));
    const m = this.rows.length;
    this.size = m;
    this.matrix = new Float64Array(m * m);
    for (let i = 0; i < m; ++i)
      for (let j = 0; j <= i; ++j) this.matrix[i * m + j] = this.matrix[j * m + i] = this.covariance(this.rows[i], this.rows[j]);
    this.added = this.rows.map((row, i) => row.slope ? this.nuggets[i - this.features.length] : this.nugget);
    this.factorise();
  }
  /// The kernel of two places.
  value(x, y) {
    const {degree, trend, correlation, lengths} = this;
    let s = 1, squared = 0;
    for (let n = 0; n < x.length; ++n) s += x[n] * y[n];
    const straight = trend * s ** degree;
    if (correlation === "none") return straight;
    for (let n = 0; n < x.length; ++n) squared += ((x[n] - y[n]) / lengths[n]) ** 2;
    if (correlation === "gaussian") return straight + Math.exp(-0.5 * squared);
    const r = Math.sqrt(5 * squared);
    return straight + (1 + r + r * r / 3) * Math.exp(-r);
  }
  /// The same, its derivative as y moves along dy, as x moves along dx, and as both do.
  kernel(x, dx, y, dy) {
    const {degree, trend, correlation, lengths} = this;
    const s = 1 + dotOf(x, y), first = trend * degree * s ** (degree - 1),
          second = degree > 1 ? trend * degree * (degree - 1) * s ** (degree - 2) : 0;
    const byX = dotOf(y, dx), byY = dotOf(x, dy);
    const jet = [trend * s ** degree, first * byX, first * byY, second * byX * byY + first * dotOf(dx, dy)];
    if (correlation === "none") return jet;
    let squared = 0, zu = 0, zv = 0, uv = 0;
    for (let n = 0; n < x.length; ++n) {
      const z = (x[n] - y[n]) / lengths[n], u = dx[n] / lengths[n], v = dy[n] / lengths[n];
      squared += z * z, zu += z * u, zv += z * v, uv += u * v;
    }
    if (correlation === "gaussian") {
      const e = Math.exp(-0.5 * squared);
      return [jet[0] + e, jet[1] - e * zu, jet[2] + e * zv, jet[3] + e * (uv - zu * zv)];
    }
    const r = Math.sqrt(5 * squared), e = Math.exp(-r), slope = 5 / 3 * (1 + r) * e;
    return [jet[0] + (1 + r + r * r / 3) * e, jet[1] - slope * zu, jet[2] + slope * zv, jet[3] + slope * uv - 25 / 3 * e * zu * zv];
  }
  covariance(a, b) {
    const loads = dotOf(a.load, b.load);
    if (!a.slope && !b.slope) return loads * this.value(a.x, b.x);
    const k = this.kernel(a.x, a.dx, b.x, b.dx);
    if (a.slope && b.slope)
      return dotOf(a.dload, b.dload) * k[0] + dotOf(a.dload, b.load) * k[2] + dotOf(a.load, b.dload) * k[1] + loads * k[3];
    return a.slope ? dotOf(a.dload, b.load) * k[0] + loads * k[1] : dotOf(a.load, b.dload) * k[0] + loads * k[2];
  }
  /// L D L^T of the matrix with its nuggets.
  factorise() {
    const m = this.size, L = this.matrix.slice(), D = new Float64Array(m), scaled = new Float64Array(m);
    for (let i = 0; i < m; ++i) L[i * m + i] += this.added[i];
    for (let i = 0; i < m; ++i) {
      const row = i * m;
      for (let j = 0; j < i; ++j) {
        let sum = L[row + j];
        for (let k = 0, other = j * m; k < j; ++k) sum -= scaled[k] * L[other + k];
        scaled[j] = sum;
        L[row + j] = sum / D[j];
      }
      let sum = L[row + i];
      for (let k = 0; k < i; ++k) sum -= scaled[k] * L[row + k];
      D[i] = sum;
    }
    this.L = L, this.D = D;
  }
  solve(right) {
    const {size: m, L, D} = this, x = Float64Array.from(right);
    for (let i = 0; i < m; ++i) {
      let sum = x[i];
      for (let k = 0, at = i * m; k < i; ++k) sum -= L[at + k] * x[k];
      x[i] = sum;
    }
    for (let i = 0; i < m; ++i) x[i] /= D[i];
    for (let i = m - 1; i >= 0; --i) {
      const known = x[i];
      for (let k = 0, at = i * m; k < i; ++k) x[k] -= L[at + k] * known;
    }
    return x;
  }
  /// Weights of the rows, and the deviation of the prediction.
  at(x, load) {
    const m = this.size, wanted = {x, load, slope: false, dx: x.map(() => 0)};
    const k = Float64Array.from(this.rows, row => this.covariance(row, wanted)), weights = this.solve(k);
    let variance = dotOf(load, load) * this.value(x, x) - 2 * dotOf(k, weights);
    for (let i = 0; i < m; ++i) {
      let sum = (this.added[i] + this.matrix[i * m + i]) * weights[i];
      for (let j = 0, at = i * m; j < i; ++j) sum += 2 * this.matrix[at + j] * weights[j];  // it is symmetric
      variance += weights[i] * sum;
    }
    return {weights, deviation: Math.sqrt(Math.max(variance, 0) + this.nugget)};
  }
}

/// Weights of cases and derivatives at parameters, and the estimated error, mm (DisplacementModel).
class DisplacementModel {
  constructor(data) {
    Object.assign(this, data);
    this.regression = new Regression(data.regression);
    if (data.plain)
      this.plain = {...data.plain, regression: new Regression(data.plain.regression), chosen: new Regression(data.plain.chosen)};
  }
  place(parameters) {
    const product = names => names.reduce((value, name) => value * parameters[name], 1);
    return this.features.ratios.map(({over, under, logarithm, middle, half}) => {
      const value = product(over) / product(under);
      return ((logarithm ? Math.log(Math.max(value, 1e-300)) : value) - middle) / half;
    });
  }
  load(parameters) {
    if (!this.features.loads.length) return [1];
    const q = this.features.loads.map(name => parameters[name]), norm = Math.hypot(...q);
    return norm > 0 ? q.map(x => x / norm) : q;
  }
  scale(parameters) {
    const {scale} = this.features;
    if (!scale) return 1;
    return parameters[scale.thickness] * Math.hypot(...scale.prestress.map(name => parameters[name])) / parameters[scale.modulus];
  }
  at(parameters, derivatives) {
    const place = this.place(parameters), load = this.load(parameters), plain = this.scale(parameters);
    const scale = plain * Math.exp(dotOf(this.exponents, place));
    const {weights, deviation} = this.regression.at(place, load), n = this.scales.length;
    const ofCases = Float64Array.from(this.scales, (own, i) => scale * weights[i] / own);
    const ofDerivatives = new Float64Array(derivatives);
    this.ways.forEach(({derivative, of, log_scale: logScale, size}, w) => {
      const weight = scale * weights[n + w] / (this.scales[of] * size);
      ofDerivatives[derivative] += weight;
      ofCases[of] -= weight * logScale;
    });
    let error = scale * this.error_of_deviation * deviation;
    if (this.plain) {
      const chosen = this.plain.chosen.at(place, load).weights;
      const straight = this.plain.regression.at(place, load).weights.map((weight, i) => plain * weight / this.plain.scales[i]);
      const {data, samples} = this.plain;
      let farthest = 0;
      for (let row = 0; row + 2 < data.length; row += 3) {
        let squared = 0;
        for (let c = row; c < row + 3; ++c) squared += (scale * dotOf(data[c], chosen) - dotOf(samples[c], straight)) ** 2;
        farthest = Math.max(farthest, squared);
      }
      error = Math.hypot(error, Math.sqrt(farthest));
    }
    return {cases: ofCases, derivatives: ofDerivatives, error};
  }
}

/// The body and its cut at parameters (GeometryModel).
function geometryAt(model, parameters) {
  const measures = model.constant.slice();
  if (model.names) {
    const place = model.names.map((name, k) => (parameters[name] - model.middle[k]) / model.half[k]);
    const near = model.places.map(own => 1 / (own.reduce((sum, x, k) => sum + (x - place[k]) ** 2, 0) + 1e-24) ** 2);
    const whole = near.reduce((sum, x) => sum + x, 0), row = [1, ...model.measured_by.map(k => place[k])];
    let at = 0;
    measures.forEach((value, k) => {
      if (value !== null) return;
      measures[k] = row.reduce((sum, x, r) => sum + x * model.linear[r][at], 0) +
                    near.reduce((sum, x, i) => sum + x * model.left[i][at], 0) / whole;
      ++at;
    });
  }
  const domain = {u: measures.slice(0, 2), v: measures.slice(2, 4), w: measures.slice(4, 6), t: measures.slice(6, 8)};
  const cut = {start: measures[8], length: measures[9], depth: measures[10]};
  const [front, back] = domain.t, unit = cut.length > 0 ? cut.length : 1, tip = {times: [], positions: []};
  model.times.forEach((time, k) => {
    const position = cut.start + measures[11 + k] * unit;
    tip.times.push(k + 1 === model.times.length && time === 1 ? back : front + time * (back - front));
    tip.positions.push(k === 0 ? position : Math.max(position, tip.positions[k - 1]));
  });
  return {domain, cut, tip};
}

/// Bases of a body of this geometry, of those in parameters that all bodies share (CommonCases::bases_in).
function basesIn(bases, parametrization, {domain, cut}) {
  if (parametrization !== "fixed") return bases;
  const own = {};
  ["along", "across", "height", "time"].forEach((name, axis) => {
    const [front, back] = domain["uvwt"[axis]];
    const place = axis === 1 && cut.length > 0 ? x => x === -1 ? front : x === 1 ? back : x * (x < 0 ? -front : back)
                                               : x => x === 1 ? back : front + x * (back - front);
    own[name] = {degree: bases[name].degree, knots: bases[name].knots.map(place)};
  });
  return own;
}

/// A study's cases as sums of modes, and what lies between them.
class BetweenCases {
  constructor(data, coded) {
    this.data = data;
    this.coded = coded;
    this.modes = [];
    if (!data.modes) return;
    const {bytes} = data.modes;
    this.starts = [0];
    for (const count of bytes) this.starts.push(this.starts[this.starts.length - 1] + base64Size(count));
    if (this.starts[bytes.length] !== coded.length) throw new Damaged("modes are missing");
    this.columns = data.fit_errors.length + data.derivative_errors.length;
    if (bytes[0] !== 4 * this.columns * (bytes.length - 1)) throw new Damaged("the shares of the modes do not fit");
  }
  piece(k) { return bytesOf(this.coded.slice(this.starts[k], this.starts[k + 1])); }
  /// Does a part of what takes long, some 30 ms; returns whether nothing is left to do.
  prepare() {
    const {data, modes} = this, count = data.modes ? data.modes.bytes.length - 1 : 0;
    if (!this.groups) {
      this.groups = data.groups.map(group => ({...group, model: new DisplacementModel(group.model)}));
      if (count === 0) return true;
      const shares = new DataView(this.piece(0).buffer);
      this.shares = Float32Array.from({length: count * this.columns}, (_, n) => shares.getFloat32(4 * n, true));
    } else if (modes.length < count) {
      const k = modes.length, header = {parametrization: data.parametrization, bases: data.bases, slices: data.modes.slices[k],
                                        quantum: data.modes.quantum};
      modes.push(Float32Array.from(controlPoints(header, this.piece(k + 1))));
    }
    return modes.length === count;
  }
  complete(values) {
    const {parameters, base} = this.data, all = {...parameters};
    for (const {name} of this.data.varying) if (name in values) all[name] = values[name];
    if ("patch.on_bone" in base && "patch.height" in base)
      all["patch.on_bone"] = all["patch.height"] === base["patch.height"] ? 0 : 1;
    return all;
  }
  /// The parameters with base values of all but those of the group.
  variedIn(names, parameters) {
    const varied = {...parameters};
    for (const [name, value] of Object.entries(this.data.base)) if (!names.includes(name)) varied[name] = value;
    return varied;
  }
  /// Whether skin under these prestresses would be compressed in some direction, which a membrane does not carry.
  compressed(values) {
    const {scale} = this.data.groups[0].model.features, all = this.complete(values);
    if (!scale) return false;
    const [u, v, uv] = scale.prestress.map(name => all[name]);
    return u < 0 || v < 0 || u * v < uv * uv;
  }
  prediction(parameters) {
    const derivatives = this.data.derivative_errors.length, [together, ...alone] = this.groups;
    if (!alone.length) return together.model.at(parameters, derivatives);
    const sum = {cases: new Float64Array(this.data.fit_errors.length), derivatives: new Float64Array(derivatives)};
    const add = (group, {cases}, sign) => group.cases.forEach((i, k) => sum.cases[i] += sign * cases[k]);
    const first = together.model.at(this.variedIn(together.names, parameters), 0), base = this.variedIn([], parameters);
    add(together, first, 1);
    let squares = first.error ** 2;
    for (const group of alone) {
      const varied = this.variedIn(group.names, parameters);
      if (Object.keys(base).every(name => base[name] === varied[name])) continue;
      const changed = group.model.at(varied, 0);
      add(group, changed, 1), add(group, group.model.at(base, 0), -1);
      squares += changed.error ** 2;
    }
    return {...sum, error: Math.sqrt(squares)};
  }
  /// At the values of the parameters that vary: weights of cases and derivatives, and errorOf(largest displacement),
  /// the estimated error over that.
  predictionAt(values) {
    while (!this.prepare());
    const {data} = this, prediction = this.prediction(this.complete(values));
    const weights = [...prediction.cases, ...prediction.derivatives], errors = [...data.fit_errors, ...data.derivative_errors];
    const ofFits = Math.sqrt(weights.reduce((sum, weight, i) => sum + (weight * errors[i]) ** 2, 0));
    const errorOf = largest => largest > 0
      ? Math.hypot(prediction.error / largest, Math.max(data.fit_error, ofFits / largest), data.modes ? data.modes.error : 0) : 0;
    return {cases: prediction.cases, weights, errorOf};
  }
  /// The field at these values, which is valid until the next, and errorOf().
  at(values) {
    const {weights, errorOf} = this.predictionAt(values), {data, modes, shares, columns} = this, parameters = this.complete(values);
    const points = this.points = this.points || new Float64Array(modes.length ? modes[0].length : 0);
    points.fill(0);
    modes.forEach((mode, k) => {
      let size = 0;
      for (let i = 0, at = k * columns; i < columns; ++i) size += shares[at + i] * weights[i];
      addMultiple(points, size, mode);
    });
    const geometry = geometryAt(data.geometry, parameters);
    const field = new Field({parametrization: data.parametrization, bases: basesIn(data.bases, data.parametrization, geometry), ...geometry}, points);
    return {field, errorOf};
  }
}
