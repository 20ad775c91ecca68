#include "explorer/app/main_window.h"

#include <QApplication>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QMimeData>
#include <QStatusBar>
#include <QVBoxLayout>

#include "base/error.h"
#include "explorer/app/case_table.h"
#include "explorer/app/help_sheet_dialog.h"
#include "explorer/app/parallel_coordinates.h"
#include "explorer/app/parameter_panel.h"
#include "explorer/app/plots.h"
#include "explorer/app/time_bar.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/session/command_table.h"

namespace cleft {

MainWindow::MainWindow(Session& session) : session_(session) {
  setObjectName("main_window");
  setWindowTitle("Cleft");
  setAcceptDrops(true);
  setDockNestingEnabled(true);
  make_middle();
  make_docks();
  make_actions();
  make_tools();
  status_ = new QLabel(this);
  status_->setObjectName("status");
  statusBar()->addWidget(status_, 1);
  scene_->drawn = [this] {
    const double ms = 1e3 * scene_->frame_seconds();
    QString text = session_.has_scene()
                       ? QString("%1 ms a picture, %2 a second").arg(ms, 0, 'f', 0).arg(1000 / ms, 0, 'f', 0)
                       : QString("Nothing is open");
    if (session_.mesh())
      text += QString("   |   mesh of %1 triangles, %2 cuts")
                  .arg(session_.scene()->surface().triangles.size())
                  .arg(session_.state().cuts.size());
    if (const auto& seen = session_.seen())
      text += QString("   |   %1 of %2 vertices left at rest, off by at most %3 pixels")
                  .arg(seen->left_out.vertices)
                  .arg(seen->left_out.of)
                  .arg(seen->pixels, 0, 'g', 2);
    if (device_->on()) text += "   |   " + device_->status();
    if (!session_.warnings().empty()) text += "   |   " + QString::fromStdString(session_.warnings().front());
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
      say_line, [this] { choose_study(); },
      [this] { choose("Open a study or a case", "Field files (*.dffd)", "open", false); });
  scene_ = new SceneWidget(session_, say_line);
  auto* time = new TimeBar(session_, say_line);
  message_ = new MessageBar;
  command_line_ = new QLineEdit;
  command_line_->setObjectName("command_line");
  command_line_->setPlaceholderText(
      "A command, like: time 12    set tissue.young_modulus 0.02    color gape    help");
  connect(command_line_, &QLineEdit::returnPressed, this, [this] { take_command_line(); });
  stack_ = new QStackedWidget;
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
  device_ = std::make_unique<DeviceControl>(session_, *scene_, say_line, [this](const std::string& text) {
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
    return made;
  };
  auto* parameters = new ParameterPanel(session_, say_line);
  auto* lines = new ParallelCoordinates(session_, say_line);
  auto* cases = new CaseTable(session_, say_line, [lines] { lines->take_figures(); });
  auto* plots = new Plots(session_);
  auto* parameter_dock = dock("parameter_dock", "Parameters", parameters, Qt::LeftDockWidgetArea);
  auto* case_dock = dock("case_dock", "Cases", cases, Qt::LeftDockWidgetArea);
  auto* plot_dock = dock("plot_dock", "Plots", plots, Qt::RightDockWidgetArea);
  auto* line_dock = dock("line_dock", "All cases", lines, Qt::RightDockWidgetArea);
  resizeDocks({parameter_dock, plot_dock}, {372, 310}, Qt::Horizontal);
  resizeDocks({parameter_dock, case_dock}, {230, 330}, Qt::Vertical);
  resizeDocks({plot_dock, line_dock}, {360, 230}, Qt::Vertical);
  for (Panel* panel : std::initializer_list<Panel*>{parameters, cases, plots, lines})
    panels_.push_back(panel);
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
    message_->tell(QString::fromStdString(e.what()));
    Changes all;  // widgets that were ahead of the session come back to it
    all.time = all.shown = all.coloring = all.playing = true;
    follow(all);
    return false;
  }
}

/// What takes longer than a moment is shown, and can be cancelled.
bool MainWindow::show_progress(const std::string& what, double part) {
  constexpr int moment = 300, steps = 1000;  // ms
  if (!saying_ || (!progress_ && since_said_.elapsed() < moment)) return true;
  if (!progress_) {
    progress_ = std::make_unique<QProgressDialog>("", "Cancel", 0, steps, this);
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
  if (say(line)) command_line_->clear();
}

void MainWindow::follow(const Changes& changes) {
  stack_->setCurrentWidget(session_.has_scene() ? static_cast<QWidget*>(scene_) : welcome_);
  if (changes.study && session_.study()) remember_recent(session_.state().study);
  if (changes.study) fill_recent(), welcome_->refresh();
  if (changes.look) paint_theme();
  follow_tools();
  for (Panel* panel : panels_) panel->follow(changes);
  const std::string& study = session_.state().study;
  setWindowTitle(study.empty() ? "Cleft" : QString::fromStdString("Cleft: " + study));
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
  say((mesh ? "mesh " : state ? "load " : ending == ".csv" ? "cut-file " : "open ") + quoted(path));
}

void MainWindow::choose(const QString& title, const QString& filter, const std::string& command, bool save) {
  const QString path = save ? QFileDialog::getSaveFileName(this, title, {}, filter)
                            : QFileDialog::getOpenFileName(this, title, {}, filter);
  if (!path.isEmpty()) say(command + " " + quoted(path.toStdString()));
}

void MainWindow::choose_study() {
  const QString path = QFileDialog::getExistingDirectory(this, "Open a study folder");
  if (!path.isEmpty()) say("open " + quoted(path.toStdString()));
}

void MainWindow::show_help() {
  if (auto* shown = findChild<QDialog*>("help")) return shown->show(), shown->raise();
  (new HelpSheet(this))->show();
}

}  // namespace cleft
