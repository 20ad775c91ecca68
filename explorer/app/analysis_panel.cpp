#include "explorer/app/analysis_panel.h"

#include <QFileDialog>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "explorer/session/command_table.h"

namespace cleft {

AnalysisPanel::AnalysisPanel(Session& session, const Say& say) : session_(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(4, 4, 4, 0);
  figure_ = new QComboBox(this);
  figure_->setObjectName("analyzed_figure");
  figure_->setAccessibleName(tr("Figure to analyze"));
  figure_->setEditable(true);
  figure_->addItems({"gape", "gape(0)", "displacement"});
  figure_->setToolTip(
      tr("gape, gape(u), gape(u, t), displacement, displacement(u, v, w): as cleft analyze takes it"));
  figure_->setMinimumWidth(60);
  const auto button = [&](const char* name, const QString& text, const QString& tip) {
    auto* made = new QPushButton(text, this);
    made->setObjectName(name);
    made->setToolTip(tip);
    made->setMinimumWidth(30);
    return made;
  };
  analyze_ =
      button("analyze", tr("Analyze"), tr("What the figure depends on, and how surely (analyze FIGURE)"));
  fit_ =
      button("fit", tr("Fit ..."), tr("The parameters that explain my measurements, a CSV file (fit FILE)"));
  propose_ = button("propose", tr("Next cases ..."),
                    tr("The cases that the study needs most, as a study file (propose 8 FILE)"));
  auto* top = new QHBoxLayout;
  top->addWidget(figure_, 1);
  top->addWidget(analyze_);
  auto* below = new QHBoxLayout;
  below->addWidget(fit_);
  below->addWidget(propose_);
  column->addLayout(top);
  column->addLayout(below);
  auto* room = new QScrollArea(this);
  room->setWidgetResizable(true);
  room->setFrameShape(QFrame::NoFrame);
  room->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  room->setWidget(plot_ = new AnalysisPlot(session, say));
  column->addWidget(room, 1);
  connect(analyze_, &QPushButton::clicked, this,
          [this, say] { say("analyze " + figure_->currentText().toStdString()); });
  connect(fit_, &QPushButton::clicked, this, [this, say] {
    const QString path =
        QFileDialog::getOpenFileName(this, tr("Fit to measurements"), {}, tr("Measurements (*.csv)"));
    if (!path.isEmpty()) say("fit " + quoted(path.toStdString()));
  });
  connect(propose_, &QPushButton::clicked, this, [this, say] {
    const QString path =
        QFileDialog::getSaveFileName(this, tr("Write the next cases"), {}, tr("Study files (*.toml)"));
    if (!path.isEmpty()) say("propose 8 " + quoted(path.toStdString()));
  });
}

void AnalysisPanel::show_answers() {
  for (QWidget* w : std::initializer_list<QWidget*>{figure_, analyze_, fit_, propose_})
    w->setEnabled(session_.study() != nullptr);
  if (!session_.state().analyzed.empty()) {
    const QSignalBlocker quiet(figure_);
    figure_->setEditText(QString::fromStdString(session_.state().analyzed));
  }
  plot_->take_room();
  plot_->update();
}

}  // namespace cleft
