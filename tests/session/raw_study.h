// A study of two cases, of which the first has its simulation: frame 0 displaced by a constant, the others
// the field's displacement and a known error.
#pragma once

#include <filesystem>
#include <fstream>

#include "encoder/field/file/field_file.h"
#include "solver/snapshot/snapshot.h"
#include "tests/support/recorded.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/synthetic_field.h"

namespace cleft {

/// mm: of a node, at every frame but the first.
inline Vec3 made_error(const Vec3& uvw) { return {0, 0, 0.001 * (40 + uvw.x)}; }

inline Snapshot raw_snapshot() {
  Snapshot s;
  for (int i = -15; i <= 15; ++i)
    for (int j = -10; j <= 10; ++j)
      for (int k = 0; k <= 4; ++k) s.points.push_back({2. * i, 2. * j, -3. * k});
  s.cut_start = -15, s.cut_length = 30, s.cut_depth = 6;
  const std::size_t single = s.points.size();
  for (std::size_t n = 0; n < single; ++n)
    if (const Vec3 p = s.points[n]; p.y == 0 && std::abs(p.x) < 15 && p.z > -6) {
      s.pairs.push_back({static_cast<int>(n), static_cast<int>(s.points.size())});
      s.points.push_back(p);
    }
  s.times = {0, 10, 20, 30};
  for (const double t : s.times) {
    s.position.push_back(t - 15);
    int open = 0;
    for (const auto& [left, right] : s.pairs)
      if (s.points[left].x < t - 15) ++open;
    s.released.push_back(open);
  }
  s.cell_offsets = {0};
  s.smallest_gap = s.residual_equilibrium = s.residual_closure = s.times;
  s.case_hash = "case0";
  s.parameters = recorded({{"skin.prestress_v", 0.02}});
  return s;
}

inline const std::string& raw_study() {
  static const TemporaryFolder folder;
  static const std::string study = [] {
    for (const int number : {0, 1}) {
      const std::string name = "case" + std::to_string(number), place = folder / ("study/cases/" + name);
      std::filesystem::create_directories(place);
      Field field = synthetic_field(3 + number);
      field.parameters = recorded({{"skin.prestress_v", 0.02 + 0.01 * number}, {"cut.depth", 6}});
      field.case_hash = name;
      write_field(place + "/case.dffd", field);
      std::ofstream(place + "/manifest.json") << "{}";
    }
    const std::string place = folder / "study/cases/case0";
    const Field field = read_field(place + "/case.dffd");  // as it was coded
    const Snapshot s = raw_snapshot();
    SnapshotWriter writer(place + "/case.h5", s);
    const std::size_t lefts = s.points.size() - s.pairs.size();
    for (std::size_t j = 0; j < s.frames(); ++j) {
      std::vector<Vec3> frame;
      for (std::size_t n = 0; n < s.points.size(); ++n) {
        const Vec3& p = s.points[n];
        const bool cut = p.y == 0 && std::abs(p.x) < 15 && p.z > -6;
        const Side side = !cut ? side_of(p.y) : n < lefts ? Side::left : Side::right;
        const Vec3 constant{0.5, 0.25, -1};
        frame.push_back(j == 0 ? constant
                               : constant + field.displacement(p, side, s.times[j]) + made_error(p));
      }
      writer.write_frames(j, frame);
    }
    writer.finish(s);
    return folder / "study";
  }();
  return study;
}

}  // namespace cleft
