#!/usr/bin/env bash
# check_tables.sh ROOT: mesh formats and devices are stated once. Finds texts of the program (string literals) that
# spell the ending of a mesh outside of its table and of its reader, or a device's name outside of its own file.
set -u
root=$1; bad=0
cd "$root" || exit 1

# literals PATTERN EXCEPT FOLDER...: lines with a string literal that matches, but for comments and the files EXCEPT
literals() {
  local pattern=$1 except=$2; shift 2
  grep -rnE --include='*.h' --include='*.cpp' "\"([^\"\\\\]|\\\\.)*($pattern)([^\"\\\\]|\\\\.)*\"" "$@" |
    grep -vE '^[^:]*:[0-9]+: *(//|#include)' | grep -vE "^($except)"
}
complain() { [ -z "$2" ] || { echo "$1:"; sed 's/^/  /' <<< "$2"; bad=1; }; }

# Series for ParaView (export_main, paraview_file) are no meshes that somebody cuts: their .vtu files are their own.
endings=$(grep -oE '\{"\.[a-z0-9]+"' explorer/io/formats/mesh_formats.h | tr -d '{".' | paste -sd'|')
[ -n "$endings" ] || { echo "no endings in explorer/io/formats/mesh_formats.h"; bad=1; }
complain "take endings of meshes from explorer/io/formats/mesh_formats.h" \
  "$(literals "\\.($endings)\\b" 'explorer/io/(formats/mesh_formats\.h|mesh_file\.cpp|(ply|stl)_file\.cpp|paraview_file\.cpp)|explorer/commands/export_main\.cpp|explorer/app/examples\.cpp' explorer haptic tradeoff cli)"

names=$(grep -rhoE --include='*.h' --include='*.cpp' '(\.name|char\* [a-z]*_?name) = "[a-z]+"' haptic/devices | grep -oE '"[a-z]+"' | tr -d '"' | sort -u)
[ "$(wc -w <<< "$names")" -ge 6 ] || { echo "the devices' rows were not found in haptic/devices"; bad=1; }
for name in $names; do
  own=$(grep -rlE --include='*.h' --include='*.cpp' "(\\.name|char\\* [a-z]*_?name) = \"$name\"" haptic/devices)
  complain "take the device's name from its row (haptic/devices/list.h)" \
    "$(grep -rnE --include='*.h' --include='*.cpp' "\"$name\"" explorer haptic tradeoff cli | grep -v "^$own:")"
done
# Names that are no words of English are found within texts, too.
rare=$(grep -E 'spacemouse|gamepad|phantom' <<< "$names" | paste -sd'|')
complain "take lists of devices from device_choices() or device_usages()" \
  "$(literals "\\b($rare)\\b" 'haptic/devices/(spacemouse|gamepad|phantom)\.(cpp|h)' explorer haptic tradeoff cli)"
exit $bad
