#include "explorer/app/run_window.h"

#include <QApplication>
#include <QStyleFactory>
#include <QSurfaceFormat>

#include "base/error.h"
#include "explorer/app/main_window.h"
#include "explorer/view/offscreen_window.h"

namespace cleft {

void run_window(Session& session, int width, int height, const std::string& line) {
  if (!has_display())
    throw InputError(
        "no display to open a window on (DISPLAY is not set or no X server answers): use --screenshot F.png "
        "or "
        "--script FILE");
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);  // software rendering takes three times as long with them
  QSurfaceFormat::setDefaultFormat(format);
  static int argc = 1;
  static char name[] = "cleft-explore";
  static char* argv[] = {name, nullptr};
  QApplication application(argc, argv);
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  MainWindow window(session);
  window.resize(width, height);
  window.show();
  if (!line.empty()) window.say(line);
  QApplication::exec();
}

}  // namespace cleft
