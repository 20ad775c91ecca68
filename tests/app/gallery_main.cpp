// gallery SCRIPT OUT WIDTH HEIGHT: does the script's lines in a window, and takes a picture of the whole
// window at every line `shot NAME`. Further lines: `close` (dialogs), `click OBJECT` (a button or menu entry,
// by its object name), `drag X0 Y0 X1 Y1` over the picture.
#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QStyleFactory>
#include <QSurfaceFormat>
#include <QTabWidget>
#include <QThread>
#include <fstream>
#include <iostream>

#include "explorer/app/main_window.h"
#include "explorer/session/command_table.h"
#include "explorer/view/picture.h"
#include "tests/app/mouse.h"

using namespace cleft;

namespace {

void shoot(MainWindow& window, const std::string& file) {
  settle();
  QPixmap picture = window.grab();
  for (QDialog* dialog : window.findChildren<QDialog*>())
    if (dialog->isVisible()) {
      QPainter painter(&picture);
      painter.drawPixmap((window.width() - dialog->width()) / 2, (window.height() - dialog->height()) / 2,
                         dialog->grab());
    }
  picture.save(QString::fromStdString(file), "PNG", 0);  // packed as tightly as can be
}

bool click(MainWindow& window, const std::string& name) {
  const QString object = QString::fromStdString(name);
  if (auto* action = window.findChild<QAction*>(object)) return action->trigger(), true;
  if (auto* button = window.findChild<QAbstractButton*>(object)) return button->click(), true;
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);
  QSurfaceFormat::setDefaultFormat(format);
  QApplication application(argc, argv);
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  if (argc != 5) return std::cerr << "gallery SCRIPT OUT WIDTH HEIGHT\n", 2;
  Session session(session_services([](const std::string& text) { std::cout << text << '\n'; }));
  MainWindow window(session);
  window.resize(std::atoi(argv[3]), std::atoi(argv[4]));
  window.show();
  settle();
  std::ifstream script(argv[1]);
  int failures = 0;
  for (std::string line; std::getline(script, line);) {
    const std::vector<std::string> words = split_line(line);
    if (words.empty()) continue;
    if (words[0] == "shot") {
      shoot(window, std::string(argv[2]) + "/" + words[1] + ".png");
    } else if (words[0] == "close") {
      for (QDialog* dialog : window.findChildren<QDialog*>()) dialog->close();
    } else if (words[0] == "click") {
      if (!click(window, words[1])) std::cerr << "nothing is named " << words[1] << '\n', ++failures;
    } else if (words[0] == "page") {
      window.findChild<QTabWidget*>("plot_pages")->setCurrentIndex(std::stoi(words[1]));
    } else if (words[0] == "drag") {  // over the picture, in parts of its width and height
      drag_over(window.scene(), std::stod(words[1]), std::stod(words[2]), std::stod(words[3]),
                std::stod(words[4]));
    } else {
      window.say(line);
    }
    settle();
    while (session.preparing()) settle();
  }
  return failures > 0;
}
