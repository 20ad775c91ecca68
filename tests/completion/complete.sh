#!/usr/bin/env bash
# complete.sh PYTHON SOURCE BIN: makes the completion for bash and completes words with it as bash would; makes the man
# pages, which have to list the same options.
set -eu
python=$1 pages=$2/docs/generate/help_pages.py bin=$3
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
"$python" "$pages" completion "$bin" "$work/cleft"
"$python" "$pages" man "$bin" "$work/man"
. "$work/cleft"

bad=0
# expect WORDS... = ANSWER: what the last of the words is completed to
expect() {
  COMP_WORDS=()
  while [ "$1" != "=" ]; do COMP_WORDS+=("$1"); shift; done
  shift
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _cleft
  [ "${COMPREPLY[*]-}" = "$*" ] || { echo "${COMP_WORDS[*]}: expected '$*', got '${COMPREPLY[*]-}'"; bad=1; }
}
expect cleft en = encode
expect cleft stat = status
expect cleft encode --par = --parametrization
expect cleft encode --parametrization t = tip
expect cleft nonsense -- =
[ ! -x "$bin/cleft-solve" ] || { expect cleft so = solve; expect cleft solve --method it = iterative; }
if [ -x "$bin/cleft-cut" ]; then
  expect cleft cut --ma = --max-edge
  COMP_WORDS=(cleft cut --) COMP_CWORD=2
  _cleft
  for option in $("$bin/cleft" cut --help | grep -oE '^  (-h,)?--[a-z-]+' | sed 's/.*--/--/'); do
    [[ " ${COMPREPLY[*]} " == *" $option "* ]] || { echo "cleft cut --: $option is missing"; bad=1; }
  done
fi
for page in "$work"/man/cleft-*.1; do
  command=$(basename "$page" .1)
  for option in $("$bin/$command" --help | grep -oE '^  (-h,)?--[a-z-]+' | sed 's/.*--/--/'); do
    grep -qF -- "${option//-/\\-}\\fR" "$page" || { echo "$page: $option is missing"; bad=1; }
  done
done
diff <("$bin/cleft" help encode) <("$bin/cleft" encode --help) || bad=1
exit $bad
