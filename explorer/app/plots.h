// Curves of the shown case and of those compared: gape over the length cut, and the opening along the cut,
// with bands of their errors; in a mesh, of the cuts in it.
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
  /// Half the height of its band at each of its places, mm; empty: its error is not known.
  const std::vector<double>& profile_error() const { return profile_error_; }

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
  void draw_patch_openings();
  void draw_mesh_openings();
  void draw_now(double t, double highest);
  void draw_probe();
  void dress(Plot& plot);
  enum class Style { line, dashed, dots };
  static void add_curve(vtkChartXY* chart, const Curve& curve, const std::string& name, int color,
                        Style style);
  /// So many mm to either side of the curve, but not below 0.
  static void add_band(vtkChartXY* chart, const Curve& curve, const std::vector<double>& error, int color);

  Session& session_;
  QTimer soon_;  ///< while time runs, plots are drawn less often than the picture
  Plot over_time_, along_cut_, probe_;
  QTabWidget* pages_;
  QLabel* probe_note_;
  std::map<const Field*, Curve> gapes_;            // of the fields shown
  std::map<const WoundScene*, Curve> mesh_gapes_;  // likewise, of the scenes of a mesh
  Curve profile_;
  std::vector<double> profile_error_;
};

}  // namespace cleft
