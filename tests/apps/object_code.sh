#!/bin/sh
# What the compiler made of the library's static archives. Pictures are the same everywhere only if
#   - multiply and add are fused where the source says so alone: in *_simd.cpp objects;
#   - no approximate reciprocal or reciprocal root is used (Intel's and AMD's differ);
#   - no function of libm is called whose last bits depend on the machine.
# Usage: object_code.sh OBJDUMP NM ARCHIVE...
set -eu
objdump=$1
nm=$2
shift 2
faults=0

# Functions of libm that IEEE 754 defines to the last bit, or that only move bits.
exact='sqrt|floor|ceil|trunc|round|nearbyint|rint|lrint|llrint|lround|llround|fma|fabs|fmod|remainder|frexp|ldexp|scalbn|scalbln|ilogb|logb|modf|copysign|nextafter|fmin|fmax|fdim'
inexact='a?(sin|cos|tan)h?(pi)?|atan2|sincos|exp|exp2|exp10|expm1|log|log2|log10|log1p|pow|cbrt|hypot|erfc?|[lt]gamma|j[01n]|y[01n]'

report() {
  echo "$1"
  faults=$((faults + 1))
}

for archive; do
  # "file.cpp.o: instruction" of everything that is forbidden.
  listing=$("$objdump" -d --no-show-raw-insn "$archive" | awk '
    # "x.cpp.o:" with the GNU program, "archive.a(x.cpp.o):" with that of LLVM.
    /^[^ ].*file format/ { object = $1; sub(/\)?:$/, "", object); sub(/.*\(/, "", object); next }
    $2 ~ /^v?rcp(14|28)?[ps][sdh]$/ || $2 ~ /^v?rsqrt(14|28)?[ps][sdh]$/ {
      print object ": approximate " $2; next }
    $2 ~ /^vfn?m(add|sub|addsub|subadd)/ && object !~ /_simd\.cpp\.o$/ {
      print object ": fused " $2 }' | sort | uniq -c)
  [ -z "$listing" ] || report "$archive: forbidden instructions
$listing"

  imports=$("$nm" -u "$archive" | awk '{ print $NF }' | sed 's/@.*//' | sort -u |
    grep -E "^($inexact)[fl]?$" | grep -Ev "^($exact)[fl]?$" || true)
  [ -z "$imports" ] || report "$archive: calls of libm functions that differ between machines:
$imports"
done

if [ "$faults" -ne 0 ]; then exit 1; fi
echo "$# archives are clean"
