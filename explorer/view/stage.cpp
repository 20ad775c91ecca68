#include "explorer/view/stage.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkRendererCollection.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace cleft {

Stage::Stage(vtkRenderWindow* window, double samples) : window_(window), samples_(samples) {
  camera_observer_ = window_->AddObserver(vtkCommand::StartEvent, this, &Stage::follow_camera);
}

Stage::~Stage() {
  window_->RemoveObserver(camera_observer_);
  make_views(0);
}

void Stage::make_views(std::size_t count) {
  if (count == views_.size()) return;
  scalpel_view_.reset();
  for (View& v : views_) {
    v.view->set_coarse(false);
    v.overlay.reset();
    v.furniture.reset();
    window_->RemoveRenderer(v.view->renderer());
  }
  views_.clear();
  scenes_.assign(count, nullptr);
  const int columns = count > 1 ? 2 : 1, rows = count > 2 ? 2 : 1;
  for (std::size_t i = 0; i < count; ++i) {
    views_.push_back({std::make_unique<WoundView>(), nullptr});
    views_.back().view->set_smooth(smooth_);
    views_.back().view->set_coarse(coarse_);
    vtkRenderer* renderer = views_.back().view->renderer();
    const int column = static_cast<int>(i) % columns, row = rows - 1 - static_cast<int>(i) / columns;
    renderer->SetViewport(double(column) / columns, double(row) / rows, double(column + 1) / columns,
                          double(row + 1) / rows);
    views_.back().view->set_legend(i + 1 == count);
    if (i > 0) renderer->SetActiveCamera(view(0).renderer()->GetActiveCamera());
    window_->AddRenderer(renderer);
    views_.back().furniture = std::make_unique<Furniture>(window_, renderer);
  }
}

namespace {

std::pair<Vec3, Vec3> moving_box(const WoundScene& scene) {
  const std::vector<bool> moving = scene.moving();
  Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
  for (std::size_t i = 0; i < moving.size(); ++i)
    for (int k = 0; moving[i] && k < 3; ++k) {
      low[k] = std::min(low[k], scene.surface().points[i][k]);
      high[k] = std::max(high[k], scene.surface().points[i][k]);
    }
  return {low, high};
}

std::shared_ptr<const WoundScene> at_detail(const std::shared_ptr<const WoundScene>& whole, double mm) {
  const auto some = mm > 0 ? whole->with_detail(mm) : nullptr;
  return some ? some : whole;
}

}  // namespace

void Stage::show(Session& session) {
  if (!session.has_scene()) return make_views(0);
  const std::vector<int> cases = session.views();
  const bool relaid = cases.size() != views_.size();
  make_views(cases.size());
  warp_ = session.state().warp;
  const bool fresh = take_scenes(session) || relaid;
  aim(session.state().camera, relaid || session.mesh() != mesh_);  // another mesh may have another size
  mesh_ = session.mesh();
  follow_camera();
  color(session, fresh);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    WoundView& view = *views_[i].view;
    view.set_warp(scenes_[i] == live_ ? 1 : warp_);
    view.set_edges(session.state().edges);
    view.set_lifelike(session.state().lifelike);
    view.set_clip(session.state().clip);
    const double time = scenes_[i] == live_ ? scenes_[i]->duration() : session.state().time;
    if (scenes_[i] == live_ || view.time() != time) view.set_time(time);
    if (scenes_[i] == live_) draw_scalpel(view);
  }
  if (!scalpel_) scalpel_view_.reset();
  for (std::size_t i = 0; i < views_.size(); ++i) views_[i].view->set_faded(session.is_guess(cases[i]));
  lay_over(session);
  for (View& v : views_) v.view->renderer()->ResetCameraClippingRange();
  label(session);
  tell_detail(session);
}

bool Stage::take_scenes(Session& session) {
  detail_ = session.state().detail;
  const std::vector<int> cases = session.views();
  bool fresh = false;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    View& view = views_[i];
    const auto whole = scene_of(session, cases[i]);
    if (whole == view.whole) continue;
    view.whole = whole, view.detail = 0;
    view.box = moving_box(*whole);
    view.detail = detail_of(view);
    scenes_[i] = at_detail(whole, view.detail);
    view.view->show(scenes_[i], session.state().time);
    fresh = true;
  }
  return fresh;
}

/// Before every picture, whoever has moved the camera or the window's edge.
void Stage::follow_camera() {
  for (std::size_t i = 0; i < views_.size(); ++i) {
    View& view = views_[i];
    view.view->shade_under(scalpel_ && scenes_[i] == live_ ? &scalpel_->pose : nullptr);
    const double detail = view.whole ? detail_of(view) : 0;
    if (detail == view.detail) continue;
    view.detail = detail;
    scenes_[i] = at_detail(view.whole, detail);
    view.view->show(scenes_[i], view.view->time());
  }
}

PixelBound Stage::pixel_bound(const View& view) const { return {view.view->renderer(), view.box, samples_}; }

/// mm. In pixels down to a power of the square root of 2, so that a camera that slowly comes closer seldom
/// needs another.
double Stage::detail_of(const View& view) const {
  if (!detail_) return 0;
  if (!detail_->pixels) return 1e-3 * detail_->amount;
  const double mm = pixel_bound(view).mm(detail_->amount) / std::max(warp_, 1.);
  return mm > 0 ? std::exp2(std::floor(2 * std::log2(mm)) / 2) : 0;
}

/// Of the shown case's view.
void Stage::tell_detail(Session& session) const {
  const std::vector<int> cases = session.views();
  const auto shown =
      static_cast<std::size_t>(std::find(cases.begin(), cases.end(), session.state().shown) - cases.begin());
  const std::size_t i = shown < cases.size() ? shown : 0;
  const auto out = detail_ ? scenes_[i]->left_out() : std::nullopt;
  session.see(out ? std::optional(DetailSeen{*out, pixel_bound(views_[i]).pixels(warp_ * out->error)})
                  : std::nullopt);
}

/// In the view of the shown case.
void Stage::lay_over(Session& session) {
  Overlay overlay = live_ ? Overlay{} : session.overlay();
  if (warp_ != 1 && !overlay.empty()) {
    overlay = {};
    overlay.caption = "nodes, lattices, volumes and lines lie over displacements as they are only (warp 1)";
  }
  caption_ = overlay.caption;
  const std::vector<int> cases = session.views();
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const bool here = cases[i] == session.state().shown && !overlay.empty();
    views_[i].view->set_opacity(here ? overlay.surface_opacity : 1);
    if (!here) {
      views_[i].overlay.reset();
      continue;
    }
    if (!views_[i].overlay) views_[i].overlay = std::make_unique<OverlayView>(views_[i].view->renderer());
    views_[i].overlay->show(overlay, session.state().dark, coarse_ ? 0.5 : 1);
  }
}

void Stage::set_smooth(bool smooth) {
  smooth_ = smooth;
  for (View& v : views_) v.view->set_smooth(smooth);
}

void Stage::set_coarse(bool coarse) {
  coarse_ = coarse;
  for (View& v : views_) v.view->set_coarse(coarse);
}

void Stage::set_live(std::shared_ptr<const WoundScene> scene, const HapticState* scalpel) {
  live_ = std::move(scene);
  scalpel_.reset();
  if (live_ && scalpel) scalpel_ = *scalpel;
}

std::shared_ptr<const WoundScene> Stage::scene_of(Session& session, int i) const {
  return live_ && i == session.state().shown ? live_ : session.scene_of(i);
}

void Stage::draw_scalpel(const WoundView& view) {
  if (!scalpel_) return;
  if (!scalpel_view_) scalpel_view_ = std::make_unique<ScalpelView>(view.renderer());
  scalpel_view_->move(scalpel_->pose, scalpel_->pose.tip);
}

void Stage::color(Session& session, bool fresh) {
  const SessionState& s = session.state();
  const auto reference = needs_reference(s.coloring) ? session.reference() : nullptr;
  const bool other =
      s.coloring != shown_.coloring || reference.get() != shown_.reference || s.map != shown_.map;
  if (s.range) {
    if (!fresh && !other && *s.range == shown_.range) return;
    shown_.range = *s.range;
  } else {
    std::pair<double, double> range{HUGE_VAL, -HUGE_VAL};
    for (View& v : views_) {
      const auto [least, greatest] = v.view->range_of(s.coloring, reference.get(), s.percentiles);
      range = {std::min(range.first, least), std::max(range.second, greatest)};
    }
    if (!(range.second > range.first)) range.second = range.first + 1;
    if (!fresh && !other && range == shown_.range) return;
    shown_.range = range;
  }
  shown_.coloring = s.coloring;
  shown_.reference = reference.get();
  shown_.map = s.map;
  for (View& v : views_) v.view->color_by(session.coloring_with_unit(), reference, shown_.range, s.map);
}

void Stage::aim(const CameraState& camera, bool fresh) {
  const Vec3 middle = scenes_.front()->surface().middle;
  if (!fresh && camera == shown_.camera && (camera.pose || camera.frame || middle == shown_.middle)) {
    for (View& v : views_) v.view->renderer()->ResetCameraClippingRange();
    return;
  }
  shown_.camera = camera;
  shown_.middle = middle;
  view(0).aim(camera);
  for (View& v : views_) v.view->renderer()->ResetCameraClippingRange();
}

/// "skin.prestress_v=0.05" as "prestress_v=0.05", so that it fits a small view.
std::string without_groups(const std::string& name) {
  std::string out;
  std::istringstream words(name);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('='), dot = word.rfind('.', equals);
    out += (out.empty() ? "" : " ") +
           (equals == std::string::npos || dot == std::string::npos ? word : word.substr(dot + 1));
  }
  return out;
}

/// In lines of what fits `width` pixels.
std::string wrapped(const std::string& text, double width) {
  const std::size_t most = std::max(20., width / 7.5);
  std::string out;
  std::size_t length = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool next = length > 0 && length + 1 + word.size() > most;
    out += (length == 0 ? "" : next ? "\n" : " ") + word;
    length = next || length == 0 ? word.size() : length + 1 + word.size();
  }
  return out;
}

void Stage::label(Session& session) {
  const bool dark = session.state().dark;
  const std::vector<int> cases = session.views();
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const std::string whole = session.title_of(cases[i]);
    const double width = views_[i].view->renderer()->GetSize()[0] * 72. / window_->GetDPI();
    const std::string title = wrapped(views_.size() > 1 ? without_groups(whole) : whole, width);
    std::string below = session.progress_text(views_[i].view->time(), views_[i].view->duration());
    for (const std::string& text :
         {session.note_of(cases[i]), cases[i] == session.state().shown ? caption_ : std::string()})
      if (!text.empty()) below += "\n" + wrapped(text, width);
    views_[i].furniture->set_text(title, below, views_.size() > 1);
    if (session.mesh())
      views_[i].furniture->set_axes({"x", "y", "z"});
    else
      views_[i].furniture->set_axes({"u", "v", "w"});
    views_[i].view->set_dark(dark);
    const double ink = dark ? 0.9 : 0.1;
    views_[i].furniture->set_ink(ink, ink, ink);
  }
}

int Stage::view_at(int x, int y) const {
  for (std::size_t i = 0; i < views_.size(); ++i)
    if (views_[i].view->renderer()->IsInViewport(x, y)) return static_cast<int>(i);
  return -1;
}

double Stage::mm_a_pixel(int i) const {
  vtkRenderer* renderer = views_.at(i).view->renderer();
  return 2 * renderer->GetActiveCamera()->GetDistance() *
         std::tan(renderer->GetActiveCamera()->GetViewAngle() / 2 * M_PI / 180) / renderer->GetSize()[1];
}

CameraState::Pose Stage::camera() const {
  vtkCamera* c = views_.front().view->renderer()->GetActiveCamera();
  const auto vec = [](const double* x) { return Vec3{x[0], x[1], x[2]}; };
  return {vec(c->GetPosition()), vec(c->GetFocalPoint()), vec(c->GetViewUp()), c->GetViewAngle()};
}

}  // namespace cleft
