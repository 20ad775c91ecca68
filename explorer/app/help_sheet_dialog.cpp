#include "explorer/app/help_sheet_dialog.h"

#include <QDialogButtonBox>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "explorer/session/command_table.h"

namespace cleft {

namespace {

const char* const keys = R"(<h2>Mouse and keys</h2><table cellpadding=3>
<tr><td><b>Left, drag</b></td><td>turn the picture; with the scalpel: cut the skin</td></tr>
<tr><td><b>Shift + left, middle</b></td><td>move it</td></tr>
<tr><td><b>Wheel, right</b></td><td>zoom</td></tr>
<tr><td><b>Space</b></td><td>play or pause</td></tr>
<tr><td><b>Left, Right</b></td><td>back or on by 1 mm of cut</td></tr>
<tr><td><b>Page Up, Page Down</b></td><td>case before, next case</td></tr>
<tr><td><b>P, Z</b></td><td>click a point: plot its motion, or read the simulation's nodes there; Esc: no more</td></tr>
<tr><td><b>C</b></td><td>scalpel on or off</td></tr>
<tr><td><b>Ctrl+Z, Ctrl+Shift+Z</b></td><td>take the last cut or tension back, make it again</td></tr>
<tr><td><b>Home</b></td><td>camera back to where it was at first</td></tr>
<tr><td><b>Ctrl+O, Ctrl+M</b></td><td>open a study, a mesh</td></tr>
<tr><td><b>Ctrl+P</b></td><td>screenshot</td></tr>
<tr><td><b>Ctrl+S, Ctrl+L</b></td><td>save the session, load one</td></tr>
<tr><td><b>Ctrl+D</b></td><td>dark or light</td></tr>
<tr><td><b>F1</b></td><td>this sheet</td></tr></table>)";

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

HelpSheet::HelpSheet(QWidget* parent) : QDialog(parent) {
  setObjectName("help");
  setWindowTitle("Cleft: keys and commands");
  resize(760, 620);
  auto* text = new QTextBrowser(this);
  text->setObjectName("help_text");
  text->setHtml(keys + commands());
  auto* close = new QDialogButtonBox(QDialogButtonBox::Close, this);
  auto* column = new QVBoxLayout(this);
  column->addWidget(text);
  column->addWidget(close);
  connect(close, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

}  // namespace cleft
