// The page instead of the picture while nothing is open: the studies opened last.
#pragma once

#include <QListWidget>
#include <QWidget>
#include <functional>
#include <string>

namespace cleft {

/// The files and folders opened last, newest first; kept in the user's settings.
QStringList recent_files();
void remember_recent(const std::string& path);

class WelcomePage : public QWidget {
 public:
  WelcomePage(std::function<void(const std::string&)> open, const std::function<void()>& choose_folder,
              const std::function<void()>& choose_file);
  void refresh();

 private:
  std::function<void(const std::string&)> open_;
  QListWidget* recent_;
};

}  // namespace cleft
