#include "explorer/scene/path_file.h"

#include "base/error.h"
#include "base/text.h"

namespace cleft {

ScalpelPath read_path(const std::string& file, double depth, double scale,
                      const std::optional<Field>& field) {
  const NumberTable table = read_csv(file);
  ScalpelPath path = ScalpelPath::from_table(table, file);
  if (depth > 0)
    path.set_depth(depth / scale);
  else if (table.column("depth") < 0 && field)
    path.set_depth(field->cut().depth / scale);
  else if (table.column("depth") < 0)
    throw FileError(file, "has no column 'depth', and there is no field that knows one: give --depth in mm");
  return path;
}

}  // namespace cleft
