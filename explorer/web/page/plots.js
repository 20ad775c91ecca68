// Curves and parallel coordinates, on canvases.
"use strict";

const shownNumber = x => Number.isFinite(x) ? String(Number(x.toPrecision(4))) : "-";

/// A canvas of its size on the screen, cleared; its context, width and height in CSS pixels.
function freshCanvas(canvas) {
  const ratio = Math.min(2, window.devicePixelRatio || 1), width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = Math.round(width * ratio), canvas.height = Math.round(height * ratio);
  const g = canvas.getContext("2d");
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  const style = getComputedStyle(canvas);
  g.font = "12px " + style.fontFamily;
  return {g, width, height, ink: style.color, accent: style.getPropertyValue("--accent").trim(),
          faint: style.getPropertyValue("--faint").trim()};
}

function niceTicks(least, greatest, count) {
  const raw = (greatest - least) / count || 1, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map(n => n * power).find(s => s >= raw), ticks = [];
  for (let x = Math.ceil(least / step - 1e-9) * step; x <= greatest + 1e-9 * step; x += step) ticks.push(x);
  return ticks;
}

/// Curves of [x, y], y from 0 on, one after another along x, with a mark at x = `at`.
function drawCurve(canvas, curves, at, xTitle, yTitle) {
  const points = curves.flat();
  const {g, width, height, ink, accent, faint} = freshCanvas(canvas);
  const left = 46, right = width - 10, top = 22, bottom = height - 34;
  const least = points[0][0], greatest = points[points.length - 1][0];
  const highest = Math.max(1e-12, ...points.map(([, y]) => y)) * 1.05;
  const px = x => left + (x - least) / (greatest - least || 1) * (right - left);
  const py = y => bottom - y / highest * (bottom - top);
  g.fillStyle = ink;
  g.textAlign = "left";
  g.fillText(yTitle, 4, 14);
  g.textAlign = "right";
  g.fillText(xTitle, right, height - 5);
  g.strokeStyle = faint;
  g.lineWidth = 1;
  g.beginPath();
  for (const y of niceTicks(0, highest, 4)) {
    g.moveTo(left, py(y)), g.lineTo(right, py(y));
    g.fillText(shownNumber(y), left - 5, py(y) + 4);
  }
  g.stroke();
  g.textAlign = "center";
  for (const x of niceTicks(least, greatest, 5)) g.fillText(shownNumber(x), px(x), bottom + 15);
  g.strokeStyle = accent;
  g.lineWidth = 2;
  g.beginPath();
  for (const curve of curves) curve.forEach(([x, y], n) => n ? g.lineTo(px(x), py(y)) : g.moveTo(px(x), py(y)));
  g.stroke();
  if (at !== null) {
    g.strokeStyle = ink;
    g.lineWidth = 1;
    g.beginPath();
    g.moveTo(px(at), top), g.lineTo(px(at), bottom);
    g.stroke();
  }
}

/// Parallel coordinates with ranges that are brushed on their axes.
class ParallelCoordinates {
  constructor(canvas, columns, rows, changed) {
    Object.assign(this, {canvas, columns, rows, brushes: {}, shown: -1, passes: () => true});
    this.limits = columns.map((column, c) => {
      let least = Infinity, greatest = -Infinity;
      for (const row of rows) if (Number.isFinite(row[c])) least = Math.min(least, row[c]), greatest = Math.max(greatest, row[c]);
      return greatest > least ? [least, greatest] : [least - 1, greatest + 1];
    });
    let axis = -1, from = 0;
    canvas.addEventListener("pointerdown", event => {
      const {width} = canvas.getBoundingClientRect();
      axis = Math.round((event.offsetX - 40) / Math.max(1, width - 80) * Math.max(1, columns.length - 1));
      axis = clamp(axis, 0, columns.length - 1);
      from = this.valueAt(axis, event.offsetY);
      canvas.setPointerCapture(event.pointerId);
      delete this.brushes[columns[axis].name];
      changed();
    });
    canvas.addEventListener("pointermove", event => {
      if (axis < 0) return;
      const to = this.valueAt(axis, event.offsetY);
      this.brushes[columns[axis].name] = [Math.min(from, to), Math.max(from, to)];
      changed();
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => axis = -1);
    canvas.addEventListener("dblclick", () => {
      this.brushes = {};
      changed();
    });
  }
  valueAt(axis, y) {
    const [least, greatest] = this.limits[axis], height = this.canvas.clientHeight;
    return least + clamp((height - 24 - y) / (height - 54), 0, 1) * (greatest - least);
  }
  within(row) {
    return this.columns.every(({name}, c) => !this.brushes[name] ||
                                             (row[c] >= this.brushes[name][0] && row[c] <= this.brushes[name][1]));
  }
  draw() {
    const {g, width, height, ink, accent, faint} = freshCanvas(this.canvas), {columns, rows} = this;
    const px = c => columns.length > 1 ? 40 + c * (width - 80) / (columns.length - 1) : width / 2;
    const py = (c, x) => height - 24 - (x - this.limits[c][0]) / (this.limits[c][1] - this.limits[c][0]) * (height - 54);
    const line = (row, style, thick) => {
      g.strokeStyle = style, g.lineWidth = thick;
      g.beginPath();
      row.forEach((x, c) => c ? g.lineTo(px(c), py(c, x)) : g.moveTo(px(c), py(c, x)));
      g.stroke();
    };
    const lines = rows.map((row, n) => ({row, chosen: this.passes(n)}));
    g.globalAlpha = 0.35;
    for (const one of lines) if (!one.chosen) line(one.row, faint, 1);
    g.globalAlpha = rows.length > 100 ? 0.35 : 0.8;
    for (const one of lines) if (one.chosen) line(one.row, accent, 1);
    g.globalAlpha = 1;
    if (this.shown >= 0) line(rows[this.shown], ink, 2.5);
    if (this.values) line(this.values, ink, 2.5);
    g.fillStyle = ink;
    columns.forEach(({name, short}, c) => {
      g.textAlign = c === 0 ? "left" : c === columns.length - 1 ? "right" : "center";
      const x = c === 0 ? 4 : c === columns.length - 1 ? width - 4 : px(c);
      g.fillText(short, x, c % 2 ? 26 : 13);
      g.fillText(shownNumber(this.limits[c][0]), x, height - 6);
      g.strokeStyle = ink, g.lineWidth = 1;
      g.beginPath();
      g.moveTo(px(c), 30), g.lineTo(px(c), height - 24);
      g.stroke();
      const brush = this.brushes[name];
      if (brush) {
        g.fillStyle = accent;
        g.fillRect(px(c) - 4, py(c, brush[1]), 8, Math.max(2, py(c, brush[0]) - py(c, brush[1])));
        g.fillStyle = ink;
      }
    });
  }
}

/// The condition of the field "find" as a function of a name's number: gape > 3 and not (error < 1 or a.b <= 2).
function parseCondition(text, names) {
  const words = text.match(/[A-Za-z_][\w.]*|\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?|<=|>=|==|!=|[-<>()=]|\S/g) || [];
  let at = 0;
  const fail = what => { throw new Error("The condition is not understood at " + (words[at] ? `"${words[at]}"` : "its end") + ": " + what); };
  const operand = () => {
    const word = words[at];
    if (word === "-") {
      ++at;
      const inner = operand();
      return row => -inner(row);
    }
    if (word === undefined || (!names.includes(word) && !/^[\d.]/.test(word))) fail("a number or one of " + names.join(", ") + " is expected.");
    ++at;
    const number = Number(word);
    return names.includes(word) ? row => row(word) : () => number;
  };
  const comparison = () => {
    if (words[at] === "not") {
      ++at;
      const inner = comparison();
      return row => !inner(row);
    }
    if (words[at] === "(") {
      ++at;
      const inner = either();
      if (words[at++] !== ")") --at, fail("a closing bracket is expected.");
      return inner;
    }
    const a = operand(), sign = words[at];
    const compare = {"<": (x, y) => x < y, ">": (x, y) => x > y, "<=": (x, y) => x <= y, ">=": (x, y) => x >= y,
                     "==": (x, y) => x === y, "=": (x, y) => x === y, "!=": (x, y) => x !== y};
    if (sign === undefined || !Object.hasOwn(compare, sign)) fail("a comparison (<, >, <=, >=, ==, !=) is expected.");
    ++at;
    const b = operand();
    return row => compare[sign](a(row), b(row));
  };
  const both = () => {
    let result = comparison();
    while (words[at] === "and") {
      ++at;
      const a = result, b = comparison();
      result = row => a(row) && b(row);
    }
    return result;
  };
  const either = () => {
    let result = both();
    while (words[at] === "or") {
      ++at;
      const a = result, b = both();
      result = row => a(row) || b(row);
    }
    return result;
  };
  const result = either();
  if (at < words.length) fail("and, or, or the end is expected.");
  return result;
}
