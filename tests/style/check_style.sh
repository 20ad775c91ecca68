#!/usr/bin/env bash
# check_style.sh ROOT BUILD: clang-format and clang-tidy over the C++ files of ROOT that have changed, with ROOT's
# .clang-format and .clang-tidy and the compile commands that CMake wrote to BUILD. Exit code 1 where one complains.
#
# Changed is what differs from a base commit, uncommitted and untracked files included. The base is
#   - the commit CLEFT_STYLE_BASE, where that is set;
#   - else the merge base with the branch's upstream, where HEAD has commits of its own since;
#   - else the last tag before HEAD, where it is at most 20 commits back;
#   - else the commit 20 before HEAD, or the oldest there is (a shallow clone).
# Without a base (no git, or a clone of a single commit) clang-format checks all files, and clang-tidy none.
#
# clang-format checks whole files. clang-tidy is slow, so it checks .cpp files only, the last changed first, at most 24
# of them, until 60 seconds have passed, and what it finds counts where the line has changed (in headers too). The last
# line says how many files were checked, and how many were not.
set -eu
root=$1; build=$2; here=$(cd "$(dirname "$0")" && pwd)
most_files=24; most_seconds=60; commits_back=20
for tool in clang-format clang-tidy; do
  command -v $tool > /dev/null || { echo "$tool is missing; ./setup/install.sh tests installs it"; exit 1; }
done
[ -f "$build/compile_commands.json" ] || { echo "$build has no compile_commands.json; configure it with CMake"; exit 1; }
cd "$root"

base_commit() {
  [ -z "${CLEFT_STYLE_BASE:-}" ] || { git rev-parse --verify "$CLEFT_STYLE_BASE^{commit}"; return; }
  local base
  base=$(git merge-base HEAD '@{upstream}' 2> /dev/null) && [ "$base" != "$(git rev-parse HEAD)" ] && { echo "$base"; return; }
  base=$(git describe --tags --abbrev=0 HEAD^ 2> /dev/null) && [ "$(git rev-list --count "$base..HEAD")" -le $commits_back ] &&
    { git rev-parse "$base^{commit}"; return; }
  base=$(git rev-list --first-parent --max-count=$((commits_back + 1)) HEAD 2> /dev/null | tail -n 1)
  [ "$base" = "$(git rev-parse HEAD 2> /dev/null)" ] || echo "$base"
}
sources=('*.cpp' '*.h')
top=$(git rev-parse --show-toplevel 2> /dev/null || true)
if [ -n "$top" ] && [ "$(realpath "$top")" = "$(realpath .)" ]; then base=$(base_commit); else base=; fi
if [ -z "$base" ]; then
  echo "no earlier commit is known: the format of all files is checked, and clang-tidy is left out"
  mapfile -t changed < <(find . -path ./build -prune -o \( -name '*.cpp' -o -name '*.h' \) -print | sort)
else
  echo "files changed since $(git show -s --format='%h (%s)' "$base")"
  mapfile -t changed < <({ git diff --name-only --diff-filter=d "$base" -- "${sources[@]}"
                           git ls-files --others --exclude-standard -- "${sources[@]}"; } | sort -u)
fi

bad=0
if [ ${#changed[@]} -gt 0 ]; then
  printf '%s\0' "${changed[@]}" | xargs -0 clang-format --dry-run -Werror || { bad=1; echo "clang-format -i mends these"; }
fi
[ -n "$base" ] || { echo "clang-format: ${#changed[@]} files; clang-tidy: none"; exit $bad; }

# The lines that count: [{"name": file, "lines": [[first, last], ...]}, ...], one file a line.
lines=$({ git diff -U0 -M --diff-filter=d "$base" -- "${sources[@]}"
          git ls-files -z --others --exclude-standard -- "${sources[@]}" |
            while IFS= read -r -d '' file; do echo "+++ b/$file"; echo "@@ -0,0 +1,$(wc -l < "$file") @@"; done; } |
  awk '/^\+\+\+ b\// { file = substr($0, 7); next }
       /^@@ / { split(substr($3, 2), at, ","); n = at[2] == "" ? 1 : at[2]
                if (n > 0) of[file] = of[file] (of[file] == "" ? "" : ",") "[" at[1] "," at[1] + n - 1 "]" }
       END { for (file in of) printf "{\"name\":\"%s\",\"lines\":[%s]}\n", file, of[file] }')
mapfile -t last_changed_first < <({ git diff --name-only HEAD -- '*.cpp'
                                    git ls-files --others --exclude-standard -- '*.cpp'
                                    git log --format= --name-only "$base..HEAD" -- '*.cpp'; } | awk '!seen[$0]++')
filter="[$(paste -sd, <<< "$lines")]"
commands=$(mktemp -d); trap 'rm -rf "$commands"' EXIT
python3 "$here/single_commands.py" "$build" "$commands"
checked=0; skipped=0; start=$SECONDS
for file in "${last_changed_first[@]}"; do
  grep -qF "{\"name\":\"$file\"," <<< "$lines" || continue                  # taken away, or only moved
  grep -qF "/$file\"" "$commands/compile_commands.json" || continue           # not built here
  left=$((most_seconds - (SECONDS - start)))
  if [ $checked -ge $most_files ] || [ $left -le 0 ]; then skipped=$((skipped + 1)); continue; fi
  result=0
  output=$(timeout "$left" clang-tidy --quiet -p "$commands" --warnings-as-errors='*' --line-filter="$filter" \
    --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-ignored-optimization-argument "$root/$file" 2>&1) || result=$?
  if [ $result = 124 ]; then skipped=$((skipped + 1)); continue; fi
  checked=$((checked + 1))
  [ $result = 0 ] || { bad=1; echo "$output" | grep -vE '^[0-9]+ warnings? (generated|treated)'; }
done
echo "clang-format: ${#changed[@]} files; clang-tidy: $checked files in $((SECONDS - start)) s, $skipped left out"
exit $bad
