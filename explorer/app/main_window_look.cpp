// The menu of how the surface is drawn.
#include <QAction>
#include <QMenu>

#include "base/text.h"
#include "explorer/app/main_window.h"
#include "explorer/scene/color_maps.h"

namespace cleft {

namespace {
constexpr double warps[] = {1, 2, 5};
constexpr const char* trimmed = "2% 98%";
}  // namespace

void MainWindow::make_look_menu(QMenu* menu) {
  look_menu_ = menu;
  const auto checkable = [&](const std::string& name, const QString& text, std::function<void()> run,
                             const QKeySequence& key = {}) {
    add_action(menu, name.c_str(), text, key, std::move(run))->setCheckable(true);
  };
  for (const double factor : warps)
    checkable("warp_" + shortest(factor), tr("Displacements %1 times as large").arg(factor),
              [this, factor] { say("warp " + shortest(factor)); });
  menu->addSeparator();
  checkable("map_auto", tr("Usual colours"), [this] { say("map auto"); });
  for (const ColorMap& map : color_maps())
    checkable("map_" + map.name, QString::fromStdString(map.name + ": " + map.help),
              [this, name = map.name] { say("map " + name); });
  menu->addSeparator();
  checkable("trim", tr("Colours from 2 to 98 % of the values"), [this] {
    say(session_.state().percentiles ? std::string("range auto") : std::string("range ") + trimmed);
  });
  checkable("shading", tr("Light as on skin and &wounds"),
            [this] { say(session_.state().lifelike ? "shading plain" : "shading skin"); });
  checkable(
      "edges", tr("&Edges of triangles"), [this] { say(session_.state().edges ? "edges off" : "edges on"); },
      QKeySequence("E"));
  checkable("clip", tr("Section across the &first cut"), [this] {
    if (session_.state().clip) return void(say("clip off"));
    const bool mesh = session_.mesh() != nullptr;
    const double length = mesh && !session_.state().cuts.empty() ? session_.cut_paths().front().length()
                          : session_.study()                     ? session_.cut_length_of_fields()
                                                                 : 0;
    say("clip cut 1 " + shortest(length / 2));
  });
}

void MainWindow::follow_look() {
  const SessionState& s = session_.state();
  const auto check = [&](const std::string& name, bool on) {
    findChild<QAction*>(QString::fromStdString(name))->setChecked(on);
  };
  look_menu_->setEnabled(session_.has_scene());
  for (const double factor : warps) check("warp_" + shortest(factor), s.warp == factor);
  check("map_auto", s.map.empty());
  for (const ColorMap& map : color_maps()) check("map_" + map.name, s.map == map.name);
  check("trim", s.percentiles.has_value());
  check("shading", s.lifelike);
  check("edges", s.edges);
  check("clip", s.clip.has_value());
}

}  // namespace cleft
