#include "explorer/view/furniture.h"

#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace cleft {

namespace {

void set_up(vtkTextActor* text, int size) {
  vtkTextProperty* look = text->GetTextProperty();
  look->SetFontSize(size);
  look->SetFontFamilyToArial();
  text->SetTextScaleModeToNone();
}

}  // namespace

double round_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double digit : {5., 2.})
    if (digit * power <= most) return digit * power;
  return power;
}

Furniture::Furniture(vtkRenderWindow* window, vtkRenderer* renderer) : window_(window), renderer_(renderer) {
  set_up(title_, 13), set_up(time_, 13), set_up(length_, 12);
  for (vtkTextActor* text : {title_.Get(), time_.Get()}) text->GetTextProperty()->SetLineSpacing(1.5);
  title_->GetTextProperty()->SetVerticalJustificationToTop();
  time_->GetTextProperty()->SetVerticalJustificationToTop();
  length_->GetTextProperty()->SetJustificationToCentered();

  ruler_->SetNumberOfPoints(4);
  vtkNew<vtkCellArray> line;
  line->InsertNextCell({0, 1, 2, 3});
  vtkNew<vtkPolyData> data;
  data->SetPoints(ruler_);
  data->SetLines(line);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  bar_->SetMapper(mapper);
  for (vtkActor2D* actor : {static_cast<vtkActor2D*>(title_), static_cast<vtkActor2D*>(time_),
                            static_cast<vtkActor2D*>(length_), bar_.Get()})
    renderer_->AddViewProp(actor);

  corner_->SetLayer(1);
  corner_->InteractiveOff();
  corner_->AddActor(axes_);
  axes_->SetTotalLength(1, 1, 1);
  for (vtkCaptionActor2D* caption :
       {axes_->GetXAxisCaptionActor2D(), axes_->GetYAxisCaptionActor2D(), axes_->GetZAxisCaptionActor2D()}) {
    caption->GetTextActor()->SetTextScaleModeToNone();
    caption->GetCaptionTextProperty()->ItalicOff();
    caption->GetCaptionTextProperty()->BoldOff();
    caption->GetCaptionTextProperty()->ShadowOff();
    caption->GetCaptionTextProperty()->SetFontSize(13);
  }
  window_->SetNumberOfLayers(2);
  window_->AddRenderer(corner_);

  observer_ = renderer_->AddObserver(vtkCommand::StartEvent, this, &Furniture::arrange);
}

Furniture::~Furniture() {
  renderer_->RemoveObserver(observer_);
  for (vtkActor2D* actor : {static_cast<vtkActor2D*>(title_), static_cast<vtkActor2D*>(time_),
                            static_cast<vtkActor2D*>(length_), bar_.Get()})
    renderer_->RemoveViewProp(actor);
  window_->RemoveRenderer(corner_);
}

void Furniture::set_text(const std::string& title, const std::string& time, bool small) {
  title_->GetTextProperty()->SetFontSize(small ? 11 : 13);
  time_->GetTextProperty()->SetFontSize(small ? 11 : 13);
  title_->SetInput(title.c_str());
  title_lines_ = 1 + static_cast<int>(std::count(title.begin(), title.end(), '\n'));
  time_->SetInput(time.c_str());
}

void Furniture::set_axes(const std::array<const char*, 3>& names) {
  axes_->SetXAxisLabelText(names[0]);
  axes_->SetYAxisLabelText(names[1]);
  axes_->SetZAxisLabelText(names[2]);
}

void Furniture::set_ink(double red, double green, double blue) {
  const double paper = red + green + blue > 1.5 ? 0.1 : 0.95;  // under words, which may lie over the skin
  for (vtkTextActor* text : {title_.Get(), time_.Get(), length_.Get()}) {
    text->GetTextProperty()->SetColor(red, green, blue);
    text->GetTextProperty()->SetBackgroundColor(paper, paper, paper);
    text->GetTextProperty()->SetBackgroundOpacity(0.55);
  }
  bar_->GetProperty()->SetColor(red, green, blue);
  for (vtkCaptionActor2D* caption :
       {axes_->GetXAxisCaptionActor2D(), axes_->GetYAxisCaptionActor2D(), axes_->GetZAxisCaptionActor2D()})
    caption->GetCaptionTextProperty()->SetColor(red, green, blue);
}

void Furniture::arrange() {
  const int* size = renderer_->GetSize();
  if (size[0] <= 0 || size[1] <= 0) return;
  const double scale = window_->GetDPI() / 72.;
  place(title_, 12 * scale, size[1] - 10 * scale);
  place(time_, 12 * scale, size[1] - (10 + title_lines_ * 20) * scale);
  vtkCamera* camera = renderer_->GetActiveCamera();
  const double height = 2 * camera->GetDistance() * std::tan(camera->GetViewAngle() / 2 * M_PI / 180);
  if (height > 0) draw_ruler(size[1] / height, size, scale);
  turn_axes();
}

/// Pixels from the lower left of the renderer's part of the window.
void Furniture::place(vtkTextActor* text, double x, double y) {
  const int* origin = renderer_->GetOrigin();
  text->SetDisplayPosition(origin[0] + static_cast<int>(x), origin[1] + static_cast<int>(y));
}

void Furniture::draw_ruler(double pixels_per_mm, const int size[2], double scale) {
  const double mm = round_length(0.2 * size[0] / pixels_per_mm);
  const double length = mm * pixels_per_mm, right = size[0] - 16 * scale, low = 16 * scale, tick = 6 * scale;
  ruler_->SetPoint(0, right - length, low + tick, 0);
  ruler_->SetPoint(1, right - length, low, 0);
  ruler_->SetPoint(2, right, low, 0);
  ruler_->SetPoint(3, right, low + tick, 0);
  ruler_->Modified();
  bar_->GetProperty()->SetLineWidth(static_cast<float>(1.6 * scale));
  length_->SetInput((shortest(mm) + " mm").c_str());
  place(length_, right - length / 2, low + 5 * scale);
}

void Furniture::turn_axes() {
  const double* view = renderer_->GetViewport();
  const int* size = window_->GetSize();
  const double side = std::min(84 * window_->GetDPI() / 72., 0.2 * renderer_->GetSize()[1]);
  if (size[0] <= 0 || size[1] <= 0) return;
  corner_->SetViewport(view[0], view[1], view[0] + side / size[0], view[1] + side / size[1]);
  vtkCamera* from = renderer_->GetActiveCamera();
  vtkCamera* to = corner_->GetActiveCamera();
  double direction[3];
  from->GetDirectionOfProjection(direction);
  to->SetFocalPoint(0, 0, 0);
  to->SetPosition(-direction[0], -direction[1], -direction[2]);
  to->SetViewUp(from->GetViewUp());
  to->ParallelProjectionOn();
  to->SetParallelScale(1.45);
  corner_->ResetCameraClippingRange(-1.5, 1.5, -1.5, 1.5, -1.5, 1.5);
}

}  // namespace cleft
