#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The libraries as somebody else uses them:   tests/library.sh BUILD_FOLDER
# Every public header compiles alone as C and as C++ and leaves no macro, type or enumerator without a prefix; the
# programs of examples/ give the right answers, built in the tree, by find_package(breech) and by pkg-config; C++ links.
# Exit 77 = skipped.
set -euo pipefail
build=$(realpath "$1") tree=$(dirname "$(dirname "$(realpath "$0")")")
if grep -qE '^CMAKE_(C_FLAGS|C_FLAGS_DEBUG):.*fsanitize' "$build/CMakeCache.txt" ||
    ! grep -q '^CMAKE_C_COMPILER:.*gcc' "$build/CMakeCache.txt" || ! command -v pkg-config >/dev/null || ! command -v g++ >/dev/null; then
    echo 'skipped: a build with sanitizers or not by gcc, or no pkg-config or g++'
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail()
{
    printf '%s\n' "$*" >&2
    exit 1
}
cmake --install "$build" --prefix "$folder/first" >log || { cat log && exit 1; }
mv first moved

# ---- headers ----

# Names of macros after the text on standard input, but those that the compiler has without it.
macros() { gcc -dM -E -Imoved/include/breech - | sed -E 's/^#define ([A-Za-z0-9_]+).*/\1/' | sort; }
types() # the same of types and enumerators
{
    local object # one each: two of these run side by side
    object=$(mktemp --tmpdir=. --suffix=.o)
    gcc -x c -g -fno-eliminate-unused-debug-types -fno-eliminate-unused-debug-symbols -c -Imoved/include/breech -o "$object" -
    readelf --debug-dump=info "$object" | awk '
        /Abbrev Number/ { named = /DW_TAG_(typedef|enumerator|structure_type|union_type|enumeration_type)/ }
        named && /DW_AT_name/ { print $NF; named = 0 }' | sort -u
}
looked=0
while read -r header; do
    grep -qE "^#ifndef BREECH_" "moved/include/breech/$header" || continue # a row of a table
    printf '#include "%s"\n' "$header" >one.c
    gcc -std=c11 -Wall -Wextra -Werror -fsyntax-only -Imoved/include/breech one.c || fail "$header does not compile alone as C"
    g++ -x c++ -std=c++17 -Wall -Wextra -Werror -fsyntax-only -Imoved/include/breech one.c || fail "$header does not compile alone as C++"
    { gcc -M -Imoved/include/breech one.c | grep -oE 'moved/[^ ]*\.(h|def)' | xargs cat | grep -E '^#include <' || true; } | sort -u >standard
    leaked=$(comm -13 <(macros <standard) <(macros <one.c) | grep -vE '^(BASE|CIRCUIT|MPM|BREECH)_' || true)
    [ -z "$leaked" ] || fail "$header leaves macros: $leaked"
    leaked=$(comm -13 <(types <standard) <(types <one.c) | grep -vE '^(BASE|CIRCUIT|MPM|BREECH|base|circuit|mpm)(_|$)' || true)
    [ -z "$leaked" ] || fail "$header leaves types or enumerators: $leaked"
    looked=$((looked + 1))
done < <(cd moved/include/breech && find . -name '*.h' -printf '%P\n' | sort)
[ $looked -ge 15 ] || fail "only $looked headers were looked at"
if find moved/include -name '*_internal.h' -o -name lanes.h | grep .; then fail 'private headers are installed'; fi

# ---- examples ----

answers() # folder of the programs, prefix of their names
{
    said=$("$1/$2shot")
    [ "$said" = "$expected" ] || fail "$1: shot says $said, the program $expected"
    read -r peak _ _ _ _ _ _ momentum _ _ energy < <("$1/$2sphere_on_plate" | tr -d ,)
    awk -v p="$peak" -v m="$momentum" -v e="$energy" 'BEGIN { exit !(p > 10 && p < 16.3 && m < 1e-12 && e * e < 1e-24) }' ||
        fail "$1: sphere_on_plate: $peak GPa (16.2 of the planar impact at most), momentum $momentum, energy $energy"
    read -r _ _ _ soft _ _ _ _ _ hard _ < <("$1/$2own_strength" | tr -d ';')
    awk -v s="$soft" -v h="$hard" 'BEGIN { exit !(s > 10 && h > s + 1 && h < 20) }' || fail "$1: own_strength: $soft, $hard mm"
}
muzzle() # of the case that shot.c is
{
    "$build/bin/breech" shot "$tree/cases/default_shot" -o shot --force --quiet --set output.report=no 2>err || { cat err >&2 && return 1; }
    sed -nE 's/.*"muzzle_velocity":[ \t]*([0-9.]+).*/\1/p' shot/summary.json | head -n 1 | awk '{ printf "%.1f m/s\n", $1 }'
}
expected=$(muzzle)
answers "$build/bin" example_
cmake -S moved/share/doc/breech/examples -B found -DCMAKE_PREFIX_PATH="$folder/moved" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_COMPILER="$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")" >log 2>&1 || { cat log && exit 1; }
cmake --build found --parallel 2 >log 2>&1 || { cat log && exit 1; }
grep -q "$folder/moved/lib" found/CMakeFiles/*/link.txt found/CMakeFiles/example_shot.dir/link.txt 2>/dev/null || fail 'find_package took another installation'
answers found example_

export PKG_CONFIG_PATH=$folder/moved/lib/pkgconfig
mkdir by_hand
for example in shot:circuit sphere_on_plate:mpm own_strength:mpm; do
    # shellcheck disable=SC2046 # words
    gcc -O1 -Wall -Wextra -Werror "$tree/examples/${example%:*}.c" $(pkg-config --cflags --libs "breech-${example#*:}") -lm -o "by_hand/${example%:*}" || fail "$example: pkg-config"
done
answers by_hand ''
[ "$(pkg-config --modversion breech-mpm)" = "$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")" ] || fail 'pkg-config: another version'

cat >user.cpp <<'END'
#include "circuit/shot.h"
#include "mpm/mpm.h"
int main()
{
    mpm_scene scene;
    mpm_scene_default(&scene);
    mpm_body *body;
    const base_status s = mpm_scene_add_body(&scene, &body);
    mpm_scene_free(&scene);
    circuit_shot_config config = {};
    return s.code == BASE_STATUS_OK && circuit_shot_check(&config).code == BASE_STATUS_BAD_INPUT ? 0 : 1;
}
END
# shellcheck disable=SC2046
g++ -Wall user.cpp $(pkg-config --cflags --libs breech-circuit breech-mpm) -o user && ./user || fail 'C++ does not link or run'
echo "$looked headers, three examples in three ways"
