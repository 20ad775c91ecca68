#!/usr/bin/env python3
"""make_page.py ROW...: writes docs/stability.md, from the rows that record_limit wrote, to standard output. A row is
"| method | limit | what the test shows | noticed | then | `test` |"."""
import sys
import textwrap

HEAD = """# Stability: where methods fail

Each section is a test that takes a method to the point where it fails. The numbers are those that the test
measured, rounded. `tests/stability/table.sh` makes this page; `tests/stability/limits.txt` lists the order
and the tests.
"""
NAMES = ["Limit", "Measured", "Detected", "Consequence", "Test"]


def section(row):
    method, *cells = (cell.strip() for cell in row.strip().strip("|").split("|"))
    lines = ["", f"## {method[0].upper()}{method[1:]}", ""]
    for name, cell in zip(NAMES, cells, strict=True):
        lines += textwrap.wrap(f"- **{name}**: {cell}", 110, subsequent_indent="  ", break_long_words=False,
                               break_on_hyphens=False)
    return "\n".join(lines) + "\n"


print(HEAD, end="")
for name in sys.argv[1:]:
    with open(name) as file:
        print(section(file.read()), end="")
