// cleft check: verifies snapshots, fields and whole studies.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

#include "base/command/command.h"
#include "base/error.h"
#include "base/h5/h5.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/pieces_at_nodes.h"
#include "encoder/field/file/study_file.h"
#include "params/run/study_folder.h"
#include "solver/snapshot/snapshot.h"

using namespace cleft;

namespace {

void check_study_file(const std::string& file) {
  const StudyFile study(file);
  for (int i = 0; i < study.size(); ++i) study.field(i);
  h5::File::open(file).read_everything();
}

void check_field_file(const std::string& file) {
  if (pieces_in(file) > 0) {
    read_blended(file);
    nodes_in(file);
    h5::File::open(file).read_everything();
    return;
  }
  const Field field = read_field(file);
  read_residual(file);
  for (std::size_t q = 0; q < field.quantities.size(); ++q) read_quantity_residual(file, q);
  h5::File::open(file).read_everything();
}

void check_file(const std::string& file) {
  const std::string format = format_of(file);
  if (format == "cleft-snapshot")
    check_snapshot(file);
  else if (format == "cleft-field")
    check_field_file(file);
  else if (format == "cleft-study")
    check_study_file(file);
  else
    throw FileError(file, "is neither a snapshot nor a field nor a study");
}

/// Control points are equal bit for bit; those of a sum of modes are on finer knots, and its error at nodes
/// is at most its modes/error.
bool same_field(const Field& packed, const Field& published, double modes_error) {
  if (modes_error == 0) return packed.coefficients() == published.coefficients();
  const auto& domain = published.parametrization().domain();
  const auto at = [&](int axis, int step, int steps) {
    return domain[axis].front + (domain[axis].back - domain[axis].front) * step / steps;
  };
  constexpr int steps = 12;
  double largest = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      for (int k = 0; k <= steps; ++k)
        for (int l = 1; l <= 4; ++l) {
          const Vec3 uvw{at(0, i, steps), at(1, j, steps), at(2, k, steps)};
          const double t = at(3, l, 4);
          largest = std::max(largest, norm(packed.displacement(uvw, Side::both, t) -
                                           published.displacement(uvw, Side::both, t)));
        }
  return largest <= 1.5 * modes_error * published.report.largest_displacement;
}

/// A study's file holds the fields of its published cases, and no others.
void check_packed(const std::string& packed, const std::string& folder) {
  const StudyFile study(packed);
  h5::File::open(packed).read_everything();
  const auto stale = [&](const std::string& what) {
    throw FileError(packed, what + "; run cleft pack " + folder + " again");
  };
  std::map<std::string, std::string> published;
  for (const StudyCase& one : published_study_cases(folder)) published[one.name] = one.field_file;
  for (int i = 0; i < study.size(); ++i) {
    const Field field = study.field(i);
    const auto found = published.find(study.name(i));
    if (found == published.end()) stale("holds case " + study.name(i) + ", which is not published");
    if (!same_field(field, read_field(found->second), study.modes_error(i)))
      stale("holds another field than the published case " + study.name(i));
    published.erase(found);
  }
  if (!published.empty()) stale("lacks the published case " + published.begin()->first);
}

/// Says what there is to know of a sound one.
std::string check_study(const std::string& path) {
  const StudyFolder folder(path);
  Mistakes mistakes;
  std::size_t without = 0;
  std::vector<std::string> older;
  for (const std::string& hash : folder.published_cases())
    mistakes.collect([&] {
      folder.verify(hash);
      if (const std::string field = folder.published(hash) + "/case.dffd"; is_older_field(field))
        older.push_back(hash);
      else
        check_file(field);
      if (folder.manifest(hash).value("snapshot", "kept") == "dropped")
        ++without;
      else
        check_file(folder.published(hash) + "/case.h5");
    });
  if (const std::string packed = path + "/study.dffd"; std::filesystem::exists(packed))
    mistakes.collect([&] { check_packed(packed, path); });
  mistakes.throw_if_any();
  std::string verdict = "sound";
  if (without > 0)
    verdict += "; " + std::to_string(without) + " cases without raw data (keep_snapshots = \"none\")";
  if (!older.empty()) verdict += "; " + note_of_older(path, older);
  return verdict;
}

void check_all(const std::vector<std::string>& places) {
  Mistakes mistakes;
  for (const std::string& place : places) {
    std::string verdict = "sound";
    const bool sound = mistakes.collect([&] {
      if (std::filesystem::is_directory(place))
        verdict = check_study(place);
      else
        check_file(place);
    });
    if (sound) std::cout << place << ": " << verdict << "\n";
  }
  mistakes.throw_if_any();
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Reads every byte of files, or of a study's published cases, and verifies checksums and schemas.",
      "cleft check");
  std::vector<std::string> places;
  app.add_option("FILE|DIR", places, "snapshots, fields or study folders")->required();
  return run_command(app, argc, argv, [&] { check_all(places); });
}
