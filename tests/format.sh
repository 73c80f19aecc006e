#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every .c and .h is formatted by the repository's .clang-format, and no line is longer than 120 columns.
#    tests/format.sh --fix [FILE...]   formats them.
# Versions of clang-format differ in their results: 14 is the one that counts.  Exit 77 = skipped.
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/files.sh

tool=$(command -v clang-format-14 || command -v clang-format || true)
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
    echo 'skipped: clang-format 14 is not installed (Debian 12: clang-format)'
    exit 77
fi
if [ "${1:-}" = --fix ]; then
    shift
    for file in "$@"; do # the order of a .def is its own
        case $file in *.[ch]) ;; *) echo "$file: only .c and .h are formatted" >&2 && exit 2 ;; esac
    done
    if [ $# -gt 0 ]; then exec "$tool" -i "$@"; fi
    sources '\.[ch]$' | xargs "$tool" -i
    exit 0
fi
bad=0
unformatted=$({ sources '\.[ch]$' | xargs "$tool" --dry-run -Werror --ferror-limit=1 2>&1 || true; } |
    sed -nE 's/^([^ :]+):[0-9]+:.*/\1/p' | sort -u)
if [ -n "$unformatted" ]; then
    printf 'not formatted, tests/format.sh --fix FILE...:\n%s\n' "$unformatted"
    bad=1
fi
wide=$(sources '\.(c|h|def)$' | xargs awk 'length($0) > 120 { print FILENAME ":" FNR ": " length($0) " columns" }')
if [ -n "$wide" ]; then
    printf 'more than 120 columns:\n%s\n' "$wide"
    bad=1
fi
exit $bad
