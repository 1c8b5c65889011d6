#!/bin/sh
# Whether a shared library has the functions that a header declares, and no other symbol.
#   exported_symbols.sh NM LIBRARY HEADER
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" -D --defined-only --format=posix "$2" | sed 's/[@ ].*//' | grep -v '^SWELL_[0-9]*$' | sort >"$work/has"
tr '\n' ' ' <"$3" | grep -o 'SWELL_API [^;]*;' | grep -o 'swell_[a-z_]*(' | tr -d '(' | sort >"$work/declares"
test -s "$work/declares"
diff "$work/declares" "$work/has"
