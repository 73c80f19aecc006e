#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tables of docs/validation: the comparison notices what it should, and every part has its place in a page.  With
# BREECH_FULL=1 the quick parts are computed anew and compared (tables.py --list; half an hour of two cores).
#   tests/tables.sh BREECH
set -euo pipefail
validate=$(dirname "$(realpath "$0")")/validate python=/usr/bin/python3
[ -x $python ] || { echo "skipped: no $python" && exit 77; }
$python "$validate/test_pages.py"
$python "$validate/test_pairs.py"
if [ "${BREECH_FULL:-0}" != 1 ]; then exit; fi
$python "$validate/tables.py" "$1" tables-out --check
