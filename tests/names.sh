#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every external name begins with its library's prefix: base_, circuit_, mpm_; in coupling with its room's (host_, case_,
# ...).    tests/names.sh BUILD_FOLDER    Exit 77 = skipped.
set -euo pipefail
build=$1
bad=0 looked=0
while read -r object; do
    source=${object#"$build"/}
    source=$(sed -E 's#CMakeFiles/[^/]*\.dir/##; s#\.o$##' <<<"$source")
    [ -f "$source" ] || continue # left over from a file that has moved
    prefix=${source%%/*}
    if [ "$prefix" = coupling ]; then prefix=${source#coupling/} prefix=${prefix%%/*}; fi
    looked=$((looked + 1))
    wrong=$(nm -g --defined-only "$object" |
        awk -v p="${prefix}_" 'NF == 3 && substr($3, 1, 1) != "." && index($3, "_") != 1 && index($3, p) != 1 { print $3 }')
    if [ -n "$wrong" ]; then
        printf '%s: external names without the prefix %s_:\n%s\n' "$source" "$prefix" "$wrong"
        bad=1
    fi
done < <(find "$build"/{base,circuit,mpm,coupling} -name '*.c.o' ! -path '*/breech.dir/*')
if [ $looked = 0 ]; then echo 'skipped: nothing is built' && exit 77; fi
[ $bad = 0 ] && echo "$looked files keep the prefixes"
exit $bad
