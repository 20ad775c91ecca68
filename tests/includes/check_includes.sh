#!/usr/bin/env bash
# check_includes.sh ROOT: keeps the one-way dependencies of docs/architecture.md. A part may include itself and what
# its line names; third-party headers that only some parts may see are named below.
set -u
root=$1; bad=0

complain() { echo "$1: a file here must not include $2:"; sed 's/^/  /' <<<"$3"; bad=1; }

# part : parts it may include, as extended regular expressions of paths
while IFS=: read -r part allowed; do
  [ -n "$part" ] || continue
  [ -d "$root/$part" ] || { echo "$part: no such folder"; bad=1; continue; }
  nested=$(case $part in solver) echo snapshot ;; encoder) echo field import interpolate ;; *) echo nowhere ;; esac)
  found=$(find "$root/$part" \( -false $(printf -- "-o -path $root/$part/%s " $nested) \) -prune -o \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 -r grep -HnE '#include "(base|params|solver|encoder|haptic|explorer|tradeoff|cli|examples)/' |
    grep -vE "#include \"($part|$allowed)/")
  [ -z "$found" ] || complain "$part" "anything but $allowed" "$found"
done <<'PARTS'
base:base
params:base
solver/snapshot:base
solver:base|params
encoder/field:base
encoder:base|params|solver/snapshot
encoder/import:base|solver/snapshot
encoder/interpolate:base|encoder/field|params
haptic:base|encoder/field
explorer/incision:base|encoder/field|haptic
explorer/io:base|explorer/incision|solver/snapshot
explorer/scene:base|encoder/field|encoder/interpolate|haptic|explorer/incision|solver/snapshot|params
explorer/view:base|encoder/field|haptic|explorer/incision|explorer/scene|explorer/io
explorer/app:base|params|encoder/field|haptic|explorer/incision|explorer/scene|explorer/view
tradeoff:base|params|solver/snapshot|encoder|haptic|explorer/incision|explorer/scene
cli:base|params|solver/snapshot|encoder/field
examples:base
PARTS

# forbid NAME PATTERN FOLDER...: no file of the folders may include a header that matches, but for what $except names
forbid() {
  local name=$1 pattern=$2 found; shift 2
  found=$(cd "$root" && grep -rnE --include='*.h' --include='*.cpp' "#include <($pattern)" "$@" | grep -vE "^(${except:-$^})")
  [ -z "$found" ] || complain "$*" "$name" "$found"
}
forbid "deal.II or Trilinos" 'deal\.II/|Epetra|ml_|Teuchos|dmumps' base params solver/snapshot encoder haptic explorer tradeoff cli examples
forbid "MPI" 'mpi\.h' base params solver/snapshot encoder haptic explorer tradeoff cli examples
except='encoder/import/|base/vtk_listener\.h:' forbid "VTK or Qt" 'vtk|Q[A-Z]' base params solver encoder haptic explorer/incision explorer/scene tradeoff cli
forbid "Qt" 'Q[A-Z]' base params solver encoder haptic explorer/incision explorer/scene explorer/io explorer/view tradeoff cli examples
forbid "Eigen" 'Eigen/' base params encoder/field haptic
forbid "HDF5" 'hdf5|H5' params solver encoder haptic explorer tradeoff cli examples
found=$(cd "$root" && grep -rn --include='*.h' --include='*.cpp' '#include "encoder/import/' base params solver encoder haptic \
  explorer tradeoff cli examples | grep -v '^encoder/import/')
[ -z "$found" ] || complain "other folders" "encoder/import" "$found"
exit $bad
