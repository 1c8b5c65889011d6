#!/bin/sh
# The documents: their size, their faults, the generated page of options, the site.
#   scripts/docs.sh count | check | options | site OUT
# --help says the rest.
exec python3 -B "$(dirname "$0")/docs.py" "$@"
