#include "explorer/view/explore_window.h"

#include <vtkCallbackCommand.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <cmath>

#include "base/error.h"
#include "explorer/view/offscreen_window.h"

namespace cleft {
namespace {

/// Calls (window.*set)(value) whenever the slider has moved.
template <void (ExploreWindow::*set)(double)>
void observe(vtkSliderWidget* slider, ExploreWindow* window) {
  vtkNew<vtkCallbackCommand> moved;
  moved->SetClientData(window);
  moved->SetCallback([](vtkObject* caller, unsigned long, void* data, void*) {
    auto* widget = static_cast<vtkSliderWidget*>(caller);
    auto* look = static_cast<vtkSliderRepresentation*>(widget->GetRepresentation());
    (static_cast<ExploreWindow*>(data)->*set)(look->GetValue());
  });
  slider->AddObserver(vtkCommand::InteractionEvent, moved);
}

}  // namespace

ExploreWindow::ExploreWindow(Explorer& explorer, int width, int height) : explorer_(explorer) {
  if (!has_display())
    throw InputError(
        "no display to open a window on (DISPLAY is not set or no X server answers): use --screenshot F.png "
        "for a picture");
  window_->SetMultiSamples(0);
  window_->SetSize(width, height);
  window_->SetWindowName("cleft explore");
  window_->AddRenderer(explorer.view().renderer());
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(vtkNew<vtkInteractorStyleTrackballCamera>());

  place(time_, 0.08, "t = %.1f mm");
  time_.look->SetMinimumValue(0);
  observe<&ExploreWindow::set_time>(time_.widget, this);

  const int cases = explorer.study().size();
  place(case_, 0.20, "%.0f");
  case_.look->SetMinimumValue(1);
  case_.look->SetMaximumValue(std::max(cases, 2));
  observe<&ExploreWindow::set_case>(case_.widget, this);
  if (cases == 1) case_.widget->EnabledOff();
  label_case();
}

ExploreWindow::~ExploreWindow() {
  time_.widget->EnabledOff(), case_.widget->EnabledOff();
  window_->RemoveRenderer(explorer_.view().renderer());
}

void ExploreWindow::place(Slider& slider, double height, const char* format) {
  vtkSliderRepresentation2D* look = slider.look;
  for (vtkCoordinate* end : {look->GetPoint1Coordinate(), look->GetPoint2Coordinate()})
    end->SetCoordinateSystemToNormalizedDisplay();
  look->GetPoint1Coordinate()->SetValue(0.06, height);
  look->GetPoint2Coordinate()->SetValue(0.5, height);
  look->SetLabelFormat(format);
  look->SetSliderLength(0.018), look->SetSliderWidth(0.022), look->SetTubeWidth(0.005);
  look->SetEndCapLength(0.004), look->SetEndCapWidth(0.014);
  look->SetLabelHeight(0.022), look->SetTitleHeight(0.022);
  for (vtkProperty2D* part : {look->GetTubeProperty(), look->GetCapProperty()})
    part->SetColor(0.35, 0.37, 0.40);
  look->GetSliderProperty()->SetColor(0.75, 0.25, 0.2);
  look->GetSelectedProperty()->SetColor(0.9, 0.4, 0.3);
  for (vtkTextProperty* text : {look->GetLabelProperty(), look->GetTitleProperty()}) {
    text->SetColor(0.1, 0.1, 0.12);
    text->BoldOff(), text->ShadowOff();
  }
  slider.widget->SetInteractor(interactor_);
  slider.widget->SetRepresentation(look);
  slider.widget->SetAnimationModeToJump();
  slider.widget->EnabledOn();
}

void ExploreWindow::set_time(double t) {
  explorer_.view().set_time(t);
  interactor_->Render();
}

void ExploreWindow::set_case(double number) {
  const int i = static_cast<int>(std::lround(number)) - 1;
  if (i == explorer_.shown_case()) return;
  explorer_.show_case(i);
  label_case();
  interactor_->Render();
}

void ExploreWindow::label_case() {
  const int i = explorer_.shown_case();
  case_.look->SetValue(i + 1);
  case_.look->SetTitleText(explorer_.study().name(i).c_str());
  time_.look->SetMaximumValue(explorer_.view().duration());
  time_.look->SetValue(explorer_.view().time());
  window_->SetWindowName(("cleft explore: " + explorer_.study().name(i)).c_str());
}

void ExploreWindow::run() {
  interactor_->Initialize();
  window_->Render();
  interactor_->Start();
}

}  // namespace cleft
