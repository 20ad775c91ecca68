// What a session needs from its owner, as it can neither read mesh files nor draw pictures itself.
#pragma once

#include <functional>
#include <string>

#include "explorer/incision/surface_mesh.h"

namespace cleft {

class Session;

struct MovieFormat {
  int width = 1280, height = 720;  ///< pixels
  double rate = 25;                ///< pictures per second
};

struct SessionServices {
  std::function<SurfaceMesh(const std::string& file)> read_mesh;
  std::function<void(const std::string& file, const SurfaceMesh& mesh)> write_mesh;
  std::function<void(Session& session, const std::string& file, int width, int height, bool transparent)>
      draw;
  /// The saved session in a picture, as JSON.
  std::function<std::string(const std::string& file)> state_in_picture;
  std::function<void(const std::string& text)>
      answer;  ///< shows the answer of a command: one or several lines
  /// Starts a haptic device with its file; "off": stops it. None without a window.
  std::function<void(const std::string& name, const std::string& file)> device = nullptr;
  /// A movie of the growing cut: .ogv, or a folder of PNG files.
  std::function<void(Session& session, const std::string& file, const MovieFormat& format)> film = nullptr;
  /// Shows the progress of a long operation; returns false if the user has cancelled it.
  std::function<bool(const std::string& what, double part)> progress = nullptr;
};

}  // namespace cleft
