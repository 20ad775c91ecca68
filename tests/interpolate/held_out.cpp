#include "tests/interpolate/held_out.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "encoder/series.h"

namespace cleft {

namespace {

/// The case whose parameters are nearest, in parts of the study's ranges.
const Field& nearest_to(const StudyInterpolator& study, const std::vector<StudyMember>& members,
                        const CaseParameters& values) {
  const StudyMember* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const StudyMember& member : members) {
    double distance = 0;
    for (const auto& range : study.varying())
      distance += std::pow((member.field.parameters.number(range.name).value() - values.at(range.name)) /
                               (range.greatest - range.least),
                           2);
    if (distance < least) least = distance, nearest = &member;
  }
  return nearest->field;
}

/// Largest distance of each field from the frames, and of the first from the last, over the largest
/// displacement.
struct Distances {
  std::vector<double> from_frames;
  double first_from_last = 0;
};
Distances distances_of(const std::vector<const Field*>& fields, const Series& series) {
  Distances result{std::vector<double>(fields.size()), 0};
  std::vector<Place> places;
  for (const Sample& sample : series.samples) places.push_back({sample.uvw, sample.side, 0});
  std::vector<std::vector<Vec3>> values(fields.size(), std::vector<Vec3>(places.size()));
  for (std::size_t j = 1; j < series.times.size(); ++j) {
    for (Place& place : places) place.t = series.times[j];
    for (std::size_t f = 0; f < fields.size(); ++f) fields[f]->displacements(places, values[f]);
    for (std::size_t n = 0; n < places.size(); ++n) {
      const auto row = series.frames[j].row(static_cast<Eigen::Index>(n));
      for (std::size_t f = 0; f < fields.size(); ++f)
        result.from_frames[f] =
            std::max(result.from_frames[f], norm(values[f][n] - Vec3{row[0], row[1], row[2]}));
      result.first_from_last = std::max(result.first_from_last, norm(values.front()[n] - values.back()[n]));
    }
  }
  for (double& distance : result.from_frames) distance /= series.largest_displacement;
  result.first_from_last /= series.largest_displacement;
  return result;
}

}  // namespace

std::vector<HeldOut> compare_held_out(const StudyInterpolator& study, const std::vector<StudyMember>& members,
                                      const std::string& held) {
  std::vector<HeldOut> list;
  for (const StudyCase& one : published_study_cases(held)) {
    const Field own = read_field(one.field_file);
    const Series series{SnapshotReader(one.field_file.substr(0, one.field_file.size() - 4) + "h5")};
    CaseParameters values;
    for (const auto& range : study.varying()) values[range.name] = own.parameters.number(range.name).value();
    const auto start = std::chrono::steady_clock::now();
    const Field field = study.at(values);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    const Distances d = distances_of({&field, &nearest_to(study, members, values), &own}, series);
    const Interpolation& made = *field.interpolation;
    list.push_back({d.from_frames[0], d.first_from_last, d.from_frames[1], d.from_frames[2],
                    made.estimated_error, made.interpolation_error, made.outside, took.count()});
  }
  return list;
}

double share_within(const std::vector<double>& values, double most) {
  const auto within = std::count_if(values.begin(), values.end(), [&](double x) { return x <= most; });
  return static_cast<double>(within) / static_cast<double>(values.size());
}

}  // namespace cleft
