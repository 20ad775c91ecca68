// The page instead of the picture while nothing is open: three steps, examples, and what was opened last.
#pragma once

#include <QCoreApplication>
#include <QListWidget>
#include <QScrollArea>
#include <functional>
#include <string>

#include "explorer/app/examples.h"

namespace cleft {

/// The files and folders opened last, newest first; kept in the user's settings.
QStringList recent_files();
void remember_recent(const std::string& path);

class WelcomePage : public QScrollArea {
  Q_DECLARE_TR_FUNCTIONS(WelcomePage)

 public:
  struct Actions {
    std::function<void(const std::string& path)> open;
    std::function<void(const Example&)> open_example;
    std::function<void()> choose_study, choose_file, choose_mesh;
  };
  explicit WelcomePage(Actions actions);
  void refresh();  ///< what was opened last, and which examples are there

 private:
  Actions actions_;
  QWidget* recent_title_;
  QListWidget* recent_;
  QWidget* examples_;
};

}  // namespace cleft
