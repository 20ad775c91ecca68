#!/usr/bin/env bash
# install.sh [SECTION...]: installs the Debian packages of packages.txt that are missing, and nothing else: what building
# needs, and the sections that are named: solver, explorer, python, tests, benchmarks, docs, packages. `demo`, and no
# argument: solver and explorer; `tests` adds these and python too, and `benchmarks` adds the tests. Says what it will do;
# works as root or through sudo; does nothing when all is there.
set -eu
here=$(cd "$(dirname "$0")" && pwd)

sections=" build "
for section in "${@:-demo}"; do
  case $section in
    demo) sections+="solver explorer " ;;
    tests) sections+="solver explorer python tests " ;;
    benchmarks) sections+="solver explorer python tests benchmarks " ;;
    build | solver | explorer | python | docs | packages) sections+="$section " ;;
    *) echo "install.sh: error: unknown section '$section': build, solver, explorer, python, demo, tests, benchmarks, docs or packages" >&2; exit 2 ;;
  esac
done

missing=() section=
while read -r package; do
  case $package in '' | '#'*) continue ;; '['*) section=${package//[\[\]]/}; continue ;; esac
  [[ $sections == *" $section "* ]] || continue
  [ "$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)" = "install ok installed" ] || missing+=("$package")
done < "$here/packages.txt"
[ ${#missing[@]} -gt 0 ] || exit 0

echo "Installing ${#missing[@]} Debian packages with apt-get: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo > /dev/null || { echo "This needs root: run it as root, or install sudo." >&2; exit 1; }
  as_root=(sudo)
fi
log=$(mktemp)
export DEBIAN_FRONTEND=noninteractive
start=$SECONDS
if ! { "${as_root[@]}" apt-get update -q &&
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"; } > "$log" 2>&1; then
  tail -20 "$log" >&2
  echo "apt-get failed; its whole output is in $log" >&2
  exit 1
fi
rm -f "$log"
echo "Installed in $((SECONDS - start)) s."
