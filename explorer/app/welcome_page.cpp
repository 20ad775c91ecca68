#include "explorer/app/welcome_page.h"

#include <QCommandLinkButton>
#include <QDir>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QTimer>
#include <QVBoxLayout>

#include "explorer/io/formats/mesh_formats.h"
#include "explorer/session/command_table.h"

namespace cleft {

namespace {
constexpr int most_recent = 10;
constexpr const char* key = "recent";

QLabel* text(const char* name, const QString& words) {
  auto* label = new QLabel(words);
  label->setObjectName(name);
  label->setWordWrap(true);
  return label;
}
}  // namespace

QStringList recent_files() {
  QStringList there;
  for (const QString& path : QSettings("cleft", "explore").value(key).toStringList())
    if (QFileInfo::exists(path)) there << path;
  return there;
}

void remember_recent(const std::string& path) {
  QStringList recent = recent_files();
  const QString name = QString::fromStdString(path);
  recent.removeAll(name);
  recent.prepend(name);
  QSettings("cleft", "explore").setValue(key, QStringList(recent.mid(0, most_recent)));
}

WelcomePage::WelcomePage(Actions actions) : actions_(std::move(actions)) {
  setObjectName("welcome");
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(24, 16, 24, 16);
  const QString steps =
      QString("<ol style='margin-left:-20px'><li>%1</li><li>%2</li><li>%3</li></ol>")
          .arg(tr("<b>Open</b> a study or an example."),
               tr("<b>Look</b>: drag turns the picture, the slider below it grows the cut, "
                  "the parameters on the left choose a case."),
               tr("<b>Cut</b>: open a mesh of your own, press <b>C</b>, and drag over its skin."));
  column->addWidget(text("steps", "<h2>Cleft</h2>" + steps));
  const auto button = [&](const char* name, const QString& words, const std::function<void()>& run) {
    auto* made = new QPushButton(words);
    made->setObjectName(name);
    connect(made, &QPushButton::clicked, this, [run] { run(); });
    return made;
  };
  auto* row = new QHBoxLayout;
  row->addWidget(button("open_study", tr("Open a study ..."), actions_.choose_study));
  row->addWidget(button("open_file", tr("A field file ..."), actions_.choose_file));
  row->addWidget(button("welcome_mesh", tr("A mesh ..."), actions_.choose_mesh));
  column->addLayout(row);
  examples_ = new QWidget;
  new QVBoxLayout(examples_);
  examples_->layout()->setContentsMargins(0, 0, 0, 0);
  examples_->layout()->setSpacing(0);
  column->addWidget(examples_);
  recent_title_ = text("recent_title", tr("Opened last:"));
  column->addWidget(recent_title_);
  recent_ = new QListWidget;
  recent_->setObjectName("recent");
  recent_->setAccessibleName(tr("Opened last"));
  recent_->setTextElideMode(Qt::ElideMiddle);
  recent_->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
  recent_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  column->addWidget(recent_);
  const QString meshes = QString::fromStdString(mesh_endings(MeshKind::surface, MeshUse::read));
  column->addWidget(
      text("hint", tr("Studies, field files, meshes (%1) and pictures taken here can be dropped onto "
                      "this window. <b>F1</b> shows all keys and commands.")
                       .arg(meshes)));
  column->addStretch(1);
  setWidget(page);
  connect(recent_, &QListWidget::itemActivated, this,
          [this](QListWidgetItem* item) { actions_.open(item->text().toStdString()); });
  refresh();
}

void WelcomePage::refresh() {
  recent_->clear();
  recent_->addItems(recent_files());
  for (QWidget* w : {static_cast<QWidget*>(recent_title_), static_cast<QWidget*>(recent_)})
    w->setVisible(recent_->count() > 0);
  qDeleteAll(examples_->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly));
  for (const Example& example : examples_in(examples_folder(), computed_examples_folder())) {
    auto* link = new QCommandLinkButton(tr("Example: %1").arg(example.title), example.help);
    if (!example.command.isEmpty())
      link->setDescription(example.help + " " + tr("It is computed first: a click tells how."));
    link->setObjectName(example.name);
    link->setToolTip(example.help);
    examples_->layout()->addWidget(link);
    connect(link, &QCommandLinkButton::clicked, this, [this, example] {
      QTimer::singleShot(0, this, [this, example] { actions_.open_example(example); });  // may end the button
    });
  }
}

}  // namespace cleft
