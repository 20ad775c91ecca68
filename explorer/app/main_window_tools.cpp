// Menus, tool bar and theme of the window.
#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QMenuBar>
#include <QPalette>
#include <QSignalBlocker>
#include <QStyle>
#include <QToolBar>

#include "base/error.h"
#include "base/text.h"
#include "explorer/app/main_window.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/session/command_table.h"
#include "haptic/devices/list.h"
#include "haptic/devices/plugins.h"

namespace cleft {

QAction* MainWindow::add_action(QMenu* menu, const char* name, const QString& text, const QKeySequence& key,
                                std::function<void()> run) {
  auto* action = new QAction(text, this);
  action->setObjectName(name);
  action->setShortcut(key);
  menu->addAction(action);
  connect(action, &QAction::triggered, this, [run = std::move(run)] { run(); });
  return action;
}

void MainWindow::make_actions() {
  const auto line = [this](const std::string& text) { return [this, text] { say(text); }; };
  QMenu* file = menuBar()->addMenu(tr("&File"));
  add_action(file, "open", tr("&Open a study ..."), QKeySequence("Ctrl+O"), [this] { choose_study(); });
  add_action(file, "open_mesh", tr("Open a &mesh to cut ..."), QKeySequence("Ctrl+M"),
             [this] { choose_mesh(); });
  add_action(file, "open_path", tr("Cut along a &path file ..."), {},
             [this] { choose(tr("Open a path"), tr("Paths (*.csv)"), "cut-file", false); });
  recent_ = file->addMenu(tr("&Recent"));
  file->addSeparator();
  add_action(file, "save", tr("&Save the session ..."), QKeySequence("Ctrl+S"),
             [this] { choose(tr("Save the session"), tr("Sessions (*.json)"), "save", true); });
  add_action(file, "load", tr("&Load a session ..."), QKeySequence("Ctrl+L"), [this] {
    choose(tr("Load a session"), tr("Sessions and pictures (*.json *.png)"), "load", false);
  });
  add_action(file, "screenshot", tr("S&creenshot ..."), QKeySequence("Ctrl+P"),
             [this] { choose(tr("Save a picture"), tr("Pictures (*.png)"), "screenshot", true); });
  add_action(file, "screenshot_transparent", tr("Screenshot &without background ..."), {}, [this] {
    const QString path = QFileDialog::getSaveFileName(this, tr("Save a picture"), {}, tr("Pictures (*.png)"));
    const QSize size = scene_->size();
    if (!path.isEmpty())
      say("screenshot " + quoted(path.toStdString()) + " " + std::to_string(size.width()) + " " +
          std::to_string(size.height()) + " transparent");
  });
  add_action(file, "movie", tr("M&ovie ..."), {},
             [this] { choose(tr("Save a movie"), tr("Movies (*.ogv)"), "movie", true); });
  add_action(file, "export", tr("&Export the cut mesh ..."), {}, [this] {
    choose(tr("Export the mesh"), QString::fromStdString(surface_filter(MeshUse::write)), "export", true);
  });
  add_action(file, "record", tr("&Write the commands so far ..."), {},
             [this] { choose(tr("Write the commands"), tr("Scripts (*.txt)"), "record", true); });
  file->addSeparator();
  add_action(file, "quit", tr("&Quit"), QKeySequence("Ctrl+Q"), [this] { close(); });

  QMenu* edit = menuBar()->addMenu(tr("&Cut"));
  scalpel_ = add_action(edit, "scalpel", tr("S&calpel"), QKeySequence("C"), [this] {
    if (scalpel_->isChecked()) brush_->setChecked(false), scene_->set_painting(false);
    scene_->set_cutting(scalpel_->isChecked());
  });
  scalpel_->setCheckable(true);
  scalpel_->setToolTip(tr("Press and drag over the skin to cut it (C)"));
  brush_ = add_action(edit, "tension_brush", tr("&Tension brush"), QKeySequence("T"), [this] {
    if (brush_->isChecked()) scalpel_->setChecked(false), scene_->set_cutting(false);
    scene_->set_painting(brush_->isChecked());
  });
  brush_->setCheckable(true);
  brush_->setToolTip(tr("Press and drag over the skin along its larger tension: cuts turn against it (T)"));
  handles_ = add_action(edit, "handles", tr("&Handles of a cut"), QKeySequence("H"), [this] {
    const SessionState& s = session_.state();
    say(s.handled >= 0 ? std::string("handles off") : "handles " + std::to_string(s.cuts.size()));
    follow_tools();
  });
  handles_->setCheckable(true);
  handles_->setToolTip(tr(
      "Drag the balls of a cut to move its path over the skin, to deepen and to tilt it; click another cut "
      "to "
      "have its balls (H)"));
  undo_ = add_action(edit, "undo", tr("&Undo"), QKeySequence("Ctrl+Z"),
                     [this] { say(session_.line_to_take_back().empty() ? "undo" : "undo any"); });
  redo_ = add_action(edit, "redo", tr("&Redo"), QKeySequence("Ctrl+Shift+Z"),
                     [this] { say(session_.line_to_make_again().empty() ? "redo" : "redo any"); });
  simulate_ = add_action(edit, "simulate", tr("S&imulate the cuts"), QKeySequence("Ctrl+Shift+S"), [this] {
    say(simulate_->isChecked() ? "simulate on" : "simulate off");
    simulate_->setChecked(session_.state().simulate);
  });
  simulate_->setCheckable(true);
  simulate_->setToolTip(tr("Show the cuts as a simulation of this very body opens them, in seconds"));
  constexpr int milliseconds_between_looks = 200;
  simulating_.setInterval(milliseconds_between_looks);
  connect(&simulating_, &QTimer::timeout, this, [this] { session_.take_simulated(); });
  make_device_menu(edit->addMenu(tr("&Haptic device")));
  add_action(edit, "patch", tr("Back to the &patch"), {}, line("patch"));

  QMenu* view = menuBar()->addMenu(tr("&View"));
  add_action(view, "front", tr("&Camera to the front"), QKeySequence("Home"), line("camera 0 0"));
  add_action(view, "single", tr("&One view"), QKeySequence("1"), line("single"));
  add_action(view, "compare", tr("&Compare the selected cases, or four from this one"), QKeySequence("4"),
             [this] { compare_cases(); });
  add_action(view, "previous", tr("Case &before"), QKeySequence("PgUp"), line("previous"));
  add_action(view, "next", tr("&Next case"), QKeySequence("PgDown"), line("next"));
  add_action(view, "play_pause", tr("&Play or pause"), QKeySequence("Space"),
             [this] { say(session_.state().playing ? "pause" : "play"); });
  add_action(view, "back", tr("&Back by 1 mm"), QKeySequence("Left"), line("step -1"));
  add_action(view, "on", tr("On by 1 &mm"), QKeySequence("Right"), line("step 1"));
  QMenu* panels = view->addMenu(tr("P&anels"));
  for (QDockWidget* dock : docks_) panels->addAction(dock->toggleViewAction());
  panels->addSeparator();
  add_action(panels, "arrange", tr("&As they were at first"), {}, [this] { arrange_docks(); });
  add_action(view, "command", tr("Command &line"), QKeySequence("Ctrl+K"),
             [this] { command_line_->setFocus(); });
  make_closer_actions(view);
  make_detail_menu(view->addMenu(tr("&Level of detail")));
  make_look_menu(view->addMenu(tr("&Surface")));
  dark_ = add_action(view, "dark", tr("&Dark"), QKeySequence("Ctrl+D"),
                     [this] { say(session_.state().dark ? "theme light" : "theme dark"); });
  dark_->setCheckable(true);

  QMenu* help = menuBar()->addMenu(tr("&Help"));
  add_action(help, "help_sheet", tr("&Keys and commands"), QKeySequence("F1"), [this] { show_help(); });
}

/// Those selected in the table, if there are several; else four from the shown one on.
void MainWindow::compare_cases() {
  if (!session_.study()) return static_cast<void>(say("compare 1 2"));
  std::vector<int> cases = cases_->selected();
  const int count = session_.study()->size();
  if (cases.size() < 2) {
    cases.clear();
    for (int k = 0; k < std::min(count, 4); ++k) cases.push_back((session_.state().shown + k) % count);
  }
  std::string line = "compare";
  for (const int i : cases) line += " " + std::to_string(i + 1);
  say(line);
}

/// What a cut in a mesh never moves by more than that stays at rest.
void MainWindow::make_detail_menu(QMenu* menu) {
  detail_menu_ = menu;
  const std::pair<const char*, const char*> details[] = {
      {"off", QT_TR_NOOP("&All motion")},
      {"0.1px", QT_TR_NOOP("Motion of more than 0.&1 pixels")},
      {"0.25px", QT_TR_NOOP("Motion of more than 0.&25 pixels")},
      {"0.5px", QT_TR_NOOP("Motion of more than 0.&5 pixels")},
      {"1px", QT_TR_NOOP("Motion of more than a &pixel")},
      {"10um", QT_TR_NOOP("Motion of more than 10 &micrometres")}};
  for (const auto& [amount, text] : details)
    add_action(menu, (std::string("detail_") + amount).c_str(), tr(text), {},
               [this, amount = std::string(amount)] { say("detail " + amount); })
        ->setCheckable(true);
}

void MainWindow::make_device_menu(QMenu* menu) {
  device_menu_ = menu;
  menu->setToolTipsVisible(true);
  add_action(menu, "device_off", tr("&None"), {}, [this] { say("device off"); })->setCheckable(true);
  for (const DeviceKind& kind : built_in_devices()) add_device(kind);
  // Plug-ins are code of others: they are loaded when somebody looks for them, and not with the window.
  connect(menu, &QMenu::aboutToShow, this, [this] { add_plugins(); });
}

void MainWindow::add_device(const DeviceKind& kind) {
  const QString title = QString::fromStdString(kind.title);
  QAction* action = add_action(device_menu_, ("device_" + kind.name).c_str(), title, {}, [this, kind, title] {
    if (kind.input)
      choose(title, kind.input->filter, "device " + kind.name, false);
    else
      say("device " + kind.name);
  });
  action->setCheckable(true);
  action->setToolTip(QString::fromStdString(kind.help));
}

/// Those that cannot be used are there, too, with the reason.
void MainWindow::add_plugins() {
  for (const std::string& file : plugin_files()) {
    const std::string name = "device_" + plugin_name(file);
    if (findChild<QAction*>(QString::fromStdString(name))) continue;
    try {
      add_device(plugin_device(file));
    } catch (const InputError& e) {
      QAction* action = add_action(device_menu_, name.c_str(), QString::fromStdString(file), {}, [] {});
      action->setEnabled(false);
      action->setToolTip(e.what());
    }
  }
  follow_tools();
}

void MainWindow::make_tools() {
  QToolBar* bar = addToolBar(tr("Tools"));
  bar->setObjectName("tools");
  bar->setMovable(false);
  bar->addWidget(new QLabel(tr(" Colour by ")));
  coloring_ = new QComboBox;
  coloring_->setObjectName("coloring");
  coloring_->setAccessibleName(tr("Colour by"));
  coloring_->setToolTip(tr("What the surface is coloured by"));
  bar->addWidget(coloring_);
  connect(coloring_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int i) { say("color " + coloring_->itemText(i).toStdString()); });
  bar->addSeparator();
  bar->addAction(scalpel_);
  depth_ = new QDoubleSpinBox;
  depth_->setObjectName("depth");
  depth_->setAccessibleName(tr("Depth of cuts"));
  depth_->setRange(0, 50);
  depth_->setSingleStep(0.5);
  depth_->setSuffix(tr(" mm deep"));
  depth_->setSpecialValueText(tr("the case's depth"));
  depth_->setToolTip(tr("Depth of the cuts to come, mm"));
  tilt_ = new QDoubleSpinBox;
  tilt_->setObjectName("tilt");
  tilt_->setAccessibleName(tr("Tilt of the blade"));
  tilt_->setRange(-60, 60);
  tilt_->setSingleStep(5);
  tilt_->setDecimals(0);
  tilt_->setPrefix(tr("tilt "));
  tilt_->setSuffix("\u00b0");
  tilt_->setToolTip(tr("How far the blade leans to its left, degrees"));
  bar->addWidget(depth_);
  bar->addWidget(tilt_);
  connect(depth_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this](double depth) { scene_->set_depth(depth); });
  connect(tilt_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this](double tilt) { scene_->set_tilt(tilt); });
  bar->addAction(handles_);
  bar->addAction(undo_);
  bar->addAction(redo_);
  bar->addSeparator();
  const std::pair<const char*, QString> short_texts[] = {
      {"handles", tr("Handles")},    {"probe", tr("Probe")},     {"zoom", tr("Zoom")},
      {"measure", tr("Ruler")},      {"compare", tr("Compare")}, {"front", tr("Front")},
      {"screenshot", tr("Picture")}, {"help_sheet", tr("Help")}};
  for (const auto& [name, text] : short_texts) findChild<QAction*>(name)->setIconText(text);
  for (const char* name :
       {"probe", "zoom", "measure", "single", "compare", "front", "screenshot", "help_sheet"})
    bar->addAction(findChild<QAction*>(name));
}

void MainWindow::follow_tools() {
  const SessionState& s = session_.state();
  const QSignalBlocker quiet(coloring_);
  std::vector<ColoringText> all = colorings();
  if (!session_.mesh() || session_.mesh()->colors.empty())
    std::erase_if(all, [](const ColoringText& c) { return c.coloring == Coloring::own; });
  for (const std::string& name : session_.quantities()) {
    all.push_back(text_of(Coloring(name)));
    all.back().name = name;
  }
  coloring_->clear();
  for (const ColoringText& c : all) {
    coloring_->addItem(QString::fromStdString(c.name));
    coloring_->setItemData(coloring_->count() - 1, QString::fromStdString(c.help), Qt::ToolTipRole);
    if (c.coloring == s.coloring) coloring_->setCurrentIndex(coloring_->count() - 1);
  }
  coloring_->setEnabled(session_.has_scene());
  const bool can_cut = session_.mesh() != nullptr;
  if (!can_cut && scalpel_->isChecked()) scalpel_->setChecked(false), scene_->set_cutting(false);
  if (!can_cut && brush_->isChecked()) brush_->setChecked(false), scene_->set_painting(false);
  for (QAction* action : {scalpel_, brush_}) action->setEnabled(can_cut);
  depth_->setEnabled(can_cut), tilt_->setEnabled(can_cut);
  const auto tell_step = [](QAction* action, const std::string& line, const QString& what) {
    constexpr int most = 60;  // letters
    const QString words = QString::fromStdString(line);
    action->setToolTip(line.empty() ? action->text().remove('&')
                                    : what.arg(words.size() > most ? words.left(most) + " ..." : words));
  };
  tell_step(undo_, session_.line_to_take_back(), tr("Undo: %1"));
  tell_step(redo_, session_.line_to_make_again(), tr("Redo: %1"));
  undo_->setEnabled(!s.cuts.empty() || !s.tensions.empty() || !session_.line_to_take_back().empty());
  handles_->setEnabled(can_cut && !s.cuts.empty());
  handles_->setChecked(s.handled >= 0);
  simulate_->setEnabled(session_.mesh() != nullptr);
  simulate_->setChecked(s.simulate);
  if (session_.simulating() != simulating_.isActive())
    session_.simulating() ? simulating_.start() : simulating_.stop();
  redo_->setEnabled(!s.undone.empty() || !s.tensions_undone.empty() || !s.edits_undone.empty() ||
                    !session_.line_to_make_again().empty());
  dark_->setChecked(s.dark);
  device_menu_->setEnabled(can_cut);
  follow_picking();
  between_->setEnabled(session_.study() != nullptr);
  between_->setChecked(s.between);
  figure_menu_->setEnabled(session_.has_scene());
  const QString figure = "figure_" + QString::fromStdString(s.figure.empty() ? "off" : s.figure);
  for (QAction* action : figure_menu_->actions()) action->setChecked(action->objectName() == figure);
  follow_look();
  detail_menu_->setEnabled(can_cut);
  const QString detail = "detail_" + QString::fromStdString(s.detail ? text_of(*s.detail) : "off");
  for (QAction* action : detail_menu_->actions()) action->setChecked(action->objectName() == detail);
  const QString device = "device_" + QString::fromStdString(device_->on() ? device_->name() : "off");
  for (QAction* action : device_menu_->actions()) action->setChecked(action->objectName() == device);
}

void MainWindow::fill_recent() {
  recent_->clear();
  for (const QString& path : recent_files())
    connect(recent_->addAction(path), &QAction::triggered, this,
            [this, path] { open_any(path.toStdString()); });
  recent_->setEnabled(!recent_->isEmpty());
}

void MainWindow::paint_theme() {
  QPalette palette = QApplication::style()->standardPalette();
  // Text has a contrast of at least 4.5 (WCAG, level AA) on all of them.
  palette.setColor(QPalette::Highlight, QColor(0, 114, 178));
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::PlaceholderText, QColor(105, 105, 105));
  if (session_.state().dark) {
    const QColor window(38, 40, 44), base(28, 30, 33), text(224, 224, 224), faint(128, 128, 128);
    palette.setColor(QPalette::Window, window);
    palette.setColor(QPalette::WindowText, text);
    palette.setColor(QPalette::Base, base);
    palette.setColor(QPalette::AlternateBase, window);
    palette.setColor(QPalette::ToolTipBase, base);
    palette.setColor(QPalette::ToolTipText, text);
    palette.setColor(QPalette::Text, text);
    palette.setColor(QPalette::Button, QColor(52, 55, 60));
    palette.setColor(QPalette::ButtonText, text);
    palette.setColor(QPalette::Link, QColor(86, 180, 233));
    palette.setColor(QPalette::PlaceholderText, QColor(150, 150, 150));
    for (const auto role : {QPalette::Text, QPalette::ButtonText, QPalette::WindowText})
      palette.setColor(QPalette::Disabled, role, faint);
  }
  QApplication::setPalette(palette);
}

}  // namespace cleft
