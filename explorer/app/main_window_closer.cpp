// The window's tools for looking closer: between cases, at single points, with a ruler, at how it works.
#include "explorer/app/main_window.h"
#include "explorer/app/message_bar.h"
#include "explorer/app/scene_widget.h"

namespace cleft {

void MainWindow::make_closer_actions(QMenu* menu) {
  between_ = add_action(menu, "between", tr("&Interpolate between cases"), {},
                        [this] { say(session_.state().between ? "between off" : "between on"); });
  between_->setCheckable(true);
  probe_ = add_action(menu, "probe", tr("Pro&be a point"), QKeySequence("P"), [this] { pick("probe"); });
  probe_->setCheckable(true);
  probe_->setToolTip(tr("Click a point of the patch: its motion is plotted (P)"));
  zoom_ = add_action(menu, "zoom", tr("&Zoom to the simulation's nodes"), QKeySequence("Z"),
                     [this] { pick("zoom"); });
  zoom_->setCheckable(true);
  zoom_->setToolTip(tr("Click a point of the patch: the simulation's nodes there are read and drawn (Z)"));
  measure_ =
      add_action(menu, "measure", tr("&Measure on the skin"), QKeySequence("M"), [this] { measure(); });
  measure_->setCheckable(true);
  measure_->setToolTip(tr(
      "Click places of the skin: the distances between them, the angle at the second of three and the area "
      "of "
      "more are told, and move with it (M)"));
  add_action(menu, "closer_off", tr("&No probe, zoom and ruler"), QKeySequence("Esc"), [this] {
    pick("");
    if (session_.state().probe) say("probe clear");
    if (session_.state().zoom) say("zoom off");
    if (!session_.state().ruler.empty()) say("measure clear");
  });
  figure_menu_ = menu->addMenu(tr("&How it works"));
  for (const std::string& name : overlay_figures())
    add_action(figure_menu_, ("figure_" + name).c_str(), QString::fromStdString(name), {}, [this, name] {
      say("figure " + name);
    })->setCheckable(true);
}

/// Another time the same: no more.
void MainWindow::pick(const std::string& command) {
  if (!command.empty() && !(session_.study() && !session_.mesh())) {
    message_->tell(session_.mesh()
                       ? tr("What is probed and zoomed to is the patch that was simulated (Cut, Back to "
                            "the patch, or the command patch), not a mesh.")
                       : tr("No study is open, so that there is nothing to look closer at."));
    return follow_tools();
  }
  scene_->set_picking(command == scene_->picking() ? "" : command);
  follow_tools();
}

/// Another measurement begins; another time the same: the last one stays, and no more is added.
void MainWindow::measure() {
  const bool begins = scene_->picking() != measuring_picks && session_.has_scene();
  if (begins && !session_.state().ruler.empty()) say("measure clear");
  if (!session_.has_scene()) message_->tell(tr("Nothing is open, so that there is nothing to measure."));
  scene_->set_picking(begins ? measuring_picks : "");
  follow_tools();
}

void MainWindow::follow_picking() {
  const std::string& picking = scene_->picking();
  if (!picking.empty() &&
      (picking == measuring_picks ? !session_.has_scene() : !session_.study() || session_.mesh()))
    scene_->set_picking("");
  probe_->setChecked(picking == "probe");
  zoom_->setChecked(picking == "zoom");
  measure_->setChecked(picking == measuring_picks);
}

}  // namespace cleft
