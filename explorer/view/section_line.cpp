#include "explorer/view/section_line.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

namespace cleft {

SectionLine::SectionLine(const Vec3& place, const Vec3& ahead) {
  plane_->SetOrigin(place.x, place.y, place.z);
  plane_->SetNormal(-ahead.x, -ahead.y, -ahead.z);  // VTK keeps the side that it points to
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(all_->GetOutputPort());
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  line_->SetMapper(mapper);
  line_->PickableOff();
  vtkProperty* look = line_->GetProperty();
  look->LightingOff();
  look->SetColor(0, 0.28, 0.45);
  look->SetLineWidth(3);
}

void SectionLine::clip(vtkActor* actor) const {
  actor->GetMapper()->RemoveAllClippingPlanes();
  actor->GetMapper()->AddClippingPlane(plane_);
}

void SectionLine::add(vtkPolyData* surface) {
  const auto cutter = vtkSmartPointer<vtkCutter>::New();
  cutter->SetInputData(surface);
  cutter->SetCutFunction(plane_);
  all_->AddInputConnection(cutter->GetOutputPort());
  cutters_.push_back(cutter);
}

}  // namespace cleft
