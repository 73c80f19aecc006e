# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# Sourced by demo.sh and test.sh: the Debian 12 packages Breech needs, and how to get them.  The one list of them.

packages_build=(gcc libc6-dev cmake ninja-build libsundials-dev libgsl-dev libhdf5-dev libyaml-dev libudunits2-dev
                libcjson-dev libcmocka-dev gnuplot-nox libopenmpi-dev openmpi-bin dpkg-dev file)
packages_test=(git clang lld libclang-rt-14-dev libomp-dev clang-format pyflakes3 python3-h5py python3-matplotlib
               python3-yaml python3-pip pkg-config g++)
packages_full=(ngspice paraview python3-paraview xvfb xauth chromium mmdebstrap pandoc doxygen fonts-dejavu-extra)

packages_missing()
{
    local package
    for package in "$@"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || printf '%s ' "$package"
    done
}

packages_refuse() # reason, packages
{
    printf '%s: cannot install the missing packages: %s.\n' "$0" "$1" >&2
    printf 'Please install them as root, then start %s again:\n    apt-get update && apt-get install %s\n' "$0" "$2" >&2
    exit 1
}

# Installs what is missing of the packages named; nothing is touched when all are there.
packages_install()
{
    local missing log as_root=()
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        printf '%s: this is not a Debian system; going on with what is installed. Breech is built on Debian 12 with:\n' "$0"
        printf '    %s\n' "$*"
        return 0
    fi
    missing=$(packages_missing "$@")
    [ -n "$missing" ] || return 0
    if [ "$(id -u)" != 0 ]; then
        if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
            packages_refuse 'not root, and sudo is missing or asks for a password' "$missing"
        fi
        as_root=(sudo -n)
    fi
    printf '%s: installing %s(a minute or two)\n' "$0" "$missing"
    log=$(mktemp)
    "${as_root[@]}" apt-get update -qq >"$log" 2>&1 ||
        printf '%s: the package lists could not be refreshed; trying with the old ones\n' "$0" >&2
    # shellcheck disable=SC2086 # a list of words
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >"$log" 2>&1 || {
        tail -n 5 "$log" >&2
        packages_refuse 'apt-get failed (no network, or a package source without them?)' "$missing"
    }
    rm -f "$log"
}
