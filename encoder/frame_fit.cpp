#include "encoder/frame_fit.h"

#include <algorithm>
#include <numeric>

namespace cleft {

namespace {

constexpr double of_middles = 0.03;  // the weight of edges: more bends the opening next to a front
constexpr double of_middles_open = 0.01, of_middles_at_front = 0.003;  // of lips
constexpr double of_middles_firm = 0.2;                                // where knots are as close as nodes
constexpr double of_middles_slight = 0.003;                            // where nodes nearly determine all
constexpr int enough = 8;  // nodes a control point, in any piece along the cut

/// Where the basis along interpolates: pieces between such knots share no function but at their ends.
struct Piece {
  double front, back;  // along
  int functions;
};
std::vector<Piece> pieces_of(const BSplineBasis& along) {
  std::vector<Piece> pieces;
  const auto& knots = along.knots();
  const std::size_t p = static_cast<std::size_t>(along.degree());
  double front = along.front();
  int spans = 0;
  for (std::size_t i = p + 1; i + p < knots.size(); ++i) {
    if (knots[i] > knots[i - 1]) ++spans;
    if (knots[i] > front && knots[i] == knots[i + p - 1]) {
      pieces.push_back({front, knots[i], spans + along.degree()});
      front = knots[i], spans = 0;
    }
  }
  return pieces;
}

}  // namespace

FrameFit::FrameFit(const Series& series, const Parametrization& parametrization,
                   const std::array<BSplineBasis, 3>& bases, Hold hold)
    : series_(series),
      parametrization_(parametrization),
      bases_(bases),
      nodes_(parametrization, bases, series.samples) {
  if (hold == Hold::slight) {
    std::vector<std::size_t> all(series.middles.samples.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    add_group(series.middles, all, std::vector<bool>(series.times.size(), true), of_middles_slight);
    return;
  }
  std::vector<double> u;
  for (const Sample& sample : series.samples) u.push_back(sample.uvw.x);
  std::sort(u.begin(), u.end());
  std::vector<double> columns = u;
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  const auto within = [](const std::vector<double>& places, double front, double back) {
    return std::upper_bound(places.begin(), places.end(), back) -
           std::lower_bound(places.begin(), places.end(), front);
  };
  std::vector<bool> sparse(series.times.size(), false), inside(series.centres.samples.size(), false),
      held(hold == Hold::firm || series.middles_hold ? series.middles.samples.size() : 0, false);
  const int section = bases[1].size() * bases[2].size();
  const double tiny = 1e-8 * (u.back() - u.front());
  for (std::size_t j = series.from_zero ? 1 : 0; j < series.times.size(); ++j)
    for (const Piece& piece : pieces_of(bases[0])) {
      const double front = parametrization.u_at(piece.front, series.times[j]),
                   back = parametrization.u_at(piece.back, series.times[j]);
      if (within(u, front, back) >= enough * piece.functions * section &&
          within(columns, front, back) >= piece.functions)
        continue;
      sparse[j] = true;
      for (std::size_t c = 0; c < inside.size(); ++c)
        if (const double at = series.centres.samples[c].uvw.x; front < at && at < back) inside[c] = true;
      for (std::size_t c = 0; c < held.size(); ++c)
        if (const double at = series.middles.samples[c].uvw.x; front - tiny <= at && at <= back + tiny)
          held[c] = true;
    }
  std::vector<std::size_t> at_plane, others, middles;
  for (std::size_t c = 0; c < inside.size(); ++c)
    if (series.centres.touches_plane[c])
      at_plane.push_back(c);
    else if (inside[c])
      others.push_back(c);
  std::vector<std::size_t> on_lips;
  for (std::size_t c = 0; c < held.size(); ++c)
    if (held[c]) (series.from_zero && series.middles.samples[c].uvw.y == 0 ? on_lips : middles).push_back(c);
  if (series.geometry.cut.length > 0)
    add_group(series.centres, at_plane, std::vector<bool>(sparse.size(), true));
  add_group(series.centres, others, sparse);
  add_group(series.middles, middles, sparse, hold == Hold::firm ? of_middles_firm : of_middles);
  add_group(series.middles, on_lips, sparse, of_middles_at_front);
  add_lips(on_lips, sparse);
}

/// Lips close as a root next to the front, which edges there would straighten: an edge holds them from the
/// frame on in which both of its ends are open; the later that is, the fewer frames are told apart.
void FrameFit::add_lips(const std::vector<std::size_t>& edges, const std::vector<bool>& sparse) {
  const std::size_t frames = sparse.size();
  std::vector<std::size_t> opens(series_.samples.size(), frames), both(edges.size(), 0);
  for (std::size_t p = 0; p < series_.pairs.size(); ++p) {
    const auto open = std::upper_bound(series_.released.begin(), series_.released.end(), static_cast<int>(p));
    for (const std::int32_t n : series_.pairs[p])
      opens[n] = std::min(opens[n], static_cast<std::size_t>(open - series_.released.begin()));
  }
  const CellCentres& middles = series_.middles;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (std::size_t k = middles.first[edges[e]]; k < middles.first[edges[e] + 1]; ++k)
      both[e] = std::max(both[e], opens[middles.nodes[k]]);
  for (std::size_t before = 0, from = 1; from < frames; before = from, from += 1 + from / 4) {
    std::vector<bool> of_frame = sparse;
    std::fill(of_frame.begin(), of_frame.begin() + static_cast<std::ptrdiff_t>(from), false);
    if (std::find(of_frame.begin(), of_frame.end(), true) == of_frame.end()) continue;
    std::vector<std::size_t> open;
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (before < both[e] && both[e] <= from) open.push_back(edges[e]);
    add_group(middles, open, of_frame, of_middles_open);
  }
}

void FrameFit::add_group(const CellCentres& all, const std::vector<std::size_t>& cells,
                         std::vector<bool> of_frame, double weight) {
  if (cells.empty()) return;
  CellCentres centres = all.only(cells);
  SpaceFit fit(parametrization_, bases_, centres.samples);
  std::optional<FrontCentres> fronts;
  if (series_.quadratic && weight == 1) fronts.emplace(centres, series_.samples, series_.pairs);
  groups_.push_back({std::move(centres), std::move(fit), std::move(of_frame), std::move(fronts), weight});
}

SpaceFit::Normal FrameFit::normal(std::size_t frame, double strength) const {
  const double t = series_.times[frame];
  SpaceFit::Normal sum = nodes_.normal(t, 0);
  for (const Group& group : groups_)
    if (group.of_frame[frame]) sum.add(group.weight, group.fit.normal(t, 0));
  nodes_.roughen(sum, strength);
  return sum;
}

Eigen::MatrixX3d FrameFit::project(std::size_t frame, const Eigen::Ref<const Eigen::MatrixX3d>& d) const {
  const double t = series_.times[frame];
  Eigen::MatrixX3d sum = nodes_.project(d, t);
  for (const Group& group : groups_)
    if (group.of_frame[frame]) {
      Eigen::MatrixX3d means = group.centres.mean(d);
      if (group.fronts) {
        const double start = series_.geometry.cut.start;
        group.fronts->correct(means, d, {start, start + t});
      }
      sum += group.weight * group.fit.project(means, t);
    }
  return sum;
}

Eigen::MatrixX3d FrameFit::values(const Eigen::MatrixX3d& x, std::size_t frame) const {
  return nodes_.values(x, series_.times[frame]);
}

double FrameFit::bytes() const {
  double sum = nodes_.bytes();
  for (const Group& group : groups_) sum += group.fit.bytes();
  return sum;
}

}  // namespace cleft
