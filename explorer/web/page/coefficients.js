// The decoder of a field's coefficients: docs/formats.md, "The code of the integers". All numbers are integers
// below 2^53; where they may exceed 2^31, a shift is a division rounded down.
"use strict";

const codeTables = (() => {
  const stretch = new Int16Array(4096), squash = new Int32Array(6143), rate = new Int32Array(1024);
  for (let p = 0; p < 4096; ++p) stretch[p] = Math.round(256 * Math.log((p + 0.5) / (4095.5 - p)));
  for (let x = -3071; x <= 3071; ++x)
    squash[x + 3071] = Math.min(65532, Math.max(4, Math.round(65536 / (1 + Math.exp(-x / 256)))));
  for (let n = 0; n < 1024; ++n) rate[n] = Math.floor(655360 / (10 * n + 16));
  const logistic = new Int16Array(28 * 17 * 8);
  let at = 0;
  for (let level = 0; level < 28; ++level) {
    const scale = 0.7 / 256 * (4 + level % 4 + 0.5) * 2 ** (Math.floor(level / 4) + 1);
    const below = x => 1 / (1 + Math.exp(-x / scale));
    const part = (x, y) => Math.exp((x - y) / scale) * (1 + Math.exp(y / scale)) / (1 + Math.exp(x / scale));
    for (let offset = 0; offset < 17; ++offset) {
      const f = offset / 32, under = -0.5 - f, over = f - 0.5;
      const p = [below(under) + below(over), 1 / (1 + part(over, under))];
      for (let tail = 0; tail < 3; ++tail) p.push(part(over - tail - 1, over - tail));
      for (let tail = 0; tail < 3; ++tail) p.push(part(under - tail - 1, under - tail));
      for (const x of p) logistic[at++] = Math.round(256 * Math.min(9, Math.max(-9, Math.log(x / (1 - x)))));
    }
  }
  return {stretch, squash, rate, logistic};
})();

class Damaged extends Error {}

/// In which order slices are coded, and which of them are known then; -1: the closed state or none, -2: none.
function sliceOrder(slices) {
  const order = [], known = new Array(slices).fill(false);
  const add = slice => {
    let before = slice - 1, after = slice + 1, beforeThat = -2, afterThat = -2;
    while (before >= 0 && !known[before]) --before;
    while (after < slices && !known[after]) ++after;
    if (before >= 0) {
      beforeThat = before - 1;
      while (beforeThat >= 0 && !known[beforeThat]) --beforeThat;
    }
    if (after >= slices) {
      after = -1;
    } else {
      afterThat = after + 1;
      while (afterThat < slices && !known[afterThat]) ++afterThat;
      if (afterThat >= slices) afterThat = -2;
    }
    known[slice] = true;
    order.push({slice, before, after, beforeThat, afterThat});
  };
  if (slices > 0) add(slices - 1);
  const spans = [[-1, slices - 1]];
  for (let n = 0; n < spans.length; ++n) {
    const [from, to] = spans[n];
    if (to - from < 2) continue;
    const middle = (from + to + 1) >> 1;
    add(middle);
    spans.push([from, middle], [middle, to]);
  }
  return order;
}

/// `grid`: along, across, height, unknown (of place (i across + j) height + k; -1: none), unknowns. The result
/// is numbered (component * slices + slice) * unknowns + unknown. Throws Damaged.
function decodeCoefficients(grid, slices, bytes) {
  const {stretch, squash, rate, logistic} = codeTables;
  const U = grid.along, V = grid.across, W = grid.height, N = grid.unknowns;
  const width = [V >> 1, V - (V >> 1)];
  const B = W + 3, A = (width[1] + 3) * B, size = (U + 3) * A;
  const largest = 2 ** 40, most = 268435456;
  const values = new Float64Array(3 * slices * N);

  let at = 0, beyond = 0, range = 4294967295, code = 0;
  const next = () => {
    if (at < bytes.length) return bytes[at++];
    if (++beyond > 4) throw new Damaged("coded numbers end too early");
    return 0;
  };
  for (let i = 0; i < 4; ++i) code = ((code << 8) | next()) >>> 0;
  const bit = p => {
    const part = (range >>> 16) * p;
    let value = 0;
    if (code < part) {
      range = part;
      value = 1;
    } else {
      code -= part;
      range -= part;
    }
    while (range < 16777216) {
      code = ((code << 8) | next()) >>> 0;
      range = (range << 8) >>> 0;
    }
    return value;
  };
  const plain = () => {
    let digits = 0;
    while (bit(32768))
      if (++digits > 48) throw new Damaged("a coded number is too large");
    let read = 1;
    for (let i = 0; i < digits; ++i) read = 2 * read + bit(32768);
    return read - 1;
  };
  const limited = x => x < -most ? -most : x > most ? most : x;
  const logLevel = x => {
    const below = 29 - Math.clz32(x);
    return 4 * below + 4 + (x >> below);
  };
  const scaleLevel = x => logLevel(x + 5) - 9;

  // The unknowns of both halves in the order of coding
  const places = [0, 1].map(half => {
    const list = {at: [], unknown: [], across: [], twin: []};
    for (let i = 0; i < U; ++i)
      for (let j = 0; j < width[half]; ++j)
        for (let k = 0; k < W; ++k) {
          const column = half === 0 ? j : V - 1 - j, unknown = grid.unknown[(i * V + column) * W + k];
          if (unknown < 0) continue;
          list.at.push((i + 2) * A + (j + 2) * B + k + 2);
          list.unknown.push(unknown);
          list.across.push(j);
          list.twin.push(half === 0 || j < width[0] ? grid.unknown[(i * V + V - 1 - column) * W + k] : -1);
        }
    for (const name in list) list[name] = Int32Array.from(list[name]);
    return list;
  });
  const channel = () => ({
    innovation: new Int32Array(size), error: new Int32Array(size).fill(77),
    earlier: new Int32Array(size).fill(77), residual: new Int8Array(size).fill(2),
  });
  const channels = [0, 1].map(() => [channel(), channel(), channel()]);
  const nothing = new Int32Array(size), closed = new Float64Array(N);
  const firstP = new Int32Array(12 * 12 * 5 * 16).fill(32768), firstSeen = new Int32Array(firstP.length);
  const secondP = new Int32Array(125 * 8 * 16).fill(32768), secondSeen = new Int32Array(secondP.length);
  const mixers = new Int32Array(256 * 3);
  for (let n = 0; n < 256; ++n) mixers.set([13107, 13107, 39322], 3 * n);
  // Weights: by half, whether slices follow, and column across; the last is of all places
  const rows = width[1] + 1, weights = new Int32Array(2 * 2 * rows * 16);
  for (let half = 0; half < 2; ++half)
    for (let first = 0; first < 2; ++first)
      for (let row = 0; row < rows; ++row) {
        const w = ((half * 2 + first) * rows + row) * 16;
        for (const direct of [3, 6, 7]) weights[w + direct] = first ? 11469 : 5734;
        for (const diagonal of [1, 2, 4]) weights[w + diagonal] = first ? -6554 : -1638;
        if (first) weights[w] = 3277;
      }
  const differsP = [32768, 32768, 32768], differsSeen = [0, 0, 0];

  let firsts = 0, seconds = 0, selected = 0, opinion = 0;
  const decide = (decision, kind) => {
    const a = firsts + decision, b = seconds + decision, m = 3 * (selected + 16 * decision);
    const pa = firstP[a], pb = secondP[b];
    const oa = stretch[pa >> 4], ob = stretch[pb >> 4], oc = logistic[opinion + kind];
    const sum = Math.floor((mixers[m] * oa + mixers[m + 1] * ob + mixers[m + 2] * oc) / 65536);
    const p = squash[(sum < -3071 ? -3071 : sum > 3071 ? 3071 : sum) + 3071];
    const value = bit(p);
    const error = 5 * ((value << 16) - p);
    const w0 = mixers[m] + ((error * oa + 32768) >> 16), w1 = mixers[m + 1] + ((error * ob + 32768) >> 16),
          w2 = mixers[m + 2] + ((error * oc + 32768) >> 16);
    mixers[m] = w0 < -1048576 ? -1048576 : w0 > 1048576 ? 1048576 : w0;
    mixers[m + 1] = w1 < -1048576 ? -1048576 : w1 > 1048576 ? 1048576 : w1;
    mixers[m + 2] = w2 < -1048576 ? -1048576 : w2 > 1048576 ? 1048576 : w2;
    const target = value ? 65535 : 0;
    firstP[a] = pa + Math.floor((target - pa) * rate[firstSeen[a]] / 65536);
    secondP[b] = pb + Math.floor((target - pb) * rate[secondSeen[b]] / 65536);
    if (firstSeen[a] < 255) ++firstSeen[a];
    if (secondSeen[b] < 255) ++secondSeen[b];
    return value;
  };
  /// The distance of the value from the integer that is nearest to the prediction
  const distance = coarse => {
    let bin = 0;
    if (decide(0, 0)) {
      const negative = decide(1, 1);
      let more = 0;
      while (more < 20 && decide((negative ? 9 : 2) + (more < 6 ? more : 6),
                                 (negative ? 5 : 2) + (more < 2 ? more : 2)))
        ++more;
      if (more === 20) more += plain();
      if (more > 4 * largest) throw new Damaged("a coded number is too large");
      bin = negative ? -more - 1 : more + 1;
    }
    if (coarse === 0) return bin;
    let read = 0;
    for (let n = 0; n < coarse; ++n) read = 2 * read + bit(32768);
    return bin * 2 ** coarse + read - 2 ** (coarse - 1);
  };
  const keep = (index, found) => {
    if (!(Math.abs(found) <= largest)) throw new Damaged("a coded number is too large");
    values[index] = found;
  };

  const x = new Int32Array(16);
  const codeHalf = (step, c, half) => {
    const between = step.after >= 0;
    const toward = between ? Math.floor((Math.floor(131072 * (step.slice - step.before) /
                                                    (step.after - step.before)) + 1) / 2) : 0;
    const perStep = between ? Math.floor(65536 / (step.after - step.before)) : 0;
    const perBefore = step.beforeThat !== -2 ? Math.floor(65536 / (step.before - step.beforeThat)) : 0;
    const perAfter = step.afterThat !== -2 ? Math.floor(65536 / (step.afterThat - step.after)) : 0;
    const slice = l => l < 0 ? closed : values.subspan(c, l);
    const before = slice(step.before), after = slice(step.after), beforeThat = slice(step.beforeThat),
          afterThat = slice(step.afterThat);
    const own = channels[half][c], last = channels[half][0];
    const rank = c === 1 ? 0 : c === 2 ? 1 : 2;
    const near = rank > 0 ? channels[half][rank === 1 ? 1 : 2] : null, far = rank > 1 ? channels[half][1] : null;
    const nearInnovation = near ? near.innovation : nothing, farInnovation = far ? far.innovation : nothing;
    const nearError = near ? near.error : last.earlier, farError = far ? far.error : last.earlier;
    const twin = half === 1 ? channels[0][c].innovation : nothing, twinSign = c === 1 ? -1 : 1;
    const d = own.innovation, e = own.error, p = own.earlier, r = own.residual;
    const list = places[half], count = list.at.length;
    const set = (half * 2 + (between ? 0 : 1)) * rows, overall = (set + rows - 1) * 16;
    const first = (c * slices + step.slice) * N;
    for (let n = 0; n < count; ++n) {
      const o = list.at[n], unknown = list.unknown[n], across = list.across[n];
      let base = 0;
      x[0] = d[o - A - B - 1], x[1] = d[o - B - 1], x[2] = d[o - A - B], x[3] = d[o - B];
      x[4] = d[o - A - 1], x[5] = d[o - 2], x[6] = d[o - A], x[7] = d[o - 1];
      x[8] = d[o - B + 1], x[10] = d[o - 2 * A], x[12] = nearInnovation[o], x[14] = farInnovation[o];
      x[9] = x[11] = x[13] = 0;
      x[15] = across < width[0] ? twinSign * twin[o] : 0;
      if (between) {
        const from = before[unknown], to = after[unknown], slope = (to - from) * perStep;
        base = Math.floor((from * (65536 - toward) + to * toward) / 256);
        x[9] = limited((to - from) * 64);
        if (step.beforeThat !== -2)
          x[11] = limited(Math.floor(((from - beforeThat[unknown]) * perBefore - slope) / 256));
        if (step.afterThat !== -2)
          x[13] = limited(Math.floor(((afterThat[unknown] - to) * perAfter - slope) / 256));
      }
      let all = 2048;
      for (let i = 0; i < 16; ++i) all |= x[i] ^ (x[i] >> 31);
      const shift = 20 - Math.clz32(all);
      const local = (set + across) * 16;
      let sumOne = 0, sumTwo = 0, squares = shift > 15 ? 0 : 655360 >> (2 * shift);
      for (let i = 0; i < 16; ++i) {
        const value = x[i] >> shift;
        x[i] = value;
        sumOne += weights[overall + i] * value;
        sumTwo += weights[local + i] * value;
        squares += value * value;
      }
      const scaled = 2 ** (shift - 14);
      const one = Math.floor(sumOne * scaled), two = Math.floor(sumTwo * scaled);
      const prediction = base + Math.floor((one + two) / 2);

      const direct = e[o - A] + e[o - B] + e[o - 1];
      const diagonal = e[o - A - B] + e[o - A - 1] + e[o - B - 1] + e[o - A + B] + e[o - A + 1] + e[o - B + 1];
      const behind = p[o - A] + p[o - B] + p[o - 1], ahead = p[o + A] + p[o + B] + p[o + 1];
      const spread = ahead + 3 * (p[o] + nearError[o]) + 2 * farError[o];
      const scale = Math.floor((4 * direct + diagonal + behind + spread) / 32);
      const nearSize = Math.floor(direct * 85 / 256);
      const earlierSize = Math.floor((p[o] + Math.floor((ahead + behind) * 43 / 256)) / 2);
      const residuals = (r[o - A] * 5 + r[o - B]) * 5 + r[o - 1];

      const nearest = Math.floor((prediction + 128) / 256);
      let offset = prediction - 256 * nearest;
      const flipped = offset < 0;
      if (flipped) offset = -offset;
      const coarse = 22 - Math.clz32(scale | 512), fine = scale >> coarse, level = scaleLevel(fine);
      offset >>= coarse;
      const partNear = Math.min(scaleLevel(nearSize) * 3 >> 3, 11);
      const partEarlier = Math.min(scaleLevel(earlierSize) * 3 >> 3, 11);
      firsts = ((partNear * 12 + partEarlier) * 5 + (offset >> 5)) * 16;
      seconds = ((flipped ? 124 - residuals : residuals) * 8 + Math.min(level >> 2, 7)) * 16;
      selected = Math.min(level * 3 >> 3, 15);
      opinion = (Math.min(logLevel(fine + 13) - 12, 27) * 17 + (offset >> 3)) * 8;
      const away = distance(coarse), found = nearest + (flipped ? -away : away);
      keep(first + unknown, found);

      const target = 256 * found;
      const inverse = Math.floor(68719476736 / squares);
      let factor = Math.floor(Math.floor(limited(target - base - one) / 2 ** shift) * 160 * inverse / 4194304);
      factor = (factor < -511 ? -511 : factor > 511 ? 511 : factor) * 64;
      for (let i = 0; i < 16; ++i) {
        const w = weights[overall + i] + ((factor * (x[i] * 4)) >> 16);
        weights[overall + i] = w < -24576 ? -24576 : w > 24576 ? 24576 : w;
      }
      factor = Math.floor(Math.floor(limited(target - base - two) / 2 ** shift) * 70 * inverse / 4194304);
      factor = (factor < -511 ? -511 : factor > 511 ? 511 : factor) * 64;
      for (let i = 0; i < 16; ++i) {
        const w = weights[local + i] + ((factor * (x[i] * 4)) >> 16);
        weights[local + i] = w < -24576 ? -24576 : w > 24576 ? 24576 : w;
      }
      d[o] = limited(target - base);
      const away256 = Math.abs(limited(target - prediction));
      e[o] = away256;
      p[o] = between ? Math.floor((away256 + p[o]) / 2) : away256 >> 1;
      const residual = found - nearest;
      r[o] = 2 + (residual < -2 ? -2 : residual > 2 ? 2 : residual);
    }
  };
  /// The second half where it mirrors the first: one decision for each value confirms it.
  const copyHalf = (slice, c) => {
    const first = (c * slices + slice) * N, sign = c === 1 ? -1 : 1, list = places[1];
    for (let n = 0; n < list.at.length; ++n) {
      const mirror = list.twin[n] < 0 ? 0 : sign * values[first + list.twin[n]];
      const p = differsP[c], differs = bit(Math.min(65532, Math.max(4, p)));
      differsP[c] = p + Math.floor(((differs ? 65535 : 0) - p) * rate[differsSeen[c]] / 65536);
      if (differsSeen[c] < 1023) ++differsSeen[c];
      let away = 0;
      if (differs) {
        const negative = bit(32768), more = plain();
        away = negative ? -more - 1 : more + 1;
      }
      keep(first + list.unknown[n], mirror + away);
    }
  };
  values.subspan = (c, l) => values.subarray((c * slices + l) * N, (c * slices + l + 1) * N);

  const mirrored = [bit(32768), bit(32768), bit(32768)];
  for (const step of sliceOrder(slices))
    for (const c of [1, 2, 0])
      for (let half = 0; half < 2; ++half)
        if (half === 1 && mirrored[c]) copyHalf(step.slice, c);
        else codeHalf(step, c, half);
  if (at < bytes.length) throw new Damaged("coded numbers go on after their end");
  return values;
}
