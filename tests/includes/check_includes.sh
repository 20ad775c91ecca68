#!/usr/bin/env bash
# check_includes.sh ROOT: keeps the one-way dependencies of docs/architecture.md. A part may include itself and what
# its line names; third-party headers that only some parts may see are named below.
set -u
root=$1; bad=0

complain() { echo "$1: a file here must not include $2:"; sed 's/^/  /' <<<"$3"; bad=1; }

# folder : folders it may include, as extended regular expressions of paths. A folder listed with a folder inside it is checked
# without that one, which has a line of its own.
parts=$(cat <<'PARTS'
base:base
base/command:base
base/h5:base
base/ranks:base
params:base|params/parameters
params/parameters:base
params/material:base
params/run:base|base/command|params|params/parameters
solver/snapshot:base|base/h5|params/parameters
solver/body:base|base/h5|params|params/parameters
solver/multigrid:base
solver:base|base/command|base/h5|base/ranks|params|params/parameters|params/material|solver/snapshot|solver/body|solver/multigrid
encoder/field:base|params/parameters
encoder/field/file:base|base/h5|encoder/field|params/parameters
encoder:base|base/command|base/h5|params|params/parameters|encoder/field|encoder/field/file|solver/snapshot
encoder/import:base|base/command|base/h5|base/ranks|solver/snapshot|params/parameters|encoder/field|encoder/field/file
encoder/interpolate:base|base/command|encoder/field|encoder/field/file|params|params/parameters
encoder/command:base|base/command|base/h5|base/ranks|params|params/parameters|encoder|encoder/field|encoder/field/file|solver/snapshot
encoder/modes:base|base/command|encoder/field|encoder/field/file|encoder/interpolate|params|params/parameters
haptic:base|encoder/field|params/parameters
haptic/devices:base|haptic
explorer/incision:base|encoder/field
explorer/study:base|base/h5|params|params/parameters|solver/snapshot|encoder/field|encoder/field/file|encoder/interpolate
explorer/web:base|params|params/parameters|encoder/field|encoder/field/file|encoder/interpolate|explorer/incision|explorer/study|explorer/wound
explorer/analysis:base|encoder/field|encoder/interpolate|explorer/study|haptic|params/parameters
explorer/guard:base|explorer/incision
explorer/body:base|params|params/parameters|solver/body|solver/snapshot|haptic|explorer/incision|explorer/guard
explorer/wound:base|base/h5|params/material|encoder/field|encoder/field/file|explorer/incision|explorer/guard|explorer/study|params/parameters
explorer/scalpel:base|encoder/field|haptic|haptic/devices|explorer/incision|explorer/wound
explorer/scene:base|encoder/field|haptic|explorer/incision|explorer/body|explorer/study|explorer/wound|explorer/scalpel
explorer/session:base|params|params/parameters|params/run|encoder/field|haptic/devices|explorer/incision|explorer/body|explorer/study|explorer/wound|explorer/scene|explorer/io/formats
explorer/io:base|explorer/incision|explorer/io/formats|solver/snapshot
explorer/io/formats:base
explorer/view:base|encoder/field|haptic|explorer/incision|explorer/study|explorer/wound|explorer/scalpel|explorer/scene|explorer/session|explorer/io
explorer/app:base|params|params/parameters|encoder/field|haptic|haptic/devices|explorer/incision|explorer/study|explorer/wound|explorer/scalpel|explorer/scene|explorer/session|explorer/io/formats|explorer/view
explorer/commands:base|base/command|base/h5|params|params/parameters|params/run|encoder/field|encoder/field/file|haptic|haptic/devices|solver/snapshot|solver/body|explorer/[a-z]+|explorer/io/formats
tradeoff/rivals:base|encoder|encoder/field|solver/snapshot
tradeoff/replays:base|encoder/field|solver/snapshot|explorer/incision|explorer/wound|params/parameters
tradeoff:base|base/command|params|params/parameters|params/run|solver/snapshot|encoder|encoder/field|encoder/field/file|haptic|haptic/devices|explorer/incision|explorer/study|explorer/wound|explorer/scalpel|tradeoff/rivals|tradeoff/replays
cli:base|base/command|base/h5|params|params/parameters|params/run|solver/snapshot|encoder/field|encoder/field/file
examples/head:base|base/command
python:base|base/h5|params|params/parameters|solver/snapshot|encoder|encoder/field|encoder/field/file|encoder/interpolate|explorer/incision|explorer/body|explorer/study|explorer/wound|explorer/scene
PARTS
)
variants='kernels|parametrization|sampling|material'  # folders of one library that hold a file for each variant
folders=$(cut -d: -f1 <<< "$parts")
while IFS=: read -r part allowed; do
  [ -d "$root/$part" ] || { echo "$part: no such folder"; bad=1; continue; }
  inner=$(grep "^$part/" <<< "$folders")
  found=$(find "$root/$part" \( -false $(printf -- "-o -path $root/%s " ${inner:-nowhere}) \) -prune -o \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 -r grep -HnE '#include "(base|params|solver|encoder|haptic|explorer|tradeoff|cli|examples)/' |
    grep -vE "#include \"($part(/($variants))?|$allowed)/[^/]+\"")
  [ -z "$found" ] || complain "$part" "anything but $allowed" "$found"
done <<< "$parts"

# forbid NAME PATTERN FOLDER...: no file of the folders may include a header that matches, but for what $except names
forbid() {
  local name=$1 pattern=$2 found; shift 2
  found=$(cd "$root" && grep -rnE --include='*.h' --include='*.cpp' "#include <($pattern)" "$@" | grep -vE "^(${except:-$^})")
  [ -z "$found" ] || complain "$*" "$name" "$found"
}
forbid "deal.II or Trilinos" 'deal\.II/|Epetra|ml_|Teuchos|dmumps' base params solver/snapshot encoder haptic explorer tradeoff cli examples python
except='base/ranks/ranks\.cpp:' forbid "MPI" 'mpi\.h' base params solver/snapshot encoder haptic explorer tradeoff cli examples python
except='encoder/import/|base/vtk_listener\.h:' forbid "VTK or Qt" 'vtk|Q[A-Z]' base params solver encoder haptic explorer/incision explorer/study explorer/wound explorer/scalpel explorer/scene explorer/session explorer/io/formats tradeoff cli python
forbid "Qt" 'Q[A-Z]' base params solver encoder haptic explorer/incision explorer/study explorer/wound explorer/scalpel explorer/scene explorer/session explorer/io explorer/view tradeoff cli examples
forbid "Eigen" 'Eigen/' base params encoder/field haptic
forbid "HDF5" 'hdf5|H5' params solver encoder haptic explorer tradeoff cli examples python
found=$(cd "$root" && grep -rn --include='*.h' --include='*.cpp' '#include "encoder/import/' base params solver encoder haptic \
  explorer tradeoff cli examples | grep -v '^encoder/import/')
[ -z "$found" ] || complain "other folders" "encoder/import" "$found"
exit $bad
