#!/bin/sh
# Whether programs compiled with the recorded swell.h run with this one: no function, no type and no place of a member that
# they know may change. The library exports exactly what the header declares (exported_symbols.sh), so functions made of the
# declarations alone are compared.
#   recorded_abi.sh CC HEADER RECORDED    SWELL_UPDATE_ABI=1 records anew what may be added
set -eu
command -v abidiff >/dev/null || { echo "note: skipped, for want of abigail-tools"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
grep -v '^#' "$2" | tr '\n' ' ' | grep -o 'SWELL_API [^;]*;' | sed 's/;$/ { __builtin_trap(); }/' >"$work/functions.h"
printf '#include "swell.h"\n#include "functions.h"\n' >"$work/swell.c"
"$1" -std=c11 -g -O0 -shared -fPIC -Wl,-soname,libswell.so.0 -I "$(dirname "$2")" -I "$work" "$work/swell.c" -o "$work/libswell.so"
abidw --no-corpus-path --no-show-locs --no-comp-dir-path "$work/libswell.so" >"$work/swell.abi"
same=true
abidiff "$3" "$work/swell.abi" >"$work/report" || same=false
breaks="[1-9][0-9]* Removed|deletion|data member change|enumerator change|offset changed|return type changed|parameter [0-9]+ .*(was|changed)|type name changed"
if $same; then
  exit 0
elif [ "${SWELL_UPDATE_ABI:-}" ] && ! grep -qE "$breaks" "$work/report"; then
  cp "$work/swell.abi" "$3"
else
  cat "$work/report"
  echo "error: include/swell.h is not the recorded interface; if it adds something: SWELL_UPDATE_ABI=1 $0 $*" >&2
  exit 1
fi
