// The window over a study of four cases, made on the spot.
#pragma once

#include "explorer/app/main_window.h"
#include "explorer/io/mesh_file.h"
#include "explorer/view/picture.h"
#include "tests/app/mouse.h"
#include "tests/session/session_fixture.h"

namespace cleft {

/// A study as SessionTest makes it, a real mesh file, and the window.
class WindowTest : public SessionTest {
 protected:
  WindowTest() {
    write_mesh(mesh(), flat_plate());
    window_.resize(1280, 720);
    window_.show();
    QApplication::setActiveWindow(&window_);  // there is no window manager to do so
    settle(20);
  }

  std::string mesh() const { return folder_ / "plate.stl"; }
  const SessionState& now() const { return real_.state(); }
  void tell(const std::string& line) { ASSERT_TRUE(window_.say(line)) << window_.message().toStdString(); }
  void wait_for_figures() {
    const auto known = [&] {
      for (int i = 0; i < 4; ++i)
        if (!real_.knows_figures(i)) return false;
      return true;
    };
    for (int tries = 0; tries < 100 && !known(); ++tries) settle(20);
    settle(20);
  }
  template <class T>
  T& widget(const char* name) {
    auto* found = window_.findChild<T*>(name);
    if (!found) throw std::runtime_error(std::string("no widget is named ") + name);
    return *found;
  }

  Session real_{session_services([](const std::string&) {})};
  MainWindow window_{real_};
};

}  // namespace cleft
