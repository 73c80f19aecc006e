#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tries deliberate faults in a scratch copy: each must build, and its test must fail, or that test proves less than it
# seems to.  They stand in one list a room, mpm-grid.txt those of mpm/grid, one a line:
#   file :: test of ctest :: sed -E expression that puts the fault in
#   tests/mutants/run.sh [PATTERN]   all (hours), or those whose line matches the pattern
#   tests/mutants/run.sh --part K/N  every Nth, from the Kth on (K = 0 .. N - 1)
#   tests/mutants/run.sh --check     only that every line stands in its room's list, applies and names a test (seconds;
#                                    part of ctest)
set -euo pipefail
cd "$(dirname "$0")/../.."
source tests/files.sh
export BREECH_FULL=0 # the short part of a test must notice

pattern=. dry=0 part=0/1
case "${1:-}" in
--check) dry=1 ;;
--part) part=$2 ;;
?*) pattern=$1 ;;
esac

list=$(cat tests/mutants/*.txt | grep -vE '^[[:space:]]*(#|$)' | grep -E -- "$pattern") ||
    { echo "no fault matches $pattern" && exit 1; }
list=$(awk -v k="${part%/*}" -v n="${part#*/}" 'NR % n == k % n' <<<"$list")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

split() # one line of the list -> file, test, fault
{
    file=${1%% :: *}
    local rest=${1#* :: }
    test=${rest%% :: *}
    fault=${rest#* :: }
}

# Every line stands in the list of its file's room.
check_rooms()
{
    local list line room bad=0
    for list in tests/mutants/*.txt; do
        while read -r line; do
            split "$line"
            room=${file%/*} room=${room//\//-}
            if [ "$room.txt" != "${list##*/}" ]; then echo "belongs in tests/mutants/$room.txt: $line" && bad=1; fi
        done < <(grep -vE '^[[:space:]]*(#|$)' "$list")
    done
    return $bad
}

# Faults of one file, those of $lines.  One sed tries them all, each on every line as it was, and prints the numbers of
# those that match; what begins with an address has one of its own.
check_file() # file
{
    local number bad=0 script=h file test fault
    local -A applies=()
    for number in "${!lines[@]}"; do
        split "${lines[number]}"
        if [[ $fault == s* ]]; then
            script+=$'\ng\n'$fault$'\ntY'$number$'\nbN'$number$'\n:Y'$number$'\ni\\\n'$number$'\n:N'$number
        elif ! sed -E "$fault" "$1" | cmp -s "$1"; then
            applies[$number]=1
        fi
    done
    while read -r number; do applies[$number]=1; done < <(sed -nE "$script" "$1")
    for number in "${!lines[@]}"; do
        if [ -z "${applies[$number]:-}" ]; then echo "changes nothing: ${lines[number]}" && bad=1; fi
    done
    return $bad
}

check_list()
{
    local line last='' bad=0
    local -a lines=()
    while read -r line; do
        split "$line"
        if [ "$file" != "$last" ] && [ ${#lines[@]} -gt 0 ]; then
            check_file "$last" || bad=1
            lines=()
        fi
        last=$file
        if [ ! -f "$file" ]; then echo "no such file: $line" && bad=1 && last='' && continue; fi
        lines+=("$line")
        if [ ! -f "tests/$test.c" ] && [ ! -f "tests/$test.sh" ]; then echo "no such test: $line" && bad=1; fi
    done < <(sort -s -t: -k1,1 <<<"$list")
    if [ ${#lines[@]} -gt 0 ]; then check_file "$last" || bad=1; fi
    return $bad
}

# Builds what a test needs and runs it; output in $scratch/log.  Nothing to read for them: mpirun would take the list's rest.
build_test()
{
    local target=breech # what a test that is a script runs
    if [ -f "$copy/tests/$1.c" ]; then target=$1; fi
    cmake --build "$copy/build" --target "$target" --parallel "$(nproc)" </dev/null >"$scratch/log" 2>&1
}
run_test()
{
    ctest --test-dir "$copy/build" --no-tests=error --timeout 600 -R "^$1\$" </dev/null >"$scratch/log" 2>&1
}

check_rooms
check_list
if [ $dry = 1 ]; then echo "$(wc -l <<<"$list") faults, all apply" && exit 0; fi

copy=$scratch/copy
mkdir "$copy"
sources . | tr '\n' '\0' | xargs -0 cp --parents -t "$copy"
cmake -S "$copy" -B "$copy/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O2 -DBREECH_WERROR=OFF \
    >"$scratch/log" || { cat "$scratch/log" && exit 1; }

# Without a fault every named test must pass, else its failing proves nothing.
while read -r test; do
    if ! build_test "$test" || ! run_test "$test"; then
        cat "$scratch/log"
        echo "$test fails without any fault" && exit 1
    fi
done < <(while read -r line; do split "$line" && echo "$test"; done <<<"$list" | sort -u)

survived=0 tried=0
while read -r line; do
    split "$line"
    tried=$((tried + 1))
    cp "$copy/$file" "$scratch/faultless"
    sed -E -i "$fault" "$copy/$file"
    if ! build_test "$test"; then
        cat "$scratch/log"
        echo "DOES NOT BUILD  $line" && survived=$((survived + 1))
    elif run_test "$test"; then
        echo "NOT NOTICED     $line" && survived=$((survived + 1))
    else
        echo "noticed         $line"
    fi
    cp "$scratch/faultless" "$copy/$file" # a new time stamp, so that the next build sees it
done <<<"$list"
echo "$tried of $(wc -l <<<"$list") faults tried, $survived not noticed by their test"
[ $survived = 0 ] && [ $tried = "$(wc -l <<<"$list")" ]
