#include "explorer/view/scalpel_view.h"

#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <cmath>
#include <vector>

namespace cleft {

namespace {

/// A prism: an outline in the plane of edge (x) and axis (z), and as far as `thick` on either side of it.
vtkSmartPointer<vtkPolyData> prism(const std::vector<std::pair<double, double>>& outline, double thick) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  const auto count = static_cast<vtkIdType>(outline.size());
  for (const double y : {-thick, thick})
    for (const auto& [x, z] : outline) points->InsertNextPoint(x, y, z);
  std::vector<vtkIdType> below, above;
  for (vtkIdType i = 0; i < count; ++i) below.push_back(i), above.push_back(2 * count - 1 - i);
  faces->InsertNextCell(count, below.data());
  faces->InsertNextCell(count, above.data());
  for (vtkIdType i = 0; i < count; ++i) {
    const vtkIdType next = (i + 1) % count, side[] = {i, i + count, next + count, next};
    faces->InsertNextCell(4, side);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(faces);
  return data;
}

void dress(vtkActor* actor, vtkPolyData* data, double grey, double specular) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  actor->SetMapper(mapper);
  actor->PickableOff();
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetColor(grey, grey, grey * 1.05);
  actor->GetProperty()->SetSpecular(specular);
  actor->GetProperty()->SetSpecularPower(25);
}

}  // namespace

ScalpelView::ScalpelView(vtkRenderer* renderer) : renderer_(renderer) {
  // The edge is ahead; the back of the blade is straight.
  dress(blade_, prism({{0, 0}, {2.2, 3}, {3, 8}, {2.4, 14}, {-1.2, 14}, {-1.2, 4}}, 0.15), 0.8, 0.6);
  dress(handle_, prism({{-1.2, 14}, {2.4, 14}, {3, 22}, {3, 90}, {-2, 90}, {-2, 22}}, 1.1), 0.45, 0.3);
  renderer_->AddViewProp(blade_);
  renderer_->AddViewProp(handle_);
}

ScalpelView::~ScalpelView() {
  renderer_->RemoveViewProp(blade_);
  renderer_->RemoveViewProp(handle_);
}

void ScalpelView::move(const ScalpelPose& pose, const Vec3& tip) {
  const Vec3 axis = normalized(pose.axis), side = normalized(cross(axis, pose.edge)),
             edge = cross(side, axis);
  vtkNew<vtkMatrix4x4> place;
  for (int k = 0; k < 3; ++k) {
    place->SetElement(k, 0, edge[k]);
    place->SetElement(k, 1, side[k]);
    place->SetElement(k, 2, axis[k]);
    place->SetElement(k, 3, tip[k]);
  }
  for (vtkActor* actor : {blade_.Get(), handle_.Get()}) {
    actor->SetUserMatrix(place);
    actor->SetVisibility(pose.present);
  }
}

}  // namespace cleft
