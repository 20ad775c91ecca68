#include "tradeoff/certificate.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/output_file.h"
#include "base/scratch_folder.h"
#include "base/text.h"
#include "encoder/samples.h"
#include "explorer/study/between_cases.h"
#include "explorer/study/study.h"
#include "params/solve_hash.h"
#include "params/stiffness.h"
#include "params/study.h"
#include "tradeoff/tool.h"

namespace cleft {

namespace {

Parameters whole_parameters(const RecordedParameters& recorded, const std::string& where) {
  return recorded.whole(where, "its cases do not record",
                        ", so that their equations are not known; run the study again");
}

/// What is written at the nodes has to be what the solver would find there.
void check_study(const PublishedStudy& study) {
  const Field field = study.read(0);
  const std::string where = study.path();
  if (field.source) throw InputError(where + ": holds imported data, whose equations are not known");
  const Parameters parameters = whole_parameters(field.parameters, where);
  check_linear(parameters, where);
  if (parameters.skin.edges == SkinEdges::free)
    throw InputError(where + ": " + row_of(parameters, parameters.skin.edges).name +
                     " = free: fields count from a closed frame that is not at rest; set it to held");
  if (field.case_hash != solve_hash(parameters))
    throw InputError(where +
                     ": its cases are no patches that this version solves (bodies, or other defaults); "
                     "the bound is for patches so far");
}

/// A field between the cases, and the case that it stands for.
struct ShownCase {
  std::shared_ptr<const Field> field;
  Parameters parameters;
};

/// Of several cases of one mesh the study's case whose moduli make the bounds least.
struct Reference {
  Parameters parameters;
  std::string name;
};
Reference reference_for(const std::vector<const ShownCase*>& shown, const PublishedStudy& study) {
  Reference best;
  double least = HUGE_VAL;
  for (int i = 0; i < study.size(); ++i) {
    const Parameters moduli = whole_parameters(study.parameters(i), study.path());
    double worst = 1;
    for (const ShownCase* one : shown) {
      const StiffnessRatios ratios = stiffness_ratios(one->parameters, moduli);
      worst = std::max(worst, ratios.least > 0 ? ratios.greatest / ratios.least : HUGE_VAL);
    }
    if (worst >= least) continue;
    least = worst;
    best = {with_moduli_of(shown.front()->parameters, moduli), study.name(i)};
  }
  if (best.name.empty())
    throw InputError(study.path() +
                     ": no case has the springs and the bending stiffness that the others have, by which an "
                     "error is bounded; ask for parameters that are above 0, like those of a case");
  return best;
}

/// The field's displacements at the nodes of an unsolved snapshot, in its frames.
void write_shown(const ShownCase& shown, const std::string& mesh, const std::string& out) {
  const SnapshotReader reader(mesh);
  Snapshot s = reader.snapshot();
  s.parameters = RecordedParameters(shown.parameters);
  std::vector<SnapshotArray> arrays;
  std::vector<double> axes;
  if (s.coordinates) arrays = {canonical_array, frame_array}, axes = reader.point_array(frame_array, 0);
  SnapshotWriter writer(out, s, arrays);
  for (const SnapshotArray& array : arrays) writer.write_array(array, 0, reader.point_array(array, 0));
  std::vector<Place> places;
  for (const Sample& sample : samples_in_field(reader)) places.push_back({sample.uvw, sample.side, 0});
  std::vector<Vec3> values(places.size());
  for (std::size_t frame = 0; frame < s.frames(); ++frame) {
    for (Place& place : places) place.t = s.times[frame];
    shown.field->displacements(places, values);
    for (std::size_t n = 0; n < values.size() && !axes.empty(); ++n)
      values[n] = in_space(values[n], &axes[9 * n]);
    writer.write_frames(frame, values);
  }
  writer.finish(s);
}

Certificate certificate_of(const nlohmann::json& found, const Reference& reference) {
  Certificate one;
  one.reference = reference.name;
  one.most_over_error = found.at("bound_over_error_at_most");
  one.moved = found.at("closed_pairs_moved_mm");
  for (const nlohmann::json& frame : found.at("frames")) {
    one.length_cut.push_back(frame.at("length_cut_mm"));
    one.bound.push_back(frame.at("bound")), one.size.push_back(frame.at("size"));
    if (frame.contains("error")) one.error.push_back(frame.at("error"));
  }
  return one;
}

/// Of cases of one mesh, by one factor.
std::vector<Certificate> of_one_mesh(const std::vector<const ShownCase*>& shown, const PublishedStudy& study,
                                     bool solve, const std::function<void(const std::string&)>& progress) {
  const ScratchFolder work("certify");
  const Reference reference = reference_for(shown, study);
  write_text_file(work / "reference.toml", case_file_text({reference.parameters, {}}));
  progress("making the mesh");
  run_tool("solve", {work / "reference.toml", "--unsolved", "--out", work / "mesh.h5"}, work.path());
  std::vector<std::string> arguments;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    progress("evaluating field " + std::to_string(i + 1) + " of " + std::to_string(shown.size()));
    arguments.push_back(work / ("shown" + std::to_string(i) + ".h5"));
    write_shown(*shown[i], work / "mesh.h5", arguments.back());
  }
  arguments.insert(arguments.end(), {"--reference", work / "reference.toml"});
  if (solve) arguments.emplace_back("--solve");
  progress("bounding the residuals");
  std::vector<Certificate> list;
  for (const nlohmann::json& one : run_tool("residual", arguments, work.path()))
    list.push_back(certificate_of(one, reference));
  return list;
}

}  // namespace

std::vector<Certificate> certificates(const std::string& path, const std::vector<ParametersByName>& points,
                                      bool solve, const std::function<void(const std::string&)>& progress) {
  const PublishedStudy study(path);
  check_study(study);
  const BetweenCases between(path);
  between.wait([&](double) { progress("reading the study"); });
  std::vector<ShownCase> shown;
  Mistakes mistakes;
  for (const ParametersByName& values : points)
    mistakes.collect([&] {
      const auto field = between.at(values);
      shown.push_back({field, whole_parameters(field->parameters, path)});
    });
  mistakes.throw_if_any();

  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < shown.size(); ++i)
    groups[mesh_and_release_key(shown[i].parameters)].push_back(i);
  std::vector<Certificate> list(points.size());
  for (const auto& [key, members] : groups) {
    std::vector<const ShownCase*> some;
    for (const std::size_t i : members) some.push_back(&shown[i]);
    const std::vector<Certificate> found = of_one_mesh(some, study, solve, progress);
    for (std::size_t k = 0; k < members.size(); ++k) list[members[k]] = found.at(k);
  }
  for (std::size_t i = 0; i < points.size(); ++i) list[i].values = points[i];
  return list;
}

}  // namespace cleft
