// The cheapest settings of the chain whose error stays within a bound, from what cheap cases tell of each
// link.
//
// An error is a difference of openings, right lip less left lip, over the cut and over time; its size is its
// largest length over the largest opening. What a link does is measured where it is cheap:
//
//   mesh     nodes of coarse meshes of three sizes against each other; they give the order in the element's
//   size tip      the field against its own mesh between nodes and frames, where the lips close as the square
//   root
//            of the distance from the tip, at the same sizes; finer ones go on with the order of the last two
//   patch    against one that is far wider, in a coarse mesh
//   code     what a looser tolerance adds, at the finest of those meshes
//
// Mesh and patch may cancel: their differences are added with their signs before their size is taken. The
// error at the tip is largest elsewhere: the root of both squares counts. The code's is added.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/vec3.h"
#include "params/parameters.h"

namespace cleft {

/// What is chosen.
struct Setting {
  double element_size = 0;  ///< mm, at the cut; elements grow away from it by mesh_grading
  double margin = 0;        ///< mm of patch around the cut, on all four sides
  double tolerance = 0;     ///< of the encoder
};
inline constexpr double advised_grading = 1.3;
Parameters applied(const Setting& setting, Parameters parameters);

/// What a setting is expected to come to. Errors are over the largest opening.
struct Expectation {
  double mesh = 0, tip = 0, patch = 0, code = 0, total = 0;
  double nodes = 0, seconds = 0, bytes = 0;  ///< seconds: of processors, to solve and encode

  /// The link whose error is largest.
  std::string dominating() const;
};

/// A case, measured in coarse meshes.
class CaseModel {
 public:
  /// Takes seconds. `work`: a folder for what is made on the way. Throws InputError where the case has not
  /// one straight upright cut.
  CaseModel(const Parameters& parameters, std::string work,
            const std::function<void(const std::string&)>& progress);

  Expectation expectation(const Setting& setting) const;
  double frame_ms() const { return frame_ms_; }  ///< of a replayed frame of 10,000 moving vertices
  /// All settings there are to choose from.
  std::vector<Setting> settings() const;

 private:
  using Samples = std::vector<Vec3>;  // over the cut and over time, mm

  void measure_meshes();
  void measure_patches();
  double tip_error(double size) const;  // mm
  Parameters coarse(double elements, double margin) const;

  Parameters parameters_;
  std::string work_;
  std::function<void(const std::string&)> progress_;
  double largest_ = 0;    // opening, mm
  double mesh_size_ = 0;  // element size of the coarser of the two meshes compared
  double mesh_order_ = 1;
  Samples mesh_;
  std::vector<std::pair<double, double>> tips_;      // by element size, coarsest first: mm
  std::vector<std::pair<double, Samples>> patches_;  // by margin
  struct Code {
    double tolerance, error, bytes;  // mm beyond the mesh's
  };
  std::vector<Code> codes_;
  std::vector<std::pair<double, double>> costs_;  // nodes, seconds
  double frame_ms_ = 0;
};

/// Of several cases the largest errors and the mean costs.
Expectation expectation(const std::vector<CaseModel>& models, const Setting& setting);

struct Goals {
  double error = 0;
  double frame_ms = 0, megabytes = 0;  ///< 0: any. Of all cases together
  double cases = 1;                    ///< of the study; the models stand for them
};

/// The cheapest setting that is expected to keep all goals. Throws InputError, naming what stands in the way
/// and the nearest that can be had, where none does.
Setting advise(const std::vector<CaseModel>& models, const Goals& goals);

}  // namespace cleft
