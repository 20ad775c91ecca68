// All words of the window can be translated: what a translator gives is what is shown, and no text that is
// written into the sources goes around it.
#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <QTabWidget>
#include <QTest>
#include <QTranslator>
#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include "base/text.h"
#include "tests/app/window_fixture.h"

namespace cleft {
namespace {

/// Another language, whose words are in brackets.
class Bracketing : public QTranslator {
 public:
  bool isEmpty() const override { return false; }
  QString translate(const char* context, const char* source, const char*, int) const override {
    contexts.insert(context);
    return QString::fromUtf8("\u27e6") + QString::fromUtf8(source) + QString::fromUtf8("\u27e7");
  }
  mutable std::set<std::string> contexts;
};

class Translated : public SessionTest {
 protected:
  Translated() {
    QCoreApplication::installTranslator(&translator_);
    write_mesh(mesh_, flat_plate());
    window_ = std::make_unique<MainWindow>(real_);
    window_->resize(1280, 720);
    window_->show();
    settle(20);
  }
  ~Translated() override {
    window_.reset();
    QCoreApplication::removeTranslator(&translator_);
  }

  /// Words without a bracket that no command, case or file is named by.
  void expect_translated(const QString& words, const QObject* of) {
    static const std::set<QString> names{"Cleft", "mm", "MPa", "\u00b0", "#"};
    const bool has_words = std::any_of(words.begin(), words.end(), [](QChar c) { return c.isLetter(); });
    if (!has_words || names.count(words)) return;
    EXPECT_NE(words.indexOf(QString::fromUtf8("\u27e6")), -1)
        << of->metaObject()->className() << " " << of->objectName().toStdString() << ": "
        << words.toStdString();
  }

  void look_through() {
    for (const QWidget* w : window_->findChildren<QWidget*>()) {
      if (w->window() != window_.get()) continue;
      expect_translated(w->toolTip(), w);
      for (const char* property :
           {"text", "placeholderText", "prefix", "suffix", "specialValueText", "title"})
        if (const QVariant words = w->property(property); words.type() == QVariant::String && !is_data(w))
          expect_translated(words.toString(), w);
      if (const auto* tabs = qobject_cast<const QTabWidget*>(w))
        for (int i = 0; i < tabs->count(); ++i) expect_translated(tabs->tabText(i), tabs);
      if (const auto* dock = qobject_cast<const QDockWidget*>(w))
        expect_translated(dock->windowTitle(), dock);
    }
    for (const QAction* action : window_->findChildren<QAction*>()) {
      const QString name = action->objectName();
      if (name.startsWith("device_") && name != "device_off") continue;     // words of the table of devices
      if (name.startsWith("figure_") || name.startsWith("map_")) continue;  // names that commands take
      if (QFileInfo::exists(action->text())) continue;                      // opened last
      if (name.isEmpty() && action->text().isEmpty()) continue;
      expect_translated(action->text(), action);
      expect_translated(action->toolTip(), action);
    }
  }
  /// What a user has typed, or what comes from the session.
  static bool is_data(const QWidget* w) {
    return (qobject_cast<const QLineEdit*>(w) && w->property("placeholderText").toString().isEmpty()) ||
           w->objectName().endsWith(".value") || w->objectName() == "certainty" ||
           w->objectName() == "message";
  }

  std::string mesh_ = folder_ / "plate.stl";
  Bracketing translator_;
  Session real_{session_services([](const std::string&) {})};
  std::unique_ptr<MainWindow> window_;
};

TEST_F(Translated, EveryWordOfTheWindowComesFromTheTranslator) {
  look_through();
  ASSERT_TRUE(window_->say("open " + study()));
  settle(400);
  look_through();
  ASSERT_TRUE(window_->say("mesh " + mesh_));
  ASSERT_TRUE(window_->say("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1"));
  ASSERT_TRUE(window_->say("wall on"));
  settle(400);
  look_through();
  for (const std::string& context : translator_.contexts)
    EXPECT_EQ(context.find("QWidget"), std::string::npos)
        << "words of a class without Q_DECLARE_TR_FUNCTIONS have the context of Qt's class";
}

/// Words that are put into a widget as they stand in the sources.
std::vector<std::string> words_around_the_translator(const std::string& source) {
  static const std::regex put(
      R"re((setText|setToolTip|setWindowTitle|setPlaceholderText|setPrefix|setSuffix|setSpecialValueText|setAccessibleName|addTab|addMenu|addToolBar|setTitle|setLabelText|new QLabel|new QPushButton|new QCheckBox|new QRadioButton|new QDockWidget|getOpenFileName|getSaveFileName|getExistingDirectory|drawText|message_->tell|message_->answer)\(([^;"]*[^;"(r])?\(?"((?:[^"\\]|\\.)*)")re");
  std::vector<std::string> found;
  for (std::sregex_iterator it(source.begin(), source.end(), put), end; it != end; ++it) {
    const std::string before = (*it)[2], words = (*it)[3];
    static const std::regex has_words("[A-Za-z]{2}");
    if (before.find("tr(") != std::string::npos || before.find("translate(") != std::string::npos) continue;
    if (std::regex_search(words, has_words) && words != "Cleft")
      found.push_back((*it)[1].str() + ": " + words);
  }
  return found;
}

TEST(Sources, PutNoWordsIntoWidgetsThatCannotBeTranslated) {
  EXPECT_EQ(words_around_the_translator("a->setText(\"Open a file\");").size(), 1u) << "the check finds them";
  EXPECT_EQ(words_around_the_translator("a->setText(QString(\"%1 of\").arg(1));").size(), 1u);
  EXPECT_EQ(words_around_the_translator("a->setText(on ? \"Open\" : tr(\"Close\"));").size(), 1u);
  EXPECT_TRUE(words_around_the_translator("a->setText(tr(\"Open a file\"));").empty());
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(APP_SOURCES)) {
    if (entry.path().extension() != ".cpp") continue;
    ++files;
    for (const std::string& words : words_around_the_translator(read_text_file(entry.path().string())))
      ADD_FAILURE() << entry.path().filename() << ": " << words;
  }
  EXPECT_GT(files, 20);
}

}  // namespace
}  // namespace cleft
