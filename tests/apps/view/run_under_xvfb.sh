#!/bin/sh
# Runs a command on an X server of its own; 77 (skipped) if there is no Xvfb.
# SWELL_TEST_SCREEN: the screen, such as 1280x720x24.
if ! command -v xvfb-run >/dev/null || ! command -v Xvfb >/dev/null; then
  echo "skipped: no Xvfb" >&2
  exit 77
fi
exec xvfb-run -a -s "-screen 0 ${SWELL_TEST_SCREEN:-1280x720x24}" "$@"
