#!/usr/bin/env bash
# The paper's rows (tests/paper/wu2017.py) at two cells a radius, ten minutes: only with BREECH_FULL=1.
#   tests/paper.sh BREECH
[ "${BREECH_FULL:-0}" = 1 ] || { echo 'skipped: BREECH_FULL is not 1' && exit 77; }
rm -rf paper-out
exec /usr/bin/python3 "$(dirname "$0")/paper/wu2017.py" "$1" paper-out 2
