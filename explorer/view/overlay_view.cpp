#include "explorer/view/overlay_view.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include "explorer/view/legend.h"

namespace cleft {

namespace {

void set_up(vtkActor* actor, vtkPolyData* data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  actor->SetMapper(mapper);
  actor->PickableOff();
  actor->GetProperty()->LightingOff();
}

vtkNew<vtkUnsignedCharArray> colors() {
  vtkNew<vtkUnsignedCharArray> array;
  array->SetNumberOfComponents(3);
  return array;
}

void add(vtkUnsignedCharArray* array, const Ink& ink) {
  array->InsertNextTuple3(255 * ink[0], 255 * ink[1], 255 * ink[2]);
}

void put_dots(const std::vector<Overlay::Dot>& dots, vtkPolyData* data) {
  vtkNew<vtkPoints> places;
  vtkNew<vtkCellArray> cells;
  const auto inks = colors();
  for (const Overlay::Dot& dot : dots) {
    const vtkIdType id = places->InsertNextPoint(dot.place.x, dot.place.y, dot.place.z);
    cells->InsertNextCell(1, &id);
    add(inks, dot.ink);
  }
  data->SetPoints(places), data->SetVerts(cells);
  data->GetCellData()->SetScalars(inks);
}

constexpr double handle_pixels = 12;
constexpr double above_the_surface_legend = 0.13;  // of a view's height

vtkSmartPointer<vtkLookupTable> colors_between(const Ink& none, const Ink& most, double largest) {
  constexpr int colors = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(colors);
  table->SetTableRange(0, largest);
  for (int i = 0; i < colors; ++i) {
    const Ink ink = between(none, most, double(i) / (colors - 1));
    table->SetTableValue(i, ink[0], ink[1], ink[2]);
  }
  return table;
}

/// Offset towards the eye, in units of the depth buffer: in front of their surface, or of everything.
void lift(vtkActor* actor, bool in_front) {
  constexpr double a_little = -4, all_of_it = -1e5;
  auto* mapper = static_cast<vtkPolyDataMapper*>(actor->GetMapper());
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0, in_front ? all_of_it : a_little);
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(in_front ? all_of_it : 2 * a_little);
}

}  // namespace

OverlayView::OverlayView(vtkRenderer* renderer) : renderer_(renderer) {
  set_up(dots_, dot_data_), set_up(lines_, line_data_), set_up(handles_, handle_data_);
  dots_->GetProperty()->SetPointSize(6);
  lines_->GetProperty()->SetLineWidth(1.4F);
  renderer_->AddActor(lines_);
  renderer_->AddActor(dots_);
  handles_->GetProperty()->RenderPointsAsSpheresOn();
  handles_->GetProperty()->LightingOn();
  renderer_->AddActor(handles_);
}

OverlayView::~OverlayView() {
  renderer_->RemoveActor(dots_);
  renderer_->RemoveActor(handles_);
  renderer_->RemoveActor(lines_);
  if (legend_) renderer_->RemoveViewProp(legend_);
}

void OverlayView::show(const Overlay& overlay, bool dark, double pixels) {
  const double scale =
      pixels * (renderer_->GetRenderWindow() ? renderer_->GetRenderWindow()->GetDPI() / 72. : 1);
  dots_->GetProperty()->SetPointSize(static_cast<float>(6 * scale));
  lines_->GetProperty()->SetLineWidth(static_cast<float>(1.4 * scale));
  handles_->GetProperty()->SetPointSize(static_cast<float>(handle_pixels * scale));
  for (vtkActor* actor : {dots_.Get(), lines_.Get(), handles_.Get()}) lift(actor, overlay.in_front);
  put_dots(overlay.dots, dot_data_);
  put_dots(overlay.handles, handle_data_);
  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> lines;
  const auto line_colors = colors();
  for (const Overlay::Line& line : overlay.lines) {
    lines->InsertNextCell(static_cast<int>(line.places.size()));
    for (const Vec3& x : line.places) lines->InsertCellPoint(corners->InsertNextPoint(x.x, x.y, x.z));
    add(line_colors, line.ink);
  }
  line_data_->SetPoints(corners), line_data_->SetLines(lines);
  line_data_->GetCellData()->SetScalars(line_colors);
  explain(overlay.scale, dark);
}

void OverlayView::explain(const std::optional<Overlay::Scale>& scale, bool dark) {
  if (legend_) renderer_->RemoveViewProp(legend_);
  legend_ = nullptr;
  if (!scale) return;
  legend_ = make_legend(colors_between(scale->none, scale->most, scale->largest), scale->title,
                        above_the_surface_legend);
  set_dark_background(legend_, dark);
  renderer_->AddViewProp(legend_);
}

}  // namespace cleft
