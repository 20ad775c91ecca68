#include "explorer/view/wound_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>

#include <algorithm>

#include "base/error.h"
#include "explorer/view/wound_colors.h"

namespace cleft {
namespace {

vtkSmartPointer<vtkActor> make_actor(const SurfacePart& part, vtkLookupTable* colors) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(part.data());
  mapper->SetScalarVisibility(colors != nullptr);
  if (colors) {
    mapper->SetLookupTable(colors);
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();  // layers of tissue stay sharp between few rows of points
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* look = actor->GetProperty();
  look->SetInterpolationToPhong();
  look->SetColor(skin_color[0], skin_color[1], skin_color[2]);
  look->SetAmbient(0.12);
  look->SetDiffuse(0.9);
  look->SetSpecular(0.12);
  look->SetSpecularPower(18);
  return actor;
}

vtkSmartPointer<vtkScalarBarActor> make_legend(vtkLookupTable* colors) {
  vtkNew<vtkScalarBarActor> legend;
  legend->SetLookupTable(colors);
  legend->SetTitle("displacement, mm");
  legend->SetNumberOfLabels(3);
  legend->SetLabelFormat("%.2g");
  legend->SetOrientationToHorizontal();
  legend->SetPosition(0.70, 0.86);
  legend->SetWidth(0.27);
  legend->SetHeight(0.11);
  legend->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text : {legend->GetTitleTextProperty(), legend->GetLabelTextProperty()}) {
    text->SetFontSize(15);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
    text->SetColor(0.1, 0.1, 0.12);
  }
  return legend;
}

double largest_displacement(const WoundScene& scene) {
  constexpr int samples = 8;
  std::vector<Vec3> points;
  double largest = 0;
  for (int i = 1; i <= samples; ++i) {
    scene.positions(scene.duration() * i / samples, points);
    for (std::size_t p = 0; p < points.size(); ++p)
      largest = std::max(largest, squared_norm(points[p] - scene.surface().points[p]));
  }
  return largest > 0 ? std::sqrt(largest) : 1;
}

}  // namespace

WoundView::WoundView() {
  renderer_->GradientBackgroundOn();
  renderer_->SetBackground(0.62, 0.65, 0.69);
  renderer_->SetBackground2(0.90, 0.92, 0.94);
  renderer_->SetUseFXAA(true);
  add_lights();
}

WoundView::~WoundView() = default;

void WoundView::add_lights() {
  renderer_->RemoveAllLights();
  renderer_->AutomaticLightCreationOff();
  const auto add = [this](double x, double y, double z, double intensity, double red, double blue) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, z);
    light->SetColor(red, 1, blue);
    light->SetIntensity(intensity);
    renderer_->AddLight(light);
  };
  add(-0.7, 0.9, 1.0, 0.80, 1.0, 0.95);   // key, from above left
  add(0.5, -0.25, 1.0, 0.50, 0.97, 1.0);  // fill, from beside the eye: looks into the wound
  add(0.2, 1.0, -0.8, 0.25, 1.0, 1.0);    // rim, from behind
}

void WoundView::show(std::shared_ptr<const WoundScene> scene) {
  const bool first = !scene_;
  scene_ = std::move(scene);
  const WoundSurface& surface = scene_->surface();
  CLEFT_CHECK(surface.regions.size(), ==, surface.triangles.size());
  CLEFT_CHECK(surface.depth_fraction.size(), ==, surface.points.size());
  skin_.emplace(surface, [](Region r) { return r == Region::skin; });
  walls_.emplace(surface, [](Region r) { return r != Region::skin; });
  add_actors();
  set_time(scene_->duration());
  if (first) aim({});
}

void WoundView::add_actors() {
  for (vtkProp* prop : props_) renderer_->RemoveViewProp(prop);  // the window's sliders stay
  props_.clear();
  vtkSmartPointer<vtkLookupTable> skin;
  if (scene_->shows_displacement()) {
    skin = displacement_colors(largest_displacement(*scene_));
    add_prop(make_legend(skin));
  }
  const vtkSmartPointer<vtkActor> skin_actor = make_actor(*skin_, skin);
  if (skin) {  // colours must be read against the legend
    skin_actor->GetProperty()->SetAmbient(0.35);
    skin_actor->GetProperty()->SetDiffuse(0.62);
  }
  add_prop(skin_actor);
  vtkSmartPointer<vtkActor> walls = make_actor(*walls_, tissue_colors());
  walls->GetProperty()->SetSpecular(0.3);  // moist
  walls->GetProperty()->SetSpecularPower(40);
  add_prop(walls);
  walls_->color([this](int p) { return scene_->surface().depth_fraction[p]; });
}

void WoundView::add_prop(vtkProp* prop) {
  renderer_->AddViewProp(prop);
  props_.push_back(prop);
}

void WoundView::set_time(double t) {
  time_ = std::clamp(t, 0., scene_->duration());
  scene_->positions(time_, points_);
  CLEFT_CHECK(points_.size(), ==, scene_->surface().points.size());
  skin_->move(points_);
  walls_->move(points_);
  if (scene_->shows_displacement())
    skin_->color([this](int p) { return norm(points_[p] - scene_->surface().points[p]); });
}

void WoundView::aim(const ViewAngles& angles) {
  const WoundSurface& surface = scene_->surface();
  const Vec3 &middle = surface.middle, normal = normalized(surface.outward);
  double radius = 0;
  for (const Vec3& x : surface.points) radius = std::max(radius, norm(x - middle));
  // Heads and patches stand with y upwards; a cut that faces up or down turns the picture along itself.
  const Vec3 up = std::abs(normal.y) < 0.9 ? Vec3{0, 1, 0} : surface.along;
  constexpr double view_angle = 24;
  const double distance = radius / std::sin(view_angle / 2 * M_PI / 180);
  const Vec3 eye = middle + distance * normal;
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetViewAngle(view_angle / angles.zoom);
  camera->SetFocalPoint(middle.x, middle.y, middle.z);
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetViewUp(up.x, up.y, up.z);
  camera->OrthogonalizeViewUp();
  camera->Azimuth(angles.azimuth);
  camera->Elevation(angles.elevation);
  camera->OrthogonalizeViewUp();
  renderer_->ResetCameraClippingRange();
}

}  // namespace cleft
