// The wall of pictures: what they show, order and filter, what is linked, and the file that keeps them.
#include <QComboBox>
#include <QDockWidget>
#include <QListView>
#include <QTableView>
#include <QTest>
#include <QToolButton>
#include <fstream>

#include "base/text.h"
#include "explorer/app/case_wall.h"
#include "tests/app/window_fixture.h"

namespace cleft {
namespace {

class Wall : public WindowTest {
 protected:
  /// Of its own, as the file of pictures is written beside it.
  Wall() { std::filesystem::copy(study(), own(), std::filesystem::copy_options::recursive); }
  std::string own() const { return folder_ / "own"; }
  std::string file() const { return own() + "/study.wall"; }

  CaseWall& wall() { return wall_of(window_); }
  static CaseWall& wall_of(MainWindow& window) {
    return *dynamic_cast<CaseWall*>(window.findChild<QDockWidget*>("wall_dock")->widget());
  }
  QListView& list() { return widget<QListView>("wall"); }
  static void wait_for(const CaseWall& wall) {
    for (int tries = 0; tries < 500 && !wall.complete(); ++tries) settle(20);
    ASSERT_TRUE(wall.complete());
  }
  void open_wall() {
    tell("open " + own());
    wait_for_figures();
    tell("wall on");
    wait_for(wall());
  }
  /// Cases as the list has them, from 1.
  std::vector<int> order() {
    std::vector<int> cases;
    for (int row = 0; row < list().model()->rowCount(); ++row)
      cases.push_back(list().model()->index(row, 0).data().toInt());
    return cases;
  }
  /// Pixels inside the wound: darker than the skin at any light.
  static int dark_pixels(const QPixmap& picture) {
    const QImage image = picture.toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) count += QColor(image.pixel(x, y)).green() < 80;
    return count;
  }
};

TEST_F(Wall, ShowsThePictureOfEveryCaseAndWiderWoundsLargerInThem) {
  open_wall();
  std::vector<std::pair<double, int>> openings;
  for (int i = 0; i < 4; ++i) {
    ASSERT_FALSE(wall().picture(i).isNull()) << i;
    openings.emplace_back(gape(*real_.study()->field(i), 0, 30), dark_pixels(wall().picture(i)));
  }
  std::sort(openings.begin(), openings.end());
  EXPECT_GT(openings[0].second, 20);
  for (const int wide : {2, 3})
    for (const int narrow : {0, 1}) {
      ASSERT_GT(openings[wide].first, openings[narrow].first + 2) << "mm";
      EXPECT_GT(openings[wide].second, 1.2 * openings[narrow].second) << openings[wide].first << " mm";
    }
}

TEST_F(Wall, IsSortedAndFilteredAsTheTable) {
  open_wall();
  std::vector<int> by_gape{1, 2, 3, 4};
  const auto opening = [&](int i) { return gape(*real_.study()->field(i - 1), 0, 30); };
  std::sort(by_gape.begin(), by_gape.end(), [&](int a, int b) { return opening(a) > opening(b); });
  auto& by = widget<QComboBox>("wall_sort");
  by.setCurrentText("gape");
  emit by.activated(by.currentIndex());
  widget<QToolButton>("wall_order").click();
  EXPECT_EQ(real_.said().back(), "sort gape down");
  EXPECT_EQ(order(), by_gape);
  EXPECT_EQ(widget<QTableView>("cases").model()->index(0, 0).data().toInt(), by_gape[0]);
  EXPECT_NE(wall().text(0).indexOf("gape"), -1) << "the figure is written below";
  widget<QTableView>("cases").sortByColumn(0, Qt::AscendingOrder);
  EXPECT_EQ(now().sorted_by, "") << "a click on a header is a command too";
  EXPECT_EQ(order(), (std::vector{1, 2, 3, 4}));
  tell("brush gape 4 9");
  for (int i = 0; i < 4; ++i) EXPECT_EQ(wall().is_faded(i), opening(i + 1) < 4) << i;
  tell("filter on");
  for (const int i : order()) EXPECT_GE(opening(i), 4);
  EXPECT_LT(order().size(), 4U);
}

TEST_F(Wall, AClickShowsACaseAndSeveralAreSelectedEverywhere) {
  open_wall();
  const auto click = [&](int row, Qt::KeyboardModifiers keys) {
    const QRect room = list().visualRect(list().model()->index(row, 0));
    ASSERT_FALSE(room.isEmpty());
    QTest::mouseClick(list().viewport(), Qt::LeftButton, keys, room.center());
  };
  click(2, {});
  EXPECT_EQ(now().shown, 2);
  click(3, Qt::ControlModifier);
  EXPECT_EQ(now().selected, (std::vector{2, 3}));
  auto& table = widget<QTableView>("cases");
  EXPECT_EQ(table.selectionModel()->selectedRows().size(), 2);
  tell("select 1 2 4");
  EXPECT_EQ(table.selectionModel()->selectedRows().size(), 3);
  EXPECT_TRUE(list().selectionModel()->isSelected(list().model()->index(1, 0)));
  tell("case 2");
  EXPECT_EQ(now().selected.size(), 3U) << "another case is shown of those";
  widget<QAction>("compare").trigger();
  EXPECT_EQ(now().compared, (std::vector{0, 1, 3}));
  tell("single");
  click(0, {});
  EXPECT_TRUE(now().selected.empty());
  EXPECT_EQ(table.selectionModel()->selectedRows().size(), 1);
  EXPECT_FALSE(window_.say("select 5"));
}

TEST_F(Wall, PicturesAreKeptBesideTheStudyAndDamagedOnesDrawnAnew) {
  open_wall();
  const QImage first = wall().picture(1).toImage();
  ASSERT_TRUE(std::filesystem::exists(file()));
  const WallPictures kept = read_wall_file(file(), thumbnail_look);
  EXPECT_EQ(kept.size(), 4U);
  EXPECT_TRUE(read_wall_file(file(), "another look").empty());
  {
    Session again(session_services([](const std::string&) {}));
    again.say("open " + own());
    MainWindow window(again);
    EXPECT_FALSE(wall_of(window).picture(1).isNull()) << "before anything is drawn";
    QImage from_file = wall_of(window).picture(1).toImage();
    long off = 0;
    for (int y = 0; y < first.height(); ++y)
      for (int x = 0; x < first.width(); ++x)
        off += std::abs(qGreen(first.pixel(x, y)) - qGreen(from_file.pixel(x, y)));
    EXPECT_LT(off, 4L * first.width() * first.height()) << "to what JPEG loses";
  }
  std::string bytes = read_text_file(file());
  bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);
  write_text_file(file(), bytes);
  EXPECT_EQ(read_wall_file(file(), thumbnail_look).size(), 3U);
  Session again(session_services([](const std::string&) {}));
  again.say("open " + own());
  again.say("wall on");
  MainWindow window(again);
  window.resize(1280, 720);
  window.show();
  settle(50);
  wait_for(wall_of(window));
  EXPECT_EQ(read_wall_file(file(), thumbnail_look), kept) << "the same, bit for bit";
}

TEST_F(Wall, IsClosedAndOpenedByTheSessionAndByTheMenu) {
  tell("open " + own());
  auto& dock = widget<QDockWidget>("wall_dock");
  EXPECT_FALSE(dock.isVisible());
  dock.toggleViewAction()->trigger();
  EXPECT_TRUE(now().wall);
  EXPECT_EQ(real_.said().back(), "wall on");
  dock.close();
  EXPECT_FALSE(now().wall);
  tell("wall on");
  EXPECT_TRUE(dock.isVisible());
  widget<QAction>("arrange").trigger();
  EXPECT_FALSE(dock.isVisible());
}

}  // namespace
}  // namespace cleft
