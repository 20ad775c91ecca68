#!/usr/bin/env bash
# check_the_libraries_check.sh PYTHON ROOT: breaks the rule of check_libraries.py in a copy of ROOT in each of its ways; each
# has to be found.
set -eu
python=$1 root=$2 here=$(cd "$(dirname "$0")" && pwd)
copy=$(mktemp -d); trap 'rm -rf "$copy"' EXIT
(cd "$root" && find base params solver encoder haptic explorer tradeoff \( -name '*.cpp' -o -name CMakeLists.txt \) -print0 |
  xargs -0 cp --parents -t "$copy")
check() { "$python" "$here/check_libraries.py" "$copy"; }
check || { echo "the copy itself fails"; exit 1; }

# breaks WHAT FILE LINE: the line, added to the file, has to be found
breaks() {
  cp "$copy/$2" "$copy/kept"
  echo "$3" >> "$copy/$2"
  if check > /dev/null; then echo "not found: $1"; exit 1; fi
  mv "$copy/kept" "$copy/$2"
}
breaks "two libraries in one folder" base/CMakeLists.txt 'cleft_library(more text.cpp)'
breaks "a library of two folders" explorer/CMakeLists.txt 'cleft_library(both study/study.cpp wound/wounds.cpp)'
echo > "$copy/haptic/orphan.cpp"
if check > /dev/null; then echo "not found: a source of no library"; exit 1; fi
echo "every violation was found"
