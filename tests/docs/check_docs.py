#!/usr/bin/env python3
"""check_docs.py ROOT: checks the documents of the project: no line is longer than 110 columns; each folder that
tests/includes/check_includes.sh lists has a README of at most 20 lines; each file that a document links to exists."""
import re
import sys
from pathlib import Path

COLUMNS, README_LINES = 110, 20


def documents(root):
    skipped = {".git", "build", "out"}
    return sorted(p for p in root.rglob("*.md") if not skipped & set(p.relative_to(root).parts))


def folders(root):
    text = (root / "tests/includes/check_includes.sh").read_text()
    return [line.split(":")[0] for line in re.search(r"<<'PARTS'\n(.*?)\nPARTS", text, re.S).group(1).splitlines()]


def complaints(root):
    for path in documents(root):
        name, text = path.relative_to(root), path.read_text()
        for number, line in enumerate(text.splitlines(), 1):
            if len(line) > COLUMNS:
                yield f"{name}:{number}: {len(line)} columns; break the line at {COLUMNS}"
        for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text):
            if "://" not in target and not (path.parent / target).exists():
                yield f"{name}: the link to {target} leads to no file"
    for folder in folders(root):
        readme = root / folder / "README.md"
        if not readme.exists():
            yield f"{folder}: no README.md; write what the folder is, what it reads and makes, what it may include"
        elif (lines := len(readme.read_text().splitlines())) > README_LINES:
            yield f"{folder}/README.md: {lines} lines; a folder's README has at most {README_LINES}"


if __name__ == "__main__":
    found = list(complaints(Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
