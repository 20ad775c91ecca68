#include "explorer/view/wound_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellPicker.h>
#include <vtkLight.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "explorer/view/legend.h"
#include "explorer/view/wound_colors.h"

namespace cleft {
namespace {

vtkSmartPointer<vtkActor> make_actor(vtkPolyData* data, vtkLookupTable* colors) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
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
  look->SetAmbient(0.12);
  look->SetDiffuse(0.9);
  look->SetSpecular(0.12);
  look->SetSpecularPower(18);
  return actor;
}

void show_paint(vtkMapper* mapper) {
  mapper->ScalarVisibilityOn();
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(SurfacePart::painted);
  mapper->SetColorModeToDirectScalars();
}

}  // namespace

WoundView::WoundView() {
  renderer_->GradientBackgroundOn();
  renderer_->SetBackground(0.62, 0.65, 0.69);
  renderer_->SetBackground2(0.90, 0.92, 0.94);
  set_smooth(true);
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
  add(0.5, -0.25, 1.0, 0.50, 0.97, 1.0);  // fill light, next to the eye: lights the inside of the wound
  add(0.2, 1.0, -0.8, 0.25, 1.0, 1.0);    // rim, from behind
}

void WoundView::show(std::shared_ptr<const WoundScene> scene, std::optional<double> t) {
  const bool first = !scene_;
  if (first || &scene->surface() != &scene_->surface()) known_range_.reset();
  scene_ = std::move(scene);
  const WoundSurface& surface = scene_->surface();
  CLEFT_CHECK(surface.regions.size(), ==, surface.triangles.size());
  CLEFT_CHECK(surface.depth_fraction.size(), ==, surface.points.size());
  skin_.emplace(
      surface, [](Region r) { return r == Region::skin; }, scene_->moving());
  walls_.emplace(surface, [](Region r) { return r != Region::skin; });
  lit_ = false;
  add_actors();
  set_time(t.value_or(scene_->duration()));
  if (first) aim({});
}

void WoundView::color_by(const Coloring& coloring, std::shared_ptr<const Field> reference,
                         std::optional<std::pair<double, double>> range, const std::string& map) {
  coloring_ = coloring, reference_ = std::move(reference), range_ = range, map_ = map;
  if (!scene_) return;
  add_actors();
  set_time(time_);
}

namespace {

constexpr int times_of_ranges = 8;

/// Of at least one value: the least that is not below that part of them.
double quantile(std::vector<double>& values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

/// Of what moves.
std::vector<double> WoundView::values_over_time(const Coloring& coloring, const Field* reference) {
  const std::vector<bool> moving = scene_->moving();
  std::vector<double> all, values;
  for (int i = 1; i <= times_of_ranges; ++i) {
    scene_->values(coloring, reference, scene_->duration() * i / times_of_ranges, values);
    for (std::size_t p = 0; p < values.size(); ++p)
      if ((moving.empty() || moving[p]) && std::isfinite(values[p])) all.push_back(values[p]);
  }
  return all;
}

std::pair<double, double> WoundView::range_of(const Coloring& coloring, const Field* reference,
                                              const std::optional<std::pair<double, double>>& percentiles) {
  if (is_look(coloring)) return {0, 0};
  if (known_range_ && known_range_->coloring == coloring && known_range_->reference == reference &&
      known_range_->percentiles == percentiles)
    return known_range_->range;
  const bool from_zero = coloring.kind != Coloring::quantity;
  std::vector<double> values;
  double least = from_zero ? 0 : HUGE_VAL, greatest = from_zero ? 0 : -HUGE_VAL;
  if (percentiles) {
    values = values_over_time(coloring, reference);
    if (!values.empty())
      least = quantile(values, percentiles->first / 100),
      greatest = quantile(values, percentiles->second / 100);
  }
  for (int i = from_zero ? 1 : 0; !percentiles && i <= times_of_ranges; ++i) {
    scene_->values(coloring, reference, scene_->duration() * i / times_of_ranges, values);
    std::erase_if(values, [](double v) { return !std::isfinite(v); });  // unknown errors
    if (values.empty()) continue;
    // Strain has no bound at the ends of the cut: the highest values there would leave no colour for the
    // rest.
    greatest = std::max(greatest, quantile(values, coloring == Coloring::strain ? 0.99 : 1));
    if (!from_zero || is_signed(coloring))
      least = std::min(least, *std::min_element(values.begin(), values.end()));
  }
  if (is_signed(coloring)) greatest = std::max(std::abs(least), std::abs(greatest)), least = -greatest;
  if (least > greatest) least = greatest = 0;
  known_range_ = {coloring, reference, percentiles, {least, greatest}};
  return {least, greatest};
}

void WoundView::add_actors() {
  for (vtkProp* prop : props_) renderer_->RemoveViewProp(prop);  // the window's sliders stay
  props_.clear();
  legend_ = nullptr;
  vtkSmartPointer<vtkLookupTable> skin;
  if (!is_look(coloring_)) {
    const auto [least, greatest] = range_ ? *range_ : range_of(coloring_, reference_.get());
    const std::vector<ColorMap>& maps = color_maps();
    const ColorMap& map = !map_.empty() ? color_map(map_) : is_signed(coloring_) ? maps.back() : maps.front();
    skin = value_colors(map, least, greatest > least ? greatest : least + 1);
    if (is_faded_) fade(skin);
    legend_ = make_legend(skin, text_of(coloring_).title);
    legend_->SetVisibility(has_legend_);
    add_prop(legend_);
  }
  const bool painted = coloring_ == Coloring::own && paint_skin();
  skin_actor_ = make_actor(skin_->data(), skin);
  still_actor_ = make_actor(skin_->still(), skin);
  for (vtkActor* actor : {skin_actor_.Get(), still_actor_.Get()}) {
    add_prop(actor);
    const auto [red, green, blue] = is_faded_ ? faded(skin_color) : skin_color;
    actor->GetProperty()->SetColor(red, green, blue);
    if (painted) show_paint(actor->GetMapper());
    if (!skin) continue;
    actor->GetProperty()->SetAmbient(0.35);  // colours must be read against the legend
    actor->GetProperty()->SetDiffuse(0.62);
  }
  const vtkSmartPointer<vtkLookupTable> tissue = tissue_colors();
  if (is_faded_) fade(tissue);
  wall_actor_ = make_actor(walls_->data(), tissue);
  wall_actor_->GetProperty()->SetSpecular(0.3);  // moist
  wall_actor_->GetProperty()->SetSpecularPower(40);
  add_prop(wall_actor_);
  show_opacity();
  show_edges();
  show_section();
  show_light();
  walls_->color([this](int p) { return scene_->surface().depth_fraction[p]; });
  set_background();
}

/// In the mesh's own colours; false where it has none.
bool WoundView::paint_skin() {
  const std::vector<PointColor>& own = scene_->surface().colors;
  if (own.empty()) return false;
  skin_->paint([&](int point) {
    const PointColor& color = own[static_cast<std::size_t>(point)];
    return is_faded_ ? faded(color) : color;
  });
  return true;
}

void WoundView::set_coarse(bool coarse) {
  if (coarse == (renderer_->GetPass() != nullptr)) return;
  if (!coarse) coarse_->ReleaseGraphicsResources(renderer_->GetRenderWindow());
  renderer_->SetPass(coarse ? coarse_.Get() : nullptr);
}

void WoundView::set_opacity(double opacity) {
  if (opacity == opacity_) return;
  opacity_ = opacity;
  show_opacity();
}

void WoundView::set_faded(bool faded) {
  if (faded == is_faded_) return;
  is_faded_ = faded;
  if (!scene_) return;
  add_actors();
  set_time(time_);
}

void WoundView::set_warp(double factor) {
  if (factor == warp_) return;
  warp_ = factor;
  if (scene_) set_time(time_);
}

void WoundView::set_edges(bool visible) {
  if (visible == edges_) return;
  edges_ = visible;
  if (!scene_) return;
  add_actors();
  set_time(time_);
}

void WoundView::show_edges() {
  for (vtkActor* actor : {skin_actor_.Get(), still_actor_.Get(), wall_actor_.Get()}) {
    actor->GetProperty()->SetEdgeVisibility(edges_);
    actor->GetProperty()->SetEdgeColor(0.25, 0.25, 0.28);
  }
}

void WoundView::set_clip(const std::optional<ClipState>& clip) {
  if (clip == clip_) return;
  clip_ = clip;
  if (!scene_) return;
  add_actors();
  set_time(time_);
}

/// Of actors that are new.
void WoundView::show_section() {
  section_.reset();
  if (!clip_) return;
  section_.emplace(clip_->place, clip_->ahead);
  for (vtkActor* actor : {skin_actor_.Get(), still_actor_.Get(), wall_actor_.Get()}) section_->clip(actor);
  for (vtkPolyData* surface : {skin_->data(), skin_->still(), walls_->data()}) section_->add(surface);
  add_prop(section_->line());
}

void WoundView::show_opacity() {
  for (vtkActor* actor : {skin_actor_.Get(), still_actor_.Get(), wall_actor_.Get()})
    actor->GetProperty()->SetOpacity(opacity_);
}

void WoundView::set_dark(bool dark) {
  if (dark == dark_) return;
  dark_ = dark;
  set_background();
}

void WoundView::set_background() {
  if (dark_) {
    renderer_->SetBackground(0.10, 0.11, 0.13);
    renderer_->SetBackground2(0.20, 0.22, 0.25);
  } else {
    renderer_->SetBackground(0.80, 0.83, 0.86);
    renderer_->SetBackground2(0.96, 0.97, 0.98);
  }
  if (legend_) set_dark_background(legend_, dark_);
}

void WoundView::add_prop(vtkProp* prop) {
  renderer_->AddViewProp(prop);
  props_.push_back(prop);
}

void WoundView::set_time(double t) {
  time_ = std::clamp(t, 0., scene_->duration());
  scene_->positions(time_, points_);
  const std::vector<Vec3>& rest = scene_->surface().points;
  for (std::size_t p = 0; warp_ != 1 && p < points_.size(); ++p)
    points_[p] = rest[p] + warp_ * (points_[p] - rest[p]);
  CLEFT_CHECK(points_.size(), ==, scene_->surface().points.size());
  skin_->move(points_);
  walls_->move(points_);
  if (lifelike_ && lit_) {
    light_->at(points_, lights_);
    skin_->light(lights_, rest);
    walls_->light(lights_, rest);
  }
  if (is_look(coloring_)) return;
  scene_->values(coloring_, reference_.get(), time_, values_);
  skin_->color([this](int p) { return values_[p]; });
}

std::optional<WoundView::Place> WoundView::skin_at(int x, int y) {
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(0);
  if (!picker->Pick(x, y, 0, renderer_) || picker->GetCellId() < 0) return {};
  const bool still = picker->GetActor() == still_actor_;
  if (!still && picker->GetActor() != skin_actor_) return {};
  const vtkPolyData* hit = still ? skin_->still() : skin_->data();
  const auto corners = skin_->corners(hit, static_cast<std::size_t>(picker->GetCellId()));
  const double* p = picker->GetPCoords();
  const std::vector<Vec3>& rest = scene_->surface().points;
  const auto corner = [&](int i) { return rest[corners[i]]; };
  return Place{(1 - p[0] - p[1]) * corner(0) + p[0] * corner(1) + p[1] * corner(2),
               normalized(cross(corner(1) - corner(0), corner(2) - corner(0)))};
}

void WoundView::aim(const CameraState& state) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  if (state.pose) {
    const CameraState::Pose& p = *state.pose;
    camera->SetViewAngle(p.view_angle);
    camera->SetFocalPoint(p.focal_point.x, p.focal_point.y, p.focal_point.z);
    camera->SetPosition(p.position.x, p.position.y, p.position.z);
    camera->SetViewUp(p.up.x, p.up.y, p.up.z);
    renderer_->ResetCameraClippingRange();
    return;
  }
  const WoundSurface& surface = scene_->surface();
  const CameraState::Frame from =
      state.frame.value_or(CameraState::Frame{surface.middle, surface.outward, surface.along});
  const Vec3 &middle = from.middle, normal = normalized(from.outward);
  // Heads and patches have y upwards; for a cut that faces up or down the picture is aligned with the cut.
  const Vec3 up = std::abs(normal.y) < 0.9 ? Vec3{0, 1, 0} : from.along;
  constexpr double view_angle = 24;
  const Vec3 eye = middle + normal;
  camera->SetViewAngle(view_angle / state.zoom);
  camera->SetFocalPoint(middle.x, middle.y, middle.z);
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetViewUp(up.x, up.y, up.z);
  camera->OrthogonalizeViewUp();
  camera->Azimuth(state.azimuth);
  camera->Elevation(state.elevation);
  camera->OrthogonalizeViewUp();
  const double distance = distance_to_see_all(middle, view_angle);
  const double* back = camera->GetDirectionOfProjection();
  camera->SetPosition(middle.x - distance * back[0], middle.y - distance * back[1],
                      middle.z - distance * back[2]);
  renderer_->ResetCameraClippingRange();
}

/// From the middle, at the camera's direction, with a margin.
double WoundView::distance_to_see_all(const Vec3& middle, double view_angle) const {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const auto vec = [](const double* x) { return Vec3{x[0], x[1], x[2]}; };
  const Vec3 forward = vec(camera->GetDirectionOfProjection()), up = vec(camera->GetViewUp()),
             right = cross(forward, up);
  const int* size = renderer_->GetSize();
  const double aspect = size[0] > 1 && size[1] > 1 ? double(size[0]) / size[1] : 16. / 9;
  const double high = std::tan(view_angle / 2 * M_PI / 180), wide = aspect * high;
  double distance = 0;
  for (const Vec3& x : scene_->surface().points) {
    const Vec3 from = x - middle;
    const double needed = std::max(std::abs(dot(from, up)) / high, std::abs(dot(from, right)) / wide);
    distance = std::max(distance, 1.35 * needed - dot(from, forward));
  }
  return distance;
}

}  // namespace cleft
