#include "explorer/app/help_sheet_dialog.h"

#include <QDialogButtonBox>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "explorer/session/command_table.h"

namespace cleft {

namespace {

const char* const mouse = R"(<h2>Mouse and keys</h2><table cellpadding=3>
<tr><td><b>Left, drag</b></td><td>turn the picture; with the scalpel: cut the skin</td></tr>
<tr><td><b>Shift + left, middle</b></td><td>move it</td></tr>
<tr><td><b>Wheel, right</b></td><td>zoom</td></tr>
<tr><td><b>Drag along an axis of "All cases"</b></td><td>keep the cases in that range; double-click: all</td></tr>
)";

/// The keys of all menu entries.
QString keys_of(const QList<QAction*>& actions) {
  QString html;
  for (const QAction* action : actions)
    if (!action->shortcut().isEmpty())
      html += "<tr><td><b>" + action->shortcut().toString(QKeySequence::NativeText).toHtmlEscaped() +
              "</b></td><td>" + QString(action->text()).remove('&').remove(" ...").toHtmlEscaped() +
              "</td></tr>";
  return html + "</table>";
}

QString commands() {
  QString html =
      "<h2>Commands</h2><p>For the command line below the picture, and for scripts "
      "(<code>cleft explore --script FILE</code>).</p>";
  for (const CommandGroup& group : command_groups()) {
    html += "<h3>" + QString::fromStdString(group.title) + "</h3><table cellpadding=3>";
    for (const Command& c : group.commands)
      html += "<tr><td><b>" + QString::fromStdString(c.name) + "</b> " +
              QString::fromStdString(c.arguments).toHtmlEscaped() + "</td><td>" +
              QString::fromStdString(c.help).toHtmlEscaped() + "</td></tr>";
    html += "</table>";
  }
  return html;
}

}  // namespace

HelpSheet::HelpSheet(QWidget* parent, const QList<QAction*>& actions) : QDialog(parent) {
  setObjectName("help");
  setWindowTitle("Cleft: keys and commands");
  resize(760, 620);
  auto* text = new QTextBrowser(this);
  text->setObjectName("help_text");
  text->setHtml(mouse + keys_of(actions) + commands());
  auto* close = new QDialogButtonBox(QDialogButtonBox::Close, this);
  auto* column = new QVBoxLayout(this);
  column->addWidget(text);
  column->addWidget(close);
  connect(close, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

}  // namespace cleft
