// What a field costs to evaluate, measured within one run: medians, every figure next to what it is compared
// with. cleft-benchmark-field
#include <chrono>
#include <cstdio>
#include <random>
#include <string>

#include "base/quantiles.h"
#include "encoder/field/field.h"
#include "explorer/wound/replay_pieces.h"

using namespace cleft;

namespace {

/// Keeps the compiler from leaving out what is measured.
double kept = 0;

/// Median nanoseconds of a call over `rounds`, divided by what it does.
template <class Function>
double nanoseconds(int rounds, std::size_t things, const Function& function) {
  std::vector<double> times;
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    function();
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    times.push_back(time.count() / static_cast<double>(things));
  }
  return median(times);
}

/// 22 x 14 x 9 x 13 random control points over a patch of 60 x 40 x 8 mm with a cut of 24 mm.
Field make_field(const std::string& parametrization) {
  const CanonicalCut cut{-12, 24, 3};
  FieldGeometry geometry{{{{-30, 30}, {-20, 20}, {-8, 0}, {0, 24}}}, cut, {{0, 24}, {-12, 12}}};
  std::array<BSplineBasis, 4> bases{BSplineBasis::uniform(3, 22, -30, 30),
                                    BSplineBasis::broken(3, 14, -20, 0, 20),
                                    BSplineBasis::uniform(3, 9, -8, 0), BSplineBasis::uniform(3, 13, 0, 24)};
  if (parametrization == "tip")
    bases = {BSplineBasis(3, {0,   0, 0, 0, 0.3, 0.6, 0.8, 1,   1,   1, 1.2, 1.4, 1.5,
                              1.7, 2, 2, 2, 2.1, 2.2, 2.4, 2.6, 2.8, 3, 3,   3,   3}),
             BSplineBasis::broken(3, 14, -1, 0, 1),
             BSplineBasis(3, {-2, -2, -2, -2, -1.5, -1, -1, -1, -0.5, 0, 0, 0, 0}),
             BSplineBasis::uniform(3, 13, 0, 1)};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t count = 1;
  for (const BSplineBasis& basis : bases) count *= static_cast<std::size_t>(basis.size());
  std::vector<Vec3> coefficients(count);
  for (Vec3& c : coefficients) c = {uniform(random), uniform(random), uniform(random)};
  return {make_parametrization(parametrization, std::move(geometry)), bases, std::move(coefficients)};
}

/// 100 x 100 points of a curved surface, row after row, at one time.
std::vector<Place> coherent_places() {
  std::vector<Place> places;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) {
      const double u = -29.7 + 0.6 * j, v = -19.9 + 0.4 * i;
      places.push_back({{u, v, -0.001 * (u * u + v * v)}, Side::both, 13.7});
    }
  return places;
}

std::vector<Place> random_places() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Place> places(10000);
  for (Place& p : places)
    p = {
        {-30 + 60 * unit(random), -20 + 40 * unit(random), -8 * unit(random)}, Side::both, 24 * unit(random)};
  return places;
}

/// Median nanoseconds a place, over slices so short that hardly any is interrupted.
template <class Function>
double a_place(const std::vector<Place>& places, const Function& evaluate) {
  constexpr std::size_t slice = 500;
  std::vector<Vec3> out(slice);
  std::vector<double> times;
  for (int round = 0; round < 20; ++round)
    for (std::size_t begin = 0; begin + slice <= places.size(); begin += slice) {
      times.push_back(
          nanoseconds(1, slice, [&] { evaluate(std::span(places).subspan(begin, slice), std::span(out)); }));
      kept += out[slice / 2].x;
    }
  return median(times);
}

void evaluation(Field& field) {
  const std::vector<Place> coherent = coherent_places(), random = random_places();
  std::printf("%-8s ns a point:        coherent   random\n", field.parametrization().name().c_str());
  const auto print = [&](const char* kernel, const char* what, const auto& evaluate) {
    std::printf("  %-7s %-14s %8.1f %8.1f\n", kernel, what, a_place(coherent, evaluate),
                a_place(random, evaluate));
  };
  for (const Kernel kernel : available_kernels()) {
    field.use(kernel);
    print(name_of(kernel), "batch",
          [&](std::span<const Place> places, std::span<Vec3> out) { field.displacements(places, out); });
    print(name_of(kernel), "one at a time", [&](std::span<const Place> places, std::span<Vec3> out) {
      for (std::size_t i = 0; i < places.size(); ++i)
        out[i] = field.displacement(places[i].uvw, places[i].side, places[i].t);
    });
    print(name_of(kernel), "derivatives", [&](std::span<const Place> places, std::span<Vec3> out) {
      for (std::size_t i = 0; i < places.size(); ++i)
        out[i] = field.derivatives(places[i].uvw, places[i].side, places[i].t).by_t;
    });
  }
  CollapsedField collapsed;
  field.collapse(3, collapsed);
  const double once = nanoseconds(41, 1, [&] { field.collapse(13.7, collapsed); });
  print("", "collapsed",
        [&](std::span<const Place> places, std::span<Vec3> out) { collapsed.displacements(places, out); });
  std::printf("  collapsing to one t: %.1f us\n", 1e-3 * once);
}

void contraction(const Field& field) {
  const std::vector<Place> places = random_places();
  History history;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6}) {
    double pieces = 0;
    std::vector<double> times;
    for (std::size_t i = 0; i < 1000; ++i) {
      times.push_back(
          nanoseconds(1, 1, [&] { field.contract(places[i].uvw, places[i].side, tolerance, history); }));
      pieces += static_cast<double>(history.controls.size());
    }
    std::printf("  contraction to %.0e: %8.2f us a point, %6.1f pieces a history\n", tolerance,
                1e-3 * median(times), pieces / 1000);
    if (!field.parametrization().moves()) break;
  }
}

/// A plain sum of everything in memory.
template <class T>
double sum_of(const T* memory, std::size_t count) {
  const auto* values = reinterpret_cast<const double*>(memory);
  const std::size_t size = count * sizeof(T) / sizeof(double);
  double sums[16]{};
  for (std::size_t i = 0; i + 16 <= size; i += 16)
    for (std::size_t k = 0; k < 16; ++k) sums[k] += values[i + k];
  for (std::size_t k = 1; k < 16; ++k) sums[0] += sums[k];
  return sums[0];
}

/// 10,000 vertices about the cut, frame after frame from one end of it to the other.
void replay(const Field& field, double tolerance) {
  const std::vector<Place> places = random_places();
  const Field* const fields[] = {&field};
  const std::vector<double> times = replay_times(fields, tolerance);
  std::vector<int> vertices;
  std::vector<Vec3> rest, out(places.size());
  for (const Place& p : places) vertices.push_back(static_cast<int>(vertices.size())), rest.push_back(p.uvw);
  const std::vector<double> offsets(places.size());
  ReplayPieces pieces(times, offsets, vertices);
  History history;
  for (const Place& p : places) {
    field.contract(p.uvw, p.side, tolerance, times, history);
    pieces.append(history);
  }
  const std::size_t spans = times.size() - 1, blocks = pieces.blocks().size() / spans, frames = 200;
  std::vector<double> frame_times, read_times;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const double s = 24. * static_cast<double>(frame) / frames;
    const auto span =
        static_cast<std::size_t>(std::upper_bound(times.begin(), times.end() - 1, s) - times.begin() - 1);
    // Of another span: not what has just been read.
    const std::size_t other = (span + spans / 2) % spans;
    frame_times.push_back(nanoseconds(1, 1, [&] { pieces.positions(s, rest.data(), out.data()); }));
    read_times.push_back(nanoseconds(1, 1, [&] {
      kept += sum_of(&pieces.blocks()[other * blocks], blocks) + sum_of(rest.data(), rest.size()) +
              sum_of(offsets.data(), offsets.size()) + sum_of(vertices.data(), vertices.size());
    }));
    kept += out[5].x;
  }
  const double frame = median(frame_times), read = median(read_times);
  const double bytes = static_cast<double>(blocks * sizeof(PieceBlock) +
                                           places.size() * (sizeof(Vec3) + sizeof(double) + sizeof(int)));
  std::printf(
      "  replay to %.0e: %.1f us a frame of 10,000 vertices, %.2f times reading its %.2f MB; %zu spans of "
      "time, %.1f %% of the pieces divided\n",
      tolerance, 1e-3 * frame, frame / read, 1e-6 * bytes, spans,
      100. * static_cast<double>(pieces.exceptions()) / static_cast<double>(spans * places.size()));
}

}  // namespace

int main() {
  for (const std::string name : {"fixed", "tip"}) {
    Field field = make_field(name);
    evaluation(field);
    contraction(field);
    replay(field, 1e-2);
  }
  return kept == 12345.678;
}
