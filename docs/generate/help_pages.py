"""help_pages.py man|completion BIN OUT: man pages, or the completion for bash, of the commands in the folder BIN.

Everything comes from what the commands print on --help: `cleft --help` lists the commands, and each of them its options.
`man` writes cleft.1 and cleft-COMMAND.1 into the folder OUT, `completion` writes the file OUT.
"""

import os
import re
import subprocess
import sys


def printed(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def commands_of(bin_folder):
    """[(name, summary)] of the commands that are built."""
    text = printed(os.path.join(bin_folder, "cleft"), "--help")
    listed = re.findall(r"^  (\w[\w-]*) {2,}(.+)$", text, re.M)
    return [pair for pair in listed if os.access(os.path.join(bin_folder, "cleft-" + pair[0]), os.X_OK)]


class Entry:
    """An option or a positional argument: names, what its value must be, and its help."""

    def __init__(self, head, text):
        word, _, self.value = head.partition(" ")
        self.names = word.split(",")
        self.text = text
        choices = re.search(r"\{([^}]*)\}", self.value)
        self.choices = choices.group(1).split(",") if choices else []

    @property
    def takes_value(self):
        return re.match(r"(TEXT|INT|UINT|FLOAT)\b", self.value) is not None


class Help:
    """The parts of a command's help: description, usage, positionals, options, and what follows them."""

    def __init__(self, text):
        before, _, rest = text.partition("\nUsage: ")
        self.description = before.strip()
        self.usage, _, rest = rest.partition("\n")
        self.entries = {"Positionals": [], "Options": []}
        section, self.rest, head = None, "", None
        lines = rest.split("\n")
        for k, line in enumerate(lines):
            if line.rstrip(":") in self.entries and line.endswith(":"):
                section = self.entries[line.rstrip(":")]
            elif section is not None and re.match(r"  \S", line):
                # The help begins in column 35, behind two spaces, or on a line of its own.
                head, text = line[:34].strip(), line[34:].strip()
                if len(line) > 34 and line[33] != " ":
                    head, _, text = line.strip().partition("  ")
                section.append(Entry(head, text.strip()))
            elif section and re.match(r" {20,}\S", line):
                section[-1].text = (section[-1].text + " " + line.strip()).strip()
            elif line.strip():
                self.rest = "\n".join(lines[k:]).rstrip()
                break


def roff(text):
    """Text as troff takes it: backslashes, hyphens, and lines that begin like a request."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def man_page(name, version, summary, text):
    page = Help(text)
    lines = ['.TH "%s" 1 "" "%s" "User Commands"' % (name.upper(), version),
             ".SH NAME", roff(name + " - " + summary),
             ".SH SYNOPSIS", ".B " + roff(page.usage),
             ".SH DESCRIPTION", roff(page.description)]
    for title, entries in page.entries.items():
        if entries:
            lines.append(".SH " + ("ARGUMENTS" if title == "Positionals" else title.upper()))
        for entry in entries:
            lines += [".TP", r"\fB%s\fR %s" % (roff(", ".join(entry.names)), roff(entry.value)), roff(entry.text)]
    if page.rest:
        lines += [".SH NOTES", ".nf", roff(page.rest), ".fi"]
    lines += [".SH EXIT STATUS", "0 done, 1 failed, 2 wrong usage or input."]
    return "\n".join(lines) + "\n"


def write_man_pages(bin_folder, out):
    version = printed(os.path.join(bin_folder, "cleft"), "--version").strip()
    commands = commands_of(bin_folder)
    os.makedirs(out, exist_ok=True)
    for name, summary in commands:
        text = printed(os.path.join(bin_folder, "cleft-" + name), "--help")
        with open(os.path.join(out, "cleft-%s.1" % name), "w") as page:
            page.write(man_page("cleft-" + name, version, summary, text))
    with open(os.path.join(out, "cleft.1"), "w") as page:
        page.write("\n".join(
            ['.TH "CLEFT" 1 "" "%s" "User Commands"' % version, ".SH NAME",
             roff("cleft - simulations of a growing cut as discontinuous free-form deformations"), ".SH SYNOPSIS",
             ".B cleft", "COMMAND [OPTIONS]", ".SH COMMANDS"] +
            [".TP\n.BR cleft\\-%s (1)\n%s" % (roff(name), roff(summary)) for name, summary in commands]) + "\n")


SCRIPT = """\
# Completion of cleft and its commands for bash, made from their --help.
_cleft() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]:-}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "@COMMANDS@ --help --version" -- "$word"))
    return
  fi
  case "$command $before" in
@CHOICES@
  esac
  if [[ $word == -* ]]; then
    case $command in
@OPTIONS@
    esac
    return
  fi
  compopt -o filenames 2> /dev/null
  COMPREPLY=($(compgen -f -- "$word"))
}
complete -F _cleft cleft
"""


def write_completion(bin_folder, out):
    choices, options = [], []
    commands = commands_of(bin_folder)
    for name, _ in commands:
        entries = Help(printed(os.path.join(bin_folder, "cleft-" + name), "--help")).entries["Options"]
        words = [word for entry in entries for word in entry.names if word.startswith("--")]
        options.append('      %s) COMPREPLY=($(compgen -W "%s" -- "$word")) ;;' % (name, " ".join(words)))
        for entry in entries:
            if entry.choices:
                choices.append('    "%s %s") COMPREPLY=($(compgen -W "%s" -- "$word")); return ;;' %
                               (name, entry.names[-1], " ".join(entry.choices)))
    script = SCRIPT.replace("@COMMANDS@", " ".join(name for name, _ in commands))
    script = script.replace("@CHOICES@", "\n".join(choices)).replace("@OPTIONS@", "\n".join(options))
    os.makedirs(os.path.dirname(os.path.abspath(out)), exist_ok=True)
    with open(out, "w") as file:
        file.write(script)


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in ("man", "completion"):
        sys.exit(__doc__.split("\n")[0])
    {"man": write_man_pages, "completion": write_completion}[sys.argv[1]](sys.argv[2], sys.argv[3])
