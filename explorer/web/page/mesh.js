// A mesh with cuts: its points at the lengths cut that it shows, as sums of modes that the cases have in common.
"use strict";

class MeshMotion {
  constructor(data, coded) {
    Object.assign(this, data);
    let at = 0;
    const pieces = data.bytes.map(count => {
      const begin = at;
      at += base64Size(count);
      return () => bytesOf(coded.slice(begin, begin + base64Size(count))).buffer;
    });
    if (at !== coded.length) throw new Damaged("a piece of the mesh is missing");
    const [points, depth, triangles, places, active, shares, ...modes] = pieces;
    const floats = piece => new Float32Array(piece()), whole = piece => new Uint32Array(piece());
    this.rest = Float64Array.from(floats(points));
    this.depth = floats(depth);
    const corners = whole(triangles);
    this.skinCorners = corners.subarray(0, 3 * data.skin), this.wallCorners = corners.subarray(3 * data.skin);
    this.wallPlaces = floats(places);
    this.moving = whole(active);
    this.shares = floats(shares);
    this.coded = modes;
    this.cases = this.shares.length / Math.max(1, modes.length);
    const within = list => list.every(n => n < data.points);
    const sound = this.rest.length === 3 * data.points && this.depth.length === data.points && within(corners) && within(this.moving) &&
                  data.slices >= 1 && data.slices < 10000 && Number.isInteger(this.cases) &&
                  data.cuts.every(cut => within(cut.left) && within(cut.right));
    if (!sound) throw new Damaged("the mesh does not fit to its numbers");
  }
  /// Decoded when they are first needed: numbered (component * slices + slice) * points + point.
  modesOf() {
    const count = this.moving.length;
    this.decoded ??= this.coded.map(piece => {
      const grid = {along: count, across: 1, height: 1, unknown: Int32Array.from({length: count}, (_, n) => n), unknowns: count};
      const whole = decodeCoefficients(grid, this.slices, new Uint8Array(piece())), mode = new Float32Array(whole.length);
      for (let n = 0; n < mode.length; ++n) mode[n] = whole[n] * this.quantum;
      return mode;
    });
    return this.decoded;
  }
  /// What moves the mesh as a sum of cases does.
  sum(weights) {
    const series = new Float32Array(3 * this.slices * this.moving.length);
    this.modesOf().forEach((mode, k) => {
      let size = 0;
      for (let i = 0; i < this.cases; ++i) size += weights[i] * this.shares[k * this.cases + i];
      if (size !== 0) addMultiple(series, size, mode);
    });
    return new MovingMesh(this, series);
  }
  caseOf(i) { return this.sum(Float64Array.from({length: this.cases}, (_, n) => n === i ? 1 : 0)); }
}

/// What the page shows of a case in a mesh, in place of a field.
class MovingMesh {
  constructor(motion, series) { Object.assign(this, {motion, series, duration: motion.duration}); }
  /// The displacements of all points at the sampled length that is nearest to t.
  displacements(t, out) {
    const {motion: {slices, moving}, series} = this, count = moving.length, slice = Math.round(clamp(t / this.duration, 0, 1) * slices) - 1;
    for (let a = 0; a < count; ++a)
      for (let c = 0; c < 3; ++c) out[3 * moving[a] + c] = slice < 0 ? 0 : series[(c * slices + slice) * count + a];
  }
  /// Of each cut pairs of place and opening, mm.
  profiles(t) {
    const {motion} = this, {rest} = motion;
    this.scratch = this.scratch || new Float64Array(rest.length);
    this.displacements(t, this.scratch);
    const d = this.scratch;
    return motion.cuts.map(({begin, left, right, places}) => places.map((place, k) => {
      const l = 3 * left[k], r = 3 * right[k];
      return [begin + place, Math.hypot(d[r] - d[l] + rest[r] - rest[l], d[r + 1] - d[l + 1] + rest[r + 1] - rest[l + 1],
                                        d[r + 2] - d[l + 2] + rest[r + 2] - rest[l + 2])];
    }));
  }
}

class MeshScene {
  constructor(mesh) {
    const {motion} = mesh;
    Object.assign(this, {shape: "mesh", rest: motion.rest, depth: motion.depth, skin: motion.skinCorners, walls: motion.wallCorners,
                         count: motion.points, middle: [0, 0, 0], places: motion.wallPlaces});
    this.displacement = new Float64Array(3 * this.count);
    this.take(mesh);
  }
  take(mesh) { this.mesh = mesh; }
  at(t) {
    this.mesh.displacements(t, this.displacement);
    this.openWalls = 0;
    while (this.openWalls < this.walls.length && this.places[this.openWalls / 3] < t) this.openWalls += 3;
    return this.displacement;
  }
  values(coloring, t, out) {
    const d = this.displacement;
    for (let p = 0; p < this.count; ++p) out[p] = lengthOf(d[3 * p], d[3 * p + 1], d[3 * p + 2]);
    return out;
  }
  largestValue(coloring, out) {
    let largest = 0;
    for (let i = 1; i <= 8; ++i) {
      this.at(this.mesh.duration * i / 8);
      for (const value of this.values(coloring, 0, out)) if (value > largest) largest = value;
    }
    return largest > 0 ? largest : 1;
  }
}
