#!/usr/bin/env bash
# The manual pages that the build made: one for each command, with all of its options, as `man` prints them.
#   tests/scripts/manual_test.sh BUILD_FOLDER
# Exit code 77: skipped, as the pages were not built or `man` is not here.
set -euo pipefail
pages=$1/packaging/manual
raks=$1/bin/raks
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() {
    echo "FAILED: $*" >&2
    failures=1
}
[ -e "$pages/raks/raks.1" ] || { echo "skipped: the manual was not built"; exit 77; }
command -v man groff >/dev/null || { echo "skipped: man is not here (package man-db)"; exit 77; }
export LC_ALL=C.UTF-8 MANWIDTH=80 MANPAGER=cat

for page in "$pages"/*/*.1; do
    name=$(basename "$page" .1)
    man --warnings -l "$page" 2>"$work/said" | sed 's/.\x08//g' >"$work/$name"
    [ ! -s "$work/said" ] || fail "$name: $(cat "$work/said")"
    for section in NAME SYNOPSIS DESCRIPTION OPTIONS "EXIT STATUS" "SEE ALSO"; do
        grep -q "^$section\$" "$work/$name" || fail "$name has no $section"
    done
done
for wanted in raks:SETTINGS raks:FILES raks:EXAMPLES raks-play:KEYS raks-play:EXAMPLES raks-stick:KEYS; do
    grep -q "^${wanted#*:}\$" "$work/${wanted%:*}" || fail "${wanted%:*} has no ${wanted#*:}"
done

# commands_of COMMAND...: those that its help lists.
commands_of() { "$raks" "$@" --help | sed -n '/^Subcommands:/,$s/^  \([a-z]*\) .*/\1/p'; }
# Each has an entry of its own.
has_options() {
    local page=$1 option
    shift
    while read -r option; do
        grep -qE -- "^ {7}(-.*, )?$option([ ,]|$)" "$work/$page" || fail "$page: $* has $option, and the page has not"
    done < <("$raks" "$@" --help | sed -n 's/^  \(-[^ ]*\).*/\1/p' | sed 's/{false}//; s/,/\n/g' | grep '^--')
}
count=0
for command in $(commands_of); do
    page=raks-$command
    grep -q "^ *$page(1)" "$work/raks" || fail "raks does not name $page"
    [ -e "$work/$page" ] || {
        # Of a program that was not built there is none.
        [[ $command == @(train|capture) && ! -x $1/bin/$page ]] || fail "there is no $page"
        continue
    }
    below=$(commands_of "$command")
    [ -n "$below" ] || has_options "$page" "$command"
    for inner in $below; do
        has_options "$page" "$command" "$inner"
    done
    count=$((count + 1))
done
[ $count -ge 17 ] || fail "only $count commands were looked at"
exit $failures
