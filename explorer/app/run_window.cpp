#include "explorer/app/run_window.h"

#include <vtkLogger.h>

#include <QApplication>
#include <QStyleFactory>
#include <QSurfaceFormat>

#include "base/error.h"
#include "explorer/app/main_window.h"
#include "explorer/view/offscreen_window.h"

namespace cleft {

void run_window(Session& session, const std::optional<std::array<int, 2>>& size, const std::string& line) {
  if (!has_display())
    throw InputError(
        "no display to open a window on (DISPLAY is not set or no X server answers): use --screenshot F.png "
        "or "
        "--script FILE");
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // what fails is reported by us
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);  // software rendering takes three times as long with them
  QSurfaceFormat::setDefaultFormat(format);
  static int argc = 1;
  static char name[] = "cleft-explore";
  static char* argv[] = {name, nullptr};
  QApplication application(argc, argv);
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  MainWindow window(session);
  constexpr std::array<int, 2> at_first{1280, 720};
  const auto [width, height] = size.value_or(at_first);
  window.resize(width, height);
  window.restore_layout(!size);
  window.show();
  if (!line.empty()) window.say(line);
  QApplication::exec();
}

}  // namespace cleft
