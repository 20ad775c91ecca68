#include "explorer/app/handle_drag.h"

#include <vtkCamera.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr double grasp = 9;                           // pixels of the screen around a handle
constexpr double least_depth = 0.1, most_depth = 50;  // mm
constexpr double most_tilt = 60;                      // degrees
constexpr double at_the_eye = 0.97;                   // cosine from which a blade points at the eye

struct Ray {
  Vec3 from, way;  ///< way: of length 1, away from the eye
};

Vec3 world_of(vtkRenderer* renderer, const PicturePlace& at, double depth) {
  renderer->SetDisplayPoint(at.x, at.y, depth);
  renderer->DisplayToWorld();
  const double* x = renderer->GetWorldPoint();
  return {x[0] / x[3], x[1] / x[3], x[2] / x[3]};
}

Ray ray_at(vtkRenderer* renderer, const PicturePlace& at) {
  const Vec3 near = world_of(renderer, at, 0), far = world_of(renderer, at, 1);
  return {near, normalized(far - near)};
}

/// Where a place in space is in the picture.
std::pair<double, double> shown_at(vtkRenderer* renderer, const Vec3& x) {
  renderer->SetWorldPoint(x.x, x.y, x.z, 1);
  renderer->WorldToDisplay();
  const double* shown = renderer->GetDisplayPoint();
  return {shown[0], shown[1]};
}

/// Pixels of the screen between a place in space and one in the picture.
double apart(vtkRenderer* renderer, const Vec3& x, const PicturePlace& at) {
  const auto [u, v] = shown_at(renderer, x);
  return std::hypot(u - at.x, v - at.y) / at.ratio;
}

double rounded(double value, double step) { return std::round(value / step) * step; }

std::string text_of(const Vec3& x) {
  constexpr double step = 1e-3;  // mm
  return shortest(rounded(x.x, step)) + "," + shortest(rounded(x.y, step)) + "," +
         shortest(rounded(x.z, step));
}

}  // namespace

bool HandleDrag::press(const WoundView& view, const PicturePlace& at) {
  handles_.reset(), line_.clear();
  if (session_.state().warp != 1) return false;  // they are not drawn
  const auto handles = session_.handles();
  if (!handles) return false;
  double least = grasp;
  const auto take = [&](const Vec3& place, Kind kind, int point) {
    const double distance = apart(view.renderer(), place, at);
    if (distance >= least) return;
    least = distance, kind_ = kind, point_ = point;
    handles_ = handles;
  };
  for (std::size_t i = 0; i < handles->places.size(); ++i)
    take(handles->places[i], Kind::point, handles->points[i]);
  take(handles->depth_handle(), Kind::depth, -1);
  take(handles->tilt_handle(), Kind::tilt, -1);
  if (!handles_) return false;
  pressed_height_ = at.y / at.ratio;
  double up[3];
  view.renderer()->GetActiveCamera()->GetViewUp(up);
  constexpr double way = 10;  // mm
  const Vec3& foot = handles->depth.foot;
  const auto [x0, y0] = shown_at(view.renderer(), foot);
  const auto [x1, y1] = shown_at(view.renderer(), foot + way * Vec3{up[0], up[1], up[2]});
  mm_a_pixel_ = way * at.ratio / std::max(std::hypot(x1 - x0, y1 - y0), 1.);
  return true;
}

double HandleDrag::dragged_depth(const WoundView& view, const PicturePlace& at) const {
  const CutHandles::Blade& blade = handles_->depth;
  const Vec3 inward = -blade.direction();
  const Ray ray = ray_at(view.renderer(), at);
  const double cosine = dot(inward, ray.way);
  if (std::abs(cosine) > at_the_eye) return blade.depth + mm_a_pixel_ * (pressed_height_ - at.y / at.ratio);
  // The place of the blade's line that is nearest to the ray.
  const Vec3 between = ray.from - blade.foot;
  return (dot(between, inward) - cosine * dot(between, ray.way)) / (1 - cosine * cosine);
}

/// By the place under the mouse in the plane through the handle that faces the eye.
double HandleDrag::dragged_tilt(const WoundView& view, const PicturePlace& at) const {
  const CutHandles::Blade& blade = handles_->tilt;
  const Ray ray = ray_at(view.renderer(), at);
  double facing[3];
  view.renderer()->GetActiveCamera()->GetDirectionOfProjection(facing);
  const Vec3 normal{facing[0], facing[1], facing[2]};
  const double part = dot(handles_->tilt_handle() - ray.from, normal) / dot(ray.way, normal);
  const Vec3 to = ray.from + part * ray.way - blade.foot;
  return std::atan2(-dot(to, blade.across), dot(to, blade.outward)) * 180 / std::numbers::pi;
}

void HandleDrag::drag(WoundView& view, const PicturePlace& at) {
  if (!handles_) return;
  const auto index = static_cast<std::size_t>(session_.state().handled);
  CutEdit edit;
  std::string line = "edit-cut " + std::to_string(index + 1);
  if (kind_ == Kind::point) {
    const auto place = view.skin_at(at.x, at.y);
    if (!place) return;
    edit.moves = {{point_, place->position}};
    edit.reach = rounded(handles_->reach, 0.01);
    line += " point " + std::to_string(point_ + 1) + " " + text_of(place->position);
    if (edit.reach > 0) line += " reach " + shortest(edit.reach);
  } else if (kind_ == Kind::depth) {
    edit.depth = rounded(std::clamp(dragged_depth(view, at), least_depth, most_depth), 0.1);
    line += " depth " + shortest(*edit.depth);
  } else {
    edit.tilt = rounded(std::clamp(dragged_tilt(view, at), -most_tilt, most_tilt), 1);
    line += " tilt " + shortest(*edit.tilt);
  }
  try {
    session_.preview_cut(edited(session_.state().cuts.at(index), edit, session_.skin()));
    session_.handles();
    line_ = line;
  } catch (const InputError&) {  // no cut leads there
    session_.preview_cut({});
    line_.clear();
  }
}

std::string HandleDrag::release() {
  handles_.reset();
  session_.preview_cut({});
  return std::move(line_);
}

int HandleDrag::cut_at(const WoundView& view, const PicturePlace& at) {
  if (!session_.mesh()) return -1;
  constexpr int places = 200;
  double least = grasp;
  int found = -1;
  const std::vector<ScalpelPath> paths = session_.cut_paths();
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (int k = 0; k <= places; ++k) {
      const Vec3 place = paths[i].at(paths[i].length() * k / places).position;
      if (const double distance = apart(view.renderer(), place, at); distance < least)
        least = distance, found = static_cast<int>(i);
    }
  return found;
}

}  // namespace cleft
