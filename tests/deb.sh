#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The Debian package is made, and works where only its dependencies are:   tests/deb.sh BUILD_FOLDER
# It is installed by apt in a fresh Debian 12 (needs root and mmdebstrap) and used there; without those two it is unpacked and used.
# With BREECH_FULL=1 alone: making it takes half a minute, and tests/install.sh uses the same files.  Exit 77 = skipped.
set -euo pipefail
build=$(realpath "$1") tests=$(dirname "$(realpath "$0")")
[ "${BREECH_FULL:-0}" = 1 ] || { echo 'skipped: only with BREECH_FULL=1' && exit 77; }
if ! command -v cpack >/dev/null || ! command -v dpkg-shlibdeps >/dev/null ||
    ! grep -q '^CMAKE_BUILD_TYPE:[A-Z]*=Release' "$build/CMakeCache.txt" || ! grep -q '^CMAKE_C_COMPILER:.*gcc' "$build/CMakeCache.txt"; then
    echo 'skipped: no release build by gcc, or no dpkg-dev'
    exit 77
fi
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
chmod 755 "$folder"
cpack --config "$build/CPackConfig.cmake" -B "$folder/made" >"$folder/log" 2>&1 || { cat "$folder/log" && exit 1; }
package=$(echo "$folder"/made/*.deb)
depends=$(dpkg-deb -f "$package" Depends)
for library in libc6 libhdf5-103-1 libsundials-ida6 libgsl27 libyaml-0-2 libudunits2-0 libcjson1 libgomp1; do
    [[ ", $depends" == *", $library "* || ", $depends," == *", $library,"* ]] || { echo "the package does not depend on $library: $depends" && exit 1; }
done
[ "$(dpkg-deb -f "$package" Version)" = "$version" ] || { echo "the package is not of version $version" && exit 1; }

if [ "$(id -u)" != 0 ] || ! command -v mmdebstrap >/dev/null; then
    dpkg-deb -x "$package" "$folder/root"
    mkdir "$folder/elsewhere"
    exec bash "$tests/installed.sh" "$folder/root/usr" "$folder/elsewhere" "$version"
fi
mmdebstrap --quiet --variant=apt bookworm "$folder/root"
cp "$package" "$tests/installed.sh" "$folder/root/tmp/"
mkdir -p "$folder/root/proc"
within() # its /proc goes with the command, so that nothing is left mounted
{
    # shellcheck disable=SC2016 # for the inner shell
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive unshare --mount \
        sh -c 'mount --bind /proc "$0/proc" && exec chroot "$0" "$@"' "$folder/root" "$@"
}
within apt-get update -qq
within apt-get install -y -qq --no-install-recommends "/tmp/$(basename "$package")" >"$folder/log" 2>&1 || { cat "$folder/log" && exit 1; }
within mkdir /tmp/elsewhere
within bash /tmp/installed.sh /usr /tmp/elsewhere "$version"
within bash -c 'cd /tmp && mkdir user && chown nobody user && cd user && su -s /bin/sh nobody -c "breech shot default_shot --quiet && ls -l out/default_shot"'
