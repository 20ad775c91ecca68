// What stands around a view's scene: title, length cut, a bar of so many mm, and the directions of the axes.
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
  /// For a renderer in that window; a small renderer for the axes is put above it.
  Furniture(vtkRenderWindow* window, vtkRenderer* renderer);
  ~Furniture();

  /// `small`: of a view that shares the window.
  void set_text(const std::string& title, const std::string& time, bool small);
  void set_axes(const std::array<const char*, 3>& names);
  /// Of texts and lines; the background is the renderer's.
  void set_ink(double red, double green, double blue);
  /// Fits everything to the renderer's part of the window.
  void arrange();

 private:
  void draw_ruler(double pixels_per_mm, const int size[2], double scale);
  void place(vtkTextActor* text, double x, double y);
  void turn_axes();

  vtkRenderWindow* window_;
  vtkRenderer* renderer_;
  unsigned long observer_;
  vtkNew<vtkRenderer> corner_;
  vtkNew<vtkAxesActor> axes_;
  vtkNew<vtkTextActor> title_, time_, length_;
  vtkNew<vtkPoints> ruler_;
  vtkNew<vtkActor2D> bar_;
};

/// The longest of 1, 2, 5, 10, 20 ... (and 0.5, 0.2 ...) that is not above `most`.
double round_length(double most);

}  // namespace cleft
