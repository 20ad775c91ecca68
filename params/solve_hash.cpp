#include "params/solve_hash.h"

#include "params/hash.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

constexpr int hash_version =
    3;  // raise when the same parameters no longer give the same snapshot, or its format changes

}  // namespace

std::string solve_hash(const Parameters& parameters, const std::string& body) {
  std::string text = "cleft case " + std::to_string(hash_version) + "\n";
  for (const Parameter& row : parameter_table()) {
    if (row.added_later && get_parameter(parameters, row) == get_parameter(Parameters{}, row)) continue;
    text += row.name + "=" + to_text(get_parameter(parameters, row)) + "\n";
  }
  // All patches with mean dilatation had a chess board before.
  if (parameters.tissue.formulation == TissueFormulation::mean_dilatation && !has_chess_board(parameters))
    text += "diagonals=rows\n";
  // The elements of tilted cuts were as long as those of upright ones.
  if (parameters.cut.tilt != 0) text += "length_of_elements=by_tilt\n";
  // The torsion faded away from the cut before.
  if (parameters.skin.curvature_uv != 0) text += "torsion=constant\n";
  if (!body.empty()) text += "body=" + body + "\n";
  return sha256(text).substr(0, 16);
}

}  // namespace cleft
