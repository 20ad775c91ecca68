// Curves of the shown case and of those compared: gape over the length cut, and the opening along the cut.
#pragma once

#include <QVTKOpenGLNativeWidget.h>
#include <vtkChartXY.h>
#include <vtkContextView.h>
#include <vtkNew.h>
#include <vtkTable.h>

#include <QLabel>
#include <QTabWidget>
#include <QTimer>
#include <QWidget>
#include <map>

#include "explorer/app/panel.h"
#include "explorer/study/case_figures.h"

namespace cleft {

class Plots : public QWidget, public Panel {
 public:
  explicit Plots(Session& session);
  void follow(const Changes& changes) override;
  /// The curves drawn last, of the first view, for tests.
  const Curve& profile() const { return profile_; }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Plot {
    QVTKOpenGLNativeWidget* widget;
    vtkNew<vtkContextView> view;
    vtkNew<vtkChartXY> chart;
  };
  void set_up(Plot& plot, const char* name, const char* x, const char* y);
  QWidget* make_page(std::initializer_list<Plot*> plots);
  void draw();
  void draw_opening();
  void draw_probe();
  void dress(Plot& plot);
  enum class Style { line, dashed, dots };
  static void add_curve(vtkChartXY* chart, const Curve& curve, const std::string& name, int color,
                        Style style);

  Session& session_;
  QTimer soon_;  ///< while time runs, plots are drawn less often than the picture
  Plot over_time_, along_cut_, probe_;
  QTabWidget* pages_;
  QLabel* probe_note_;
  std::map<const Field*, Curve> gapes_;  // of the fields shown
  Curve profile_;
};

}  // namespace cleft
