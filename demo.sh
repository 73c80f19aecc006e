#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The main job on the default case: a shot, its sites, and where along the rail gouging begins.
# Installs missing Debian packages, builds build/release, writes out/default_shot.
set -euo pipefail
cd "$(dirname "$0")"
source cmake/debian-packages.sh

packages_install "${packages_build[@]}"
cmake --preset release
cmake --build --preset release
./build/release/bin/breech onset cases/default_shot -o out/default_shot --force "$@"
printf '\nResults: out/default_shot\n'
printf '    summary.json   every number     report.html   the same to look at     history.h5, *.hdf   for HDF5 tools, ParaView\n'
