#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# No Python file uses a name that nothing defines, or imports one that it does not use.    Exit 77 = skipped.
# A function of a table that takes half an hour to run would say so last.
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/files.sh
if ! command -v pyflakes3 >/dev/null; then
    echo 'skipped: pyflakes3 is not installed (Debian: pyflakes3)'
    exit 77
fi
mapfile -t files < <(sources '\.py$')
[ ${#files[@]} -gt 40 ] || { echo "only ${#files[@]} files were looked at" && exit 1; }
pyflakes3 "${files[@]}"
