// Fields whose components are arrays of their own, as disp_x, disp_y, disp_z.
#pragma once

#include <string>
#include <vector>

#include "encoder/import/frame_files.h"

namespace cleft {

/// Where a component is: in an array of its own, as component `column` of a vector, or, being 0, nowhere.
struct Component {
  std::string array = {};
  int column = -1;
  bool is_zero() const { return array.empty(); }
};

/// The components of a field that is called `source`, among the arrays that are there: the array of that
/// name; those of "sxx+syy+0+sxy"; or, for "disp", disp_x, disp_y and disp_z, or the like, of which `source`
/// becomes the sum. {{source}} where nothing of it is there.
std::vector<Component> components_of(std::string& source, const std::vector<std::string>& there);

/// One array of all, from those that are read, which are the components that are not zero. Two and three are
/// a vector, four (XX YY ZZ XY), six and nine a tensor. Throws InputError about the field `source` if an
/// array has another number of components.
SourceArray composed(const std::vector<Component>& components, std::vector<SourceArray> arrays,
                     const std::string& source);

/// The source of a field with these components as the field's file records it: with each "+" of an array's
/// own name twice, which tells it from those between arrays. And the name of an array so recorded.
std::string recorded_source(const std::string& source, const std::vector<Component>& components);
std::string array_recorded(const std::string& source);

/// A component of a field that is written back: its array, and which of the field's numbers it is.
struct WrittenComponent {
  std::string array;
  int place = 0;
};
/// Of a vector or a symmetric tensor (XX YY ZZ XY YZ XZ) whose name is such a sum; none of other fields.
std::vector<WrittenComponent> written_components(const std::string& source, int components);

}  // namespace cleft
