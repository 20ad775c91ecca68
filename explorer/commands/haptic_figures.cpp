#include "explorer/commands/haptic_figures.h"

#include <algorithm>

#include "explorer/io/mesh_file.h"
#include "explorer/wound/mesh_cuts.h"
#include "explorer/wound/tissue_colors.h"

namespace cleft {

namespace {

Json quantiles_us(const TimeHistogram& h) {
  return {{"p50", 1e6 * h.quantile(0.5)},
          {"p99", 1e6 * h.quantile(0.99)},
          {"p99.9", 1e6 * h.quantile(0.999)},
          {"max", 1e6 * h.largest()}};
}

}  // namespace

Json figures_of(const HapticLoop& loop, const ScalpelCutting& cutting) {
  const LoopStatistics& s = loop.statistics();
  return {{"seconds", loop.state().time},
          {"ticks", s.ticks},
          {"stiffness_N_per_mm", loop.model().stiffness()},
          {"largest_force_N", s.largest_force},
          {"largest_change_N", s.largest_change},
          {"change_beyond_permitted_N", s.excess_change},
          {"energy_put_in_Nmm", -loop.passivity().delivered()},
          {"energy_created_Nmm", loop.passivity().created()},
          {"punctures", loop.state().punctures},
          {"last_puncture_N", loop.model().last_puncture_force()},
          {"softest_puncture_N_per_mm", loop.model().puncture_stiffness()[0]},
          {"firmest_puncture_N_per_mm", loop.model().puncture_stiffness()[1]},
          {"cuts", cutting.cut_length() > 0 ? cutting.incisions() : 0},
          {"cut_mm", cutting.cut_length()},
          {"triangles_cut", cutting.figures().triangles_cut},
          {"cut_steps", cutting.figures().cuts},
          {"stopped", cutting.figures().stopped}};
}

void add_times(Json& figures, HapticLoop& loop, const BareTimer& bare, const ScalpelCutting& cutting) {
  const LoopStatistics& s = loop.statistics();
  const CuttingFigures& c = cutting.figures();
  const auto named = std::min<std::uint64_t>(s.overruns, s.overrun_ticks.size());
  figures.update({{"compute_us", quantiles_us(s.compute)},
                  {"lateness_us", quantiles_us(s.lateness)},
                  {"bare_timer_compute_us", quantiles_us(bare.compute)},
                  {"bare_timer_lateness_us", quantiles_us(bare.lateness)},
                  {"page_faults", s.page_faults},
                  {"overruns", s.overruns},
                  {"overrun_ticks",
                   std::vector<std::uint64_t>(s.overrun_ticks.begin(), s.overrun_ticks.begin() + named)},
                  {"missed_ticks", s.missed},
                  {"ticks_not_cut", loop.for_cutting().dropped()},
                  {"real_time_refused", loop.refused()},
                  {"cut_step_us", quantiles_us(c.cut)},
                  {"grid_update_us", quantiles_us(c.update)},
                  {"wound_us", quantiles_us(c.open)}});
}

void write_cut_mesh(const std::string& file, ScalpelCutting& cutting, double scale) {
  const CutMesh& mesh = cutting.mesh();
  SurfaceMesh surface = mesh.surface();
  PointArray displacement{"displacement", 3, {}};
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    surface.points[v] = cutting.position(static_cast<int>(v));
    const Vec3 d = surface.points[v] - mesh.position(static_cast<int>(v));
    displacement.values.insert(displacement.values.end(), {d.x, d.y, d.z});
  }
  surface.colors = with_tissue(cutting.colors(), depth_fractions_of(mesh));
  write_mesh(file, surface,
             {displacement, {"depth", 1, depths_of(mesh, scale)}, {"region", 1, regions_of(mesh)}});
}

}  // namespace cleft
