#!/bin/sh
# api_reference.sh DOXYGEN BUILD: makes the API reference; any warning fails it.
set -eu
rm -rf "$2/reference"
"$1" "$2/Doxyfile"
# has FILE TEXT
has() {
  grep -q "$2" "$1" || { echo "$1 lacks '$2'"; exit 1; }
}
html=$2/reference/html
has "$html/swell_8h.html" 'Draws into the picture'
has "$html/structswell__pick.html" 'from the eye'
has "$html/structswell_1_1ocean_1_1Disturbance.html" 'beam, length, draught'
