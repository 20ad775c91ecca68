#include "explorer/app/welcome_page.h"

#include <QDir>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>

#include "explorer/io/formats/mesh_formats.h"
#include "explorer/session/command_table.h"

namespace cleft {

namespace {
constexpr int most_recent = 10;
constexpr const char* key = "recent";
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

WelcomePage::WelcomePage(std::function<void(const std::string&)> open,
                         const std::function<void()>& choose_folder, const std::function<void()>& choose_file)
    : open_(std::move(open)) {
  setObjectName("welcome");
  auto* title = new QLabel(
      "<h1>Cleft</h1><p>Explore studies of simulated cuts, and cut any surface mesh with "
      "them.</p>");
  auto* open_study = new QPushButton("Open a study folder ...");
  open_study->setObjectName("open_study");
  auto* open_file = new QPushButton("Open a study.dffd or case.dffd ...");
  open_file->setObjectName("open_file");
  const QString meshes = QString::fromStdString(mesh_endings(MeshKind::surface, MeshUse::read));
  auto* hint = new QLabel(
      "No study yet? <code>examples/demo.sh</code> makes one; it is then in "
      "<code>out/demo/study</code>.<br>Studies, field files, meshes (" +
      meshes +
      ") and "
      "pictures taken here can be dropped onto this window. <b>F1</b> shows all commands.");
  hint->setObjectName("hint");
  hint->setWordWrap(true);
  recent_ = new QListWidget;
  recent_->setObjectName("recent");
  auto* column = new QVBoxLayout;
  column->addWidget(title);
  column->addWidget(open_study);
  column->addWidget(open_file);
  column->addSpacing(12);
  column->addWidget(new QLabel("Opened last:"));
  column->addWidget(recent_, 1);
  column->addWidget(hint);
  auto* middle = new QHBoxLayout(this);
  middle->addStretch(1);
  middle->addLayout(column, 3);
  middle->addStretch(1);
  middle->setContentsMargins(20, 30, 20, 30);
  connect(open_study, &QPushButton::clicked, this, [choose_folder] { choose_folder(); });
  connect(open_file, &QPushButton::clicked, this, [choose_file] { choose_file(); });
  connect(recent_, &QListWidget::itemActivated, this,
          [this](QListWidgetItem* item) { open_(item->text().toStdString()); });
  refresh();
}

void WelcomePage::refresh() {
  recent_->clear();
  recent_->addItems(recent_files());
}

}  // namespace cleft
