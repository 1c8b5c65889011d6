#!/bin/sh
# Warns of commits that are hard to review: a title that is not "area: Imperative", no body with the reason, or more
# than 1,500 changed lines. Ends with 0 whatever it finds.
#   scripts/check_commits.sh [BASE]     the commits since BASE (origin/main), or the last 50 where there is no BASE
# Not counted: renames, lines that are the same where they were taken from and put to, golden pictures, kept scenes,
# what fuzzers have learnt, images. A rename of a name by a script counts; its body should say so.
set -eu
cd "$(dirname "$0")/.."
base=${1:-origin/main}
most_lines=1500

if git rev-parse --verify --quiet "$base^{commit}" >/dev/null; then
  range="$base..HEAD"
else
  echo "note: no commit '$base' here: looks at the last 50"
  range="-50"
fi

# title_fault TITLE: an area or several, a colon, and a verb that is in no other form ("Added", "Adding").
title_fault() {
  verb=$(printf '%s\n' "$1" | sed -nE 's#^[A-Za-z0-9_./-]+(, [A-Za-z0-9_./-]+)*: ([A-Z][^ ]*).*#\2#p')
  case $verb in
    '') echo "its title is not of the shape 'area: Imperative'" ;;
    Bring | Embed | Feed | Need | Seed | Speed) ;;
    *ed | *ing) echo "its title's verb '$verb' is not an imperative" ;;
  esac
  case $1 in *.) echo "its title ends with a full stop" ;; esac
}

# body_fault COMMIT: nothing below the title but trailers and numbers.
body_fault() {
  git show -s --format=%b "$1" | grep -Ev '^[A-Z][A-Za-z-]*: |^[^A-Za-z]*$' | grep -q . || echo "its body gives no reason"
}

# changed_lines COMMIT: added and removed, less those that only moved.
changed_lines() {
  git -c core.quotePath=off show --format= -M --unified=0 "$1" -- . ':!tests/golden' ':!tests/scenes_*' ':!tests/fuzz/corpus' \
    ':!*.png' ':!*.svg' ':!*.jpg' ':!*.exr' |
    awk '
      /^(diff|index|---|\+\+\+|@@)/ { next }
      /^[-+]/ {
        changed++
        line = substr($0, 2)
        gsub(/[ \t]+/, "", line)
        if (line == "") next
        other = /^\+/ ? "-" : "+"
        if (open_lines[other, line] > 0) { open_lines[other, line]--; moved += 2 } else open_lines[substr($0, 1, 1), line]++
      }
      END { print changed - moved }'
}

git rev-list --no-merges --reverse "$range" HEAD | while read -r commit; do
  title=$(git show -s --format=%s "$commit")
  {
    title_fault "$title"
    body_fault "$commit"
    lines=$(changed_lines "$commit")
    [ "$lines" -le $most_lines ] || echo "it changes $lines lines, more than $most_lines"
  } | while read -r fault; do
    echo "warning: $(git show -s --format=%h "$commit") '$title': $fault"
  done
done
