#include "explorer/view/legend.h"

#include <vtkTextProperty.h>

namespace cleft {

vtkSmartPointer<vtkScalarBarActor> make_legend(vtkLookupTable* colors, const std::string& title, double low) {
  vtkNew<vtkScalarBarActor> legend;
  legend->SetLookupTable(colors);
  legend->SetTitle(title.c_str());
  legend->SetNumberOfLabels(2);  // the ends: the middle is the title's
  legend->SetLabelFormat("%.3g");
  legend->SetOrientationToHorizontal();
  legend->SetPosition(0.33, low);
  legend->SetWidth(0.34);
  legend->SetHeight(0.11);
  legend->SetBarRatio(0.22);
  legend->SetVerticalTitleSeparation(6);
  legend->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text : {legend->GetTitleTextProperty(), legend->GetLabelTextProperty()}) {
    text->SetFontSize(14);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
  }
  set_dark_background(legend, false);
  return legend;
}

void set_dark_background(vtkScalarBarActor* legend, bool dark) {
  const double ink = dark ? 0.9 : 0.1;
  for (vtkTextProperty* text : {legend->GetTitleTextProperty(), legend->GetLabelTextProperty()})
    text->SetColor(ink, ink, ink);
}

}  // namespace cleft
