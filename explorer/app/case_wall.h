// Pictures of all cases. They are drawn when there is time, and kept in a file beside the study. Order,
// filter and selection are those of the table of cases.
#pragma once

#include <QComboBox>
#include <QCoreApplication>
#include <QLabel>
#include <QListView>
#include <QPixmap>
#include <QTimer>
#include <QToolButton>
#include <QWidget>
#include <memory>
#include <vector>

#include "explorer/app/case_table.h"
#include "explorer/app/panel.h"
#include "explorer/study/wall_file.h"
#include "explorer/view/thumbnail.h"

namespace cleft {

class CaseWall : public QWidget, public Panel {
  Q_DECLARE_TR_FUNCTIONS(CaseWall)

 public:
  CaseWall(Session& session, Say say, CaseTable& table);
  ~CaseWall() override;
  void follow(const Changes& changes) override;

  /// Of case i; null: not drawn yet, or it cannot be.
  const QPixmap& picture(int i) const { return pictures_.at(static_cast<std::size_t>(i)); }
  bool complete() const { return !idle_.isActive(); }
  /// What is written below the picture of case i.
  QString text(int i) const;
  bool is_faded(int i) const;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void new_study();
  void follow_lists();
  void say_sort();
  void draw_next();
  int next_without() const;
  void draw(int i);
  void keep();
  void tell_progress();

  Session& session_;
  Say say_;
  CaseTable& table_;
  QComboBox* by_;
  QToolButton* order_;
  QLabel* progress_;
  QListView* list_;
  QTimer idle_;
  std::unique_ptr<ThumbnailDrawer> drawer_;
  std::vector<QPixmap> pictures_;  // by case
  std::vector<bool> tried_;        // likewise
  std::string file_;               // where they are kept; empty: nowhere
  WallPictures kept_;              // what is to be in it
  int fresh_ = 0;                  // that are not in it
};

}  // namespace cleft
