#!/usr/bin/env bash
# check_the_check.sh ROOT: adds forbidden includes to a copy of the sources; each must be found.
set -eu
root=$1; here=$(cd "$(dirname "$0")" && pwd)
copy=$(mktemp -d); trap 'rm -rf "$copy"' EXIT
(cd "$root" && find base params solver encoder haptic explorer tradeoff cli examples python \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 cp --parents -t "$copy"); mkdir -p "$copy/haptic"
"$here/check_includes.sh" "$copy" || { echo "the copy itself fails"; exit 1; }
# All at once, each in a file of its own that the check must name.
declare -A planted=()
plant() {  # FOLDER ENDING LINE
  local file=$1/forbidden_${#planted[@]}.$2
  printf '%s\n' "$3" > "$copy/$file"
  planted[$file]=$3
}
expect_all_found() {  # CHECK
  local output result=0 file
  output=$("$1" "$copy" 2>&1) || result=$?
  [ $result != 0 ] || { echo "$1 ends with 0"; exit 1; }
  for file in "${!planted[@]}"; do
    grep -qF -- "$file:" <<< "$output" || { echo "not found: ${planted[$file]} in $file"; exit 1; }
    rm "$copy/$file"
  done
  planted=()
}
while IFS='|' read -r folder include; do
  plant "$folder" h "#include $include"
done <<'CASES'
base|"params/study.h"
params|"solver/solve.h"
solver/snapshot|"params/study.h"
solver|"encoder/encode.h"
encoder|"solver/solve.h"
encoder/field|"encoder/encode.h"
encoder|"explorer/study/study.h"
haptic|"explorer/incision/incision.h"
explorer/incision|"explorer/view/wound_view.h"
explorer/scene|<vtkPolyData.h>
explorer/incision|<QWidget>
explorer/view|<QWidget>
explorer/view|"explorer/app/panel.h"
explorer/scene|"explorer/view/stage.h"
explorer/wound|"explorer/scene/coloring.h"
explorer/study|"explorer/wound/wounds.h"
explorer/incision|"explorer/wound/ipv.h"
explorer/scalpel|"explorer/session/session.h"
params|"params/run/lock.h"
encoder/field|"encoder/field/file/field_file.h"
haptic|"haptic/devices/hand.h"
explorer/app|"solver/snapshot/snapshot.h"
explorer/scene|"tradeoff/chart.h"
tradeoff|"explorer/view/stage.h"
explorer/view|<deal.II/grid/tria.h>
encoder/field|<Eigen/Core>
explorer/scene|<hdf5.h>
encoder|<vtkPolyData.h>
base|<vtkPolyData.h>
encoder/import|"encoder/encode.h"
encoder/import|"explorer/io/mesh_file.h"
encoder/import|<hdf5.h>
encoder|"encoder/import/series.h"
python|"explorer/io/mesh_file.h"
python|<hdf5.h>
CASES
expect_all_found "$here/check_includes.sh"
# The same for lists by hand of what a table states.
"$here/check_tables.sh" "$copy" || { echo "the copy itself fails"; exit 1; }
while IFS='|' read -r folder line; do
  plant "$folder" cpp "$line"
done <<'LISTS'
explorer/app|const char* meshes = "Surface meshes (*.stl *.obj)";
explorer/commands|bool is_volume(const std::string& path) { return path.ends_with(".vtu"); }
explorer/app|if (name == "hand") return;
explorer/commands|app.add_option("--device", device, "a spacemouse or a gamepad");
LISTS
expect_all_found "$here/check_tables.sh"
echo "every forbidden include and list was found"
