// The window: the picture, and around it the panels. Widgets only send lines to the session and follow it.
#pragma once

#include <QComboBox>
#include <QCoreApplication>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QProgressDialog>
#include <QStackedWidget>
#include <QTimer>
#include <QToolButton>
#include <vector>

#include "explorer/app/case_table.h"
#include "explorer/app/device_control.h"
#include "explorer/app/message_bar.h"
#include "explorer/app/panel.h"
#include "explorer/app/scene_widget.h"
#include "explorer/app/welcome_page.h"
#include "haptic/devices/device_kind.h"

namespace cleft {

class MainWindow : public QMainWindow {
  Q_DECLARE_TR_FUNCTIONS(MainWindow)

 public:
  explicit MainWindow(Session& session);
  ~MainWindow() override;

  /// Sends a line to the session; a refusal is shown in the message bar.
  bool say(const std::string& line);

  SceneWidget& scene() { return *scene_; }
  const DeviceControl& device() const { return *device_; }
  QString message() const { return message_->message(); }
  /// Puts docks and tool bar where they were when a window was closed last, and the window too with `place`.
  void restore_layout(bool place);

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void make_middle();
  void make_docks();
  void arrange_docks();
  void make_wall();
  void size_docks();
  void compare_cases();
  void make_actions();
  void make_tools();
  void make_device_menu(QMenu* menu);
  void add_device(const DeviceKind& kind);
  void add_plugins();
  void make_closer_actions(QMenu* menu);
  void make_detail_menu(QMenu* menu);
  void make_look_menu(QMenu* menu);
  void follow_look();
  void pick(const std::string& command);
  void measure();
  void follow_picking();
  void say_when_free(const std::string& line);
  bool show_progress(const std::string& what, double part);
  QAction* add_action(QMenu* menu, const char* name, const QString& text, const QKeySequence& key,
                      std::function<void()> run);
  void follow(const Changes& changes);
  void follow_tools();
  void paint_theme();
  void choose(const QString& title, const QString& filter, const std::string& command, bool save);
  void choose_study();
  void choose_mesh();
  void open_example(const Example& example);
  void fill_recent();
  void open_any(const std::string& path);
  void open_mesh(const std::string& path);
  void show_help();
  void take_command_line();

  Session& session_;
  std::vector<Panel*> panels_;
  std::vector<QDockWidget*> docks_;
  QDockWidget* wall_;  ///< the last of them; shown where the session says so
  CaseTable* cases_;
  QStackedWidget* stack_;
  WelcomePage* welcome_;
  SceneWidget* scene_;
  std::unique_ptr<DeviceControl> device_;
  MessageBar* message_;
  QLineEdit* command_line_;
  QLabel* status_;
  QToolButton* certainty_;
  QComboBox* coloring_;
  QAction *scalpel_, *brush_, *handles_, *undo_, *redo_, *simulate_, *dark_;
  QTimer simulating_;  // runs while a simulation does
  QDoubleSpinBox *depth_, *tilt_;
  QMenu *recent_, *device_menu_, *figure_menu_, *detail_menu_, *look_menu_;
  QAction *probe_, *zoom_, *measure_, *between_;
  std::unique_ptr<QProgressDialog> progress_;
  QElapsedTimer since_said_;
  bool saying_ = false, sized_ = false;
  std::vector<QAction*> layouts_;
};

}  // namespace cleft
