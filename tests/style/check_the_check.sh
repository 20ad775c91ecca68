#!/usr/bin/env bash
# check_the_check.sh ROOT: in a small repository of its own with ROOT's rules, check_style.sh accepts what keeps them and
# finds each thing that does not.
set -eu
root=$1; here=$(cd "$(dirname "$0")" && pwd)
copy=$(mktemp -d); trap 'rm -rf "$copy"' EXIT
cp "$root/.clang-format" "$root/.clang-tidy" "$copy"
cd "$copy"; mkdir build; echo build > .gitignore
good='int zero() { return 0; }'; unformatted='int   zero( ){return 0;}'; finding='int* nowhere() { return 0; }'
printf '%s\n' "$finding" > old.cpp          # from before anybody looked
printf '%s\n' "$good" > a.cpp
printf '[%s]\n' "$(for f in a old new; do printf '{"directory":"%s","file":"%s/%s.cpp","command":"c++ -c %s.cpp"},' "$copy" "$copy" $f $f
  done | sed 's/,$//')" > build/compile_commands.json
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
unset CLEFT_STYLE_BASE GIT_DIR GIT_WORK_TREE
expect() {  # RESULT WHAT TEXT: the check ends with RESULT, and its output holds TEXT
  local result=0 output
  output=$("$here/check_style.sh" "$copy" "$copy/build" 2>&1) || result=$?
  if [ $result != "$1" ] || ! grep -qF -- "$3" <<< "$output"; then
    echo "$2: exit code $result, not $1 with '$3':"; echo "$output"; exit 1
  fi
}
expect 0 "no repository at all" "clang-tidy: none"
git init -q; git add .; git commit -qm first
expect 0 "a single commit" "clang-tidy: none"
printf '%s\n' "$unformatted" > a.cpp; expect 1 "a single commit, badly formatted" "clang-format -i mends"
printf '// Nothing.\n%s\n' "$good" > a.cpp; git commit -qam second
expect 0 "a changed file that keeps the rules" "clang-tidy: 1 files"
printf '%s\n' "$unformatted" > new.cpp; expect 1 "an untracked file, badly formatted" "clang-format -i mends"
printf '%s\n' "$finding" > new.cpp; expect 1 "an untracked file with a finding" "modernize-use-nullptr"
git add .; git commit -qm third; expect 1 "a committed file with a finding" "modernize-use-nullptr"
CLEFT_STYLE_BASE=HEAD expect 0 "nothing changed since the given base" "clang-tidy: 0 files"
printf '%s\n' "$good" > new.cpp; printf '\n%s\n' "$good" >> old.cpp; git commit -qam fourth
expect 0 "a finding in a line that has not changed" "clang-tidy: 3 files"
git mv old.cpp moved.cpp; git commit -qm fifth; CLEFT_STYLE_BASE=HEAD~1 expect 0 "a file that only moved" "clang-tidy: 0 files"
echo "everything that breaks the rules was found"
