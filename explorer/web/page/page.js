// The page: reads its data, shows a case or a field between the cases, and keeps its state in the address.
"use strict";

const crcTable = Uint32Array.from({length: 256}, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 3988292384 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});
function crc32(text) {
  let crc = 4294967295;
  for (let n = 0; n < text.length; ++n) crc = crcTable[(crc ^ text.charCodeAt(n)) & 255] ^ (crc >>> 8);
  return (crc ^ 4294967295) >>> 0;
}

/// The text of an element, exactly as it was written.
function dataOf(id) {
  const element = document.getElementById(id);
  if (!element || !document.getElementById("end")) throw new Damaged("its end is missing");
  const text = element.textContent;
  if (String(text.length) !== element.dataset.bytes || String(crc32(text)) !== element.dataset.crc)
    throw new Damaged(`its part "${id}" is not what was written`);
  return text;
}

function bytesOf(text) {
  const characters = atob(text), bytes = new Uint8Array(characters.length);
  for (let n = 0; n < bytes.length; ++n) bytes[n] = characters.charCodeAt(n);
  return bytes;
}
const base64Size = bytes => 4 * Math.ceil(bytes / 3);

/// The header of a case, of the columns of docs/formats.md.
function headerOf(columns, i) {
  const header = {};
  for (const [path, column] of Object.entries(columns)) {
    const value = "all" in column ? column.all : "each" in column ? column.each[i] : column.values[column.of[i]];
    if (value === "absent") continue;
    const [group, ...rest] = path.split("/"), name = rest.join("/");
    if (rest.length === 0) header[group] = value;
    else (header[group] = header[group] || {})[name] = value;
  }
  return header;
}

class Page {
  constructor() {
    this.data = JSON.parse(dataOf("study"));
    if (this.data.format !== "cleft-page" || this.data.version !== 1) throw new Damaged("it has another format");
    this.coded = dataOf("coefficients");
    const modes = dataOf("modes");
    this.mesh = this.data.mesh ? new MeshMotion(this.data.mesh, modes) : null;
    this.between = this.data.between ? new BetweenCases(this.data.between, this.mesh ? null : modes) : null;
    let at = 0;
    const starts = list => list.map(bytes => {
      const start = at;
      at += base64Size(bytes);
      return start;
    });
    this.modeStarts = starts(this.data.modes ? this.data.modes.bytes : []);
    this.starts = starts(this.data.cases.map(one => one.bytes));
    if (at !== this.coded.length) throw new Damaged("coefficients are missing");
    this.fields = new Map();
    this.names = this.data.parameters.map(parameter => parameter.name);
    this.headers = this.data.cases.map((one, i) => headerOf(this.data.columns, i));
    this.rows = this.headers.map((header, i) => {
      const {gape, displacement, error} = this.data.cases[i];
      return [...this.names.map(name => header.parameters[name] ?? NaN), gape, displacement, 100 * error];
    });
    this.columns = [
      ...this.data.parameters.map(({name, unit}) => ({name, title: name + (unit ? ", " + unit : ""), short: name.replace(/^.*\./, "")})),
      {name: "gape", title: "gape, mm", short: "gape"}, {name: "displacement", title: "displacement, mm", short: "displacement"},
      {name: "error", title: "error, %", short: "error"}];
    this.state = {case: 0, values: null, t: this.duration(0), color: "displacement", dark: matchMedia("(prefers-color-scheme: dark)").matches, where: ""};
    this.view = new View(document.getElementById("view"), document.getElementById("painted"));
    this.build();
    this.readAddress();
    this.refresh(true);
    this.filter();
    this.prepare();
    window.addEventListener("resize", () => this.refresh());
    window.addEventListener("hashchange", () => {
      if (location.hash.slice(1) !== this.address()) this.readAddress(), this.refresh(), this.filter();
    });
  }
  /// Fields between the cases are prepared bit by bit, while nothing else is to be done.
  prepare() {
    const step = () => {
      if (this.between && !this.between.prepare()) setTimeout(step, 10);
    };
    setTimeout(() => {
      this.view.measure();
      step();
    }, 300);
  }
  duration(i) { return this.mesh ? this.mesh.duration : this.headers[i].domain.t[1]; }

  /// The field of a case, decoded when it is first shown; the last sixteen are kept.
  fieldOf(i) {
    let field = this.fields.get(i);
    if (field) return field;
    const header = this.headers[i], coded = (start, bytes) => bytesOf(this.coded.slice(start, start + base64Size(bytes)));
    if (this.mesh) {
      field = this.mesh.caseOf(i);
    } else if (header.modes) {
      const {bytes, quanta} = this.data.modes;
      this.modes ??= bytes.map((count, k) => new CodedPoints(header, coded(this.modeStarts[k], count)).values.map(value => value * quanta[k]));
      field = new Field(header, sumOfModes(header, this.modes));
    } else {
      field = new Field(header, controlPoints(header, coded(this.starts[i], this.data.cases[i].bytes)));
    }
    this.fields.set(i, field);
    if (this.fields.size > 16) this.fields.delete(this.fields.keys().next().value);
    return field;
  }
  /// The case that has these values, or -1.
  caseOf(values) {
    return this.rows.findIndex(row => this.names.every((name, c) => Math.abs(row[c] - values[c]) <= 1e-9 * Math.abs(row[c])));
  }
  nearestCase(values) {
    let best = 0, least = Infinity;
    this.rows.forEach((row, i) => {
      const away = this.names.reduce((sum, name, c) =>
        sum + ((row[c] - values[c]) / ((this.ranges[c][1] - this.ranges[c][0]) || 1)) ** 2, 0);
      if (away < least) least = away, best = i;
    });
    return best;
  }

  build() {
    const get = id => document.getElementById(id);
    this.get = get;
    get("legend-colors").width = 256, get("legend-colors").height = 1;
    get("legend-colors").getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(valueTable), 256, 1), 0, 0);
    document.title = this.data.title + " - Cleft";
    get("title").textContent = this.data.title;
    this.data.cases.forEach((one, i) => {
      const option = document.createElement("option");
      option.value = String(i);
      option.textContent = `${i + 1}  ${one.name}`;
      get("case").append(option);
    });
    this.noCase = document.createElement("option");
    this.noCase.value = "-1";
    this.noCase.textContent = "between the cases";
    this.noCase.hidden = true;
    get("case").append(this.noCase);
    this.ranges = this.names.map((name, c) => [Math.min(...this.rows.map(row => row[c])), Math.max(...this.rows.map(row => row[c]))]);
    this.sliders = this.data.parameters.map(({name, unit, help}, c) => {
      const row = document.createElement("div"), label = document.createElement("label"),
            input = document.createElement("input"), output = document.createElement("output");
      row.className = "row";
      label.textContent = name;
      label.title = help;
      input.type = "range", input.step = "any", input.id = "parameter-" + c;
      [input.min, input.max] = this.ranges[c].map(String);
      label.htmlFor = input.id;
      row.append(label, input, output);
      get("parameters").append(row);
      input.addEventListener("input", () => {
        const values = this.values().slice();
        values[c] = Number(input.value);
        this.choose(values);
      });
      return {input, tell: value => {
        if (document.activeElement !== input || Number(input.value) !== value) input.value = String(value);
        output.textContent = shownNumber(value) + (unit ? " " + unit : "");
      }};
    });
    get("case").addEventListener("change", event => this.show(Number(event.target.value)));
    get("time").addEventListener("input", event => this.set({t: Number(event.target.value)}));
    get("color").addEventListener("change", event => this.set({color: event.target.value}));
    get("dark").addEventListener("click", () => this.set({dark: !this.state.dark}));
    get("play").addEventListener("click", () => this.play());
    get("reset").addEventListener("click", () => this.turn(0, 0, 1));
    get("where").addEventListener("input", event => {
      this.set({where: event.target.value});
      this.filter();
    });
    if (this.mesh)
      for (const option of [...get("color").options])
        if (!["displacement", "tissue"].includes(option.value)) option.remove();
    this.buildTable();
    this.parallel = new ParallelCoordinates(get("parallel"), this.columns, this.rows, () => this.filter());
    this.parallel.passes = i => this.chosen[i];
    this.listen();
  }
  buildTable() {
    const table = this.get("table"), head = table.createTHead().insertRow();
    this.order = this.rows.map((row, i) => i);
    [...this.columns.map(column => column.title), "case"].forEach((title, c) => {
      const cell = document.createElement("th");
      cell.textContent = title;
      cell.addEventListener("click", () => {
        const sign = this.sorted === c ? -1 : 1;
        this.sorted = sign > 0 ? c : undefined;
        const key = i => c < this.columns.length ? this.rows[i][c] : i;
        this.order.sort((a, b) => sign * (key(a) - key(b)));
        this.filter();
      });
      head.append(cell);
    });
    this.body = table.createTBody();
    this.lines = this.rows.map((row, i) => {
      const line = document.createElement("tr");
      for (const number of row) {
        const cell = document.createElement("td");
        cell.textContent = shownNumber(number);
        line.append(cell);
      }
      const cell = document.createElement("td");
      cell.textContent = this.data.cases[i].hash || this.data.cases[i].name;
      line.append(cell);
      line.addEventListener("click", () => this.show(i));
      return line;
    });
  }
  listen() {
    const canvas = this.get("view"), pointers = new Map();
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    canvas.addEventListener("pointermove", event => {
      const before = pointers.get(event.pointerId);
      if (!before) return;
      const now = [event.clientX, event.clientY];
      if (pointers.size === 2) {
        const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
        const apart = p => Math.max(1, Math.hypot(p[0] - other[0], p[1] - other[1]));
        this.turn(this.view.azimuth, this.view.elevation, this.view.zoom * apart(now) / apart(before));
      } else {
        const degrees = 180 / Math.max(200, canvas.clientHeight);
        this.turn(this.view.azimuth - (now[0] - before[0]) * degrees, this.view.elevation + (now[1] - before[1]) * degrees, this.view.zoom);
      }
      pointers.set(event.pointerId, now);
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, event => pointers.delete(event.pointerId));
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.turn(this.view.azimuth, this.view.elevation, this.view.zoom * Math.exp(-0.001 * clamp(event.deltaY, -300, 300)));
    }, {passive: false});
    document.addEventListener("keydown", event => {
      const {tagName, type} = event.target, slider = tagName === "INPUT" && type === "range";
      if (event.ctrlKey || event.altKey || event.metaKey || tagName === "SELECT" || (tagName === "INPUT" && !slider)) return;
      if ((slider && event.key.startsWith("Arrow")) || (tagName === "BUTTON" && event.key === " ")) return;
      const {azimuth, elevation, zoom} = this.view, step = 5, {t} = this.state, length = this.duration(this.state.case);
      const keys = {
        ArrowLeft: () => this.turn(azimuth - step, elevation, zoom), ArrowRight: () => this.turn(azimuth + step, elevation, zoom),
        ArrowUp: () => this.turn(azimuth, elevation + step, zoom), ArrowDown: () => this.turn(azimuth, elevation - step, zoom),
        "+": () => this.turn(azimuth, elevation, zoom * 1.1), "-": () => this.turn(azimuth, elevation, zoom / 1.1),
        "[": () => this.set({t: t - length / 60}), "]": () => this.set({t: t + length / 60}),
        n: () => this.show((this.state.case + 1) % this.rows.length),
        p: () => this.show((this.state.case + this.rows.length - 1) % this.rows.length),
        r: () => this.turn(0, 0, 1), d: () => this.set({dark: !this.state.dark}), " ": () => this.play()};
      if (!Object.hasOwn(keys, event.key)) return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  values() { return this.state.values || this.names.map((name, c) => this.rows[this.state.case][c]); }
  show(i) {
    if (i < 0) return;
    this.set({case: i, values: null});
  }
  /// A case, or what is between them, by the parameters' values.
  choose(values) {
    const exact = this.caseOf(values);
    if (exact >= 0) this.set({case: exact, values: null});
    else if (this.between) this.set({case: this.nearestCase(values), values});
    else this.set({case: this.nearestCase(values), values: null});
  }
  turn(azimuth, elevation, zoom) {
    Object.assign(this.view, {azimuth: ((azimuth + 180) % 360 + 360) % 360 - 180, elevation: clamp(elevation, -89, 89), zoom: clamp(zoom, 0.2, 40)});
    this.later();
  }
  set(change) {
    Object.assign(this.state, change);
    this.later();
  }
  play() {
    this.playing = !this.playing;
    this.get("play").textContent = this.playing ? "Pause" : "Play";
    if (!this.playing) return;
    const length = this.field.duration, begun = performance.now() - (this.state.t < length ? this.state.t / length * 4000 : 0);
    const step = now => {
      if (!this.playing) return;
      this.set({t: Math.min(length, (now - begun) / 4000 * length)});
      if (this.state.t >= length) this.play();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  later() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.refresh(true);
    });
  }
  /// Draws what the state says; what takes longer follows when nothing has changed for a moment. `moving`: with fewer
  /// pixels, where drawing is slow.
  refresh(moving = false) {
    const {state, get} = this;
    document.documentElement.classList.toggle("dark", state.dark);
    this.takeField();
    state.t = clamp(state.t, 0, this.field.duration);
    if (this.mesh) state.t = Math.round(state.t / this.mesh.duration * this.mesh.slices) * this.mesh.duration / this.mesh.slices;
    const largest = this.largestValue();
    this.scene.at(state.t);
    const values = state.color === "tissue" ? null : this.scene.values(state.color, state.t, this.numbers);
    this.view.move(this.scene.displacement);
    this.range = [0, largest];
    this.view.draw(values, this.range, state.dark, moving);
    get("case").value = state.values ? "-1" : String(state.case);
    this.noCase.hidden = !state.values;
    this.sliders.forEach((slider, c) => slider.tell(this.values()[c]));
    get("time").max = String(this.field.duration);
    get("time").value = String(state.t);
    get("time-value").textContent = shownNumber(state.t) + " mm";
    get("color").value = state.color;
    get("error").textContent = this.errorText();
    get("dark").setAttribute("aria-pressed", String(state.dark));
    if (get("where").value !== state.where) get("where").value = state.where;
    this.drawLegend();
    clearTimeout(this.slow);
    this.slow = setTimeout(() => this.refreshSlow(), 120);
  }
  takeField() {
    const {case: i, values} = this.state, key = values ? values.join() : String(i);
    if (key === this.key) return;
    const between = values && this.betweenAt(this.named(values));
    this.field = values ? between.field : this.fieldOf(i);
    if (this.scene && this.scene.shape === PatchScene.shapeOf(this.field)) {
      this.scene.take(this.field);
    } else {
      this.scene = this.mesh ? new MeshScene(this.field) : new PatchScene(this.field);
      this.numbers = new Float32Array(this.scene.count);
      this.view.take(this.scene);
    }
    this.key = key;
    this.largest = {};
    this.error = values ? between.errorOf(this.largestValue("displacement")) : this.data.cases[i].error;
  }
  named(values) { return Object.fromEntries(this.names.map((name, c) => [name, values[c]])); }
  betweenAt(values) {
    if (!this.mesh) return this.between.at(values);
    const {cases, errorOf} = this.between.predictionAt(values);
    return {field: this.mesh.sum(this.data.cases.map(({hash}) => cases[this.between.data.cases.indexOf(hash)] ?? 0)), errorOf};
  }
  largestValue(color = this.state.color) {
    if (color === "tissue") return 1;
    this.largest[color] ??= this.scene.largestValue(color, this.numbers.slice());
    return this.largest[color];
  }
  errorText() {
    return this.errorOfField() + (this.mesh && this.mesh.cases > 1 ? " " + this.data.mesh.note : "");
  }
  errorOfField() {
    const percent = shownNumber(100 * this.error) + " %";
    if (this.mesh && this.mesh.cases < 2) return this.data.mesh.note;
    if (this.state.values && this.between.compressed(this.named(this.state.values)))
      return "There is no such case: the skin would be compressed in some direction.";
    if (this.state.values) return `Between the cases: estimated error ${percent} of the largest displacement.`;
    return `Case ${this.state.case + 1} of ${this.rows.length}: no node is off by more than ${percent} of the largest displacement` +
           (this.between || this.rows.length < 2 ? "." : ". Sliders choose the nearest case, for nothing is known between them: " + this.data.not_between);
  }
  drawLegend() {
    const {get} = this, shown = this.state.color !== "tissue";
    get("legend").hidden = !shown;
    if (!shown) return;
    get("legend-title").textContent = get("color").selectedOptions[0].textContent;
    get("legend-least").textContent = "0";
    get("legend-greatest").textContent = shownNumber(this.range[1]);
  }
  refreshSlow() {
    const {field, get, state} = this;
    this.view.refine();
    const profiles = field.profiles(state.t);
    if (profiles.length && this.curveOf !== this.key) {
      this.curveOf = this.key;
      this.curve = [];
      for (let i = 0; i <= 60; ++i) this.curve.push([field.duration * i / 60, widestGape(field, field.duration * i / 60)]);
    }
    if (profiles.length) {
      drawCurve(get("gape-curve"), [this.curve], state.t, "length cut, mm", "widest opening, mm");
      drawCurve(get("profile-curve"), profiles, null, this.mesh ? "place along the cuts, mm" : "u, mm", "opening along the cut, mm");
    }
    this.markShown();
    history.replaceState(null, "", "#" + this.address());  // not in each picture: browsers limit how often
  }
  /// Which cases the condition and the brushes choose.
  filter() {
    const {get, state} = this, numbers = i => name => this.rows[i][this.columns.findIndex(column => column.name === name)];
    let condition = () => true, mistake = "";
    try {
      if (state.where.trim()) condition = parseCondition(state.where, this.columns.map(column => column.name));
    } catch (error) {
      mistake = error.message;
    }
    this.chosen = this.rows.map((row, i) => condition(numbers(i)) && this.parallel.within(row));
    const count = this.chosen.filter(Boolean).length;
    get("found").textContent = mistake || `${count} of ${this.rows.length} cases`;
    this.body.replaceChildren(...this.order.filter(i => this.chosen[i]).map(i => this.lines[i]));
    this.markShown();
  }
  markShown() {
    const {state} = this, shown = state.values ? -1 : state.case;
    if (this.marked) this.marked.classList.remove("shown");
    this.marked = this.lines[shown];
    if (this.marked) this.marked.classList.add("shown");
    this.parallel.shown = shown;
    this.parallel.values = state.values;
    this.parallel.draw();
  }

  address() {
    const {state, view} = this, parts = new URLSearchParams({case: state.case + 1, t: shownNumber(state.t), color: state.color,
      az: shownNumber(view.azimuth), el: shownNumber(view.elevation), zoom: shownNumber(view.zoom), dark: state.dark ? 1 : 0});
    if (state.values) parts.set("values", state.values.join(","));
    if (state.where) parts.set("where", state.where);
    return parts.toString();
  }
  /// What is missing or makes no sense in the address stays as it is.
  readAddress() {
    const parts = new URLSearchParams(location.hash.slice(1)), {state, view} = this;
    const number = (name, low, high, take) => {
      const value = parts.has(name) ? Number(parts.get(name)) : NaN;
      if (Number.isFinite(value)) take(clamp(value, low, high));
    };
    number("case", 1, this.rows.length, value => {
      state.case = Math.round(value) - 1, state.values = null, state.t = this.duration(state.case);
    });
    const values = (parts.get("values") || "").split(",").map(Number);
    if (this.between && parts.has("values") && values.length === this.names.length && values.every(Number.isFinite))
      this.choose(values.map((value, c) => clamp(value, ...this.ranges[c])));
    number("t", 0, Infinity, value => state.t = value);
    number("az", -180, 180, value => view.azimuth = value);
    number("el", -89, 89, value => view.elevation = value);
    number("zoom", 0.2, 40, value => view.zoom = value);
    number("dark", 0, 1, value => state.dark = value === 1);
    if ([...this.get("color").options].some(option => option.value === parts.get("color"))) state.color = parts.get("color");
    if (parts.has("where")) state.where = parts.get("where");
  }
}

document.addEventListener("DOMContentLoaded", () => {
  const message = document.getElementById("message"), main = document.getElementById("main");
  try {
    if (!message || !main) return;
    main.hidden = false;
    window.cleft = new Page();
    message.hidden = true;
  } catch (error) {
    main.hidden = true;
    message.hidden = false;
    message.textContent = error instanceof Damaged || error instanceof SyntaxError
      ? `This page is damaged: ${error.message}. Ask for it again, or make it again with cleft export --web.`
      : error.message;
  }
});
