// Title, length cut, scale bar and axes around a view's scene.
#pragma once

#include <vtkAxesActor.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <array>
#include <string>

namespace cleft {

class Furniture {
 public:
  /// For a renderer in that window, with a small renderer for the axes in front of it.
  Furniture(vtkRenderWindow* window, vtkRenderer* renderer);
  ~Furniture();

  /// `small`: for a view that shares the window.
  void set_text(const std::string& title, const std::string& time, bool small);
  void set_axes(const std::array<const char*, 3>& names);
  /// The colour of texts and lines for a dark or light background.
  void set_ink(double red, double green, double blue);
  /// Adapts everything to the renderer's part of the window.
  void arrange();

 private:
  void draw_ruler(double pixels_per_mm, const int size[2], double scale);
  void place(vtkTextActor* text, double x, double y);
  void turn_axes();

  vtkRenderWindow* window_;
  vtkRenderer* renderer_;
  unsigned long observer_;
  int title_lines_ = 1;
  vtkNew<vtkRenderer> corner_;
  vtkNew<vtkAxesActor> axes_;
  vtkNew<vtkTextActor> title_, time_, length_;
  vtkNew<vtkPoints> ruler_;
  vtkNew<vtkActor2D> bar_;
};

/// The largest of 1, 2, 5, 10, 20 ... (and 0.5, 0.2 ...) that is at most `most`.
double round_length(double most);

}  // namespace cleft
