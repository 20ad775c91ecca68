#include "explorer/body/tissue_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr double flattest = 0.05;     // of an element: wedges so flat are not made for a change of tissue
constexpr double moves_within = 0.3;  // of a step between nodes: these move

}  // namespace

std::vector<TissueLayer> layers_of(const RegionFile& file) {
  std::vector<TissueLayer> layers;
  if (file.faces) throw InputError("[faces] of --materials is of an own mesh of cells; --mesh is a surface");
  for (const RegionSection& section : file.sections) {
    const bool last = &section == &file.sections.back();
    const std::string layer = section.where + ": layer [" + section.material.name + "]";
    if (!section.regions.empty())
      throw InputError(layer + ": region is of an own mesh of cells; below a surface say to_depth");
    if (last && section.to_depth)
      throw InputError(layer + " is the last one and goes down to patch.height; leave to_depth out");
    if (!last && !section.to_depth)
      throw InputError(layer + " needs to_depth, mm below the skin, where the next one begins");
    if (!last && !layers.empty() && *section.to_depth <= layers.back().to_depth)
      throw InputError(layer + ": to_depth = " + shortest(*section.to_depth) + " mm is not below that of [" +
                       layers.back().material.name + "], " + shortest(layers.back().to_depth) +
                       " mm; name layers from the skin down");
    layers.push_back({section.material, section.to_depth.value_or(std::numeric_limits<double>::infinity())});
  }
  return layers;
}

Layers divided(Layers layers, const std::vector<TissueLayer>& tissue, double size) {
  auto& depth = layers.depth;
  std::vector<double> fixed = {0, depth[layers.bottom], depth.back()};
  for (const TissueLayer& layer : tissue) {
    const double at = layer.to_depth;
    if (std::isinf(at)) break;
    if (!(at < depth.back()))
      throw InputError(
          "layer [" + layer.material.name + "]: to_depth = " + shortest(at) +
          " mm is not above the lower side of the tissue, patch.height = " + shortest(depth.back()) +
          " mm; make the tissue thicker, or leave out the layers below");
    auto next = std::lower_bound(depth.begin(), depth.end(), at);
    const auto nearest = next - (*next - at > at - *(next - 1) ? 1 : 0);
    const bool may_move =
        *nearest > depth[layers.bottom] && std::find(fixed.begin(), fixed.end(), *nearest) == fixed.end();
    if (std::abs(*nearest - at) < flattest * size) {
      fixed.push_back(*nearest);
    } else if (may_move && std::abs(*nearest - at) < moves_within * (*next - *(next - 1))) {
      *nearest = at, fixed.push_back(at);
    } else {
      layers.bottom += at < depth[layers.bottom] ? 1 : 0;
      depth.insert(next, at), fixed.push_back(at);
    }
  }
  return layers;
}

int tissue_between(const Layers& layers, const std::vector<TissueLayer>& tissue, int k) {
  const double middle = (layers.depth[k] + layers.depth[k + 1]) / 2;
  for (std::size_t t = 0; t < tissue.size(); ++t)
    if (middle < tissue[t].to_depth) return static_cast<int>(t);
  return static_cast<int>(tissue.size()) - 1;
}

}  // namespace cleft
