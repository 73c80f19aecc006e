#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What `cmake --install` lays down works outside the tree, also after it was moved:   tests/install.sh BUILD_FOLDER
# The program knows the installed cases and materials, links of the manual lead somewhere, Python finds the program.
# Exit 77 = skipped.
set -euo pipefail
build=$(realpath "$1")
if [ ! -x "$build/bin/breech" ]; then
    echo 'skipped: the program is not built'
    exit 77
fi
tests=$(dirname "$(realpath "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$build" --prefix "$folder/first" >"$folder/log" || { cat "$folder/log" && exit 1; }
mkdir "$folder/elsewhere"
mv "$folder/first" "$folder/moved"
exec bash "$tests/installed.sh" "$folder/moved" "$folder/elsewhere" "$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")"
