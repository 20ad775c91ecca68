// The window for those who use no mouse, hear it, need contrast, or read from right to left.
#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QScrollBar>
#include <QSlider>
#include <QTabBar>
#include <QTabWidget>
#include <QTableView>
#include <QTest>
#include <QToolBar>
#include <cmath>
#include <regex>
#include <set>

#include "tests/app/window_fixture.h"

namespace cleft {
namespace {

class Access : public WindowTest {
 protected:
  Access() {
    tell("open " + study());
    tell("mesh " + mesh());
    tell("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
    tell("wall on");
    window_.say("tme 3");  // the message bar with its buttons
    wait_for_figures();
  }
  /// What a user acts on; parts of other controls, as the field of a spin box, are none of their own.
  std::vector<QWidget*> controls() {
    std::vector<QWidget*> all;
    for (QWidget* w : window_.findChildren<QWidget*>()) {
      const bool acts = qobject_cast<QAbstractButton*>(w) || qobject_cast<QSlider*>(w) ||
                        qobject_cast<QComboBox*>(w) || qobject_cast<QLineEdit*>(w) ||
                        qobject_cast<QAbstractSpinBox*>(w) || qobject_cast<QAbstractItemView*>(w) ||
                        qobject_cast<QTabBar*>(w) || w == &window_.scene();
      const QWidget* parent = w->parentWidget();
      const bool part = qobject_cast<const QAbstractSpinBox*>(parent) ||
                        qobject_cast<const QComboBox*>(parent) || qobject_cast<const QTabBar*>(parent) ||
                        qobject_cast<const QAbstractItemView*>(parent) || w->inherits("QHeaderView") ||
                        w->inherits("QComboBoxListView");
      if (acts && !part && w->window() == &window_) all.push_back(w);
    }
    return all;
  }
  static std::string text_of(const QWidget* w) {
    return std::string(w->metaObject()->className()) + " " + w->objectName().toStdString();
  }
};

TEST_F(Access, EveryControlHasANameForAScreenReader) {
  auto& pages = widget<QTabWidget>("plot_pages");
  for (int page = 0; page < pages.count(); ++page) {
    pages.setCurrentIndex(page);
    settle(50);
    for (QWidget* w : controls()) {
      if (!w->isVisible()) continue;
      QAccessibleInterface* read = QAccessible::queryAccessibleInterface(w);
      ASSERT_TRUE(read) << text_of(w);
      EXPECT_FALSE(read->text(QAccessible::Name).isEmpty()) << text_of(w);
    }
  }
  for (const char* name :
       {"gape_over_time", "opening_profile", "tornado", "analysis_plot", "parallel_coordinates"})
    EXPECT_FALSE(widget<QWidget>(name).accessibleName().isEmpty())
        << name << ": what is painted has no words";
}

TEST_F(Access, TheKeyTabReachesEveryControl) {
  auto& pages = widget<QTabWidget>("plot_pages");
  for (int page = 0; page < pages.count(); ++page) {
    pages.setCurrentIndex(page);
    settle(50);
    window_.scene().setFocus();
    std::set<const QWidget*> reached;
    for (int k = 0; k < 200; ++k) {
      QWidget* now = QApplication::focusWidget();
      ASSERT_TRUE(now);
      reached.insert(now);
      QTest::keyClick(now, Qt::Key_Tab);
      if (QApplication::focusWidget() == &window_.scene() && k > 0) break;
    }
    EXPECT_EQ(QApplication::focusWidget(), &window_.scene()) << "Tab comes around, and is trapped nowhere";
    for (QWidget* w : controls()) {
      if (!w->isVisible() || !w->isEnabled()) continue;
      // The tool bar's actions are in the menus, and so are the buttons of docks.
      if (qobject_cast<QToolBar*>(w->parentWidget()) && qobject_cast<QAbstractButton*>(w)) continue;
      if (qobject_cast<QDockWidget*>(w->parentWidget())) continue;
      if (w->inherits("QMenuBarExtension") || w->objectName() == "qt_menubar_ext_button" ||
          w->objectName() == "qt_toolbar_ext_button")
        continue;
      bool found = reached.count(w) > 0;
      for (const QWidget* one : reached) found = found || w->focusProxy() == one;
      EXPECT_TRUE(found) << text_of(w);
    }
  }
  for (const QAction* action : widget<QToolBar>("tools").actions()) {
    if (action->isSeparator() || action->text().isEmpty()) continue;
    bool in_menu = false;
    for (const QWidget* one : action->associatedWidgets())
      in_menu = in_menu || qobject_cast<const QMenu*>(one);
    EXPECT_TRUE(in_menu) << action->objectName().toStdString();
  }
}

/// WCAG 2.1: of relative luminances.
double contrast(const QColor& a, const QColor& b) {
  const auto luminance = [](const QColor& c) {
    const auto part = [](double v) { return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    return 0.2126 * part(c.redF()) + 0.7152 * part(c.greenF()) + 0.0722 * part(c.blueF());
  };
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}
/// As it looks where it lets the ground through.
QColor over(const QColor& ink, const QColor& ground) {
  const double a = ink.alphaF();
  return QColor::fromRgbF(a * ink.redF() + (1 - a) * ground.redF(),
                          a * ink.greenF() + (1 - a) * ground.greenF(),
                          a * ink.blueF() + (1 - a) * ground.blueF());
}
constexpr double aa = 4.5;  // of WCAG's level AA, for text

TEST_F(Access, TextHasContrastInBothThemes) {
  EXPECT_NEAR(contrast(Qt::black, Qt::white), 21, 1e-9);
  EXPECT_NEAR(contrast(QColor(119, 119, 119), Qt::white), 4.48, 0.01) << "a known pair";
  for (const char* theme : {"theme light", "theme dark"}) {
    tell("wall off");
    tell(theme);
    settle(50);
    const QPalette p = QApplication::palette();
    using Pair = std::pair<QPalette::ColorRole, QPalette::ColorRole>;
    for (const auto& [ink, paper] :
         {Pair{QPalette::WindowText, QPalette::Window}, Pair{QPalette::Text, QPalette::Base},
          Pair{QPalette::Text, QPalette::AlternateBase}, Pair{QPalette::ButtonText, QPalette::Button},
          Pair{QPalette::HighlightedText, QPalette::Highlight},
          Pair{QPalette::ToolTipText, QPalette::ToolTipBase}, Pair{QPalette::PlaceholderText, QPalette::Base},
          Pair{QPalette::Link, QPalette::Base}, Pair{QPalette::Link, QPalette::Window}})
      EXPECT_GE(contrast(over(p.color(ink), p.color(paper)), p.color(paper)), aa)
          << theme << ": " << ink << " on " << paper;
    // Faded rows can be read.
    tell("find gape > 3");
    settle(50);
    const auto& table = widget<QTableView>("cases");
    int faded = 0;
    for (int row = 0; row < table.model()->rowCount(); ++row)
      if (const QVariant ink = table.model()->index(row, 0).data(Qt::ForegroundRole); ink.isValid()) {
        ++faded;
        EXPECT_GE(contrast(ink.value<QColor>(), table.palette().color(QPalette::Base)), aa) << theme;
      }
    EXPECT_GT(faded, 0);
    tell("find clear");
    // The colours that style sheets state, of errors and of answers.
    for (const bool error : {true, false}) {
      if (error)
        window_.say("tme 3");
      else
        tell("info");
      const std::string style = widget<QWidget>("message_bar").styleSheet().toStdString();
      std::smatch paper, ink;
      ASSERT_TRUE(std::regex_search(style, paper, std::regex("background: (#[0-9a-f]+)"))) << style;
      ASSERT_TRUE(std::regex_search(style, ink, std::regex("; color: (#[0-9a-f]+)"))) << style;
      EXPECT_GE(contrast(QColor(ink[1].str().c_str()), QColor(paper[1].str().c_str())), aa) << style;
    }
  }
}

TEST_F(Access, RightToLeftThePanelsAreMirroredAndThePictureIsNot) {
  const CameraState::Pose before = window_.scene().stage().camera();
  QApplication::setLayoutDirection(Qt::RightToLeft);
  settle(100);
  EXPECT_GT(widget<QLabel>("time_label").x() + 1, 0);
  const int slider = widget<QSlider>("time").x(), play = widget<QWidget>("play").x();
  const CameraState::Pose mirrored = window_.scene().stage().camera();
  tell("time 10");
  const int at_ten = widget<QSlider>("time").value();
  const QString error = widget<QAbstractButton>("certainty").text();
  window_.grab().save(QString::fromStdString(folder_ / "mirrored.png"));
  if (const char* file = std::getenv("MIRRORED_PICTURE")) window_.grab().save(file);
  QApplication::setLayoutDirection(Qt::LeftToRight);
  settle(50);
  EXPECT_LT(slider, play) << "the buttons are on the right";
  EXPECT_LT(norm(mirrored.position - before.position), 1e-9);
  EXPECT_EQ(error.at(0), QChar(0x202a)) << "signs of numbers stay beside them";
  EXPECT_NEAR(at_ten, widget<QSlider>("time").maximum() / 3., 2);
}

}  // namespace
}  // namespace cleft
