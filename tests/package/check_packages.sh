#!/usr/bin/env bash
# check_packages.sh CPACK BUILD [PYTHON]: makes the Debian packages of the library of the Python module and of the plug-in, which take seconds
# (that of the commands takes minutes), looks into them, imports the module from where it is unpacked, and has lintian
# check them where it is installed (setup/install.sh packages).
set -eu
cpack=$1 build=$2 python=${3:-}
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
components="development${python:+;python;paraview}"
"$cpack" --config "$build/CPackConfig.cmake" -B "$work" -D CPACK_COMPONENTS_ALL="$components" \
  -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }

# holds PACKAGE NAME...: files whose names end so
holds() {
  local package=$1 name; shift
  dpkg-deb -x "$work/${package}"_*.deb "$work/root"
  dpkg-deb -c "$work/${package}"_*.deb > "$work/list"
  for name in "$@"; do grep -q "$name\$" "$work/list" || { echo "$package has no $name"; exit 1; }; done
  ! grep -vE ' root/root ' "$work/list" || { echo "$package has files of other owners than root"; exit 1; }
}
holds libcleft-dev cleft/encoder/field/field.h libcleft_field.a CleftConfig.cmake libcleft-dev/copyright
if [ -n "$python" ]; then
  holds python3-cleft cleft/__init__.py cleft/_cleft.pyi .dist-info/entry_points.txt python3-cleft/copyright
  holds paraview-cleft cleft/paraview_plugin.py paraview-cleft/copyright
  folder=$(dirname "$(dirname "$(find "$work/root" -name paraview_plugin.py)")")
  PYTHONPATH=$folder "$python" -c 'import cleft, sys; assert cleft.__file__.startswith(sys.argv[1])' "$folder"
  dpkg-deb -f "$work"/python3-cleft_*.deb Depends | grep -qE 'python3 \(>= 3\.[0-9]+\).*libhdf5' ||
    { dpkg-deb -f "$work"/python3-cleft_*.deb Depends; exit 1; }
fi
if command -v lintian > /dev/null; then
  lintian --fail-on error --suppress-tags initial-upload-closes-no-bugs --allow-root "$work"/*.deb
else
  echo "lintian is not installed: not checked by it"
fi
