#include "explorer/app/help_sheet_dialog.h"

#include <QDialogButtonBox>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "explorer/session/command_table.h"

namespace cleft {

namespace {

QString row(const QString& keys, const QString& what) {
  return "<tr><td><b>" + keys.toHtmlEscaped() + "</b></td><td>" + what.toHtmlEscaped() + "</td></tr>";
}

QString mouse() {
  return "<h2>" + HelpSheet::tr("Mouse and keys") + "</h2><table cellpadding=3>" +
         row(HelpSheet::tr("Left, drag"),
             HelpSheet::tr("turn the picture; with the scalpel: cut the skin; a ball: change its cut")) +
         row(HelpSheet::tr("Shift + left, middle"), HelpSheet::tr("move it")) +
         row(HelpSheet::tr("Wheel, right"), HelpSheet::tr("zoom")) +
         row(HelpSheet::tr("Drag along an axis of \"All cases\""),
             HelpSheet::tr("keep the cases in that range; double-click: all"));
}

/// The keys of all menu entries.
QString keys_of(const QList<QAction*>& actions) {
  QString html;
  for (const QAction* action : actions)
    if (!action->shortcut().isEmpty())
      html += row(action->shortcut().toString(QKeySequence::NativeText),
                  QString(action->text()).remove('&').remove(" ..."));
  return html + "</table>";
}

QString commands() {
  QString html = "<h2>" + HelpSheet::tr("Commands") + "</h2><p>" +
                 HelpSheet::tr(
                     "For the command line below the picture, and for scripts (<code>cleft explore --script "
                     "FILE</code>).") +
                 "</p>";
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
  setWindowTitle(tr("Cleft: keys and commands"));
  resize(760, 620);
  auto* text = new QTextBrowser(this);
  text->setObjectName("help_text");
  text->setHtml(mouse() + keys_of(actions) + commands());
  auto* close = new QDialogButtonBox(QDialogButtonBox::Close, this);
  auto* column = new QVBoxLayout(this);
  column->addWidget(text);
  column->addWidget(close);
  connect(close, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

}  // namespace cleft
