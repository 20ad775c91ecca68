// The cheapest setting of the chain whose error is within a bound, from measurements of each source of error
// in cheap cases.
//
// An error is a difference of openings (right lip minus left lip) over the cut and over time; its size is its
// largest norm over the largest opening. Each source of error is measured where it is cheap:
//
//   patch    against one that is far wider, in a coarse mesh
//   mesh     nodes of two coarse meshes against each other, in a patch that errs little; it goes as the
//            element's size, as the energy of a crack does; of linear elements, and of quadratic ones where
//            they may pay and serve (mesh_errors.h)
//   tip      the field against its own mesh between nodes and frames, where the lips close as the square root
//            of the distance from the tip, at three sizes (two of quadratic elements); finer ones go on with
//            the order of the last two; or what the mesh's first node there is off, if that is more
//   code     what a looser tolerance adds, at the finest of those meshes, encoded where the choice needs it;
//            none beyond half the error is taken
//   model    small strains against finite ones, in a coarse mesh (model_error.h)
//   detail   what a replay leaves alone, on both lips
//
// Patch, mesh and tip may add or cancel: their differences are added with their signs before their size is
// taken. That of the tip is often largest elsewhere: where the root of both squares is more, it counts. The
// others are added. Mesh, patch, tip and code are measured with small strains, and are the same parts of the
// opening with finite ones. The model counts where it can be chosen, with its sign too, but never less than
// it is alone: an error of the mesh may not make up for it.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "params/parameters/parameters.h"
#include "tradeoff/mesh_errors.h"
#include "tradeoff/model_error.h"
#include "tradeoff/setting.h"

namespace cleft {

/// Estimates for a setting. Errors are relative to the largest opening.
struct Expectation {
  double mesh = 0, tip = 0, patch = 0, code = 0, detail = 0, model = 0, total = 0;
  bool model_counts = false;                 ///< in the total
  double nodes = 0, seconds = 0, bytes = 0;  ///< seconds: of processors, to solve and encode
  double frames = 0;                         ///< one for each column of nodes along the cut

  /// The name of the largest source of error.
  std::string dominating() const;
};

/// Throws InputError if the case does not have exactly one straight upright cut.
void check_advisable(const Parameters& parameters);

/// What is known of the finite model, for a case.
struct ModelKnowledge {
  std::optional<ModelError> error;  ///< needed for choosing, and for cases of the finite model
  bool choose = false;              ///< between the models; if not, the case's own is taken
};

/// A case, measured in coarse meshes.
class CaseModel {
 public:
  /// Takes seconds. `work`: a folder for intermediate files. `quadratic`: measures quadratic elements too, if
  /// the case can have them. Throws as check_advisable() does.
  CaseModel(const Parameters& parameters, std::string work,
            const std::function<void(const std::string&)>& progress, ModelKnowledge models = {},
            bool quadratic = false);

  Expectation expectation(const Setting& setting) const;
  double largest_opening() const { return largest_; }  ///< mm
  /// Time of a replayed frame of 10,000 vertices in the patch, without those that never move by more than
  /// `detail`, mm.
  double frame_ms(double detail) const;
  /// Numbers of control points along u, v, w and t that the encoder takes for a setting's tolerance, in the
  /// finest mesh measured of its elements.
  std::array<int, 4> control_points(const Setting& setting) const {
    return meshes_of(setting.elements)->code(setting.tolerance).control_points;
  }
  /// All candidates of meshes and patches, before a tolerance is chosen.
  std::vector<Setting> settings() const;
  /// Whether the case can have a setting's elements, and they were measured.
  bool serves(const Setting& setting) const;

 private:
  bool quadratic_elements_serve() const;
  void measure_meshes(bool quadratic);
  void measure_patches();
  const MeshErrors* meshes_of(ElementOrder elements) const;  // null if not measured

  Parameters parameters_;
  ModelKnowledge models_;
  std::string work_;
  std::function<void(const std::string&)> progress_;
  double largest_ = 0;                               // opening, mm
  std::vector<std::pair<double, Samples>> patches_;  // by margin
  std::vector<MeshErrors> meshes_;                   // of linear elements first; of small strains
};

/// For several cases: the largest errors and the mean costs.
Expectation expectation(const std::vector<CaseModel>& models, const Setting& setting);

/// The largest error for which quadratic elements may be cheaper than linear ones.
constexpr double most_of_quadratic = 0.05;

struct Goals {
  double error = 0;
  double frame_ms = 0, megabytes = 0;  ///< 0: any. Of all cases together
  double cases = 1;                    ///< of the study; the models stand for them
  std::optional<Model> model = {};     ///< this one alone, where both may be chosen
};

/// The cheapest setting that is expected to satisfy all goals. If there is none, throws InputError that names
/// the obstacle and the nearest possible values.
Setting advise(const std::vector<CaseModel>& models, const Goals& goals);

}  // namespace cleft
