// The interactive window: the wound, a slider for the length cut and one for the case.
#pragma once

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>

#include "explorer/view/explorer.h"

namespace cleft {

class ExploreWindow {
 public:
  /// `explorer` must outlive the window. Throws InputError where there is no display.
  ExploreWindow(Explorer& explorer, int width, int height);
  ~ExploreWindow();

  /// Draws and reacts until the window is closed.
  void run();

  /// What dragging the sliders does: the length cut in mm, and the case's number from 1.
  void set_time(double t);
  void set_case(double number);

  vtkSliderWidget* time_slider() const { return time_.widget; }
  vtkSliderWidget* case_slider() const { return case_.widget; }

 private:
  struct Slider {
    vtkNew<vtkSliderWidget> widget;
    vtkNew<vtkSliderRepresentation2D> look;
  };
  void place(Slider& slider, double height, const char* format);
  void label_case();

  Explorer& explorer_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  Slider time_, case_;
};

}  // namespace cleft
