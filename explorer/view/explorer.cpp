#include "explorer/view/explorer.h"

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/incision.h"
#include "explorer/io/mesh_file.h"
#include "explorer/scene/mesh_scene.h"
#include "explorer/scene/patch_scene.h"

namespace cleft {

/// Cut once for every depth that the cases ask for.
struct Explorer::Patient {
  SurfaceMesh mesh;
  ScalpelPath path;
  bool own_depth;  ///< the path's file says how deep; else the case does
  std::shared_ptr<const CutSurface> cut;

  std::shared_ptr<const CutSurface> cut_for(const Field& field) {
    const double depth = own_depth ? path.largest_depth() : field.cut().depth;
    if (cut && path.largest_depth() == depth) return cut;
    if (!own_depth) path.set_depth(depth);
    return cut = std::make_shared<CutSurface>(mesh, std::vector{path});
  }
};

namespace {

SurfaceMesh read_mesh_in_mm(const std::string& file, double scale) {
  SurfaceMesh mesh = read_mesh(file);
  for (Vec3& x : mesh.points) x *= scale;
  return mesh;
}

NumberTable read_path_in_mm(const std::string& file, double scale) {
  NumberTable table = read_csv(file);
  for (const char* name : {"x", "y", "z", "depth"})
    if (const int column = table.column(name); column >= 0)
      for (std::vector<double>& row : table.rows) row[column] *= scale;
  return table;
}

}  // namespace

Explorer::Explorer(const ExplorerInput& input) : study_(input.study) {
  if (!input.mesh.empty()) {
    const NumberTable table = read_path_in_mm(input.path, input.scale);
    patient_.reset(new Patient{read_mesh_in_mm(input.mesh, input.scale),
                               ScalpelPath::from_table(table, input.path), table.column("depth") >= 0,
                               nullptr});
  }
  show_case(0);
}

Explorer::~Explorer() = default;

void Explorer::show_case(int i) {
  if (i == shown_) return;
  const std::shared_ptr<const Field> field = study_.field(i);
  const double time = view_.time();
  view_.color_by(patient_ ? Coloring::tissue : Coloring::displacement);
  if (patient_)
    view_.show(std::make_shared<MeshScene>(patient_->cut_for(*field), field));
  else
    view_.show(std::make_shared<PatchScene>(field));
  if (shown_ >= 0) view_.set_time(time);
  shown_ = i;
}

}  // namespace cleft
