// cross_validate STUDY HELD_OUT: how far cleft interpolate is off at cases that it did not see, and what it
// says of itself. HELD_OUT is a study folder, with the snapshots of its cases.
#include <algorithm>
#include <cstdio>

#include "base/command.h"
#include "base/error.h"
#include "encoder/field/field_file.h"
#include "encoder/field/study_file.h"
#include "encoder/interpolate/study_interpolator.h"
#include "encoder/series.h"

using namespace cleft;

namespace {

struct Row {
  double estimate, interpolation_estimate;  ///< what the field says of itself
  double raw, own;      ///< its error against the simulation's frames, and against their own field
  double nearest, fit;  ///< errors against the frames: of the nearest case's field, of the own field
  double milliseconds, outside;
};

/// Largest distances over all nodes and frames, over the largest displacement.
Row compare(const Field& interpolated, const Field& nearest, const Field& own, const Series& series) {
  Row row{};
  std::vector<Place> places;
  for (const Sample& sample : series.samples) places.push_back({sample.uvw, sample.side, 0});
  std::vector<Vec3> a(places.size()), b(places.size()), c(places.size());
  for (std::size_t j = 1; j < series.times.size(); ++j) {
    for (Place& place : places) place.t = series.times[j];
    interpolated.displacements(places, a), nearest.displacements(places, b), own.displacements(places, c);
    for (std::size_t n = 0; n < places.size(); ++n) {
      const auto i = static_cast<Eigen::Index>(n);
      const Vec3 truth{series.frames[j](i, 0), series.frames[j](i, 1), series.frames[j](i, 2)};
      row.raw = std::max(row.raw, norm(a[n] - truth)),
      row.nearest = std::max(row.nearest, norm(b[n] - truth));
      row.fit = std::max(row.fit, norm(c[n] - truth)), row.own = std::max(row.own, norm(a[n] - c[n]));
    }
  }
  for (double* error : {&row.raw, &row.nearest, &row.fit, &row.own}) *error /= series.largest_displacement;
  return row;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <class Function>
std::vector<double> each(const std::vector<Row>& rows, const Function& function) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back(function(row));
  return values;
}

double share(const std::vector<double>& values, double most) {
  return static_cast<double>(
             std::count_if(values.begin(), values.end(), [&](double x) { return x <= most; })) /
         static_cast<double>(values.size());
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Interpolates a study at the cases of another and compares with their simulations.",
               "cross_validate");
  std::string study, held;
  bool json = false;
  app.add_option("STUDY", study, "study folder or study.dffd")->required();
  app.add_option("HELD_OUT", held, "study folder of cases that are not in STUDY")->required();
  app.add_flag("--json", json, "print the figures as JSON");
  return run_command(app, argc, argv, [&] {
    auto start = std::chrono::steady_clock::now();
    const StudyInterpolator interpolator(study);
    const double load_seconds = seconds_since(start);
    const auto members = read_members(study);
    std::vector<Row> rows;
    for (const StudyCase& one : published_fields(held)) {
      const Field own = read_field(one.field_file);
      const Series series{SnapshotReader(one.field_file.substr(0, one.field_file.size() - 4) + "h5")};
      CaseParameters values;
      for (const auto& range : interpolator.varying()) values[range.name] = own.parameters.at(range.name);
      start = std::chrono::steady_clock::now();
      const Field field = interpolator.at(values);
      const double took = 1e3 * seconds_since(start);
      const StudyMember* nearest = nullptr;
      double least = 1e300;
      for (const StudyMember& member : members) {
        double distance = 0;
        for (const auto& range : interpolator.varying())
          distance += std::pow(
              (member.field.parameters.at(range.name) - values[range.name]) / (range.greatest - range.least),
              2);
        if (distance < least) least = distance, nearest = &member;
      }
      Row row = compare(field, nearest->field, own, series);
      row.estimate = field.interpolation->estimated_error,
      row.interpolation_estimate = field.interpolation->interpolation_error;
      row.milliseconds = took, row.outside = field.interpolation->outside;
      std::fprintf(stderr,
                   "%s estimate %.4f (%.4f) raw %.4f own %.4f nearest %.4f fit %.4f outside %.3f %.1f ms\n",
                   one.name.c_str(), row.estimate, row.interpolation_estimate, row.raw, row.own, row.nearest,
                   row.fit, row.outside, row.milliseconds);
      rows.push_back(row);
    }
    if (rows.empty()) throw InputError(held + ": no published cases");
    Json features = Json::array();
    for (const std::string& name : interpolator.features().names()) features.push_back(name);
    const auto& kernel = interpolator.regression().covariance();
    print_figures(
        {{"cases", interpolator.cases().size()},
         {"held_out", rows.size()},
         {"features", features},
         {"method", kernel.name},
         {"degree", kernel.degree},
         {"nugget", kernel.nugget},
         {"lengths", std::vector<double>(kernel.lengths.begin(), kernel.lengths.end())},
         {"load_seconds", load_seconds},
         {"left_out_l2", interpolator.regression().left_out_error()},
         {"left_out_median",
          median({interpolator.left_out_errors().begin(), interpolator.left_out_errors().end()})},
         {"median_error", median(each(rows, [](const Row& r) { return r.raw; }))},
         {"median_error_against_own_field", median(each(rows, [](const Row& r) { return r.own; }))},
         {"median_fit_error", median(each(rows, [](const Row& r) { return r.fit; }))},
         {"median_nearest", median(each(rows, [](const Row& r) { return r.nearest; }))},
         {"share_within_twice_the_estimate",
          share(each(rows, [](const Row& r) { return r.raw / r.estimate; }), 2)},
         {"median_estimate_over_error", median(each(rows, [](const Row& r) { return r.estimate / r.raw; }))},
         {"own_share_within_twice_the_estimate",
          share(each(rows, [](const Row& r) { return r.own / r.interpolation_estimate; }), 2)},
         {"own_median_estimate_over_error",
          median(each(rows, [](const Row& r) { return r.interpolation_estimate / r.own; }))},
         {"share_below_a_fifth_of_the_nearest",
          share(each(rows, [](const Row& r) { return r.raw / r.nearest; }), 0.2)},
         {"median_part_of_the_nearest", median(each(rows, [](const Row& r) { return r.raw / r.nearest; }))},
         {"median_milliseconds", median(each(rows, [](const Row& r) { return r.milliseconds; }))}},
        json);
  });
}
