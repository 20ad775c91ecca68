// Curves of the shown case and of those compared: gape over the length cut, and the opening along the cut,
// with bands of their errors; in a mesh, of the cuts in it.
#pragma once

#include <QVTKOpenGLNativeWidget.h>
#include <vtkChartXY.h>
#include <vtkContextView.h>
#include <vtkNew.h>
#include <vtkTable.h>

#include <QCoreApplication>
#include <QLabel>
#include <QTabWidget>
#include <QTimer>
#include <QWidget>
#include <array>
#include <map>
#include <optional>

#include "explorer/app/analysis_panel.h"
#include "explorer/app/panel.h"
#include "explorer/app/wound_table.h"
#include "explorer/study/case_figures.h"

namespace cleft {

class Plots : public QWidget, public Panel {
  Q_DECLARE_TR_FUNCTIONS(Plots)

 public:
  Plots(Session& session, const Say& say);
  void follow(const Changes& changes) override;
  /// The curves drawn last, of the first view, for tests.
  const Curve& profile() const { return profile_; }
  /// Half the height of its band at each of its places, mm; empty: its error is not known.
  const std::vector<double>& profile_error() const { return profile_error_; }
  /// The line of the probe's displacement along axis k, and half the height of its band, mm.
  const Curve& probed(int k) const { return probed_[static_cast<std::size_t>(k)]; }
  std::optional<double> probed_error() const { return probed_error_; }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Plot {
    QVTKOpenGLNativeWidget* widget;
    vtkNew<vtkContextView> view;
    vtkNew<vtkChartXY> chart;
  };
  void set_up(Plot& plot, const char* name, const QString& x, const QString& y);
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
  /// So many mm to either side of the curve, but not below `least`.
  static void add_band(vtkChartXY* chart, const Curve& curve, const std::vector<double>& error, int color,
                       double least = 0);

  Session& session_;
  QTimer soon_;  ///< while time runs, plots are drawn less often than the picture
  Plot over_time_, along_cut_, probe_;
  QTabWidget* pages_;
  QLabel* probe_note_;
  WoundTable* wounds_;
  AnalysisPanel* analysis_;
  std::map<std::shared_ptr<const Field>, Curve> gapes_;  // of the fields shown
  /// Of the wounds of a case in a mesh.
  struct MeshOpening {
    Curve gape;
    std::vector<Validity> validity;
  };
  std::map<std::shared_ptr<const WoundScene>, MeshOpening> mesh_gapes_;  // likewise, of the scenes of a mesh
  std::array<Curve, 3> probed_;
  std::optional<double> probed_error_;
  Curve profile_;
  std::vector<double> profile_error_;
};

}  // namespace cleft
