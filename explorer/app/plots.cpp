#include "explorer/app/plots.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkContextScene.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotArea.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "explorer/app/tornado_plot.h"

namespace cleft {

namespace {
/// Okabe and Ito's colours, which colour-blind people can distinguish.
constexpr unsigned char colors[][3] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}};
constexpr int milliseconds_a_plot = 150;

double widest_of(const std::vector<WoundScene::Opening>& openings) {
  double widest = 0;
  for (const auto& opening : openings)
    for (const double value : opening.values) widest = std::max(widest, value);
  return widest;
}

/// The widest opening of all cuts in a mesh over the length cut.
Curve gape_of(const WoundScene& scene) {
  constexpr int times = 24;
  Curve gape;
  for (int i = 0; i <= times; ++i) {
    const double t = scene.duration() * i / times;
    gape.x.push_back(t), gape.y.push_back(widest_of(scene.openings(t)));
  }
  return gape;
}

/// mm: ahead of the blade the guard may part lips by a few thousandths.
constexpr double closed = 0.02;

/// mm, at each place of a cut: the expected error is one over the largest opening. What is not cut is closed.
std::vector<double> error_of(const WoundScene::Opening& opening, const OpeningError& expected) {
  const double widest = widest_of({opening});
  std::vector<double> error;
  for (std::size_t i = 0; i < opening.places.size(); ++i)
    error.push_back(opening.values[i] > closed ? widest * expected.value_at(opening.places[i]) : 0);
  return error;
}

/// mm, of the widest opening of all cuts.
std::vector<double> error_of(const Curve& gape, const std::vector<Validity>& cuts) {
  double largest = 0;
  for (const Validity& cut : cuts) largest = std::max(largest, cut.expected_error.largest);
  std::vector<double> error = gape.y;
  for (double& value : error) value *= largest;
  return error;
}
}  // namespace

Plots::Plots(Session& session, const Say& say) : session_(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  set_up(over_time_, "gape_over_time", tr("length cut, mm"), tr("widest gape, mm"));
  set_up(along_cut_, "opening_profile", tr("place along the cut, mm"), tr("opening, mm"));
  set_up(probe_, "probe_plot", tr("length cut, mm"), tr("displacement, mm"));
  pages_ = new QTabWidget(this);
  pages_->setObjectName("plot_pages");
  pages_->addTab(make_page({&over_time_, &along_cut_}), tr("Opening"));
  QWidget* probe = make_page({&probe_});
  probe_note_ = new QLabel(probe);
  probe_note_->setObjectName("probe_note");
  probe_note_->setWordWrap(true);
  static_cast<QVBoxLayout*>(probe->layout())->insertWidget(0, probe_note_);
  pages_->addTab(probe, tr("Probe"));
  pages_->addTab(new TornadoPlot(session), tr("Tornado"));
  pages_->addTab(wounds_ = new WoundTable(session, say), tr("Wounds"));
  pages_->addTab(analysis_ = new AnalysisPanel(session, say), tr("Analysis"));
  connect(pages_, &QTabWidget::currentChanged, this, [this] { draw(); });
  column->addWidget(pages_);
  soon_.setSingleShot(true);
  connect(&soon_, &QTimer::timeout, this, [this] { draw(); });
}

QWidget* Plots::make_page(std::initializer_list<Plot*> plots) {
  auto* page = new QWidget(this);
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  for (Plot* plot : plots) column->addWidget(plot->widget, 1);
  return page;
}

void Plots::set_up(Plot& plot, const char* name, const QString& x, const QString& y) {
  plot.widget = new QVTKOpenGLNativeWidget(this);
  plot.widget->setObjectName(name);
  plot.widget->setAccessibleName(tr("%1 over %2").arg(y, x));
  plot.widget->setMinimumHeight(100);
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetMultiSamples(0);
  plot.widget->setRenderWindow(window);
  plot.view->SetRenderWindow(window);
  plot.view->GetScene()->AddItem(plot.chart);
  for (const auto& [side, title] : {std::pair{vtkAxis::BOTTOM, x}, {vtkAxis::LEFT, y}}) {
    vtkAxis* axis = plot.chart->GetAxis(side);
    axis->SetTitle(title.toStdString());
    axis->GetTitleProperties()->SetBold(false);
    axis->GetTitleProperties()->SetFontSize(12);
    axis->GetLabelProperties()->SetFontSize(11);
  }
  plot.chart->SetActionToButton(vtkChart::PAN, -1);  // a look only: time is chosen in the time bar
  plot.chart->SetActionToButton(vtkChart::ZOOM, -1);
}

void Plots::dress(Plot& plot) {
  const bool dark = session_.state().dark;
  const double paper = dark ? 0.14 : 1, ink = dark ? 0.88 : 0.12;
  plot.view->GetRenderer()->SetBackground(paper, paper, paper);
  for (const int side : {vtkAxis::BOTTOM, vtkAxis::LEFT}) {
    vtkAxis* axis = plot.chart->GetAxis(side);
    axis->GetTitleProperties()->SetColor(ink, ink, ink);
    axis->GetLabelProperties()->SetColor(ink, ink, ink);
    axis->GetPen()->SetColorF(ink, ink, ink);
    axis->GetGridPen()->SetColorF(dark ? 0.25 : 0.9, dark ? 0.25 : 0.9, dark ? 0.25 : 0.9);
  }
  plot.chart->GetLegend()->GetLabelProperties()->SetColor(ink, ink, ink);
  plot.chart->GetLegend()->GetBrush()->SetColorF(paper, paper, paper, 0.8);
}

void Plots::add_curve(vtkChartXY* chart, const Curve& curve, const std::string& name, int color,
                      Style style) {
  vtkNew<vtkTable> table;
  vtkNew<vtkFloatArray> x, y;
  x->SetName("x"), y->SetName(name.c_str());
  table->AddColumn(x), table->AddColumn(y);
  table->SetNumberOfRows(static_cast<vtkIdType>(curve.x.size()));
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    table->SetValue(static_cast<vtkIdType>(i), 0, curve.x[i]);
    table->SetValue(static_cast<vtkIdType>(i), 1, curve.y[i]);
  }
  vtkPlot* line = chart->AddPlot(style == Style::dots ? vtkChart::POINTS : vtkChart::LINE);
  const bool dashed = style == Style::dashed;
  if (style == Style::dots)
    static_cast<vtkPlotPoints*>(line)->SetMarkerSize(5), line->SetLegendVisibility(false);
  line->SetInputData(table, 0, 1);
  line->SetColor(colors[color][0], colors[color][1], colors[color][2], dashed ? 150 : 255);
  line->SetWidth(dashed ? 1.2F : 2.2F);
  if (dashed) line->GetPen()->SetLineType(vtkPen::DASH_LINE), line->SetLegendVisibility(false);
}

void Plots::add_band(vtkChartXY* chart, const Curve& curve, const std::vector<double>& error, int color,
                     double least) {
  vtkNew<vtkTable> table;
  for (const char* name : {"x", "least", "most"}) {
    vtkNew<vtkFloatArray> column;
    column->SetName(name);
    table->AddColumn(column);
  }
  table->SetNumberOfRows(static_cast<vtkIdType>(curve.x.size()));
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const auto row = static_cast<vtkIdType>(i);
    table->SetValue(row, 0, curve.x[i]);
    table->SetValue(row, 1, std::max(least, curve.y[i] - error[i]));
    table->SetValue(row, 2, curve.y[i] + error[i]);
  }
  auto* band = static_cast<vtkPlotArea*>(chart->AddPlot(vtkChart::AREA));
  band->SetInputData(table);
  band->SetInputArray(0, "x"), band->SetInputArray(1, "least"), band->SetInputArray(2, "most");
  constexpr unsigned char faint = 60;
  band->SetColor(colors[color][0], colors[color][1], colors[color][2], faint);
  band->SetLegendVisibility(false);
}

void Plots::draw() {
  const QString time = session_.is_imported() ? tr("time from the first frame") : tr("length cut, mm");
  for (const Plot* plot : {&over_time_, &probe_})
    plot->chart->GetAxis(vtkAxis::BOTTOM)->SetTitle(time.toStdString());
  if (pages_->currentIndex() == 0) draw_opening();
  if (pages_->currentIndex() == 1) draw_probe();
  if (pages_->currentIndex() == 2) pages_->currentWidget()->update();
  if (pages_->currentWidget() == wounds_) wounds_->show_wounds();
  if (pages_->currentWidget() == analysis_) analysis_->show_answers();
}

void Plots::draw_probe() {
  probe_.chart->ClearPlots();
  dress(probe_);
  const bool probed = session_.study() && session_.state().probe;
  QString note = tr("Probe (key P): click a point of the patch, or say: probe U,V,W");
  if (probed) {
    const Motion motion = session_.probed_motion();
    constexpr const char* names[] = {QT_TR_NOOP("along u"), QT_TR_NOOP("across v"), QT_TR_NOOP("height w")};
    probed_ = motion.node ? motion.at_node : motion.field;  // the dots are the node's
    probed_error_ = error_of_displacement(*session_.field());
    for (int k = 0; k < 3; ++k) {
      const std::vector<double> error(probed_[static_cast<std::size_t>(k)].x.size(),
                                      probed_error_.value_or(0));
      if (probed_error_) add_band(probe_.chart, probed_[static_cast<std::size_t>(k)], error, k, -HUGE_VAL);
      add_curve(probe_.chart, probed_[static_cast<std::size_t>(k)], tr(names[k]).toStdString(), k,
                Style::line);
      if (motion.node)
        add_curve(probe_.chart, motion.raw[k], tr("%1, node").arg(tr(names[k])).toStdString(), k,
                  Style::dots);
    }
    const Vec3& asked = session_.state().probe->uvw;
    const Vec3 x = motion.node.value_or(asked);
    note = tr("Motion of %1, %2, %3 mm").arg(x.x, 0, 'g', 3).arg(x.y, 0, 'g', 3).arg(x.z, 0, 'g', 3);
    note += motion.node ? tr(", the simulation's node %1 mm from the place asked for. Dots: the simulation")
                              .arg(norm(x - asked), 0, 'g', 2)
                        : "; " + QString::fromStdString(session_.why_no_raw(session_.state().shown));
  }
  probe_note_->setText(note);
  probe_.chart->SetShowLegend(probed);
  probe_.chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::LEFT);  // where motion begins
  probe_.chart->RecalculateBounds();
  probe_.widget->renderWindow()->Render();
}

void Plots::draw_opening() {
  over_time_.chart->ClearPlots();
  along_cut_.chart->ClearPlots();
  dress(over_time_), dress(along_cut_);
  profile_ = {}, profile_error_.clear();
  if (session_.mesh())
    draw_mesh_openings();
  else if (session_.study())
    draw_patch_openings();
  for (Plot* plot : {&over_time_, &along_cut_}) {
    plot->chart->RecalculateBounds();
    plot->widget->renderWindow()->Render();
  }
}

void Plots::draw_now(double t, double highest) {
  add_curve(over_time_.chart, {{t, t}, {0, highest}}, tr("now").toStdString(), 1, Style::dashed);
  const bool several = session_.views().size() > 1;
  for (const auto& [plot, room] : {std::pair{&over_time_, several ? 1.6 : 1.05}, {&along_cut_, 1.05}}) {
    vtkAxis* axis = plot->chart->GetAxis(vtkAxis::LEFT);
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(0, (highest > 0 ? highest : 1) * room);
  }
  over_time_.chart->SetShowLegend(several);                                     // for both
  over_time_.chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::LEFT);  // where wounds begin
}

/// Of the fields, with the error of an opening that their fits or interpolations state.
void Plots::draw_patch_openings() {
  std::map<std::shared_ptr<const Field>, Curve> gapes;
  const std::vector<int> views = session_.views();
  double highest = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const auto field = session_.field_of(views[k]);
    const auto known = gapes_.find(field);
    const Curve& gape = gapes[field] = known != gapes_.end() ? known->second : gape_over_time(*field);
    const Curve profile = opening_profile(*field, std::min(session_.state().time, field->duration()));
    const std::string name = tr("case %1").arg(views[k] + 1).toStdString();
    const int color = static_cast<int>(k);
    const std::optional<double> error = error_of_gape(*field);
    for (const auto& [plot, curve] : {std::pair{&over_time_, &gape}, {&along_cut_, &profile}}) {
      if (error) add_band(plot->chart, *curve, std::vector<double>(curve->x.size(), *error), color);
      add_curve(plot->chart, *curve, name, color, Style::line);
    }
    if (k == 0) profile_ = profile;
    if (k == 0 && error) profile_error_.assign(profile.x.size(), *error);
    highest = std::max(highest, *std::max_element(gape.y.begin(), gape.y.end()) + error.value_or(0));
  }
  draw_now(std::min(session_.state().time, session_.field()->duration()), highest);
  gapes_.swap(gapes);
}

/// Of the wounds on the screen, those of one cut after another: places count from the start of the first.
void Plots::draw_mesh_openings() {
  std::map<std::shared_ptr<const WoundScene>, MeshOpening> gapes;
  const std::vector<int> views = session_.views();
  double highest = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const auto scene = session_.scene_of(views[k]);
    const auto known = mesh_gapes_.find(scene);
    const auto& [gape, validity] = gapes[scene] =
        known != mesh_gapes_.end()
            ? known->second
            : MeshOpening{gape_of(*scene),
                          views[k] == session_.state().shown ? session_.validity() : scene->validity()};
    const std::string name = tr("case %1").arg(views[k] + 1).toStdString();
    const int color = static_cast<int>(k);
    const bool judged = !validity.empty();
    double most = *std::max_element(gape.y.begin(), gape.y.end());
    if (judged) {
      const std::vector<double> error = error_of(gape, validity);
      add_band(over_time_.chart, gape, error, color);
      most += *std::max_element(error.begin(), error.end());
    }
    add_curve(over_time_.chart, gape, name, color, Style::line);
    highest = std::max(highest, most);
    double begin = 0;
    const auto openings = scene->openings(std::min(session_.state().time, scene->duration()));
    const auto paths = session_.cut_paths();
    for (std::size_t cut = 0; cut < openings.size(); ++cut) {
      Curve profile{openings[cut].places, openings[cut].values};
      for (double& place : profile.x) place += begin;
      begin += paths[cut].length();
      if (judged) {
        const std::vector<double> error = error_of(openings[cut], validity[cut].expected_error);
        add_band(along_cut_.chart, profile, error, color);
        if (k == 0) profile_error_.insert(profile_error_.end(), error.begin(), error.end());
      }
      add_curve(along_cut_.chart, profile, name, color, Style::line);
      if (k > 0) continue;
      profile_.x.insert(profile_.x.end(), profile.x.begin(), profile.x.end());
      profile_.y.insert(profile_.y.end(), profile.y.begin(), profile.y.end());
    }
  }
  draw_now(session_.state().time, highest);
  mesh_gapes_.swap(gapes);
}

void Plots::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  draw();
}

void Plots::follow(const Changes& changes) {
  if (!isVisible()) return;
  if (changes.closer && session_.state().probe && !session_.mesh()) pages_->setCurrentIndex(1);
  if (changes.answers && session_.study() && !changes.study) pages_->setCurrentWidget(analysis_);
  if (changes.study || changes.layout || changes.look || changes.closer || changes.answers)
    draw();
  else if ((changes.brushes || changes.lists) && pages_->currentWidget() == analysis_)
    analysis_->show_answers();
  const bool drawn = changes.study || changes.layout || changes.look;
  if (!drawn && (changes.shown || (changes.time && !soon_.isActive())))
    soon_.start(milliseconds_a_plot);  // once a slider rests
}

}  // namespace cleft
