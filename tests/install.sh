#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What `cmake --install` lays down works outside the tree:   tests/install.sh BUILD_FOLDER
# The program starts, says its version and knows the installed materials; a user's program compiles and links with
# the installed headers and libraries.  Exit 77 = skipped.
set -euo pipefail
build=$1
if [ ! -x "$build/bin/breech" ]; then
    echo 'skipped: the program is not built'
    exit 77
fi
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$build" --prefix "$prefix" >"$prefix/log" || { cat "$prefix/log" && exit 1; }

cd "$prefix"
for file in share/breech/cases/materials lib/python3/dist-packages/breech/__init__.py share/breech/tools/paraview_crater.py include/breech/base/status.h include/breech/circuit include/breech/mpm/mpm.h; do
    if [ ! -e $file ]; then echo "not installed: $file" && exit 1; fi
done
bin/breech --version | grep -qF "$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")" ||
    { echo 'breech --version does not say the version' && exit 1; }
materials=$(env -u BREECH_MATERIALS bin/breech materials) ||
    { echo 'breech materials fails on the installed materials' && exit 1; }
for file in share/breech/cases/materials/*.yaml; do
    grep -q "^$(basename "$file" .yaml) .*$(realpath share)/breech/cases/materials" <<<"$materials" ||
        { echo "breech materials does not list $file" && exit 1; }
done
env -u BREECH_MATERIALS bin/breech check share/breech/cases/default_shot >/dev/null ||
    { echo 'breech check fails on an installed case' && exit 1; }

cat >user.c <<'END'
#include "base/status.h"
int main(void)
{
    return base_status_error(STATUS_IO, "%d", 7).text[0] == '7' ? 0 : 1;
}
END
compiler=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
"$compiler" -fsanitize=address,undefined -Iinclude/breech user.c -o user lib/libbreech_base.a
./user || { echo 'the user program does not run' && exit 1; }
echo "installed and used from $prefix"
