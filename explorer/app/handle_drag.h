// A handle of a cut under the mouse: what it leads to is drawn while it is dragged, and is a line afterwards.
#pragma once

#include <optional>
#include <string>

#include "explorer/session/session.h"
#include "explorer/view/wound_view.h"

namespace cleft {

/// A place in the picture, from its lower left corner; `ratio` pixels are one of the screen's.
struct PicturePlace {
  int x, y;
  double ratio;
};

class HandleDrag {
 public:
  explicit HandleDrag(Session& session) : session_(session) {}

  /// Takes the handle at a place of the view of the shown case; false: there is none.
  bool press(const WoundView& view, const PicturePlace& at);
  bool pressed() const { return handles_.has_value(); }
  /// A point goes over the skin, a depth along the blade, or with the mouse's height where the blade points
  /// at the eye, and a tilt around the path. What leads nowhere, as a place beside the skin, changes nothing.
  void drag(WoundView& view, const PicturePlace& at);
  /// Lets go. The line that makes what was drawn; empty: nothing has changed.
  std::string release();

  /// The cut, from 0, whose path is drawn at a place of the view; -1: none.
  int cut_at(const WoundView& view, const PicturePlace& at);

 private:
  enum class Kind { point, depth, tilt };
  double dragged_depth(const WoundView& view, const PicturePlace& at) const;
  double dragged_tilt(const WoundView& view, const PicturePlace& at) const;

  Session& session_;
  std::optional<CutHandles> handles_;  // as they were when one was taken
  Kind kind_ = Kind::point;
  int point_ = 0;  // of the cut, from 0
  double pressed_height_ = 0, mm_a_pixel_ = 0;
  std::string line_;
};

}  // namespace cleft
