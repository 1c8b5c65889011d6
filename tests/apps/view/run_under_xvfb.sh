#!/bin/sh
# Runs a command on an X server of its own; 77 (skipped) if there is no Xvfb.
# SWELL_TEST_SCREEN: the screen, such as 1280x720x24.
if ! command -v xvfb-run >/dev/null || ! command -v Xvfb >/dev/null; then
  echo "skipped: no Xvfb" >&2
  exit 77
fi
export LSAN_OPTIONS="suppressions=$(dirname "$0")/third_party_leaks.txt:print_suppressions=0"
# Without -noreset the server starts over, and refuses clients, whenever its last one leaves.
exec xvfb-run -a -s "-noreset -screen 0 ${SWELL_TEST_SCREEN:-1280x720x24}" "$@"
