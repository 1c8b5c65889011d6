#!/bin/sh
# Are the frames of this tree as fast as a commit's?
#   scripts/compare.sh [--turns N] [--frames N] [--threads N] COMMIT [-- SCENE|WxH ...]
# --help says the rest.
exec python3 -B "$(dirname "$0")/compare.py" "$@"
