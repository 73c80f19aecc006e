#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# All tests.    ./test.sh          gcc, optimised; clang with sanitizers, without what is slow     (minutes)
#               ./test.sh --full   the long parts too; all short parts with both compilers, optimised and sanitized,
#                                  and the portable build; the reader fuzzed with 10^6 inputs; a twelfth of the
#                                  deliberate faults and a sixth of the figures' commands, others for every commit
#                                  (all: tests/mutants/run.sh, tests/validate/figures.py)   (hours)
# Installs missing Debian packages.  The last lines repeat the closing line of every ctest run.
set -euo pipefail
cd "$(dirname "$0")"
source cmake/debian-packages.sh

full=0
case "${1:-}" in
'') ;;
--full) full=1 ;;
*) printf 'usage: %s [--full]\n' "$0" >&2 && exit 2 ;;
esac

packages=("${packages_build[@]}" "${packages_test[@]}")
if [ $full = 1 ]; then packages+=("${packages_full[@]}"); fi
packages_install "${packages[@]}"

export OMP_WAIT_POLICY=passive # tests share the machine
export UBSAN_OPTIONS=print_stacktrace=1
# clang 14's leak check may die of the threads' storage (llvm D147459); keeping 16 MB of freed memory, not 256, is faster
export ASAN_OPTIONS=intercept_tls_get_addr=0:quarantine_size_mb=16
export LSAN_OPTIONS=suppressions=$PWD/tests/leaks.txt:print_suppressions=0
export BREECH_HEAVY=$full # what is heavy with sanitizers (tests/full_common.h)
limit=$([ $full = 1 ] && echo 14400 || echo 1800) # [s] only a test that hangs takes so long
log=$(mktemp)
trap 'rm -f "$log"' EXIT
closing='' failed=0

finish() # name, 0 or 1, text
{
    closing+=$(printf '%-14s %s' "$1" "$3")$'\n'
    if [ "$2" != 0 ]; then failed=1; fi
}

# The five slowest tests of the ctest run in $log.  Nothing fails by the clock: a short part of more than a minute is
# marked, to be split or made smaller.
slowest()
{
    printf 'slowest:\n'
    sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .* ([0-9.]+) sec.*/\2 \1/p' "$log" | sort -rn | head -5 |
        awk -v full="$BREECH_FULL" '{ mark = ($1 > 60 && full == 0) ? "   LONG: more than a minute" : ""
            printf "%8.1f s  %s%s\n", $1, $2, mark }'
}

# Configure, build, test one preset, long parts 0 or 1; without the tests whose label matches the third argument.
# What checks the tree and not a build (label `tree`) runs with the first preset alone.
stage()
{
    local preset=$1 without=$3 bad=0
    export BREECH_FULL=$2
    printf '\n==== %s ====\n' "$preset"
    if ! { cmake --preset "$preset" >"$log" 2>&1 || { cat "$log" && false; }; } ||
        ! cmake --build --preset "$preset" --parallel "$(nproc)"; then
        finish "$preset" 1 'does not build'
        return 0
    fi
    ctest --test-dir "build/$preset" --output-on-failure --no-tests=error --timeout "$limit" --parallel "$(nproc)" \
        --label-exclude "$without" | tee "$log" || bad=1
    slowest
    finish "$preset" $bad "$(grep -E 'tests passed|No tests' "$log" || echo 'ctest did not finish')"
}

# Name and command of a check that is no ctest run.
check()
{
    local name=$1
    shift
    printf '\n==== %s ====\n' "$name"
    if "$@"; then finish "$name" 0 passed; else finish "$name" 1 FAILED; fi
}

stage release $full none
stage clang-debug 0 "$([ $full = 1 ] && echo tree || echo 'tree|slow')"
if [ $full = 1 ]; then
    stage debug 0 tree
    stage clang-release 0 tree
    stage portable 0 tree
    check fuzz tests/fuzz.sh 1000000
    commit=$(git rev-parse --short=7 HEAD 2>/dev/null || echo 0)
    check mutants tests/mutants/run.sh --part $((16#$commit % 12))/12
fi

printf '\n==== closing lines, after %d s ====\n%s' $SECONDS "$closing"
exit $failed
