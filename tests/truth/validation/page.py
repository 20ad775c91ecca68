"""The page's tables: rows, numbers rounded so that they are the same on every machine, and its texts."""

import difflib
import math
import re


def below(error, least=1e-13):
    """The power of ten above it, and above `least`, which is chosen above what rounding and the ends of iterations
    decide."""
    return f"< 1e{math.floor(math.log10(max(error, least)) + 1e-9) + 1}" if math.isfinite(error) else "-"


def number(value):
    return f"{value:.3g}"


def percent(value, sign=True):
    return f"{100 * value:+.1f} %" if sign else f"{100 * value:.2g} %"


class Page:
    """Its texts are the sections of a file, "<!-- name -->" before each."""

    def __init__(self, texts):
        parts = re.split(r"<!-- (\w+) -->\n", texts.read_text())
        self.texts = dict(zip(parts[1::2], parts[2::2]))
        self.sections, self.failed, self.differs = {"intro": []}, [], False
        self.name = "intro"

    def begin(self, name, heads):
        self.name = name
        self.sections[name] = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]

    def row(self, *cells):
        """The last: whether the row is within its bound; None: it has none."""
        *cells, holds = cells
        line = "| " + " | ".join(cells) + " |"
        self.sections[self.name].append(line)
        if holds is not None and not holds:
            self.failed.append(line)

    def text(self, name):
        return "\n".join([self.texts[name], *self.sections[name]]).rstrip("\n") + "\n"

    def written(self):
        return "\n".join(self.text(name) for name in self.sections)

    def compare(self, page, name):
        """Section by section, as each begins with its heading."""
        parts = {part.splitlines()[0]: part for part in re.split(r"\n(?=## )", page)}
        for section in self.sections:
            measured = self.text(section)
            found = parts.get(measured.splitlines()[0], "")
            lines = list(difflib.unified_diff(found.splitlines(), measured.splitlines(), name, "measured", lineterm="", n=0))
            if lines:
                self.differs = True
                print("\n".join(lines))
        if self.differs:
            print(f"{name} is not what its command measures: tests/truth/validation/page.sh writes it again")
