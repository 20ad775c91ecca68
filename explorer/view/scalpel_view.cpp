#include "explorer/view/scalpel_view.h"

#include <vtkMatrix4x4.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>

#include <algorithm>

#include "explorer/view/lifelike.h"
#include "explorer/view/scalpel_shape.h"

namespace cleft {

namespace {

void dress(vtkActor* actor, vtkPolyData* shape, double grey) {
  constexpr double crease = 22;  // degrees: edges between faces stay sharp
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(shape);
  normals->SetFeatureAngle(crease);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  actor->SetMapper(mapper);
  actor->PickableOff();
  actor->GetProperty()->SetInterpolationToPhong();
  actor->GetProperty()->SetColor(grey, grey, std::min(1., grey * 1.03));
  light_as_steel(actor);
}

}  // namespace

ScalpelView::ScalpelView(vtkRenderer* renderer) : renderer_(renderer) {
  dress(blade_, scalpel_blade(), 0.92);
  dress(handle_, scalpel_handle(), 0.70);
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
