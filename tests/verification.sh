#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The closed answers of cases/verification as a user runs them:   tests/verification.sh PROGRAM
# The quick ones; with BREECH_FULL=1 all that have a list of expectations.
set -euo pipefail
breech=$1
cases=$(cd "$(dirname "$0")/../cases/verification" && pwd)
names='copper_hugoniot two_disks spinning_strut bending_strut sod notched_bar'
if [ "${BREECH_FULL:-0}" = 1 ]; then names=$(cd "$cases" && ls */expected.yaml | xargs -n 1 dirname); fi
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
bad=0
for name in $names; do
    printf '%s\n' "$name"
    "$breech" scene "$cases/$name" -o "$out/$name" --quiet --set output.report=no --set output.snapshots=0 2>"$out/said" ||
        { cat "$out/said" && exit 1; }
    "$breech" check "$cases/$name" --expect "$out/$name" || bad=1
done
exit $bad
