// The changes by a line, for the listeners of a session.
#pragma once

namespace cleft {

struct Changes {
  bool study = false, shown = false, cuts = false, time = false, playing = false, coloring = false,
       camera = false, layout = false, look = false, brushes = false, closer = false, detail = false,
       answers = false, lists = false;
  void all() {
    study = shown = cuts = time = playing = coloring = camera = layout = look = brushes = closer = detail =
        answers = lists = true;
  }
};

}  // namespace cleft
