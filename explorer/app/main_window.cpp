#include "explorer/app/main_window.h"

#include <QApplication>
#include <QClipboard>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QMimeData>
#include <QScrollArea>
#include <QSettings>
#include <QStatusBar>
#include <QVBoxLayout>

#include "base/error.h"
#include "base/message.h"
#include "base/text.h"
#include "explorer/app/case_wall.h"
#include "explorer/app/direction.h"
#include "explorer/app/help_sheet_dialog.h"
#include "explorer/app/parallel_coordinates.h"
#include "explorer/app/parameter_panel.h"
#include "explorer/app/plots.h"
#include "explorer/app/time_bar.h"
#include "explorer/app/unit_dialog.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/session/command_table.h"
#include "explorer/wound/mesh_unit.h"

namespace cleft {

namespace {
constexpr const char *geometry_key = "geometry", *layout_key = "layout";  // of the settings

/// Whether a table has openings or motions; that of a blade's path has normals.
bool holds_measurements(const std::string& path) {
  try {
    const NumberTable table = read_csv(path);
    for (const char* name : {"gape", "displacement", "du", "dv", "dw"})
      if (table.column(name) >= 0) return true;
  } catch (const InputError&) {  // the command that reads it tells what is wrong
  }
  return false;
}

}  // namespace

MainWindow::MainWindow(Session& session) : session_(session) {
  setObjectName("main_window");
  setWindowTitle("Cleft");
  setAcceptDrops(true);
  QApplication::instance()->installEventFilter(this);
  setDockNestingEnabled(true);
  make_middle();
  make_docks();
  make_actions();
  make_tools();
  status_ = new QLabel(this);
  status_->setObjectName("status");
  statusBar()->addWidget(status_, 1);
  certainty_ = new QToolButton(this);
  certainty_->setObjectName("certainty");
  certainty_->setAutoRaise(true);
  certainty_->setFixedHeight(certainty_->fontMetrics().height() + 2);  // as high without a text
  certainty_->setToolTip(tr("The expected error of the opening: a click tells the reason (wounds)"));
  connect(certainty_, &QToolButton::clicked, this, [this] { say("wounds"); });
  statusBar()->addPermanentWidget(certainty_);
  session_.tell_warnings_elsewhere();  // there
  scene_->drawn = [this] {
    const double ms = 1e3 * scene_->frame_seconds();
    QString text = session_.has_scene()
                       ? tr("%1 ms a picture, %2 a second").arg(ms, 0, 'f', 0).arg(1000 / ms, 0, 'f', 0)
                       : tr("Nothing is open");
    if (session_.mesh())
      text += tr("   |   mesh of %1 triangles, %2 cuts")
                  .arg(session_.scene()->surface().triangles.size())
                  .arg(session_.state().cuts.size());
    if (const auto& seen = session_.seen())
      text += tr("   |   %1 of %2 vertices left at rest, off by at most %3 pixels")
                  .arg(seen->left_out.vertices)
                  .arg(seen->left_out.of)
                  .arg(seen->pixels, 0, 'g', 2);
    if (device_->on()) text += "   |   " + device_->status();
    const QString fits = status_->fontMetrics().elidedText(text, Qt::ElideRight, status_->width());
    status_->setText(fits);
    status_->setToolTip(fits == text ? QString() : text);
  };
  session_.hand_devices_to([this](const std::string& name, const std::string& file) {
    device_->take(name, file);
    follow_tools();
  });
  session_.answer_to([this](const std::string& text) { message_->answer(QString::fromStdString(text)); });
  session_.tell_progress_to(
      [this](const std::string& what, double part) { return show_progress(what, part); });
  session_.listen([this](const Changes& changes) { follow(changes); });
  Changes all;
  all.all();
  follow(all);
  for (const std::string& notice : session_.notices())  // of what was open before there was a window
    message_->answer(QString::fromStdString(notice));
}

MainWindow::~MainWindow() { device_.reset(); }

void MainWindow::make_middle() {
  const Say say_line = [this](const std::string& line) { return say(line); };
  welcome_ = new WelcomePage(
      {[this](const std::string& path) { open_any(path); },
       [this](const Example& example) { open_example(example); }, [this] { choose_study(); },
       [this] { choose(tr("Open a study or a case"), tr("Field files (*.dffd)"), "open", false); },
       [this] { choose_mesh(); }});
  scene_ = new SceneWidget(session_, say_line);
  scene_->too_short = [this](double mm) {
    message_->tell(tr("The blade has moved over %1 mm of skin only, and nothing is cut: %2")
                       .arg(mm, 0, 'g', 2)
                       .arg(tr("is the unit of the mesh right (command unit)? Or drag further.")));
  };
  scene_->missed = [this] {
    const std::string& what = scene_->picking();
    message_->tell(tr("There is no skin at this place to %1: click on the %2 (Esc: no more).")
                       .arg(what == measuring_picks ? tr("measure")
                            : what == "zoom"        ? tr("zoom to")
                                                    : tr("probe"),
                            session_.mesh() ? tr("mesh") : tr("patch")));
  };
  auto* time = new TimeBar(session_, say_line);
  message_ = new MessageBar;
  command_line_ = new QLineEdit;
  command_line_->setObjectName("command_line");
  command_line_->setAccessibleName(tr("Command line"));
  command_line_->setPlaceholderText(
      tr("A command, like: time 12    set tissue.young_modulus 0.02    color gape    help"));
  connect(command_line_, &QLineEdit::returnPressed, this, [this] { take_command_line(); });
  stack_ = new QStackedWidget;
  welcome_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);  // the picture may be smaller
  stack_->addWidget(welcome_);
  stack_->addWidget(scene_);
  auto* middle = new QWidget(this);
  auto* column = new QVBoxLayout(middle);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(stack_, 1);
  column->addWidget(message_);
  column->addWidget(time);
  column->addWidget(command_line_);
  setCentralWidget(middle);
  const Say say_cut = [this](const std::string& line) {
    say_when_free(line);
    return true;
  };
  device_ = std::make_unique<DeviceControl>(session_, *scene_, say_cut, [this](const std::string& text) {
    message_->tell(QString::fromStdString(text));
  });
  panels_ = {scene_, time, device_.get()};
}

void MainWindow::make_docks() {
  const Say say_line = [this](const std::string& line) { return say(line); };
  const auto dock = [this](const char* name, const QString& title, QWidget* inside, Qt::DockWidgetArea area) {
    auto* made = new QDockWidget(title, this);
    made->setObjectName(name);
    made->setWidget(inside);
    made->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetFloatable |
                      QDockWidget::DockWidgetClosable);
    addDockWidget(area, made);
    docks_.push_back(made);
    return made;
  };
  auto* parameters = new ParameterPanel(session_, say_line);
  auto* lines = new ParallelCoordinates(session_, say_line);
  auto* cases = new CaseTable(session_, say_line, [lines] { lines->take_figures(); });
  auto* plots = new Plots(session_, say_line);
  auto* scrolled = new QScrollArea;  // many parameters do not push the other panels away
  scrolled->setWidget(parameters);
  scrolled->setWidgetResizable(true);
  scrolled->setFrameShape(QFrame::NoFrame);
  scrolled->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  dock("parameter_dock", tr("Parameters"), scrolled, Qt::LeftDockWidgetArea);
  dock("case_dock", tr("Cases"), cases, Qt::LeftDockWidgetArea);
  dock("plot_dock", tr("Plots"), plots, Qt::RightDockWidgetArea);
  dock("line_dock", tr("All cases"), lines, Qt::RightDockWidgetArea);
  cases_ = cases;
  for (Panel* panel : std::initializer_list<Panel*>{parameters, cases, plots, lines})
    panels_.push_back(panel);
  make_wall();
}

/// Below the picture; it is a part of the session whether it is shown, however that is asked for.
void MainWindow::make_wall() {
  auto* wall = new CaseWall(
      session_, [this](const std::string& line) { return say(line); }, *cases_);
  wall_ = new QDockWidget(tr("Wall"), this);
  wall_->setObjectName("wall_dock");
  wall_->setWidget(wall);
  addDockWidget(Qt::BottomDockWidgetArea, wall_);
  setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  wall_->hide();
  docks_.push_back(wall_);
  panels_.push_back(wall);
  const auto say_shown = [this] {
    const bool on = !wall_->isHidden();  // a window that is closed or minimised hides no panel
    if (on != session_.state().wall) session_.say(on ? "wall on" : "wall off");
  };
  connect(wall_->toggleViewAction(), &QAction::triggered, this, say_shown);
  connect(wall_->toggleViewAction(), &QAction::toggled, this, say_shown);  // by the panel's own button
}

/// As they are at first.
void MainWindow::arrange_docks() {
  say("wall off");
  for (QDockWidget* dock : docks_) {
    dock->setFloating(false);
    dock->setVisible(dock != wall_);
    addDockWidget(dock == wall_                            ? Qt::BottomDockWidgetArea
                  : dock == docks_[0] || dock == docks_[1] ? Qt::LeftDockWidgetArea
                                                           : Qt::RightDockWidgetArea,
                  dock);
  }
  size_docks();
}

/// At most half of the width is the panels'.
void MainWindow::size_docks() {
  constexpr int left = 372, right = 310;
  const double part = std::min(1., 0.5 * width() / (left + right));
  resizeDocks({docks_[0], docks_[2]}, {static_cast<int>(part * left), static_cast<int>(part * right)},
              Qt::Horizontal);
  resizeDocks({docks_[0], docks_[1]}, {230, 330}, Qt::Vertical);
  resizeDocks({docks_[2], docks_[3]}, {360, 230}, Qt::Vertical);
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (!sized_) size_docks();
  sized_ = true;
}

void MainWindow::restore_layout(bool place) {
  const QSettings settings("cleft", "explore");
  if (place) restoreGeometry(settings.value(geometry_key).toByteArray());
  sized_ = restoreState(settings.value(layout_key).toByteArray());
  if (session_.state().wall)
    wall_->show();  // a script has asked for it
  else if (!wall_->isHidden())
    session_.say("wall on");
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QSettings settings("cleft", "explore");
  settings.setValue(geometry_key, saveGeometry());
  settings.setValue(layout_key, saveState());
  QMainWindow::closeEvent(event);
}

bool MainWindow::say(const std::string& line) {
  if (saying_) return false;  // events while a line is being done
  saying_ = true;
  message_->tell("");
  since_said_.start();
  try {
    session_.say(line);
    saying_ = false;
    progress_.reset();
    return true;
  } catch (const std::exception& e) {
    saying_ = false;
    progress_.reset();
    message_->tell(QString::fromStdString(message_of(e)));
    Changes all;  // widgets that were ahead of the session come back to it
    all.time = all.shown = all.coloring = all.playing = true;
    follow(all);
    return false;
  }
}

/// At once, or when the line that is being done is done.
void MainWindow::say_when_free(const std::string& line) {
  constexpr int again = 50;  // ms
  if (saying_)
    QTimer::singleShot(again, this, [this, line] { say_when_free(line); });
  else
    say(line);
}

/// What takes longer than a moment is shown, and can be cancelled.
bool MainWindow::show_progress(const std::string& what, double part) {
  constexpr int moment = 300, steps = 1000;  // ms
  if (!saying_ || (!progress_ && since_said_.elapsed() < moment)) return true;
  if (!progress_) {
    progress_ = std::make_unique<QProgressDialog>("", tr("Cancel"), 0, steps, this);
    progress_->setObjectName("progress");
    progress_->setWindowModality(Qt::WindowModal);
    progress_->setMinimumDuration(0);
    progress_->setAutoReset(false);
  }
  progress_->setLabelText(QString::fromStdString(what) + " ...");
  progress_->setValue(static_cast<int>(part * steps));
  QApplication::processEvents();
  return !progress_->wasCanceled();
}

void MainWindow::take_command_line() {
  const std::string line = command_line_->text().toStdString();
  if (line == "help") return show_help();
  if (!say(line)) return;
  command_line_->clear();
  stack_->currentWidget()->setFocus();  // Space and arrows are the picture's again
}

void MainWindow::follow(const Changes& changes) {
  stack_->setCurrentWidget(session_.has_scene() ? static_cast<QWidget*>(scene_) : welcome_);
  if (changes.study && session_.study()) remember_recent(session_.state().study);
  if (changes.study && session_.mesh()) remember_recent(session_.state().mesh);
  if (changes.study) fill_recent(), welcome_->refresh();
  if (changes.look) paint_theme();
  if (wall_->isHidden() == session_.state().wall) wall_->setVisible(session_.state().wall);
  follow_tools();
  const std::vector<Validity>& validity = session_.validity();
  certainty_->setEnabled(!validity.empty());  // always there, so that nothing moves
  certainty_->setText(validity.empty() ? QString()
                                       : left_to_right(QString::fromStdString(error_of_openings(validity))));
  for (Panel* panel : panels_) panel->follow(changes);
  const std::string& study = session_.state().study;
  setWindowTitle(study.empty() ? "Cleft" : tr("Cleft: %1").arg(QString::fromStdString(study)));
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls()) open_any(url.toLocalFile().toStdString());
  event->acceptProposedAction();
}

void MainWindow::open_any(const std::string& path) {
  const std::string ending = ending_of(path);
  const bool mesh = is_mesh(path, MeshKind::surface);
  const bool state = ending == ".json" || ending == ".png";
  if (mesh) return open_mesh(path);
  if (ending == ".csv" && session_.study() && holds_measurements(path))
    return void(say("fit " + quoted(path)));
  say((state ? "load " : ending == ".csv" ? "cut-file " : "open ") + quoted(path));
}

/// What is computed first is told with its command, which is then in the clipboard, too.
void MainWindow::open_example(const Example& example) {
  for (const std::string& line : example.lines)
    if (!say(line)) return;
  if (example.command.isEmpty()) return;
  QApplication::clipboard()->setText(example.command);
  message_->tell({});
  message_->answer(
      tr("This family is computed first, in about three minutes on two cores. The command, for a "
         "terminal, is in the clipboard; then click here again:") +
      "\n" + example.command);
}

void MainWindow::choose_mesh() {
  const QString path = QFileDialog::getOpenFileName(this, tr("Open a mesh"), {},
                                                    QString::fromStdString(surface_filter(MeshUse::read)));
  if (!path.isEmpty()) open_mesh(path.toStdString());
}

/// Where it would be too small or too large in mm, its unit is asked for.
void MainWindow::open_mesh(const std::string& path) {
  double mm = 1;
  try {
    const double extent = extent_of(session_.services().read_mesh(path));
    const double cut_length = session_.cut_length_of_fields();
    if (extent > 0 && !is_sensible_extent(extent, cut_length)) {
      UnitDialog dialog(this, extent, cut_length);
      if (dialog.exec() != QDialog::Accepted) return;
      mm = dialog.mm();
    }
  } catch (const std::exception&) {  // the command tells what is wrong
  }
  say("mesh " + quoted(path) + (mm == 1 ? "" : " " + shortest(mm)));
}

void MainWindow::choose(const QString& title, const QString& filter, const std::string& command, bool save) {
  const QString path = save ? QFileDialog::getSaveFileName(this, title, {}, filter)
                            : QFileDialog::getOpenFileName(this, title, {}, filter);
  if (!path.isEmpty()) say(command + " " + quoted(path.toStdString()));
}

void MainWindow::choose_study() {
  const QString path = QFileDialog::getExistingDirectory(this, tr("Open a study folder"));
  if (!path.isEmpty()) say("open " + quoted(path.toStdString()));
}

void MainWindow::show_help() {
  if (auto* shown = findChild<QDialog*>("help")) return shown->show(), shown->raise();
  (new HelpSheet(this, findChildren<QAction*>()))->show();
}

}  // namespace cleft
