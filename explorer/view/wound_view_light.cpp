// The light of a wound's view where it is that of skin and wounds.
#include "explorer/view/lifelike.h"
#include "explorer/view/wound_view.h"

namespace cleft {

void WoundView::set_lifelike(bool on) {
  if (on == lifelike_) return;
  lifelike_ = on;
  if (!scene_) return;
  add_actors();
  set_time(time_);
}

/// Of actors that are new.
void WoundView::show_light() {
  if (!lifelike_ || edges_) return;
  if (!lit_) light_ = std::make_unique<SurfaceLight>(scene_->surface(), light_.get());
  lit_ = true;
  if (is_look(coloring_))
    for (vtkActor* actor : {skin_actor_.Get(), still_actor_.Get()}) light_as_skin(actor);
  light_as_wound(wall_actor_);
}

void WoundView::shade_under(const ScalpelPose* scalpel) {
  if (!lifelike_ || edges_ || !scene_) return;
  for (vtkActor* actor : {skin_actor_.Get(), still_actor_.Get(), wall_actor_.Get()})
    cleft::shade_under(actor, renderer_->GetActiveCamera(), scalpel);
}

}  // namespace cleft
