#!/usr/bin/env bash
# check_the_check.sh ROOT: adds one forbidden include at a time to a copy of the sources; each must be found.
set -eu
root=$1; here=$(cd "$(dirname "$0")" && pwd)
copy=$(mktemp -d); trap 'rm -rf "$copy"' EXIT
(cd "$root" && find base params solver encoder haptic explorer tradeoff cli examples python \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 cp --parents -t "$copy"); mkdir -p "$copy/haptic"
"$here/check_includes.sh" "$copy" || { echo "the copy itself fails"; exit 1; }
while IFS='|' read -r folder include; do
  printf '#include %s\n' "$include" > "$copy/$folder/forbidden.h"
  if "$here/check_includes.sh" "$copy" > /dev/null; then echo "not found: $include in $folder"; exit 1; fi
  rm "$copy/$folder/forbidden.h"
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
# The same for lists by hand of what a table states.
"$here/check_tables.sh" "$copy" || { echo "the copy itself fails"; exit 1; }
while IFS='|' read -r folder line; do
  printf '%s\n' "$line" > "$copy/$folder/forbidden.cpp"
  if "$here/check_tables.sh" "$copy" > /dev/null; then echo "not found: $line in $folder"; exit 1; fi
  rm "$copy/$folder/forbidden.cpp"
done <<'LISTS'
explorer/app|const char* meshes = "Surface meshes (*.stl *.obj)";
explorer/commands|bool is_volume(const std::string& path) { return path.ends_with(".vtu"); }
explorer/app|if (name == "hand") return;
explorer/commands|app.add_option("--device", device, "a spacemouse or a gamepad");
LISTS
echo "every forbidden include and list was found"
